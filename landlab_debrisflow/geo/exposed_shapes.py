"""Shapes that may be exposed: read and checked, and the cells of a lattice under them."""

import os
from pathlib import Path

import numpy as np

from ..core.errors import InputError
from ..core.hints import did_you_mean
from .lattice import Lattice

SHIFTS = (0, 1), (0, -1), (1, 0), (-1, 0)


def cells_under(geometry, lattice: Lattice):
    """Return the cells under a shape, or beside it if it only touches sides of cells.

    Parameters
    ----------
    geometry : shapely.Geometry
    lattice : Lattice

    Returns
    -------
    rows, columns : ndarray of int, shape (n,)
    measure : ndarray, shape (n,)
        Area [m2], length [m] or number of points of the shape in each cell.
    on_grid : float
        Part of the shape on the grid.
    """
    import shapely

    (dx, dy), (x0, y0) = lattice.spacing, lattice.lower_left
    west, south, east, north = geometry.bounds
    first = max(0, int(np.floor((south - y0) / dy + 0.5)) - 1), max(0, int(np.floor((west - x0) / dx + 0.5)) - 1)
    last = (
        min(lattice.shape[0] - 1, int(np.floor((north - y0) / dy + 0.5)) + 1),
        min(lattice.shape[1] - 1, int(np.floor((east - x0) / dx + 0.5)) + 1),
    )
    spans = (np.arange(low, high + 1) for low, high in zip(first, last, strict=True))
    rows, columns = (each.ravel() for each in np.meshgrid(*spans, indexing="ij"))
    x, y = x0 + dx * columns, y0 + dy * rows
    boxes = shapely.box(x - 0.5 * dx, y - 0.5 * dy, x + 0.5 * dx, y + 0.5 * dy)
    touched = shapely.intersects(boxes, geometry)
    rows, columns, boxes = rows[touched], columns[touched], boxes[touched]
    measure_of = {0: shapely.get_num_geometries, 1: shapely.length, 2: shapely.area}[shapely.get_dimensions(geometry)]
    measure = np.asarray(measure_of(shapely.intersection(boxes, geometry)), float)
    if np.any(measure > 0.0):
        rows, columns, measure = rows[measure > 0.0], columns[measure > 0.0], measure[measure > 0.0]
    grid = shapely.box(*lattice.bounds)
    on_grid = float(measure_of(shapely.intersection(geometry, grid)) / measure_of(geometry))
    return rows, columns, measure, min(1.0, on_grid)


def open_faces(rows, columns, closed):
    """Return rows and columns of the open cells beside the sides of closed ones, each once.

    Parameters
    ----------
    rows, columns : ndarray of int, shape (n,)
        Closed cells.
    closed : ndarray of bool, shape (rows, columns) of the lattice
    """
    found = set()
    for dr, dc in SHIFTS:
        found.update(zip((rows + dr).tolist(), (columns + dc).tolist(), strict=True))
    inside = [(r, c) for r, c in sorted(found) if 0 <= r < closed.shape[0] and 0 <= c < closed.shape[1]]
    free = np.array([(r, c) for r, c in inside if not closed[r, c]], int).reshape(-1, 2)
    return free[:, 0], free[:, 1]


def shape_frame(shapes):
    """Return shapes as a GeoDataFrame without empty or broken ones.

    Parameters
    ----------
    shapes : geopandas.GeoDataFrame, str or os.PathLike

    Returns
    -------
    geopandas.GeoDataFrame

    Raises
    ------
    InputError
        If there are none, or one cannot be used.
    """
    try:
        import geopandas
        import pandas as pd
        import shapely
    except ImportError as error:
        raise InputError('exposure needs geopandas; pip install "landlab_debrisflow[geo]"') from error
    if isinstance(shapes, str | os.PathLike):
        if not Path(shapes).exists():
            raise InputError(f"exposure: cannot read {os.fspath(shapes)}: there is no such file")
        try:
            shapes = geopandas.read_file(shapes)
        except Exception as error:  # drivers raise errors of many classes
            raise InputError(
                f"exposure: cannot read {os.fspath(shapes)}: {error}; give a GeoPackage, GeoJSON or Shapefile"
            ) from error
    if not isinstance(shapes, geopandas.GeoDataFrame):
        kind = "a table without geometry" if isinstance(shapes, pd.DataFrame) else type(shapes).__name__
        raise InputError(f"exposure: shapes must be a GeoDataFrame or a file of shapes, got {kind}")
    if not len(shapes):
        raise InputError("exposure: there are no shapes")
    geometries = shapes.geometry.values
    bad = np.asarray(shapely.is_missing(geometries) | shapely.is_empty(geometries) | ~shapely.is_valid(geometries))
    if bad.any():
        k = int(np.argmax(bad))
        reason = "empty" if geometries[k] is None or geometries[k].is_empty else shapely.is_valid_reason(geometries[k])
        raise InputError(
            f"exposure: shape {k + 1} of {len(shapes)} cannot be used: {reason}; mend it, with make_valid() or in QGIS"
        )
    return shapes


def in_system(frame, crs):
    """Return shapes in the coordinate reference system of the maps, if both are known."""
    if crs is None or frame.crs is None:
        return frame
    return frame.to_crs(crs)


def identifiers(frame, identifier):
    """Return the names of shapes: the values of a column, or their numbers from 1.

    Raises
    ------
    InputError
        If there is no such column, or a value is there twice.
    """
    if identifier is None:
        return list(range(1, len(frame) + 1))
    if identifier not in frame:
        known = [str(name) for name in frame.columns if name != frame.geometry.name]
        raise InputError(
            f"exposure: the shapes have no attribute {identifier!r}{did_you_mean(identifier, known)}; there are "
            f"{', '.join(known)}"
        )
    names = frame[identifier].tolist()
    if len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise InputError(f"exposure: {identifier} {twice!r} is there twice; give each shape one of its own")
    return names


def extent_of(frame) -> str:
    """Return the corners of the rectangle around shapes in words [m]."""
    west, south, east, north = frame.total_bounds
    return f"({west:.10g}, {south:.10g}) to ({east:.10g}, {north:.10g})"


def check_on_grid(frame, lattice: Lattice, parts) -> None:
    """Refuse shapes of which none touches the grid.

    Parameters
    ----------
    frame : geopandas.GeoDataFrame
    lattice : Lattice
    parts : sequence of float
        Part of each shape on the grid.

    Raises
    ------
    InputError
    """
    if not any(parts):
        west, south, east, north = lattice.bounds
        raise InputError(
            f"exposure: none of the {len(parts)} shapes touches the grid, which goes from ({west:.10g}, "
            f"{south:.10g}) to ({east:.10g}, {north:.10g}) m; theirs go from {extent_of(frame)}: are they in the "
            "system of the maps?"
        )
