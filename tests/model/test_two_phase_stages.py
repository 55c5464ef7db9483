"""Stages of a step of two phases by themselves: the mixture, the pull that two kicks share, who bears on the bed."""

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.model.phases.mixture import DRAINAGE, PoreWater, end_of_grains, pressure_by_porosity, stiffen
from landlab_debrisflow.model.phases.momentum import Motion, pull_along_bed
from landlab_debrisflow.physics.contracts import MIXTURE, WATER

FEW = {"particle_count": 100}
SURGE = {
    "line_start": (20.0, 35.0), "line_end": (20.0, 60.0), "times": [0.0, 8.0], "discharge": 40.0, "velocity": 4.0,
}  # fmt: skip


def test_grains_end_before_the_last_water():
    for phases, end in (([], 0), ([WATER], 0), ([MIXTURE], 1), ([MIXTURE, WATER, MIXTURE, WATER, WATER], 3)):
        assert end_of_grains(np.array(phases, np.int8)) == end


@pytest.mark.slow
@pytest.mark.parametrize("inflow", [None, SURGE])
def test_water_has_neither_column_nor_erosion(slope, inflow):
    """Behind the grains in memory, or between grains that have flowed in later."""
    flow = DebrisFlow(slope, flow="two_phase", inflow=inflow, numerics=FEW)
    flow.run_one_step(4.0)
    sim = flow._simulation
    p = sim.particles
    water, end = p.phase == WATER, sim.phases.bearing(p).stop
    assert (end == (~water).sum()) == (inflow is None) and not (~water[end:]).any()
    for nothing in (p.basal_excess_pore_pressure, p.excess_pore_pressure, p.entrained_volume, p.entrainment_rate):
        assert not nothing[water].any() and nothing[~water].any()
    assert flow.budget["eroded"] > 0.0 and p.mean_excess_pore_pressure[water].any()


@pytest.mark.slow
def test_the_pull_is_that_of_the_present_thrust(slope):
    """The last kick of a step and the first of the next have one pull: nothing between them may change it."""
    flow = DebrisFlow(slope, flow="two_phase", inflow=SURGE, numerics=FEW)
    for _ in range(3):
        flow.run_one_step(1.0)
        sim = flow._simulation
        p = sim.particles
        motion = Motion(p.velocity, p.pull.copy(), p.water_pull.copy(), p.slope_x, p.slope_y, p.cos_slope)
        pull_along_bed(tuple(sim.state.exchange.partners), p.thrust, motion, 9.81)
        assert p.pull.any() and np.array_equal(motion[1], p.pull)
        grains = p.phase != WATER
        assert p.water_pull.any() and np.array_equal(motion[2][:, grains], p.water_pull[:, grains])


def test_pressure_follows_the_strain_of_the_skeleton():
    phase, before, now = np.array([MIXTURE, WATER, MIXTURE], np.int8), np.full(3, 0.4), np.array([0.41, 0.5, 0.4])
    source = pressure_by_porosity(phase, before, now, 1e5, 0.5)
    assert source == pytest.approx([2e5 * np.log(0.6 / 0.59), 0.0, 0.0], rel=1e-13)


@pytest.mark.parametrize("dt", [0.0, 1e-9, 1e-4, 9.9e-4, 1.01e-3, 0.1, 39.0, 41.0, 1e6])
def test_stiffness_counts_as_far_as_drag_and_drainage_let_it(dt):
    """K lightness phi(x) phi(y), phi(x) = (1 - exp(-x))/x; here x and y are dt times about 1, in three forms."""
    n, h, k = 0.4, 2.0, 1e5
    lightness = n / 1000.0 + n * n / (0.6 * 2650.0)
    drag, consolidation = h * n * n / lightness, h * h / DRAINAGE
    water = PoreWater(*(np.array([value]) for value in (WATER, n, h, drag, consolidation)))
    phi = -np.expm1(-dt) / dt if dt > 0.0 else 1.0
    # expm1 has all digits; the series leaves out x^4/120 < 1e-14
    assert stiffen(water, 2650.0, 1000.0, k, dt)[0] == pytest.approx(k * lightness * phi**2, rel=3e-14)
