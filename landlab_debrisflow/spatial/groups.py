"""Groups of particles that follow each other in a row of cells, as many as the vector unit has lanes.

The sums of a group run over one list of candidates: the particles near enough to its box to act on any particle of it.
Candidates are found by a test of boxes without branches, for all particles of the rows around.
"""

from typing import NamedTuple

import numpy as np

from ..core.jit import inner, kernel
from ..core.lanes import LANES, lane_places
from .cells import BINS_PER_CELL, Cells

CELLS_PER_GROUP = 8
"""Most columns of cells that a group spans: where particles are sparse, a group over more would have a wide box."""

MARGIN = 1.0 + 1e-5
"""Distance within which a candidate counts as near, squared, over that of its support: more than the rounding of
distances in 32 bits, so that the pairs of a particle do not depend on its group."""

_U64 = np.uint64
_LANES, _NONE = _U64(LANES), _U64(0)  # unsigned: loops with an index that may be negative are not vectorised


class Groups(NamedTuple):
    """Groups of sorted particles in cells that are awake, g of them.

    Attributes
    ----------
    first : ndarray of int, shape (g,)
        First sorted place.
    last : ndarray of int, shape (g,)
        Sorted place behind the last.
    west : ndarray of int, shape (g,)
        Cell of the first particle.
    east : ndarray of int, shape (g,)
        Cell of the last particle.
    """

    first: np.ndarray
    last: np.ndarray
    west: np.ndarray
    east: np.ndarray


def group(cells: Cells) -> Groups:
    """Return the groups of the particles of a cell list in cells that are awake."""
    found = np.empty((4, cells.order.size), np.int64)
    count = _group(cells.columns, cells.start, cells.awake, found)
    return Groups(*found[:, :count])


@kernel
def _group(columns, start, awake, groups):
    """Return the number of groups, and write them: first and last place, first and last cell.

    Parameters
    ----------
    columns, start, awake
        As in `Cells`.
    groups : ndarray of int, shape (4, n)
        Written.
    """
    g, row = -1, -1
    for c in range(awake.size):
        if not awake[c]:
            continue
        k, last = start[c], start[c + 1]
        while k < last:
            if (
                g < 0
                or groups[1, g] != k
                or k - groups[0, g] == LANES
                or (c // columns != row or c - groups[2, g] >= CELLS_PER_GROUP)
            ):
                g += 1
                groups[0, g], groups[2, g], row = k, c, c // columns
            k = min(last, groups[0, g] + LANES)
            groups[1, g], groups[3, g] = k, c
    return g + 1


@inner
def find_candidates(g, groups, sorted_places, cells, near):
    """Write the places of the particles that may act on a group, or on which one of it acts; return their number.

    Parameters
    ----------
    g : int
        Number of the group.
    groups : Groups
        All groups.
    sorted_places : ndarray, shape (3, m + LANES)
        x, y and support of the particles of the groups, in their order [m].
    cells : Cells
        Cell list over the n particles that act.
    near : ndarray of uint32, shape (n + LANES,)
        Written: sorted places, which rise.
    """
    columns, rows, size, x0, y0, _, _, _, bins, places, reach, _, _ = cells
    first, last, west, east = groups
    least_x, largest_x, least_y, largest_y, support = np.inf, -np.inf, np.inf, -np.inf, 0.0
    for k in range(_U64(first[g]), _U64(last[g])):
        least_x, largest_x = min(least_x, sorted_places[0, k]), max(largest_x, sorted_places[0, k])
        least_y, largest_y = min(least_y, sorted_places[1, k]), max(largest_y, sorted_places[1, k])
        support = max(support, sorted_places[2, k])
    far, hits = 0.0, lane_places()
    for c in range(west[g], east[g] + 1):
        far = max(far, reach[c])
    per_metre, m = 1.0 / size, _NONE
    columns_of_bins = BINS_PER_CELL * columns
    low_row = max(int((least_y - far - y0) * per_metre), 0)
    high_row = min(int((largest_y + far - y0) * per_metre), rows - 1)
    low = max(int((least_x - far - x0) * (BINS_PER_CELL * per_metre)), 0)
    high = min(int((largest_x + far - x0) * (BINS_PER_CELL * per_metre)), columns_of_bins - 1)
    for row in range(low_row, high_row + 1):
        k, last = bins[row * columns_of_bins + low], bins[row * columns_of_bins + high + 1]
        while k < last:
            here, left = _U64(k), _U64(last - k)
            for lane in range(_LANES):
                x, y, distance = places[0, here + lane], places[1, here + lane], places[2, here + lane]
                gap_x, gap_y = max(least_x - x, x - largest_x, 0.0), max(least_y - y, y - largest_y, 0.0)
                distance = max(support, distance)
                hits[lane] = (gap_x * gap_x + gap_y * gap_y < distance * distance * MARGIN) & (lane < left)
            for lane in range(_LANES):
                near[m] = here + lane
                m += _U64(hits[lane])
            k += LANES
    return m
