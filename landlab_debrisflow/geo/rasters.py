"""Rasters from files: elevation, depths, parameters."""

import hashlib
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..core.errors import InputError
from .lattice import Lattice


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


def read_raster(path: str | Path, crs: str | None = None) -> RasterFile:
    """Read the first band of a raster.

    Parameters
    ----------
    path : str or Path
        GeoTIFF, ESRI ASCII or another format that GDAL reads.
    crs : str, optional
        Coordinate reference system, such as ``"EPSG:32633"``, for a file that names none.

    Returns
    -------
    RasterFile

    Raises
    ------
    InputError
        If the file is missing or no raster.
    """
    import rasterio

    path = Path(path)
    if not path.is_file():
        raise InputError(f"cannot read {path}: there is no such file")
    try:
        with rasterio.open(path) as source:
            values, transform = source.read(1, masked=True).astype(float).filled(np.nan), source.transform
            found = source.crs.to_wkt() if source.crs else crs
    except rasterio.errors.RasterioError as error:
        raise InputError(f"cannot read {path} as a raster: {error}; give a GeoTIFF or an ESRI ASCII file") from error
    rows, columns = values.shape
    dx, dy = transform.a, -transform.e
    if dy > 0.0:
        values, south = values[::-1], transform.f - rows * dy
    else:
        dy, south = -dy, transform.f
    lattice = Lattice((rows, columns), (dx, dy), (transform.c + 0.5 * dx, south + 0.5 * dy), found)
    return RasterFile(values.copy(), lattice, path, hashlib.sha256(path.read_bytes()).hexdigest())
