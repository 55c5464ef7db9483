"""The bed: elevation, erodible soil, and the depth eroded so far.

Every node value is the value at the beginning of the call less the depth eroded since, in one subtraction: rounding
errors do not accumulate over thousands of steps, and elevation and soil move together. The values at the beginning are
copied when a node is first lowered, into its slot (`spatial/slots.py`), so that a large raster costs nothing.
"""

from copy import copy
from typing import NamedTuple

import numpy as np

from ..core.arrays import value_at
from ..core.jit import kernel
from ..core.structs import struct
from ..spatial.footprints import Footprints
from ..spatial.raster import CORE, FIXED_VALUE, Raster
from ..spatial.slots import with_places
from ..spatial.transfer import Cover, scatter
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
    taken : ndarray, shape (slots,)
        Depth eroded in this call [m].
    before : ndarray, shape (slots, 3)
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
    """Demand for soil at the nodes under a flow: scratch of an erosion.

    Attributes
    ----------
    volume : ndarray, shape (slots,)
        Soil asked for [m3]; 0 before and after.
    granted : ndarray, shape (slots, 2)
        Fraction of the demand that the soil can supply, and its pore pressure ratio [-].
    touched : ndarray of int, shape (slots,)
        Slots of nodes with a demand, as many as there are, in order of first touch.
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
        self._cover = Cover(raster)
        self._taken, self._before = np.zeros(0), np.empty((0, 3))  # as in `NodeAccounts`
        self._demand, self._granted, self._touched = np.zeros((0, 1)), np.empty((0, 2)), np.empty(0, np.int64)

    def copy(self) -> "Bed":
        """Return a bed with accounts of its own, on the same elevation, soil and surface."""
        other = copy(self)
        other._taken, other._before = self._taken.copy(), self._before.copy()
        if self.pore_pressure is not None:
            other.pore_pressure = self.pore_pressure.copy()
            other.pressure_ratio = other.pore_pressure.ratio
        return other

    def _fit(self, slots: int) -> None:
        """Make accounts and scratch as long as there are slots."""
        if self._taken.size < slots:
            self._taken, self._before = with_places(self._taken, slots), with_places(self._before, slots)
            self._demand, self._granted = np.zeros((slots, 1)), np.empty((slots, 2))
            self._touched = np.empty(slots, np.int64)

    def _lowered(self):
        """Return the nodes that were lowered in this call, in their order, and their slots."""
        slots = np.flatnonzero(self._taken)
        nodes = self._cover.slots.node[slots]
        order = np.argsort(nodes)
        return nodes[order], slots[order]

    @property
    def lowered(self):
        """Nodes that were lowered in this call, int, shape (k,), and how far, shape (k,) [m]."""
        nodes, slots = self._lowered()
        return nodes, self._taken[slots]

    def variables(self) -> dict:
        """Return the accounts of the call by name, as dimensions and values: of the nodes that were lowered [m]."""
        nodes, slots = self._lowered()
        taken, before = ("lowered", self._taken[slots]), (("ground", "lowered"), self._before[slots].T)
        return {"lowered_node": ("lowered", nodes), "taken": taken, "before": before}

    def set_variables(self, variables) -> None:
        """Restore the accounts of a call that `variables` returned, values by name."""
        slots = self._cover.slots.reach(variables["lowered_node"])
        self._fit(self._cover.slots.count)
        self._taken[slots], self._before[slots] = variables["taken"], variables["before"].T

    @property
    def elevation_before(self):
        """Elevation at the beginning of the call, ndarray, shape (nodes,) [m]."""
        elevation, (nodes, slots) = self.elevation.copy(), self._lowered()
        elevation[nodes] = self._before[slots, 1]
        return elevation

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
        """Return the nodes on which all particles `p` of a flow lie, or would lie if they were at `x`, `y` [m]."""
        return self._cover.footprints(*((p.x, p.y) if x is None else (x, y)), p.volume, p.depth, p.share)

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
        *_, node = footprints
        self._fit(node.size)
        accounts = NodeAccounts(
            soil=self.soil, elevation=self.elevation, eroded_depth=self.eroded_depth, taken=self._taken,
            before=self._before, pressure_ratio=self.pressure_ratio,
        )  # fmt: skip
        demand = Demand(volume=self._demand[:, 0], granted=self._granted, touched=self._touched)
        count, entrained, ratio = _erode(footprints, demanded, self.raster.area, accounts, demand)
        at = node[self._touched[:count]]
        self.surface.move_to(at, self.elevation[at])
        return entrained, ratio

    def eroded_in_event(self, nodes):
        """Return the depth eroded at some nodes since the event began [m]."""
        self._fit(self._cover.slots.count)
        taken = self._taken[self._cover.slots.of_node[nodes]]
        return taken if self._earlier is None else self._earlier[nodes] + taken

    def depth_of(self, footprints: Footprints, volume):
        """Return the nodes under some particles, and the depth that their volume [m3] would have on these nodes [m].

        The footprints are those of all particles; `volume`, shape (n,), is 0 for particles that do not count. Both
        results have one entry per node.
        """
        *_, node = footprints
        self._fit(node.size)
        slots = scatter(footprints, volume[:, None], self._demand, self._touched)
        depth = self._demand[slots, 0] / self.raster.area
        self._demand[slots, 0] = 0.0
        return node[slots], depth

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
        Number of slots touched.
    entrained, ratio : ndarray, shape (n,)
        Volume given to each particle [m3] and its pore pressure ratio [-].
    """
    soil, elevation, eroded_depth, taken, before, pressure_ratio = accounts
    volume, granted, touched = demand
    begin, end, index, weight, nodes = footprints
    entrained, ratio, found = np.zeros(demanded.size), np.zeros(demanded.size), 0
    for i in range(demanded.size):
        if demanded[i] > 0.0:
            for k in range(begin[i], end[i]):
                slot = index[k]
                if volume[slot] == 0.0:
                    touched[found] = slot
                    found += 1
                volume[slot] += weight[k] * demanded[i]
    for k in range(found):
        slot = touched[k]
        node = nodes[slot]
        if taken[slot] == 0.0:
            before[slot, 0], before[slot, 1], before[slot, 2] = soil[node], elevation[node], eroded_depth[node]
        part = min(1.0, (before[slot, 0] - taken[slot]) * area / volume[slot])
        granted[slot, 0], granted[slot, 1] = part, value_at(pressure_ratio, node)
        taken[slot] = min(taken[slot] + part * volume[slot] / area, before[slot, 0])
        soil[node] = before[slot, 0] - taken[slot]
        elevation[node] = before[slot, 1] - taken[slot]
        eroded_depth[node] = before[slot, 2] + taken[slot]
        volume[slot] = 0.0
    for i in range(demanded.size):
        if demanded[i] > 0.0:
            fraction, pressure = 0.0, 0.0
            for k in range(begin[i], end[i]):
                given = weight[k] * granted[index[k], 0]
                fraction += given
                pressure += given * granted[index[k], 1]
            entrained[i] = demanded[i] * fraction
            ratio[i] = pressure / fraction if fraction > 0.0 else 0.0
    return found, entrained, ratio
