"""What cannot be computed is refused in clear words, and nothing is changed."""

import logging
import math

import numpy as np
import pytest
from landlab import FieldError, HexModelGrid, RasterModelGrid

from landlab_debrisflow import DebrisFlow, InputError, ParameterError, SimulationError
from landlab_debrisflow.core.parameters import on_nodes
from landlab_debrisflow.physics.friction import Coulomb
from validation.grids import COARSE, changed_fields, copy_fields, place

from ..twins import Failed, failing

Z, SOIL, RELEASE = "topographic__elevation", "soil__depth", "debris_flow__release_depth"
INSIDE, EDGE = 10 * 60 + 20, 60  # a core node; a boundary node
RELEASING = 10 * 60 + 6


def refused(grid, flow, error=InputError, call=None):
    """Return the message of the refusal, having checked that it left the grid alone."""
    before, particles, budget = copy_fields(grid), flow.particles, flow.budget
    with pytest.raises(error) as refusal:
        (call or (lambda: flow.run_one_step(1.0)))()
    assert not changed_fields(grid, before)
    assert flow.particles.identical(particles) and flow.budget == budget
    return str(refusal.value)


@pytest.fixture(params=["before the release", "while it moves"])
def flow(slope, request):
    """A flow that has yet to start, or is under way."""
    flow = DebrisFlow(slope, numerics=COARSE)
    return place(flow) if request.param == "while it moves" else flow


@pytest.mark.parametrize("grid", [HexModelGrid((5, 5)), None, np.zeros((5, 5))], ids=["hexagons", "None", "array"])
def test_only_rasters(grid):
    with pytest.raises(ValueError, match="RasterModelGrid"):
        DebrisFlow(grid)


@pytest.mark.slow
def test_elevation_is_needed():
    with pytest.raises(FieldError, match=Z):
        DebrisFlow(RasterModelGrid((5, 5)))


@pytest.mark.slow
@pytest.mark.parametrize("node", [INSIDE, EDGE])
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("name", [Z, SOIL])
def test_values_that_are_no_numbers(slope, flow, name, value, node):
    slope.at_node[name][node] = value
    message = refused(slope, flow)
    assert message.startswith(f"{name} must be finite") and f"node {node} " in message and "close the node" in message
    slope.status_at_node[node] = slope.BC_NODE_IS_CLOSED
    flow.run_one_step(0.1)  # at a closed node it is nobody's business


@pytest.mark.slow
def test_open_nodata_says_how_to_close_it(slope, flow):
    slope.at_node[Z][[INSIDE, INSIDE + 1]] = -9999.0
    message = refused(slope, flow)
    assert "NODATA (-9999) at 2 nodes" in message and f"node {INSIDE} (row 10, column 20)" in message
    assert "grid.set_nodata_nodes_to_closed(grid.at_node['topographic__elevation'], -9999)" in message
    slope.set_nodata_nodes_to_closed(slope.at_node[Z], -9999)  # the remedy works as printed
    flow.run_one_step(0.1)


def test_soil_below_nothing(slope, flow):
    slope.at_node[SOIL][INSIDE] = -1e-9
    message = refused(slope, flow)
    assert "soil__depth must lie in [0, inf] m" in message and "-1e-09" in message and f"node {INSIDE} " in message


@pytest.mark.parametrize("value", [-0.1, 1.1, np.nan])
def test_a_ratio_of_the_bed_outside_0_to_1(slope, flow, value):
    ratio = slope.add_full("bed__excess_pore_pressure_ratio", 0.5, at="node")
    ratio[INSIDE] = value
    message = refused(slope, flow)
    assert "bed__excess_pore_pressure_ratio must lie in [0, 1]" in message and f"node {INSIDE} " in message


@pytest.mark.parametrize("name", [Z, SOIL, RELEASE, "bed__degree_of_saturation"])
def test_several_values_per_node(slope, name):
    """Landlab takes fields of layers or components, too."""
    values = slope.at_node[name] if name in slope.at_node else np.ones(slope.number_of_nodes)
    if name in slope.at_node:
        slope.delete_field("node", name)
    slope.add_field(name, np.stack([values, values], axis=1), at="node")
    with pytest.raises(InputError, match=rf"{name} must have one value per node, the shape \(1200,\), got \(1200, 2\)"):
        DebrisFlow(slope, numerics=COARSE).run_one_step(1.0)


@pytest.mark.parametrize("value", [-0.1, 1.1, np.nan, -9999.0])
def test_a_degree_of_saturation_of_the_bed_outside_0_to_1(slope, flow, value):
    slope.add_full("bed__degree_of_saturation", 0.5, at="node")[INSIDE] = value
    message = refused(slope, flow)
    assert "bed__degree_of_saturation must lie in [0, 1]" in message and f"node {INSIDE} " in message


@pytest.mark.slow
@pytest.mark.parametrize(
    ("node", "value", "words"),
    [
        (INSIDE, -0.5, "must be >= 0 m, got -0.5"),
        (INSIDE, np.nan, "must be finite, got nan"),
        (INSIDE, np.inf, "must be finite, got inf"),
        (EDGE, 0.5, "boundary or closed node"),
        (EDGE, -0.5, "must be >= 0 m"),
        (INSIDE, 1.5, "raise soil__depth there, or clip the release with np.minimum"),
    ],
)
def test_releases_that_cannot_be(slope, flow, node, value, words):
    slope.at_node[RELEASE][node] = value
    message = refused(slope, flow)
    assert RELEASE in message and words in message and f"node {node} " in message


def test_a_release_on_closed_nodes(slope, flow):
    slope.at_node[RELEASE][INSIDE] = 0.5
    slope.status_at_node[INSIDE] = slope.BC_NODE_IS_CLOSED
    assert "boundary or closed node" in refused(slope, flow)


def test_a_mass_wasting_id_on_the_boundary(slope, flow):
    slope.at_node[RELEASE][:] = 0.0
    slope.add_zeros("mass__wasting_id", at="node", dtype=int)[EDGE] = 3
    assert "mass__wasting_id" in refused(slope, flow)


@pytest.mark.parametrize(("status", "word"), [(2, "fixed-gradient"), (3, "looped")])
def test_boundaries_that_mean_nothing(slope, flow, status, word):
    slope.status_at_node[EDGE] = status
    message = refused(slope, flow)
    assert f"1 {word} boundary nodes" in message and f"node {EDGE} " in message
    before = copy_fields(slope)
    with pytest.raises(ValueError, match=word):  # and at once when it is built
        DebrisFlow(slope)
    assert not changed_fields(slope, before)


@pytest.mark.slow
@pytest.mark.parametrize("dt", [-1.0, -1e-300, math.nan, math.inf, "1", True, None, [1.0], 1j])
def test_times_that_are_none(slope, flow, dt):
    assert "dt must be" in refused(slope, flow, call=lambda: flow.run_one_step(dt))
    assert "max_duration must be" in refused(slope, flow, call=lambda: flow.run_until_rest(dt))


@pytest.mark.parametrize(
    ("keywords", "words"),
    [
        ({"friction": "ice"}, ("friction: unknown law 'ice'", "coulomb", "voellmy")),
        ({"friction": {"law": "coulomb", "mu": 1}}, ("unknown key 'mu'", "basal_friction_angle [deg]")),
        ({"friction": {"law": "coulomb", "basal_friction_angle": 90.0}}, ("Coulomb", "[0, 89] deg", "90.0")),
        ({"erosion": {"law": "growth", "growth_rate": -1.0}}, ("growth_rate must lie in [0, inf] m-1, got -1.0",)),
        ({"material": {"porosity": 1.5}}, ("Material: porosity", "1.5")),
        ({"material": "sand"}, ("material must be a Material or a mapping", "'sand'")),
        ({"numerics": {"particles": 10}}, ("unknown key 'particles'", "particle_count [-]")),
        ({"numerics": {"particle_count": 10, "particle_spacing": 1.0}}, ("not both",)),
    ],
)
def test_parameters_that_are_none(slope, keywords, words):
    before = copy_fields(slope)
    with pytest.raises(ParameterError) as refusal:
        DebrisFlow(slope, **keywords)
    assert all(word in str(refusal.value) for word in words)
    assert not changed_fields(slope, before)


@pytest.mark.parametrize("observer", [object(), print, type("Deaf", (), {"interval": 0.0, "observe": print})()])
def test_observers_that_are_none(slope, observer):
    before = copy_fields(slope)
    with pytest.raises(InputError, match="an observer needs interval"):
        DebrisFlow(slope, observers=[observer])
    assert not changed_fields(slope, before)


def test_nothing_to_release_is_said_once(slope, caplog):
    slope.at_node[RELEASE][:] = 0.0
    flow = DebrisFlow(slope)
    before = copy_fields(slope)
    with caplog.at_level(logging.INFO, "landlab_debrisflow"):
        for _ in range(3):
            flow.run_one_step(1.0)
        assert flow.run_until_rest() is True
    assert not changed_fields(slope, before) and flow.elapsed_time == 3.0
    assert len(caplog.records) == 1 and "nothing to do" in caplog.records[0].getMessage()


class Poison:
    """Coulomb friction, which gives NaN as one of its two numbers for fast particles."""

    def __init__(self, poisoned):
        self.poisoned, self.sound = poisoned, Coulomb()

    def basal_resistance(self, state, yield_stress, drag):
        state = state._replace(parameters=on_nodes(self.sound, {}))
        self.sound.basal_resistance(state, yield_stress, drag)
        {"yield_stress": yield_stress, "drag": drag}[self.poisoned][state.speed > 5.0] = np.nan


@pytest.mark.slow
@pytest.mark.parametrize("poisoned", ["yield_stress", "drag"])
def test_a_state_that_is_no_number_any_more(slope, poisoned):
    flow = DebrisFlow(slope, friction=Poison(poisoned), numerics=COARSE)
    flow.run_one_step(0.5)
    before, particles, budget = copy_fields(slope), flow.particles, flow.budget
    with pytest.raises(SimulationError) as failure:
        flow.run_until_rest()
    error = failure.value
    assert error.variable == "velocity" and 0 <= error.particle < 100 and 0.5 < error.time < 10.0
    assert "velocity of particle" in str(error) and "grid is as it was before the call" in str(error)
    assert not changed_fields(slope, before)
    assert flow.particles.identical(particles) and flow.budget == budget and flow.elapsed_time == 0.5
    flow.run_one_step(0.1)  # what did not fail can go on


@pytest.mark.slow
@pytest.mark.parametrize("start", [0.0, 2.5])
def test_a_step_that_raises(slope, start):
    flow = DebrisFlow(slope, numerics=COARSE)
    flow.run_one_step(start)
    with failing(7):
        refused(slope, flow, error=Failed, call=flow.run_until_rest)
    assert flow.elapsed_time == start
    assert flow.run_until_rest() is True
