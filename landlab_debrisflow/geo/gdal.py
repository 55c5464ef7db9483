"""Rasters that GDAL reads, by way of rasterio."""

import contextlib
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from ..core.errors import InputError
from .lattice import Lattice, Window
from .names import import_error, reason_of, said
from .source import RasterSource

FORMATS = "give a GeoTIFF, an ESRI ASCII grid or NetCDF"
DRIVERS = {
    "GTiff", "COG", "VRT", "HFA", "EHdr", "ENVI", "ERS", "AAIGrid", "GSAG", "GSBG", "GS7BG", "GRASSASCIIGrid", "SAGA",
    "RST", "PCRaster", "SRTMHGT", "DTED", "USGSDEM", "BT", "ISG", "XYZ", "JP2OpenJPEG", "ILWIS", "RMF", "LCP",
}  # fmt: skip
"""Formats of numbers on a map; pictures and servers are none."""
PICTURE = ("red", "green", "blue", "alpha", "palette", "cyan", "hue", "Y", "Cb", "Cr")


@contextlib.contextmanager
def opened(path: Path) -> Iterator[Any]:
    """Open a raster by rasterio, and turn failures of its libraries, also in the block, into refusals.

    Raises
    ------
    InputError
        With the message of the library.
    """
    try:
        import rasterio
        from rasterio._err import CPLE_BaseError
    except ImportError as error:
        raise import_error(error) from error
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the warning of a raster without a place on the map, which is refused below
        try:
            with rasterio.open(path.absolute()) as source:
                yield source
        except InputError:
            raise
        except MemoryError as error:
            raise InputError(f"cannot read {path}: it does not fit into memory; give a window or a spacing") from error
        except (rasterio.errors.RasterioError, CPLE_BaseError, OSError, ValueError, TypeError, OverflowError) as error:
            raise InputError(f"cannot read {path} as a raster: {reason_of(error)}; {FORMATS}") from error


def open_gdal(path: Path, choice: str | None, notes: list[str] | None) -> RasterSource:
    """Open one band of a raster.

    Parameters
    ----------
    path : Path
    choice : str or None
        Number of the band, by default 1.
    notes : list of str or None
        Remarks for the user are appended to it.

    Raises
    ------
    InputError
        If the file is no raster of numbers on a map with sides along x and y.
    """
    with opened(path) as source:
        if source.driver not in DRIVERS:
            raise InputError(f"cannot read {path}: {source.driver} is no format for elevations or depths; {FORMATS}")
        band = _band(path, source, choice)
        if source.count > 1 and choice is None:
            said(notes, f"{path.name}: the first of {source.count} bands is read; another one is {path.name}:2")
        if np.dtype(source.dtypes[band - 1]).kind not in "iuf":
            raise InputError(f"cannot read {path}: its values are of type {source.dtypes[band - 1]}, no real numbers")
        if source.colorinterp[band - 1].name in PICTURE:
            colour = source.colorinterp[band - 1].name
            raise InputError(f"cannot read {path}: band {band} is the colour {colour} of a picture; {FORMATS}")
        lattice, south_up = _lattice(path, source), source.transform.e > 0.0
        scale, offset = source.scales[band - 1], source.offsets[band - 1]
        unit, integer = source.units[band - 1] or "", np.dtype(source.dtypes[band - 1]).kind in "iu"
    if (scale, offset) != (1.0, 0.0):
        if not (np.isfinite([scale, offset]).all() and scale != 0.0):
            raise InputError(
                f"cannot read {path}: its scale {scale} and offset {offset} are no numbers to compute with"
            )
        said(notes, f"{path.name}: values are multiplied by {scale:g} and {offset:g} is added, as the file says")

    def read(window: Window, shape: tuple[int, int]) -> np.ndarray:
        from rasterio.windows import Window as Block

        rows, columns = window
        top = rows.start if south_up else lattice.shape[0] - rows.stop
        block = Block(columns.start, top, columns.stop - columns.start, rows.stop - rows.start)
        with opened(path) as source:
            masked = source.read(band, window=block, out_shape=shape, masked=True)
        values = masked.astype(float).filled(np.nan)
        values = values if (scale, offset) == (1.0, 0.0) else values * scale + offset
        return values if south_up else values[::-1].copy()

    return RasterSource(path, lattice, read, unit, integer and (scale, offset) == (1.0, 0.0))


def crs_of_gdal(path: Path) -> str | None:
    """Return the coordinate reference system that GDAL finds for a file, as WKT, or None."""
    try:
        with opened(path) as source:
            return source.crs.to_wkt() if source.crs else None
    except InputError:
        return None


def _band(path: Path, source, choice: str | None) -> int:
    if source.count == 0:
        inside = ", ".join(source.subdatasets[:5])
        raise InputError(f"cannot read {path}: it has no band" + (f"; it holds {inside}" if inside else ""))
    if choice is None:
        return 1
    if not choice.isdecimal() or not 1 <= int(choice) <= source.count:
        raise InputError(f"cannot read {path}:{choice}: after the colon stands a band, 1 to {source.count}")
    return int(choice)


def _lattice(path: Path, source) -> Lattice:
    transform, (rows, columns) = source.transform, source.shape
    if transform.is_identity or not np.isfinite(transform[:6]).all():
        raise InputError(
            f"cannot read {path}: it has no place on the map, neither georeference nor world file; give it one, by "
            f"rio edit-info {path} --crs EPSG:CODE --transform [dx, 0, west, 0, -dy, north]"
        )
    dx, dy = transform.a, abs(transform.e)
    shear = max(abs(transform.b) * rows, abs(transform.d) * columns)
    if shear > 1e-3 * min(abs(dx), dy) or dx == 0.0 or dy == 0.0:
        crs = source.crs.to_string() if source.crs else "EPSG:CODE"
        crs = crs if len(crs) < 20 else "EPSG:CODE"
        raise InputError(
            f"cannot read {path}: its rows do not run along x (rotated transform {tuple(transform)[:6]}); straighten "
            f"it: gdalwarp -r bilinear {path} out.tif, or rio warp {path} out.tif --dst-crs {crs} --resampling bilinear"
        )
    if dx < 0.0:
        raise InputError(
            f"cannot read {path}: its columns run from east to west; turn it: gdalwarp -r bilinear {path} out.tif"
        )
    south = transform.f if transform.e > 0.0 else transform.f + rows * transform.e
    crs = source.crs.to_wkt() if source.crs else None
    return Lattice((rows, columns), (dx, dy), (transform.c + 0.5 * dx, south + 0.5 * dy), crs)
