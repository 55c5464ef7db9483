"""Exposure of buildings, roads and further shapes to the flow, as a table."""

import os
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ..core.errors import InputError
from ..grid.fields import OUTPUT_PREFIX
from ..record.files import write_atomically
from ..record.written_maps import LEAST_DEPTH, mask_peaks
from .exposed_shapes import cells_under, check_on_grid, identifiers, in_system, open_faces, shape_frame
from .geotiff import lattice_of

ELEVATION = "topographic__elevation"

QUANTITIES = {
    "max_depth": "m", "max_speed": "m_s", "max_impact_pressure": "kPa", "max_run_up": "m", "deposit_depth": "m",
}  # fmt: skip
"""Maps of which a table has the largest value and the mean, and the ending of the names of columns, their unit."""

FACTORS = {"kPa": 1e-3}
"""Factors from the units of the maps to those of the table."""

ARRIVAL = OUTPUT_PREFIX + "arrival_time"


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
    frame = shape_frame(shapes)
    lattice = lattice_of(maps, crs)
    frame = in_system(frame, lattice.crs)
    names = identifiers(frame, identifier)
    if missing := [name for name in (*QUANTITIES, "arrival_time") if OUTPUT_PREFIX + name not in maps]:
        raise InputError(f"exposure: the maps lack {OUTPUT_PREFIX}{missing[0]}; give flow.maps whole")
    masked = mask_peaks(maps, least_depth)
    closed = np.isnan(maps[ELEVATION].values) if ELEVATION in maps else np.zeros(lattice.shape, bool)
    values = {name: np.nan_to_num(masked[OUTPUT_PREFIX + name].values) for name in QUANTITIES}
    arrival = masked[ARRIVAL].values
    rows = [_row(geometry, lattice, closed, values, arrival) for geometry in frame.geometry]
    check_on_grid(frame, lattice, [row["on_grid"] for row in rows])
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
    rows, columns, measure, on_grid = cells_under(geometry, lattice)
    open_cells = ~closed[rows, columns]
    faces = open_faces(rows[~open_cells], columns[~open_cells], closed)
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
