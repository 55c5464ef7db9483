"""Ground of a scene, from its keys and files to arrays over nodes."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from scipy.ndimage import binary_dilation, label

from ..core.checks import in_range
from ..core.errors import InputError
from ..geo.cover import nodes_inside
from ..geo.lattice import Lattice, Window, extent
from ..geo.names import said
from ..geo.rasters import MOST_NODES, checksum_of, open_raster, read_window
from ..geo.references import check_reference
from ..geo.resampling import COARSER, read_onto, resample
from ..geo.source import RasterSource
from ..grid.elevation_checks import HOLE, SUSPECT
from .content import SceneContent
from .edits import Ground, edit_ground
from .gully import gully
from .reach import reachable_window, starting_shapes
from .terrain_keys import TerrainKeys
from .zones import VECTORS, has_suffix, parameter_fields, polygons_of, zone_nodes

ELEVATION, SOIL = "topographic__elevation", "soil__depth"
BED_FIELDS = {
    "bed_pressure_ratio": "bed__excess_pore_pressure_ratio",
    "bed_degree_of_saturation": "bed__degree_of_saturation",
}
"""Keys of the pore water of the bed, alike in the terrain, its zones and the material, and the fields for them."""
FEW_NODES = 250_000
"""Largest number of nodes of a DEM that is taken as a whole if no window is given: a part of it would save nothing."""
SMALLEST = 5
"""Least number of rows and of columns of a terrain."""


def build_terrain(content: SceneContent, folder: Path) -> xr.Dataset:
    """Return elevation, soil and varying parameters over ``y`` and ``x``, named as fields of the grid.

    Parameters
    ----------
    content : SceneContent
        Keys of the scene. From its releases and inflow ``window: reach`` starts; the pore water of the bed of its
        material holds outside the zones with another one, unless the terrain gives one.
    folder : Path
        Directory to which names of files are relative.

    Returns
    -------
    xarray.Dataset
        With ``topographic__elevation`` [m], NaN where there are no data; ``soil__depth`` [m] if there is erodible soil;
        ``bed__excess_pore_pressure_ratio`` and ``bed__degree_of_saturation`` [-] if given; a field for each parameter
        that varies; and ``closed``, bool, if buildings close nodes. Attributes: ``crs_wkt``, the coordinate reference
        system, "" if it is not known; ``dem`` and ``dem_sha256``, name and checksum of the file; ``notes``, remarks and
        doubts for the user.

    Raises
    ------
    InputError
        If a file cannot be used, or files do not fit each other.
    """
    notes: list[str] = []
    keys, setup = content.terrain, content.setup
    source, checksum = _example(keys) if keys.example is not None else _dem(keys, folder, notes)
    window = _window(keys, source, folder, content.release, setup.inflow, notes)
    lattice, elevation = _elevation(keys, source, window, notes)
    _note_missing(elevation, notes)
    zones = zone_nodes(keys.zones, lattice, source.lattice, folder, notes)
    soil = _soil(keys, lattice, source, folder, zones, notes)
    ground = Ground(elevation, soil, np.zeros(lattice.shape, bool), lattice)
    edit_ground(keys.edits, ground, source.lattice, folder, notes)
    fields: dict[str, Any] = {ELEVATION: elevation, SOIL: soil}
    for key, field in BED_FIELDS.items():
        fields[field] = _bed_water(key, keys, lattice, folder, zones, getattr(setup.material, key), notes)
    fields |= parameter_fields(content.varying, zones, lattice, folder, notes)
    if ground.closed.any():
        fields["closed"] = ground.closed
    return xr.Dataset(
        {name: (("y", "x"), values) for name, values in fields.items() if values is not None},
        {"y": lattice.y, "x": lattice.x},
        {
            "crs_wkt": lattice.crs or "",
            "dem": source.path.name,
            "dem_sha256": checksum,
            "notes": list(dict.fromkeys(notes)),
        },
    )


def lattice_of(terrain: xr.Dataset) -> Lattice:
    """Return the place of the nodes of a terrain on the map."""
    x, y = terrain.x.values, terrain.y.values
    spacing = (float(x[-1] - x[0]) / (x.size - 1), float(y[-1] - y[0]) / (y.size - 1))
    return Lattice((y.size, x.size), spacing, (float(x[0]), float(y[0])), terrain.attrs.get("crs_wkt") or None)


def _dem(keys: TerrainKeys, folder: Path, notes: list[str]) -> tuple[RasterSource, str]:
    source = open_raster(folder / str(keys.elevation), keys.crs, notes)
    check_reference(source.lattice, keys.crs, source.path)
    return source, checksum_of(source.path)


def _example(keys: TerrainKeys) -> tuple[RasterSource, str]:
    """Return the ground that is built in as if it came from a file."""
    elevation, _, lattice = gully()

    def read(window: Window, shape: tuple[int, int]) -> np.ndarray:
        if shape != window.shape:
            raise ValueError("the example is small enough to be read whole")
        return elevation[window].copy()

    return RasterSource(Path(f"example: {keys.example}"), lattice, read), ""


def _window(keys: TerrainKeys, source: RasterSource, folder: Path, releases, inflow, notes: list[str]) -> Window:
    """Return the part of the DEM to run on."""
    lattice, asked = source.lattice, keys.window
    if isinstance(asked, tuple):
        window = lattice.window_around(asked)
        if min(window.shape) < SMALLEST:
            raise InputError(
                f"window: [west, south, east, north] must hold {SMALLEST} x {SMALLEST} nodes of the DEM or more, "
                f"which covers {extent(lattice.bounds)}; got {extent(asked)}"
            )
        return window
    if asked == "all" or (asked is None and lattice.size <= FEW_NODES):
        return lattice.window
    starts = starting_shapes(releases, inflow, lattice, folder)
    if not starts:
        return lattice.window
    window = reachable_window(source, starts, keys.travel_angle)
    if window.shape != lattice.shape:
        said(
            notes,
            f"window: {window.shape[0]} x {window.shape[1]} of {lattice.shape[0]} x {lattice.shape[1]} nodes can be "
            f"reached at a travel angle of {keys.travel_angle:g} degrees and more "
            f"({extent(lattice.cut(window).bounds)}); window: all takes the whole DEM",
        )
    return window


def _elevation(keys: TerrainKeys, source: RasterSource, window: Window, notes: list[str]):
    """Return lattice and elevation of the terrain, resampled if another spacing is given."""
    own, spacing = source.lattice, keys.spacing
    if min(window.shape) < SMALLEST:
        rows, columns = window.shape
        raise InputError(f"{source.path} has {rows} x {columns} nodes, at least {SMALLEST} x {SMALLEST} are needed")
    if spacing is None or np.allclose(spacing, own.spacing, rtol=1e-6):
        return own.cut(window), read_window(source, window, missing=keys.nodata, notes=notes)
    west, south, east, north = own.bounds
    shape = math.floor((north - south) / spacing + 1e-6), math.floor((east - west) / spacing + 1e-6)
    # cells begin at the south-western corner of the DEM, so that they do not depend on the window
    whole = Lattice(shape, (spacing, spacing), (west + 0.5 * spacing, south + 0.5 * spacing), own.crs)
    part = whole.window_around(own.cut(window).bounds)
    if min(part.shape) < SMALLEST or part.shape[0] * part.shape[1] > MOST_NODES:
        raise InputError(
            f"spacing: {spacing:g} m makes {part.shape[0]} x {part.shape[1]} nodes, {SMALLEST} x {SMALLEST} to "
            f"{MOST_NODES:.0e} are possible; the DEM has {own.spacing[0]:g} m"
        )
    lattice = whole.cut(part)
    bounds, (dx, dy) = lattice.bounds, own.spacing
    needed = own.window_around((bounds[0] - 4 * dx, bounds[1] - 4 * dy, bounds[2] + 4 * dx, bounds[3] + 4 * dy))
    values = read_window(source, needed, missing=keys.nodata, notes=notes)
    how = "means over cells" if lattice.area > COARSER * own.area else "by cubic interpolation, which adds no detail"
    said(notes, f"spacing: elevation from cells of {own.spacing[0]:g} to {spacing:g} m, {how}")
    return lattice, resample(values, own.cut(needed), lattice, "cubic")


def _note_missing(elevation: np.ndarray, notes: list[str]) -> None:
    for value in SUSPECT:
        _note_filled(elevation, value, notes)
    missing = np.isnan(elevation)
    if missing.all():
        raise InputError("elevation: there are no data in the window, all is NODATA; choose another window or DEM")
    if not missing.any():
        return
    areas, count = label(missing)
    edge = np.unique(np.concatenate([areas[0], areas[-1], areas[:, 0], areas[:, -1]]))
    holes = np.setdiff1d(np.arange(1, count + 1), edge)
    if holes.size:
        nodes = int(np.isin(areas, holes).sum())
        said(
            notes,
            f"elevation: {holes.size} holes without data, {nodes} nodes, are closed, so that the flow goes round them; "
            "fill them first if there is ground (gdal_fillnodata, or QGIS: Fill nodata)",
        )
    if missing.sum() > sum(np.isin(areas, holes).reshape(-1)):
        outside = int(missing.sum() - np.isin(areas, holes).sum())
        said(notes, f"elevation: {outside} nodes at the edge are without data and closed")


def _note_filled(elevation: np.ndarray, value: float, notes: list[str]) -> None:
    """Note nodes of an elevation [m] by which voids are filled, at the edge too, if all ground beside is far higher."""
    filled = elevation == value
    if not filled.any():
        return
    beside = elevation[binary_dilation(filled) & ~filled & ~np.isnan(elevation)]
    if beside.size and beside.min() - value >= HOLE:
        said(
            notes,
            f"elevation: exactly {value:g} m at {np.count_nonzero(filled)} nodes, and the ground beside them is "
            f"{beside.min() - value:.4g} m higher and more: if {value:g} marks missing data, give terrain: nodata: "
            f"{value:g}; as it is, a flow that comes there falls",
        )


def _soil(keys: TerrainKeys, lattice: Lattice, source: RasterSource, folder: Path, zones, notes: list[str]):
    """Return the depth of erodible soil, or None if there is none."""
    value = keys.soil_depth
    if value is None and keys.example is not None:
        soil = resample(gully()[1], gully()[2], lattice)
    elif value is None:
        soil = None
    elif has_suffix(value, VECTORS):
        soil = np.zeros(lattice.shape)
        for shape in polygons_of(value, source.lattice, folder, notes):
            depth = shape.number("soil_depth", low=0.0)
            if depth is None:
                raise InputError(f"soil_depth: {shape.lacks('soil_depth')}")
            soil.reshape(-1)[nodes_inside(shape.geometry, lattice)] = depth
    else:
        soil = _number_or_raster("soil_depth", value, lattice, folder, keys.crs, notes, (0.0, np.inf), "m")
    for zone, nodes in zip(keys.zones, zones, strict=True):
        if zone.soil_depth is not None:
            soil = np.zeros(lattice.shape) if soil is None else soil
            soil.reshape(-1)[nodes] = zone.soil_depth
    return soil


def _bed_water(
    key: str, keys: TerrainKeys, lattice: Lattice, folder: Path, zones, elsewhere: float, notes: list[str]
):  # fmt: skip
    """Return the values at all nodes of a `key` of `BED_FIELDS` [-], or None if neither terrain nor zone gives it.

    `elsewhere` is that of the material, which holds outside the zones if the terrain gives none [-].
    """
    values, value = None, getattr(keys, key)
    if value is not None:
        values = _number_or_raster(key, value, lattice, folder, keys.crs, notes, (0.0, 1.0), "-")
    for zone, nodes in zip(keys.zones, zones, strict=True):
        if getattr(zone, key) is not None:
            values = np.full(lattice.shape, elsewhere) if values is None else values
            values.reshape(-1)[nodes] = getattr(zone, key)
    return values


def _number_or_raster(name: str, value, lattice: Lattice, folder: Path, crs, notes: list[str], bounds, unit: str):
    """Return a number or the values of a raster at all nodes, 0 where the raster has no data."""
    if not isinstance(value, str):
        return np.full(lattice.shape, float(value))
    values = read_onto(folder / value, lattice, crs, lengths=unit == "m", notes=notes)
    missing = np.isnan(values)
    if missing.any():
        said(notes, f"{name}: 0 at {np.count_nonzero(missing)} nodes without data in {value}")
    values[missing] = 0.0
    low, high = bounds
    in_range(f"{name}: values of {folder / value}", values, low, high, unit, form="g", error=InputError)
    return values
