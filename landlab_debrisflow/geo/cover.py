"""Nodes in and along shapes."""

from typing import Any, NamedTuple

import numpy as np

from .lattice import Lattice

FEW_CELLS = 64
"""Most cells that are intersected with a polygon one by one; more are first sorted in blocks."""

MANY_CORNERS, TILE = 500, 32
"""Least number of corners with which a polygon is first cut into tiles, and the width of a tile in cells."""


class Cover(NamedTuple):
    """Cells that a polygon covers.

    Attributes
    ----------
    nodes : ndarray, shape (n,)
        Numbers of the nodes in these cells, in rising order; the row is the number over the columns of the lattice.
    fraction : ndarray, shape (n,)
        Part of each cell that is covered, above 0 and at most 1 [-].
    """

    nodes: np.ndarray
    fraction: np.ndarray


def cover_cells(polygon: Any, lattice: Lattice) -> Cover:
    """Return the cells that a polygon covers, and which part of each.

    Areas are those of the intersections, so that their sum is the area of the polygon inside the lattice to rounding.

    Parameters
    ----------
    polygon : shapely Polygon or MultiPolygon
        In the coordinates of the lattice [m].
    lattice : Lattice

    Returns
    -------
    Cover
    """
    polygon = _in_cells(polygon, lattice)
    inside, edge = _sorted_out(polygon, lattice.shape)
    fraction = _cut_areas(polygon, *edge)
    columns = lattice.shape[1]
    nodes = np.concatenate([inside[0] * columns + inside[1], edge[0] * columns + edge[1]])
    fraction = np.concatenate([np.ones(inside[0].size), np.minimum(fraction, 1.0)])
    order = np.argsort(nodes)
    order = order[fraction[order] > 0.0]
    return Cover(nodes[order], fraction[order])


def covered_fraction(polygon: Any, lattice: Lattice) -> np.ndarray:
    """Return the part of the cell around every node that a polygon covers, shape (rows, columns) [-].

    For many polygons `cover_cells` is faster: it returns only the cells that are covered.
    """
    fraction, cover = np.zeros(lattice.size), cover_cells(polygon, lattice)
    fraction[cover.nodes] = cover.fraction
    return fraction.reshape(lattice.shape)


def nodes_inside(polygon: Any, lattice: Lattice) -> np.ndarray:
    """Return the numbers of the nodes inside a polygon, shape (n,), in rising order."""
    import shapely

    polygon = _in_cells(polygon, lattice)
    inside, edge = _sorted_out(polygon, lattice.shape)
    shapely.prepare(polygon)
    within = shapely.contains_xy(polygon, edge[1] + 0.5, edge[0] + 0.5)
    columns = lattice.shape[1]
    return np.sort(np.concatenate([inside[0] * columns + inside[1], edge[0][within] * columns + edge[1][within]]))


class Distances(NamedTuple):
    """Nodes near a line.

    Attributes
    ----------
    nodes : ndarray, shape (n,)
        Numbers of the nodes, in rising order.
    distance : ndarray, shape (n,)
        To the nearest point of the line, on the map [m].
    station : ndarray, shape (n,)
        Way along the line to that point [m].
    """

    nodes: np.ndarray
    distance: np.ndarray
    station: np.ndarray


def nodes_near(line: Any, lattice: Lattice, reach: float) -> Distances:
    """Return the nodes within some distance of a line, or of the outline of a polygon.

    Parameters
    ----------
    line : shapely LineString or LinearRing
        In the coordinates of the lattice [m].
    lattice : Lattice
    reach : float
        Largest distance [m].

    Returns
    -------
    Distances
    """
    import shapely

    x0, y0 = lattice.lower_left
    line = shapely.transform(line, lambda points: points - (x0, y0))
    west, south, east, north = line.bounds
    (dx, dy), local = lattice.spacing, lattice._replace(lower_left=(0.0, 0.0))
    window = local.window_around((west - reach - dx, south - reach - dy, east + reach + dx, north + reach + dy))
    rows, columns = (np.arange(part.start, part.stop) for part in window)
    # strip by strip of rows: most nodes of the rectangle around a long line are far from it
    found, strip = [], max(1, 1_000_000 // max(columns.size, 1))
    for k in range(0, rows.size, strip):
        row, column = (grid.reshape(-1) for grid in np.meshgrid(rows[k : k + strip], columns, indexing="ij"))
        points = shapely.points(column * dx, row * dy)
        near = shapely.dwithin(line, points, reach) if points.size else np.zeros(0, bool)
        distance, station = shapely.distance(line, points[near]), shapely.line_locate_point(line, points[near])
        found.append((row[near] * lattice.shape[1] + column[near], distance, station))
    if not found:
        return Distances(np.empty(0, int), np.empty(0), np.empty(0))
    return Distances(*(np.concatenate(values) for values in zip(*found, strict=True)))


def _in_cells(polygon, lattice: Lattice):
    """Return a polygon in units of cells from the corner of a lattice, where rounding is small."""
    import shapely

    x0, y0 = lattice.lower_left
    dx, dy = lattice.spacing
    return shapely.transform(polygon, lambda points: (points - (x0, y0)) / (dx, dy) + 0.5)


def _cut_areas(polygon, rows, columns) -> np.ndarray:
    """Return the area of a polygon in each of some cells; a long outline is cut into tiles first."""
    import shapely

    if shapely.get_num_coordinates(polygon) <= MANY_CORNERS:
        return shapely.area(shapely.intersection(_boxes(rows, columns, 1), polygon))
    areas = np.zeros(rows.size)
    tiles, tile_of = np.unique(np.stack([rows // TILE, columns // TILE]), axis=1, return_inverse=True)
    order = np.argsort(tile_of.reshape(-1), kind="stable")
    for tile, cells in zip(tiles.T, np.split(order, np.cumsum(np.bincount(tile_of.reshape(-1)))[:-1]), strict=True):
        piece = shapely.intersection(polygon, _boxes(TILE * tile[0], TILE * tile[1], TILE))
        areas[cells] = shapely.area(shapely.intersection(_boxes(rows[cells], columns[cells], 1), piece))
    return areas


def _boxes(rows, columns, size):
    import shapely

    return shapely.box(columns, rows, columns + size, rows + size)


def _sorted_out(polygon, shape: tuple[int, int]):
    """Return rows and columns of cells wholly inside a polygon, and of cells that its outline may cut.

    Blocks of cells are halved until they lie inside, outside, or are single cells.
    """
    import shapely

    nothing = np.empty(0, int), np.empty(0, int)
    if polygon.is_empty:
        return nothing, nothing
    west, south, east, north = polygon.bounds
    first = np.maximum(np.floor([south, west]), 0.0).astype(int)
    last = np.minimum(np.ceil([north, east]), shape).astype(int)
    if np.any(last <= first):
        return nothing, nothing
    count = last - first
    size = 1
    if count[0] * count[1] > FEW_CELLS:
        shapely.prepare(polygon)
        size = 1 << max(0, int(np.ceil(np.log2(max(count)))) - 2)
    starts = [np.arange(low, high, size) for low, high in zip(first, last, strict=True)]
    rows, columns = (grid.reshape(-1) for grid in np.meshgrid(*starts, indexing="ij"))
    inside = []
    while True:
        if count[0] * count[1] > FEW_CELLS:
            boxes = _boxes(rows, columns, size)
            touching = shapely.intersects(polygon, boxes)
            full = touching.copy()
            full[touching] = shapely.contains(polygon, boxes[touching])
            inside.append(_cells_of(rows[full], columns[full], size, last))
            cut = touching & ~full
            rows, columns = rows[cut], columns[cut]
        if size == 1:
            break
        size //= 2
        rows, columns = (
            (values[:, None] + np.array(steps) * size).reshape(-1)
            for values, steps in ((rows, (0, 0, 1, 1)), (columns, (0, 1, 0, 1)))
        )
        within = (rows < last[0]) & (columns < last[1])
        rows, columns = rows[within], columns[within]
    if not inside:
        return nothing, (rows, columns)
    return tuple(np.concatenate(part) for part in zip(*inside, strict=True)), (rows, columns)


def _cells_of(rows, columns, size, last):
    """Return rows and columns of the single cells in blocks, without cells past the edge."""
    step_rows, step_columns = (grid.reshape(-1) for grid in np.mgrid[:size, :size])
    rows = (rows[:, None] + step_rows).reshape(-1)
    columns = (columns[:, None] + step_columns).reshape(-1)
    within = (rows < last[0]) & (columns < last[1])
    return rows[within], columns[within]
