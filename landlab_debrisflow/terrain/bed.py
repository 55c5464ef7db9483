"""The bed: elevation, what of it may be eroded, and what has been taken.

Every node value is the value at the beginning of the call less what was eroded since, in one
subtraction: rounding does not pile up over thousands of steps, and elevation and soil move together.
"""

import numpy as np

from ..spatial.transfer import Nodes, gather, scatter
from .surface import Surface


class Bed:
    """The ledger of erosion over one call.

    Parameters
    ----------
    nodes : Nodes
        The raster.
    surface : Surface
        Kept in step with `elevation`.
    elevation : ndarray, shape (nodes,)
        Bed elevation [m], changed in place.
    soil : ndarray, shape (nodes,), or None
        Erodible depth [m], changed in place; None: nothing erodes.
    eroded_depth : ndarray, shape (nodes,)
        Cumulative erosion [m], changed in place.
    pressure_ratio : ndarray, shape (nodes,)
        Excess pore pressure of the bed over its liquefaction value [-].
    drained : ndarray of bool, shape (nodes,), or None
        Where a drain holds the excess pore pressure at 0; None: nowhere.
    """

    def __init__(self, nodes: Nodes, surface: Surface, elevation, soil, eroded_depth, pressure_ratio, drained=None):
        self.nodes, self.surface, self.elevation, self.soil = nodes, surface, elevation, soil
        self.eroded_depth, self.pressure_ratio = eroded_depth, pressure_ratio
        self.drained = drained
        self._elevation, self._eroded_depth = elevation.copy(), eroded_depth.copy()
        self._soil = None if soil is None else soil.copy()
        self._taken = np.zeros(elevation.size)  # depth eroded in this call [m]
        self._demand = np.zeros((1, elevation.size))
        self._grant = np.zeros((2, elevation.size))
        self._touched = np.empty(elevation.size, np.int64)

    def erode(self, x, y, spread, wanted):
        """Take soil for particles that ask for it; those on one node share what is left there.

        Parameters
        ----------
        x, y, spread : ndarray, shape (n,)
            Position and tent half-width of each particle [m].
        wanted : ndarray, shape (n,)
            Volume asked for [m3].

        Returns
        -------
        granted : ndarray, shape (n,)
            Volume given [m3], at most `wanted`.
        ratio : ndarray, shape (n,)
            Pore pressure ratio of the soil given [-]; 0 where nothing was.
        """
        granted, ratio = np.zeros((2, x.size))
        asking = np.flatnonzero(wanted > 0.0)
        if self.soil is None or asking.size == 0:
            return granted, ratio
        x, y, spread, wanted = x[asking], y[asking], spread[asking], wanted[asking]
        area = self.nodes.area
        at = scatter(self.nodes, x, y, spread, wanted[None, :], self._demand, self._touched)
        demand = self._demand[0, at]
        left = (self._soil[at] - self._taken[at]) * area
        share = np.minimum(1.0, left / demand)
        self._grant[0, at], self._grant[1, at] = share, share * self.pressure_ratio[at]
        got, got_ratio = gather(self.nodes, x, y, spread, self._grant)
        self._take(at, share * demand / area)
        self._demand[0, at] = 0.0
        self._grant[:, at] = 0.0
        granted[asking], ratio[asking] = wanted * got, got_ratio / np.where(got > 0.0, got, 1.0)
        return granted, ratio

    def is_drained(self, x, y):
        """Return whether the node nearest to each particle is drained, or None if there is no drain anywhere."""
        if self.drained is None:
            return None
        nodes = self.nodes
        row, column = np.floor(y / nodes.dy + 0.5).astype(int), np.floor(x / nodes.dx + 0.5).astype(int)
        return self.drained[row * nodes.columns + column]

    def _take(self, at, depth):
        taken = np.minimum(self._taken[at] + depth, self._soil[at])
        self._taken[at] = taken
        self.soil[at] = self._soil[at] - taken
        self.elevation[at] = self._elevation[at] - taken
        self.eroded_depth[at] = self._eroded_depth[at] + taken
        self.surface.move_to(at, self.elevation[at])

    def depth_of(self, x, y, spread, volume):
        """Return the nodes under some particles and the depth their volume [m3] would have there [m]."""
        at = scatter(self.nodes, x, y, spread, volume[None, :], self._demand, self._touched).copy()
        depth = self._demand[0, at] / self.nodes.area
        self._demand[0, at] = 0.0
        return at, depth

    def lay_down(self, x, y, spread, volume):
        """Add the particles' volume [m3] to elevation and soil; return the nodes and the depth added [m]."""
        at, depth = self.depth_of(x, y, spread, volume)
        self.elevation[at] += depth
        if self.soil is not None:
            self.soil[at] += depth
        self.surface.move_to(at, self.elevation[at])
        return at, depth
