"""Carry volumes and values between particles and the nodes of a raster.

The rule, used for every field, for erosion and for the deposit: a particle is a hat function (bilinear) whose
half-width is twice its own spacing (V/h)^(1/2), never less than the node spacing, never more than four of them. Its
weights are normalised over the *core* nodes it reaches, so nothing is lost at a boundary and nothing is put outside.

The loops run in particle order in one thread: the only sums that several particles share.
"""

import numpy as np

from ..core.jit import inner, kernel
from .raster import CORE, Raster

WIDEST = 4.0
"""Largest half-width of a hat function in node spacings."""

MOST_NODES_PER_STEP = 2.0
"""Largest part of a node spacing that a particle may cross in a step (model/numerics.py)."""

REACH = int(WIDEST + MOST_NODES_PER_STEP) + 1
"""Nodes within which a particle writes, also after a step."""

MOST_NODES = 100
"""Room for the nodes under one hat function; there are at most (2 `WIDEST` + 1)^2."""


def scatter(raster: Raster, x, y, half_width, values, sums, touched):
    """Add particles' values to nodes.

    Parameters
    ----------
    raster : Raster
        Nodes, their statuses and spacing [m].
    x, y, half_width : ndarray, shape (n,)
        Position and half-width of the hat functions [m].
    values : ndarray, shape (n, k)
        Amounts; the first must be > 0 where a particle counts.
    sums : ndarray, shape (nodes, k)
        Zero on entry; the amounts are added. Those of a node lie together: on a wide raster few pages are touched.
    touched : ndarray of int, shape (nodes,)
        Scratch for the list of nodes reached.

    Returns
    -------
    ndarray of int
        The nodes reached, in order of first touch: all that a caller needs to look at.
    """
    return touched[: _scatter(raster, x, y, half_width, values, sums, touched)]


@inner
def hat_weights(raster, x, y, half_width, index, weight):
    """Write the core nodes under a hat function at a point [m] and their normalised weights [-]; return how many.

    Parameters
    ----------
    raster : Raster
        Nodes, their statuses and spacing [m].
    x, y, half_width : float
        Position, and half-width, kept between one and `WIDEST` node spacings [m].
    index : ndarray of int, shape (MOST_NODES,)
        Written: the nodes.
    weight : ndarray, shape (MOST_NODES,)
        Written: their weights, which sum to 1 [-].

    Returns
    -------
    int
        Number of entries written.
    """
    status, columns, rows, dx, dy = raster
    ax, ay = min(max(half_width, dx), WIDEST * dx), min(max(half_width, dy), WIDEST * dy)
    west, east = max(int(np.ceil((x - ax) / dx)), 0), min(int(np.floor((x + ax) / dx)), columns - 1)
    per_x, per_y, count, total = 1.0 / ax, 1.0 / ay, 0, 0.0
    for r in range(max(int(np.ceil((y - ay) / dy)), 0), min(int(np.floor((y + ay) / dy)), rows - 1) + 1):
        wy = 1.0 - abs(y - r * dy) * per_y
        for c in range(west, east + 1):
            node = r * columns + c
            w = wy * (1.0 - abs(x - c * dx) * per_x)
            if status[node] == CORE and w > 0.0:
                index[count], weight[count] = node, w
                total += w
                count += 1
    scale = 1.0 / total
    for k in range(count):
        weight[k] *= scale
    return count


@kernel
def _scatter(raster, x, y, half_width, values, sums, touched):
    """Add amounts of particles to sums over nodes; return the number of nodes reached.

    A particle is spread over nodes by a hat function, see `hat_weights`.

    Parameters
    ----------
    raster : Raster
        Nodes, their statuses and spacing [m].
    x, y, half_width : ndarray, shape (n,)
        Position and half-width of the hat functions [m].
    values : ndarray, shape (n, k)
        Amounts, in any unit; particles whose first amount is not > 0 are left out.
    sums : ndarray, shape (nodes, k)
        Zero on entry; the amounts are added.
    touched : ndarray of int, shape (nodes,)
        Written from its beginning: nodes in order of first touch. What it held before does not matter.

    Returns
    -------
    int
        Number of nodes written to `touched`.
    """
    index, weight = np.empty(MOST_NODES, np.int64), np.empty(MOST_NODES)
    found = 0
    for i in range(x.size):
        if values[i, 0] <= 0.0:
            continue
        for k in range(hat_weights(raster, x[i], y[i], half_width[i], index, weight)):
            node = index[k]
            if sums[node, 0] == 0.0:
                touched[found] = node
                found += 1
            for v in range(values.shape[1]):
                sums[node, v] += weight[k] * values[i, v]
    return found
