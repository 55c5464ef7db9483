"""Limits of the time step, and further reductions over all particles at its end."""

from typing import NamedTuple

import numpy as np

from ..core.arrays import value_at
from ..core.jit import kernel
from ..core.structs import struct
from ..core.threads import in_ranges, worth
from .crossing import find_time_across, time_over
from .step_rule import GROWTH, StepRule

NOT_STIFF = np.zeros(1)
"""Nothing but weight drives waves [m2 s-2]."""


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
    thrust : ndarray, shape (3, n)
        Acceleration by pressure [m s-2].
    volume : ndarray, shape (n,)
        Volume that moves [m3].
    """

    velocity: np.ndarray
    thrust: np.ndarray
    volume: np.ndarray


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


def reduce_particles(particles, gravity: float, rule: StepRule, stiff=NOT_STIFF, ground=None, threads: int = 1):
    """Return the `StepLimits` of all particles that are awake.

    The step is bounded by a Lagrangian Courant condition: pressure waves (g_n h)^(1/2) and converging flow
    against the smoothing length (the speed itself does not count), and the way of a step against the node spacing.

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
    ground : tuple, optional
        `Surface` below the particles, and `Raster` with walls or None; by default no ground counts as even.
    threads : int
        Number of threads.
    """
    p = particles
    waves = Waves(
        summed=p.summed, light=p.light, cosine=p.cos_slope, thickness=p.thickness, own_thickness=p.own_thickness,
        thickening=p.thickening, smoothing_length=p.smoothing_length, stiffness=stiff,
    )  # fmt: skip
    motion = Motion(velocity=p.velocity, thrust=p.thrust, volume=p.volume)
    growth = Growth(rate=p.entrainment_rate, depth=p.depth)
    energies, short_times = np.zeros(p.awake // ENERGY_BLOCK + 1), np.empty(p.awake)
    found = in_ranges(
        _reduce, p.awake, worth(threads, p.awake), p.awake, waves, motion, growth,
        p.basal_excess_pore_pressure, gravity, rule.way, energies, short_times,
        unit=ENERGY_BLOCK,
    )  # fmt: skip
    wave_rates, growth_rates, times_across, speeds, places = zip(*found, strict=True)
    wave_rate, growth_rate, across = max(wave_rates), max(growth_rates), min(times_across)
    energy, fastest, broken = float(energies.sum()), max(speeds), max(places)
    others = min(rule.courant_number / max(wave_rate, 1e-300), GROWTH / max(growth_rate, 1e-300))
    if ground is not None and across < others and rule.way < rule.longest_way and broken < 0:
        across = find_time_across(p, *ground, rule, gravity, short_times, others)
    return StepLimits(min(others, across), energy, fastest, broken)


ENERGY_BLOCK = 4096
"""Particles whose energy is one sum, so that the order of sums does not depend on the number of threads."""

MOST_CONVERGENCE = 14.0 / 3.0
"""Largest rate of thickening, over largest speed / smoothing length, of even flow [-]: two speeds, times the integral
of |dW/dr| over that of W, 7/(3 l). A light particle that meets a flow would thicken faster."""


@kernel
def _reduce(first, last, count, waves, motion, growth, pressure, gravity, way, energies, short_times):
    """Reduce the particles from place `first` to `last` - 1 to the limits of the next step.

    Parameters
    ----------
    first, last : int
        The first is a multiple of `ENERGY_BLOCK`.
    count : int
        Particles that are awake.
    waves : Waves
        Pressure waves at n particles.
    motion : Motion
        Motion of n particles.
    growth : Growth
        Growth by erosion at n particles.
    pressure : ndarray, shape (n,)
        Basal excess pore pressure [Pa].
    gravity : float
        Acceleration by gravity [m s-2].
    way : float
        Way of a particle in a step that is short enough anywhere [m].
    energies : ndarray, shape (blocks,)
        Written, of the blocks of these particles: sum of volume times speed squared [m5 s-2].
    short_times : ndarray, shape (count,)
        Written, of these particles: time in which each may go `way` [s].

    Returns
    -------
    wave_rate : float
        Highest rate at which waves and converging flow cross a smoothing length [s-1].
    growth_rate : float
        Highest rate of growth [s-1].
    across : float
        Shortest time in which a particle may go the way that is short enough anywhere [s].
    fastest, broken
        As in `StepLimits`.
    """
    summed, light, cosine, thickness, own_thickness, thickening, smoothing_length, stiffness = waves
    velocity, thrust, volume = motion
    erosion_rate, depth = growth
    wave_rate, growth_rate, across, fastest, broken = 0.0, 0.0, np.inf, 0.0, -1
    most = 0.0
    for i in range(count):
        most = max(most, velocity[0, i] ** 2 + velocity[1, i] ** 2 + velocity[2, i] ** 2)
    most = MOST_CONVERGENCE * np.sqrt(most)
    for i in range(first, last):
        speed2 = velocity[0, i] ** 2 + velocity[1, i] ** 2 + velocity[2, i] ** 2
        push2 = thrust[0, i] ** 2 + thrust[1, i] ** 2 + thrust[2, i] ** 2
        # not isfinite(), which reordering breaks (core/jit.py)
        if not abs(speed2 + push2 + thickness[i] + pressure[i]) < np.inf:
            broken = i
        celerity, speed = np.sqrt(gravity * cosine[i] * thickness[i]), np.sqrt(speed2)
        if summed[i]:
            fastest_wave = np.sqrt(celerity * celerity + value_at(stiffness, i))
            converging = max(thickening[i], 0.0) / own_thickness[i]
            if light[i]:
                converging = min(converging, most / smoothing_length[i])
            wave_rate = max(wave_rate, fastest_wave / smoothing_length[i] + converging)
        short_times[i] = time_over(way, speed2, gravity + np.sqrt(push2))
        across = min(across, short_times[i])  # also of particles not summed
        if not light[i]:
            growth_rate = max(growth_rate, erosion_rate[i] / depth[i])
        energies[i // ENERGY_BLOCK] += volume[i] * speed2
        fastest = max(fastest, speed + celerity)
    return wave_rate, growth_rate, across, fastest, broken
