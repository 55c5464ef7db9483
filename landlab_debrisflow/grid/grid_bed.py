"""The fields of a grid as the bed of the model, and the terrain as the last call left it."""

from dataclasses import dataclass, replace

import numpy as np

from ..physics.material import Material
from ..spatial.raster import CLOSED, Raster
from ..terrain.bed import Bed
from ..terrain.bed_pressure import BedPressure
from ..terrain.surface import Surface
from .inflow_lines import check_strips
from .release import take_off


@dataclass
class GridBed:
    """The ground a component works on, from call to call.

    Arrays over nodes are changed in place, everything else is replaced.

    Attributes
    ----------
    material : Material
        Densities and porosities of the component.
    eroded : ndarray, shape (nodes,)
        Depth eroded in all calls [m]; not the field, which other components may change.
    event_eroded : ndarray, shape (nodes,), or None
        Depth eroded in the event before the present call [m].
    elevation : ndarray, shape (nodes,), or None
        As the last call left it [m]; None before the first.
    status : ndarray of uint8, shape (nodes,), or None
        Node statuses as the last call left them; None before the first.
    surface : Surface or None
        Surface of that elevation.
    """

    material: Material
    eroded: np.ndarray
    event_eroded: np.ndarray | None = None
    elevation: np.ndarray | None = None
    status: np.ndarray | None = None
    surface: Surface | None = None

    def copy(self) -> "GridBed":
        """Return a copy that shares the arrays."""
        return replace(self)

    @property
    def arrays(self) -> list:
        """Arrays over nodes that a call changes in place."""
        return [array for array in (self.eroded, self.elevation, self.event_eroded) if array is not None]

    def matches(self, elevation, status) -> bool:
        """Return whether elevation and status are as the last call left them."""
        known = self.elevation is not None
        return known and np.array_equal(self.elevation, elevation) and np.array_equal(self.status, status)

    def is_below(self, release, elevation, status) -> bool:
        """Return whether the ground was raised only where a release takes it off again, since the last call left it.

        The bed of the call is then the same as if a release had been taken from the ground, with the depth less the
        rise: the ground changed only where it fails, and mass at rest elsewhere can stay asleep.

        Parameters
        ----------
        release : Release
        elevation, status : ndarray, shape (nodes,)
            Elevation [m], release included, and node statuses now.
        """
        if self.elevation is None or not np.array_equal(self.status, status):
            return False
        nodes = release.nodes
        raised = elevation != self.elevation
        raised[nodes] = False
        rise, rounding = elevation[nodes] - self.elevation[nodes], np.spacing(np.abs(elevation[nodes]))
        return not raised.any() and bool(np.all((rise >= 0.0) & (rise <= release.depth + rounding)))

    def lay(self, given, rows, inflow, time: float) -> Bed:
        """Take the release off the ground and return the bed below.

        Parameters
        ----------
        given : GridInput
            Its elevation, soil and release fields are changed.
        rows : RowBackup
            Keeps the rows that are changed.
        inflow : Inflow
            Inflow to come; it gets the direction in which the ground falls, if none is given.
        time : float
            Time of the component [s].

        Raises
        ------
        InputError
            If the inflow would enter where there is no core node.
        """
        terrain, soil, release = given.terrain, given.soil, given.release
        closed = terrain.status == CLOSED
        if terrain.changed:
            self.elevation, self.status = terrain.elevation.copy(), terrain.status
        if terrain.changed or closed.any():  # elevations filled into closed nodes follow those of the nodes around
            self.surface = None
        if release.nodes.size:
            failing = release.nodes // terrain.shape[1]
            rows.keep_rows(failing.min(), failing.max() + 1)
            take_off(release, terrain.elevation, soil.depth)
            if self.surface is not None:
                self.surface.move_to(release.nodes, terrain.elevation[release.nodes])
        if self.surface is None:
            shape = terrain.shape
            self.surface = Surface(terrain.elevation.reshape(shape), terrain.spacing, closed.reshape(shape))
        inflow.aim(self.surface)
        check_strips(terrain, inflow)
        if given.new_event:
            self.event_eroded = None
        return self._bed(terrain, soil, time)

    def lay_again(self, terrain, soil, time: float, accounts, pressure) -> Bed:
        """Return the bed of a call that has begun, with its accounts; the surface is made of the elevation it had then.

        Parameters
        ----------
        terrain : Terrain
        soil : Soil
        time : float
            Time of the component [s].
        accounts, pressure : mapping
            As `Bed.variables` and `BedPressure.variables` returned them, values by name; empty: of no call.
        """
        bed = self._bed(terrain, soil, time)
        if accounts:
            bed.set_variables(accounts)
        if pressure:
            bed.pore_pressure.set_variables(pressure)
        shape, closed = terrain.shape, terrain.status == CLOSED
        surface = Surface(bed.elevation_before.reshape(shape), terrain.spacing, closed.reshape(shape))
        lowered, *_ = bed.lowered
        surface.move_to(lowered, bed.elevation[lowered])
        self.surface = bed.surface = surface
        return bed

    def _bed(self, terrain, soil, time) -> Bed:
        material, pore_pressure = self.material, None
        raster = Raster.from_status(terrain.status.reshape(terrain.shape), terrain.spacing)
        if soil.pressure is not None:
            drainage_time = np.inf if material.bed_drainage_time is None else material.bed_drainage_time
            loading = material.bed_loading_coefficient
            pore_pressure = BedPressure(raster, soil.pressure, loading, drainage_time, time)
            ratio = pore_pressure.ratio
        elif soil.pressure_ratio is None:
            ratio = np.array([material.bed_pressure_ratio])
        else:
            ratio = np.array(soil.pressure_ratio, float)
        saturation = np.array(material.bed_degree_of_saturation if soil.saturation is None else soil.saturation, float)
        return Bed(
            raster, self.surface, terrain.elevation, soil.depth, self.eroded, ratio, soil.drained, pore_pressure,
            self.event_eroded, np.atleast_1d(saturation) if np.any(saturation < 1.0) else None,
        )  # fmt: skip

    def note_end(self, bed: Bed, nodes: slice) -> None:
        """Note elevation and erosion at the end of a call, which changed them at some nodes only."""
        self.elevation[nodes] = bed.elevation[nodes]
        if self.event_eroded is None:
            self.event_eroded = np.zeros(bed.elevation.size)
        lowered, depth, _ = bed.lowered
        self.event_eroded[lowered] += depth

    def restore_surface(self, elevation, nodes: slice) -> None:
        """Move the surface to an elevation [m] at some nodes that was put back."""
        if self.surface is not None:
            moved = np.arange(nodes.start, nodes.stop)
            moved = moved[self.status[moved] != CLOSED]  # elevations filled into closed nodes never change
            self.surface.move_to(moved, elevation[moved])
