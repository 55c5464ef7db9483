"""Sort particles into square cells, and find the cells within reach of each other.

Supports differ from particle to particle, and a pair interacts if *either* reaches the other. The list holds for each
cell its reach (the largest support inside), the box around its particles, and its window: the number of cells to the
farthest cell for which the reach of one of the two spans the gap between them.

A cell sleeps while nothing in its window has changed, because its sums would not change either.
"""

import os
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ..core.jit import kernel

CELLS_PER_PARTICLE = 4
"""Largest number of cells: the empty land between distant parts of a flow must not cost memory or time."""


class Cells(NamedTuple):
    """A cell list over n particles; cell c holds the sorted particles ``start[c]:start[c + 1]``.

    Attributes
    ----------
    columns : int
        Cells in a row.
    size : float
        Width of a cell [m].
    order : ndarray of int, shape (n,)
        Particle at each sorted place.
    start : ndarray of int, shape (cells + 1,)
        First sorted place of each cell, and n.
    reach : ndarray, shape (cells,)
        Largest support inside [m].
    box : ndarray, shape (4, cells)
        Least and largest x, least and largest y inside [m].
    window : ndarray of int, shape (cells,)
        Number of cells in x and in y within which neighbours may lie.
    awake : ndarray of bool, shape (cells,)
        Whether a particle in the window has changed.
    computed : ndarray of bool, shape (n,)
        Whether the particle is in a cell that is awake.
    """

    columns: int
    size: float
    order: np.ndarray
    start: np.ndarray
    reach: np.ndarray
    box: np.ndarray
    window: np.ndarray
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
    west, width, south, height, size = _extent(x, y, support)
    most = CELLS_PER_PARTICLE * n + 16
    size = max(size, np.sqrt(width * height / most), max(width, height) / most)
    columns, rows = int(width / size) + 1, int(height / size) + 1
    cells = columns * rows
    found = Cells(
        columns=columns,
        size=size,
        order=np.empty(n, np.int64),
        start=np.zeros(cells + 1, np.int64),
        reach=np.zeros(cells),
        box=np.empty((4, cells)),
        window=np.zeros(cells, np.int64),
        awake=np.zeros(cells, np.bool_),
        computed=np.empty(n, np.bool_),
    )
    plain = tuple(found)  # kernels are called faster with plain tuples (core/structs.py)
    _sort(x, y, support, changed, west, south, plain)
    _wake(plain)
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


@kernel
def _sort(x, y, support, changed, west, south, cells):
    """Write order, start, reach and box of the cells, and into ``awake`` whether a particle inside has changed.

    Parameters
    ----------
    x, y, support : ndarray, shape (n,)
        Map coordinates and radius within which each particle has neighbours [m].
    changed : ndarray of bool, shape (n,)
        Whether each particle has changed.
    west, south : float
        Lower left corner of the cells [m].
    cells : Cells
        Start, reach and awake are 0 on entry.
    """
    columns, size, order, start, reach, box, _, stirred, _ = cells
    rows, cell = (start.size - 1) // columns, np.empty(x.size, np.int64)
    for c in range(reach.size):
        box[0, c], box[1, c], box[2, c], box[3, c] = np.inf, -np.inf, np.inf, -np.inf
    for i in range(x.size):
        c = min(int((y[i] - south) / size), rows - 1) * columns + min(int((x[i] - west) / size), columns - 1)
        cell[i] = c
        start[c + 1] += 1
        reach[c] = max(reach[c], support[i])
        box[0, c], box[1, c] = min(box[0, c], x[i]), max(box[1, c], x[i])
        box[2, c], box[3, c] = min(box[2, c], y[i]), max(box[3, c], y[i])
        stirred[c] |= changed[i]
    for c in range(start.size - 1):
        start[c + 1] += start[c]
    for i in range(x.size - 1, -1, -1):  # backwards, so that particles keep their order within a cell
        c = cell[i]
        start[c + 1] -= 1
        order[start[c + 1]] = i
    # start[c + 1] now holds the beginning of cell c: shift it back
    for c in range(start.size - 1):
        start[c] = start[c + 1]
    start[start.size - 1] = x.size


@kernel
def _wake(cells):
    """Find the windows; turn ``awake`` from whether a cell has changed into whether its window has.

    Parameters
    ----------
    cells : Cells
        Sorted by `_sort`; window, 0 on entry, awake and computed are written.
    """
    columns, size, order, start, reach, _, window, awake, computed = cells
    rows = (start.size - 1) // columns
    for row in range(rows):
        for column in range(columns):
            c = row * columns + column
            if start[c] == start[c + 1]:
                continue
            k = int(np.ceil(reach[c] / size))
            for r in range(max(row - k, 0), min(row + k, rows - 1) + 1):
                for q in range(max(column - k, 0), min(column + k, columns - 1) + 1):
                    distance = max(abs(r - row), abs(q - column))
                    d = r * columns + q
                    window[d] = max(window[d], distance)
                    window[c] = max(window[c], distance)
    stirred = awake.copy()
    for row in range(rows):
        for column in range(columns):
            c = row * columns + column
            if start[c] == start[c + 1]:
                continue
            w = 0 if stirred[c] else window[c]
            for r in range(max(row - w, 0), min(row + w, rows - 1) + 1):
                for q in range(max(column - w, 0), min(column + w, columns - 1) + 1):
                    awake[c] |= stirred[r * columns + q]
            for k in range(start[c], start[c + 1]):
                computed[order[k]] = awake[c]


@lru_cache(maxsize=4)
def _pool(process: int, threads: int) -> ThreadPoolExecutor:
    """Return the thread pool of a process; the number of the process is a key because a fork inherits no threads."""
    return ThreadPoolExecutor(threads, thread_name_prefix="debrisflow")


def over_cells(function, cells: Cells, threads: int, *arguments):
    """Call ``function(first, last, *arguments)`` on ranges of cells with equal numbers of particles.

    One thread computes the whole of a cell and writes only to the particles in it. So the result does not depend on the
    number of threads, to the last bit.
    """
    count = cells.start.size - 1
    if threads == 1:
        function(0, count, *arguments)
        return
    parts = np.searchsorted(cells.start, np.linspace(0, cells.order.size, threads + 1))
    parts[0], parts[-1] = 0, count
    pool = _pool(os.getpid(), threads)
    for future in [pool.submit(function, int(a), int(b), *arguments) for a, b in pairwise(parts)]:
        future.result()
