"""The fields of the grid as the model's bed, read and checked at every call; nothing here costs a copy of the grid."""

import numpy as np

from . import inputs
from .core.parameters import on_nodes
from .core.variables import OUTPUT_PREFIX
from .spatial.transfer import Nodes
from .terrain.bed import Bed
from .terrain.surface import Surface


class Ground:
    """What the flow runs over, from call to call.

    Parameters
    ----------
    grid : RasterModelGrid
    physics : Physics
        Whose laws may have parameters that vary in space, and whose material says what pressure the bed has
        where no field does.
    """

    def __init__(self, grid, physics):
        self._grid, self._ratio = grid, np.array([physics.material.bed_pressure_ratio])
        self._laws = {kind: getattr(physics, kind) for kind in ("friction", "erosion")}
        inputs.check_parameters(grid, self._laws)
        self.parameters = None  # by kind, as `Simulation.on` wants them
        self._seen = None  # elevation and status as the last call left them
        self._surface = None  # of that elevation
        self.elevation = self.soil = self.status = self.bed = None

    def read(self) -> bool:
        """Read and check the fields; return whether the terrain differs from what the last call left.

        Raises
        ------
        InputError
            If a value is not usable.
        """
        grid, at = self._grid, self._grid.at_node
        fields = ("topographic__elevation", "soil__depth", "bed__excess_pore_pressure_ratio", "bed__drained")
        present = set(at)  # its get() is a dict's and knows nothing of the fields
        self.elevation, self.soil, self._ratios, self._drained = (at[n] if n in present else None for n in fields)
        self.status = grid.status_at_node.copy()
        changed = self._seen is None or not all(map(np.array_equal, self._seen, (self.elevation, self.status)))
        if changed:
            inputs.check_boundaries(grid)
            inputs.check_elevation(grid, self.elevation)
            self._seen, self._surface = (self.elevation.copy(), self.status), None
        inputs.check_bed(grid, self.soil, self._ratios, self._drained)
        inputs.check_parameters(grid, self._laws)
        self.parameters = {kind: on_nodes(law, at) for kind, law in self._laws.items()}
        return changed

    def make_bed(self) -> Bed:
        """Return the bed as the fields are now."""
        grid = self._grid
        closed = (self.status == grid.BC_NODE_IS_CLOSED).reshape(grid.shape)
        if self._surface is None or closed.any():  # what is filled into closed nodes follows those around
            self._surface = Surface(self.elevation.reshape(grid.shape), (grid.dx, grid.dy), closed)
        core = self.status == grid.BC_NODE_IS_CORE
        nodes = Nodes(core, grid.number_of_node_columns, float(grid.dx), float(grid.dy))
        ratios = self._ratio if self._ratios is None else np.array(self._ratios, float)
        drained = None if self._drained is None else self._drained > 0.0
        eroded_depth = grid.at_node[OUTPUT_PREFIX + "eroded_depth"]
        self.bed = Bed(nodes, self._surface, self.elevation, self.soil, eroded_depth, ratios, drained)
        return self.bed

    def fail(self, nodes, depth) -> None:
        """Take what fails, [m] at some nodes, off elevation and soil, and clear the fields that said so."""
        inputs.lower_ground(self._grid, nodes, depth, self.soil)
        if self._surface is not None:
            self._surface.move_to(nodes, self.elevation[nodes])

    def remember(self, nodes: slice) -> None:
        """Note how the call leaves the elevation; only `nodes` may have changed."""
        self._seen[0][nodes] = self.elevation[nodes]

    def forget(self) -> None:
        """Read everything anew at the next call."""
        self._seen = self._surface = None
