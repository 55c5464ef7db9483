"""Part of a DEM that releases can reach."""

import math
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from scipy.ndimage import distance_transform_edt, label

from ..core.errors import InputError
from ..geo.cover import cover_cells
from ..geo.lattice import Bounds, Lattice, Window
from ..geo.rasters import open_raster, read_window
from ..geo.shapes import read_shapes
from ..geo.source import RasterSource
from ..model.inflow.hydrograph import Hydrograph
from .release_keys import ReleaseKeys

MOST_EXAMINED = 1_000_000
"""Most nodes that are examined at once; of a larger part of the DEM only every second, third, ... node is."""
HEAD = 20.0
"""Energy above the ground that a release may begin with, its thickness included [m]."""
MARGIN_NODES, MARGIN = 10, 50.0
"""Least width of the margin around the reached ground, in nodes and in m."""
FIRST_BOX = 500.0
"""Width of the ground around the releases that is examined first [m]."""
MOST_STARTS = 20
"""Largest number of releases with an energy line of their own; further releases share the highest one."""


def starting_shapes(
    releases: Iterable[ReleaseKeys], inflow: Iterable[Hydrograph], lattice: Lattice, folder: Path
) -> list[Any]:
    """Return polygons, points and lines from which mass starts, in the coordinates of a lattice.

    Parameters
    ----------
    releases : iterable of ReleaseKeys
    inflow : iterable of Hydrograph
    lattice : Lattice
        Lattice of the whole DEM.
    folder : Path
        Directory to which names of files are relative.

    Raises
    ------
    InputError
        If a file cannot be read, or shapes lie outside of the DEM.
    """
    import shapely

    shapes = [shapely.LineString([each.line_start, each.line_end]) for each in inflow]
    for k, keys in enumerate(releases):
        try:
            shapes += _release_shapes(keys, lattice, folder)
        except InputError as error:
            raise InputError(f"release[{k}]: {error}") from error
    return shapes


def _release_shapes(keys: ReleaseKeys, lattice: Lattice, folder: Path) -> list[Any]:
    if keys.kind == "raster":
        return [_raster_shape(folder / str(keys.raster), lattice)]
    value, kind = getattr(keys, keys.kind), keys.kind.removesuffix("s")
    source = folder / value if isinstance(value, str) else value
    return [shape.geometry for shape in read_shapes(source, lattice.crs, kind=kind, bounds=lattice.bounds)]


def _raster_shape(path: Path, lattice: Lattice):
    """Return the rectangle around the values above 0 of a raster of depths."""
    import shapely

    source = open_raster(path, lattice.crs)
    values = read_window(source, source.lattice.window)
    rows, columns = np.nonzero(np.nan_to_num(values) > 0.0)
    if rows.size == 0:
        return shapely.box(*source.lattice.bounds)
    part = source.lattice.cut(Window(slice(rows.min(), rows.max() + 1), slice(columns.min(), columns.max() + 1)))
    return shapely.box(*part.bounds)


def reachable_window(source: RasterSource, starts: Sequence[Any], travel_angle: float) -> Window:
    """Return the rectangle around the ground that lies below energy lines from the releases and is connected to them.

    A line falls from the highest point of a release, and `HEAD` above it, with the travel angle in every direction; the
    distance is the straight one, so that bends of the way make the part larger than needed, never smaller. Around it
    there is a margin. Only the necessary part of the DEM is read, thinned out where it is large.

    The angle of 5 degrees by default is below those of long run-outs: L = 1.9 V^0.16 H^0.83 (Rickenmann 1999) gives 6.0
    degrees for 1e7 m3 that fall 300 m, 10.5 degrees for 1e6 m3 and 1000 m; H/L = 0.97 V^-0.105 (Corominas 1996, debris
    flows) 10 degrees for 1e7 m3.

    Parameters
    ----------
    source : RasterSource
        The DEM.
    starts : sequence of shapely geometries
        Releases and lines of inflow.
    travel_angle : float
        [deg]

    Returns
    -------
    Window
    """
    import shapely

    lattice = source.lattice
    width = max(FIRST_BOX, 20.0 * max(lattice.spacing))
    box: Bounds = _widened(tuple(shapely.total_bounds(np.array(starts, object))), width)
    while True:
        window = lattice.window_around(box)
        reached, coarse = _reached(source, window, starts, math.tan(math.radians(travel_angle)))
        rows, columns = np.nonzero(reached)
        if rows.size == 0:
            return window
        touched = (
            columns.min() == 0,
            rows.min() == 0,
            columns.max() == coarse.shape[1] - 1,
            rows.max() == coarse.shape[0] - 1,
        )
        more = (
            window.columns.start > 0, window.rows.start > 0,
            window.columns.stop < lattice.shape[1], window.rows.stop < lattice.shape[0],
        )  # fmt: skip
        if not any(grow := [one and other for one, other in zip(touched, more, strict=True)]):
            break
        width *= 2.0
        box = tuple(edge + sign * width * side for edge, sign, side in zip(box, (-1, -1, 1, 1), grow, strict=True))
    margin = max(MARGIN, MARGIN_NODES * max(lattice.spacing), 2.0 * max(coarse.spacing))
    found = coarse.cut(Window(slice(rows.min(), rows.max() + 1), slice(columns.min(), columns.max() + 1)))
    return lattice.window_around(_widened(found.bounds, margin))


def _widened(bounds: Bounds, width: float) -> Bounds:
    west, south, east, north = bounds
    return west - width, south - width, east + width, north + width


def _reached(source: RasterSource, window: Window, starts: Sequence[Any], gradient: float):
    """Return which nodes of a window are reached, and their lattice, thinned out if the window is large."""
    import shapely

    part = source.lattice.cut(window)
    step = math.ceil(math.sqrt(part.size / MOST_EXAMINED))
    shape = math.ceil(part.shape[0] / step), math.ceil(part.shape[1] / step)
    dx, dy = part.spacing[0] * part.shape[1] / shape[1], part.spacing[1] * part.shape[0] / shape[0]
    corner = part.bounds[0] + 0.5 * dx, part.bounds[1] + 0.5 * dy
    coarse = Lattice(shape, (dx, dy), corner, part.crs)
    elevation = read_window(source, window, shape)
    known = np.isfinite(elevation)
    energy, begun = np.full(shape, -np.inf), np.zeros(shape, bool)
    shapes = list(starts) if len(starts) <= MOST_STARTS else [shapely.union_all(list(starts))]
    for start in shapes:
        nodes = np.zeros(shape, bool)
        nodes.reshape(-1)[cover_cells(start.buffer(0.71 * math.hypot(dx, dy)), coarse).nodes] = True
        nodes &= known
        if nodes.any():
            distance = distance_transform_edt(~nodes, sampling=(dy, dx))
            np.maximum(energy, elevation[nodes].max() + HEAD - gradient * distance, out=energy)
            begun |= nodes
    areas, _ = label(known & (elevation <= energy), np.ones((3, 3)))
    return np.isin(areas, np.setdiff1d(areas[begun], 0)), coarse
