"""Copies of grids for pilot runs: the same nodes, or every second one."""

from typing import Any

import numpy as np
from landlab import RasterModelGrid

from ..core.errors import InputError
from ..grid.fields import NODE_FIELDS
from ..grid.release import MASS_WASTING_ID, RELEASE_DEPTH, RELEASE_VELOCITY, read_release

ELEVATION, SOIL = "topographic__elevation", "soil__depth"

OUTPUTS = frozenset(field.name for field in NODE_FIELDS if field.intent == "out")
"""Fields that a component starts anew."""

FEWEST = 5
"""Fewest rows and columns of which every second makes a grid."""


def copy_grid(grid: RasterModelGrid) -> RasterModelGrid:
    """Return a new grid with the same nodes, statuses and fields at nodes, outputs of a component left out.

    Parameters
    ----------
    grid : RasterModelGrid

    Returns
    -------
    RasterModelGrid
    """
    copied = _new_grid(grid, grid.shape, 1)
    copied.status_at_node[:] = grid.status_at_node
    for name in grid.at_node:
        if name not in OUTPUTS:
            copied.add_field(name, np.array(grid.at_node[name]), at="node")
    return copied


def put_back(copied: RasterModelGrid, grid: RasterModelGrid) -> None:
    """Put the fields of a grid back into a copy of it on which a flow has run.

    Parameters
    ----------
    copied : RasterModelGrid
        As `copy_grid` returned it; fields that have been added since are taken away.
    grid : RasterModelGrid
    """
    for name in list(copied.at_node.keys()):
        if name in grid.at_node:
            copied.at_node[name][:] = grid.at_node[name]
        else:
            copied.delete_field("node", name)


def coarse_grid(grid: RasterModelGrid) -> RasterModelGrid:
    """Return a new grid of every second row and column, with the release of the same volume around the same centre.

    Fields, and the ground below the release, keep their values at the nodes that stay. The depth of the release at a
    node that goes is divided among the neighbours that stay. The edge keeps its statuses.

    Parameters
    ----------
    grid : RasterModelGrid
        It is not changed.

    Returns
    -------
    RasterModelGrid

    Raises
    ------
    InputError
        If too few nodes stay, or none of those on which the release would lie is open to flow.
    """
    if min(grid.shape) < FEWEST:
        rows, columns = grid.shape
        raise InputError(f"every second node of {rows} x {columns} nodes makes no grid; {FEWEST} x {FEWEST} are needed")
    shape = tuple((count + 1) // 2 for count in grid.shape)
    coarse = _new_grid(grid, shape, 2)
    places = [np.arange(0, count, 2) for count in grid.shape]
    for axis, count in zip(places, grid.shape, strict=True):
        axis[-1] = count - 1  # the last row and column belong to the edge, whether their number is odd or even
    kept = np.array(grid.status_at_node).reshape(grid.shape)[np.ix_(*places)]
    coarse.status_at_node[:] = kept.ravel()
    depth, momentum = _release(grid)
    fine = {name: np.array(grid.at_node[name]) for name in grid.at_node if name not in OUTPUTS}
    fine = {name: values for name, values in fine.items() if values.ndim == 1}
    for name in (ELEVATION, SOIL):
        if name in fine:
            fine[name] = fine[name] - depth.ravel()
    for name, values in fine.items():
        coarse.add_field(name, values.reshape(grid.shape)[::2, ::2].ravel().copy(), at="node")
    _lay_release(coarse, depth_on(coarse, depth), momentum)
    return coarse


def depth_on(coarse: RasterModelGrid, depth: np.ndarray) -> np.ndarray:
    """Return the depth of a release over the nodes of a coarse grid, on core nodes and of the same volume [m].

    Parameters
    ----------
    coarse : RasterModelGrid
        As `coarse_grid` returns it.
    depth : ndarray, shape (rows, columns)
        Depth over the nodes of the grid that it was made of [m].

    Returns
    -------
    ndarray, shape (rows, columns)

    Raises
    ------
    InputError
        If no core node is left to lie on.
    """
    spread = every_second(depth)
    spread[np.array(coarse.status_at_node).reshape(coarse.shape) != 0] = 0.0
    if depth.any() and not spread.any():
        raise InputError("none of the nodes of a release stays where it may flow")
    return spread * (depth.sum() / (4.0 * spread.sum())) if depth.any() else spread


def every_second(values: np.ndarray) -> np.ndarray:
    """Return values per area over every second row and column, of the same integral, in their unit.

    Parameters
    ----------
    values : ndarray, shape (rows, columns)
        The value of a node that goes is halved between the two neighbours that stay.

    Returns
    -------
    ndarray, shape ((rows + 1) // 2, (columns + 1) // 2)

    Examples
    --------
    >>> every_second(np.array([[0.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 8.0]]))
    array([[0.25, 0.25],
           [0.25, 2.25]])
    """
    for axis in (0, 1):
        rows = np.moveaxis(values, axis, 0)
        stay, go = 0.5 * rows[::2], 0.25 * rows[1::2]
        stay[: len(go)] += go
        stay[1:] += go[: len(stay) - 1]
        if len(go) == len(stay):
            stay[-1] += go[-1]  # a node at the end has one neighbour only
        values = np.moveaxis(stay, 0, axis)
    return values


def write_release(grid: RasterModelGrid) -> None:
    """Write depths into the release field of a grid, also where ids of mass wasting ask for a release [m].

    Parameters
    ----------
    grid : RasterModelGrid
        Changed; the ids become 0.
    """
    depth, _ = _release(grid)
    if RELEASE_DEPTH not in grid.at_node:
        grid.add_zeros(RELEASE_DEPTH, at="node")
    grid.at_node[RELEASE_DEPTH][:] = depth.ravel()
    if MASS_WASTING_ID in grid.at_node:
        grid.at_node[MASS_WASTING_ID][:] = 0


def _release(grid) -> tuple[np.ndarray, np.ndarray | None]:
    """Return depth [m] and momentum per mass and area, (2, rows, columns) [m2 s-1], of the release on a grid."""
    soil = np.asarray(grid.at_node[SOIL]) if SOIL in grid.at_node else None
    depth, momentum = np.zeros(grid.number_of_nodes), None
    if RELEASE_DEPTH in grid.at_node:
        release = read_release(grid, soil)
        depth[release.nodes] = release.depth
        if release.velocity is not None:
            momentum = np.zeros((2, grid.number_of_nodes))
            momentum[:, release.nodes] = release.velocity * release.depth
            momentum = momentum.reshape(2, *grid.shape)
    return depth.reshape(grid.shape), momentum


def _lay_release(grid, depth, momentum) -> None:
    """Lay a release of some depth, (rows, columns) [m], on ground and soil of a coarse grid.

    `momentum` is that of `_release` over the nodes of the fine grid.
    """
    at, flat = grid.at_node, depth.ravel()
    for name in (ELEVATION, SOIL):
        if name in at:
            at[name] += flat
    for name in (RELEASE_DEPTH, MASS_WASTING_ID, *RELEASE_VELOCITY):
        if name in at:
            at[name][:] = 0
    if RELEASE_DEPTH not in at:
        grid.add_zeros(RELEASE_DEPTH, at="node")
    at[RELEASE_DEPTH][:] = flat
    if momentum is not None:
        for name, values in zip(RELEASE_VELOCITY, momentum, strict=True):
            if name not in at:
                grid.add_zeros(name, at="node")
            np.divide(every_second(values).ravel(), flat, out=at[name], where=flat > 0.0)


def _new_grid(grid: Any, shape: tuple[int, int], step: int) -> RasterModelGrid:
    spacing = step * float(grid.dx), step * float(grid.dy)
    return RasterModelGrid(shape, xy_spacing=spacing, xy_of_lower_left=grid.xy_of_lower_left)
