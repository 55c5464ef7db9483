"""How long a step may be."""

import numpy as np

TERRAIN_FRACTION = 0.25
"""Largest part of a node spacing a particle may cross in a step: the terrain must not be jumped over."""


def longest_step(particles, cosine, thickening, gravity: float, courant_number: float, node_spacing: float) -> float:
    """Return the longest stable time step [s].

    Lagrangian Courant condition: pressure waves (g_n h)^(1/2) and converging flow against the smoothing
    length (the speed itself does not count), and the speed against the node spacing.

    Parameters
    ----------
    particles : Particles
    cosine, thickening : ndarray, shape (n,)
        cos(theta) and -h div v [m s-1].
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
    closing = np.maximum(thickening, 0.0) / p.thickness
    waves = np.max(celerity / p.smoothing_length + closing)
    speed = np.sqrt(np.max(np.einsum("in,in->n", p.velocity, p.velocity)))
    return min(courant_number / waves, TERRAIN_FRACTION * node_spacing / max(speed, 1e-300))
