"""Sort particles into square cells, and find the cells within reach of each other.

Supports differ from particle to particle, and a pair interacts if *either* reaches the other. So the list holds for
each cell not its own largest support but the largest of all particles that may act on it, its reach. Cells stand in
rows along x, and particles are sorted along x more finely than by cells: those of a stretch of a row follow each other
in the sorted order, and a few of them that follow each other lie in a small box (groups.py).

A cell sleeps while nothing in its reach has changed, because its sums would not change either.
"""

from typing import NamedTuple

import numpy as np

from ..core.jit import inner, kernel
from ..core.lanes import LANES

CELL_WIDTH = 1.3
"""Width of a cell over the harmonic mean of the supports: groups of 16 are then about as long as wide, and full."""

BINS_PER_CELL = 8
"""Bins along x into which the particles of a cell are sorted."""

CELLS_PER_PARTICLE = 4
"""Largest number of cells: the empty land between distant parts of a flow must not cost memory or time."""


_U64 = np.uint64  # unsigned: an index that may be negative counts from the end, which takes time
_ONE = _U64(1)


class Cells(NamedTuple):
    """A cell list over n particles; cell c holds the sorted particles ``start[c]:start[c + 1]``.

    Attributes
    ----------
    columns : int
        Cells in a row.
    rows : int
        Rows of cells.
    size : float
        Width of a cell [m].
    west : float
        Least x of the cells [m].
    south : float
        Least y of the cells [m].
    support : float
        Harmonic mean of the supports [m].
    order : ndarray of int, shape (n,)
        Particle at each sorted place.
    start : ndarray of int, shape (cells + 1,)
        First sorted place of each cell, and n.
    bins : ndarray of int, shape (BINS_PER_CELL cells + 1,)
        First sorted place of each bin, and n.
    sorted : ndarray, shape (3, n + LANES)
        x, y and support at each sorted place [m].
    reach : ndarray, shape (cells,)
        Largest support of the particles that may act on those in the cell, or on which these may act [m].
    awake : ndarray of bool, shape (cells,)
        Whether a particle in reach has changed.
    computed : ndarray of bool, shape (n,)
        Whether the particle is in a cell that is awake.
    """

    columns: int
    rows: int
    size: float
    west: float
    south: float
    support: float
    order: np.ndarray
    start: np.ndarray
    bins: np.ndarray
    sorted: np.ndarray
    reach: np.ndarray
    awake: np.ndarray
    computed: np.ndarray


def sort_into_cells(x, y, support, changed=None) -> Cells:
    """Build the cell list.

    Parameters
    ----------
    x, y : ndarray, shape (n,)
        Map coordinates [m].
    support : ndarray, shape (n,)
        Radius within which each particle has neighbours [m].
    changed : ndarray of bool, shape (n,), optional
        Particles whose neighbours' sums may differ from last time; all if not given.
    """
    n = x.size
    changed = np.ones(n, np.bool_) if changed is None else changed
    west, width, south, height, mean = _extent(x, y, support)
    most = CELLS_PER_PARTICLE * n + 16
    size = max(CELL_WIDTH * mean, np.sqrt(width * height / most), max(width, height) / most)
    columns, rows = int(width / size) + 1, int(height / size) + 1
    cells = columns * rows
    found = Cells(
        columns=columns,
        rows=rows,
        size=size,
        west=west,
        south=south,
        support=mean,
        order=np.empty(n, np.int64),
        start=np.empty(cells + 1, np.int64),
        bins=np.zeros(BINS_PER_CELL * cells + 1, np.int64),
        sorted=np.empty((3, n + LANES)),
        reach=np.zeros(cells),
        awake=np.zeros(cells, np.bool_),
        computed=np.empty(n, np.bool_),
    )
    plain = tuple(found)  # kernels are called faster with plain tuples (core/structs.py)
    scratch = np.empty(n, np.uint64), np.empty(cells), np.empty(cells, np.bool_)
    _sort(x, y, support, changed, plain, scratch)
    return found


@kernel
def _extent(x, y, support):
    """Return least x, extent in x, least y, extent in y, and the harmonic mean of the supports, all [m].

    Parameters
    ----------
    x, y, support : ndarray, shape (n,)
        Position and support of the particles [m].
    """
    west, east, south, north, total = x[0], x[0], y[0], y[0], 0.0
    for i in range(x.size):
        west, east, south, north = min(west, x[i]), max(east, x[i]), min(south, y[i]), max(north, y[i])
        total += 1.0 / support[i]
    return west, east - west, south, north - south, x.size / total


@inner
def _wake(cells, inside, stirred):
    """Turn the reach of cells from the largest support inside into the largest in reach, and find the cells awake.

    Parameters
    ----------
    cells : Cells
        Sorted into bins; reach, awake and computed are written.
    inside, stirred : ndarray, shape (columns * rows,)
        Scratch for reach and awake as they come in.
    """
    columns, rows, size, _, _, _, order, start, _, _, reach, awake, computed = cells
    sleepers = False
    for c in range(_U64(reach.size)):
        inside[c], stirred[c] = reach[c], awake[c]
    for row in range(rows):
        for column in range(columns):
            c = _U64(row * columns + column)
            if start[c] == start[c + _ONE]:
                continue
            reached, sleepers = inside[c] / size, sleepers | (not stirred[c])
            w = int(np.ceil(reached))
            for r in range(max(row - w, 0), min(row + w, rows - 1) + 1):
                gap = max(abs(r - row) - 1, 0)
                half = int(np.ceil(np.sqrt(reached * reached - gap * gap)))
                first, last = max(column - half, 0), min(column + half, columns - 1)
                for d in range(_U64(r * columns + first), _U64(r * columns + last + 1)):
                    reach[d] = max(reach[d], inside[c])
    if not sleepers:
        computed[:] = True
        return
    for row in range(rows):
        for column in range(columns):
            c, w = row * columns + column, int(np.ceil(inside[row * columns + column] / size))
            for r in range(max(row - w, 0), min(row + w, rows - 1) + 1):
                for q in range(max(column - w, 0), min(column + w, columns - 1) + 1):
                    gap_x, gap_y, d = max(abs(q - column) - 1, 0), max(abs(r - row) - 1, 0), r * columns + q
                    if (gap_x * gap_x + gap_y * gap_y) * size * size < inside[c] * inside[c]:
                        awake[c] |= stirred[d]
                        awake[d] |= stirred[c]
    for c in range(_U64(awake.size)):
        awake[c] &= start[c] < start[c + _ONE]
        for k in range(_U64(start[c]), _U64(start[c + _ONE])):
            computed[_U64(order[k])] = awake[c]


@kernel
def _sort(x, y, support, changed, cells, scratch):
    """Write order, start and bins, then the reach of cells, and which of them are awake.

    Parameters
    ----------
    x, y, support : ndarray, shape (n,)
        Map coordinates and radius within which each particle has neighbours [m].
    changed : ndarray of bool, shape (n,)
        Whether each particle has changed.
    cells : Cells
        Bins, reach and awake are 0 on entry.
    scratch : tuple of ndarray
        Of n uint64, and for every cell a float and a bool.
    """
    columns, rows, size, west, south, _, order, start, bins, places, reach, stirred, _ = cells
    bin_of, inside, was_stirred = scratch
    columns_of_bins, per_metre = BINS_PER_CELL * columns, 1.0 / size
    for i in range(x.size):
        row = min(np.int64((y[i] - south) * per_metre), rows - 1)
        column = min(np.int64((x[i] - west) * (BINS_PER_CELL * per_metre)), columns_of_bins - 1)
        bin_of[i] = _U64(row * columns_of_bins + column)
    for i in range(x.size):
        bins[bin_of[i] + _ONE] += 1
    for b in range(_U64(bins.size - 1)):
        bins[b + _ONE] += bins[b]
    for i in range(x.size - 1, -1, -1):  # backwards, so that particles keep their order within a bin
        b = bin_of[_U64(i)] + _ONE
        bins[b] -= 1
        order[_U64(bins[b])] = i
    # bins[b + 1] now holds the beginning of bin b: shift it back
    for b in range(_U64(bins.size - 1)):
        bins[b] = bins[b + _ONE]
    bins[bins.size - 1] = x.size
    for c in range(_U64(start.size - 1)):
        start[c] = bins[c * _U64(BINS_PER_CELL)]
        largest, any_changed = 0.0, False
        for k in range(_U64(start[c]), _U64(bins[(c + _ONE) * _U64(BINS_PER_CELL)])):
            i = _U64(order[k])
            places[0, k], places[1, k], places[2, k] = x[i], y[i], support[i]
            largest = max(largest, support[i])
            any_changed |= changed[i]
        reach[c], stirred[c] = largest, any_changed
    start[start.size - 1] = x.size
    _pad(places)
    _wake(cells, inside, was_stirred)


def cells_of_phase(cells: Cells, in_phase) -> Cells:
    """Return the cells with the particles of one phase only.

    Parameters
    ----------
    cells : Cells
        Cell list over the particles.
    in_phase : ndarray of bool, shape (n,)
        Whether each particle is of the phase.
    """
    count = np.count_nonzero(in_phase)
    found = cells._replace(
        order=np.empty(count, np.int64), start=np.empty_like(cells.start), bins=np.empty_like(cells.bins),
        sorted=np.empty((3, count + LANES)),
    )  # fmt: skip
    _select(tuple(cells), in_phase, tuple(found))
    return found


@kernel
def _select(cells, in_phase, found):
    """Write order, start, bins and sorted places of the particles of one phase.

    Parameters
    ----------
    cells : Cells
        Cell list over all n particles.
    in_phase : ndarray of bool, shape (n,)
        Whether each particle is of the phase.
    found : Cells
        Written.
    """
    _, _, _, _, _, _, order, _, bins, places, _, _, _ = cells
    _, _, _, _, _, _, found_order, found_start, found_bins, found_places, _, _, _ = found
    m = _U64(0)
    for b in range(_U64(bins.size - 1)):
        found_bins[b] = m
        for k in range(_U64(bins[b]), _U64(bins[b + _ONE])):
            if in_phase[_U64(order[k])]:
                found_order[m] = order[k]
                found_places[0, m], found_places[1, m] = places[0, k], places[1, k]
                found_places[2, m] = places[2, k]
                m += _ONE
    found_bins[bins.size - 1] = m
    for c in range(found_start.size):
        found_start[c] = found_bins[BINS_PER_CELL * c]
    _pad(found_places)


@inner
def _pad(places):
    """Put no particle beyond the last one: these places are far away and reach nothing."""
    for k in range(places.shape[1] - LANES, places.shape[1]):
        places[0, k] = places[1, k] = np.inf
        places[2, k] = 0.0
