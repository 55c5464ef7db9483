"""Ground before and after an event, as far as maps tell."""

from typing import NamedTuple

import numpy as np
import xarray as xr

from ..core.errors import InputError
from ..grid.fields import OUTPUT_PREFIX
from ..record.written_maps import ELEVATION_BEFORE, RELEASED_DEPTH

ELEVATION = "topographic__elevation"
RELEASE_DEPTH = f"{OUTPUT_PREFIX}release_depth"
"""Depth that is yet to fail, in maps before the event [m]."""


class GroundProfile(NamedTuple):
    """Surfaces of an event over the map [m].

    Attributes
    ----------
    before : xarray.DataArray
        Ground before the event; without `is_exact`, ground after it without erosion and deposit.
    bed : xarray.DataArray
        Ground after the event, without the deposit.
    after : xarray.DataArray
        Ground after the event.
    peak : xarray.DataArray
        Surface of the flow at its peak, above the bed.
    is_exact : bool
        Whether the ground before is known: else the scar of the release is in it.
    """

    before: xr.DataArray
    bed: xr.DataArray
    after: xr.DataArray
    peak: xr.DataArray
    is_exact: bool


def ground_of(maps: xr.Dataset, before: xr.Dataset | xr.DataArray | None = None) -> GroundProfile:
    """Return the surfaces of an event.

    Parameters
    ----------
    maps : xarray.Dataset
        As `DebrisFlow.maps` returns them, or read from their file.
    before : xarray.Dataset or xarray.DataArray, optional
        Maps or elevation before the event [m]; by default those kept with the maps, if there are any.

    Returns
    -------
    GroundProfile

    Raises
    ------
    InputError
        If the maps have no elevation.
    """
    elevation = elevation_of(maps)
    nothing = xr.zeros_like(elevation)
    deposit = _depth(maps, "deposit_depth", nothing)
    moving = maps.attrs.get("budget_moving")  # stacked maps have lost it
    is_settled = not (float(_depth(maps, "depth", nothing).max()) if moving is None else float(moving)) > 0.0
    bed = elevation - deposit if is_settled else elevation
    after, known = bed + deposit, elevation_before(maps, before)
    peak = bed + np.maximum(_depth(maps, "max_depth", nothing), deposit)
    if known is None:
        return GroundProfile(bed + _depth(maps, "eroded_depth", nothing), bed, after, peak, False)
    return GroundProfile(known, bed, after, peak, True)


def elevation_of(maps: xr.Dataset) -> xr.DataArray:
    """Return the elevation of maps over ``y`` and ``x`` [m].

    Raises
    ------
    InputError
        If there is none.
    """
    if ELEVATION not in maps:
        raise InputError(f"plots: the maps lack {ELEVATION}; give flow.maps whole, or the maps.nc of a run")
    return on_increasing_axes(maps[ELEVATION])


def elevation_before(maps: xr.Dataset, before: xr.Dataset | xr.DataArray | None = None) -> xr.DataArray | None:
    """Return the elevation before the event [m] as it is given or as written maps hold it; None if it is not known."""
    if before is None:
        return on_increasing_axes(maps[ELEVATION_BEFORE]) if ELEVATION_BEFORE in maps else None
    if isinstance(before, xr.Dataset):
        before = elevation_of(before)
    elevation = elevation_of(maps)
    before = on_increasing_axes(before)
    if before.shape != elevation.shape or not all(np.allclose(before[axis], elevation[axis]) for axis in "yx"):
        raise InputError(
            f"plots: before must be over the same nodes as the maps, shape {elevation.shape}, got {before.shape}"
        )
    return before


def elevation_change(maps: xr.Dataset, before: xr.Dataset | xr.DataArray | None = None) -> xr.DataArray:
    """Return the change of elevation [m]: deposit above 0, erosion and the scar below.

    Without the ground before the event: deposit less erosion, which lacks the scar of the release.
    """
    if ELEVATION in maps:
        ground = ground_of(maps, before)
        return ground.after - ground.before
    eroded, deposit = (maps[f"{OUTPUT_PREFIX}{name}"] for name in ("eroded_depth", "deposit_depth"))
    return on_increasing_axes(deposit - eroded)


def release_outline(maps: xr.Dataset, before: xr.Dataset | xr.DataArray | None = None) -> xr.DataArray | None:
    """Return where mass was released, of bool over ``y`` and ``x``; None if that is not known."""
    sources = [(before, RELEASE_DEPTH)] if isinstance(before, xr.Dataset) else []
    for dataset, name in [*sources, (maps, RELEASED_DEPTH)]:
        if name in dataset and bool((released := on_increasing_axes(dataset[name]) > 0.0).any()):
            return released
    return None


def on_increasing_axes(values: xr.DataArray) -> xr.DataArray:
    """Return values over ``y`` and ``x`` that both increase; rasters of a GIS begin in the north.

    Raises
    ------
    InputError
        If they are over other dimensions, or over fewer than two nodes along one.
    """
    if set(values.dims) != {"y", "x"} or min(values.shape) < 2 or not all(axis in values.coords for axis in "yx"):
        sizes = ", ".join(f"{dim}: {size}" for dim, size in values.sizes.items())
        raise InputError(
            f"plots: a map must be over y and x alone, with coordinates and two nodes along both, got {sizes or 'none'}"
        )
    values = values.transpose("y", "x")
    for axis in "yx":
        if values[axis].values[0] > values[axis].values[-1]:
            values = values.isel({axis: slice(None, None, -1)})
    return values


def _depth(maps: xr.Dataset, name: str, nothing: xr.DataArray) -> xr.DataArray:
    """Return a depth of maps [m], 0 where it is missing."""
    full = OUTPUT_PREFIX + name
    return on_increasing_axes(maps[full]).fillna(0.0) if full in maps else nothing
