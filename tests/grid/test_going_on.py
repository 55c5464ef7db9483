"""After a call that failed or was interrupted a flow goes on as if nothing had been, to the bit."""

import tracemalloc
from unittest import mock

import numpy as np
import pytest

from landlab_debrisflow.model.rest import Bodies
from validation.grids import changed_fields, copy_fields

from ..twins import SCENES, Failed, Fails, build, different, failing, outcome, run_through, state

STAGES = ("advance", "friction_and_kick", "entrain", "move", "sample_bed", "interact", "consolidate", "find_limits")


# ---- interrupted ----


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_a_call_that_was_interrupted_goes_on(name, twin):
    expected, expected_state, steps = twin(name)
    rng = np.random.default_rng(1)
    for at in ((0,), (1, 2), rng.integers(3, steps // 2, 1), rng.choice(steps - 1, 4, replace=False), (steps - 1,)):
        flow = build(name, [Fails(*at)])
        assert run_through(flow) == len(at)
        assert not different(outcome(flow), expected) and not different(state(flow), expected_state)


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_an_observer_that_fails_in_the_last_look_finds_a_call_that_came_to_its_end(name, twin):
    expected, expected_state, steps = twin(name)
    flow = build(name, [Fails(steps)])
    with pytest.raises(Failed) as failure:
        flow.run_until_rest()
    assert "the call had come to its end" in failure.value.__notes__[0]
    assert not different(outcome(flow), expected) and not different(state(flow), expected_state)
    assert flow.run_until_rest() is True
    assert not different(outcome(flow), expected)


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_what_is_left_of_a_step_is_enough(name):
    """`run_one_step(dt)` ends where it should have, whatever rounding is in what is left of dt."""
    flow, whole = build(name, [Fails(4, 19, 23)]), build(name)
    for each in (flow, whole):
        for duration in (0.1, 5.3, 0.7):  # 0.1 + t + (5.3 - t) is not 5.4
            run_through(each, duration)
    assert len(flow._observers[0].looks) > 24
    assert not different(outcome(flow), outcome(whole)) and not different(state(flow), state(whole))


@pytest.mark.slow
def test_it_may_go_on_until_rest_or_for_a_time():
    flow, whole = build("eroding", [Fails(30)]), build("eroding")
    with pytest.raises(Failed):
        flow.run_one_step(1000.0)
    flow.run_until_rest()
    whole.run_until_rest()
    assert not different(outcome(flow), outcome(whole))
    flow = build("eroding", [Fails(30)])
    with pytest.raises(Failed):
        flow.run_until_rest()
    then = flow.elapsed_time
    flow.run_one_step(2.0)
    assert flow.elapsed_time == then + 2.0 and not flow.at_rest


def test_while_interrupted_a_flow_shows_itself_and_counts():
    flow = build("eroding", [Fails(60)])
    with pytest.raises(Failed):
        flow.run_until_rest()
    at, area = flow.grid.at_node, 25.0
    assert 0.0 < flow.elapsed_time < 20.0 and not flow.at_rest
    assert float(at["debris_flow__depth"].sum()) * area == pytest.approx(flow.budget["moving"], rel=1e-12)
    assert float(at["debris_flow__eroded_depth"].sum()) * area == pytest.approx(flow.budget["eroded"], rel=1e-12)
    assert flow.budget["eroded"] > 10.0 and flow.budget["deposited"] == 0.0
    assert flow.columns.sizes["particle"] == 60
    seen = flow.maps
    flow.run_one_step(0.0)
    assert flow.maps.identical(seen)


# ---- the grid was changed while interrupted ----


def add_release(grid):
    grid.at_node["debris_flow__release_depth"][(grid.x_of_node == 40.0) & (abs(grid.y_of_node - 30.0) < 8.0)] = 0.5


def take_soil(grid):
    grid.at_node["topographic__elevation"] -= grid.at_node["soil__depth"]
    grid.at_node["soil__depth"][:] = 0.0


def close_nodes(grid):
    grid.status_at_node[grid.x_of_node > 140.0] = grid.BC_NODE_IS_CLOSED


def raise_ground(grid):
    grid.at_node["topographic__elevation"][:] = np.maximum(grid.at_node["topographic__elevation"], grid.x_of_node)


def forget_peaks(grid):
    grid.at_node["debris_flow__max_speed"][:] = 0.0


def replace_soil(grid):
    soil = grid.at_node.pop("soil__depth")
    grid.add_field("soil__depth", soil.copy(), at="node")


def drain_bed(grid):
    grid.at_node["bed__excess_pore_pressure"][:] = 0.0


@pytest.mark.slow
@pytest.mark.parametrize(
    "change", [add_release, take_soil, close_nodes, raise_ground, forget_peaks, replace_soil, drain_bed]
)
def test_what_was_changed_while_interrupted_counts(change):
    name = "loaded bed" if change is drain_bed else "eroding"
    flow, same = (build(name, [Fails(60)]) for _ in range(2))
    for each in (flow, same):
        with pytest.raises(Failed):
            each.run_until_rest()
    change(flow.grid)
    given, before = copy_fields(flow.grid), flow.budget
    flow.run_one_step(1.0)
    same.run_one_step(1.0)
    assert different(outcome(flow), outcome(same))
    at = flow.grid.at_node
    # the next call read what was given, and balances: the fixture of all tests looks at the elevation
    assert flow.budget["released"] - before["released"] == given["debris_flow__release_depth"].sum() * 25.0
    fell = given["soil__depth"] - at["soil__depth"] - given["debris_flow__release_depth"]
    assert flow.budget["eroded"] - before["eroded"] == pytest.approx(fell.sum() * 25.0, abs=1e-9)
    if change is forget_peaks:
        assert (at["debris_flow__max_speed"] == 0.0)[at["debris_flow__max_depth"] > 0.0].any()
    flow.run_until_rest()
    assert abs(flow.budget["residual"]) < 1e-9


def test_what_does_not_concern_the_flow_may_change(twin):
    flow = build("eroding", [Fails(60)])
    with pytest.raises(Failed):
        flow.run_until_rest()
    flow.grid.add_ones("somebody__elses", at="node")
    flow.run_until_rest()
    flow.grid.at_node.pop("somebody__elses")
    assert not different(outcome(flow), twin("eroding")[0])


def test_a_mistake_that_is_mended_does_not_count(twin):
    flow = build("eroding", [Fails(60)])
    with pytest.raises(Failed):
        flow.run_until_rest()
    release = flow.grid.at_node["debris_flow__release_depth"]
    release[500] = -1.0
    with pytest.raises(ValueError, match="must be >= 0 m"):
        flow.run_until_rest()
    release[500] = 0.0
    flow.run_until_rest()
    assert not different(outcome(flow), twin("eroding")[0]) and not different(state(flow), twin("eroding")[1])


@pytest.mark.slow
def test_a_field_that_a_law_reads_counts():
    flows = []
    for angle in (30.0, 60.0):
        flow = build("friction from a field", [Fails(60)])
        with pytest.raises(Failed):
            flow.run_until_rest()
        flow.grid.at_node["friction__angle"][:] = angle
        flow.run_one_step(0.5)
        flows.append(float(abs(flow.particles.velocity_x).max()))
    assert flows[1] < flows[0] - 1.0


# ---- undone ----


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_a_call_that_failed_was_not(name):
    rng = np.random.default_rng(2)
    for stage in rng.choice(STAGES, 3, replace=False):
        flow, same = build(name), build(name)
        duration = float(rng.uniform(0.0, 6.0))
        for each in (flow, same):
            each.run_one_step(duration)
        before, fields = state(flow), copy_fields(flow.grid)
        for _ in range(2):
            with failing(int(rng.integers(2, 25)), stage), pytest.raises(Failed):
                flow.run_until_rest()
            assert not changed_fields(flow.grid, fields)
            assert not different(state(flow), before)
        for each in (flow, same):
            each.run_one_step(1.0)
            each.run_until_rest()
        assert not different(outcome(flow), outcome(same)) and not different(state(flow), state(same))


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_a_call_that_failed_after_it_was_interrupted_goes_on_from_the_interruption(name, twin):
    expected, expected_state, steps = twin(name)
    rng = np.random.default_rng(3)
    flow = build(name, [Fails(int(rng.integers(1, steps // 2)))])
    with pytest.raises(Failed):
        flow.run_until_rest()
    flow._observers, before, fields = (), state(flow), copy_fields(flow.grid)
    for stage in rng.choice(STAGES, 2, replace=False):
        with failing(int(rng.integers(2, steps // 4)), stage), pytest.raises(Failed):
            flow.run_until_rest()
        assert not changed_fields(flow.grid, fields)
        assert not different(state(flow), before)
    flow.run_until_rest()
    assert not different(outcome(flow), expected) and not different(state(flow), expected_state)


def test_whatever_a_step_changes_is_undone():
    """Attributes that nobody has thought of yet: numbers, arrays changed in place, lists, new ones."""
    flow = build("eroding")
    flow.run_one_step(2.0)
    sim = flow._simulation.state
    sim.number, sim.array, sim.nested = 1, np.zeros(3), {"list": [np.zeros(2)]}
    judge = Bodies.judge

    def change(*arguments):
        sim = flow._simulation.state
        sim.number += 1
        sim.array += 1.0
        sim.nested["list"][0] += 1.0
        sim.nested["list"].append(2)
        sim.new = sim.bodies.new = "new"
        return judge(*arguments)

    before = state(flow)
    with mock.patch.object(Bodies, "judge", change), failing(5), pytest.raises(Failed):
        flow.run_one_step(2.0)
    assert not different(state(flow), before)
    sim = flow._simulation.state
    assert sim.number == 1 and not hasattr(sim, "new") and not sim.array.any() and len(sim.nested["list"]) == 1


@pytest.mark.slow
def test_to_undo_costs_no_copy_of_the_raster():
    flow = build("eroding", shape=(400, 300))
    flow.run_one_step(1.0)
    tracemalloc.start()
    try:
        with flow._call.rollback.undo_on_failure():
            assert tracemalloc.get_traced_memory()[0] < 0.3 * flow.grid.at_node["soil__depth"].nbytes
    finally:
        tracemalloc.stop()
