"""Rasters on the nodes of another lattice."""

import math
from pathlib import Path

import numpy as np

from ..core.errors import InputError
from .lattice import Bounds, Lattice, extent
from .names import import_error, said
from .rasters import open_raster, read_window
from .references import label_of, same_place, transformed
from .source import RasterSource

SAME_LATTICE = 1e-3
"""Largest shift between two lattices, over the spacing, at which their nodes count as the same [-]."""
COARSER = 1.5
"""Least area of a cell over that of the source with which means are taken [-]."""
LEAST_DATA = 0.5
"""Part of a cell that must have data for its mean to be taken [-]."""


def read_onto(
    path: str | Path, lattice: Lattice, crs: str | None = None, *, lengths: bool = True, whole: bool = True,
    notes: list[str] | None = None,
) -> np.ndarray:  # fmt: skip
    """Read a raster onto the nodes of a lattice, shape (rows, columns), NaN where there are no data.

    A raster of the same lattice is taken as it is. Of another spacing or reference system it is resampled: means over
    the cells of a coarser lattice, bilinear on a finer one.

    Parameters
    ----------
    path : str or Path
        As in `read_raster`.
    lattice : Lattice
    crs : str, optional
        Coordinate reference system of a file that names none; by default that of the lattice is taken.
    lengths : bool
        As in `read_raster`.
    whole : bool
        Whether the raster must cover the lattice; else it must touch it, and there are no data beyond its edge.
    notes : list of str, optional
        Remarks for the user are appended to it.

    Raises
    ------
    InputError
        If the file is no raster, does not cover the lattice, or does not touch it.
    """
    source = open_raster(path, crs or lattice.crs, notes)
    own = source.lattice
    tolerance = SAME_LATTICE * min(lattice.spacing)
    if same_place(lattice.crs, own.crs, lattice.bounds, tolerance):
        wanted = lattice.bounds
    else:
        wanted = _moved_bounds(lattice, str(own.crs))
        said(notes, f"{source.path.name}: brought from {label_of(own.crs)} into {label_of(lattice.crs)}")
    _check_cover(source, wanted, label_of(own.crs), whole)
    dx, dy = own.spacing
    window = own.window_around((wanted[0] - 3 * dx, wanted[1] - 3 * dy, wanted[2] + 3 * dx, wanted[3] + 3 * dy))
    offset = [(a - b) / step for a, b, step in zip(lattice.lower_left, own.lower_left, own.spacing, strict=True)]
    steps = max(abs(a - b) * max(lattice.shape) for a, b in zip(lattice.spacing, own.spacing, strict=True))
    shift = max(abs(value - round(value)) for value in offset)
    if wanted == lattice.bounds and steps <= tolerance and shift <= SAME_LATTICE:
        column, row = (round(value) for value in offset)
        if row >= 0 and column >= 0 and row + lattice.shape[0] <= own.shape[0] and (
            column + lattice.shape[1] <= own.shape[1]
        ):  # fmt: skip
            return read_window(
                source, window._replace(
                    rows=slice(row, row + lattice.shape[0]), columns=slice(column, column + lattice.shape[1])
                ), lengths=lengths, notes=notes,
            )  # fmt: skip
    values = read_window(source, window, lengths=lengths, notes=notes)
    said(notes, f"{source.path.name}: resampled from cells of {dx:g} to {lattice.spacing[0]:g} m")
    return resample(values, own.cut(window)._replace(crs=own.crs or lattice.crs), lattice)


def resample(values: np.ndarray, source: Lattice, target: Lattice, finer: str = "bilinear") -> np.ndarray:
    """Return values of one lattice on another, shape (rows, columns); missing data are not spread.

    Parameters
    ----------
    values : ndarray, shape (rows, columns) of `source`
        NaN where there are no data.
    source, target : Lattice
    finer : {"bilinear", "cubic"}
        Interpolation on a finer lattice; on a coarser one means over cells are taken, weighted by area, where at least
        `LEAST_DATA` of the cell has data.
    """
    try:
        import rasterio.warp
        from rasterio.enums import Resampling
    except ImportError as error:
        raise import_error(error) from error
    coarser = target.area > COARSER * source.area
    method = Resampling.average if coarser else Resampling[finer]
    crs = {"src_crs": source.crs or "EPSG:32601", "dst_crs": target.crs or "EPSG:32601"}
    # a system that is not known counts as the same
    crs = crs if source.crs and target.crs else dict.fromkeys(crs, "EPSG:32601")
    data = ~np.isnan(values)

    def onto(array, how):
        result = np.full(target.shape, np.nan)
        try:
            rasterio.warp.reproject(
                np.ascontiguousarray(array[::-1]), result, src_transform=_transform(source),
                dst_transform=_transform(target), src_nodata=np.nan, dst_nodata=np.nan, resampling=how, **crs,
            )  # fmt: skip
        except (rasterio.errors.RasterioError, rasterio._err.CPLE_BaseError, ValueError) as error:
            raise InputError(
                f"a raster cannot be brought from {label_of(source.crs)} to {label_of(target.crs)}: {error}"
            ) from error
        return result[::-1]

    result = onto(values, method)
    if not coarser:
        return result
    fraction = onto(data.astype(float), Resampling.average)
    return np.where(fraction >= LEAST_DATA, result, np.nan)


def _transform(lattice: Lattice):
    from rasterio.transform import Affine

    west, _, _, north = lattice.bounds
    return Affine(lattice.spacing[0], 0.0, west, 0.0, -lattice.spacing[1], north)


def _moved_bounds(lattice: Lattice, crs: str) -> Bounds:
    """Return the rectangle around a lattice in another coordinate reference system."""
    west, south, east, north = lattice.bounds
    along = np.linspace(0.0, 1.0, 21)
    x = np.concatenate([west + (east - west) * along] * 2 + [np.full(21, west), np.full(21, east)])
    y = np.concatenate([np.full(21, south), np.full(21, north)] + [south + (north - south) * along] * 2)
    x, y = transformed(x, y, str(lattice.crs), crs)
    if not np.isfinite(x + y).all():
        raise InputError(f"the DEM lies outside of {label_of(crs)}; give a file in {label_of(lattice.crs)}")
    return float(x.min()), float(y.min()), float(x.max()), float(y.max())


def _check_cover(source: RasterSource, wanted: Bounds, system: str, whole: bool) -> None:
    """Refuse a raster that ends more than a cell before the edge of a rectangle [m], or one wholly outside."""
    west, south, east, north = source.lattice.bounds
    if not whole:
        if wanted[0] >= east or wanted[1] >= north or wanted[2] <= west or wanted[3] <= south:
            raise InputError(
                f"{source.path} lies wholly outside the terrain: it reaches over {extent(source.lattice.bounds)}, the "
                f"terrain over {extent(wanted)} ({system}); is it of this place, and in the system that it names?"
            )
        return
    dx, dy = (math.ceil(1e6 * step) / 1e6 for step in source.lattice.spacing)
    if wanted[0] < west - dx or wanted[1] < south - dy or wanted[2] > east + dx or wanted[3] > north + dy:
        raise InputError(
            f"{source.path} does not cover the terrain: it reaches over {extent(source.lattice.bounds)}, the terrain "
            f"over {extent(wanted)} ({system}); give a larger raster, or a smaller terrain by "
            "window: [west, south, east, north]"
        )
