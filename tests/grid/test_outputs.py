"""Whose the outputs of a grid are: what a component finds there, what it leaves, and that maps and budget agree."""

import copy
import gc
import logging

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow, InputError, ParameterError
from landlab_debrisflow.grid.fields import NODE_FIELDS
from landlab_debrisflow.model.map_fields import PHASES
from validation.grids import COARSE, changed_fields, copy_fields, inclined, release_slab

Z, SOIL, RELEASE = "topographic__elevation", "soil__depth", "debris_flow__release_depth"
ERODED, DEPOSIT, ARRIVAL = (f"debris_flow__{name}" for name in ("eroded_depth", "deposit_depth", "arrival_time"))
OUTPUTS = {field.name: field.start for field in NODE_FIELDS if field.intent == "out"}
PEAKS = [name for name in OUTPUTS if "__max_" in name]
NEAR, FAR = (30.0, 48.0), (60.0, 30.0)
SURGE = {
    "line_start": (20.0, 40.0), "line_end": (20.0, 60.0),
    "times": [0.0, 5.0, 10.0], "discharge": [0.0, 40.0, 0.0], "velocity": 5.0,
}  # fmt: skip


def scene(walled=False):
    """Return a wet slope that runs out on a flat, with something about to fail; a wall may stand across its foot."""
    grid = inclined((20, 80), 5.0, 0.5, soil=1.0, foot=150.0)
    if walled:
        grid.status_at_node[grid.x_of_node >= 160.0] = grid.BC_NODE_IS_CLOSED
    reset(grid)
    return grid


def reset(grid, centre=NEAR):
    """Put back what is an input."""
    grid.at_node[Z][:] = 0.5 * np.maximum(0.0, 150.0 - grid.x_of_node)
    grid.at_node[SOIL][:] = 1.0
    release_slab(grid, centre, 8.0, 1.0)


def outputs(grid):
    return {name: grid.at_node[name].copy() for name in OUTPUTS if name in grid.at_node}


def agree(flow, of=None):
    """Assert that maps, fields and budget tell the same volumes."""
    grid, budget = flow.grid, flow.budget if of is None else of
    area, maps = grid.dx * grid.dy, flow.maps
    resting = np.zeros(0) if flow.particles.sizes["particle"] == 0 else flow._simulation.resting_depth()[1]
    expected = {ERODED: budget["eroded"], DEPOSIT: budget["deposited"] + resting.sum() * area}
    # rounding of elevations of 75 m at some hundred nodes, in every event
    size = 1e-11 * (1.0 + budget["released"] + budget["inflow"])
    for name, volume in expected.items():
        assert grid.at_node[name].sum() * area == pytest.approx(volume, abs=size), name
        assert float(maps[name].sum()) * area == pytest.approx(volume, abs=size), name
    return budget


@pytest.mark.slow
@pytest.mark.parametrize("walled", [False, True])
def test_a_second_component_finds_nothing_of_the_first(walled):
    """A study of parameters: what is an input is put back, and the rest is as on a fresh grid, walls included."""
    grid, fresh = scene(walled), scene(walled)
    DebrisFlow(grid, erosion="none", numerics=COARSE | {"particle_count": 60}).run_until_rest()
    flow = DebrisFlow(grid, numerics=COARSE)
    for name, start in OUTPUTS.items():
        assert name not in grid.at_node or np.all(grid.at_node[name] == start), name
    reset(grid)
    other = DebrisFlow(fresh, numerics=COARSE)
    assert flow.run_until_rest() and other.run_until_rest()
    assert agree(flow) == other.budget
    for name, values in outputs(fresh).items():
        np.testing.assert_array_equal(grid.at_node[name], values, name)


@pytest.mark.slow
def test_numbers_of_two_phases_do_not_stay_for_one():
    grid = scene()
    two = DebrisFlow(grid, flow="two_phase", numerics=COARSE)
    two.run_one_step(4.0)
    phases = [f"debris_flow__{name}" for name in PHASES]
    assert all(grid.at_node[name].any() for name in phases) and set(phases) <= set(two.maps)
    reset(grid)
    one = DebrisFlow(grid, numerics=COARSE)
    one.run_one_step(4.0)
    assert not any(grid.at_node[name].any() for name in phases) and not set(phases) & set(one.maps)
    reset(grid)
    DebrisFlow(grid, flow="two_phase", numerics=COARSE).run_one_step(4.0)
    assert all(grid.at_node[name].any() for name in phases)


def test_the_solid_fraction_is_that_of_dilatant_debris_and_does_not_stay_for_other():
    grid, name = scene(), "debris_flow__solid_fraction"
    dilatant = DebrisFlow(grid, column={"law": "ale", "dilatancy": {}}, numerics=COARSE, erosion="none")
    dilatant.run_one_step(3.0)
    columns, volume = dilatant.columns.solid_fraction, dilatant.particles.volume.values
    under = grid.at_node["debris_flow__depth"] > 0.0
    assert np.array_equal(grid.at_node[name] > 0.0, under)
    # mean over the thickness of every particle, trapezoidal, and over the nodes by volume
    of_particles = columns.values[:, 1:-1].sum(axis=1) + 0.5 * (columns.values[:, 0] + columns.values[:, -1])
    expected = np.sum(volume * of_particles / (columns.shape[1] - 1)) / volume.sum()
    depth = grid.at_node["debris_flow__depth"]
    assert np.sum(depth * grid.at_node[name]) / depth.sum() == pytest.approx(expected, rel=1e-12)
    assert 0.5 < expected < 0.7 and name in dilatant.maps
    words = dilatant.maps.attrs
    assert words["column_dilatancy_permeability"] == 5e-9 and words["column_dilatancy_permeability_units"] == "m2"
    assert not [name for name in words if "coefficient_of_consolidation" in name]
    reset(grid)
    other = DebrisFlow(grid, numerics=COARSE)
    other.run_one_step(1.0)
    assert not grid.at_node[name].any() and name not in other.maps


@pytest.mark.slow
def test_what_is_neither_written_nor_computed_starts_anew():
    """As after reading a grid with the outputs of another process from a file."""
    grid = scene()
    for name in OUTPUTS:
        grid.add_full(name, 7.0, at="node")
    flow = DebrisFlow(grid, numerics=COARSE)
    assert all(np.all(grid.at_node[name] == start) for name, start in OUTPUTS.items())
    flow.run_until_rest()
    agree(flow)


@pytest.mark.parametrize(
    "wrong",
    [
        {"friction": "coulom"}, {"numerics": {"particle_count": 0}}, {"inflow": {"times": [0.0, 1.0]}},
        {"friction": {"law": "coulomb", "basal_friction_angle": np.full(3, 30.0)}}, {"continues": "the last"},
    ],
)  # fmt: skip
def test_a_refused_component_takes_nothing_over(wrong):
    grid = scene()
    flow = DebrisFlow(grid, numerics=COARSE)
    flow.run_one_step(4.0)
    before = copy_fields(grid)
    with pytest.raises((InputError, ParameterError)):
        DebrisFlow(grid, **wrong)
    assert not changed_fields(grid, before)
    assert flow.run_until_rest()
    agree(flow)


# ---- several on one grid ----


def of(flow, name):
    return np.nan_to_num(flow.maps[name].values.ravel())


@pytest.mark.slow
@pytest.mark.parametrize("laws", [({}, {"friction": "voellmy"}), ({"flow": "two_phase"}, {})])
def test_components_called_in_turn_have_outputs_of_their_own(laws):
    grid = scene()
    grid.at_node[RELEASE][:] = 0.0
    flows = [DebrisFlow(grid, numerics=COARSE, **law) for law in laws]
    for flow, other, centre in ((*flows, NEAR), (*flows[::-1], FAR), (*flows, NEAR), (*flows[::-1], NEAR)):
        kept, budget = other.maps, other.budget
        release_slab(grid, centre, 8.0, 0.2)
        grid.at_node[RELEASE][:] = np.minimum(grid.at_node[RELEASE], grid.at_node[SOIL])
        assert flow.run_until_rest()
        agree(flow)
        assert other.budget == budget
        for name in OUTPUTS:
            if name in grid.at_node:
                np.testing.assert_array_equal(grid.at_node[name], of(flow, name) if name in flow.maps else 0.0, name)
            if name in kept:
                np.testing.assert_array_equal(other.maps[name], kept[name], name)
    assert sum(flow.budget["released"] for flow in flows) == pytest.approx(3 * 45.0 + 45.0, rel=1e-12)


@pytest.mark.slow
def test_the_one_called_is_as_if_it_had_been_alone():
    """A call of another one in between, without a release, leaves no trace."""
    grid, alone = scene(), scene()
    first, same = DebrisFlow(grid, numerics=COARSE), DebrisFlow(alone, numerics=COARSE)
    other = DebrisFlow(grid, flow="two_phase", numerics=COARSE)
    for _ in range(3):
        first.run_one_step(4.0)
        same.run_one_step(4.0)
        other.run_one_step(1.0)
        other.new_event()
    assert first.run_until_rest() and same.run_until_rest()
    for name, values in outputs(alone).items():
        np.testing.assert_array_equal(grid.at_node[name], values, name)
    assert first.budget == same.budget


@pytest.mark.slow
def test_outputs_of_one_that_is_gone_do_not_stay():
    grid = scene()
    first = DebrisFlow(grid, numerics=COARSE)
    first.run_until_rest()
    before = outputs(grid)
    second = DebrisFlow(grid, numerics=COARSE)
    reset(grid, FAR)
    second.run_one_step(3.0)
    del second
    gc.collect()
    first.run_one_step(1.0)  # nothing to do
    for name, values in before.items():
        np.testing.assert_array_equal(grid.at_node[name], values, name)


@pytest.mark.slow
def test_they_are_written_also_where_nothing_flowed_since():
    """A call keeps to the rows of the raster that the flow may reach; the first event was far from them."""
    grid = inclined((80, 40), 5.0, 0.5, soil=1.0, foot=100.0)
    release_slab(grid, (30.0, 40.0), 8.0, 1.0)
    flow = DebrisFlow(grid, numerics=COARSE)
    flow.run_until_rest()
    before = {name: grid.at_node[name].copy() for name in (ERODED, DEPOSIT)}
    for name in before:
        grid.at_node[name][:] = 0.0
    release_slab(grid, (30.0, 360.0), 8.0, 0.3)
    flow.run_until_rest()
    agree(flow)
    for name, values in before.items():
        near = grid.y_of_node < 120.0
        np.testing.assert_array_equal(grid.at_node[name][near], values[near], name)


class Auditor:
    interval = 1.0

    def observe(self, flow):
        agree(flow)


class Fails:
    interval = 3.0

    def observe(self, flow):
        raise RuntimeError("no paper left")


@pytest.mark.slow
def test_a_call_that_fails_leaves_the_outputs_of_the_other_one(monkeypatch):
    grid = scene()
    first = DebrisFlow(grid, numerics=COARSE)
    first.run_one_step(2.0)
    maps = first.maps
    second = DebrisFlow(grid, numerics=COARSE)
    release_slab(grid, FAR, 8.0, 0.2)
    second.run_one_step(2.0)
    before = copy_fields(grid)
    bodies, steps = first._simulation.state.bodies, iter(range(100))
    separate = bodies.separate
    monkeypatch.setattr(bodies, "judge", lambda p, *_: separate(p) if next(steps) < 5 else 1 / 0)
    with pytest.raises(ZeroDivisionError):
        first.run_one_step(2.0)
    assert not changed_fields(grid, before)
    for name in OUTPUTS.keys() & set(maps):
        np.testing.assert_array_equal(first.maps[name], maps[name], name)


@pytest.mark.slow
def test_a_copy_of_grid_and_component_is_a_component_of_its_own():
    grid = scene()
    flow = DebrisFlow(grid, numerics=COARSE)
    flow.run_one_step(4.0)
    before, twin = outputs(grid), copy.deepcopy(flow)
    DebrisFlow(twin.grid)  # puts aside what the twin wrote, and nothing else
    for name, values in before.items():
        np.testing.assert_array_equal(grid.at_node[name], values, name)
    assert twin.run_until_rest() and flow.run_until_rest()
    assert agree(twin) == agree(flow)
    for name, values in outputs(grid).items():
        np.testing.assert_array_equal(twin.grid.at_node[name], values, name)


def test_debris_that_is_left_behind_is_said_once(caplog):
    grid = scene()
    flow = DebrisFlow(grid, erosion="none", numerics=COARSE)
    flow.run_one_step(2.0)
    with caplog.at_level(logging.WARNING):
        other = DebrisFlow(grid)
        assert "carries 225 m3 that have not settled: the flow of this one runs through them" in caplog.text
        caplog.clear()
        flow.run_one_step(1.0)  # the other one carries nothing
        other.run_one_step(1.0)
        assert [record.getMessage()[:7] for record in caplog.records] == ["nothing"]


# ---- going on ----


@pytest.mark.slow
@pytest.mark.parametrize("laws", [({}, {}), ({"flow": "two_phase"}, {}), ({}, {"flow": "two_phase"})])
def test_a_component_that_continues_adds_to_maps_and_budget(laws):
    grid = scene()
    first = DebrisFlow(grid, numerics=COARSE, inflow=SURGE, material={"porosity": 0.5}, **laws[0])
    first.run_until_rest()
    before, whole, phases, end = outputs(grid), first.budget, first.budget_by_phase, first.elapsed_time
    second = DebrisFlow(grid, numerics=COARSE, continues=first, **laws[1])
    assert second.elapsed_time == end and second.outflow_by_edge == first.outflow_by_edge
    assert agree(second, whole) == second.budget and second.budget_by_phase == phases
    for name, values in before.items():
        np.testing.assert_array_equal(grid.at_node[name], values, name)
    release_slab(grid, FAR, 8.0, 0.3)
    assert second.run_until_rest() and second.elapsed_time > end
    budget = agree(second)
    assert budget["released"] == pytest.approx(whole["released"] + 67.5, rel=1e-14)
    assert budget["inflow"] == whole["inflow"] > 0.0 and budget["eroded"] > whole["eroded"]
    for name in (*PEAKS, ERODED, DEPOSIT):
        assert np.all(grid.at_node[name] >= before[name]), name
    arrival = grid.at_node[ARRIVAL]
    came = before[ARRIVAL] >= 0.0
    np.testing.assert_array_equal(arrival[came], before[ARRIVAL][came])
    assert arrival[~came].max() > end
    solid = second.budget_by_phase["solid"]
    assert solid["released"] == pytest.approx(0.5 * whole["released"] + 0.6 * 67.5, rel=1e-14)
    for terms in second.budget_by_phase.values():
        assert abs(terms["residual"]) < 1e-10
    assert first.budget == whole and first.budget_by_phase == phases  # its own are as they were
    for name in before.keys() & set(first.maps):
        np.testing.assert_array_equal(first.maps[name].values.ravel(), before[name], name)


@pytest.mark.slow
def test_inflow_of_one_that_continues_is_by_elapsed_time():
    grid = scene()
    first = DebrisFlow(grid, numerics=COARSE)
    first.run_until_rest()
    end = first.elapsed_time
    with pytest.raises(
        InputError, match=r"the inflow begins at .* s, but elapsed_time goes on from .* add that to its"
    ):
        DebrisFlow(grid, continues=first, inflow=SURGE)
    later = SURGE | {"times": [end + time for time in SURGE["times"]]}
    second = DebrisFlow(grid, continues=first, inflow=later, numerics=COARSE)
    assert second.run_until_rest() and agree(second)["inflow"] == pytest.approx(200.0, rel=1e-12)
    assert second.budget["released"] == 225.0


@pytest.mark.slow
def test_only_what_is_over_is_continued():
    grid = scene()
    flow = DebrisFlow(grid, numerics=COARSE | {"settle": False})
    flow.run_one_step(3.0)
    with pytest.raises(InputError, match=r"still carries .* m3 that have not settled; run_until_rest\(\) and settle"):
        DebrisFlow(grid, continues=flow)
    flow.run_until_rest()
    with pytest.raises(InputError, match="still carries"):
        DebrisFlow(grid, continues=flow)
    flow.settle()
    with pytest.raises(InputError, match="on another grid"):
        DebrisFlow(scene(), continues=flow)
    with pytest.raises(InputError, match="continues must be the DebrisFlow before on the same grid, got 7"):
        DebrisFlow(grid, continues=7)
    second = DebrisFlow(grid, continues=flow, inflow=SURGE | {"times": [100.0, 105.0, 110.0]}, numerics=COARSE)
    with pytest.raises(InputError, match="inflow of the earlier DebrisFlow is not over, the next of it enters at 10"):
        DebrisFlow(grid, continues=second)
    assert second.run_until_rest()
    agree(second)


@pytest.mark.slow
def test_a_landscape_with_a_component_for_every_event():
    grid, budget, flow = scene(), None, None
    for centre in (NEAR, FAR, NEAR):
        release_slab(grid, centre, 8.0, 0.2)
        grid.at_node[RELEASE][:] = np.minimum(grid.at_node[RELEASE], grid.at_node[SOIL])
        flow = DebrisFlow(grid, numerics=COARSE, continues=flow)
        flow.run_until_rest()
        assert budget is None or flow.budget["deposited"] > budget["deposited"]
        budget = agree(flow)


# ---- a new event ----


@pytest.mark.slow
def test_a_new_event_starts_peaks_and_nothing_else():
    grid = scene(walled=True)
    flow = DebrisFlow(grid, numerics=COARSE)
    flow.run_until_rest()
    before, budget, end = outputs(grid), flow.budget, flow.elapsed_time
    assert before["debris_flow__max_impact_pressure"][grid.status_at_node == 4].any()  # walls have peaks, too
    flow.new_event()
    for name, values in before.items():
        expected = np.full_like(values, OUTPUTS[name]) if name in (*PEAKS, ARRIVAL) else values
        np.testing.assert_array_equal(grid.at_node[name], expected, name)
    assert flow.budget == budget and flow.elapsed_time == end
    release_slab(grid, FAR, 8.0, 0.3)
    flow.run_until_rest()
    assert agree(flow)["eroded"] > budget["eroded"]
    reached = grid.at_node[ARRIVAL] >= 0.0
    assert grid.at_node[ARRIVAL][reached].min() >= end and not reached[np.argmin(abs(grid.x_of_node - 10.0))]
    assert grid.at_node["debris_flow__max_depth"].max() < before["debris_flow__max_depth"].max()


@pytest.mark.slow
def test_no_event_begins_while_the_last_goes_on():
    grid = scene()
    flow = DebrisFlow(grid, numerics=COARSE, inflow=SURGE)
    flow.run_one_step(12.0)
    before = copy_fields(grid)
    with pytest.raises(InputError, match=r"something still moves or has yet to flow in; run_until_rest\(\) first"):
        flow.new_event()
    assert not changed_fields(grid, before)


@pytest.mark.slow
def test_what_lies_has_forgotten_the_way_it_came():
    """Debris left on a counter-slope has run up; in the next event its surface is its depth above the bed below it."""
    grid = inclined((20, 80), 5.0, 0.0)
    grid.at_node[Z][:] = 0.5 * np.abs(grid.x_of_node - 100.0)
    release_slab(grid, (30.0, 48.0), 12.0, 1.0)
    flow = DebrisFlow(
        grid, numerics=COARSE | {"settle": False}, friction={"law": "coulomb", "basal_friction_angle": 40.0}
    )
    assert flow.run_until_rest()
    run_up, depth = grid.at_node["debris_flow__max_run_up"], grid.at_node["debris_flow__depth"]
    assert run_up.max() > depth.max() + 1.0
    flow.new_event()
    flow.run_one_step(1e-6)
    # a node shows the mean over the tents of particles of different depth
    assert run_up.max() < 1.5 * depth.max() and np.all((run_up > 0.0) == (depth > 0.01))


# ---- maps and budget ----


@pytest.mark.slow
@pytest.mark.parametrize("zeroed", [(DEPOSIT,), (ERODED,), (DEPOSIT, ERODED)])
@pytest.mark.parametrize("settle", [True, False])
def test_the_accounts_are_the_components_own(zeroed, settle):
    """Who sets the fields of erosion and deposit to 0 between calls finds all of it again."""
    grid = scene()
    flow = DebrisFlow(grid, numerics=COARSE | {"settle": settle})
    flow.run_until_rest()
    for name in zeroed:
        grid.at_node[name][:] = 0.0
    area = grid.dx * grid.dy
    assert float(flow.maps[ERODED].sum()) * area == pytest.approx(flow.budget["eroded"], rel=1e-12)
    assert float(flow.maps[DEPOSIT].sum()) * area == pytest.approx(
        flow.budget["deposited"] + flow.budget["moving"], rel=1e-12
    )
    release_slab(grid, FAR, 8.0, 0.3)
    flow.run_one_step(5.0)
    agree(flow)
    flow.run_until_rest()
    agree(flow)


@pytest.mark.slow
@pytest.mark.parametrize("settle", [True, False])
@pytest.mark.parametrize("keywords", [{}, {"flow": "two_phase"}, {"inflow": SURGE}, {"column": "none"}])
def test_over_the_life_of_a_component(settle, keywords):
    grid = scene()
    flow = DebrisFlow(grid, numerics=COARSE | {"settle": settle}, observers=[Auditor()], **keywords)
    agree(flow)
    for _ in range(3):
        flow.run_one_step(2.0)
        agree(flow)
    flow._observers = (Fails(),)
    with pytest.raises(RuntimeError, match="no paper"):
        flow.run_until_rest()
    agree(flow)
    flow._observers = (Auditor(),)
    for centre in (FAR, NEAR):
        flow.run_until_rest()
        agree(flow)
        if flow.at_rest:
            flow.new_event()
        release_slab(grid, centre, 8.0, 0.1)
        grid.at_node[RELEASE][:] = np.minimum(grid.at_node[RELEASE], grid.at_node[SOIL])
        flow.run_one_step(4.0)
        agree(flow)
    flow.run_until_rest()
    flow.settle()
    agree(flow)


@pytest.mark.slow
def test_nodes_closed_over_a_deposit_keep_it_in_the_maps():
    grid = scene()
    flow = DebrisFlow(grid, numerics=COARSE)
    flow.run_until_rest()
    grid.status_at_node[grid.x_of_node >= 160.0] = grid.BC_NODE_IS_CLOSED
    assert np.isnan(flow.maps[Z].values[:, 40]).all()
    agree(flow)
