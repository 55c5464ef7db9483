"""Refusals of elevations that no ground has: voids of a DEM filled with a number, elevations in other units.

Slopes of any length, pits and cliffs of some hundred metres are ground and pass. Only differences between neighbours
count, so a DEM may lie at any height, whatever the datum.
"""

import numpy as np
from scipy.ndimage import label

from ..core.errors import InputError
from ..spatial.raster import CLOSED
from .checks import check_finite, where
from .fill_values import closing_call, code_of, is_fill

Z = "topographic__elevation"

HIGHEST_CLIFF = 1500.0
"""Largest height of a cliff steeper than `STEEPEST` [m]: the highest on Earth, of Mount Thor, has 1250 m."""

STEEPEST = 10.0
"""Least slope between two nodes at which a height is taken for a fault of the DEM [-]."""

SUSPECT = (0.0, -1.0, -99.0, -999.0)
"""Elevations that exist, but are also used to fill voids."""

HOLE, SHAFT = 50.0, 300.0
"""Least height of the walls all round a void filled with a number of `SUSPECT`, and with any other [m]."""


MOST_VALUES = 20
"""Most different elevations below high walls that are examined: a filled void has one elevation."""


def check_elevation(grid, elevation) -> None:
    """Refuse elevations that cannot be computed with or cannot be meant, at every node that is not closed.

    `elevation` has shape (nodes,) [m].

    Raises
    ------
    InputError
        With the value, the number of nodes that have it, the first node, and a remedy.
    """
    used = grid.status_at_node != CLOSED
    check_finite(
        grid, Z, elevation,
        f"close the node or mend the DEM: grid.status_at_node[~np.isfinite(grid.at_node['{Z}'])] = "
        "grid.BC_NODE_IS_CLOSED",
    )  # fmt: skip
    low = np.min(elevation, where=used, initial=np.inf)
    high = np.max(elevation, where=used, initial=-np.inf)
    if low <= -9999.0 or high >= 9999.0:  # without a cliff there is no fill value
        _check_fills(grid, elevation, used)
    if high - low > HIGHEST_CLIFF:
        _check_cliffs(grid, elevation, used)
    if high - low > HOLE:
        for value in SUSPECT:
            if low <= value <= high:
                _check_holes(grid, elevation, used, value, HOLE)
    if high - low > SHAFT:
        pairs = _steep_pairs(grid, elevation, used, SHAFT)[0]
        for value in np.unique(elevation[pairs].min(axis=0))[:MOST_VALUES]:
            _check_holes(grid, elevation, used, value, SHAFT)


def _check_fills(grid, elevation, used):
    nodes = np.flatnonzero(used & is_fill(elevation))
    if nodes.size:
        value = elevation[nodes[0]]
        nodes = nodes[elevation[nodes] == value]
        raise InputError(
            f"{Z} is NODATA ({code_of(value)}) at {nodes.size} nodes that are not closed, the first "
            f"is {where(grid, nodes[0])}; close them: {closing_call(Z, value)}"
        )


def _neighbours(grid):
    """Yield slices of nodes and of their neighbours in a raster, the step between their numbers, the distance [m].

    The step is in the numbers of nodes, the distance in m; first along x, then along y.
    """
    yield np.s_[:, :-1], np.s_[:, 1:], 1, float(grid.dx)
    yield np.s_[:-1], np.s_[1:], grid.number_of_node_columns, float(grid.dy)


def _first_nodes(grid, pairs):
    """Return the numbers of the first nodes of the pairs of neighbours that the mask `pairs` chooses."""
    row, column = np.nonzero(pairs)
    return row * grid.number_of_node_columns + column


def _steep_pairs(grid, elevation, used, least):
    """Return pairs of neighbours that are steep and differ by more than `least` [m], shape (2, n), and the most.

    `elevation` [m] and `used` (bool: the node counts) have shape (nodes,). Second value: largest difference of any pair
    [m].
    """
    raster, pairs, most = np.where(used, elevation, np.nan).reshape(grid.shape), [], 0.0
    for one, other, step, spacing in _neighbours(grid):
        height = np.abs(raster[one] - raster[other])
        first = _first_nodes(grid, height > max(least, STEEPEST * spacing))
        pairs.append(np.array([first, first + step]))
        most = max(most, float(np.nanmax(height, initial=0.0)))
    return np.concatenate(pairs, axis=1), most


def _check_cliffs(grid, elevation, used):
    """Refuse steps between neighbours that no cliff has, naming the side that is farther from the rest.

    `elevation` [m] and `used` (bool: the node counts) have shape (nodes,).
    """
    pairs, fall = _steep_pairs(grid, elevation, used, HIGHEST_CLIFF)
    if pairs.size == 0:
        return
    z, middle = np.where(used, elevation, np.nan), np.median(elevation[used])
    odd = np.abs(z[pairs] - middle).argmax(axis=0)
    suspects = np.unique(pairs[odd, np.arange(odd.size)])
    values, count = np.unique(z[suspects], return_counts=True)
    value = values[count.argmax()]
    nodes = np.flatnonzero(z == value)
    close = f"{closing_call(Z, value)}; in a scene file terrain: nodata: {code_of(value)}"
    if nodes.size == 1 < values.size:  # many elevations: the rim of a void that was smoothed into its surroundings
        sign, limit = ("<", values.max()) if value < middle else (">", values.min())
        close = f"grid.status_at_node[grid.at_node['{Z}'] {sign}= {code_of(limit)}] = grid.BC_NODE_IS_CLOSED"
    raise InputError(
        f"{Z} is {code_of(value)} m at {nodes.size} nodes, the first is {where(grid, nodes[0])}, and differs from its "
        f"neighbours by up to {fall:.4g} m, which no ground does; if there are no data close them: {close}; else mend "
        "the DEM (elevations and coordinates are in m)"
    )


def _check_holes(grid, elevation, used, value, deep):
    """Refuse voids of two nodes and more inside the grid that are filled with `value`, `deep` [m] below all around.

    `elevation` [m] and `used` (bool: the node counts) have shape (nodes,); `value` is an elevation [m].
    """
    filled, raster = (used & (elevation == value)).reshape(grid.shape), elevation.reshape(grid.shape)
    usable, rim, sheer = used.reshape(grid.shape), [], []
    for one, other, step, spacing in _neighbours(grid):
        first = _first_nodes(grid, (filled[one] != filled[other]) & usable[one] & usable[other])
        inside = np.where(filled.flat[first], first, first + step)
        rim.append(inside)
        outside = 2 * first + step - inside
        sheer.append(raster.flat[outside] - value >= max(deep, STEEPEST * spacing))
    rim, sheer = np.concatenate(rim), np.concatenate(sheer)
    if not sheer.any():
        return
    patches, count = label(filled)
    hole = np.zeros(count + 1, bool)
    hole[patches.flat[rim[sheer]]] = True
    hole[patches.flat[rim[~sheer]]] = False
    for edge in (patches[0], patches[-1], patches[:, 0], patches[:, -1]):
        hole[edge] = False
    hole &= np.bincount(patches.ravel()) > 1
    nodes = np.flatnonzero(hole[patches])
    if nodes.size == 0:
        return
    close = f"{closing_call(Z, value)}; in a scene file terrain: nodata: {code_of(value)}"
    if nodes.size < np.count_nonzero(filled):  # other nodes with this elevation are ground
        close = f"grid.status_at_node[{nodes.tolist()}] = grid.BC_NODE_IS_CLOSED"
    raise InputError(
        f"{Z} is exactly {code_of(value)} m at {nodes.size} nodes, the first is {where(grid, nodes[0])}, with upright "
        f"walls of {deep:g} m and more all round: a void that is filled with a number? Close them: {close}; or, if it "
        "is ground, give it another elevation"
    )
