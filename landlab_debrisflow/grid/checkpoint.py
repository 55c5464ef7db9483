"""A flow as a Dataset, between two calls or between two steps of one, and back.

The Dataset leaves out all that can be computed from its contents: the surface through the nodes, cells of neighbours,
scratch arrays of a step.
"""

import json

import numpy as np
import xarray as xr

from ..core.names import legal_name
from ..model.particle_order import sort_by_identity, sort_by_place
from ..model.state_dataset import from_dataset, to_dataset
from ..model.surroundings import surround
from .fields import fields_in_use
from .row_backup import RowBackup

NODES = ("y", "x")
"""Dimensions of variables at nodes: rows, from the southern one on, and columns."""

PARTICLE, FIELD = "particle_", "field_"
"""Beginnings of the names of variables of the particles, and of fields of the grid."""


def capture(grid, writer, laws, reports, end: float | None) -> xr.Dataset:
    """Return all of a flow that decides how it goes on, except its setup, as a Dataset.

    Parameters
    ----------
    grid : RasterModelGrid
        Grid of the component; its fields are those of now.
    writer : FieldWriter
        Writes the fields of the component; between two calls or between two steps of one.
    laws : mapping of str to object
        Laws that may read fields.
    reports : Reports
        Messages of the component.
    end : float or None
        Time until which the call should go that has begun [s]; None: none has.

    Returns
    -------
    xarray.Dataset
    """
    shape = tuple(map(int, grid.shape))
    sim, state = writer.simulation, writer.state
    data = dict(sort_by_identity(to_dataset(sim.state, PARTICLE), PARTICLE).variables)
    data["cpu_time"] = ("stage", np.array(sim.state.counters.cpu), {"units": "s"})

    def add(prefix, variables):
        for name, (dims, values) in variables.items():
            if dims == "node":
                dims, values = NODES, np.reshape(values, shape)
            elif dims and not isinstance(dims, str):
                dims = tuple(f"{prefix}{dim}" for dim in dims)
            elif dims:
                dims = f"{prefix}{dims}"
            data[f"{prefix}{name}"] = (dims, values)

    for name, values in fields_in_use(grid, laws).items():
        words = {"field": name, "units": grid.at_node.units.get(name, "?")}
        data[f"{FIELD}{legal_name(name)}"] = (NODES, np.asarray(values).reshape(shape), words)
    ground = state.grid_bed
    nodes = {"status": np.asarray(grid.status_at_node), "settled": state.settled, "eroded": ground.eroded}
    nodes |= {"event_eroded": ground.event_eroded, "known_elevation": ground.elevation, "known_status": ground.status}
    nodes["drained"] = None if sim.bed is None else sim.bed.drained
    add("node_", {name: ("node", values) for name, values in nodes.items() if values is not None})
    add("", {"written": ("begin_and_end", np.array([state.written.start, state.written.stop]))})
    add("budget_", state.budget.variables())
    add("reports_", reports.variables())
    if end is not None:
        bed, rows = state.bed, writer.rows.nodes
        add("call_", {"end": ((), end), "rows": ("begin_and_end", np.array([rows.start, rows.stop]))})
        add("bed_", bed.variables())
        add("peak_maps_", state.peak_maps.variables())
        if bed.pore_pressure is not None:
            add("bed_pressure_", bed.pore_pressure.variables())
    spacing, corner = (float(grid.dx), float(grid.dy)), tuple(map(float, grid.xy_of_lower_left))
    for axis, first, step, count in zip("xy", corner, spacing, shape[::-1], strict=True):
        data[axis] = (axis, first + step * np.arange(count), {"units": "m"})
    return xr.Dataset(data, attrs={"spacing": spacing, "lower_left": corner, "warned": json.dumps(state.warned)})


def restore(writer, reader, reports, dataset: xr.Dataset) -> float | None:
    """Put a flow that was just built into the state of a Dataset, whose fields the grid has already.

    Parameters
    ----------
    writer : FieldWriter
        Writes the fields of the component.
    reader : GridReader
        Reads the fields of the component.
    reports : Reports
        Messages of the component.
    dataset : xarray.Dataset
        As `capture` returned it, of a flow with the same setup on the same raster.

    Returns
    -------
    float or None
        Time until which the call should go that had begun [s]; the writer is then between two of its steps.
    """
    sim, state = writer.simulation, writer.state
    read = {name: data.values for name, data in dataset.variables.items()}
    sim.state = from_dataset(sort_by_place(dataset, PARTICLE), sim.state, PARTICLE)
    sim.state.counters.cpu = read["cpu_time"].tolist()

    def named(prefix):
        return {n.removeprefix(prefix): values for n, values in read.items() if n.startswith(prefix)}

    nodes = {name: np.array(values).reshape(-1) for name, values in named("node_").items()}
    ground = state.grid_bed
    state.settled[:], ground.eroded[:] = nodes["settled"], nodes["eroded"]
    ground.event_eroded, ground.elevation, ground.status = (
        nodes.get(name) for name in ("event_eroded", "known_elevation", "known_status")
    )
    state.written, state.warned = slice(*read["written"].tolist()), tuple(json.loads(dataset.attrs["warned"]))
    reports.set_variables(named("reports_"))
    running, budget = "call_end" in read, named("budget_")
    if ground.status is None:  # no call has begun yet
        state.budget.set_variables(budget, None, None)
        return None
    terrain, soil, parameters = reader.read_again(ground.status, nodes.get("drained"))
    pressure = {name: v.reshape(-1) if v.ndim == 2 else v for name, v in named("bed_pressure_").items()}
    accounts = named("bed_") if running else {}
    bed = ground.lay_again(terrain, soil, sim.time, accounts, pressure)
    sim.surroundings = surround(sim.setup, sim.phases, bed, parameters)
    if not running:
        state.budget.set_variables(budget, None, None)
        return None
    state.bed = bed
    state.peak_maps = writer.new_peak_maps()
    state.peak_maps.set_variables(named("peak_maps_"))
    soil = None if bed.soil is None else RowBackup([bed.soil], bed.raster.columns)
    state.budget.set_variables(budget, bed.raster.core, soil)
    writer.rows = RowBackup(writer.changed_arrays, bed.raster.columns)
    writer.rows.keep_nodes(slice(*read["call_rows"].tolist()))
    return float(read["call_end"])
