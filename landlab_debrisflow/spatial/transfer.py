"""Carry volumes and values between particles and the nodes of a raster.

The rule, used for every field, for erosion, for the load on the bed and for the deposit: a particle is a hat function
(bilinear) whose half-width is twice its own spacing (V/h)^(1/2), never less than the node spacing, never more than four
of them, cut at the edge of the flow. Its weights are normalised over the *core* nodes that are left, so nothing is lost
at a boundary or at the edge, and nothing is put outside.

Where the edge is, tells the *cover* of a node: the map area V/h of the particles, spread by whole hat functions, over
that of the node. Inside a flow it is 1, at a straight edge 1/2, whatever the half-width. Particles are points, though:
where a flow tapers off, the outermost one stands for more ground outwards than inwards. A particle of depth h therefore
reaches nodes with a cover of (h/d)^(1/2)/2 or more, d being the largest depth under its hat function; then steep edges
and those that taper off lie alike (``python -m benchmarks.footprint``). Where a flow is narrower than its hat
functions, a particle reaches nodes with three quarters of the largest cover under its own: a single file of particles
is one spacing wide.

The loops run in particle order in one thread: the only sums that several particles share.
"""

from typing import NamedTuple

import numpy as np

from ..core.jit import kernel
from ..core.structs import struct
from .raster import CORE, Raster

WIDEST = 4.0
"""Largest half-width of a hat function in node spacings."""

MOST_NODES_PER_STEP = 2.0
"""Largest part of a node spacing that a particle may cross in a step (model/numerics.py)."""

REACH = int(WIDEST + MOST_NODES_PER_STEP) + 1
"""Nodes within which a particle writes, also after a step."""

COVERED = 0.5
"""Cover from which a node is inside a flow: that of a node on a straight edge [-]."""

NARROW = 0.75
"""Cover over the largest one near, from which a node is inside a flow that is narrower than its hat functions.

A file of particles, one spacing s apart, has the cover (1 - y/2s)/2 at a distance y: at s/2 three quarters of what it
has in the middle."""

ROUNDING = 1.0 - 1e-9
"""What a node may fall short of that by rounding [-]: a symmetric flow is cut on both sides alike."""


@struct
class Footprints(NamedTuple):
    """Nodes on which each of n particles lies, and how much of it; a sparse matrix by rows, with gaps between them.

    Attributes
    ----------
    begin, end : ndarray of int, shape (n,)
        First entry of each particle, and the one behind its last.
    node : ndarray of int, shape (m,)
        Nodes, core nodes all.
    weight : ndarray, shape (m,)
        Weights, which are > 0 and sum to 1 for every particle [-].
    """

    begin: np.ndarray
    end: np.ndarray
    node: np.ndarray
    weight: np.ndarray


class Cover:
    """Cover of the nodes of a raster by a flow, at whose edge footprints are cut.

    Parameters
    ----------
    raster : Raster
        Nodes, their statuses and spacing [m].

    Examples
    --------
    A particle of 50 m3, 2 m deep, in the middle of four nodes:

    >>> raster = Raster.from_status(np.zeros((6, 6)), (10.0, 10.0))
    >>> middle = np.array([25.0])
    >>> Cover(raster).footprints(middle, middle, np.array([50.0]), np.array([2.0]), np.array([1.0]))
    (array([0]), array([4]), array([14, 15, 20, 21]), array([0.25, 0.25, 0.25, 0.25]))
    """

    def __init__(self, raster: Raster):
        self._raster = raster
        self._sums = np.zeros((raster.status.size, 2))
        self._touched = np.empty(raster.status.size, np.int64)
        self._last = np.empty((5, 0)), ()  # particles, and their footprints

    def footprints(self, x, y, volume, depth, fraction) -> Footprints:
        """Return the footprints of all particles of a flow, without a new search if no particle has changed since.

        Parameters
        ----------
        x, y : ndarray, shape (n,)
            Position of each particle [m].
        volume, depth : ndarray, shape (n,)
            Its volume [m3] and the vertical depth of the flow there [m].
        fraction : ndarray, shape (n,)
            Part of that depth that is of the own phase [-].

        Returns
        -------
        Footprints
        """
        given = x, y, volume, depth, fraction
        if x.size != self._last[0].shape[1] or x.size == 0 or _changed(self._last[0], *given):
            self._last = _find_footprints(self._raster, *given, self._sums, self._touched)
        return self._last[1]


def scatter(footprints: Footprints, values, sums, touched):
    """Add particles' values to nodes.

    Parameters
    ----------
    footprints : Footprints
        Of the n particles, or of more, the first n of which are meant.
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
    return touched[: _scatter(footprints, values, sums, touched)]


@kernel
def _changed(particles, x, y, volume, depth, fraction):
    """Compare particles with copies of earlier ones, shape (5, n); return whether any number differs."""
    for i in range(x.size):
        if particles[0, i] != x[i] or particles[1, i] != y[i]:
            return True
        if particles[2, i] != volume[i] or particles[3, i] != depth[i] or particles[4, i] != fraction[i]:
            return True
    return False


@kernel
def _find_footprints(raster, x, y, volume, depth, fraction, sums, touched):
    """Spread the area of particles over nodes by hat functions, and cut these where too little is covered.

    Parameters
    ----------
    raster : Raster
        Nodes, their statuses and spacing [m].
    x, y, volume, depth, fraction : ndarray, shape (n,)
        Position [m], volume [m3], depth of the flow [m] and fraction of the own phase [-] of each particle.
    sums : ndarray, shape (nodes, 2)
        Scratch: area [m2] and volume [m3] that lie on the nodes; 0 before and after.
    touched : ndarray of int, shape (nodes,)
        Scratch: nodes with an area.

    Returns
    -------
    particles : ndarray, shape (5, n)
        Copy of the five arrays of particles.
    footprints : Footprints
    """
    status, columns, rows, dx, dy = raster
    particles, half_width, area = np.empty((5, x.size)), np.empty(x.size), volume / depth
    most, found, cell = 0, 0, dx * dy
    for i in range(x.size):
        particles[0, i], particles[1, i], particles[2, i] = x[i], y[i], volume[i]
        particles[3, i], particles[4, i] = depth[i], fraction[i]
        half_width[i] = 2.0 * np.sqrt(area[i] / fraction[i])
        ax, ay = min(max(half_width[i], dx), WIDEST * dx), min(max(half_width[i], dy), WIDEST * dy)
        most += (int(2.0 * ax / dx) + 1) * (int(2.0 * ay / dy) + 1)
    begin, end = np.empty(x.size, np.int64), np.empty(x.size, np.int64)
    node, weight, last = np.empty(most, np.int64), np.empty(most), 0
    for i in range(x.size):
        begin[i], total, xi, yi = last, 0.0, x[i], y[i]
        ax, ay = min(max(half_width[i], dx), WIDEST * dx), min(max(half_width[i], dy), WIDEST * dy)
        west, east = max(int(np.ceil((xi - ax) / dx)), 0), min(int(np.floor((xi + ax) / dx)), columns - 1)
        south, north = max(int(np.ceil((yi - ay) / dy)), 0), min(int(np.floor((yi + ay) / dy)), rows - 1)
        per_x, per_y = 1.0 / ax, 1.0 / ay
        for r in range(south, north + 1):
            wy = 1.0 - abs(yi - r * dy) * per_y
            for c in range(west, east + 1):
                at = r * columns + c
                w = wy * (1.0 - abs(xi - c * dx) * per_x)
                if status[at] == CORE and w > 0.0:
                    node[last], weight[last] = at, w
                    total += w
                    last += 1
        scale = 1.0 / total
        for k in range(begin[i], last):
            at = node[k]
            weight[k] *= scale
            if sums[at, 0] == 0.0:
                touched[found] = at
                found += 1
            sums[at, 0] += area[i] * weight[k]
            sums[at, 1] += volume[i] * weight[k]
        end[i] = last
    for i in range(x.size):
        least, largest, deepest = np.inf, 0.0, depth[i] * cell
        for k in range(begin[i], end[i]):
            least, largest = min(least, sums[node[k], 0]), max(largest, sums[node[k], 0])
            deepest = max(deepest, sums[node[k], 1])
        bound = ROUNDING * min(NARROW * largest, COVERED * cell * np.sqrt(depth[i] * cell / deepest))
        if least < bound:
            kept, total = begin[i], 0.0
            for k in range(begin[i], end[i]):
                if sums[node[k], 0] >= bound:
                    node[kept], weight[kept] = node[k], weight[k]
                    total += weight[k]
                    kept += 1
            end[i] = kept
            scale = 1.0 / total
            for k in range(begin[i], kept):
                weight[k] *= scale
    for k in range(found):
        sums[touched[k], 0] = sums[touched[k], 1] = 0.0
    return particles, (begin, end, node[:last], weight[:last])


@kernel
def _scatter(footprints, values, sums, touched):
    """Add amounts of particles to sums over nodes; return the number of nodes reached.

    Parameters
    ----------
    footprints : Footprints
        Of the n particles at least.
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
    begin, end, node, weight = footprints
    found = 0
    for i in range(values.shape[0]):
        if values[i, 0] <= 0.0:
            continue
        for k in range(begin[i], end[i]):
            at = node[k]
            if sums[at, 0] == 0.0:
                touched[found] = at
                found += 1
            for v in range(values.shape[1]):
                sums[at, v] += weight[k] * values[i, v]
    return found
