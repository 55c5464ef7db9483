"""State of particles in 32 bits.

Positions are packed as whole numbers of a small length, the quantum, so that the differences of two particles are
exact, and equal and opposite for both; all other values as floats, whose rounding, 6e-8, is far below the error of the
sums.
"""

from typing import NamedTuple

import numpy as np

from ..core.jit import inner
from ..core.structs import struct
from .cells import Cells
from .groups import CELLS_PER_GROUP

PLACES_PER_SUPPORT = 2.0**23
"""Number of quanta over the harmonic mean of the supports."""

MOST_PLACES = 2.0**30
"""Largest number of quanta between a particle of a group and a candidate, below the half of what 32 bits can tell
apart."""


class Position(NamedTuple):
    """Where n particles are, on the bed.

    Attributes
    ----------
    x : ndarray, shape (n,)
        Map coordinates, from the lower left node [m].
    y : ndarray, shape (n,)
        Map coordinates, from the lower left node [m].
    z : ndarray, shape (n,)
        Elevation of the bed [m].
    """

    x: np.ndarray
    y: np.ndarray
    z: np.ndarray


@struct
class Packed(NamedTuple):
    """Particles in 32 bits.

    Attributes
    ----------
    places : ndarray of int32, shape (3, n)
        x, y and z in quanta, from the first particle.
    values : ndarray of float32, shape (values, n)
        Any further values of a particle, lengths in quanta.
    quantum : float
        Length of a quantum [m].
    """

    places: np.ndarray
    values: np.ndarray
    quantum: float


def quantum_of(cells: Cells) -> float:
    """Return a length of the quantum with which no difference of neighbours overflows [m]."""
    farthest = 2.0 * CELLS_PER_GROUP * cells.size + cells.reach.max()
    return max(cells.support / PLACES_PER_SUPPORT, farthest / MOST_PLACES)


def empty_packed(count: int, values: int, quantum: float) -> tuple:
    """Return a `Packed` with room for `count` particles, with so many values of each."""
    return Packed(places=np.empty((3, count), np.int32), values=np.empty((values, count), np.float32), quantum=quantum)


@inner
def pack_place(distance, per_metre):
    """Return a distance [m] as a whole number of quanta, of which there are so many per metre.

    Whole numbers wrap around, and so do their differences, which are right again.
    """
    return np.int32(np.int64(distance * per_metre))
