"""Lines over a map: rims of regions, polygons and lines of a GIS."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from numpy.typing import ArrayLike

from ..core.errors import InputError
from .style import NOTE, halo, plain_text


def draw_outline(axes: Axes, region: xr.DataArray, *, color: str = "black", linestyle: str = "-") -> LineCollection:
    """Draw the rim of a region along the edges of its cells.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    region : xarray.DataArray of bool
        Over ``y`` and ``x``.
    color, linestyle : str
        Colour, as in matplotlib.

    Returns
    -------
    matplotlib.collections.LineCollection
    """
    lines = LineCollection(
        list(rim(region)), colors=color, linewidths=1.1, linestyles=linestyle, path_effects=halo(2.2), zorder=6
    )
    axes.add_collection(lines, autolim=False)
    return lines


def draw_shapes(axes: Axes, shapes: Any, *, color: str = "black") -> LineCollection:
    """Draw polygons and lines as lines.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    shapes : object
        GeoDataFrame, geometry of shapely, GeoJSON mapping, or arrays of vertices of shape (n, 2) in map coordinates
        [m]; a sequence of them, or a mapping of names to them.
    color : str
        Colour, as in matplotlib.

    Returns
    -------
    matplotlib.collections.LineCollection

    Raises
    ------
    InputError
        If a shape has no coordinates.
    """
    lines = LineCollection(list(lines_of(shapes)), colors=color, linewidths=1.0, path_effects=halo(2.0), zorder=7)
    axes.add_collection(lines, autolim=False)
    return lines


def draw_places(axes: Axes, places: Mapping[str, ArrayLike]) -> None:
    """Draw points and lines with their names, such as gauges and sections.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    places : mapping of str to array_like, shape (2,) or (n, 2)
        Map coordinates of a point, or of the vertices of a line, by name [m].
    """
    for name, place in places.items():
        vertices = np.atleast_2d(np.asarray(place, float))[:, :2]
        vertices = vertices[np.isfinite(vertices).all(axis=1)]
        if vertices.size == 0:
            continue
        mark: dict[str, Any] = {"marker": "o", "markersize": 4.0} if len(vertices) == 1 else {"linewidth": 1.4}
        axes.plot(*vertices.T, color="black", path_effects=halo(3.0), zorder=8, label="_place", **mark)
        axes.annotate(
            plain_text(name), vertices[np.argmax(vertices[:, 1])], xytext=(0.0, 3.0), textcoords="offset points",
            ha="center", va="bottom", fontsize=NOTE, path_effects=halo(), zorder=9, annotation_clip=True,
        )  # fmt: skip


def lines_of(shapes: Any) -> Iterator[np.ndarray]:
    """Yield the vertices of all lines and rims of polygons, each of shape (n, 2) [m].

    Parameters
    ----------
    shapes : object
        As in `draw_shapes`.

    Examples
    --------
    >>> house = {"type": "Polygon", "coordinates": [[[0, 0], [10, 0], [10, 8], [0, 0]]]}
    >>> [line.shape for line in lines_of({"house": house, "road": [[0, 0], [50, 20]]})]
    [(4, 2), (2, 2)]
    """
    if hasattr(shapes, "__geo_interface__"):
        shapes = shapes.__geo_interface__
    if isinstance(shapes, Mapping) and "type" in shapes:
        yield from _lines_of_geojson(shapes)
    elif isinstance(shapes, Mapping):
        for shape in shapes.values():
            yield from lines_of(shape)
    elif _is_line(shapes):
        yield np.asarray(shapes, float)[:, :2]
    elif isinstance(shapes, Iterable) and not isinstance(shapes, str | bytes):
        for shape in shapes:
            yield from lines_of(shape)
    else:
        raise InputError(
            f"plots: shapes must be polygons or lines with map coordinates, a GeoDataFrame for one, got {shapes!r:.60}"
        )


def rim(region: xr.DataArray) -> np.ndarray:
    """Return the cell edges between True and False, shape (edges, 2 ends, 2 coordinates) [m].

    Parameters
    ----------
    region : xarray.DataArray of bool
        Over ``y`` and ``x``, which increase.
    """
    mask = np.pad(region.values.astype(bool), 1)
    edge_x, edge_y = (
        np.append(a - 0.5 * (a[1] - a[0]), a[-1] + 0.5 * (a[1] - a[0])) for a in (region.x.values, region.y.values)
    )
    row, column = np.nonzero(mask[1:-1, 1:] != mask[1:-1, :-1])
    upright = np.stack([edge_x[[column, column]], edge_y[[row, row + 1]]], axis=-1)
    row, column = np.nonzero(mask[1:, 1:-1] != mask[:-1, 1:-1])
    level = np.stack([edge_x[[column, column + 1]], edge_y[[row, row]]], axis=-1)
    return np.concatenate([upright, level], axis=1).swapaxes(0, 1)


def _is_line(shape: ArrayLike) -> bool:
    try:
        vertices = np.asarray(shape, float)
    except (TypeError, ValueError):
        return False
    return vertices.ndim == 2 and vertices.shape[0] >= 2 and vertices.shape[1] in (2, 3)


def _lines_of_geojson(shape: Mapping[str, Any]) -> Iterator[np.ndarray]:
    kind = shape["type"]
    if kind == "FeatureCollection":
        for feature in shape["features"]:
            yield from _lines_of_geojson(feature)
    elif kind == "Feature":
        if shape["geometry"] is not None:
            yield from lines_of(shape["geometry"])
    elif kind == "GeometryCollection":
        for geometry in shape["geometries"]:
            yield from lines_of(geometry)
    elif kind in ("LineString", "MultiLineString", "Polygon", "MultiPolygon"):
        yield from lines_of(_nested(shape["coordinates"], {"LineString": 0, "MultiPolygon": 2}.get(kind, 1)))


def _nested(coordinates: Any, depth: int) -> list[Any]:
    """Return a list of lines from coordinates of GeoJSON that are nested so deep."""
    if depth == 0:
        return [coordinates]
    return [line for part in coordinates for line in _nested(part, depth - 1)]
