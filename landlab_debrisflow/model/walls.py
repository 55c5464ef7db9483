"""Closed nodes as walls: what is near one has a mirror image behind it.

Without images the sums over neighbours miss half of them at a wall: thickness comes out halved, and all the
flow is pushed against it. The faces of closed nodes are the walls, so each image is in x, in y, or in both.
"""

import numpy as np

from ..core.jit import kernel
from ..physics.contracts import FlowState
from ..spatial.summation import SMOOTHING_RATIO
from ..spatial.transfer import Nodes
from .kinematics import CLOSED, stop_at_walls


def mirror(state: FlowState, changed, nodes: Nodes, status, touched):
    """Append the mirror images of particles that walls within their support make.

    Parameters
    ----------
    state : FlowState
    changed : ndarray of bool, shape (n,)
        Which particles have changed.
    nodes : Nodes
    status : ndarray, shape (nodes,)
        Node statuses as Landlab numbers them.
    touched : ndarray of int8, shape (n,)
        Set to 1 for those that move towards or along a wall within their own spacing of it, not away from it.

    Returns
    -------
    FlowState, ndarray
        The same with images behind the n particles; the arrays given if there is none.
    """
    support = 2.0 * state.smoothing_length
    rows = status.size // nodes.columns
    count = _find(state.x, state.y, support, nodes.dx, nodes.dy, nodes.columns, rows, status, _NONE, _NOWHERE)
    if count == 0:
        return state, changed
    source, wall = np.empty(count, np.int64), np.empty((2, count))
    _find(state.x, state.y, support, nodes.dx, nodes.dy, nodes.columns, rows, status, source, wall)
    x, y, velocity = state.x[source], state.y[source], state.velocity[:, source]
    for axis, position in enumerate((x, y)):
        behind = np.isfinite(wall[axis])
        position[behind] = 2.0 * wall[axis, behind] - position[behind]
        velocity[axis, behind] *= -1.0

    def both(values):
        return np.concatenate([values, values[source]])

    gap, moving = wall - np.array([state.x[source], state.y[source]]), state.velocity[:, source]
    near = (np.abs(gap) < SPACING * support[source]) & (gap * moving[:2] >= 0.0)
    touched[source[np.any(near, axis=0) & np.any(moving, axis=0)]] = 1
    images = {name: both(getattr(state, name)) for name in ALIKE}
    images |= {"x": np.concatenate([state.x, x]), "y": np.concatenate([state.y, y])}
    images["velocity"] = np.concatenate([state.velocity, velocity], axis=1)
    return state._replace(**images), both(changed)


def bear(sim, which: slice, pull, ground) -> None:
    """Take away, in place, what walls bear of the pull (3, n) on some particles at rest; `ground` (6, n) is theirs."""
    if not sim.walled:
        return
    p, nodes = sim.particles, sim.bed.nodes
    size = np.sqrt((pull**2).sum(axis=0))
    pull *= TOUCHING * min(nodes.dx, nodes.dy) / np.maximum(size, 1e-300)
    stop_at_walls(
        size.size, np.ascontiguousarray(p.x[which]), np.ascontiguousarray(p.y[which]), pull, ground, nodes.dx, nodes.dy,
        nodes.columns, sim.status, 1.0, np.zeros(size.size, np.int8),
    )  # fmt: skip
    pull *= size / (TOUCHING * min(nodes.dx, nodes.dy))


TOUCHING = 1e-3
"""Distance from a wall, over node spacing, at which a particle leans on it."""

SPACING = 0.5 / SMOOTHING_RATIO
"""Spacing of particles over their support."""

ALIKE = (
    "z",
    "volume",
    "smoothing_length",
    "longest",
    "thickness",
    "thickening",
    "gradient_term",
    "cos_slope",
    "density",
    "phase",
    "share",
    "cross_term",
    "mean_pressure",
)
"""What an image has in common with its particle."""

_NONE, _NOWHERE = np.empty(0, np.int64), np.empty((2, 0))


@kernel
def _find(x, y, support, dx, dy, columns, rows, status, source, wall):
    """Count the images, and write whose they are and the walls in x and y [m], NaN for none, if there is room.

    A wall is taken to be no nearer than a quarter of a spacing, so an image is no nearer than half of one. In a
    corner a particle and its three images in one place would sum to more than any smoothing length can make up for.
    """
    found = 0
    wx, wy = np.empty(3), np.empty(3)
    for i in range(x.size):
        r = min(max(int(np.floor(y[i] / dy + 0.5)), 0), rows - 1)
        c = min(max(int(np.floor(x[i] / dx + 0.5)), 0), columns - 1)
        wx[0] = wy[0] = np.nan
        nx = ny = 1
        least = 0.25 * SPACING * support[i]
        for side in (-1, 1):
            k = 1
            while 0 <= c + side * k < columns:
                face = (c + side * (k - 0.5)) * dx
                if abs(face - x[i]) >= support[i]:
                    break
                if status[r * columns + c + side * k] == CLOSED:
                    wx[nx] = x[i] + side * max(abs(face - x[i]), least)
                    nx += 1
                    break
                k += 1
            k = 1
            while 0 <= r + side * k < rows:
                face = (r + side * (k - 0.5)) * dy
                if abs(face - y[i]) >= support[i]:
                    break
                if status[(r + side * k) * columns + c] == CLOSED:
                    wy[ny] = y[i] + side * max(abs(face - y[i]), least)
                    ny += 1
                    break
                k += 1
        for a in range(nx):
            for b in range(ny):
                if a + b > 0:
                    if found < source.size:
                        source[found], wall[0, found], wall[1, found] = i, wx[a], wy[b]
                    found += 1
    return found
