"""The bed: elevation, erodible soil, and the depth eroded so far.

Every node value is the value at the beginning of the call less the depth eroded since, in one subtraction: rounding
errors do not accumulate over thousands of steps, and elevation and soil move together. The values at the beginning are
copied when a node is first lowered, so that a large raster costs nothing.
"""

from copy import copy
from typing import NamedTuple

import numpy as np

from ..core.arrays import value_at
from ..core.jit import kernel
from ..core.structs import struct
from ..spatial.raster import CORE, FIXED_VALUE, Raster
from ..spatial.transfer import Cover, Footprints, scatter
from .surface import Surface


@struct
class NodeAccounts(NamedTuple):
    """Accounts of soil at the nodes of a raster, changed in place.

    Attributes
    ----------
    soil : ndarray, shape (nodes,)
        Erodible depth [m].
    elevation : ndarray, shape (nodes,)
        Elevation of the bed [m].
    eroded_depth : ndarray, shape (nodes,)
        Depth eroded so far [m].
    taken : ndarray, shape (nodes,)
        Depth eroded in this call [m].
    before : ndarray, shape (3, nodes)
        Soil, elevation and eroded depth at the beginning of the call, of nodes that were lowered [m].
    pressure_ratio : ndarray, shape (nodes,) or (1,)
        Pore pressure ratio of the soil [-]; is read only.
    """

    soil: np.ndarray
    elevation: np.ndarray
    eroded_depth: np.ndarray
    taken: np.ndarray
    before: np.ndarray
    pressure_ratio: np.ndarray


@struct
class Demand(NamedTuple):
    """Demand for soil at the nodes of a raster: scratch of an erosion.

    Attributes
    ----------
    volume : ndarray, shape (nodes,)
        Soil asked for [m3]; 0 before and after.
    granted : ndarray, shape (nodes,)
        Fraction of the demand that the soil can supply [-].
    touched : ndarray of int, shape (nodes,)
        Nodes with a demand, as many as there are, in order of first touch.
    """

    volume: np.ndarray
    granted: np.ndarray
    touched: np.ndarray


class Bed:
    """Erosion of the bed over one call.

    Parameters
    ----------
    raster : Raster
        Nodes, their statuses and spacing [m].
    surface : Surface
        Updated with `elevation`.
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
        Pore pressure of the bed, whose ratio `pressure_ratio` then is; it gets the load on the bed.
    earlier : ndarray, shape (nodes,), optional
        Depth eroded in earlier calls of the same event [m]; None without earlier calls.
    saturation : ndarray, shape (nodes,) or (1,), optional
        Degree of saturation of the pores with water [-]; None: saturated everywhere.
    """

    def __init__(
        self, raster: Raster, surface: Surface, elevation, soil, eroded_depth, pressure_ratio, drained=None,
        pore_pressure=None, earlier=None, saturation=None,
    ):  # fmt: skip
        self.raster, self.surface, self.elevation, self.soil = raster, surface, elevation, soil
        self.eroded_depth, self.pressure_ratio = eroded_depth, pressure_ratio
        self.drained, self.pore_pressure = drained, pore_pressure
        self._earlier, self.saturation = earlier, saturation
        self._before = np.empty((3, elevation.size))  # soil, elevation, eroded depth of nodes that were lowered
        self.taken = np.zeros(elevation.size)  # depth eroded in this call [m]
        self._cover = Cover(raster)
        self._demand = np.zeros((elevation.size, 1))
        self._granted = np.empty(elevation.size)
        self._touched = np.empty(elevation.size, np.int64)

    def copy(self) -> "Bed":
        """Return a bed with accounts of its own, on the same elevation, soil and surface."""
        other = copy(self)
        other.taken, other._before = self.taken.copy(), self._before.copy()
        if self.pore_pressure is not None:
            other.pore_pressure = self.pore_pressure.copy()
            other.pressure_ratio = other.pore_pressure.ratio
        return other

    def variables(self) -> dict:
        """Return the accounts of the call by name, as dimensions and values: of the nodes that were lowered [m]."""
        nodes = np.flatnonzero(self.taken)
        return {
            "lowered_node": ("lowered", nodes), "taken": ("lowered", self.taken[nodes]),
            "before": (("ground", "lowered"), self._before[:, nodes]),
        }  # fmt: skip

    def set_variables(self, variables) -> None:
        """Restore the accounts of a call that `variables` returned, values by name."""
        nodes = variables["lowered_node"]
        self.taken[nodes], self._before[:, nodes] = variables["taken"], variables["before"]

    @property
    def elevation_before(self):
        """Elevation at the beginning of the call, ndarray, shape (nodes,) [m]."""
        return np.where(self.taken > 0.0, self._before[1], self.elevation)

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
            Erodible depth [m], changed in place if it is contiguous.
        pressure_ratio : float
            Excess pore pressure of the bed over its liquefaction value [-].
        **others
            As for the class.
        """
        status = np.full(elevation.shape, FIXED_VALUE)
        status[1:-1, 1:-1] = CORE
        eroded = others.pop("eroded_depth", np.zeros(elevation.size))
        soil = None if soil is None else soil.reshape(-1)
        raster, surface = Raster.from_status(status, spacing), Surface(elevation, spacing)
        return cls(raster, surface, elevation.reshape(-1), soil, eroded, np.array([pressure_ratio]), **others)

    def footprints(self, p, x=None, y=None) -> Footprints:
        """Return the nodes on which all particles `p` of a flow lie; the outline of these is the edge of the flow.

        `x` and `y` are positions to suppose instead of those there are, shape (n,) [m].
        """
        x, y = (p.x, p.y) if x is None else (x, y)
        return self._cover.footprints(x, y, p.volume, p.depth, p.share)

    def erode(self, footprints: Footprints, demanded):
        """Take the demanded soil for particles; particles at one node divide the soil left there.

        Parameters
        ----------
        footprints : Footprints
            Footprints of these particles, and of others that follow them.
        demanded : ndarray, shape (n,)
            Volume asked for [m3].

        Returns
        -------
        entrained : ndarray, shape (n,)
            Volume of soil given [m3], at most `demanded`.
        ratio : ndarray, shape (n,)
            Pore pressure ratio of the soil given [-]; 0 where nothing was.
        """
        if self.soil is None:
            return np.zeros(demanded.size), np.zeros(demanded.size)
        accounts = NodeAccounts(
            soil=self.soil, elevation=self.elevation, eroded_depth=self.eroded_depth, taken=self.taken,
            before=self._before, pressure_ratio=self.pressure_ratio,
        )  # fmt: skip
        demand = Demand(volume=self._demand[:, 0], granted=self._granted, touched=self._touched)
        count, entrained, ratio = _erode(footprints, demanded, self.raster.area, accounts, demand)
        at = self._touched[:count]
        self.surface.move_to(at, self.elevation[at])
        return entrained, ratio

    def eroded_in_event(self, nodes):
        """Return the depth eroded at some nodes since the event began [m]."""
        return self.taken[nodes] if self._earlier is None else self._earlier[nodes] + self.taken[nodes]

    def depth_of(self, footprints: Footprints, volume):
        """Return the nodes under some particles, and the depth that their volume [m3] would have on these nodes [m].

        The footprints are those of all particles; `volume`, shape (n,), is 0 for particles that do not count. Both
        results have one entry per node.
        """
        at = scatter(footprints, volume[:, None], self._demand, self._touched).copy()
        depth = self._demand[at, 0] / self.raster.area
        self._demand[at, 0] = 0.0
        return at, depth

    def lay_down(self, nodes, depth):
        """Add a depth [m] to elevation and soil of distinct nodes."""
        self.elevation[nodes] += depth
        if self.soil is not None:
            self.soil[nodes] += depth
        self.surface.move_to(nodes, self.elevation[nodes])


@kernel
def _erode(footprints, demanded, area, accounts, demand):
    """Add up the demand for soil at every node, grant the part that the soil can supply, and lower the node.

    Parameters
    ----------
    footprints : Footprints
        Footprints of the n particles at least.
    demanded : ndarray, shape (n,)
        Volume asked for [m3].
    area : float
        Map area of a node [m2].
    accounts : NodeAccounts
        Soil at the nodes, changed in place.
    demand : Demand
        Scratch of an erosion.

    Returns
    -------
    count : int
        Number of nodes touched.
    entrained, ratio : ndarray, shape (n,)
        Volume given to each particle [m3] and its pore pressure ratio [-].
    """
    soil, elevation, eroded_depth, taken, before, pressure_ratio = accounts
    volume, granted, touched = demand
    begin, end, index, weight = footprints
    entrained, ratio, found = np.zeros(demanded.size), np.zeros(demanded.size), 0
    for i in range(demanded.size):
        if demanded[i] > 0.0:
            for k in range(begin[i], end[i]):
                node = index[k]
                if volume[node] == 0.0:
                    touched[found] = node
                    found += 1
                volume[node] += weight[k] * demanded[i]
    for k in range(found):
        node = touched[k]
        if taken[node] == 0.0:
            before[0, node], before[1, node], before[2, node] = soil[node], elevation[node], eroded_depth[node]
        granted[node] = min(1.0, (before[0, node] - taken[node]) * area / volume[node])
        taken[node] = min(taken[node] + granted[node] * volume[node] / area, before[0, node])
        soil[node] = before[0, node] - taken[node]
        elevation[node] = before[1, node] - taken[node]
        eroded_depth[node] = before[2, node] + taken[node]
        volume[node] = 0.0
    for i in range(demanded.size):
        if demanded[i] > 0.0:
            fraction, pressure = 0.0, 0.0
            for k in range(begin[i], end[i]):
                given = weight[k] * granted[index[k]]
                fraction += given
                pressure += given * value_at(pressure_ratio, index[k])
            entrained[i] = demanded[i] * fraction
            ratio[i] = pressure / fraction if fraction > 0.0 else 0.0
    return found, entrained, ratio
