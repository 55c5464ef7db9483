"""Polygons of observations, brought to the nodes of an event."""

from pathlib import Path
from typing import Any

from ..core.errors import InputError
from ..geo.lattice import extent
from ..geo.shapes import read_shapes
from .place import Place


def polygon_of(value: Any, label: str, place: Place) -> Any:
    """Return the union of polygons in the coordinate reference system of an event.

    Parameters
    ----------
    value : shapely polygon, GeoDataFrame, str, Path or sequence
        Polygons, a file of them, or the corners of one [m].
    label : str
        Name of the observation, for messages.
    place : Place

    Returns
    -------
    shapely Polygon or MultiPolygon

    Raises
    ------
    InputError
        If the file cannot be read, or no polygon covers a node.
    """
    import shapely

    if isinstance(value, shapely.Geometry):
        found = value
    elif hasattr(value, "to_crs"):
        known = place.lattice.crs is not None and value.crs is not None
        found = (value.to_crs(place.lattice.crs) if known else value).geometry.union_all()
    else:
        source = place.folder / value if isinstance(value, str | Path) else [value]
        found = shapely.union_all([one.geometry for one in read_shapes(source, place.lattice.crs, kind="polygon")])
    if not found.area > 0.0:
        raise InputError(f"calibration: {label}: a polygon is needed, got {found.geom_type}; draw an area")
    if not shapely.box(*place.lattice.bounds).intersects(found):
        raise InputError(
            f"calibration: {label}: the polygon, {extent(found.bounds)}, does not touch the grid, "
            f"{extent(place.lattice.bounds)}; is it in the coordinate reference system of the DEM?"
        )
    return found
