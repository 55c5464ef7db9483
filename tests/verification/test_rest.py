"""Rest: what friction holds stays for ever, what it brakes stops at the right time and stays (docs/theory.md#rest)."""

import math

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow
from validation.cases import blocks
from validation.grids import centre_of_mass, dry_block, inclined, place, release_cap, release_slab, set_free, throw
from validation.measure import body

G, MU, ANGLE = 9.81, 0.4, math.radians(15.0)
SPEED = 10.0


@pytest.mark.slow
@pytest.mark.parametrize("step", [1e-3, 0.1, 10.0])
def test_a_slab_below_its_friction_angle_stays_for_every_step(step):
    grid = inclined((15, 40), 10.0, math.tan(ANGLE))
    release_slab(grid, (100.0, 70.0), 35.0, 0.1, on_top=True)
    flow = place(DebrisFlow(grid, **dry_block(MU, particle_count=200, rest_energy=0.0)))
    set_free(flow)  # let every step decide anew
    start = flow.particles
    for _ in range(5):
        flow.run_one_step(step)
        set_free(flow)
    # held by max(0, ...), not by a small number: to the last bit
    assert flow.particles.x.identical(start.x) and flow.particles.y.identical(start.y)
    assert not body(flow).velocity.any()


@pytest.fixture
def sliding():
    """A thin cap thrown down a slope on which it must stop; it spreads by 1e-4 of its speed only."""
    grid = inclined((15, 40), 10.0, math.tan(ANGLE))
    release_cap(grid, (100.0, 70.0), (50.0, 50.0), 2e-3, on_top=True)
    flow = place(DebrisFlow(grid, **dry_block(MU, particle_count=300, rest_energy=0.0)))
    throw(flow, SPEED * np.array([math.cos(ANGLE), 0.0, -math.sin(ANGLE)]))
    return flow


def speeds(flow):
    return np.linalg.norm(body(flow).velocity, axis=0)


@pytest.mark.slow
def test_a_sliding_slab_stops_in_time_and_stays(sliding):
    braking = G * (MU * math.cos(ANGLE) - math.sin(ANGLE))
    stop = SPEED / braking
    start, *_ = centre_of_mass(sliding)
    sliding.run_one_step(0.5 * stop)
    # measured 1e-8 in the mean: constant deceleration is integrated exactly; the spread is 1.2e-3 m/s
    assert speeds(sliding).mean() == pytest.approx(0.5 * SPEED, rel=1e-6)
    sliding.run_one_step(0.499 * stop)
    # 1e-3 of the speed is left: 1e-2 m/s, of which the spread, 1.6e-2 m/s at most, is no small part
    assert speeds(sliding).mean() == pytest.approx(1e-3 * SPEED, rel=0.01)  # measured 1e-5
    assert not sliding.at_rest
    sliding.run_one_step(0.003 * stop)
    assert not speeds(sliding).any() and sliding.at_rest
    x, *_ = centre_of_mass(sliding)
    # v0^2/(2 a); measured with the last step, in which the speed falls to zero before its end: 1e-6
    assert (x - start) / math.cos(ANGLE) == pytest.approx(0.5 * SPEED * stop, rel=1e-4)
    sliding.run_one_step(100.0)
    assert centre_of_mass(sliding)[0] == x


def test_a_slab_that_finds_itself_on_gentler_ground_stops():
    found = blocks.stopping_slab(300)
    # measured +.016 and -1.9e-4: steps get shorter as the flow slows down, so a stop is not resolved to a step any more
    assert abs(found.scalars["time error"]) < 0.023 and abs(found.scalars["travel error"]) < 3e-4
    assert found.scalars["speed left [m/s]"] == 0.0 and found.scalars["moved after [m]"] == 0.0
