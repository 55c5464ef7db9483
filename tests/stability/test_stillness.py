"""Still water stays, friction stops and does not reverse, what rests stays (docs/theory.md#failures)."""

import math

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow
from validation.cases import stability as scenes
from validation.grids import dry_block, inclined, place, release_cap, throw
from validation.watch import G, Scene

from .checks import assert_sound

CELERITY = math.sqrt(G * 2.0)  # of the basin, 2 m deep


def root_mean_square_speed(scene, share):
    """Return it at some share of the duration [m/s]."""
    return math.sqrt(2.0 * G * scene.watch.kinetic[int(share * (len(scene.watch.kinetic) - 1))])


@pytest.mark.slow
@pytest.mark.parametrize("amplitude", [0.0, 0.2])
def test_still_water_calms_down(amplitude):
    """Without friction; what moves at first is the difference of a raster's surface to the particles'."""
    scene = Scene(scenes.basin(amplitude), 800.0, count=300).run()
    assert_sound(scene)
    assert len(scene.steps.lengths) > 500
    early, late = root_mean_square_speed(scene, 0.05), root_mean_square_speed(scene, 1.0)
    # measured 6.3e-2 -> 2.1e-3 and 6.5e-2 -> 1.9e-2 m/s, where it stays: what circulates over noise (below) is damped
    # by little more than its own disorder. 6e-3 of the celerity is 2.7e-2 m/s
    assert late < 0.5 * early and late < 6e-3 * CELERITY


@pytest.mark.slow
def test_water_over_a_rough_bed_has_a_residual():
    """The weight g cos(theta) of a slope-normal thickness has no potential: a lake over noise goes on circulating.

    The equations do so (residual g sin^3(theta)); at least it stays bounded, and the smallest friction ends it.
    """
    scene = Scene(scenes.basin(1.0), 100.0, count=300).run()
    assert scene.watch.finite and scene.watch.excess <= 0.0
    bed = scene.flow._simulation.bed.surface.sample(scene.flow.particles.x.values, scene.flow.particles.y.values)
    slope2 = bed[1] ** 2 + bed[2] ** 2
    residual = G * float(np.mean((slope2 / (1.0 + slope2)) ** 1.5))
    # measured .29 m/s rms and a residual of .50 m/s2 in the mean: less than a second of it
    assert root_mean_square_speed(scene, 1.0) < 0.9 * residual
    calm = Scene(scenes.basin(1.0), 300.0, angle=2.0, count=300, numerics={"rest_energy": 1e-4}).run()
    assert calm.flow.at_rest and not calm.speeds.any()


@pytest.mark.slow
@pytest.mark.parametrize("courant", [0.3, 1.0])
@pytest.mark.parametrize("degrees", [5.0, 15.0])
def test_friction_never_reverses_a_body_thrown_uphill(degrees, courant):
    angle, speed, mu = math.radians(degrees), 10.0, 0.4
    grid = inclined((15, 60), 5.0, math.tan(angle))
    release_cap(grid, (200.0, 35.0), (25.0, 25.0), 2e-3, on_top=True)
    flow = place(DebrisFlow(grid, **dry_block(mu, particle_count=100, rest_energy=0.0, courant_number=courant)))
    throw(flow, speed * np.array([-math.cos(angle), 0.0, math.sin(angle)]))
    stop = speed / (G * (mu * math.cos(angle) + math.sin(angle)))
    start = flow.particles.x.values
    before = start
    for _ in range(60):
        flow.run_one_step(stop / 50.0)
        p = flow.particles
        # the cap is 2 mm thick: its pressure moves parts of it by some 1e-3 of the speed, never down the slope
        assert p.velocity_x.values.max() <= 0.0
        assert (p.x.values <= before).all()
        before = p.x.values
    assert flow.at_rest
    way = float(np.mean(start - before)) / math.cos(angle)
    assert way == pytest.approx(0.5 * speed * stop, rel=2e-3)


@pytest.mark.parametrize("amplitude", [0.0, 1.0])
def test_what_has_come_to_rest_stays_to_the_last_bit(amplitude):
    grid = scenes.noisy_slope(amplitude, slope=0.3)
    scene = Scene(grid, 600.0, angle=25.0, count=300, numerics={"rest_energy": 1e-4})
    assert scene.flow.run_until_rest(600.0)
    before = scene.flow.particles
    scene.flow.run_one_step(1000.0)
    assert scene.flow.at_rest and scene.flow.particles.identical(before.assign_attrs(scene.flow.particles.attrs))


@pytest.mark.slow
def test_a_remnant_above_its_friction_angle_comes_to_rest_too():
    """On 17 degrees with 15 of friction nothing holds; the kinetic energy, a part of its peak on the flat, ends it."""
    grid = inclined((21, 121), 5.0, 0.3, foot=300.0)
    scenes.release_slab(grid, (50.0, 50.0), 13.0, 2.0, on_top=True)
    scene = Scene(grid, 600.0, angle=15.0, count=300, numerics={"rest_energy": 1e-4})
    assert scene.flow.run_until_rest(600.0)
    assert not scene.speeds.any()
