"""Limits of the time step, and further reductions over all particles at its end."""

from typing import NamedTuple

import numpy as np

from ..core.jit import kernel

TERRAIN_FRACTION = 0.5
"""Largest part of a node spacing a particle may cross in a step: the terrain must not be jumped over."""


GROWTH = 0.02
"""Largest part of its volume a particle may take up in a step."""

LATTICE_FREQUENCY, LATTICE_DAMPING = 1.63, 1.17
"""Of the fastest wave on a lattice, over celerity / smoothing length: its angular frequency, and the rate at which a
shock viscosity of 1 damps it (docs/decisions.md, Flow 2)."""


def viscous_share(viscosity: float) -> float:
    """Return the factor on the Courant number for a shock viscosity > 1, which is integrated explicitly [-].

    Damped leapfrog bears x = c dt / l up to (1.63 x)^2/4 + 1.17 viscosity x/2 = 1.

    Examples
    --------
    >>> viscous_share(0.5), viscous_share(1.0), round(viscous_share(10.0), 2)
    (1.0, 1.0, 0.19)
    """

    def limit(strength):
        a, b = 0.25 * LATTICE_FREQUENCY**2, 0.5 * LATTICE_DAMPING * strength
        return (np.sqrt(b * b + 4.0 * a) - b) / (2.0 * a)

    return float(min(1.0, limit(viscosity) / limit(1.0)))


NOT_STIFF = np.zeros(1)
"""Nothing but weight drives waves [m2 s-2]."""


class StepLimits(NamedTuple):
    """Limits of the next step, and further reductions over all particles that are awake."""

    longest_step: float  # that is stable [s]
    energy: float  # sum of volume times speed squared [m5 s-2]
    fastest: float  # largest speed plus celerity [m s-1]
    broken: int  # place of a particle that is not finite, or -1


def reduce_particles(particles, gravity: float, courant_number: float, node_spacing: float, stiff=NOT_STIFF):
    """Return the `StepLimits` of all particles that are awake.

    The step is bounded by a Lagrangian Courant condition: pressure waves (g_n h)^(1/2) and converging flow
    against the smoothing length (the speed itself does not count), and the speed against the node spacing.

    Parameters
    ----------
    particles : Particles
        Those not `summed` can wait for any time: nothing near them moves.
    gravity : float
        [m s-2]
    courant_number : float
        Time step over smoothing length / celerity.
    node_spacing : float
        Smaller one of the raster's [m].
    stiff : ndarray, shape (n,) or (1,)
        What else but weight adds to the square of the celerity [m2 s-2].
    """
    p = particles
    waves, growth, across, energy, fastest, broken = _reduce(
        p.awake, p.summed, p.cos_slope, gravity, TERRAIN_FRACTION * node_spacing, p.velocity, p.thrust, p.thickness,
        p.own_thickness, p.thickening, stiff, p.smoothing_length, p.volume, p.basal_excess_pore_pressure,
        p.entrainment_rate, p.depth, p.light,
    )  # fmt: skip
    longest = min(courant_number / max(waves, 1e-300), GROWTH / max(growth, 1e-300), across)
    return StepLimits(longest, energy, fastest, broken)


MOST_CONVERGENCE = 14.0 / 3.0
"""Largest rate of thickening, over largest speed / smoothing length, of even flow [-]: two speeds, times the integral
of |dW/dr| over that of W, 7/(3 l). A light particle that meets a flow thickens faster than that."""


@kernel
def _reduce(
    count, summed, cosine, gravity, way, velocity, thrust, thickness, own_thickness, thickening, stiff,
    smoothing_length, volume, pressure, entrainment_rate, depth, light,
):  # fmt: skip
    waves, growth, across, energy, fastest, broken = 0.0, 0.0, np.inf, 0.0, 0.0, -1
    most = 0.0
    for i in range(count):
        most = max(most, velocity[0, i] ** 2 + velocity[1, i] ** 2 + velocity[2, i] ** 2)
    most = MOST_CONVERGENCE * np.sqrt(most)
    for i in range(count):
        speed2 = velocity[0, i] ** 2 + velocity[1, i] ** 2 + velocity[2, i] ** 2
        push2 = thrust[0, i] ** 2 + thrust[1, i] ** 2 + thrust[2, i] ** 2
        if not abs(speed2 + push2 + thickness[i] + pressure[i]) < np.inf:  # isfinite() is reordered away (core/jit.py)
            broken = i
        celerity, speed = np.sqrt(gravity * cosine[i] * thickness[i]), np.sqrt(speed2)
        if summed[i]:
            fastest_wave = np.sqrt(celerity * celerity + stiff[min(i, stiff.size - 1)])
            converging = max(thickening[i], 0.0) / own_thickness[i]
            if light[i]:
                converging = min(converging, most / smoothing_length[i])
            waves = max(waves, fastest_wave / smoothing_length[i] + converging)
        # v dt + 1/2 a dt^2 within the way, also of those that wait: with the most that thrust and gravity, or friction,
        # can do, so that stopping is resolved to that way, too
        gain = gravity + np.sqrt(push2)
        across = min(across, 2.0 * way / (speed + np.sqrt(speed2 + 2.0 * gain * way) + 1e-300))
        if not light[i]:
            growth = max(growth, entrainment_rate[i] / depth[i])
        energy += volume[i] * speed2
        fastest = max(fastest, speed + celerity)
    return waves, growth, across, energy, fastest, broken
