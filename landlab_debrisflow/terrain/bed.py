"""The bed: elevation, erodible soil, and the depth eroded so far.

Every node value is the value at the beginning of the call less the depth eroded since, in one subtraction: rounding
errors do not accumulate over thousands of steps, and elevation and soil move together. The values at the beginning are
copied when a node is first lowered, into its slot (`spatial/slots.py`), so that a large raster costs nothing.
"""

from copy import copy

import numpy as np

from ..spatial.footprints import Footprints
from ..spatial.raster import CORE, FIXED_VALUE, Raster
from ..spatial.slots import with_places
from ..spatial.transfer import Cover, scatter
from .soil_accounts import Demand, NodeAccounts, take_soil, taken_at
from .surface import Surface


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

    @property
    def lowered(self):
        """Nodes that were lowered in this call, in their order, how far [m], and their slots, each of shape (k,)."""
        slots = np.flatnonzero(self._taken)
        slots = slots[np.argsort(self._cover.slots.node[slots])]
        return self._cover.slots.node[slots], self._taken[slots], slots

    def variables(self) -> dict:
        """Return the accounts of the call by name, as dimensions and values: of the nodes that were lowered [m]."""
        nodes, taken, slots = self.lowered
        before = ("ground", "lowered"), self._before[slots].T
        return {"lowered_node": ("lowered", nodes), "taken": ("lowered", taken), "before": before}

    def set_variables(self, variables) -> None:
        """Restore the accounts of a call that `variables` returned, values by name."""
        slots = self._cover.slots.reach(variables["lowered_node"])
        self._fit(self._cover.slots.count)
        self._taken[slots], self._before[slots] = variables["taken"], variables["before"].T

    @property
    def elevation_before(self):
        """Elevation at the beginning of the call, ndarray, shape (nodes,) [m]."""
        elevation, (nodes, _, slots) = self.elevation.copy(), self.lowered
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

    def erode(self, footprints: Footprints, demanded, out=None):
        """Take the demanded soil for particles; particles at one node divide the soil left there.

        Parameters
        ----------
        footprints : Footprints
            Footprints of these particles, and of others that follow them.
        demanded : ndarray, shape (n,)
            Volume asked for [m3].
        out : tuple of ndarray, shape (n,), optional
            The two arrays to write; new ones by default.

        Returns
        -------
        entrained : ndarray, shape (n,)
            Volume of soil given [m3], at most `demanded`.
        ratio : ndarray, shape (n,)
            Pore pressure ratio of the soil given [-]; 0 where nothing was.
        """
        entrained, ratio = np.zeros((2, demanded.size)) if out is None else out
        if self.soil is None:
            return entrained, ratio
        *_, node = footprints
        self._fit(node.size)
        accounts = NodeAccounts(
            soil=self.soil, elevation=self.elevation, eroded_depth=self.eroded_depth, taken=self._taken,
            surface=self.surface.values, before=self._before, pressure_ratio=self.pressure_ratio,
        )  # fmt: skip
        demand = Demand(volume=self._demand[:, 0], granted=self._granted, touched=self._touched)
        _, at_edge = take_soil(footprints, demanded, self.raster.area, accounts, demand, entrained, ratio)
        if at_edge:
            self.surface.extend()
        return entrained, ratio

    def eroded_in_event(self, nodes):
        """Return the depth eroded at some nodes since the event began [m]."""
        if self.soil is None:
            return np.zeros(nodes.size) if self._earlier is None else self._earlier[nodes]
        self._fit(self._cover.slots.count)
        taken = taken_at(nodes, self._cover.slots.of_node, self._taken)
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
