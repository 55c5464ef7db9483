"""Polygons, lines and points from files."""

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ..core.errors import InputError
from .lattice import Lattice


class Shape(NamedTuple):
    """Shape on the map.

    Attributes
    ----------
    geometry : shapely geometry
        In the coordinate reference system that was asked for [m].
    attributes : dict
        Values of the feature by name.
    label : str
        File and number of the feature, for messages.
    """

    geometry: Any
    attributes: dict[str, Any]
    label: str


def read_shapes(path: str | Path, crs: str | None = None) -> list[Shape]:
    """Read the shapes of a vector file.

    Parameters
    ----------
    path : str or Path
        GeoPackage, GeoJSON, Shapefile or another format that GDAL reads.
    crs : str, optional
        Coordinate reference system of the result.

    Returns
    -------
    list of Shape

    Raises
    ------
    InputError
        If the file is missing or holds no shapes.
    """
    import geopandas

    path = Path(path)
    if not path.exists():
        raise InputError(f"cannot read {path}: there is no such file")
    try:
        frame = geopandas.read_file(path)
    except Exception as error:
        raise InputError(f"cannot read {path} as shapes: {error}; give a GeoPackage, GeoJSON or Shapefile") from error
    if crs is not None and frame.crs is not None:
        frame = frame.to_crs(crs)
    records = frame.drop(columns=frame.geometry.name).to_dict("records")
    return [
        Shape(geometry, attributes, f"{path.name} feature {k + 1}")
        for k, (geometry, attributes) in enumerate(zip(frame.geometry, records, strict=True))
    ]


def covered_fraction(polygon: Any, lattice: Lattice) -> np.ndarray:
    """Return the part of the cell around every node that a polygon covers, shape (rows, columns) [-]."""
    import shapely

    fraction = np.zeros(lattice.shape)
    west, south, east, north = polygon.bounds
    (dx, dy), (x0, y0) = lattice.spacing, lattice.lower_left
    columns = np.arange(max(0, int((west - x0) / dx - 0.5)), min(lattice.shape[1], int((east - x0) / dx + 0.5) + 2))
    rows = np.arange(max(0, int((south - y0) / dy - 0.5)), min(lattice.shape[0], int((north - y0) / dy + 0.5) + 2))
    if rows.size and columns.size:
        x, y = np.meshgrid(x0 + dx * columns, y0 + dy * rows)
        cells = shapely.box(x - 0.5 * dx, y - 0.5 * dy, x + 0.5 * dx, y + 0.5 * dy)
        fraction[np.ix_(rows, columns)] = shapely.area(shapely.intersection(cells, polygon)) / lattice.area
    return fraction
