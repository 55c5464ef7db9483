"""Rasters in NetCDF, among them maps of this package."""

import warnings
from collections.abc import Hashable
from pathlib import Path
from typing import Any

import numpy as np

from ..core.errors import InputError
from ..core.hints import did_you_mean
from .lattice import Lattice, Window
from .references import wkt_of
from .source import RasterSource

SIGNATURES = (b"CDF\x01", b"CDF\x02", b"CDF\x05", b"\x89HDF\r\n\x1a\n")
EAST = ("x", "easting", "eastings", "lon", "longitude", "xc", "projection_x_coordinate")
NORTH = ("y", "northing", "northings", "lat", "latitude", "yc", "projection_y_coordinate")
DEGREES = ("lon", "lat", "longitude", "latitude")


def is_netcdf(head: bytes) -> bool:
    """Return whether a file begins as NetCDF or HDF5 does."""
    return head.startswith(SIGNATURES)


def open_netcdf(path: Path, choice: str | None) -> RasterSource:
    """Open a variable of a NetCDF file.

    Parameters
    ----------
    path : Path
    choice : str or None
        Name of the variable; needed if the file has several rasters.

    Raises
    ------
    InputError
        If the file cannot be read, the variable is not there or not chosen, or its coordinates are not equally spaced.
    """
    with _dataset(path) as data:
        name = _variable(path, data, choice)
        array = data[name]
        if extra := [f"{dim} ({array.sizes[dim]})" for dim in array.dims[:-2] if array.sizes[dim] != 1]:
            raise InputError(
                f"cannot read {path}:{name}: beside y and x it has the dimension {', '.join(extra)}; choose one, "
                f"by xarray: data[{name!r}].isel({array.dims[0]}=-1).to_netcdf('one.nc')"
            )
        vertical, horizontal = array.dims[-2:]
        if _is_axis(data, vertical, EAST) and _is_axis(data, horizontal, NORTH):
            vertical, horizontal = horizontal, vertical
        x, y = _steps(path, data, horizontal), _steps(path, data, vertical)
        lattice = Lattice((y[2], x[2]), (abs(x[1]), abs(y[1])), (x[0], y[0]), _reference(path, data, array))
        unit = str(array.attrs.get("units", ""))
        integer = array.dtype.kind in "iu"
    flipped = y[1] < 0.0, x[1] < 0.0

    def read(window: Window, shape: tuple[int, int]) -> np.ndarray:
        slices = {}
        for axis, chosen, count, turned in zip((vertical, horizontal), window, lattice.shape, flipped, strict=True):
            slices[axis] = slice(count - chosen.stop, count - chosen.start) if turned else chosen
        with _dataset(path) as data:
            part = data[name].isel(slices).squeeze(
                [dim for dim in data[name].dims if dim not in slices], drop=True
            ).transpose(vertical, horizontal)  # fmt: skip
            try:
                values = np.asarray(part.values, float)
            except MemoryError as error:
                raise InputError(f"cannot read {path}: it does not fit into memory; give a window") from error
            except (OSError, RuntimeError, ValueError, TypeError) as error:
                raise InputError(f"cannot read {path}: {error}; the file is damaged") from error
        values = values[:: -1 if flipped[0] else 1, :: -1 if flipped[1] else 1]
        rows, columns = (
            ((np.arange(new) + 0.5) * old / new).astype(int) for new, old in zip(shape, values.shape, strict=True)
        )
        return values.copy() if shape == values.shape else values[np.ix_(rows, columns)]

    return RasterSource(path, lattice, read, unit, integer)


def _dataset(path: Path) -> Any:
    """Open a NetCDF file without reading its values."""
    import xarray as xr

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return xr.open_dataset(path, engine="netcdf4", decode_times=False, cache=False)
    except (OSError, ValueError, RuntimeError, LookupError, AttributeError, TypeError, ArithmeticError) as error:
        raise InputError(
            f"cannot read {path} as NetCDF: {error}; the file is damaged, or of another program"
        ) from error


def _variable(path: Path, data, choice: str | None) -> Hashable:
    """Return the name of the variable to read."""
    rasters = [
        name for name, array in data.data_vars.items()
        if array.ndim >= 2 and array.dtype.kind in "iuf" and not str(name).endswith(("_bnds", "_bounds"))
    ]  # fmt: skip
    listed = ", ".join(map(str, rasters))
    if not rasters:
        raise InputError(
            f"cannot read {path}: it has no variable over y and x; it has {', '.join(map(str, data)) or 'none'}"
        )
    if choice is None and len(rasters) > 1:
        raise InputError(f"{path} has several rasters: {listed}; choose one, such as {path.name}:{rasters[0]}")
    if choice is not None and choice not in rasters:
        raise InputError(f"{path} has no raster {choice!r}{did_you_mean(choice, map(str, rasters))}; it has {listed}")
    return rasters[0] if choice is None else choice


def _is_axis(data, dim, names) -> bool:
    standard = str(data[dim].attrs.get("standard_name", "")) if dim in data.coords else ""
    return str(dim).lower() in names or standard in names


def _steps(path: Path, data, dim) -> tuple[float, float, int]:
    """Return the lowest coordinate, the signed step and the number of the coordinates along a dimension."""
    if dim not in data.coords or data[dim].dtype.kind not in "iuf":
        raise InputError(
            f"cannot read {path}: the dimension {dim} has no coordinates, so its place on the map is not known; write "
            "the centres of the cells [m] into variables x and y, or give a GeoTIFF"
        )
    values = np.asarray(data[dim].values, float)
    if values.size < 2 or not np.isfinite(values).all():
        raise InputError(f"cannot read {path}: {dim} has {values.size} coordinates, at least 2 finite ones are needed")
    steps = np.diff(values)
    step = (values[-1] - values[0]) / (values.size - 1)
    uneven = np.abs(values - values[0] - step * np.arange(values.size)).max()
    rounding = np.finfo(data[dim].dtype).eps * np.abs(values).max() if data[dim].dtype.kind == "f" else 0.0
    if step == 0.0 or uneven > 1e-3 * abs(step) + rounding:
        raise InputError(
            f"cannot read {path}: coordinates {dim} are not equally spaced, steps go from {steps.min():g} to "
            f"{steps.max():g}"
        )
    return float(values.min()), float(step), values.size


def _reference(path: Path, data, array) -> str | None:
    """Return the coordinate reference system that a variable or the file names, as WKT, or None."""
    mapping = array.attrs.get("grid_mapping", array.encoding.get("grid_mapping"))
    holders = [data[name].attrs for name in (mapping, "spatial_ref", "crs") if name in data.variables]
    for attributes in [*holders, data.attrs]:
        for key in ("crs_wkt", "spatial_ref", "proj4", "epsg_code", "crs"):
            if isinstance(text := attributes.get(key), str) and text.strip():
                return wkt_of(text)
    for attributes in holders:
        if "grid_mapping_name" in attributes:
            import pyproj

            try:
                return pyproj.CRS.from_cf(attributes).to_wkt()
            except (pyproj.exceptions.ProjError, ValueError, KeyError, TypeError, AttributeError) as error:
                raise InputError(
                    f"cannot read {path}: its grid mapping is no coordinate reference system: {error}"
                ) from error
    degrees = [dim for dim in array.dims[-2:] if str(data[dim].attrs.get("units", "")).startswith("degrees_")]
    if degrees or all(str(dim).lower() in DEGREES for dim in array.dims[-2:]):
        return wkt_of("EPSG:4326")
    return None
