"""Results of the model, written into the fields of the grid in place."""

from contextlib import contextmanager
from copy import copy

import numpy as np

from ..model.deposit import extent
from ..model.peak_maps import PeakMaps
from ..spatial.transfer import REACH
from .budget import ModelVolumes, VolumeBudget
from .fields import NODE_FIELDS, OUTPUT_PREFIX, output_fields
from .grid_bed import GridBed
from .interruption import Interruption
from .outputs import DEPOSIT, ERODED
from .row_backup import NodeBackup, RowBackup
from .state import GridState


class FieldWriter:
    """Writes the state of a simulation into the fields of a grid.

    Parameters
    ----------
    grid : RasterModelGrid
        Grid of the component.
    simulation : Simulation
        Model of the component.
    interruption : Interruption
        Deferred while fields are put back.

    Attributes
    ----------
    state : GridState
        Memory of the border.
    rows : RowBackup or None
        Rows as a call found them; None between calls.
    """

    def __init__(self, grid, simulation, interruption: Interruption):
        self._grid, self.simulation, self._interruption = grid, simulation, interruption
        eroded, settled = np.zeros(grid.number_of_nodes), np.zeros(grid.number_of_nodes)
        budget = VolumeBudget(grid.dx * grid.dy)
        self.state = GridState(GridBed(simulation.setup.material, eroded), settled, budget, slice(0, 0))
        self.rows = None

    @property
    def changed_arrays(self) -> list:
        """Arrays over nodes that a call changes in place: fields, and the memory of the border."""
        at, state = self._grid.at_node, self.state
        fields = [np.asarray(at[field.name]) for field in NODE_FIELDS if "out" in field.intent and field.name in at]
        return [*fields, state.settled, *state.grid_bed.arrays]

    @property
    def draining(self) -> list:
        """Arrays over nodes that change in time everywhere, in a call that runs."""
        bed = self.state.bed
        return [] if bed is None or bed.pore_pressure is None else bed.pore_pressure.draining

    @property
    def elevation(self):
        """Elevation of the grid, ndarray, shape (nodes,) [m]."""
        return np.asarray(self._grid.at_node["topographic__elevation"])

    # ---- in a call ----

    def begin(self) -> None:
        """Prepare maps and accounts of a call, after the simulation was put on its bed."""
        state = self.state
        bed = state.bed = self.simulation.bed
        state.peak_maps = self.new_peak_maps()
        soil = None if bed.soil is None else RowBackup([bed.soil], bed.raster.columns)
        state.budget.measure_erosion(bed.raster.core, soil)
        self.keep_rows()
        self.record()

    def new_peak_maps(self) -> PeakMaps:
        """Return peak maps that write into the fields of the grid, from now on."""
        sim, at = self.simulation, self._grid.at_node
        names = [field.name for field in output_fields(sim.setup)]
        fields = {name.removeprefix(OUTPUT_PREFIX): np.asarray(at[name]) for name in names}
        return PeakMaps(sim.bed.raster, fields, sim.setup.numerics.arrival_depth, sim.time)

    def keep_rows(self, *others: RowBackup) -> None:
        """Keep the rows that the next step may change, in further backups too."""
        sim, dy = self.simulation, self._grid.dy
        south, north = extent(sim.particles, sim.state.origins, sim.inflow, sim.bed.raster)
        for backup in (self.rows, self.state.budget, *others) if south <= north else ():
            backup.keep_rows(int(south / dy) - REACH, int(north / dy) + REACH + 2)

    def follow_step(self) -> None:
        """Keep rows after a step, and record the maps if the flow may have moved on since the last update."""
        self.keep_rows()
        if self.state.peak_maps.is_due(self.simulation.time, self.simulation.state.limits.fastest):
            self.record()

    def record(self) -> None:
        """Write the maps of now and of peaks."""
        sim = self.simulation
        p = sim.particles
        self.state.peak_maps.record(p, sim.bed.footprints(p), sim.phases.density(p), sim.time)

    @contextmanager
    def present(self):
        """Write the present into the fields for the time of the block, then restore the fields."""
        sim, state, at = self.simulation, self.state, self._grid.at_node
        model, peak_maps, accounts = sim.state, state.peak_maps, {ERODED, DEPOSIT}
        outputs = {field.name for field in NODE_FIELDS if field.name.startswith(OUTPUT_PREFIX) and field.name in at}
        kept = (
            NodeBackup([at[name] for name in outputs - accounts], self._nodes_near()),
            NodeBackup([at[name] for name in accounts], self.rows.nodes), NodeBackup(self.draining, slice(None)),
        )  # fmt: skip
        sim.state, state.peak_maps = model.copy(), copy(peak_maps)
        try:
            self._write(self.rows.nodes)
            yield
        finally:
            with self._interruption.deferred():
                sim.state, state.peak_maps = model, peak_maps
                for backup in kept:
                    backup.restore()

    def _nodes_near(self):
        """Return the nodes at which maps of the present may differ from the fields."""
        p, bed = self.simulation.particles, self.simulation.bed
        columns, count = bed.raster.columns, bed.raster.core.size
        below, _ = bed.depth_of(bed.footprints(p), p.volume)
        nodes = np.concatenate([below, self.state.peak_maps.under])
        if nodes.size == 0:
            return nodes
        first = max(0, int(nodes.min()) - columns)
        # np.unique, which sorts, takes ten times as long
        marked = np.zeros(min(count, int(nodes.max()) + columns + 1) - first, bool)
        for k in (0, 1, -1, columns, -columns):  # closed nodes at their faces included
            beside = nodes + (k - first)
            marked[beside[(beside >= 0) & (beside < marked.size)]] = True
        return first + np.flatnonzero(marked)

    def _write(self, nodes: slice) -> None:
        """Bring columns, bed and fields to the present; accounts of erosion and deposit at some nodes."""
        sim, state, at = self.simulation, self.state, self._grid.at_node
        sim.catch_up()
        self.record()
        if state.bed.pore_pressure is not None:
            state.bed.pore_pressure.finish(sim.time, self.rows.nodes)
        at[ERODED][nodes], at[DEPOSIT][nodes] = state.grid_bed.eroded[nodes], state.settled[nodes]
        resting, depth = sim.resting_depth()
        at[DEPOSIT][resting] += depth

    # ---- the end of a call ----

    def close(self, settle: bool = False) -> None:
        """Write the present for good and note the terrain, so that the next call sees changes made in between.

        `settle` tells whether the mass at rest is laid into the terrain first.
        """
        state = self.state
        with self._interruption.deferred():
            if settle:
                self._settle()
            state.budget.measure_erosion(None, None)
            changed, before = self.rows.nodes, state.written
            if changed.stop > 0:
                first = min(before.start, changed.start) if before.stop > 0 else changed.start
                state.written = slice(first, max(before.stop, changed.stop))
            self._write(state.written)  # other components may have written there, too
            state.grid_bed.note_end(state.bed, changed)
            state.bed = state.peak_maps = None

    def _settle(self) -> None:
        sim, state = self.simulation, self.state
        sim.catch_up()
        self.record()
        state.budget.measure_erosion(None, None)  # the deposit is added to the soil, too
        elevation = RowBackup([state.bed.elevation], state.bed.raster.columns)
        self.keep_rows(elevation)
        nodes, depth = sim.settle()
        state.budget.count_deposit(state.bed.raster.core, elevation)
        state.settled[nodes] += depth
        state.peak_maps.clear()

    # ---- accounts over all calls ----

    def accounts(self) -> dict:
        """Return the depths eroded and deposited so far, by the names of their fields, each (nodes,) [m]."""
        deposit, (nodes, depth) = self.state.settled.copy(), self.simulation.resting_depth()
        deposit[nodes] += depth
        return {ERODED: self.state.grid_bed.eroded, DEPOSIT: deposit}

    def carried_volume(self) -> float:
        """Return the volume of all particles [m3]."""
        return float(self.simulation.particles.volume.sum())

    def model_volumes(self) -> ModelVolumes:
        """Return the volumes that the model measures."""
        sim = self.simulation
        moving_solid = float(sim.phases.solid_volume(sim.particles).sum())
        inflow, outflow, settled = sim.inflow.volume, sim.state.outflow, sim.state.settled_solid
        return ModelVolumes(self.carried_volume(), inflow, outflow.total, moving_solid, settled, outflow.solid)

    def continue_from(self, earlier: "FieldWriter") -> None:
        """Go on with the clock and the accounts of an earlier component that holds no particles any more."""
        model, before = self.simulation.state, earlier.simulation.state
        model.time, model.settled_solid, model.outflow = before.time, before.settled_solid, before.outflow.copy()
        state, former = self.state, earlier.state
        state.budget.continue_from(former.budget, earlier.model_volumes(), former.grid_bed.material)
        state.settled[:], state.grid_bed.eroded[:] = former.settled, former.grid_bed.eroded
        state.written = former.written
