"""Rasters from files: elevation, depths, parameters."""

import hashlib
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..core.errors import InputError
from ..grid.fill_values import HUGE, code_of, is_fill
from .ascii_grid import is_ascii_grid, open_ascii_grid
from .gdal import open_gdal
from .lattice import FARTHEST, Bounds, Lattice, Window, extent
from .names import find_file, said
from .netcdf import is_netcdf, open_netcdf
from .references import check_metric, metres_of_height, wkt_of
from .source import RasterSource

MOST_NODES = 100_000_000
"""Most values that are read at once; a run of so many nodes needs more memory than most machines have."""
METRES = {
    "cm": 0.01, "mm": 0.001, "dm": 0.1, "km": 1000.0, "ft": 0.3048, "foot": 0.3048, "feet": 0.3048,
    "us-ft": 1200.0 / 3937.0, "us survey foot": 1200.0 / 3937.0, "ftus": 1200.0 / 3937.0,
}  # fmt: skip
"""Metres in a unit of length other than the metre, by the names that files give it."""
UNSAID = ("", "1", "-", "unknown")
"""Texts of a unit that name no unit."""


class RasterFile(NamedTuple):
    """Raster as a file holds it.

    Attributes
    ----------
    values : ndarray, shape (rows, columns)
        Values from south to north, NaN where there are no data.
    lattice : Lattice
        Place of the values on the map.
    path : Path
        The file.
    checksum : str
        SHA-256 of the bytes of the file.
    """

    values: np.ndarray
    lattice: Lattice
    path: Path
    checksum: str


def read_raster(
    path: str | Path, crs: str | None = None, *, bounds: Bounds | None = None, missing: float | None = None,
    lengths: bool = True, notes: list[str] | None = None,
) -> RasterFile:  # fmt: skip
    """Read a raster, or the part of it in a rectangle of the map.

    Parameters
    ----------
    path : str or Path
        GeoTIFF, ESRI ASCII grid, NetCDF or another format that GDAL reads; after a colon the variable of a NetCDF file
        or the number of a band.
    crs : str, optional
        Coordinate reference system, such as ``"EPSG:32633"``, for a file that names none.
    bounds : tuple of float, optional
        West, south, east, north [m]: only whole cells that touch this rectangle are read.
    missing : float, optional
        A further value that marks missing data.
    lengths : bool
        Whether the values are elevations or depths: they are turned into metres if the file or its coordinate reference
        system states another unit.
    notes : list of str, optional
        Remarks for the user are appended to it.

    Returns
    -------
    RasterFile

    Raises
    ------
    InputError
        If the file is missing or no raster, or if its coordinates are not metres along x and y.
    """
    source = open_raster(path, crs, notes)
    window = source.lattice.window if bounds is None else source.lattice.window_around(bounds)
    if min(window.shape) == 0:
        raise InputError(
            f"{source.path} does not reach there: it covers {extent(source.lattice.bounds)}, wanted is {extent(bounds)}"
        )
    values = read_window(source, window, missing=missing, lengths=lengths, notes=notes)
    return RasterFile(values, source.lattice.cut(window), source.path, checksum_of(source.path))


def open_raster(path: str | Path, crs: str | None = None, notes: list[str] | None = None) -> RasterSource:
    """Open a raster without reading its values; arguments, errors and notes are as of `read_raster`."""
    path, choice = find_file(path)
    if not path.is_file():
        raise InputError(f"cannot read {path}: it is a directory; give the name of a file in it")
    try:
        with open(path, "rb") as file:
            head = file.read(512)
    except OSError as error:
        raise InputError(f"cannot read {path}: {error.strerror}") from error
    if is_netcdf(head):
        source = open_netcdf(path, choice)
    elif is_ascii_grid(path, head):
        source = open_ascii_grid(path)
    else:
        source = open_gdal(path, choice, notes)
    return source._replace(lattice=_referenced(source.lattice, crs, path, notes))


def read_window(
    source: RasterSource, window: Window, shape: tuple[int, int] | None = None, *, missing: float | None = None,
    lengths: bool = True, notes: list[str] | None = None,
) -> np.ndarray:  # fmt: skip
    """Return the values of a window of a raster [m], NaN where there are no data.

    Parameters
    ----------
    source : RasterSource
    window : Window
    shape : tuple of int, optional
        Rows and columns to which the values are thinned out while they are read.
    missing, lengths, notes
        As in `read_raster`.
    """
    shape = window.shape if shape is None else shape
    if shape[0] * shape[1] > MOST_NODES:
        raise InputError(
            f"{source.path}: {shape[0]} x {shape[1]} nodes are too many to be read at once (at most {MOST_NODES:.0e}); "
            "give a window or a spacing"
        )
    values = source.read(window, shape)
    with np.errstate(invalid="ignore"):
        fills = is_fill(values) & ((values < 0.0) | (np.abs(values) >= HUGE) | source.integer)
        fills |= values == missing
    if fills.any():
        found = values[fills]
        say = f"{code_of(found[0])} marks missing data at {found.size} nodes, though the file does not say so"
        values[fills] = np.nan
        if missing is None or not np.array_equal(found, np.full(found.shape, missing)):
            said(notes, f"{source.path.name}: {say}")
    factor, unit = _metres(source) if lengths else (1.0, "")
    if factor != 1.0:
        values *= factor
        said(notes, f"{source.path.name}: values are in {unit} and are multiplied by {factor:.7g} to be metres")
    return values


def checksum_of(path: Path) -> str:
    """Return the SHA-256 of the bytes of a file."""
    try:
        with open(path, "rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError as error:
        raise InputError(f"cannot read {path}: {error.strerror}") from error


def _referenced(lattice: Lattice, crs: str | None, path: Path, notes: list[str] | None) -> Lattice:
    """Return a lattice with a coordinate reference system in metres, its own or the one given."""
    given = None if crs is None else wkt_of(crs)
    if lattice.crs is None:
        if given is None:
            said(
                notes, f"{path.name}: no coordinate reference system is named; metres are assumed, maps will have none"
            )
        lattice = lattice._replace(crs=given)
    if not np.abs(lattice.bounds).max() <= FARTHEST:  # true also if the sum is not a number
        raise InputError(
            f"{path} covers {extent(lattice.bounds)} with cells of {lattice.spacing[0]:g} x {lattice.spacing[1]:g} m: "
            f"no map reaches beyond {FARTHEST:g} m; correct its place and spacing"
        )
    check_metric(lattice, path)
    return lattice


def _metres(source: RasterSource) -> tuple[float, str]:
    """Return metres in the unit of the values, and its name; 1 if it is no length."""
    unit = source.unit.strip().lower()
    return metres_of_height(source.lattice.crs) if unit in UNSAID else (METRES.get(unit, 1.0), source.unit)
