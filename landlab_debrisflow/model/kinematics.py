"""Kick and drift of points on a surface.

Curvature does no work here: gravity and pressure act along the bed, the particle drifts, and its
velocity is then turned into the new tangent plane. The speed is kept, then corrected for energy: a straight drift over
a curved bed changes the height by an amount that the two half kicks do not contain.
"""

from typing import NamedTuple

import numpy as np

from ..core.arrays import value_at
from ..core.jit import inner, kernel
from ..core.structs import struct
from ..spatial.raster import CLOSED, CORE, is_walled, nearest_node, nearest_place


@struct
class Place(NamedTuple):
    """Place of n particles on the bed, arrays of shape (n,)."""

    x: np.ndarray  # (n,) map coordinates [m]
    y: np.ndarray  # (n,) [m]
    z: np.ndarray  # (n,) elevation of the bed below [m]; written
    cosine: np.ndarray  # (n,) of the slope of the bed [-]; written
    lowest_z: np.ndarray  # (n,) lowest bed that each has come over [m]; written
    nearest_node: np.ndarray  # (n,) int; written
    expected_elevation: np.ndarray  # (n,) at which the kicks leave each [m], from `drift`


@struct
class Resistance(NamedTuple):
    """Resistance of the base to the motion of n particles.

    Attributes
    ----------
    yield_stress : ndarray, shape (n,)
        Shear stress that holds a body at rest [Pa].
    drag : ndarray, shape (n,)
        Other resistance of the bed over speed [Pa s m-1].
    mass : ndarray, shape (n,)
        Mass that is slowed, per area: density times slope-normal thickness [kg m-2].
    rest_speed : ndarray, shape (n,) or (1,)
        Speed below which a particle that is being slowed comes to rest [m s-1].
    """

    yield_stress: np.ndarray
    drag: np.ndarray
    mass: np.ndarray
    rest_speed: np.ndarray


@inner
def along_bed(i, push, slope_x, slope_y, cosine, gravity):
    """Return the acceleration of particle `i` along the bed, by gravity [m s-2] and `push`, shape (3, n) [m s-2].

    `slope_x`, `slope_y` (dz/dx, dz/dy) and `cosine` of the slope of the bed have shape (n,) [-]; `gravity` is in m s-2.
    Three components are returned.
    """
    c = cosine[i]
    nx, ny, nz = -c * slope_x[i], -c * slope_y[i], c
    across = push[0, i] * nx + push[1, i] * ny + push[2, i] * nz - gravity * nz
    return push[0, i] - across * nx, push[1, i] - across * ny, push[2, i] - across * nz - gravity


@kernel
def kick(first, velocity, push, slope, cosine, resistance, gravity, dt):
    """Accelerate particles along the bed for `dt` seconds, friction included, in place.

    Friction opposes the motion, never reverses it, and holds a body whose driving stress is below
    the yield stress. The drag enters as v_new = (v + dt a) / (1 + dt d(|v|)), which for a drag
    proportional to the speed squared is second-order and never overshoots (Kahan's method).

    Parameters
    ----------
    first : int
        Place of the first particle to kick.
    velocity, push : ndarray, shape (3, all)
        Velocity [m s-1], and acceleration by forces between particles [m s-2].
    slope : tuple of ndarray, shape (all,)
        Slope of the bed below all particles along x and y [-].
    cosine : ndarray, shape (all,)
        Cosine of the slope of the bed [-].
    resistance : Resistance
        At the n particles to kick. A particle that falls below its speed of rest stays if friction can hold it there;
        if that speed is infinite, whether or not.
    gravity : float
        Acceleration by gravity [m s-2].
    """
    yield_stress, drag, mass, rest_speed = resistance
    slope_x, slope_y = slope
    for k in range(mass.size):
        i = first + k
        ax, ay, az = along_bed(i, push, slope_x, slope_y, cosine, gravity)
        u, v, w = velocity[0, i] + dt * ax, velocity[1, i] + dt * ay, velocity[2, i] + dt * az
        speed = np.sqrt(u * u + v * v + w * w)
        if speed == 0.0:
            factor = 0.0
        else:
            before2 = velocity[0, i] ** 2 + velocity[1, i] ** 2 + velocity[2, i] ** 2
            deceleration = yield_stress[k] / mass[k]
            slowed = speed - dt * deceleration
            if slowed < 0.0:  # not max(), which would drop a NaN that the check after the step must find
                slowed = 0.0
            slowed /= 1.0 + dt * drag[k] / mass[k]
            least = value_at(rest_speed, k)
            held = slowed * slowed < before2 and ax * ax + ay * ay + az * az <= deceleration * deceleration
            resting = slowed < least and (held or least == np.inf)
            factor = 0.0 if resting else slowed / speed
        velocity[0, i], velocity[1, i], velocity[2, i] = u * factor, v * factor, w * factor


@kernel
def drift(first, position, velocity, velocity_ratio, raster, dt, expected_elevation, touched_wall, exit_node):
    """Move particles for `dt` seconds, slowed by the soil they took up; none gets into closed nodes.

    Parameters
    ----------
    first : int
        Place of the first particle to move.
    position : Position
        Position of all particles: x and y are changed in place; z is the present elevation of the bed at the old x and
        y.
    velocity : ndarray, shape (3, n)
        Multiplied by `velocity_ratio` [m s-1]; the drift uses the mean of before and after, which keeps the pair
        erosion-drift second-order.
    velocity_ratio : ndarray, shape (m,)
        Velocity after over velocity before entrainment [-], for the m particles to move.
    raster : Raster
        Nodes, their statuses and spacing [m].
    expected_elevation : ndarray, shape (n,)
        Written: the elevation at which the kicks leave the particle, less half a step of vertical velocity [m]; see
        `follow_bed`.
    touched_wall : ndarray of int8, shape (n,)
        Set to 1 where a closed node stopped the particle.
    exit_node : ndarray of int, shape (m,)
        Written: open node over which a particle left, `NO_EXIT` if the particle stays, `NOWHERE` if its position is not
        a number.

    Returns
    -------
    bool
        Whether any particle does not stay.
    """
    x, y, z = position
    status, columns, rows, dx, dy, walled = raster
    leave = False
    for m in range(exit_node.size):
        i, exit_node[m] = first + m, NO_EXIT
        expected_elevation[i] = z[i] + 0.5 * dt * velocity[2, i]
        step = 0.5 * dt * (1.0 + velocity_ratio[m])
        new_x, new_y = x[i] + step * velocity[0, i], y[i] + step * velocity[1, i]
        for k in range(3):
            velocity[k, i] *= velocity_ratio[m]
        if not (abs(new_x) < np.inf and abs(new_y) < np.inf):  # not isfinite(), which reordering breaks (core/jit.py)
            exit_node[m], leave = NOWHERE, True
            continue
        row, column = nearest_place(new_y, dy, rows), nearest_place(new_x, dx, columns)
        node = row * columns + column
        if is_walled(row, column, walled, columns):
            here = nearest_node(x[i], y[i], dx, dy, columns, rows)
            if _is_blocked(here, node, columns, status):  # `stop_at_walls` tested another starting point
                touched_wall[i] = 1
                new_x, new_y, expected_elevation[i], node = x[i], y[i], z[i], here
                velocity[0, i], velocity[1, i], velocity[2, i] = 0.0, 0.0, 0.0
        x[i], y[i] = new_x, new_y
        if status[node] != CORE:
            exit_node[m], leave = node, True
    return leave


NO_EXIT, NOWHERE = -1, -2
"""Exit nodes, as `drift` writes them, of a particle that stays on the raster and of one whose position is not a
number."""


@kernel
def stop_at_walls(x, y, velocity, sample, raster, dt, touched_wall):
    """Take away the part of each velocity that would run into a closed node within `dt` seconds, in place.

    Done right after each kick: a particle pressed against a wall has no speed, so it neither erodes nor counts as
    moving.

    Parameters
    ----------
    x, y : ndarray, shape (n,)
        Map coordinates [m].
    velocity : ndarray, shape (3, n)
        Changed in place [m s-1].
    sample : SurfaceSample
        Surface of the bed below the particles.
    raster : Raster
        Nodes, their statuses and spacing [m].
    touched_wall : ndarray of int8, shape (m,)
        Set to 1 where a closed node stopped the particle; as long as there are particles to stop.
    """
    _, slope_x, slope_y, _, _, _ = sample
    status, columns, rows, dx, dy, walled = raster
    for i in range(touched_wall.size):
        if not (abs(x[i]) < np.inf and abs(y[i]) < np.inf):  # not isfinite(), which reordering breaks (core/jit.py)
            continue
        row, column = nearest_place(y[i], dy, rows), nearest_place(x[i], dx, columns)
        if not is_walled(row, column, walled, columns):
            continue
        here = row * columns + column
        new_x, new_y = x[i] + dt * velocity[0, i], y[i] + dt * velocity[1, i]
        node = nearest_node(new_x, new_y, dx, dy, columns, rows)
        if _is_blocked(here, node, columns, status):
            touched_wall[i] = 1
            # the rest is the projection on the direction along the wall, which is never faster
            if status[here // columns * columns + node % columns] != CLOSED:
                along = (velocity[0, i] + velocity[2, i] * slope_x[i]) / (1.0 + slope_x[i] ** 2)
                velocity[0, i], velocity[1, i], velocity[2, i] = along, 0.0, along * slope_x[i]
            elif status[node // columns * columns + here % columns] != CLOSED:
                along = (velocity[1, i] + velocity[2, i] * slope_y[i]) / (1.0 + slope_y[i] ** 2)
                velocity[0, i], velocity[1, i], velocity[2, i] = 0.0, along, along * slope_y[i]
            else:
                velocity[0, i], velocity[1, i], velocity[2, i] = 0.0, 0.0, 0.0


@inner
def _is_blocked(here, node, columns, status):
    """Return whether the way between two nodes, -1 for none, leads into a closed one or between two that touch.

    `here` and `node` are nodes that touch along a side or at a corner; `columns` are those of the raster; `status`,
    shape (nodes,), are node statuses.
    """
    if node < 0 or here < 0:
        return False
    if status[node] == CLOSED:
        return True
    if node % columns == here % columns or node // columns == here // columns:
        return False
    return (
        status[here // columns * columns + node % columns] == CLOSED
        and status[node // columns * columns + here % columns] == CLOSED
    )


@kernel
def follow_bed(first, last, sample, velocity, place, raster, gravity, dt):
    """Turn velocities, shape (3, n) [m s-1], into the new tangent plane, and write the place of the particles on it.

    The two half kicks of a step, along the tangents at its ends, do the work -g dt (w + w')/2, w being the vertical
    velocity. This is the trapezoid rule for the true work g (z - z'), apart from a term g_t^2 dt^2/8 that cancels from
    step to step. The difference between true and done work is added to the kinetic energy. Without this correction a
    bed that bends within a step gives a particle energy at every crossing: 1600 m of head in a pit 100 m deep and one
    node wide.

    Parameters
    ----------
    first, last : int
        Place of the first particle to treat, and the place behind the last.
    sample : SurfaceSample
        Surface of the bed below the n particles now.
    velocity : ndarray, shape (3, n)
        Changed in place [m s-1].
    place : Place
        Place of the particles, written.
    raster : Raster
        Nodes, their statuses and spacing [m].
    gravity : float
        Acceleration by gravity [m s-2].
    dt : float
        Duration of the drift [s]; 0 if only the bed has changed, which is neither rise nor fall of the flow.
    """
    elevation, slope_x, slope_y, _, _, _ = sample
    x, y, z, cosine, lowest_z, nearest, expected_elevation = place
    _, columns, rows, dx, dy, _ = raster
    # loops of few arrays each: of many, the compiler cannot tell whether they overlap, and makes no vector code
    for i in range(first, last):
        before = lowest_z[i] + elevation[i] - z[i] if dt == 0.0 else lowest_z[i]
        lowest_z[i] = min(before, elevation[i])
    for i in range(first, last):
        nearest[i] = nearest_place(y[i], dy, rows) * columns + nearest_place(x[i], dx, columns)
    for i in range(first, last):
        c = 1.0 / np.sqrt(1.0 + slope_x[i] * slope_x[i] + slope_y[i] * slope_y[i])
        cosine[i], z[i] = c, elevation[i]
        nx, ny, nz = -c * slope_x[i], -c * slope_y[i], c
        u, v, w = velocity[0, i], velocity[1, i], velocity[2, i]
        across = u * nx + v * ny + w * nz
        speed2 = u * u + v * v + w * w
        u, v, w = u - across * nx, v - across * ny, w - across * nz
        along2 = u * u + v * v + w * w
        factor = np.sqrt(speed2 / along2) if along2 > 1e-12 * speed2 else 0.0
        if dt > 0.0 and speed2 > 0.0:
            missing = expected_elevation[i] - z[i] + 0.5 * dt * w * factor
            factor *= np.sqrt(max(0.0, 1.0 + 2.0 * gravity * missing / speed2))
        velocity[0, i], velocity[1, i], velocity[2, i] = u * factor, v * factor, w * factor
