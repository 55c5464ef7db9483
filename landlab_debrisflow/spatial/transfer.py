"""Carry volumes and values between particles and the nodes of a raster.

The rule, used for every field, for erosion, for the load on the bed and for the deposit: a particle is a hat function
(bilinear) whose half-width is twice its own spacing (V/h)^(1/2), never less than the node spacing, never more than four
of them, sharpened at the edge of the flow. Its weights are normalised over the *core* nodes that it reaches, so that no
volume is lost at a boundary or at the edge of the flow, or put outside.

Wide hat functions keep the noise of the particles out of the depth, but blur the edge of the flow over their half-width
a, which is large for coarse particles. The *cover* of a node tells how far the edge is: the map area V/h of the
particles, spread by whole hat functions, over that of the node. Inside a flow it is 1; at a distance d beyond a
straight edge it is (1 - d/a)^2/2, and at the same distance inside the edge 1 less this value. Weights are multiplied by
the cover that hat functions of one node spacing would give at this distance, over the actual cover. So an edge is
blurred by one node, whatever the number of particles (`sharpened_cover`).

The loops run in particle order in one thread: the only sums that several particles share.

Sums over nodes have one place for each slot of a node (`slots`): they take the memory of the flow, not of the raster.
"""

import numpy as np

from ..core.jit import allocating_kernel, inner, kernel
from .footprints import Footprints
from .raster import CORE, Raster
from .slots import Slots

WIDEST = 4.0
"""Largest half-width of a hat function in node spacings."""

MOST_NODES_PER_STEP = 2.0
"""Largest part of a node spacing that a particle may cross in a step (model/numerics.py)."""

REACH = int(WIDEST + MOST_NODES_PER_STEP) + 1
"""Distance in nodes within which a particle writes, after a step, too."""


class Cover:
    """Cover of the nodes of a raster by a flow, at whose edge footprints are sharpened.

    Parameters
    ----------
    raster : Raster
        Nodes, their statuses and spacing [m].

    Examples
    --------
    A particle of 50 m3, 2 m deep, in the middle of four nodes:

    >>> raster = Raster.from_status(np.zeros((6, 6)), (10.0, 10.0))
    >>> middle = np.array([25.0])
    >>> footprints = Cover(raster).footprints(middle, middle, np.array([50.0]), np.array([2.0]), np.array([1.0]))
    >>> from .footprints import on_nodes
    >>> on_nodes(footprints)[:4]
    (array([0]), array([4]), array([14, 15, 20, 21]), array([0.25, 0.25, 0.25, 0.25]))
    """

    def __init__(self, raster: Raster):
        self._raster = raster
        self.slots = Slots(raster.status.size)
        self._area, self._touched = np.zeros(0), np.empty(0, np.int64)
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
            while not self._find(given):
                self.slots.double()
        return self._last[1]

    def _find(self, given) -> bool:
        """Find the footprints of particles; return whether there were slots enough."""
        slots = self.slots
        if self._area.size < slots.count:
            self._area, self._touched = np.zeros(slots.count), np.empty(slots.count, np.int64)
        scratch = slots.of_node, slots.node, slots.used, self._area, self._touched
        *self._last, slots.used, are_enough = _find_footprints(tuple(self._raster), *given, *scratch)
        return are_enough


def scatter(footprints: Footprints, values, sums, touched):
    """Add particles' values to nodes.

    Parameters
    ----------
    footprints : Footprints
        Footprints of the n particles, or of more, of which the first n count.
    values : ndarray, shape (n, k)
        Amounts; the first must be > 0 where a particle counts.
    sums : ndarray, shape (slots, k)
        Zero on entry; the amounts are added.
    touched : ndarray of int, shape (slots,)
        Scratch for the list of slots reached.

    Returns
    -------
    ndarray of int
        Slots of the nodes reached, in order of first touch; all other sums are 0.
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


@inner
def sharpened_cover(cover, blur):
    """Return the cover that hat functions of one node spacing give, where wider ones give `cover` [-].

    Parameters
    ----------
    cover : float
        Map area of a flow at a node, spread by hat functions, over that of the node; at most 1 [-].
    blur : float
        Node spacing over half-width of these hat functions; at most 1 [-].

    Returns
    -------
    float
        Half of (1 - d/dx)^2 at the distance d beyond the edge at which `cover` is half of (1 - d/a)^2; 1 less that
        within the edge.
    """
    outside = min(cover, 1.0 - cover)
    there = 0.5 * max(0.0, 1.0 - (1.0 - np.sqrt(2.0 * outside)) / blur) ** 2
    return there if cover <= 0.5 else 1.0 - there


@allocating_kernel
def _find_footprints(raster, x, y, volume, depth, fraction, slot_of, nodes, used, cover, touched):
    """Spread the area of particles over nodes by hat functions, and sharpen these at the edge of the covered area.

    Parameters
    ----------
    raster : Raster
        Nodes, their statuses and spacing [m].
    x, y, volume, depth, fraction : ndarray, shape (n,)
        Position [m], volume [m3], depth of the flow [m] and fraction of the own phase [-] of each particle.
    slot_of, nodes, used
        Slots of all nodes, nodes of all slots and the number of those in use (`slots.Slots`); nodes without one get
        slots.
    cover : ndarray, shape (slots,)
        Scratch: area that lies on the nodes [m2]; 0 before and after.
    touched : ndarray of int, shape (slots,)
        Scratch: slots of nodes with an area.

    Returns
    -------
    particles : ndarray, shape (5, n)
        Copy of the five arrays of particles.
    footprints : Footprints
    used : int
        Slots in use now.
    are_enough : bool
        Whether there were slots enough; if not, footprints lack the nodes without one.
    """
    status, columns, rows, dx, dy, _ = raster
    particles, half_width, area = np.empty((5, x.size)), np.empty(x.size), volume / depth
    most, found, cell = 0, 0, dx * dy
    for i in range(x.size):
        particles[0, i], particles[1, i], particles[2, i] = x[i], y[i], volume[i]
        particles[3, i], particles[4, i] = depth[i], fraction[i]
        half_width[i] = 2.0 * np.sqrt(area[i] / fraction[i])
        ax, ay = min(max(half_width[i], dx), WIDEST * dx), min(max(half_width[i], dy), WIDEST * dy)
        most += (int(2.0 * ax / dx) + 1) * (int(2.0 * ay / dy) + 1)
    begin, end = np.empty(x.size, np.int64), np.empty(x.size, np.int64)
    slot, weight, last, are_enough = np.empty(most, np.int64), np.empty(most), 0, True
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
                    here = slot_of[at]
                    if here == 0:
                        if used == nodes.size:
                            are_enough = False
                            continue
                        here, slot_of[at], nodes[used] = used, used, at
                        used += 1
                    slot[last], weight[last] = here, w
                    total += w
                    last += 1
        scale = 1.0 / total
        for k in range(begin[i], last):
            at = slot[k]
            weight[k] *= scale
            if cover[at] == 0.0:
                touched[found] = at
                found += 1
            cover[at] += area[i] * weight[k]
        end[i] = last
    for i in range(x.size):
        blur = max(np.sqrt(cell) / half_width[i], 1.0 / WIDEST)
        if blur >= 1.0:  # the hat function has one node spacing already
            continue
        largest = 0.0  # less than the area of a node if the flow is narrower than its hat functions
        for k in range(begin[i], end[i]):
            largest = max(largest, cover[slot[k]])
        kept, total = begin[i], 0.0
        for k in range(begin[i], end[i]):
            covered = cover[slot[k]] / largest
            part = sharpened_cover(covered, blur)
            if part > 0.0:
                slot[kept], weight[kept] = slot[k], weight[k] * (part / covered)
                total += weight[kept]
                kept += 1
        end[i] = kept
        scale = 1.0 / total
        for k in range(begin[i], kept):
            weight[k] *= scale
    for k in range(found):
        cover[touched[k]] = 0.0
    return particles, (begin, end, slot[:last], weight[:last], nodes), used, are_enough


@kernel
def _scatter(footprints, values, sums, touched):
    """Add amounts of particles to sums over nodes; return the number of nodes reached.

    Parameters
    ----------
    footprints : Footprints
        Footprints of the n particles at least.
    values : ndarray, shape (n, k)
        Amounts, in any unit; particles whose first amount is not > 0 are left out.
    sums : ndarray, shape (slots, k)
        Zero on entry; the amounts are added.
    touched : ndarray of int, shape (slots,)
        Written from its beginning: slots in order of first touch. Earlier content is ignored.

    Returns
    -------
    int
        Number of nodes written to `touched`.
    """
    begin, end, slot, weight, _ = footprints
    found = 0
    for i in range(values.shape[0]):
        if values[i, 0] <= 0.0:
            continue
        for k in range(begin[i], end[i]):
            at = slot[k]
            if sums[at, 0] == 0.0:
                touched[found] = at
                found += 1
            for v in range(values.shape[1]):
                sums[at, v] += weight[k] * values[i, v]
    return found
