"""Particles packed in the order of their cells, in 32 bits, and the neighbourhood of a cell copied out of them.

Positions are packed as whole numbers of a 2^-23 of the width of a cell, so that the differences of two particles are
exact, and equal and opposite for both; all other values as floats, whose rounding, 6e-8, is far below the error of the
sums. A cell copies its neighbourhood, one stretch for every row of cells, into a small contiguous scratch: the loop
over the scratch has no branches, and the compiler turns it into vector code.
"""

from typing import NamedTuple

import numpy as np

from ..core.jit import inner
from ..core.structs import struct
from .cells import Cells

PLACES_PER_CELL = 2.0**23
"""Number of quanta over the width of a cell: +-2^31 quanta are 256 cells, more than any window."""

LANES = 16
"""Floats in the widest vector register."""

_U64 = np.uint64  # unsigned: loops with an index that may be negative are not vectorised


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
    """Particles in the order of their cells, with room for one more vector behind the last.

    Attributes
    ----------
    places : ndarray of int32, shape (3, n + LANES)
        x, y and z in quanta, from the first particle.
    values : ndarray of float32, shape (values, n + LANES)
        Any further values of a particle, lengths in quanta.
    quantum : float
        Length of a quantum [m].
    """

    places: np.ndarray
    values: np.ndarray
    quantum: float


def empty_packed(cells: Cells, values: int) -> tuple:
    """Return a `Packed` with room for the particles of some cells, with so many values of each."""
    room = cells.order.size + LANES
    return Packed(
        places=np.empty((3, room), np.int32), values=np.empty((values, room), np.float32),
        quantum=cells.size / PLACES_PER_CELL,
    )  # fmt: skip


@inner
def copy_neighbourhood(cell, cells, packed, scratch):
    """Copy the particles that may act on a cell into the scratch; return their number, rounded up to whole vectors.

    Parameters
    ----------
    cell : int
        Number of the cell whose particles are acted on.
    cells : Cells
        Cell list over the particles that act.
    packed : Packed
        The particles that act, in the order of that list.
    scratch : Packed
        Written: places in quanta and values, as many as of `packed`. It has room for all particles that act and
        `LANES` (16) more.

    Returns
    -------
    int
        Number of entries of the scratch to loop over: a multiple of `LANES`, the floats of one vector. Entries beyond
        the copied particles have no volume.
    """
    columns, _, _, start, reach, box, window, _, _ = cells
    places, values, _ = packed
    near_places, near_values, _ = scratch
    rows = (start.size - 1) // columns
    row, column, w, m = cell // columns, cell % columns, window[cell], 0
    for r in range(max(row - w, 0), min(row + w, rows - 1) + 1):
        low, high = -1, -1
        for q in range(max(column - w, 0), min(column + w, columns - 1) + 1):
            d = r * columns + q
            gap_x = max(box[0, d] - box[1, cell], box[0, cell] - box[1, d], 0.0)
            gap_y = max(box[2, d] - box[3, cell], box[2, cell] - box[3, d], 0.0)
            distance = max(reach[d], reach[cell])
            if gap_x * gap_x + gap_y * gap_y < distance * distance:
                low = d if low < 0 else low
                high = d
        # a row of cells is one range of sorted particles; whole vectors are copied, the surplus is overwritten
        if low >= 0:
            first, here = _U64(start[low]), _U64(m)
            count = start[high + 1] - start[low]
            whole = _U64(count + LANES - 1) // _U64(LANES) * _U64(LANES)
            for v in range(near_places.shape[0]):
                for k in range(whole):
                    near_places[v, here + k] = places[v, first + k]
            for v in range(near_values.shape[0]):
                for k in range(whole):
                    near_values[v, here + k] = values[v, first + k]
            m += count
    for k in range(m, m + LANES):  # fill up the last vector with particles of no volume
        near_places[0, k], near_places[1, k], near_places[2, k] = 0, 0, 0
        for v in range(near_values.shape[0]):
            near_values[v, k] = np.float32(0.0)
    return (m + LANES - 1) // LANES * LANES
