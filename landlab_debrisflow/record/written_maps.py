"""Maps for files: thin peaks masked, with their place on the earth and the checksum of the terrain."""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ..core.checks import in_range
from ..core.errors import InputError
from ..grid.fields import OUTPUT_PREFIX
from ..model.map_fields import PEAKS
from .attributes import quantity_attributes
from .datasets import ON_WALLS
from .files import write_dataset
from .georeference import georeferenced

LEAST_DEPTH = 0.05
"""Depth below which peaks are masked in written maps [m]."""

PEAK_DEPTH = OUTPUT_PREFIX + "max_depth"

ELEVATION_BEFORE, RELEASED_DEPTH = "topographic__elevation_before", OUTPUT_PREFIX + "released_depth"
"""Maps of a run in its file beside those of the flow: ground before the event, and depth that was released [m]."""


def mask_peaks(maps: xr.Dataset, least_depth: float = LEAST_DEPTH) -> xr.Dataset:
    """Return maps whose peaks are missing (NaN) where the flow was never as deep as a least depth.

    A film of a millimetre at full speed would be misleading in a hazard map. Closed nodes keep the impact pressure
    and run-up at their faces, where there were any.

    Parameters
    ----------
    maps : xarray.Dataset
        As `DebrisFlow.maps` returns them; they are not changed.
    least_depth : float
        Least peak depth [m], >= 0; 0 masks only nodes that no debris reached.

    Returns
    -------
    xarray.Dataset
        With an attribute ``peaks_masked_below`` [m].

    Raises
    ------
    InputError
        If the maps lack the peak depth or the depth is not usable.
    """
    in_range("mask_peaks: least_depth", least_depth, 0.0, unit="m", error=InputError)
    if PEAK_DEPTH not in maps:
        raise InputError(f"mask_peaks: the maps lack {PEAK_DEPTH}; give flow.maps whole")
    peak = maps[PEAK_DEPTH]
    reached = (peak >= least_depth) & (peak > 0.0)
    masked = {}
    for name in (OUTPUT_PREFIX + short for short in PEAKS):
        if name in maps:
            at_face = np.isnan(peak) & (maps[name] > 0.0) if name in ON_WALLS else False
            masked[name] = maps[name].where(reached | at_face)
    return maps.assign(masked).assign_attrs(quantity_attributes("peaks_masked_below", float(least_depth), "m"))


def write_maps(
    path: str | os.PathLike[str],
    maps: xr.Dataset,
    *,
    crs: str | None = None,
    least_depth: float = LEAST_DEPTH,
    attributes: Mapping[str, Any] | None = None,
) -> Path:
    """Write maps as CF NetCDF with all parameters and their place on the earth, atomically.

    Parameters
    ----------
    path : str or os.PathLike
        The file; it is replaced if it exists.
    maps : xarray.Dataset
        As `DebrisFlow.maps` returns them, with versions, date, setup and its digest as attributes.
    crs : str, optional
        Coordinate reference system, as WKT or such as ``"EPSG:32633"``.
    least_depth : float
        Peaks are masked where the flow was never as deep [m]; see `mask_peaks`.
    attributes : mapping, optional
        Further attributes, such as ``{"terrain_file": "dem.tif", "terrain_sha256": "9f86d0..."}``.

    Returns
    -------
    pathlib.Path
        Where the file is.

    Raises
    ------
    InputError
        If the file cannot be written, an attribute cannot be kept in a file, or the system is not known.
    """
    further: dict[str, Any] = {}
    for name, value in (attributes or {}).items():
        if not (kept := quantity_attributes(name, value)):
            raise InputError(f"write_maps: attribute {name!r} must be a text or a number, got {value!r}")
        further |= kept
    return write_dataset(path, georeferenced(mask_peaks(maps, least_depth).assign_attrs(further), crs))
