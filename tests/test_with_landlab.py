"""Beside other components, under the BMI wrapper, and watched by observers."""

from dataclasses import dataclass, field

import numpy as np
import pytest
from landlab import RasterModelGrid
from landlab.bmi import wrap_as_bmi
from landlab.components import DepthDependentDiffuser, FlowAccumulator, SpaceLargeScaleEroder

from landlab_debrisflow import DebrisFlow, InputError
from landlab_debrisflow.record.observers import EVERY_STEP
from validation.grids import COARSE, release_slab

Z, SOIL, ROCK = "topographic__elevation", "soil__depth", "bedrock__elevation"


@dataclass
class Watch:
    """Writes down when it was called and what it saw (and, as a plain dataclass, cannot be hashed)."""

    interval: float
    times: list = field(default_factory=list)
    moving: list = field(default_factory=list)

    def observe(self, flow):
        self.times.append(flow.elapsed_time)
        self.moving.append(float(flow.grid.at_node["debris_flow__depth"].sum()) * 25.0)


@pytest.mark.slow
def test_observers_are_called_after_the_steps_that_cross_their_interval_and_at_rest(valley):
    often, seldom, always = Watch(1.0), Watch(2.5), Watch(EVERY_STEP)
    flow = DebrisFlow(valley, numerics=COARSE, observers=[often, seldom, always])
    flow.run_one_step(4.2)
    assert np.floor(often.times).tolist() == [1.0, 2.0, 3.0, 4.0] and len(seldom.times) == 1
    flow.run_one_step(0.8)  # calls do not shift the rhythm
    assert often.times[4:] == [5.0] and seldom.times[1:] == [5.0]
    flow.run_until_rest()
    end = flow.elapsed_time
    assert np.floor(often.times[5:-1]).tolist() == list(np.arange(6.0, end))
    assert often.times[-1] == seldom.times[-1] == end
    assert all(volume > 225.0 for volume in often.moving)  # they see the grid as it is then
    steps = np.unique(always.times)
    assert always.times[0] == 0.0 and steps.size == flow.diagnostics.steps + 1
    for watch in (often, seldom):  # a look is at the end of the first step beyond
        crossed = watch.interval * np.arange(1, int(end / watch.interval) + 1)
        assert watch.times[:-1] == steps[np.searchsorted(steps, crossed)].tolist()


def test_observers_are_left_in_peace_when_nothing_happens(valley):
    watch = Watch(1.0)
    flow = DebrisFlow(valley, numerics=COARSE, observers=[watch])
    flow.run_one_step(1e9)  # the event takes half a minute of it
    assert 20 < len(watch.times) < 60
    watch.times.clear()
    flow.run_one_step(1e9)
    assert flow.run_until_rest() is True and watch.times == []


@pytest.mark.slow
def test_a_call_is_the_same_whether_watched_at_its_end_or_not(valley):
    release, z, soil = (valley.at_node[name].copy() for name in ("debris_flow__release_depth", Z, SOIL))
    particles = []
    for observers in ((), [Watch(5.0)]):
        for name, values in (("debris_flow__release_depth", release), (Z, z), (SOIL, soil)):
            valley.at_node[name][:] = values
        flow = DebrisFlow(valley, numerics=COARSE, observers=observers)
        flow.run_one_step(5.0)
        particles.append(flow.particles)
    assert particles[0].identical(particles[1])


@pytest.mark.slow
def test_bedrock_and_soil_stay_together_beside_other_components(valley):
    grid = valley
    release = grid.at_node["debris_flow__release_depth"].copy()
    grid.at_node[Z][:] += np.random.default_rng(1).uniform(0.0, 0.01, grid.number_of_nodes)  # rivers need outlets
    grid.add_field(ROCK, grid.at_node[Z] - grid.at_node[SOIL], at="node")
    accumulator = FlowAccumulator(grid, flow_director="FlowDirectorD8")
    rivers = SpaceLargeScaleEroder(grid, K_sed=1e-4, K_br=1e-5)
    grid.add_zeros("soil_production__rate", at="node")
    creep = DepthDependentDiffuser(grid, soil_transport_velocity=0.01)
    flow = DebrisFlow(grid, numerics=COARSE)
    core = grid.core_nodes
    for _ in range(2):
        grid.at_node["debris_flow__release_depth"][:] = np.minimum(0.4 * release, grid.at_node[SOIL])
        before, rock = grid.at_node[Z].copy(), grid.at_node[ROCK].copy()
        assert flow.run_until_rest() is True
        np.testing.assert_array_equal(grid.at_node[ROCK], rock)
        assert abs(grid.at_node[Z] - before).max() > 0.1
        together(grid, core)
        settled = grid.at_node[Z].copy()
        accumulator.run_one_step()
        rivers.run_one_step(1.0)
        creep.run_one_step(1.0)
        together(grid, core)
        # they work on from what the flow left, and do not take it back
        change = abs(grid.at_node[Z] - settled)[core]
        assert change.max() > 0.0 and change.mean() < 0.1 * abs(settled - before)[core].mean()


def together(grid, nodes):
    # elevations of 75 m, changed some hundred times: round-off of 1e-14 each
    gap = grid.at_node[Z] - grid.at_node[ROCK] - grid.at_node[SOIL]
    assert abs(gap[nodes]).max() < 1e-12
    assert grid.at_node[SOIL].min() >= 0.0


CONFIG = """
debris_flow:
    friction: {law: voellmy, basal_friction_angle: 25.0, turbulent_coefficient: 400}
    erosion: {law: growth, growth_rate: 0.004}
    column: ale
    material: {porosity: 0.35}
    numerics: {particle_count: 60, settle: true}
clock: {start: 0.0, stop: 100.0, step: 2.0}
grid:
    RasterModelGrid:
    - [20, 40]
    - xy_spacing: [5.0, 5.0]
    - fields:
        node:
          topographic__elevation:
            plane:
              - {point: [0.0, 0.0, 100.0], normal: [0.5, 0.0, 1.0]}
          soil__depth:
            constant:
              - value: 1.0
          debris_flow__release_depth:
            constant:
              - value: 0.0
"""


@pytest.fixture
def bmi():
    model = wrap_as_bmi(DebrisFlow)()
    model.initialize(CONFIG)
    release_slab(model._base.grid, (30.0, 48.0), 8.0, 1.0)
    return model


@pytest.mark.slow
def test_a_model_from_yaml_text(bmi):
    assert bmi.get_component_name() == "DebrisFlow"
    assert "topographic__elevation" in bmi.get_input_var_names()
    assert "debris_flow__deposit_depth" in bmi.get_output_var_names()
    assert bmi.get_var_units("debris_flow__speed") == "m/s"
    for expected in (2.0, 4.0):
        bmi.update()
        assert bmi.get_current_time() == expected == bmi._base.elapsed_time
    depth = bmi.get_value("debris_flow__depth", np.empty(800))
    assert depth.sum() * 25.0 == pytest.approx(bmi._base.budget["moving"], rel=1e-13)  # round-off
    assert bmi._base.budget["released"] == 225.0
    physics = bmi._base.setup
    assert physics.friction.turbulent_coefficient == 400.0 and physics.material.porosity == 0.35


@pytest.mark.slow
def test_update_until_ends_where_it_should(bmi):
    bmi.update_until(5.0)
    assert bmi.get_current_time() == bmi._base.elapsed_time == 5.0
    bmi.update_until(9.0)  # whole steps: ends with a step of no time
    assert bmi.get_current_time() == bmi._base.elapsed_time == 9.0


@pytest.mark.slow
def test_release_and_soil_set_through_bmi_are_those_of_the_next_step(bmi):
    bmi.update_until(90.0)
    released = bmi._base.budget["released"]
    soil, failing = np.full(800, 0.25), np.zeros(800)
    failing[10 * 40 + 8] = 0.2
    bmi.set_value("soil__depth", soil)
    bmi.set_value("debris_flow__release_depth", failing)
    assert bmi.get_value("debris_flow__release_depth", np.empty(800)).tolist() == failing.tolist()
    bmi.update()
    assert bmi._base.budget["released"] == pytest.approx(released + 0.2 * 25.0, rel=1e-14)
    assert not bmi.get_value("debris_flow__release_depth", np.empty(800)).any()
    assert 0.0 < bmi.get_value(SOIL, np.empty(800))[10 * 40 + 8] <= 0.05  # what failed is gone, and it erodes
    bmi.set_value("debris_flow__release_depth", 2.0 * failing)
    with pytest.raises(InputError, match=r"deeper than soil__depth .* node 408"):
        bmi.update()


@pytest.mark.slow
def test_every_input_can_be_set_through_bmi():
    def described(name):
        kind = "int" if name == "mass__wasting_id" else "float"
        return f"          {name}: {{constant: [{{value: 0, dtype: {kind}}}]}}\n"

    given = ("mass__wasting_id", "bed__excess_pore_pressure_ratio", "bed__drained", "bed__degree_of_saturation")
    model = wrap_as_bmi(DebrisFlow)()
    model.initialize(CONFIG + "".join(map(described, given)))
    ids, ratio = np.zeros(800, int), np.full(800, 0.25)
    ids[10 * 40 + 8] = 7
    for name, values in zip(given, (ids, ratio, np.ones(800), ratio), strict=True):
        assert name in model.get_input_var_names()
        model.set_value(name, values)
        assert model.get_value(name, values.copy()).tolist() == values.tolist()
    model.update()
    assert model._base.budget["released"] == 25.0  # all the soil of one node
    bed = model._base._simulation.bed
    assert bed.pressure_ratio.tolist() == ratio.tolist() and bed.drained.all()


def test_the_load_of_a_bed_can_be_set_through_bmi():
    model = wrap_as_bmi(DebrisFlow)()
    model.initialize(CONFIG.replace("{porosity: 0.35}", "{bed_loading_coefficient: 0.5}"))
    model.set_value("bed__excess_pore_pressure", np.full(800, 500.0))
    assert model.get_value("bed__excess_pore_pressure", np.empty(800)).tolist() == [500.0] * 800


def climbing():
    """Return a flow that slides down to x = 100 m and up again."""
    grid = RasterModelGrid((20, 60), xy_spacing=5.0)
    grid.add_field(Z, 0.4 * abs(grid.x_of_node - 100.0), at="node")
    release_slab(grid, (30.0, 48.0), 8.0, 1.0)
    friction = {"law": "coulomb", "basal_friction_angle": 5.0}
    return DebrisFlow(grid, friction=friction, erosion="none", numerics=COARSE)


@pytest.mark.slow
@pytest.mark.parametrize("rate", [5.0, -5.0], ids=["uplift", "subsidence"])
def test_what_moves_all_ground_is_no_run_up(rate):
    highest = []
    for shift in (1e-9, rate):  # in the reference the ground moves too, by nothing: then all sums are done anew
        flow = climbing()
        for _ in range(5):
            flow.run_one_step(2.0)
            flow.grid.at_node[Z] += shift
        highest.append(flow.grid.at_node["debris_flow__max_run_up"].copy())
    assert highest[0].max() > 15.0
    assert abs(highest[1] - highest[0]).max() < 1e-6  # rounding of elevations, 1e-14, grown in 10 s


MOVES = {
    "tilted up": lambda x: 0.02 * x,
    "tilted down": lambda x: -0.02 * x,
    "raised where it has climbed": lambda x: 3.0 * (x > 120.0),
    "lowered where it has climbed": lambda x: -3.0 * (x > 120.0),
    "lowered where it was lowest": lambda x: -3.0 * (abs(x - 100.0) < 15.0),
}


@pytest.mark.slow
@pytest.mark.parametrize("move", MOVES.values(), ids=MOVES)
def test_ground_that_others_move_is_neither_rise_nor_fall(move):
    flow = climbing()
    flow.run_one_step(8.0)
    p, highest = flow._simulation.particles, flow.grid.at_node["debris_flow__max_run_up"]
    order, peak = np.argsort(p.identity), highest.copy()
    before = (p.z - p.lowest_z)[order]
    assert before.max() > 10.0
    for _ in range(3):
        flow.grid.at_node[Z] += move(flow.grid.x_of_node)
        flow.run_one_step(1e-6)
        assert (p.z - p.lowest_z)[np.argsort(p.identity)] == pytest.approx(before, abs=1e-3)  # at 1e-6 s x 15 m/s
    assert (highest - peak).max() < 0.5  # of the depth, whose sums are done anew
