"""How long a step may be: the pace of starts and stops, viscosity, and what the survey finds."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from landlab_debrisflow.model.step_control import FASTER, FIRST, SLOWEST, TO_STOP, StepControl
from landlab_debrisflow.model.step_rule import GROWTH, StepRule, viscous_share
from landlab_debrisflow.model.time_step import reduce_particles

G, COURANT, WAY = 9.81, 0.6, 2.5


def paced(energies, stable=1.0, restart=False):
    control = StepControl()
    if restart:
        control.restart()
    return [control.longest(stable, energy) for energy in energies]


def test_after_a_release_steps_grow_from_a_small_one_to_what_is_stable():
    steps = paced(np.arange(1.0, 20.0), restart=True)
    assert steps[0] == FIRST
    ratios = np.diff(np.log(steps)) / math.log(FASTER)
    growing = np.array(steps[1:]) < 1.0
    np.testing.assert_allclose(ratios[growing], 1.0, rtol=1e-12)
    assert growing.sum() > 5 and steps[-1] == 1.0


def test_without_a_release_and_without_slowing_a_step_is_what_is_stable():
    assert paced([1.0, 1.0, 2.0, 4.0], stable=0.3) == [0.3] * 4


def test_a_stop_is_met_in_ever_shorter_steps():
    """At a constant deceleration from speed 1 in 10 s, steps of 1 s at most."""
    control, time, times = StepControl(), 0.0, []
    while time < 10.0 and len(times) < 200:
        step = control.longest(1.0, (1.0 - 0.1 * time) ** 2)
        times.append(step)
        time += step
    # a step takes a quarter of the time that is left, but not less than a sixteenth of what is stable
    left = 10.0 - np.cumsum(times)[1:-1]
    for step, remains in zip(times[2:], left, strict=False):
        assert step <= max(TO_STOP * remains, SLOWEST) * (1.0 + 1e-9)
    assert times[-1] == pytest.approx(SLOWEST) and time - 10.0 < SLOWEST


def test_what_turns_is_not_held_up_for_ever():
    """Once it is faster again steps grow as after a release."""
    steps = paced([1.0, 0.01, 1e-4, 1e-2, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0])
    assert min(steps) == SLOWEST and steps[-1] == 1.0


def test_nothing_that_moves_needs_no_pace():
    assert paced([0.0, 0.0, 0.0], stable=2.0) == [2.0] * 3


def test_viscosity_shortens_steps_as_damped_leapfrog_does():
    """As for the longest steps at which both roots of the amplification of a step are within the unit circle."""
    for viscosity in (1.0, 2.0, 3.0, 6.0, 10.0):
        limit = viscous_share(viscosity) * bound(1.0)
        assert limit == pytest.approx(bound(viscosity), rel=1e-6)
    assert viscous_share(0.0) == viscous_share(0.3) == viscous_share(1.0) == 1.0
    shares = [viscous_share(v) for v in np.linspace(1.0, 10.0, 30)]
    assert np.all(np.diff(shares) < 0.0)


def bound(viscosity):
    """Largest stable x of kick, drift, kick whose damping is taken with the velocity before the kick, by bisection."""
    low, high = 0.0, 2.0
    for _ in range(60):
        x = 0.5 * (low + high)
        a, b = (1.63 * x) ** 2, 1.17 * viscosity * x
        # v' = (1 - b) v - a y / dt ..., y' = y + v': characteristic polynomial z^2 - (2 - a - b) z + (1 - b)
        stable = np.abs(np.roots([1.0, -(2.0 - a - b), 1.0 - b])).max() <= 1.0 + 1e-12
        low, high = (x, high) if stable else (low, x)
    return low


@pytest.fixture
def particles():
    n = 6
    return SimpleNamespace(
        awake=n, velocity=np.zeros((3, n)), thrust=np.zeros((3, n)), thickness=np.full(n, 2.0), thickening=np.zeros(n),
        smoothing_length=np.full(n, 3.0), volume=np.full(n, 7.0), basal_excess_pore_pressure=np.zeros(n),
        entrainment_rate=np.zeros(n), depth=np.full(n, 2.5), own_thickness=np.full(n, 2.0), light=np.zeros(n, bool),
    )  # fmt: skip


def look(particles, computed=None):
    computed = np.ones(6, bool) if computed is None else computed
    particles.summed, particles.cos_slope = computed, np.full(6, 0.8)
    return reduce_particles(particles, G, StepRule(COURANT, WAY, WAY, 0.0))


CELERITY = math.sqrt(G * 0.8 * 2.0)


def test_waves_bound_the_step_where_particles_wait_for_nothing(particles):
    particles.thickness[2], particles.smoothing_length[3] = 8.0, 1.0
    found = look(particles)
    assert found.longest_step == pytest.approx(COURANT * 1.0 / CELERITY)  # the shortest of them
    assert found.fastest == pytest.approx(2.0 * CELERITY) and found.energy == 0.0 and found.broken == -1
    computed = np.ones(6, bool)
    computed[3] = False  # nothing near it moves
    assert look(particles, computed).longest_step == pytest.approx(COURANT * 3.0 / (2.0 * CELERITY))


def test_converging_flow_counts_as_waves_do(particles):
    particles.thickening[4] = 6.0
    assert look(particles).longest_step == pytest.approx(COURANT / (CELERITY / 3.0 + 6.0 / 2.0))
    particles.thickening[4] = -6.0
    assert look(particles).longest_step == pytest.approx(COURANT * 3.0 / CELERITY)


@pytest.mark.parametrize("computed", [True, False])
def test_no_step_crosses_more_than_a_part_of_a_node(particles, computed):
    """At the speed now, and with all that gravity and thrust may add: also what waits."""
    particles.velocity[:, 1], particles.thrust[:, 1] = (30.0, 0.0, -40.0), (3.0, 4.0, 0.0)
    found = look(particles, np.full(6, computed))
    step = found.longest_step
    assert 50.0 * step + 0.5 * (G + 5.0) * step**2 == pytest.approx(WAY)
    assert found.energy == pytest.approx(7.0 * 2500.0) and found.fastest == pytest.approx(50.0 + CELERITY)


def test_no_particle_takes_up_more_than_a_part_of_itself(particles):
    particles.entrainment_rate[5] = 1.0
    assert look(particles).longest_step == pytest.approx(GROWTH * 2.5 / 1.0)


@pytest.mark.parametrize("name", ["velocity", "thrust", "thickness", "basal_excess_pore_pressure"])
@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_it_finds_who_is_broken(particles, name, value):
    getattr(particles, name)[..., 4] = value
    assert look(particles).broken == 4


def test_those_asleep_are_not_looked_at(particles):
    particles.awake, particles.velocity[0, 5], particles.thickness[5] = 5, np.nan, 1e9
    found = look(particles)
    assert found.broken == -1 and found.longest_step == pytest.approx(COURANT * 3.0 / CELERITY)
