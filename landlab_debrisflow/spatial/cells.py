"""Sort particles into square cells, and list for every cell what may act on its particles.

Supports differ from particle to particle, and a pair interacts if *either* reaches the other. Each
cell therefore knows its own reach (the largest support inside) and its window: how many cells away
the farthest cell lies whose reach, or its own, spans the gap. From the cells in the window those
particles are listed whose support, or the cell's reach, spans the distance to the box around the
cell's particles.

A cell sleeps while nothing in its window has changed: its sums would come out the same, so nothing is
listed for it and nobody computes them.
"""

from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ..core.jit import kernel


class Cells(NamedTuple):
    """A cell list over n particles; cell c holds the sorted particles ``start[c]:start[c + 1]``."""

    order: np.ndarray  # (n,) particle at each sorted place
    start: np.ndarray  # (cells + 1,)
    near: np.ndarray  # sorted places of the particles that may act on a cell, those of cell c are
    near_start: np.ndarray  # (cells + 1,) near[near_start[c]:near_start[c + 1]]; none if it sleeps
    computed: np.ndarray  # (n,) bool: in a cell that is awake


def sort_into_cells(x, y, support, changed=None) -> Cells:
    """Build the cell list.

    Parameters
    ----------
    x, y : ndarray, shape (n,)
        Map coordinates [m].
    support : ndarray, shape (n,)
        Radius within which each particle feels others [m].
    changed : ndarray of bool, shape (n,), optional
        Particles whose neighbours' sums may differ from last time; all if not given.
    """
    n = x.size
    changed = np.ones(n, bool) if changed is None else changed
    west, south = x.min(), y.min()
    width, height = x.max() - west, y.max() - south
    size = support.mean()
    most = 4 * n + 16  # a flow far from its parts must not pay for the empty land between
    size = max(size, np.sqrt(width * height / most), max(width, height) / most)
    columns, rows = int(width / size) + 1, int(height / size) + 1
    cells = columns * rows
    start, order = np.zeros(cells + 1, np.int64), np.empty(n, np.int64)
    reach, window = np.zeros(cells), np.zeros(cells, np.int64)
    stirred, computed = np.zeros(cells, np.bool_), np.zeros(n, np.bool_)
    near_start = np.zeros(cells + 1, np.int64)
    candidates = _sort(
        x, y, support, changed, west, south, size, columns, rows, order, start, reach, window,
        stirred, computed, np.empty(n, np.int64),
    )  # fmt: skip
    near = np.empty(candidates, np.int64)
    _list(x[order], y[order], support[order], start, reach, window, computed[order], columns, rows, near, near_start)
    return Cells(order, start, near, near_start, computed)


@kernel
def _sort(
    x, y, support, changed, west, south, size, columns, rows, order, start, reach, window,
    stirred, computed, cell,
):  # fmt: skip
    for i in range(x.size):
        c = min(int((y[i] - south) / size), rows - 1) * columns + min(int((x[i] - west) / size), columns - 1)
        cell[i] = c
        start[c + 1] += 1
        reach[c] = max(reach[c], support[i])
        stirred[c] |= changed[i]
    for c in range(start.size - 1):
        start[c + 1] += start[c]
    for i in range(x.size - 1, -1, -1):  # backwards and counting down: the order inside a cell is kept
        c = cell[i]
        start[c + 1] -= 1
        order[start[c + 1]] = i
    # start[c + 1] now holds the beginning of cell c: shift it back
    for c in range(start.size - 1):
        start[c] = start[c + 1]
    start[start.size - 1] = x.size
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
    candidates = 0
    for row in range(rows):
        for column in range(columns):
            c = row * columns + column
            w = window[c] if start[c] < start[c + 1] else -1
            awake, here = False, 0
            for r in range(max(row - w, 0), min(row + w, rows - 1) + 1):
                for q in range(max(column - w, 0), min(column + w, columns - 1) + 1):
                    awake |= stirred[r * columns + q]
                    here += start[r * columns + q + 1] - start[r * columns + q]
            candidates += here if awake else 0
            for k in range(start[c], start[c + 1]):
                computed[order[k]] = awake
    return candidates


@kernel
def _list(x, y, support, start, reach, window, awake, columns, rows, near, near_start):
    found = 0
    for c in range(start.size - 1):
        near_start[c] = found
        if start[c] == start[c + 1] or not awake[start[c]]:
            continue
        west = east = x[start[c]]
        south = north = y[start[c]]
        for k in range(start[c], start[c + 1]):
            west, east, south, north = min(west, x[k]), max(east, x[k]), min(south, y[k]), max(north, y[k])
        row, column, w = c // columns, c % columns, window[c]
        for r in range(max(row - w, 0), min(row + w, rows - 1) + 1):
            first = start[r * columns + max(column - w, 0)]
            last = start[r * columns + min(column + w, columns - 1) + 1]
            for k in range(first, last):  # a row of cells is one stretch of sorted particles
                gap_x = max(max(west - x[k], x[k] - east), 0.0)
                gap_y = max(max(south - y[k], y[k] - north), 0.0)
                distance = max(reach[c], support[k])
                near[found] = k
                found += gap_x * gap_x + gap_y * gap_y < distance * distance
    near_start[start.size - 1] = found


def over_cells(function, cells: Cells, threads: int, *arguments):
    """Call ``function(first, last, cells, *arguments)`` on ranges of cells with equal work.

    Every cell is computed whole by one thread and writes only to its own particles, so the result
    does not depend on the number of threads, to the last bit.
    """
    count = cells.start.size - 1
    if threads == 1:
        function(0, count, *arguments)
        return
    parts = np.searchsorted(cells.start, np.linspace(0, cells.order.size, threads + 1))
    parts[0], parts[-1] = 0, count
    with ThreadPoolExecutor(threads) as pool:
        for future in [pool.submit(function, a, b, *arguments) for a, b in pairwise(parts)]:
            future.result()
