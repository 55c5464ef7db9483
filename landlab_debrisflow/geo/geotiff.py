"""Maps as GeoTIFF files, north up, each with a style for QGIS beside it."""

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ..core.errors import InputError
from ..core.hints import did_you_mean
from ..core.version import __version__
from ..grid.fields import OUTPUT_PREFIX
from ..model.map_fields import PEAKS
from ..record.files import check_directory, write_atomically
from ..record.georeference import crs_of
from ..record.written_maps import LEAST_DEPTH, mask_peaks
from .lattice import Lattice
from .styles import style_for, write_style

MAPS = "max_depth", "max_speed", "arrival_time", "eroded_depth", "deposit_depth"
"""Maps that are written if the user names none."""

ACCOUNTS = "eroded_depth", "deposit_depth", "depth", "speed", "solid_depth", "solid_speed", "water_speed"
"""Maps whose values of 0 mean that nothing is there; files leave these out."""

TILE = 256
"""Rows and columns of a tile."""


def write_geotiff(
    path: str | os.PathLike[str],
    values: np.ndarray,
    lattice: Lattice,
    *,
    description: str = "",
    unit: str = "",
    tags: Mapping[str, Any] | None = None,
) -> Path:
    """Write one map as GeoTIFF, atomically: north up, single precision, tiled, compressed, NaN where nothing is known.

    Parameters
    ----------
    path : str or os.PathLike
        The file, ``.tif``; it is replaced if it exists.
    values : ndarray, shape (rows, columns)
        In any unit, the first row southern; NaN where there is no value.
    lattice : Lattice
        Place of the nodes on the map.
    description : str
        Name of the band.
    unit : str
        Unit of the values.
    tags : mapping, optional
        Further texts to be kept in the file, by name.

    Returns
    -------
    pathlib.Path
        Where the file is.

    Raises
    ------
    InputError
        If the shape is not that of the lattice, the coordinate reference system is not known, the file cannot be
        written, or rasterio is missing.
    OSError
        If the disk is full; no file is left then, or the one that was there before.
    """
    rasterio = _rasterio()
    values = np.asarray(values)
    if values.shape != tuple(lattice.shape):
        raise InputError(
            f"write_geotiff: values must have the shape of the lattice {tuple(lattice.shape)}, got {values.shape}"
        )
    (rows, columns), (dx, dy) = lattice.shape, lattice.spacing
    west, _, _, north = lattice.bounds
    profile: dict[str, Any] = {
        "driver": "GTiff", "height": rows, "width": columns, "count": 1, "dtype": "float32", "nodata": np.nan,
        "transform": rasterio.transform.from_origin(west, north, dx, dy), "compress": "deflate", "predictor": 3,
        "tiled": True, "blockxsize": TILE, "blockysize": TILE,
    }  # fmt: skip
    if lattice.crs is not None:
        profile["crs"] = _system(lattice.crs, rasterio)
    # written in memory first: GDAL notices a full disk only when it closes a file, and raises no error then
    with rasterio.MemoryFile() as memory:
        with memory.open(**profile) as file:
            file.write(values[::-1].astype(np.float32), 1)
            file.update_tags(**{name: str(value) for name, value in (tags or {}).items()})
            if description:
                file.set_band_description(1, description)
            if unit:
                file.set_band_unit(1, unit)
        written = memory.read()
    return write_atomically(path, lambda temporary: temporary.write_bytes(written))


def write_geotiffs(
    directory: str | os.PathLike[str],
    maps: xr.Dataset,
    names: Sequence[str] = MAPS,
    *,
    crs: str | None = None,
    least_depth: float = LEAST_DEPTH,
    tags: Mapping[str, Any] | None = None,
) -> list[Path]:
    """Write maps of a flow as GeoTIFF files ``max_depth.tif`` and so on, with a QGIS style ``.qml`` beside each.

    Peaks are missing where the flow was never as deep as `least_depth`, depths where they are 0, all at closed nodes.

    Parameters
    ----------
    directory : str or os.PathLike
        Existing directory.
    maps : xarray.Dataset
        As `DebrisFlow.maps` returns them.
    names : sequence of str
        Names of the maps, with or without ``debris_flow__``; each of ``maps`` can be written.
    crs : str, optional
        Coordinate reference system, as WKT or as a code like ``"EPSG:32633"``; by default that of the maps.
    least_depth : float
        See `record.mask_peaks` [m].
    tags : mapping, optional
        Further texts for all files, by name, such as the checksum of the terrain.

    Returns
    -------
    list of pathlib.Path
        The files, in the order of `names`.

    Raises
    ------
    InputError
        If a map is not known or twice among the names, or a file cannot be written: known before anything is written.
    """
    directory, lattice = check_directory(directory), lattice_of(maps, crs)
    wanted = [_map_name(name, maps) for name in names]
    if len(set(wanted)) < len(wanted):
        raise InputError(f"write_geotiffs: a map is twice among the names, got {', '.join(names)}")
    masked = mask_peaks(maps, least_depth)
    common = {"software": f"landlab_debrisflow {__version__}"} | {
        name: maps.attrs[name] for name in ("setup_digest", "date_created", "elapsed_time") if name in maps.attrs
    }
    paths = []
    for name in wanted:
        short = name.removeprefix(OUTPUT_PREFIX)
        data = masked[name]
        if short in ACCOUNTS:
            data = data.where(data > 0.0)
        words = {"long_name": data.attrs.get("long_name", short), "units": data.attrs.get("units", "1")}
        if short in PEAKS:
            words["peaks_masked_below"] = f"{least_depth:g} m"
        everything = common | words | dict(tags or {})
        path = write_geotiff(
            directory / f"{short}.tif", data.values, lattice, description=words["long_name"], unit=words["units"],
            tags=everything,
        )  # fmt: skip
        write_style(path.with_suffix(".qml"), style_for(name, data.values), transparent_below=short in ACCOUNTS)
        paths.append(path)
    return paths


def lattice_of(maps: xr.Dataset, crs: str | None = None) -> Lattice:
    """Return the place of the nodes of maps.

    Parameters
    ----------
    maps : xarray.Dataset
        Over ``y`` and ``x``, map coordinates [m], from south to north and west to east.
    crs : str, optional
        Coordinate reference system; by default that of the maps, if they have one.

    Returns
    -------
    Lattice

    Raises
    ------
    InputError
        If the maps are not over a raster of at least 2 x 2 nodes.

    Examples
    --------
    >>> maps = xr.Dataset(coords={"y": [5.0, 15.0], "x": [0.0, 10.0, 20.0]})
    >>> lattice_of(maps).bounds
    (-5.0, 0.0, 25.0, 20.0)
    """
    if not isinstance(maps, xr.Dataset) or any(maps.sizes.get(axis, 0) < 2 or axis not in maps for axis in "yx"):
        raise InputError(f"maps must be a Dataset over y and x, as flow.maps, got {type(maps).__name__}")
    x, y = maps.x.values, maps.y.values
    spacing = (x[-1] - x[0]) / (x.size - 1), (y[-1] - y[0]) / (y.size - 1)
    if min(spacing) <= 0.0:
        raise InputError("maps must have x from west to east and y from south to north; use maps.sortby(['y', 'x'])")
    place = (float(x[0]), float(y[0]))
    return Lattice((y.size, x.size), (float(spacing[0]), float(spacing[1])), place, crs or crs_of(maps))


def _map_name(name: str, maps: xr.Dataset) -> str:
    """Return the name of a map in a Dataset, given with or without prefix."""
    for whole in (OUTPUT_PREFIX + name, name):
        if whole in maps and set(maps[whole].dims) == {"y", "x"}:
            return whole
    known = [str(each).removeprefix(OUTPUT_PREFIX) for each in maps if set(maps[each].dims) == {"y", "x"}]
    raise InputError(f"write_geotiffs: no map {name!r}{did_you_mean(name, known)}; there are {', '.join(known)}")


def _rasterio():
    try:
        import rasterio
        import rasterio.transform
    except ImportError as error:
        raise InputError('GeoTIFF files need rasterio; pip install "landlab_debrisflow[geo]"') from error
    return rasterio


def _system(crs, rasterio):
    """Return a coordinate reference system as rasterio has it."""
    try:
        return rasterio.CRS.from_user_input(crs)
    except rasterio.errors.CRSError as error:
        raise InputError(f"crs: no such coordinate reference system, got {crs!r}; give WKT or 'EPSG:number'") from error
