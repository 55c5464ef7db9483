"""How long a step may be."""

import numpy as np

TERRAIN_FRACTION = 0.25
"""Largest part of a node spacing a particle may cross in a step: the terrain must not be jumped over."""


def longest_step(particles, awake, cosine, gravity: float, courant_number: float, node_spacing: float) -> float:
    """Return the longest stable time step [s].

    Lagrangian Courant condition: pressure waves (g_n h)^(1/2) and converging flow against the smoothing
    length (the speed itself does not count), and the speed against the node spacing.

    Parameters
    ----------
    particles : Particles
    awake : ndarray of bool, shape (n,)
        Those near something that moves; the others can wait for any time.
    cosine : ndarray, shape (n,)
        cos(theta).
    gravity : float
        [m s-2]
    courant_number : float
        Time step over smoothing length / celerity.
    node_spacing : float
        Smaller one of the raster's [m].
    """
    if particles.count == 0:
        return np.inf
    p = particles
    celerity = np.sqrt(gravity * cosine * p.thickness)
    closing = np.maximum(p.thickening, 0.0) / p.thickness
    waves = np.max(np.where(awake, celerity / p.smoothing_length + closing, 0.0))
    # v dt + 1/2 a dt^2 within the fraction, with the most that gravity and thrust can do
    speed = np.sqrt(np.einsum("in,in->n", p.velocity, p.velocity))
    gain = gravity * np.sqrt(1.0 - cosine**2) + np.sqrt(np.einsum("in,in->n", p.thrust, p.thrust))
    way = TERRAIN_FRACTION * node_spacing
    across = np.min(2.0 * way / (speed + np.sqrt(speed**2 + 2.0 * gain * way) + 1e-300))  # also of those asleep
    return min(courant_number / max(waves, 1e-300), across)
