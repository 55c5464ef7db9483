"""Coordinate reference systems: lengths on the map must be metres of the ground."""

import math
from pathlib import Path
from typing import Any

import numpy as np

from ..core.errors import InputError
from .lattice import Bounds, Lattice, extent
from .names import import_error

LARGEST_DISTORTION = 0.02
"""Error of lengths on the map above which a projection is refused; national grids and UTM stay below 1 % [-]."""


def _crs_of(text: str) -> Any:
    """Return the coordinate reference system of a text such as WKT or "EPSG:32633".

    Raises
    ------
    InputError
        If the text means none.
    """
    try:
        import pyproj
    except ImportError as error:
        raise import_error(error) from error
    try:
        return pyproj.CRS.from_user_input(text)
    except (pyproj.exceptions.ProjError, ValueError, TypeError) as error:
        raise InputError(
            f"crs: {text!r} is no coordinate reference system; give its code, such as EPSG:32633 (UTM zone 33N)"
        ) from error


def wkt_of(text: str) -> str:
    """Return a coordinate reference system, given as a code or otherwise, as WKT."""
    return _crs_of(text).to_wkt()


def label_of(wkt: str | None) -> str:
    """Return code and name of a coordinate reference system."""
    if wkt is None:
        return "unknown"
    crs = _crs_of(wkt)
    code = crs.to_authority()
    return f"{':'.join(code)} ({crs.name})" if code else crs.name


LARGEST_ANGLE = 400.0
"""Largest coordinates that may be degrees: longitudes are sometimes counted on past 360 [deg]."""


def check_metric(lattice: Lattice, path: object) -> None:
    """Refuse a raster whose coordinates are not metres, with the command that reprojects it.

    Parameters
    ----------
    lattice : Lattice
    path : Path or str
        Path of the file, for the message.

    Raises
    ------
    InputError
        If the coordinates are degrees, feet or another unit than metres, or if a projection distorts lengths by more
        than `LARGEST_DISTORTION`.
    """
    if lattice.crs is None:
        if _looks_like_degrees(lattice):
            raise InputError(
                f"{path}: the coordinates ({_degrees(lattice.bounds)}, spacing {lattice.spacing[0]:.3g}) look "
                f"like degrees; reproject the file to metres: {_commands(lattice, path, 'EPSG:4326')}"
            )
        return
    crs = _crs_of(lattice.crs)
    if crs.is_geographic and np.abs(lattice.bounds).max() > LARGEST_ANGLE:
        raise InputError(
            f"{path}: its coordinate reference system is in degrees ({label_of(lattice.crs)}), but its coordinates are "
            f"not: {extent(lattice.bounds)}; assign the right one: gdal_edit.py -a_srs EPSG:CODE {path}, or rio "
            f"edit-info {path} --crs EPSG:CODE"
        )
    if crs.is_geographic:
        raise InputError(
            f"{path}: the coordinates are degrees ({label_of(lattice.crs)}), metres are needed; reproject the file: "
            f"{_commands(lattice, path)}"
        )
    axis = next(iter(crs.axis_info), None)
    if axis is not None and not math.isclose(axis.unit_conversion_factor, 1.0, rel_tol=1e-9):
        raise InputError(
            f"{path}: the coordinates are in {axis.unit_name} ({label_of(lattice.crs)}), metres are needed; reproject "
            f"the file: {_commands(lattice, path)}"
        )
    distortion = _distortion(crs, lattice.bounds)
    if distortion > LARGEST_DISTORTION:
        raise InputError(
            f"{path}: lengths of this projection ({label_of(lattice.crs)}) are off by {100.0 * distortion:.0f} % here; "
            f"reproject the file: {_commands(lattice, path)}"
        )


def metres_of_height(wkt: str | None) -> tuple[float, str]:
    """Return metres in a unit of height of a coordinate reference system, and its name; 1 m if it has no heights."""
    if wkt is None:
        return 1.0, "metre"
    parts = [part for part in [_crs_of(wkt), *_crs_of(wkt).sub_crs_list] if part.is_vertical and part.axis_info]
    axes = [axis for part in parts for axis in part.axis_info if axis.direction in ("up", "down")]
    if not axes or not axes[0].unit_conversion_factor > 0.0:
        return 1.0, "metre"
    return axes[0].unit_conversion_factor, axes[0].unit_name


def same_place(one: str | None, other: str | None, bounds: Bounds, tolerance: float) -> bool:
    """Return whether two reference systems mean the same place by the same coordinates.

    Parameters
    ----------
    one, other : str or None
        As WKT; an unknown one is taken to be the other.
    bounds : tuple of float
        Rectangle at whose corners they are compared [m].
    tolerance : float
        Largest distance of a corner [m].
    """
    if one is None or other is None or one == other:
        return True
    west, south, east, north = bounds
    x, y = np.array([west, east, west, east]), np.array([south, south, north, north])
    moved = transformed(x, y, one, other)
    return bool(np.all(np.hypot(moved[0] - x, moved[1] - y) <= tolerance))


def transformed(x: np.ndarray, y: np.ndarray, source: str, target: str) -> tuple[np.ndarray, np.ndarray]:
    """Return coordinates in another reference system, inf where they have none there."""
    import pyproj

    try:
        change = pyproj.Transformer.from_crs(_crs_of(source), _crs_of(target), always_xy=True)
        return change.transform(x, y)
    except (pyproj.exceptions.ProjError, ValueError) as error:
        raise InputError(f"no way from {label_of(source)} to {label_of(target)} is known: {error}") from error


def check_reference(lattice: Lattice, crs: str | None, path: Path) -> None:
    """Refuse a reference system given for a raster that names another one itself.

    Parameters
    ----------
    lattice : Lattice
    crs : str or None
        The one given, such as ``"EPSG:32633"``.
    path : Path
        Path of the file, for the message.

    Raises
    ------
    InputError
        If they mean other places.
    """
    if crs is not None and not same_place(lattice.crs, wkt_of(crs), lattice.bounds, max(lattice.spacing)):
        raise InputError(
            f"crs: {path.name} is in {label_of(lattice.crs)}, crs says {crs}; crs is for files that name none, leave "
            "it out"
        )


def utm_code(longitude: float, latitude: float) -> str:
    """Return the code of the UTM zone of a place, or of the polar stereographic projection beyond 84 N and 80 S.

    Examples
    --------
    >>> utm_code(13.4, 46.5), utm_code(-70.1, -33.4), utm_code(20.0, 86.0)
    ('EPSG:32633', 'EPSG:32719', 'EPSG:5041')
    """
    if latitude > 84.0 or latitude < -80.0:
        return "EPSG:5041" if latitude > 0.0 else "EPSG:5042"
    zone = math.floor((longitude + 180.0) / 6.0) % 60 + 1
    return f"EPSG:{32600 if latitude >= 0.0 else 32700:d}"[:-2] + f"{zone:02d}"


def _looks_like_degrees(lattice: Lattice) -> bool:
    west, south, east, north = lattice.bounds
    # cells of 10 seconds of arc are 0.0028 wide in degrees; cells of a laboratory model in metres are larger
    return max(lattice.spacing) < 0.003 and max(abs(west), abs(east)) <= 360.0 and max(abs(south), abs(north)) <= 90.5


def _degrees(bounds: Bounds) -> str:
    """Return a rectangle in degrees in words."""
    west, south, east, north = (f"{value:.6g}" for value in bounds)
    return f"{west} to {east}, {south} to {north}"


def _commands(lattice: Lattice, path: object, source: str | None = None) -> str:
    """Return the commands of GDAL and of rasterio that reproject a raster to UTM."""
    west, south, east, north = lattice.bounds
    middle = np.array([0.5 * (west + east)]), np.array([0.5 * (south + north)])
    longitude, latitude = transformed(*middle, source or str(lattice.crs), "EPSG:4326")
    code = utm_code(float(longitude[0]), float(latitude[0])) if np.isfinite(longitude + latitude).all() else "EPSG:CODE"
    given, given_rio = (f"-s_srs {source} ", f" --src-crs {source}") if source else ("", "")
    return (
        f"gdalwarp {given}-t_srs {code} -r bilinear {path} out.tif, or "
        f"rio warp {path} out.tif{given_rio} --dst-crs {code} --resampling bilinear"
    )


def _distortion(crs, bounds: Bounds) -> float:
    """Return the largest relative error of lengths at the middle of a rectangle, 0 where it is not known."""
    import pyproj

    west, south, east, north = bounds
    middle = np.array([0.5 * (west + east)]), np.array([0.5 * (south + north)])
    if not crs.is_projected or crs.geodetic_crs is None:
        return 0.0
    try:
        change = pyproj.Transformer.from_crs(crs, crs.geodetic_crs, always_xy=True)
        factors = pyproj.Proj(crs).get_factors(*change.transform(*middle))
    except (pyproj.exceptions.ProjError, ValueError):
        return 0.0
    scales = np.array([factors.meridional_scale, factors.parallel_scale], float).reshape(-1)
    return float(np.max(np.abs(scales - 1.0))) if np.isfinite(scales).all() else 0.0
