"""Carry volumes and values between particles and the nodes of a raster.

The rule, used for every field, for erosion and for the deposit: a particle is a tent whose half-width is
twice its own spacing (V/h)^(1/2), never less than the node spacing (then it is bilinear), never more than
four. Its weights are normalised over the *core* nodes it reaches, so nothing is lost at a boundary
and nothing is put outside.

The loops run in particle order in one thread: the only sums that several particles share.
"""

from typing import NamedTuple

import numpy as np

from ..core.jit import inner, kernel

WIDEST = 4.0
"""Largest half-width of a tent in node spacings."""

REACH = 6
"""Nodes within which a particle writes, also after a step (model/time_step.py)."""

MOST_NODES = 100
"""Room for the nodes under one tent; there are at most (2 `WIDEST` + 1)^2."""


class Nodes(NamedTuple):
    """The raster as kernels see it; coordinates start at the lower left node."""

    core: np.ndarray  # (nodes,) bool: may hold material
    columns: int
    dx: float
    dy: float

    @property
    def area(self):
        """Map area of one node [m2]."""
        return self.dx * self.dy

    def nearest(self, x, y):
        """Return the node nearest to each particle, shape (n,)."""
        return np.floor(y / self.dy + 0.5).astype(int) * self.columns + np.floor(x / self.dx + 0.5).astype(int)


def scatter(nodes: Nodes, x, y, spread, values, sums, touched):
    """Add particles' values to nodes.

    Parameters
    ----------
    x, y, spread : ndarray, shape (n,)
        Position and half-width of the tent [m].
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
    return touched[: _scatter(nodes.core, nodes.columns, nodes.dx, nodes.dy, x, y, spread, values, sums, touched)]


@inner
def weigh(core, columns, dx, dy, x, y, spread, index, weight):
    """Write the core nodes under one tent and their normalised weights; return how many."""
    rows = core.size // columns
    ax, ay = min(max(spread, dx), WIDEST * dx), min(max(spread, dy), WIDEST * dy)
    west, east = max(int(np.ceil((x - ax) / dx)), 0), min(int(np.floor((x + ax) / dx)), columns - 1)
    per_x, per_y, count, total = 1.0 / ax, 1.0 / ay, 0, 0.0
    for r in range(max(int(np.ceil((y - ay) / dy)), 0), min(int(np.floor((y + ay) / dy)), rows - 1) + 1):
        wy = 1.0 - abs(y - r * dy) * per_y
        for c in range(west, east + 1):
            node = r * columns + c
            w = wy * (1.0 - abs(x - c * dx) * per_x)
            if core[node] and w > 0.0:
                index[count], weight[count] = node, w
                total += w
                count += 1
    share = 1.0 / total
    for k in range(count):
        weight[k] *= share
    return count


@kernel
def _scatter(core, columns, dx, dy, x, y, spread, values, sums, touched):
    index, weight = np.empty(MOST_NODES, np.int64), np.empty(MOST_NODES)
    found = 0
    for i in range(x.size):
        if values[i, 0] <= 0.0:
            continue
        for k in range(weigh(core, columns, dx, dy, x[i], y[i], spread[i], index, weight)):
            node = index[k]
            if sums[node, 0] == 0.0:
                touched[found] = node
                found += 1
            for v in range(values.shape[1]):
                sums[node, v] += weight[k] * values[i, v]
    return found
