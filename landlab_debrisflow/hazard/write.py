"""Hazard maps as files: NetCDF, GeoTIFF with styles, pictures, and the table of exposed shapes."""

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from ..core.version import __version__
from ..geo.exposure import ELEVATION, write_exposure
from ..geo.geotiff import lattice_of, write_geotiff
from ..geo.lattice import Lattice
from ..geo.styles import Style, style_for, write_style
from ..plots import draw_danger_levels, draw_probability, save_figure
from ..plots.map_frame import reference_name
from ..plots.style import unit_text
from ..record.attributes import variable_attributes
from ..record.files import check_directory, write_dataset
from ..record.georeference import GRID_MAPPING
from .files import EXPOSURE, HAZARD, LEVELS
from .matrix import SWISS_LEVELS, HazardMatrix
from .summary import probabilities_of

DPI = 150
"""Dots per inch of pictures."""


TAGS = "ensemble_digest", "sampling", "members_completed", "sampling_error", "members", "effective_sample_size"
"""Attributes of maps that their GeoTIFFs have, too."""


class Layer(NamedTuple):
    """Map of a hazard Dataset that is written as a file of its own.

    Attributes
    ----------
    file : str
        Name of the file without suffix.
    variable : str
    threshold : object
        Threshold, class or quantile; None without.
    values : xarray.DataArray
        Over ``y`` and ``x``.
    """

    file: str
    variable: str
    threshold: Any
    values: xr.DataArray


def write_hazard(
    directory: str | os.PathLike[str], maps: xr.Dataset, *, elevation: Any = None, exposure: Any = None,
    shapes: Any = None, pictures: bool = True,
) -> list[Path]:  # fmt: skip
    """Write hazard maps into a directory.

    ``hazard.nc`` has all of them with their errors and attributes. Each probability, its standard error and each
    quantile is a GeoTIFF, such as ``probability_of_max_depth_above_0.5_m.tif``, with a style for QGIS; values of 0 are
    missing there. Each probability has a picture beside it.

    Parameters
    ----------
    directory : str or os.PathLike
        Existing directory.
    maps : xarray.Dataset
        As `hazard_maps` returns them, or predictive maps of a calibration.
    elevation : array_like, shape (rows, columns), optional
        Elevation of the ground, for pictures [m].
    exposure : geopandas.GeoDataFrame, optional
        As `exposure_probabilities` returns it; written as ``exposure.gpkg`` and ``exposure.csv``.
    shapes : object, optional
        Polygons and lines that pictures show; by default those of `exposure`.
    pictures : bool
        Whether pictures are drawn.

    Returns
    -------
    list of pathlib.Path

    Raises
    ------
    InputError, OutputError
        If a file cannot be written.
    """
    folder, lattice = check_directory(directory), lattice_of(maps)
    whole = with_ground(maps, elevation)
    paths = [write_dataset(folder / HAZARD, whole)]
    tags = {"software": f"landlab_debrisflow {__version__}"}
    tags |= {name: maps.attrs[name] for name in TAGS if name in maps.attrs}
    for layer in layers_of(maps):
        paths.append(_write_layer(folder, layer, lattice, tags))
    if exposure is not None:
        paths += [write_exposure(folder / f"{EXPOSURE}{suffix}", exposure) for suffix in (".gpkg", ".csv")]
    if pictures:
        drawn = exposure if shapes is None else shapes
        for layer in (one for one in layers_of(maps) if one.variable in probabilities_of(maps)):
            name = layer.variable.removeprefix("probability_of_")
            figure = draw_probability(whole, name, layer.threshold, shapes=drawn)
            paths.append(save_figure(figure, folder / f"{layer.file}.png", DPI))
    return paths


def write_danger_levels(
    directory: str | os.PathLike[str], levels: xr.Dataset, matrix: HazardMatrix = SWISS_LEVELS, *,
    elevation: Any = None, shapes: Any = None,
) -> list[Path]:  # fmt: skip
    """Write danger levels as ``danger_level.nc``, ``.tif`` with a style, and ``.png``.

    Parameters
    ----------
    directory : str or os.PathLike
        Existing directory.
    levels : xarray.Dataset
        As `hazard_matrix` returns them.
    matrix : HazardMatrix
        Matrix that they are of.
    elevation, shapes : optional
        As in `write_hazard`.

    Returns
    -------
    list of pathlib.Path

    Raises
    ------
    InputError, OutputError
        If a file cannot be written.
    """
    folder, whole = check_directory(directory), with_ground(levels, elevation)
    found, count = levels[LEVELS], len(matrix.levels)
    tags = {name: levels.attrs[name] for name in ("hazard_scale", "hazard_matrix", "hazard_matrix_source")}
    tif = write_geotiff(
        folder / f"{LEVELS}.tif", found.where(found > 0).values, lattice_of(levels), description="danger level",
        tags=tags,
    )  # fmt: skip
    style = Style(
        tuple(np.arange(1, count + 1) - 0.5), "viridis", labels=("none", *matrix.levels),
        shades=("#ffffff", *matrix.colours),
    )  # fmt: skip
    write_style(tif.with_suffix(".qml"), style, transparent_below=True)
    figure = draw_danger_levels(
        found, matrix.levels, matrix.colours, relief=whole.get(ELEVATION), reference=reference_name(levels),
        shapes=shapes,
    )  # fmt: skip
    return [
        write_dataset(folder / f"{LEVELS}.nc", whole), tif, save_figure(figure, folder / f"{LEVELS}.png", DPI),
    ]  # fmt: skip


def with_ground(maps: xr.Dataset, elevation: Any) -> xr.Dataset:
    """Return maps with the elevation of the ground, if it is given.

    Parameters
    ----------
    maps : xarray.Dataset
    elevation : array_like, shape (rows, columns), or None
        [m]

    Returns
    -------
    xarray.Dataset
    """
    if elevation is None:
        return maps
    words = variable_attributes("m", "Land surface topographic elevation")
    if GRID_MAPPING in maps.coords:
        words["grid_mapping"] = GRID_MAPPING
    return maps.assign({ELEVATION: (("y", "x"), np.asarray(elevation, np.float32), words)})


def layers_of(maps: xr.Dataset) -> Iterator[Layer]:
    """Yield the maps that are files of their own: probabilities, their standard errors, quantiles, means.

    Parameters
    ----------
    maps : xarray.Dataset
        As `hazard_maps` returns them.

    Yields
    ------
    Layer
    """
    known = probabilities_of(maps)
    errors = [f"{name}_standard_error" for name in known]
    errors = [name for name in errors if name in maps and bool(maps[name].notnull().any())]
    others = [str(name) for name in maps if str(name).startswith(("quantile_of_", "mean_of_"))]
    for name in [*known, *errors, *(one for one in others if not one.endswith(("_low", "_high")))]:
        values = maps[name]
        (axis,) = [str(dim) for dim in values.dims if dim not in ("y", "x")] or [""]
        if not axis:
            yield Layer(name, name, None, values)
            continue
        for k, bound in enumerate(maps[axis].values.tolist()):
            file = _file(name, axis, bound, str(maps[axis].attrs.get("units", "")))
            yield Layer(file, name, bound, values.isel({axis: k}))


def _file(name: str, axis: str, bound: Any, unit: str) -> str:
    if axis == "hazard_class":
        return f"{name}_{bound}".replace(" ", "_")
    if axis == "quantile":
        return f"{name}_{bound:g}"
    return f"{name}_above_{bound:g}_{unit.replace('/', '_')}"


def _write_layer(folder: Path, layer: Layer, lattice: Lattice, tags: dict[str, Any]) -> Path:
    data = layer.values
    shown = data.where(data > 0.0).values
    words = f"{data.attrs['long_name']}, {layer.file}"
    unit = unit_text(str(data.attrs["units"]))
    path = write_geotiff(
        folder / f"{layer.file}.tif", shown, lattice, description=words, unit="" if unit == "–" else unit, tags=tags
    )
    write_style(path.with_suffix(".qml"), style_for(layer.variable, shown))
    return path
