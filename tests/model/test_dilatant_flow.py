"""What a flow tells its columns with dilatancy: load on curved ground, soil, inflow; and what it reads from them."""

from types import SimpleNamespace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from landlab_debrisflow import DebrisFlow, Material
from landlab_debrisflow.laws import ALE, Dilatancy
from landlab_debrisflow.model.basal import shear_per_speed
from landlab_debrisflow.model.phases.one_phase import OnePhaseDynamics
from validation.grids import COARSE, inclined, place, release_cap, throw

TIGHT = {"law": "ale", "dilatancy": {"permeability": 0.0}}


def test_the_rate_of_shear_is_that_of_a_linear_profile_less_the_slip():
    """By hand: 2 (1 - 0.25)/(2 m)."""
    assert shear_per_speed(np.array([2.0]), Material(basal_slip_ratio=0.25)) == pytest.approx(0.75, rel=1e-15)


def test_on_curved_ground_a_flow_loads_its_columns_by_its_speed():
    """Undrained, in a moment, its pressure rises by rho' h v^2/R."""
    radius, speed = 200.0, 10.0
    grid = inclined((21, 41), 2.0, 0.0)
    x = grid.x_of_node - 40.0
    grid.at_node["topographic__elevation"][:] = x**2 / (2.0 * radius)
    release_cap(grid, (40.0, 20.0), (6.0, 6.0), 1.0, on_top=True)
    material = {"initial_pressure_ratio": 0.0}
    flow = place(DebrisFlow(grid, column=TIGHT, erosion="none", material=material, numerics=COARSE | {"settle": False}))
    p = flow.particles
    slope = (p.x.values - 40.0) / radius
    cosine = 1.0 / np.hypot(1.0, slope)
    throw(flow, (speed * cosine, 0.0, speed * cosine * slope))
    flow.run_one_step(1e-6)
    pressure, thickness = flow.particles.basal_excess_pore_pressure.values, flow.particles.thickness.values
    # of the bed between nodes the curvature is right to 1 %
    assert_allclose(pressure, 990.0 * thickness * speed**2 / radius * cosine**3, rtol=0.02)


def test_soil_brings_the_solid_fraction_of_the_bed():
    grid = inclined((20, 60), 5.0, 0.5, soil=1.0)
    release_cap(grid, (30.0, 48.0), (12.0, 12.0), 1.0)
    flow = DebrisFlow(grid, column=TIGHT, erosion="growth", material={"bed_porosity": 0.3}, numerics=COARSE)
    flow.run_one_step(3.0)
    fraction = flow.columns.solid_fraction.values
    assert_allclose(fraction[:, -1], 0.6, rtol=1e-12)
    assert 0.61 < fraction[:, 0].max() <= 0.7


def test_the_coefficient_of_consolidation_has_no_gaps():
    """Kernels would be compiled twice: for the coefficient of a law, and for a part of the memory of columns."""
    column = ALE(dilatancy={"permeability": 1e-10})
    p = SimpleNamespace(column_memory=np.ones((3, column.memory_size)))
    coefficient = OnePhaseDynamics(Material(), column).coefficient_of_consolidation(p, slice(3))
    assert coefficient.shape == (3,) and coefficient.flags.c_contiguous


def test_the_coefficient_of_consolidation_is_that_of_the_base():
    grid = inclined((20, 60), 5.0, 0.5)
    release_cap(grid, (30.0, 48.0), (12.0, 12.0), 1.0, on_top=True)
    flow = DebrisFlow(
        grid, column={"law": "ale", "dilatancy": {"permeability": 1e-10}}, erosion="none", numerics=COARSE
    )
    flow.run_one_step(2.0)
    p, columns = flow.particles, flow.columns
    stress = p.liquefaction_pressure.values - p.basal_excess_pore_pressure.values  # the ground is plane
    expected = Dilatancy(permeability=1e-10).coefficient_of_consolidation(columns.solid_fraction[:, 0].values, stress)
    assert_allclose(p.thickness.values**2 / columns.consolidation_time.values, expected, rtol=1e-6)


def test_debris_that_flows_in_has_the_solid_fraction_of_the_material():
    grid = inclined((20, 60), 5.0, 0.5)
    line = {
        "line_start": (20.0, 38.0),
        "line_end": (20.0, 58.0),
        "times": [0.0, 4.0],
        "discharge": 30.0,
        "velocity": 4.0,
    }
    flow = DebrisFlow(grid, inflow=line, column=TIGHT, erosion="none", material={"porosity": 0.45}, numerics=COARSE)
    flow.run_one_step(2.0)
    assert flow.particles.sizes["particle"] > 20
    assert_allclose(flow.columns.solid_fraction, 0.55, rtol=1e-12)
