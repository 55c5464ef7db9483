"""Parameters of laws that vary in space: from a number, an array over the nodes or the name of a field."""

import dataclasses
import math

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.core.errors import InputError, ParameterError
from landlab_debrisflow.model import step
from landlab_debrisflow.model.basal import basal_state
from landlab_debrisflow.physics.friction import Coulomb
from landlab_debrisflow.physics.registry import LAWS
from validation.grids import inclined, place, release, release_slab
from validation.measure import body

SLOPE, G = 0.5, 9.81
FIELD = "coulomb__angle"
LOOSE = {"yield_stress": 100.0, "cohesion": 30.0, "viscosity": 20.0}
"""With which a slab of a metre flows, and which the defaults leave out."""


def run(law, fields=()):
    """Return where a small slab is after 3 s, and how fast."""
    grid = inclined((9, 30), 10.0, SLOPE)
    for name, values in dict(fields).items():
        grid.add_field(name, np.full(grid.number_of_nodes, values), at="node")
    release_slab(grid, (70.0, 40.0), 25.0, 1.0)
    flow = DebrisFlow(
        grid, friction=law, erosion="none", column="none", numerics={"particle_count": 40, "settle": False}
    )
    flow.run_one_step(3.0)
    p = body(flow)
    return np.array([p.x, p.y, *p.velocity])


@pytest.mark.slow
@pytest.mark.parametrize("name", LAWS["friction"])
def test_the_same_everywhere_is_the_same_to_the_bit_however_it_is_given(name):
    law = LAWS["friction"][name]
    values = {
        field.name: LOOSE.get(field.name, field.default)
        for field in dataclasses.fields(law)
        if field.metadata["varies"]
    }
    number = run(law(**values))
    assert np.any(number[2])  # it does move
    nodes = {key: np.full(9 * 30, value) for key, value in values.items()}
    np.testing.assert_array_equal(run(law(**nodes)), number)
    named = {key: f"debris__{key}" for key in values}
    np.testing.assert_array_equal(run({"law": name, **named}, {named[key]: values[key] for key in values}), number)


def halves(number_of_columns=60):
    """Return a plane on which friction is 10 degrees up to column 29 and 20 from there on."""
    grid = inclined((7, number_of_columns), 10.0, SLOPE)
    column = np.arange(grid.number_of_nodes) % number_of_columns
    angle = np.where(column < 30, 10.0, 20.0)
    return grid, angle


def two_bodies(law, fields):
    """Let one particle go on either half, each by itself."""
    grid, _ = halves()
    for name, values in fields.items():
        grid.add_field(name, values, at="node")
    depth = np.zeros(grid.shape)
    depth[3, [5, 40]] = 1.0
    release(grid, depth.ravel(), on_top=True)
    numerics = {"particle_count": 2, "settle": False}
    material = {"water_density": 0.0}
    return place(DebrisFlow(grid, friction=law, erosion="none", column="none", material=material, numerics=numerics))


@pytest.mark.slow
@pytest.mark.parametrize("given", ["field", "array", "list"])
def test_each_body_has_the_friction_of_where_it_is(given):
    _, angle = halves()
    value = {"field": FIELD, "array": angle, "list": angle.tolist()}[given]
    flow = two_bodies({"law": "coulomb", "basal_friction_angle": value}, {FIELD: angle} if given == "field" else {})
    flow.run_one_step(4.0 - flow.elapsed_time)
    theta = math.atan(SLOPE)
    found = np.sort(np.linalg.norm(body(flow).velocity, axis=0))
    exact = [4.0 * G * (math.sin(theta) - math.tan(math.radians(phi)) * math.cos(theta)) for phi in (20.0, 10.0)]
    np.testing.assert_allclose(found, exact, rtol=1e-10)  # rounding bends the plane: measured 1.2e-12


@pytest.mark.slow
def test_it_is_that_of_the_nearest_node():
    _, angle = halves()
    flow = two_bodies(Coulomb(basal_friction_angle=angle), {})
    sim = flow._simulation
    sim.particles.x[:] = [294.999, 295.001]  # half-way between columns 29 and 30
    step.sample_bed(sim.particles, sim.bed, sim.setup.material.gravity)
    here = basal_state(sim.particles, slice(2), sim.surroundings.friction).parameters
    np.testing.assert_allclose(here.basal_friction_angle, np.radians([10.0, 20.0]), rtol=1e-15)


@pytest.mark.slow
def test_a_field_may_change_between_calls():
    _, angle = halves()
    flow = two_bodies(Coulomb(basal_friction_angle=FIELD), {FIELD: angle})
    flow.run_one_step(1.0)
    before = np.linalg.norm(body(flow).velocity, axis=0)
    flow.grid.at_node[FIELD][:] = math.degrees(math.atan(SLOPE))  # balances gravity
    flow.run_one_step(1.0)
    np.testing.assert_allclose(np.linalg.norm(body(flow).velocity, axis=0), before, rtol=1e-12)


def test_a_field_the_grid_does_not_have_is_refused():
    with pytest.raises(
        InputError, match=r"friction: basal_friction_angle is to be read from the field 'coulomb__angle'"
    ):
        two_bodies(Coulomb(basal_friction_angle=FIELD), {})


def test_an_array_of_another_size_is_refused():
    with pytest.raises(
        InputError, match="friction: basal_friction_angle has 7 values, the grid 420 nodes; give one per node"
    ):
        two_bodies(Coulomb(basal_friction_angle=np.full(7, 20.0)), {})


@pytest.mark.slow
@pytest.mark.parametrize("wrong", [90.0, -1.0, math.nan, math.inf])
def test_one_node_out_of_bounds_is_refused_with_its_place(wrong):
    _, angle = halves()
    angle[3 * 60 + 17] = wrong
    with pytest.raises(ParameterError) as refusal:
        two_bodies(Coulomb(basal_friction_angle=FIELD), {FIELD: angle})
    message = str(refusal.value)
    assert message.startswith(
        "friction: basal_friction_angle, from field 'coulomb__angle', must lie in [0, 89] deg, got"
    )
    assert message.endswith(f"got {wrong} at node 197 (row 3, column 17)")
    with pytest.raises(ParameterError) as refusal:
        two_bodies(Coulomb(basal_friction_angle=angle), {})
    assert str(refusal.value) == (
        f"friction: basal_friction_angle must lie in [0, 89] deg, got {wrong} at node 197 (row 3, column 17)"
    )


@pytest.mark.slow
def test_a_field_is_looked_at_again_in_every_call():
    _, angle = halves()
    flow = two_bodies(Coulomb(basal_friction_angle=FIELD), {FIELD: angle})
    flow.grid.at_node[FIELD][100] = math.nan
    with pytest.raises(ParameterError, match=r"got nan at node 100 \(row 1, column 40\)"):
        flow.run_one_step(1.0)


@pytest.mark.slow
@pytest.mark.parametrize("missing", [math.nan, -9999.0, math.inf])
@pytest.mark.parametrize("given", ["field", "array", "masked array"])
def test_closed_nodes_need_no_value(given, missing):
    grid, angle = halves()
    grid.status_at_node[:60] = grid.BC_NODE_IS_CLOSED
    angle[:60] = missing
    grid.add_field(FIELD, angle, at="node")
    masked = np.ma.masked_where(np.arange(angle.size) < 60, angle)
    law = Coulomb(basal_friction_angle={"field": FIELD, "array": angle, "masked array": masked}[given])
    flow = DebrisFlow(grid, friction=law)
    flow.run_one_step(1.0)
    grid.status_at_node[30] = grid.BC_NODE_IS_FIXED_VALUE
    got = math.nan if given == "masked array" else missing
    with pytest.raises(ParameterError, match=rf"must lie in \[0, 89\] deg, got {got} at node 30 \(row 0, column 30\)"):
        flow.run_one_step(1.0)


@pytest.mark.slow
@pytest.mark.parametrize("missing", [math.nan, -9999.0])
def test_closed_nodes_need_no_values_that_agree(missing):
    grid, angle = halves()
    grid.status_at_node[:60] = grid.BC_NODE_IS_CLOSED
    limit = angle + 10.0
    limit[:60] = missing
    friction = {"law": "mu_i", "static_friction_angle": angle, "limiting_friction_angle": limit}
    DebrisFlow(grid, friction=friction).run_one_step(1.0)
