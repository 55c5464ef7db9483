"""Fall lines of the ground within an outline: height of every node above the exit of its fall line."""

import heapq

import numpy as np
from scipy.sparse import coo_array, eye_array
from scipy.sparse.linalg import spsolve

SIDES = ((0, 1), (0, -1), (1, 0), (-1, 0))
"""Steps in rows and columns to the four nodes beside a node."""

RISE = 1e-6
"""Rise of a filled pit per node towards its inside [m]: small enough to be no slope, but with a way out for every
node."""


def fall_to_exit(inside: np.ndarray, elevation: np.ndarray, spacing: tuple[float, float]) -> np.ndarray:
    """Return the fall of the ground from every node of an outline to where its fall line leaves the outline [m].

    Parameters
    ----------
    inside : ndarray of bool, shape (rows, columns)
        Nodes of the outline, none of them in the outermost rows and columns.
    elevation : ndarray, shape (rows, columns)
        Elevation of the ground [m]; nothing leaves over nodes where it is NaN.
    spacing : tuple of float
        Distance of columns and of rows [m].

    Returns
    -------
    ndarray, shape (rows, columns)
        Fall [m]; 0 outside, and where a node lies lower than its exit, as in a pit of the ground.

    Notes
    -----
    The exit elevation E is carried up the ground, grad z . grad E = 0, with differences taken towards lower nodes
    (upwind, Courant et al., 1952). It is a mean of elevations at the rim, hence never below the lowest of them.
    Pits of the ground are crossed at the elevation over which they spill.
    """
    exits = np.zeros(elevation.shape)
    number = np.full(elevation.shape, -1)
    filled = fill_pits(inside, elevation)
    rows, columns = np.nonzero(inside & np.isfinite(filled))
    order = np.argsort(filled[rows, columns], kind="stable")  # every node comes after the nodes to which it falls
    rows, columns = rows[order], columns[order]
    number[rows, columns] = np.arange(rows.size)
    total, known = np.zeros((2, rows.size))
    entries = []
    for down, along in SIDES:
        there = rows + down, columns + along
        drop = filled[rows, columns] - filled[there]
        # no slope towards nodes without data
        weight = np.where(drop > 0.0, drop, 0.0) / spacing[0 if along else 1] ** 2
        total += weight
        within = number[there] >= 0
        entries.append((weight[within], np.flatnonzero(within), number[there][within]))
        out = ~within & (weight > 0.0)
        known[out] += weight[out] * elevation[there][out]
    weight, row, column = (np.concatenate(parts) for parts in zip(*entries, strict=True))
    carried = coo_array((weight / total[row], (row, column)), shape=(rows.size, rows.size))
    lower_triangle = (eye_array(rows.size) - carried).tocsc()
    exits[rows, columns] = spsolve(lower_triangle, known / total, permc_spec="NATURAL")
    return np.where(number >= 0, np.maximum(0.0, elevation - exits), 0.0)


def fill_pits(inside: np.ndarray, elevation: np.ndarray) -> np.ndarray:
    """Return the elevation of the ground with the pits inside an outline filled until they spill [m].

    Parameters
    ----------
    inside : ndarray of bool, shape (rows, columns)
        Nodes of the outline, none of them in the outermost rows and columns.
    elevation : ndarray, shape (rows, columns)
        Elevation of the ground [m]; nothing leaves over nodes where it is NaN.

    Returns
    -------
    ndarray, shape (rows, columns)
        Elevation [m], rising by a trace from where a pit spills; infinite from where nothing can leave.

    Notes
    -----
    From the lowest to the highest node, beginning outside (Barnes et al., 2014).
    """
    filled = np.where(inside, np.inf, elevation)
    beside = np.zeros(inside.shape, bool)
    for step in SIDES:
        beside |= np.roll(inside, step, (0, 1))
    rim = np.nonzero(beside & ~inside & np.isfinite(elevation))
    waiting = list(zip(elevation[rim].tolist(), *(places.tolist() for places in rim), strict=True))
    heapq.heapify(waiting)
    while waiting:
        level, row, column = heapq.heappop(waiting)
        for down, along in SIDES:
            there = row + down, column + along
            # the rim of the outline may be the edge of the raster
            within = 0 <= there[0] < inside.shape[0] and 0 <= there[1] < inside.shape[1]
            if within and inside[there] and filled[there] == np.inf:
                filled[there] = max(float(elevation[there]), level + RISE)
                heapq.heappush(waiting, (float(filled[there]), *there))
    return filled
