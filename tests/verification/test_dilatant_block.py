"""A body that makes its own pore pressure on a plane, against its ordinary differential equations; its energy."""

import math

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.exact.dilatancy import DilatantDebris, dilatant_block
from validation.grids import inclined, place, release
from validation.measure import body

SLOPE, ANGLE, GRAVITY = math.radians(31.0), 40.7, 9.81
KINDS = {"undrained": (0.0, False, 0.005), "drained": (1e-3, True, 0.005), "viscous": (0.0, False, 50.0)}
"""Permeability [m2], whether water moves freely, viscosity of the pore fluid [Pa s]."""


def block(solid_fraction, permeability, viscosity=0.005):
    """Put one particle on a plane, hydrostatic; its thickness stays because it knows no neighbours."""
    grid = inclined((7, 60), 10.0, math.tan(SLOPE))
    depth = np.zeros(grid.shape)
    depth[3, 3] = 100.0  # of which the particle keeps a 64th
    release(grid, depth.ravel(), on_top=True)
    flow = DebrisFlow(
        grid, friction={"law": "coulomb", "basal_friction_angle": ANGLE}, erosion="none",
        column={"law": "ale", "dilatancy": {"permeability": permeability, "pore_fluid_viscosity": viscosity}},
        material={"porosity": 1.0 - solid_fraction, "initial_pressure_ratio": 0.0},
        numerics={"settle": False, "particle_count": 1, "rest_energy": 0.0},
    )  # fmt: skip
    return place(flow)


def slide(flow, dt, time):
    """Let it slide; return speed [m s-1], effective stress [Pa] and solid fraction at its base."""
    for _ in range(round(time / dt)):
        flow.run_one_step(dt)
    p = flow.particles.isel(particle=0)
    load = float(p.density - 1000.0) * GRAVITY * math.cos(SLOPE) * float(p.thickness)
    speed = np.linalg.norm(body(flow).velocity[:, 0])
    return np.array([speed, load - float(p.basal_excess_pore_pressure), float(flow.columns.solid_fraction[0, 0])])


def exactly(flow, solid_fraction, time, drained, viscosity=0.005):
    thickness, debris = float(body(flow).h[0]), DilatantDebris(pore_fluid_viscosity=viscosity)
    return dilatant_block(time, SLOPE, thickness, solid_fraction, math.radians(ANGLE), drained, debris)


@pytest.mark.slow
@pytest.mark.parametrize(
    "kind, solid_fraction", [("undrained", 0.6), ("undrained", 0.63), ("drained", 0.6), ("viscous", 0.5)]
)
def test_a_block_from_rest(kind, solid_fraction):
    """Speed to 1e-3 with steps of 5 ms; its error and that of the stress are of first order."""
    permeability, drained, viscosity = KINDS[kind]
    errors = []
    for dt in (0.02, 0.005):
        flow = block(solid_fraction, permeability, viscosity)
        exact = np.array(exactly(flow, solid_fraction, 1.0, drained, viscosity))
        errors.append(np.abs(slide(flow, dt, 1.0) / exact - 1.0))
    most = 2e-3 if kind == "viscous" else 1e-3  # drag and dilatancy both change in a step
    assert errors[1][0] < most and errors[1][1] < 1e-2 and errors[1][2] < 1e-3
    wrong = errors[0] > 1e-5  # stress of drained debris and fraction of undrained debris stay
    assert np.count_nonzero(wrong) == 2
    assert np.all(errors[1][wrong] < errors[0][wrong] / 3.0)


@pytest.mark.slow
def test_a_dense_block_starts_and_locks():
    """It dilates, suction presses the grains together, and it stops for good."""
    flow = block(0.66, 0.0)
    velocity, stress, _ = exactly(flow, 0.66, np.array([0.2, 2.0]), False)
    assert velocity[0] > 0.15 and velocity[1] == 0.0
    speed, now, _ = slide(flow, 0.005, 0.2)
    assert abs(speed / velocity[0] - 1.0) < 1e-2 and abs(now / stress[0] - 1.0) < 2e-3
    speed, now, _ = slide(flow, 0.02, 1.8)
    assert speed == 0.0 and abs(now / stress[1] - 1.0) < 1e-2


@pytest.mark.slow
@pytest.mark.parametrize("solid_fraction", [0.6, 0.66])
def test_friction_of_a_dilatant_slide_takes_energy_and_never_gives_any(solid_fraction):
    """Sum the kinetic energy and that of height, of a body whose centre lies h/2 above the plane, over the density."""
    grid = inclined((20, 120), 1.0, math.tan(SLOPE))
    x, y = grid.x_of_node, grid.y_of_node
    release(grid, np.maximum(0.0, 0.5 - ((x - 12.0) ** 2 + (y - 9.5) ** 2) / 50.0), on_top=True)
    flow = DebrisFlow(
        grid, friction={"law": "coulomb", "basal_friction_angle": ANGLE}, erosion="none",
        column={"law": "ale", "dilatancy": {"permeability": 1e-10}},
        material={"porosity": 1.0 - solid_fraction, "initial_pressure_ratio": 0.0},
        numerics={"settle": False, "particle_count": 200},
    )  # fmt: skip
    place(flow)

    def energy():
        p = body(flow)
        height = math.tan(SLOPE) * (x.max() - p.x) + 0.5 * p.h / math.cos(SLOPE)
        return np.sum(p.volume * (0.5 * (p.velocity**2).sum(axis=0) + GRAVITY * height))

    energies = [energy()]
    for _ in range(20):
        flow.run_one_step(0.05)
        energies.append(energy())
    losses = -np.diff(energies)
    assert losses.sum() > 0.0 and np.all(losses > -1e-6 * losses.sum())  # kicks and drifts alternate
    if solid_fraction == 0.66:
        assert not np.any(body(flow).velocity)
