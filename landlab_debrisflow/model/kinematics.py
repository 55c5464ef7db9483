"""Kick and drift of points on a surface.

Curvature does no work here: gravity and pressure act along the bed, the particle drifts, and its
velocity is then turned into the new tangent plane. Its length is kept, but for what gravity did not pay: the
drift leaves the tangent plane, and lands higher or lower than the kicks know.
"""

import numpy as np

from ..core.jit import inner, kernel

STILL = 1e-3
"""Displacement over smoothing length, and relative change of volume, below which the sums over
neighbours need not be done again: their error is of this order."""

CORE, CLOSED = 0, 4  # node statuses as Landlab numbers them; all others are open boundaries


@inner
def along_bed(i, push, slope_x, slope_y, cosine, gravity):
    """Return the acceleration by gravity and thrust along the bed [m s-2]."""
    c = cosine[i]
    nx, ny, nz = -c * slope_x[i], -c * slope_y[i], c
    across = push[0, i] * nx + push[1, i] * ny + push[2, i] * nz - gravity * nz
    return push[0, i] - across * nx, push[1, i] - across * ny, push[2, i] - across * nz - gravity


@kernel
def kick(velocity, push, sample, cosine, yield_stress, drag, mass, gravity, rest_speed, dt):
    """Accelerate along the bed for `dt` seconds, friction included, in place.

    Friction opposes the motion, never reverses it, and holds a body whose driving stress is below
    the yield stress. The drag enters as v_new = (v + dt a) / (1 + dt d(|v|)), which for a drag
    proportional to the speed squared is second-order and never overshoots (Kahan's method).

    Parameters
    ----------
    velocity, push : ndarray, shape (3, n)
        Velocity [m s-1] and acceleration by inner forces [m s-2].
    sample : SurfaceSample
        Of the bed below the particles.
    cosine, yield_stress, drag, mass : ndarray, shape (n,)
        cos(theta); [Pa]; [Pa s m-1]; density times slope-normal thickness [kg m-2]. The last is as long as there
        are particles to kick; the others may be longer.
    rest_speed : ndarray, shape (n,) or (1,)
        A particle that is being slowed and falls below this comes to rest, if friction can hold it there [m s-1]. If it
        is infinite, whether or not.
    """
    slope_x, slope_y = sample.slope_x, sample.slope_y
    for i in range(mass.size):
        ax, ay, az = along_bed(i, push, slope_x, slope_y, cosine, gravity)
        u, v, w = velocity[0, i] + dt * ax, velocity[1, i] + dt * ay, velocity[2, i] + dt * az
        speed = np.sqrt(u * u + v * v + w * w)
        if speed == 0.0:
            factor = 0.0
        else:
            was = velocity[0, i] ** 2 + velocity[1, i] ** 2 + velocity[2, i] ** 2
            resistance = yield_stress[i] / mass[i]
            left = speed - dt * resistance
            if left < 0.0:  # not max(): a NaN must survive
                left = 0.0
            left /= 1.0 + dt * drag[i] / mass[i]
            least = rest_speed[min(i, rest_speed.size - 1)]
            held = left * left < was and ax * ax + ay * ay + az * az <= resistance * resistance
            resting = left < least and (held or least == np.inf)
            factor = 0.0 if resting else left / speed
        velocity[0, i], velocity[1, i], velocity[2, i] = u * factor, v * factor, w * factor


@kernel
def drift(x, y, z, velocity, velocity_ratio, dx, dy, columns, status, dt, expected_elevation, left, touched_wall):
    """Move the particles, slowed by the soil they took up; nothing gets into closed nodes.

    Parameters
    ----------
    x, y : ndarray, shape (n,)
        Changed in place [m].
    velocity : ndarray, shape (3, n)
        Multiplied by `velocity_ratio`; the drift uses the mean of before and after, which keeps the pair
        erosion-drift second-order.
    z : ndarray, shape (n,)
        Elevation of the bed, as it is now, where the particles are before [m].
    velocity_ratio : ndarray, shape (n,)
        Volume before over volume after entrainment [-], for the particles to move.
    status : ndarray, shape (nodes,)
        Status of the nodes.
    expected_elevation : ndarray, shape (n,)
        Written: the elevation at which the kicks leave it, less half a step of vertical velocity [m]; see
        `follow_bed`.
    left : ndarray of int, shape (n,)
        Written: the open node over which the particle left, -1 if it did not, -2 if its position is not a number.
    touched_wall : ndarray of int8, shape (n,)
        Set to 1 where a closed node stopped the particle.
    """
    rows = status.size // columns
    for i in range(left.size):
        left[i] = -1
        expected_elevation[i] = z[i] + 0.5 * dt * velocity[2, i]
        step = 0.5 * dt * (1.0 + velocity_ratio[i])
        new_x, new_y = x[i] + step * velocity[0, i], y[i] + step * velocity[1, i]
        for k in range(3):
            velocity[k, i] *= velocity_ratio[i]
        if _blocked(x[i], y[i], new_x, new_y, dx, dy, columns, status):  # `stop_at_walls` looked from elsewhere
            touched_wall[i] = 1
            new_x, new_y, expected_elevation[i] = x[i], y[i], z[i]
            velocity[0, i], velocity[1, i], velocity[2, i] = 0.0, 0.0, 0.0
        node = _nearest(new_x, new_y, dx, dy, columns, rows)
        x[i], y[i] = new_x, new_y
        if node < 0 or status[node] != CORE:
            left[i] = node if node >= 0 else -2


@kernel
def stop_at_walls(count, x, y, velocity, sample, dx, dy, columns, status, dt, touched_wall):
    """Take away, in place, the part of each velocity that would run into a closed node within `dt` seconds.

    Of the first `count` particles. Done right after each kick: a particle pressed against a wall has no speed, so it
    neither erodes nor counts as moving.
    """
    slope_x, slope_y, rows = sample.slope_x, sample.slope_y, status.size // columns
    for i in range(count):
        new_x, new_y = x[i] + dt * velocity[0, i], y[i] + dt * velocity[1, i]
        if _blocked(x[i], y[i], new_x, new_y, dx, dy, columns, status):
            touched_wall[i] = 1
            # what is left is the projection on the direction along the wall: never faster
            if status[_nearest(new_x, y[i], dx, dy, columns, rows)] != CLOSED:
                left = (velocity[0, i] + velocity[2, i] * slope_x[i]) / (1.0 + slope_x[i] ** 2)
                velocity[0, i], velocity[1, i], velocity[2, i] = left, 0.0, left * slope_x[i]
            elif status[_nearest(x[i], new_y, dx, dy, columns, rows)] != CLOSED:
                left = (velocity[1, i] + velocity[2, i] * slope_y[i]) / (1.0 + slope_y[i] ** 2)
                velocity[0, i], velocity[1, i], velocity[2, i] = 0.0, left, left * slope_y[i]
            else:
                velocity[0, i], velocity[1, i], velocity[2, i] = 0.0, 0.0, 0.0


@inner
def _blocked(x, y, new_x, new_y, dx, dy, columns, status):
    """Return whether the way leads into a closed node, or between two of them that touch at a corner."""
    rows = status.size // columns
    node, here = _nearest(new_x, new_y, dx, dy, columns, rows), _nearest(x, y, dx, dy, columns, rows)
    if node < 0 or here < 0:
        return False
    if status[node] == CLOSED:
        return True
    if node % columns == here % columns or node // columns == here // columns:
        return False
    return (
        status[_nearest(new_x, y, dx, dy, columns, rows)] == CLOSED
        and status[_nearest(x, new_y, dx, dy, columns, rows)] == CLOSED
    )


@inner
def _nearest(x, y, dx, dy, columns, rows):
    """Return the flat index of the nearest node, or -1 if the position is not a number."""
    if not (abs(x) < np.inf and abs(y) < np.inf):  # isfinite() may be reordered away (core/jit.py)
        return -1
    r = min(max(int(np.floor(y / dy + 0.5)), 0), rows - 1)
    c = min(max(int(np.floor(x / dx + 0.5)), 0), columns - 1)
    return r * columns + c


@kernel
def follow_bed(sample, velocity, cosine, z, expected_elevation, gravity, dt):
    """Write cos(theta) [-] and elevation [m], and turn each velocity into the tangent plane, in place.

    The two half kicks of a step, along the tangents at its ends, do the work -g dt (w + w')/2, w being the
    vertical velocity: the trapezoid rule for the true g (z - z'), but for a term g_t^2 dt^2/8 that telescopes
    from step to step. What is missing of the fall is added to the kinetic energy. Without it a bed that bends
    within a step pays a particle for every crossing: 1600 m of head in a pit of 100 m and one node
    (`expected_elevation` is from `drift`; if it is empty nothing drifted).
    """
    elevation, slope_x, slope_y = sample.elevation, sample.slope_x, sample.slope_y
    for i in range(cosine.size):
        c = 1.0 / np.sqrt(1.0 + slope_x[i] * slope_x[i] + slope_y[i] * slope_y[i])
        cosine[i], z[i] = c, elevation[i]
        nx, ny, nz = -c * slope_x[i], -c * slope_y[i], c
        u, v, w = velocity[0, i], velocity[1, i], velocity[2, i]
        across = u * nx + v * ny + w * nz
        speed2 = u * u + v * v + w * w
        u, v, w = u - across * nx, v - across * ny, w - across * nz
        along2 = u * u + v * v + w * w
        factor = np.sqrt(speed2 / along2) if along2 > 1e-12 * speed2 else 0.0
        if i < expected_elevation.size and speed2 > 0.0:
            missing = expected_elevation[i] - z[i] + 0.5 * dt * w * factor
            factor *= np.sqrt(max(0.0, 1.0 + 2.0 * gravity * missing / speed2))
        velocity[0, i], velocity[1, i], velocity[2, i] = u * factor, v * factor, w * factor


@kernel
def count_still_steps(x, y, z, volume, smoothing_length, reference_position, reference_volume, still_steps):
    """Count the steps since each particle moved or grew noticeably, in place.

    Parameters
    ----------
    x, y, z, volume, smoothing_length : ndarray, shape (n,)
    reference_position, reference_volume : ndarray, shape (3, n) and (n,)
        Where and how large it was when it last counted as changed [m, m3].
    still_steps : ndarray of int, shape (n,)
    """
    for i in range(x.size):
        at = reference_position[:, i]
        moved = (x[i] - at[0]) ** 2 + (y[i] - at[1]) ** 2 + (z[i] - at[2]) ** 2
        grown = abs(volume[i] - reference_volume[i])
        if moved > (STILL * smoothing_length[i]) ** 2 or grown > STILL * volume[i]:
            at[0], at[1], at[2], reference_volume[i] = x[i], y[i], z[i], volume[i]
            still_steps[i] = 0
        else:
            still_steps[i] += 1


@kernel
def disturb(x, y, support, gone_x, gone_y, gone_support, still_steps):
    """Reset the still steps of all particles within reach of removed ones, in place."""
    for k in range(gone_x.size):
        for i in range(x.size):
            reach = max(support[i], gone_support[k])
            if (x[i] - gone_x[k]) ** 2 + (y[i] - gone_y[k]) ** 2 < reach * reach:
                still_steps[i] = 0
