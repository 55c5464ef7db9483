"""State of particles that the sums over neighbours read, and the results."""

from typing import NamedTuple

import numpy as np

from .packing import Position


class SummationInput(NamedTuple):
    """State of n particles that the sums read; particles beyond the size of `Sums` act, and get no sums.

    Attributes
    ----------
    position : Position
        On the surface [m].
    velocity : ndarray, shape (3, n)
        Velocity tangent to the bed [m s-1].
    volume : ndarray, shape (n,)
        Volume [m3]; a negative volume pulls, see model/release/placing.py.
    smoothing_length : ndarray, shape (n,)
        1.4 spacings [m].
    longest : ndarray, shape (n,)
        Cap of the smoothing length [m]; there it is fixed and the plain sum holds.
    pressure_coefficient : ndarray, shape (n,)
        Depth-integrated pressure over thickness^2, Omega and reference density: inertia g_n / (2 Omega) [m s-2].
    celerity : ndarray, shape (n,)
        Celerity of waves [m s-1].
    thickness : ndarray, shape (n,)
        Slope-normal, of the last time [m].
    convergence : ndarray, shape (n,)
        -h div v, of the last time [m s-1].
    inertia : ndarray, shape (n,)
        Density over a reference density [-].
    """

    position: Position
    velocity: np.ndarray
    volume: np.ndarray
    smoothing_length: np.ndarray
    longest: np.ndarray
    pressure_coefficient: np.ndarray
    celerity: np.ndarray
    thickness: np.ndarray
    convergence: np.ndarray
    inertia: np.ndarray


class Sums(NamedTuple):
    """Results of the sums, written where cells are awake.

    Attributes
    ----------
    thickness : ndarray, shape (n,)
        Slope-normal [m].
    gradient_term : ndarray, shape (n,)
        Omega of the grad-h formulation [-].
    next_length : ndarray, shape (n,)
        Smoothing length for the next time [m].
    acceleration : ndarray, shape (3, n)
        Acceleration by pressure [m s-2].
    convergence : ndarray, shape (n,)
        -h div v, the rate at which converging flow thickens, without grad-h term [m s-1].
    """

    thickness: np.ndarray
    gradient_term: np.ndarray
    next_length: np.ndarray
    acceleration: np.ndarray
    convergence: np.ndarray
