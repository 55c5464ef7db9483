"""Closed nodes as walls: a particle near one has a ghost behind it, its mirror image.

Without ghosts a particle at a wall lacks half of its neighbours: its thickness comes out halved, and the flow is pushed
against the wall. The faces of closed nodes are the walls, so each ghost is in x, in y, or in both.
"""

import numpy as np

from ..core.jit import allocating_kernel
from ..physics.contracts import FlowState, Position, Smoothing
from ..spatial.raster import BLOCK, CLOSED, Raster, is_walled, nearest_place
from ..spatial.summation import SMOOTHING_RATIO
from .kinematics import stop_at_walls


def ghost_particles(state: FlowState, changed, walls: Raster, touched):
    """Append the ghosts of particles that walls within their support make: their mirror images.

    Parameters
    ----------
    state : FlowState
        The n particles as the flow law sees them.
    changed : ndarray of bool, shape (n,)
        Whether each particle has changed in the last steps.
    walls : Raster
        Raster with at least one closed node.
    touched : ndarray of int8, shape (n,)
        Set to 1 for particles within one particle spacing of a wall, unless they move away from it.

    Returns
    -------
    FlowState, ndarray
        `state` and `changed` with ghosts behind the n particles; the arrays given if there is none.
    """
    position, support = state.position, 2.0 * state.smoothing.length
    raster = tuple(walls)
    count = _find(position.x, position.y, support, raster, _NONE, _NOWHERE)
    if count == 0:
        return state, changed
    source, wall = np.empty(count, np.int64), np.empty((2, count))
    _find(position.x, position.y, support, raster, source, wall)
    x, y, velocity = position.x[source], position.y[source], state.velocity[:, source]
    gap, moving = wall - np.array([x, y]), velocity.copy()
    for axis, place in enumerate((x, y)):
        behind = np.isfinite(wall[axis])
        place[behind] = 2.0 * wall[axis, behind] - place[behind]
        velocity[axis, behind] *= -1.0
    near = (np.abs(gap) < SPACING * support[source]) & (gap * moving[:2] >= 0.0)
    touched[source[np.any(near, axis=0) & np.any(moving, axis=0)]] = 1

    def both(values):
        return np.concatenate([values, values[source]])

    position = Position(np.concatenate([position.x, x]), np.concatenate([position.y, y]), both(position.z))
    alike = {name: both(getattr(state, name)) for name in ALIKE}
    mixture = state.mixture
    if mixture is not None:
        mixture = mixture._replace(**{name: both(getattr(mixture, name)) for name in ALIKE_IN_MIXTURE})
    ghosts = state._replace(
        position=position,
        velocity=np.concatenate([state.velocity, velocity], axis=1),
        smoothing=Smoothing(*map(both, state.smoothing)),
        mixture=mixture,
        **alike,
    )
    return ghosts, both(changed)


def bear(x, y, pull, sample, walls: Raster | None) -> None:
    """Reduce the pull (3, n) on particles at rest by the reaction of walls [m s-2], in place; `sample` is their bed.

    `x`, `y` have shape (n,) [m], `sample` is a `SurfaceSample` there; `walls` is None where no node is closed.
    """
    if walls is None:
        return
    size = np.sqrt((pull**2).sum(axis=0))
    pull *= TOUCHING * walls.spacing / np.maximum(size, 1e-300)
    stop_at_walls(x, y, pull, sample, tuple(walls), 1.0, np.zeros(size.size, np.int8))
    pull *= size / (TOUCHING * walls.spacing)


TOUCHING = 1e-3
"""Distance from a wall, over node spacing, within which the wall supports a particle."""

SPACING = 0.5 / SMOOTHING_RATIO
"""Spacing of particles over their support."""

ALIKE = ("volume", "thickness", "thickening", "cos_slope", "density")
ALIKE_IN_MIXTURE = ("phase", "share", "cross_term", "mean_pressure")
"""Members of `FlowState` that a ghost has in common with its particle, beside elevation and smoothing."""

_NONE, _NOWHERE = np.empty(0, np.int64), np.empty((2, 0))


@allocating_kernel
def _find(x, y, support, raster, source, wall):
    """Return the number of ghosts of particles at x, y with a support [m], and write them if there is room.

    Written are the particle of each, `source`, shape (k,), and the coordinates of its walls, `wall`, shape (2, k) [m],
    NaN for none; x, y and support have shape (n,).

    A wall is taken to be no nearer than a quarter of a spacing, so a ghost is no nearer than half of one. Otherwise a
    particle in a corner and its three ghosts could lie in one place, and their sum would be too large for any smoothing
    length.
    """
    status, columns, rows, dx, dy, walled = raster
    found, clear = 0, BLOCK * min(dx, dy)  # distance to the nearest wall outside of walled blocks
    wx, wy = np.empty(3), np.empty(3)
    for i in range(x.size):
        r, c = nearest_place(y[i], dy, rows), nearest_place(x[i], dx, columns)
        if support[i] <= clear and not is_walled(r, c, walled, columns):
            continue
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
