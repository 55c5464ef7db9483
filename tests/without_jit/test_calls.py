"""Calls of few particles on few nodes that reach what stands around the kernels: undo, messages, refusals, files."""

import io
import logging
import signal

import numpy as np
import pytest
import xarray as xr
from rich.console import Console

from landlab_debrisflow import DebrisFlow, InputError, SimulationError, measures
from landlab_debrisflow.core.parameters import declared
from landlab_debrisflow.physics.erosion import Growth
from landlab_debrisflow.record.observers import Progress, Snapshots
from landlab_debrisflow.record.series import Series
from validation.grids import changed_fields, copy_fields, inclined, release_slab

from ..model.test_state import assert_same, begun, build, call
from .scenes import SHAPE, SPACING, SURGE, run

Z, SOIL, RELEASE = "topographic__elevation", "soil__depth", "debris_flow__release_depth"
FEW = {"particle_count": 12, "settle": False}
SOME = 30  # two bodies, or several rows


def slope(soil=1.0, depth=1.0):
    grid = inclined(SHAPE, SPACING, 0.5, soil=soil)
    release_slab(grid, (30.0, 20.0), 6.0, depth, on_top=True)
    return grid


@pytest.fixture
def told(caplog):
    caplog.set_level(logging.INFO, "landlab_debrisflow")
    return caplog


# ---- states ----


@pytest.mark.parametrize("scene", ["sleeps", "two phases flow in"])
def test_a_state_that_is_read_goes_on_like_the_one_written(scene):
    simulation, terrain = begun(scene, 4.0 if scene == "sleeps" else 2.5, particles=SOME)
    p = simulation.particles
    assert 0 < p.awake < p.count if scene == "sleeps" else simulation.inflow.prescribed(p).size
    other, ground = build(scene, particles=SOME), terrain.copy()
    other.state = other.state.from_dataset(simulation.state.to_dataset())
    for each, on in ((simulation, terrain), (other, ground)):
        call(each, on, 0.5, changed=True)
    assert_same(other.state, simulation.state)
    assert simulation.diagnostics.steps > 2


# ---- calls that do not come to their end ----


class Fails:
    """Raise in the look after some time [s], once."""

    interval = 0.1

    def __init__(self, after, action):
        self.after, self.action = after, action

    def observe(self, flow):
        if self.action and flow.elapsed_time > self.after:
            action, self.action = self.action, None
            action()


def fail():
    raise OSError("no room")


def press():
    signal.raise_signal(signal.SIGINT)


@pytest.mark.parametrize(("action", "error"), [(fail, OSError), (press, KeyboardInterrupt)])
def test_a_call_that_was_interrupted_goes_on_as_if_it_was_not(action, error, told):
    flow = DebrisFlow(slope(), numerics=FEW, observers=Fails(0.2, action))
    with pytest.raises(error) as failure:
        flow.run_one_step(0.6)
    assert 0.2 < flow.elapsed_time < 0.6 and "everything computed until then is kept" in failure.value.__notes__[0]
    flow.run_one_step(0.6 - flow.elapsed_time)
    other = run(0.6)
    xr.testing.assert_allclose(flow.particles, other.particles, rtol=1e-12)
    assert not flow.at_rest and flow.budget["eroded"] == pytest.approx(other.budget["eroded"], rel=1e-12)


@declared
class Breaks(Growth):
    """e_R = E_s h v: that of growth, until it is no number.

    References
    ----------
    An example.
    """

    def entrainment_rate(self, state, out):
        super().entrainment_rate(state, out)
        if state.speed.max() > 1.0:
            raise FloatingPointError("broken")


def test_a_call_that_fails_changes_nothing():
    flow = DebrisFlow(slope(), erosion=Breaks(), numerics=FEW)
    flow.run_one_step(0.1)
    fields, particles, budget = copy_fields(flow.grid), flow.particles, flow.budget
    with pytest.raises((FloatingPointError, SimulationError)):
        flow.run_one_step(5.0)
    assert not changed_fields(flow.grid, fields) and flow.budget == budget
    xr.testing.assert_identical(flow.particles, particles)


# ---- what is told ----


def test_what_leaves_and_what_still_moves_is_told(told):
    grid = inclined((9, 11), SPACING, 1.5, soil=1.0)
    release_slab(grid, (30.0, 20.0), 6.0, 1.0, on_top=True)
    flow = DebrisFlow(grid, erosion="none", column="none", numerics=FEW)
    assert flow.run_until_rest(2.8) is False
    assert "over the east edge left the grid" in told.text and "not at rest after 2.8 s" in told.text
    assert flow.outflow_by_edge["east"] == pytest.approx(flow.budget["outflow"]) and flow.budget["outflow"] > 0.0
    phases = flow.budget_by_phase
    for name, volume in flow.budget.items():
        assert phases["solid"][name] + phases["water"][name] == pytest.approx(volume, abs=1e-9)
    for action in (flow.settle, flow.new_event):
        with pytest.raises(InputError, match="run_until_rest"):
            action()


def test_a_component_in_words_and_its_end(told):
    grid = inclined(SHAPE, SPACING, 0.5, soil=1.0, foot=60.0)
    release_slab(grid, (30.0, 20.0), 6.0, 1.0, on_top=True)
    stream = io.StringIO()
    progress = Progress(0.5, "slope [a]", Console(file=stream, force_terminal=True, width=120))
    flow = DebrisFlow(grid, erosion="none", column="none", numerics={"particle_count": 12}, observers=[progress])
    assert "nothing released yet at 0 s" in repr(flow) and "erosion none" in repr(flow)
    flow.run_one_step(0.3)
    assert repr(flow).startswith("DebrisFlow: moving at 0.3 s") and "<td" in flow._repr_html_()
    before = flow.maps
    assert flow.run_until_rest(30.0) and "DebrisFlow: at rest" in repr(flow)
    assert stream.getvalue().rstrip().split("\r")[-1].startswith("slope [a]: ") and "at rest" in stream.getvalue()
    found = measures(flow, before)
    assert float(found.budget_deposited) == pytest.approx(flow.budget["released"]) and found.deposit_volume > 0.0
    following = DebrisFlow(grid, column="none", numerics=FEW, continues=flow)
    assert following.budget == pytest.approx(flow.budget) and following.elapsed_time == flow.elapsed_time
    assert following.maps.debris_flow__max_depth.max() > 0.0
    following.new_event()
    assert following.maps.debris_flow__max_depth.max() == 0.0


def test_two_components_keep_their_own_outputs(told):
    grid = slope()
    one = DebrisFlow(grid, column="none", numerics=FEW)
    one.run_one_step(0.3)
    depths = one.maps.debris_flow__max_depth
    other = DebrisFlow(grid, column="none", numerics=FEW)
    assert "another DebrisFlow on this grid carries" in told.text
    assert grid.at_node["debris_flow__max_depth"].max() == 0.0 == float(other.maps.debris_flow__max_depth.max())
    xr.testing.assert_identical(one.maps.debris_flow__max_depth, depths)


# ---- observers ----


def test_snapshots_and_series_are_what_was_seen(tmp_path):
    snapshots = Snapshots(0.1, tmp_path / "maps.nc", ["debris_flow__depth"])
    series = Series([0.0, 0.15], lambda flow: {"eroded": flow.budget["eroded"], "x": [flow.elapsed_time, 1.0]})
    for empty in (lambda: snapshots.dataset, Snapshots(1.0).write):
        with pytest.raises(InputError):
            empty()
    flow = run(0.3, observers=[snapshots, series])
    assert flow.budget["eroded"] > float(series.dataset.eroded[1]) > 0.0 == float(series.dataset.eroded[0])
    assert series.dataset.x[1].values == pytest.approx([0.15, 1.0])
    with xr.open_dataset(snapshots.write()) as read:
        assert list(read.data_vars) == ["debris_flow__depth"] and read.sizes["time"] >= 2
    with pytest.raises(InputError, match="no field 'debris_flow__deph'"):
        run(0.3, observers=Snapshots(0.1, variables=["debris_flow__deph"]))
    shapes = iter(range(100))
    with pytest.raises(InputError, match="the same names and shapes"):
        run(0.3, observers=Series([0.1], lambda flow: {"x": np.zeros(next(shapes))}))
    for wrong in (lambda: Series([1.0, 0.0], len), lambda: Series([0.0], 3), lambda: Snapshots(0.0)):
        with pytest.raises(InputError):
            wrong()
    for path in (tmp_path / "missing" / "maps.nc", tmp_path):
        with pytest.raises(InputError):
            Snapshots(1.0, path)


# ---- what is refused and doubted ----


def change(name, value, where=slice(100, 103)):
    """Return a function that puts a value into a field of a grid."""

    def into(grid):
        grid.at_node[name][where] = value

    return into


@pytest.mark.parametrize(
    ("keywords", "words"),
    [
        ({"inflow": SURGE | {"line_start": (-500.0, 14.0)}}, "line"),
        ({"friction": {"law": "coulomb", "basal_friction_angle": "some__angle"}}, "some__angle"),
        ({"erosion": {"law": "growth", "growth_rate": np.ones(7)}}, "growth_rate"),
    ],
)
def test_what_does_not_fit_the_grid_is_refused(keywords, words):
    with pytest.raises(ValueError, match=words):
        DebrisFlow(slope(), numerics=FEW, **keywords).run_one_step(0.1)


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (change(Z, np.nan), "topographic__elevation must"),
        (change(Z, -9999.0), "set_nodata_nodes_to_closed"),
        (change(SOIL, -1.0), "soil__depth must"),
        (change(SOIL, -9999.0), "soil__depth"),
        (change(RELEASE, np.inf), "debris_flow__release_depth must"),
        (change(Z, 20000.0), "topographic__elevation"),
        (change(RELEASE, 1.0, slice(0, 3)), "debris_flow__release_depth"),
    ],
)
def test_what_cannot_be_is_refused_and_nothing_changed(spoil, words):
    flow = DebrisFlow(grid := slope(), numerics=FEW)
    spoil(grid)
    fields = copy_fields(grid)
    with pytest.raises(InputError, match=words):
        flow.run_one_step(0.1)
    assert not changed_fields(grid, fields) and flow.elapsed_time == 0.0


@pytest.mark.parametrize(
    ("keywords", "words"),
    [
        ({"observers": 3}, "observe"),
        ({"continues": 3}, "continues must be"),
        ({"inflow": SURGE | {"times": [1.0, 0.0]}}, "times"),
        ({"friction": {"law": "coulomb", "cohesion": -1.0}}, "cohesion must lie in"),
    ],
)
def test_keywords_that_are_refused_leave_no_field(keywords, words):
    grid = slope()
    fields = set(grid.at_node)
    with pytest.raises(ValueError, match=words):
        DebrisFlow(grid, numerics=FEW, **keywords)
    assert set(grid.at_node) == fields


def other_name(grid):
    grid.add_full("soil_depth", 1.0, at="node")
    grid.at_node.pop(SOIL)


def deep(grid):
    grid.at_node[SOIL][102] = grid.at_node[RELEASE][102] = 40.0


@pytest.mark.parametrize(
    ("alter", "keywords", "words"),
    [
        (other_name, {}, "was it meant"),
        (deep, {}, "deeper than it is wide"),
        (None, {"erosion": {"law": "growth", "growth_rate": 3.0}}, "per metre of path"),
        (None, {"material": {"water_density": 1.0}}, "g/cm3"),
        (None, {"friction": {"law": "coulomb", "basal_friction_angle": 0.54}}, "deg"),
        (None, {"material": {"coefficient_of_consolidation": 12.0}}, "per year"),
        (change(Z, 0.0, slice(0, 0)), {}, ""),
    ],
)
def test_what_is_hardly_meant_is_said(alter, keywords, words, told):
    grid = slope()
    if alter:
        alter(grid)
    DebrisFlow(grid, numerics=FEW, **keywords).run_one_step(1e-6)
    warnings = [record.getMessage() for record in told.records if record.levelno == logging.WARNING]
    assert any(words in message for message in warnings) if words else warnings == []
