"""Refusals of checkpoints with contents that no flow has: kernels read no number of them unchecked."""

from collections import ChainMap

import numpy as np

from ..core.errors import InputError
from ..model.time_step import StepLimits
from ..physics.contracts import WATER

FREE = {
    "particle", "released", "released_part", "body_number", "exit_node", "grain", "partner", "generation",
    "budget_stretch", "budget_kept", "budget_backed_up", "budget_begin_and_end",
}  # fmt: skip
"""Dimensions whose size depends on the moment."""

CALL = {
    "call_end": (), "call_rows": ("call_begin_and_end",), "bed_lowered_node": ("bed_lowered",),
    "bed_taken": ("bed_lowered",), "bed_before": ("bed_ground", "bed_lowered"),
    "peak_maps_under": ("peak_maps_shown",), "peak_maps_passed": (), "peak_maps_then": (),
}  # fmt: skip
"""Dimensions of the variables that are there if a call has begun."""

LOADED_BED = {
    "bed_pressure_start": (), "bed_pressure_under": ("bed_pressure_loaded",), "bed_pressure_age": ("y", "x"),
    "bed_pressure_load": ("y", "x"), "bed_pressure_ratio": ("y", "x"),
}  # fmt: skip
PARTNERS = {
    "partners_of": ("grain",), "partners_count": ("grain",), "partners_index": ("pair",), "partners_weight": ("pair",),
    "partners_generation": ("generation",),
}  # fmt: skip
SOIL_KEPT = {
    "budget_stretches": ("budget_stretch", "budget_begin_and_end"),
    "budget_copies": ("budget_backed_up", "budget_kept"),
}  # fmt: skip
LIMITS: dict[str, tuple] = {f"limits_{name}": () for name in StepLimits._fields}
TOGETHER = CALL, LOADED_BED, LIMITS, PARTNERS, SOIL_KEPT
"""Variables that are there together or not at all."""

ALONE = dict.fromkeys(("node_event_eroded", "node_known_elevation", "node_known_status"), ("y", "x"))
"""Further variables that are there at some moments."""

FINITE = (
    "x", "y", "z", "velocity", "volume", "depth", "thickness", "least_thickness", "own_thickness", "share",
    "smoothing_length", "usual_length", "density",
)  # fmt: skip
"""Variables of the particles that are finite."""

POSITIVE = "volume", "depth", "thickness", "least_thickness", "share", "smoothing_length", "density"
"""Variables of the particles that are above 0."""


def check_contents(dataset, template, prefix: str, raster_shape, spacing, inflow_rows: int) -> None:
    """Refuse a Dataset that no flow wrote.

    Parameters
    ----------
    dataset : xarray.Dataset
        Contents of a file.
    template : xarray.Dataset
        As `checkpoint.capture` returns it of a flow with the same setup on the same grid, before its first call.
    prefix : str
        Beginning of the names of variables of the particles.
    raster_shape, spacing : tuple
        Rows and columns; dx and dy [m].
    inflow_rows : int
        Rows of particles that flow in altogether.

    Raises
    ------
    InputError
        If a variable is missing, of another type or shape, or has a number that cannot be.
    """
    names = [name for name in template.variables if "field" not in template[name].attrs]
    for group in TOGETHER:
        names += group if any(name in dataset for name in group) else ()
    running = "call_end" in dataset
    for name in names:
        if name not in dataset.variables:
            _refuse(f"it lacks the variable {name!r}")
        if name not in template.variables:
            continue  # its form is checked below
        found, wanted = dataset.variables[name], template.variables[name]
        same = found.dims == wanted.dims and found.dtype.kind == wanted.dtype.kind
        sizes = {dim: size for dim, size in found.sizes.items() if dim not in FREE}
        if not same or any(wanted.sizes[dim] != size for dim, size in sizes.items()):
            _refuse(f"{name!r} is {_words(found)} where {_words(wanted)} is expected")
    for name, dimensions in ChainMap(*TOGETHER, ALONE).items():
        found = dataset.variables.get(name)
        if found is not None and (found.dims != dimensions or found.dtype.kind not in "iuf"):
            _refuse(f"{name!r} is {_words(found)} where numbers over ({', '.join(dimensions)}) are expected")
    read = {name: data.values for name, data in dataset.variables.items()}
    _check_numbers(read, prefix, raster_shape, inflow_rows, running)
    for name in FINITE:
        if not np.isfinite(read[prefix + name]).all():
            _refuse(f"{prefix}{name} is not finite everywhere")
    for name in POSITIVE:
        if not np.all(read[prefix + name] > 0.0):
            _refuse(f"{prefix}{name} is not above 0 everywhere")
    for name, count, step in zip("xy", raster_shape[::-1], spacing, strict=True):
        if not np.all((read[prefix + name] >= -step) & (read[prefix + name] <= count * step)):
            _refuse(f"{prefix}{name} is outside the grid somewhere")
    if not np.isfinite(read["time"]) or read["time"] < 0.0:
        _refuse(f"time is {read['time']} s")
    if "bed_pressure_start" in read:
        start, age = read["bed_pressure_start"], read["bed_pressure_age"]
        if not (0.0 <= start <= read["time"] and np.all((age >= 0.0) & (age <= read["time"] - start))):
            _refuse("bed_pressure_start or bed_pressure_age is later than time")


def _check_numbers(read, prefix, raster_shape, inflow_rows, running) -> None:
    """Refuse numbers that stand for places in arrays and lie outside of them."""
    count, nodes, bodies = read[f"{prefix}x"].size, raster_shape[0] * raster_shape[1], read["bodies_peak"].size
    if not np.array_equal(np.sort(read[f"{prefix}place"]), np.arange(count)):
        _refuse(f"{prefix}place does not number the particles")
    if count and np.any(np.diff(read[f"{prefix}identity"]) <= 0):
        _refuse(f"{prefix}identity does not increase")
    ranges = {
        "identity": (0, int(read["ever"])), "body": (-1, bodies), "origin": (-1, read["origins_x"].size),
        "inflow_row": (-1, inflow_rows), "nearest_node": (0, nodes), "phase": (0, 2),
    }  # fmt: skip
    ranges = {prefix + name: bounds for name, bounds in ranges.items()} | {
        "awake": (0, count + 1), "inflow_rows_entered": (0, inflow_rows + 1),
        "origins_owner": (0, read["origins_x"].size), "origins_node": (0, nodes), "outflow_node": (0, nodes),
        "written": (0, nodes + 1), "node_status": (0, 5), "node_known_status": (0, 5),
    }  # fmt: skip
    if running:
        ranges |= {
            "call_rows": (0, nodes + 1), "bed_lowered_node": (0, nodes), "peak_maps_under": (0, nodes),
            "bed_pressure_under": (0, nodes), "budget_stretches": (0, nodes + 1),
        }  # fmt: skip
    if "partners_of" in read:
        ranges |= {"partners_of": (0, count), "partners_index": (0, max(count, 1))}
        ranges["partners_count"] = (0, read["partners_index"].size + 1)
    for name, (least, end) in ranges.items():
        values = read.get(name, np.zeros(0, int))
        if values.dtype.kind not in "iub" or np.any((values < least) | (values >= end)):
            _refuse(f"{name} has numbers outside [{least}, {end})")
    if "partners_of" in read:
        _check_partners(read, prefix)
    elif np.any(read[f"{prefix}phase"] == WATER):
        _refuse("there is water, but no partners_of")
    for name in ("call_rows", "budget_stretches"):
        ends = read.get(name, np.zeros((0, 2), int))
        if np.any(ends % raster_shape[1]) or np.any(np.diff(ends) < 0):
            _refuse(f"{name} are no stretches of whole rows")
    if running and not np.array_equal(read["node_status"], read.get("node_known_status")):
        _refuse("node_known_status is not node_status, which cannot change in a call")
    if running and "budget_stretches" in read and np.diff(read["budget_stretches"]).sum() != read["budget_copies"].size:
        _refuse("budget_copies does not fit budget_stretches")


def _check_partners(read, prefix) -> None:
    """Refuse grains without their partners among the water, and two phases of which anything sleeps."""
    of, index, phase = read["partners_of"], read["partners_index"], read[f"{prefix}phase"]
    if read["partners_count"].sum() != index.size:
        _refuse("partners_count does not fit partners_index")
    if read["awake"] != phase.size:
        _refuse("of two phases nothing sleeps, but awake is not the number of particles")
    if np.unique(of).size != of.size or np.any(phase[of] == WATER) or np.any(phase[index] != WATER):
        _refuse("partners_of and partners_index are not grains and the water around them")


def _words(variable) -> str:
    sizes = ", ".join(f"{dim} {size}" for dim, size in variable.sizes.items())
    return f"{variable.dtype.name} ({sizes})"


def _refuse(reason: str):
    raise InputError(f"load: the contents of the checkpoint are not those of a flow: {reason}; nothing was loaded")
