"""The fields of the grid as the model's bed, read and checked at every call; nothing here costs a copy of the grid."""

from hashlib import blake2b

import numpy as np

from ..core.parameters import on_nodes
from ..spatial.transfer import Nodes
from ..terrain.bed import Bed
from ..terrain.bed_pressure import BedPressure
from ..terrain.surface import Surface
from . import checks, plausible

BED_PRESSURE = "bed__excess_pore_pressure"


class Ground:
    """What the flow runs over, from call to call.

    Parameters
    ----------
    grid : RasterModelGrid
    physics : Setup
        Whose laws may have parameters that vary in space, and whose material says what pressure the bed has
        where no field does.
    """

    def __init__(self, grid, physics):
        self._grid, self._material = grid, physics.material
        if self._loaded and BED_PRESSURE not in grid.at_node:
            grid.add_zeros(BED_PRESSURE, at="node", units="Pa")
        self._laws = {kind: getattr(physics, kind) for kind in ("friction", "erosion")}
        checks.check_parameters(grid, self._laws)
        self.parameters = None  # by kind, as `Simulation.on` wants them
        self._seen = None  # elevation and status as the last call left them
        self._surface = None  # of that elevation
        self._eroded = None  # in this event before the present call, over nodes [m]; None: nothing
        self.eroded = np.zeros(grid.number_of_nodes)  # in all calls of the component, whatever becomes of its field [m]
        self.elevation = self.soil = self.status = self.bed = None

    @property
    def _loaded(self) -> bool:
        """Whether the bed's pore pressure follows what lies on it."""
        return self._material.bed_loading_coefficient > 0.0

    def read(self) -> bool:
        """Read and check the fields; return whether the terrain differs from what the last call left.

        Raises
        ------
        InputError
            If a value is not usable.
        """
        grid, at = self._grid, self._grid.at_node
        checks.check_types(grid)
        fields = ("topographic__elevation", "soil__depth", "bed__excess_pore_pressure_ratio", "bed__drained")
        present = set(at)  # its get() is a dict's and knows nothing of the fields
        self.elevation, self.soil, self._ratios, self._drained = (at[n] if n in present else None for n in fields)
        self.status = np.array(grid.status_at_node)  # a plain one: Landlab's does not pickle
        changed = self._seen is None or not all(map(np.array_equal, self._seen, (self.elevation, self.status)))
        if changed:
            checks.check_boundaries(grid)
            plausible.check_elevation(grid, self.elevation)
            self._seen, self._surface = (self.elevation.copy(), self.status), None
        checks.check_bed(grid, self.soil, self._ratios, self._drained)
        if self._loaded:
            checks.check_loaded_bed(grid, self._ratios, at[BED_PRESSURE])
        checks.check_parameters(grid, self._laws)
        self.parameters = {kind: on_nodes(law, at) for kind, law in self._laws.items()}
        return changed

    def make_bed(self, time: float, new_event: bool) -> Bed:
        """Return the bed as the fields are now, at some time of the component [s]."""
        grid = self._grid
        closed = (self.status == grid.BC_NODE_IS_CLOSED).reshape(grid.shape)
        if self._surface is None or closed.any():  # what is filled into closed nodes follows those around
            self._surface = Surface(self.elevation.reshape(grid.shape), (grid.dx, grid.dy), closed)
        core = self.status == grid.BC_NODE_IS_CORE
        nodes = Nodes(core, grid.number_of_node_columns, float(grid.dx), float(grid.dy))
        material, pore_pressure = self._material, None
        ratios = np.array([material.bed_pressure_ratio]) if self._ratios is None else np.array(self._ratios, float)
        if self._loaded:
            drainage_time = np.inf if material.bed_drainage_time is None else material.bed_drainage_time
            pressure, loading = grid.at_node[BED_PRESSURE], material.bed_loading_coefficient
            pore_pressure = BedPressure(nodes, pressure, loading, drainage_time, time)
            ratios = pore_pressure.ratio
        if new_event:
            self._eroded = None
        drained = None if self._drained is None else self._drained > 0.0
        self.bed = Bed(
            nodes, self._surface, self.elevation, self.soil, self.eroded, ratios, drained, pore_pressure, self._eroded
        )
        return self.bed

    def fail(self, nodes, depth) -> None:
        """Take what fails, [m] at some nodes, off elevation and soil, and clear the fields that said so."""
        checks.lower_ground(self._grid, nodes, depth, self.soil)
        if self._surface is not None:
            self._surface.move_to(nodes, self.elevation[nodes])

    @property
    def rasters(self):
        """Arrays of its own over nodes that a call changes in place."""
        return [self.eroded, *(self._seen or ())[:1], *(() if self._eroded is None else (self._eroded,))]

    @property
    def draining(self):
        """Arrays that change by themselves, everywhere."""
        return self.bed.pore_pressure.draining if self._loaded else []

    def show(self, nodes: slice, time: float) -> None:
        """Bring what of the bed changes by itself to the present; the flow was nowhere but at `nodes`."""
        if self._loaded:
            self.bed.pore_pressure.finish(time, nodes)

    def remember(self, nodes: slice) -> None:
        """Note how the call leaves the elevation and what it eroded, at the nodes where it did."""
        self._seen[0][nodes] = self.elevation[nodes]
        if self._eroded is None:
            self._eroded = self.bed.taken
        else:
            self._eroded[nodes] += self.bed.taken[nodes]

    def follow(self, nodes: slice) -> None:
        """Bring the surface to the elevation of some nodes, which others have put back."""
        if self._surface is not None:
            those = np.arange(nodes.start, nodes.stop)
            those = those[self.status[those] != self._grid.BC_NODE_IS_CLOSED]  # what is filled into those never changes
            self._surface.move_to(those, self.elevation[those])

    def fingerprint(self, names) -> tuple:
        """Return what differs once anybody has changed statuses, some fields, or fields that laws have values from."""
        at, laws = self._grid.at_node, self._laws.values()
        names = {*names, *(v for law in laws for v in getattr(law, "__dict__", {}).values() if isinstance(v, str))}
        arrays = {name: at[name] for name in names & set(at)}
        places = {name: array.ctypes.data for name, array in arrays.items()}
        arrays["status"] = self._grid.status_at_node
        return places, {name: blake2b(np.ascontiguousarray(array)).digest() for name, array in arrays.items()}
