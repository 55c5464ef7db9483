"""Exposure of buildings, roads and further shapes to the flow, as a table."""

import os
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ..core.errors import InputError
from ..core.hints import did_you_mean
from ..grid.fields import OUTPUT_PREFIX
from ..record.files import write_atomically
from ..record.written_maps import LEAST_DEPTH, mask_peaks
from .geotiff import lattice_of
from .lattice import Lattice

ELEVATION = "topographic__elevation"

QUANTITIES = {
    "max_depth": "m", "max_speed": "m_s", "max_impact_pressure": "kPa", "max_run_up": "m", "deposit_depth": "m",
}  # fmt: skip
"""Maps of which a table has the largest value and the mean, and the ending of the names of columns, their unit."""

FACTORS = {"kPa": 1e-3}
"""Factors from the units of the maps to those of the table."""

ARRIVAL = OUTPUT_PREFIX + "arrival_time"

SHIFTS = (0, 1), (0, -1), (1, 0), (-1, 0)


def exposure(
    maps: xr.Dataset,
    shapes: Any,
    *,
    identifier: str | None = None,
    crs: str | None = None,
    least_depth: float = LEAST_DEPTH,
) -> Any:
    """Return the largest depth, speed and pressure, and the first arrival, at every shape.

    A shape has the cells that it covers in part or whole, so one smaller than a cell has values, too. The **largest**
    value is that over all these cells, the **mean** is weighted with the area of each cell inside the shape (the length
    for lines); cells that the flow did not reach count as 0. A **closed** cell, a building that was made a wall, has
    the impact pressure and run-up at its own faces; for depth, speed, deposit and arrival the open cells at the faces
    of its closed cells take part in the largest value, and make the mean if no cell of the shape is open.

    Parameters
    ----------
    maps : xarray.Dataset
        As `DebrisFlow.maps` returns them, or as `write_maps` wrote them.
    shapes : geopandas.GeoDataFrame, str or os.PathLike
        Polygons, lines or points with their attributes, or a file of them.
    identifier : str, optional
        Column whose values name the shapes, each once; by default the shapes are numbered from 1.
    crs : str, optional
        Coordinate reference system of the maps; by default the one that they have. Shapes of another one are brought
        into it.
    least_depth : float
        Peaks where the flow was never as deep are left out [m].

    Returns
    -------
    geopandas.GeoDataFrame
        One row for every shape, in their order: ``id``, ``reached``, ``max_depth_m``, ``mean_max_depth_m``,
        ``max_speed_m_s``, ..., ``first_arrival_s`` (missing where nothing came), ``cells``, ``on_grid`` (part of the
        shape that the grid covers), geometry.

    Raises
    ------
    InputError
        If the maps lack a quantity, a shape is empty or broken, the identifier is missing or not unique, the file
        cannot be read, or no shape touches the grid.
    """
    frame = _frame(shapes)
    lattice = lattice_of(maps, crs)
    frame = _in_system(frame, lattice.crs)
    names = _identifiers(frame, identifier)
    if missing := [name for name in (*QUANTITIES, "arrival_time") if OUTPUT_PREFIX + name not in maps]:
        raise InputError(f"exposure: the maps lack {OUTPUT_PREFIX}{missing[0]}; give flow.maps whole")
    masked = mask_peaks(maps, least_depth)
    closed = np.isnan(maps[ELEVATION].values) if ELEVATION in maps else np.zeros(lattice.shape, bool)
    values = {name: np.nan_to_num(masked[OUTPUT_PREFIX + name].values) for name in QUANTITIES}
    arrival = masked[ARRIVAL].values
    rows = [_row(geometry, lattice, closed, values, arrival) for geometry in frame.geometry]
    if not any(row["on_grid"] for row in rows):
        west, south, east, north = lattice.bounds
        raise InputError(
            f"exposure: none of the {len(rows)} shapes touches the grid, which goes from ({west:.10g}, "
            f"{south:.10g}) to ({east:.10g}, {north:.10g}) m; theirs go from {_extent(frame)}: are they in the system "
            "of the maps?"
        )
    import geopandas

    columns = {"id": names} | {name: [row[name] for row in rows] for name in rows[0]}
    return geopandas.GeoDataFrame(columns, geometry=list(frame.geometry), crs=frame.crs or lattice.crs)


def write_exposure(path: str | os.PathLike[str], table: Any) -> Path:
    """Write a table of exposure, atomically: ``.gpkg`` with the shapes, or ``.csv`` without.

    Parameters
    ----------
    path : str or os.PathLike
        The file; it is replaced if it exists.
    table : geopandas.GeoDataFrame
        As `exposure` returns it.

    Returns
    -------
    pathlib.Path
        Where the file is.

    Raises
    ------
    InputError
        If the suffix is another one or the file cannot be written.

    Examples
    --------
    >>> write_exposure("table.xlsx", None)
    Traceback (most recent call last):
        ...
    landlab_debrisflow.core.errors.InputError: write_exposure: the name must end in .gpkg or .csv, got 'table.xlsx'
    """
    path = Path(path)
    if path.suffix == ".csv":
        text = table.drop(columns=table.geometry.name).to_csv(index=False)
        return write_atomically(path, lambda temporary: temporary.write_text(text, encoding="utf-8"))
    if path.suffix == ".gpkg":
        with warnings.catch_warnings():  # the warning that no coordinate reference system is known: maps may have none
            warnings.filterwarnings("ignore", message="'crs' was not provided")
            return write_atomically(path, lambda temporary: table.to_file(temporary, driver="GPKG", layer="exposure"))
    raise InputError(f"write_exposure: the name must end in .gpkg or .csv, got {path.name!r}")


def _row(geometry, lattice, closed, values, arrival) -> dict[str, Any]:
    """Return the row of a shape; `closed`, `values` by name and `arrival` [s] have the shape of the lattice."""
    rows, columns, measure, on_grid = _cells(geometry, lattice)
    open_cells = ~closed[rows, columns]
    faces = _faces(rows[~open_cells], columns[~open_cells], closed)
    beside = np.concatenate([rows[open_cells], faces[0]]), np.concatenate([columns[open_cells], faces[1]])
    inside = (rows[open_cells], columns[open_cells]), measure[open_cells]
    if not open_cells.any():
        inside = faces, np.ones(faces[0].size)
    row: dict[str, Any] = {"reached": bool(np.any(values["max_depth"][beside] > 0.0))}
    for name, unit in QUANTITIES.items():
        array, factor = values[name], FACTORS.get(unit, 1.0)
        on_walls = name in ("max_impact_pressure", "max_run_up")
        largest = array[rows, columns] if on_walls else array[beside]
        (at, weights) = ((rows, columns), measure) if on_walls else inside
        total = weights.sum()
        column = name if name.startswith("max") else f"max_{name}"
        row[f"{column}_{unit}"] = factor * float(largest.max(initial=0.0))
        row[f"mean_{name}_{unit}"] = factor * float(np.sum(weights * array[at]) / total) if total > 0.0 else 0.0
    times = arrival[beside]
    times = times[np.isfinite(times) & (times >= 0.0)]
    row["first_arrival_s"] = float(times.min()) if times.size else np.nan
    return row | {"cells": int(rows.size), "on_grid": on_grid}


def _cells(geometry, lattice: Lattice):
    """Return rows and columns of the cells under a shape, its measure in each, and the part of it on the grid.

    The measure is area, length or number of points. A shape that only touches sides of cells has these.
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


def _faces(rows, columns, closed):
    """Return rows and columns of the open cells beside the sides of closed ones, each once."""
    found = set()
    for dr, dc in SHIFTS:
        found.update(zip((rows + dr).tolist(), (columns + dc).tolist(), strict=True))
    inside = [(r, c) for r, c in sorted(found) if 0 <= r < closed.shape[0] and 0 <= c < closed.shape[1]]
    free = np.array([(r, c) for r, c in inside if not closed[r, c]], int).reshape(-1, 2)
    return free[:, 0], free[:, 1]


def _frame(shapes):
    """Return shapes as a GeoDataFrame without empty or broken ones."""
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


def _in_system(frame, crs):
    """Return shapes in the coordinate reference system of the maps, if both are known."""
    if crs is None or frame.crs is None:
        return frame
    return frame.to_crs(crs)


def _identifiers(frame, identifier):
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


def _extent(frame) -> str:
    west, south, east, north = frame.total_bounds
    return f"({west:.10g}, {south:.10g}) to ({east:.10g}, {north:.10g})"
