"""Line down the middle of a flow, for long sections of runs without a thalweg of their own."""

import numpy as np
import xarray as xr
from scipy.ndimage import uniform_filter1d
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components, dijkstra

from ..core.errors import InputError
from ..grid.fields import OUTPUT_PREFIX
from .ground import elevation_of, on_increasing_axes, release_outline

NEIGHBOURS = ((0, 1), (1, 0), (1, 1), (1, -1))
"""Steps to half of the eight neighbours of a node, in rows and columns."""

SHALLOW = 0.1
"""Part of the largest depth that counts at least, so that a thin film costs no more than ten times a deep flow [-]."""


def trace_thalweg(maps: xr.Dataset, before: xr.Dataset | None = None) -> np.ndarray:
    """Return a line down the deepest way of a flow, from the highest place of its release [m].

    The line is the cheapest way over the nodes that were reached, where a metre costs one over the peak depth, to the
    node that is farthest by it among the lowest ones; it is smoothed over five nodes.

    Parameters
    ----------
    maps : xarray.Dataset
        As `DebrisFlow.maps` returns them, or read from the ``maps.nc`` of a run.
    before : xarray.Dataset, optional
        Maps before the event, which tell the release; by default as the file of the maps tells, if it does.

    Returns
    -------
    ndarray, shape (n, 2)
        Map coordinates of its vertices.

    Raises
    ------
    InputError
        If the maps have no peak depth, or the flow reached fewer than two nodes.
    """
    elevation, name = elevation_of(maps).values, f"{OUTPUT_PREFIX}max_depth"
    if name not in maps:
        raise InputError(f"plots: the maps lack {name}, by which a line is found; give flow.maps whole")
    peak = on_increasing_axes(maps[name])
    depth = np.nan_to_num(peak.values)
    reached = (depth > 0.0) & np.isfinite(elevation)
    nodes = np.flatnonzero(reached)
    if nodes.size < 2:
        raise InputError("plots: the flow reached fewer than two nodes, there is no line down them; give a line")
    ways, numbers = _ways(reached, depth, peak)
    _, piece = connected_components(ways, directed=False)
    region = release_outline(maps, before)
    start = _start(nodes, elevation, None if region is None else region.values & reached, piece, depth)
    start = int(numbers[start])
    cost, earlier = dijkstra(ways, directed=False, indices=start, return_predecessors=True)
    distance = np.hypot(*(np.array(np.unravel_index(nodes, depth.shape)) - np.array(
        np.unravel_index(nodes[start], depth.shape))[:, None]))  # fmt: skip
    end = int(np.argmax(np.where(np.isfinite(cost), distance, -1.0)))
    path = [end]
    while path[-1] != start and earlier[path[-1]] >= 0:
        path.append(int(earlier[path[-1]]))
    rows, columns = np.unravel_index(nodes[path[::-1]], depth.shape)
    line = np.stack([peak.x.values[columns], peak.y.values[rows]], axis=1)
    smooth = uniform_filter1d(line, min(5, len(line)), axis=0, mode="nearest")
    smooth[0], smooth[-1] = line[0], line[-1]
    return smooth


def _ways(reached: np.ndarray, depth: np.ndarray, peak: xr.DataArray) -> tuple[coo_matrix, np.ndarray]:
    """Return the costs between neighbours that were reached, and the number of each node among them, -1 elsewhere."""
    numbers = np.full(reached.size, -1)
    numbers[np.flatnonzero(reached)] = np.arange(int(reached.sum()))
    grid = numbers.reshape(reached.shape)
    dy, dx = (float(peak[axis][1] - peak[axis][0]) for axis in ("y", "x"))
    price = 1.0 / np.maximum(depth, SHALLOW * depth.max())
    entries = []
    for down, right in NEIGHBOURS:
        here = (slice(0, reached.shape[0] - down), slice(max(0, -right), reached.shape[1] - max(0, right)))
        there = (slice(down, None), slice(max(0, right), reached.shape[1] + min(0, right)))
        both = reached[here] & reached[there]
        length = float(np.hypot(down * dy, right * dx))
        cost = 0.5 * length * (price[here] + price[there])[both]
        entries.append((grid[here][both], grid[there][both], cost))
    first, second, cost = (np.concatenate(parts) for parts in zip(*entries, strict=True))
    return coo_matrix((cost, (first, second)), shape=(int(reached.sum()),) * 2).tocsr(), numbers


def _start(nodes, elevation, released, piece, depth) -> int:
    """Return the node at which the line begins: the highest of the release, or of the piece with most volume."""
    largest = int(np.argmax(np.bincount(piece, depth.ravel()[nodes])))
    within = nodes[piece == largest]
    if released is not None and (inside := within[released.ravel()[within]]).size:
        within = inside
    return int(within[np.argmax(elevation.ravel()[within])])
