"""Limits of the time step, and further reductions over all particles at its end."""

from typing import NamedTuple

import numpy as np

from ..core.arrays import value_at
from ..core.jit import inner, kernel
from ..core.structs import struct
from .crossing import find_time_across, time_over
from .step_rule import GROWTH, StepRule

NOT_STIFF = np.zeros(1)
"""Nothing but weight drives waves [m2 s-2]."""

NO_FRICTION = np.zeros(1)
"""Yield stress where no friction is known [Pa]."""


class StepLimits(NamedTuple):
    """Limits of the next step, and further reductions over all particles that are awake.

    Attributes
    ----------
    longest_step : float
        Longest step that is stable [s].
    energy : float
        Sum of volume times speed squared [m5 s-2].
    fastest : float
        Largest speed plus celerity [m s-1].
    broken : int
        Place of a particle that is not finite; -1: none.
    """

    longest_step: float
    energy: float
    fastest: float
    broken: int


@struct
class Waves(NamedTuple):
    """Pressure waves and converging flow, at n particles.

    Attributes
    ----------
    summed : ndarray of bool, shape (n,)
        Whether the particle limits the step; nothing near the others moves.
    light : ndarray of bool, shape (n,)
        Whether the volume of the particle is much smaller than the usual one.
    cosine : ndarray, shape (n,)
        Cosine of the slope of the bed [-].
    thickness : ndarray, shape (n,)
        Slope-normal thickness [m].
    own_thickness : ndarray, shape (n,)
        Slope-normal thickness of the particle's own phase [m].
    thickening : ndarray, shape (n,)
        -h div v [m s-1].
    smoothing_length : ndarray, shape (n,)
        1.4 spacings [m].
    stiffness : ndarray, shape (n,) or (1,)
        Square of the celerity that is not by weight [m2 s-2].
    """

    summed: np.ndarray
    light: np.ndarray
    cosine: np.ndarray
    thickness: np.ndarray
    own_thickness: np.ndarray
    thickening: np.ndarray
    smoothing_length: np.ndarray
    stiffness: np.ndarray


@struct
class Motion(NamedTuple):
    """Motion of n particles.

    Attributes
    ----------
    velocity : ndarray, shape (3, n)
        Velocity tangent to the bed [m s-1].
    thrust, earlier_thrust : ndarray, shape (3, n)
        Acceleration by pressure now, and before the sums over neighbours were last done [m s-2].
    volume : ndarray, shape (n,)
        Volume that moves [m3].
    """

    velocity: np.ndarray
    thrust: np.ndarray
    earlier_thrust: np.ndarray
    volume: np.ndarray


@struct
class Friction(NamedTuple):
    """Friction that can stop n particles within a step.

    Attributes
    ----------
    yield_stress : ndarray, shape (n,) or (1,)
        Shear stress that holds a body at rest [Pa].
    density : ndarray, shape (n,)
        Density of the mixture [kg m-3].
    """

    yield_stress: np.ndarray
    density: np.ndarray


@struct
class Growth(NamedTuple):
    """Growth of n particles by erosion.

    Attributes
    ----------
    rate : ndarray, shape (n,)
        Erosion rate per map area [m s-1].
    depth : ndarray, shape (n,)
        Vertical depth of the flow [m].
    """

    rate: np.ndarray
    depth: np.ndarray


def reduce_particles(
    particles, gravity: float, rule: StepRule, stiff=NOT_STIFF, step: float = 0.0, yield_stress=NO_FRICTION, ground=None
):
    """Return the `StepLimits` of all particles that are awake.

    The step is bounded by a Lagrangian Courant condition: pressure waves (g_n h)^(1/2) and converging flow
    against the smoothing length (the speed itself does not count), and the way of a step against the node spacing.
    Particles that stay where they are by friction do not count among the waves (`NEGLIGIBLE_WAY`).

    Parameters
    ----------
    particles : Particles
        Particles that are not `summed` do not limit the step, because nothing near them moves.
    gravity : float
        Acceleration by gravity [m s-2].
    rule : StepRule
        Bounds of a step.
    stiff : ndarray, shape (n,) or (1,)
        Part of the square of the celerity that is not due to weight [m2 s-2].
    step : float
        Length of the last step [s]; 0 before the first one, when every particle counts.
    yield_stress : ndarray, shape (awake,) or (1,)
        Shear stress that holds a body at rest [Pa].
    ground : tuple, optional
        `Surface` below the particles, and `Raster` with walls or None; by default no ground counts as even.
    """
    p = particles
    waves = Waves(
        summed=p.summed, light=p.light, cosine=p.cos_slope, thickness=p.thickness, own_thickness=p.own_thickness,
        thickening=p.thickening, smoothing_length=p.smoothing_length, stiffness=stiff,
    )  # fmt: skip
    motion = Motion(velocity=p.velocity, thrust=p.thrust, earlier_thrust=p.earlier_thrust, volume=p.volume)
    friction = Friction(yield_stress=yield_stress, density=p.density)
    growth = Growth(rate=p.entrainment_rate, depth=p.depth)
    wave_rate, growth_rate, across, energy, fastest, broken = _reduce(
        p.awake, waves, motion, friction, growth, p.basal_excess_pore_pressure, gravity, tuple(rule), step
    )
    others = min(rule.courant_number / max(wave_rate, 1e-300), GROWTH / max(growth_rate, 1e-300))
    if ground is not None and across < others and rule.way < rule.longest_way and broken < 0:
        across = find_time_across(p, *ground, rule, gravity, others)
    return StepLimits(min(others, across), energy, fastest, broken)


@inner
def _stays(i, speed, step, motion, waves, friction, rule):
    """Return whether particle `i` with its `speed` [m s-1] hardly moves within a step [s], and friction keeps it so.

    `motion`, `waves` and `friction` are the structs of all particles, `rule` is the `StepRule`.
    """
    _, thrust, earlier, _ = motion
    _, _, _, thickness, _, _, smoothing_length, _ = waves
    yield_stress, density = friction
    _, _, _, _, negligible_way, steady = rule
    if step == 0.0 or not speed * step < negligible_way * smoothing_length[i]:
        return False
    deceleration = value_at(yield_stress, i) / (density[i] * thickness[i])
    dx, dy, dz = thrust[0, i] - earlier[0, i], thrust[1, i] - earlier[1, i], thrust[2, i] - earlier[2, i]
    most = steady * deceleration
    return speed <= step * deceleration and dx * dx + dy * dy + dz * dz <= most * most


MOST_CONVERGENCE = 14.0 / 3.0
"""Largest rate of thickening, over largest speed / smoothing length, of even flow [-]: two speeds, times the integral
of |dW/dr| over that of W, 7/(3 l). A light particle that meets a flow would thicken faster."""


@kernel
def _reduce(count, waves, motion, friction, growth, pressure, gravity, rule, step):
    """Reduce the particles that are awake to the limits of the next step.

    Parameters
    ----------
    count : int
        Particles that are awake.
    waves : Waves
        Pressure waves at n particles.
    motion : Motion
        Motion of n particles.
    friction : Friction
        Friction that can stop n particles.
    growth : Growth
        Growth by erosion at n particles.
    pressure : ndarray, shape (n,)
        Basal excess pore pressure [Pa].
    gravity : float
        Acceleration by gravity [m s-2].
    rule : StepRule
        Bounds of a step.
    step : float
        Length of the last step [s].

    Returns
    -------
    wave_rate : float
        Highest rate at which waves and converging flow cross a smoothing length [s-1].
    growth_rate : float
        Highest rate of growth [s-1].
    across : float
        Shortest time in which a particle may go the way that is short enough anywhere [s].
    energy, fastest, broken
        As in `StepLimits`.
    """
    summed, light, cosine, thickness, own_thickness, thickening, smoothing_length, stiffness = waves
    velocity, thrust, _, volume = motion
    erosion_rate, depth = growth
    way = rule[1]
    wave_rate, growth_rate, across, energy, fastest, broken = 0.0, 0.0, np.inf, 0.0, 0.0, -1
    most = 0.0
    for i in range(count):
        most = max(most, velocity[0, i] ** 2 + velocity[1, i] ** 2 + velocity[2, i] ** 2)
    most = MOST_CONVERGENCE * np.sqrt(most)
    for i in range(count):
        speed2 = velocity[0, i] ** 2 + velocity[1, i] ** 2 + velocity[2, i] ** 2
        push2 = thrust[0, i] ** 2 + thrust[1, i] ** 2 + thrust[2, i] ** 2
        # not isfinite(), which reordering breaks (core/jit.py)
        if not abs(speed2 + push2 + thickness[i] + pressure[i]) < np.inf:
            broken = i
        celerity, speed = np.sqrt(gravity * cosine[i] * thickness[i]), np.sqrt(speed2)
        if summed[i] and not _stays(i, speed, step, motion, waves, friction, rule):
            fastest_wave = np.sqrt(celerity * celerity + value_at(stiffness, i))
            converging = max(thickening[i], 0.0) / own_thickness[i]
            if light[i]:
                converging = min(converging, most / smoothing_length[i])
            wave_rate = max(wave_rate, fastest_wave / smoothing_length[i] + converging)
        across = min(across, time_over(way, speed2, gravity + np.sqrt(push2)))  # also of particles not summed
        if not light[i]:
            growth_rate = max(growth_rate, erosion_rate[i] / depth[i])
        energy += volume[i] * speed2
        fastest = max(fastest, speed + celerity)
    return wave_rate, growth_rate, across, energy, fastest, broken
