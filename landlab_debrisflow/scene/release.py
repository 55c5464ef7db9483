"""Releases on a grid: from the ground, within an outline, or laid on top of it."""

from typing import Any

import numpy as np

from ..core.errors import InputError
from ..grid.checks import check_types
from ..grid.release import RELEASE_DEPTH, check_release
from .failure_surface import failure_surface

ELEVATION, SOIL_DEPTH = "topographic__elevation", "soil__depth"


def failing_depth(grid: Any, inside: Any, **keywords: Any) -> np.ndarray:
    """Return the vertical depth of the body that fails within an outline, at the nodes of a grid [m].

    Parameters
    ----------
    grid : RasterModelGrid
        With ``topographic__elevation`` [m]; nothing leaves over closed nodes.
    inside : array_like, shape (nodes,) or (rows, columns)
        Nodes of the outline, as bool, or the fraction of every cell that lies inside.
    **keywords
        As in `failure_surface`: the kind, and one of ``mean_depth``, ``largest_depth`` and ``volume``.

    Returns
    -------
    ndarray, shape (nodes,)
        Vertical depth [m], for ``debris_flow__release_depth``; 0 outside.

    Raises
    ------
    InputError
        As in `failure_surface`, or if `inside` does not fit the grid.
    """
    outline = np.asarray(inside)
    if outline.size != grid.number_of_nodes:
        count = grid.number_of_nodes
        raise InputError(f"failing_depth: inside must have a value for each of {count} nodes, got {outline.size}")
    closed = grid.status_at_node == grid.BC_NODE_IS_CLOSED
    elevation = np.where(closed, np.nan, grid.at_node[ELEVATION]).reshape(grid.shape)
    spacing = float(grid.dx), float(grid.dy)
    return failure_surface(outline.reshape(grid.shape), elevation, spacing, **keywords).ravel()


def lay_on_top(grid: Any, depth: Any) -> None:
    """Lay mass on the ground, in addition to the release so far, to flow from the next call on [m].

    Elevation and, if the grid has it, ``soil__depth`` rise by the depth, and the next call takes the same depth off
    again, so that the former ground lies below the release. RAMMS, AvaFrame and most published cases release mass in
    this way. Until that call other components see the raised ground and the mass as soil.

    The budget counts the volume as released. At the end elevation has risen, over the whole grid and against the ground
    before, by deposited + released on top - released - eroded.

    Parameters
    ----------
    grid : RasterModelGrid
        ``topographic__elevation``, ``soil__depth`` if there is one, and ``debris_flow__release_depth``, which is added
        if it is missing, grow by the depth. Depth that is to fail from the ground is added to the release field with
        ``+=``.
    depth : array_like, shape (nodes,) or (rows, columns)
        Vertical depth of the mass [m]; 0 elsewhere.

    Raises
    ------
    InputError
        If a depth is negative, not finite, or not on a core node; nothing was changed.

    Examples
    --------
    >>> from landlab import RasterModelGrid
    >>> from landlab_debrisflow import DebrisFlow
    >>> grid = RasterModelGrid((20, 60), xy_spacing=5.0)
    >>> z = grid.add_field("topographic__elevation", 0.5 * (295.0 - grid.x_of_node), at="node")
    >>> lay_on_top(grid, np.where(np.hypot(grid.x_of_node - 40.0, grid.y_of_node - 48.0) < 12.0, 2.0, 0.0))
    >>> flow = DebrisFlow(grid, numerics={"particle_count": 100})
    >>> flow.run_one_step(5.0)
    >>> bool(np.allclose(z, 0.5 * (295.0 - grid.x_of_node), atol=1e-12)), flow.budget["released"]
    (True, 800.0)
    """
    depth = np.asarray(depth, float).ravel()
    if depth.size != grid.number_of_nodes:
        raise InputError(
            f"lay_on_top: depth must have a value for each of {grid.number_of_nodes} nodes, got {depth.size}"
        )
    check_types(grid)
    nodes = np.flatnonzero(depth)
    check_release(grid, "lay_on_top: depth", nodes, depth[nodes], None)
    at = grid.at_node
    if RELEASE_DEPTH not in at:
        grid.add_zeros(RELEASE_DEPTH, at="node", units="m")
    for name in {ELEVATION, SOIL_DEPTH, RELEASE_DEPTH} & set(at):
        at[name][nodes] += depth[nodes]
