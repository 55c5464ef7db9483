"""The bed: elevation, erodible soil, and the depth eroded so far.

Every node value is the value at the beginning of the call less what was eroded since, in one
subtraction: rounding does not pile up over thousands of steps, and elevation and soil move together.
Values of the beginning are kept when a node is first lowered: a large raster costs nothing.
"""

from copy import copy

import numpy as np

from ..core.jit import kernel
from ..spatial.transfer import MOST_NODES, Nodes, scatter, weigh
from .surface import Surface


class Bed:
    """Erosion of the bed over one call.

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
    pressure_ratio : ndarray, shape (nodes,) or (1,)
        Excess pore pressure of the bed over its liquefaction value [-].
    drained : ndarray of bool, shape (nodes,), or None
        Where a drain holds the excess pore pressure at 0; None: nowhere.
    pore_pressure : BedPressure, optional
        Of which `pressure_ratio` then is the ratio, and which is told what lies on the bed.
    earlier : ndarray, shape (nodes,), optional
        Depth eroded in calls before this one that belong to the same event [m]; None: there were none.
    """

    def __init__(
        self, nodes: Nodes, surface: Surface, elevation, soil, eroded_depth, pressure_ratio, drained=None,
        pore_pressure=None, earlier=None,
    ):  # fmt: skip
        self.nodes, self.surface, self.elevation, self.soil = nodes, surface, elevation, soil
        self.eroded_depth, self.pressure_ratio = eroded_depth, pressure_ratio
        self.drained, self.pore_pressure = drained, pore_pressure
        self._earlier = earlier
        self._before = np.empty((3, elevation.size))  # soil, elevation, eroded depth of nodes that were lowered
        self.taken = np.zeros(elevation.size)  # depth eroded in this call [m]
        self._demand = np.zeros((elevation.size, 1))
        self._share = np.empty(elevation.size)
        self._touched = np.empty(elevation.size, np.int64)

    def copy(self) -> "Bed":
        """Return a bed with accounts of its own, on the same elevation, soil and surface."""
        other = copy(self)
        other.taken, other._before = self.taken.copy(), self._before.copy()
        if self.pore_pressure is not None:
            other.pore_pressure = self.pore_pressure.copy()
            other.pressure_ratio = other.pore_pressure.ratio
        return other

    @classmethod
    def from_arrays(cls, elevation, spacing, soil=None, pressure_ratio=0.0, **others) -> "Bed":
        """Return a bed made of arrays alone, with open nodes along its edge and core nodes inside.

        Parameters
        ----------
        elevation : ndarray, shape (rows, columns)
            [m], changed in place if it is contiguous.
        spacing : tuple of float
            Node spacing (dx, dy) [m].
        soil : ndarray, shape (rows, columns), optional
            Erodible depth [m], likewise.
        pressure_ratio : float
            Excess pore pressure of the bed over its liquefaction value [-].
        **others
            As for the class.
        """
        core = np.zeros(elevation.shape, bool)
        core[1:-1, 1:-1] = True
        nodes = Nodes(core.ravel(), elevation.shape[1], *map(float, spacing))
        eroded = others.pop("eroded_depth", np.zeros(elevation.size))
        soil = None if soil is None else soil.reshape(-1)
        surface = Surface(elevation, spacing)
        return cls(nodes, surface, elevation.reshape(-1), soil, eroded, np.array([pressure_ratio]), **others)

    def erode(self, x, y, spread, wanted):
        """Take the demanded soil for particles; particles at one node divide the soil left there.

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
        granted, ratio = np.zeros(x.size), np.zeros(x.size)
        if self.soil is None:
            return granted, ratio
        nodes = self.nodes
        count = _erode(
            nodes.core, nodes.columns, nodes.dx, nodes.dy, x, y, spread, wanted, self._before, self.pressure_ratio,
            self._demand[:, 0], self._share, self._touched, self.taken, self.soil, self.elevation,
            self.eroded_depth, granted, ratio,
        )  # fmt: skip
        at = self._touched[:count]
        self.surface.move_to(at, self.elevation[at])
        return granted, ratio

    def eroded_in_event(self, nodes):
        """Return the depth eroded at some nodes since the event began [m]."""
        return self.taken[nodes] if self._earlier is None else self._earlier[nodes] + self.taken[nodes]

    def depth_of(self, x, y, spread, volume):
        """Return the nodes under some particles and the depth their volume [m3] would have there [m]."""
        at = scatter(self.nodes, x, y, spread, volume[:, None], self._demand, self._touched).copy()
        depth = self._demand[at, 0] / self.nodes.area
        self._demand[at, 0] = 0.0
        return at, depth

    def lay_down(self, nodes, depth):
        """Add a depth [m] to elevation and soil of distinct nodes."""
        self.elevation[nodes] += depth
        if self.soil is not None:
            self.soil[nodes] += depth
        self.surface.move_to(nodes, self.elevation[nodes])


@kernel
def _erode(
    core, columns, dx, dy, x, y, spread, wanted, before, pressure_ratio, demand, share, touched, taken,
    soil, elevation, eroded_depth, granted, ratio,
):  # fmt: skip
    """Add up the demand on every node, grant it as far as there is soil, lower the node; return the number of nodes."""
    index, weight = np.empty(MOST_NODES, np.int64), np.empty(MOST_NODES)
    found, area = 0, dx * dy
    for i in range(x.size):
        if wanted[i] > 0.0:
            for k in range(weigh(core, columns, dx, dy, x[i], y[i], spread[i], index, weight)):
                node = index[k]
                if demand[node] == 0.0:
                    touched[found] = node
                    found += 1
                demand[node] += weight[k] * wanted[i]
    for k in range(found):
        node = touched[k]
        if taken[node] == 0.0:
            before[0, node], before[1, node], before[2, node] = soil[node], elevation[node], eroded_depth[node]
        share[node] = min(1.0, (before[0, node] - taken[node]) * area / demand[node])
        taken[node] = min(taken[node] + share[node] * demand[node] / area, before[0, node])
        soil[node] = before[0, node] - taken[node]
        elevation[node] = before[1, node] - taken[node]
        eroded_depth[node] = before[2, node] + taken[node]
        demand[node] = 0.0
    for i in range(x.size):
        if wanted[i] > 0.0:
            part, pressure = 0.0, 0.0
            for k in range(weigh(core, columns, dx, dy, x[i], y[i], spread[i], index, weight)):
                got = weight[k] * share[index[k]]
                part += got
                pressure += got * pressure_ratio[min(index[k], pressure_ratio.size - 1)]
            granted[i] = wanted[i] * part
            ratio[i] = pressure / part if part > 0.0 else 0.0
    return found
