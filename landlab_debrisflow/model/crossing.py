"""Time in which particles may cross the terrain: half a node in a step, or nearly a whole one where the ground is even.

Forces act where a step begins and ends, so a step must be short where the ground bends: friction in a curve and the
impulse of a kink follow from the bed at these two places. Where the surface turns by less than `TURN` on the way, a
step of nearly a node sees all of it. A particle with a closed node near it keeps the short way, too: walls stop it at
the middle between two nodes. No step is as long as a node, unless the user asks for this, so that none leads through a
wall one node thick.
"""

import numpy as np

from ..core.jit import inner, kernel
from ..spatial.raster import CLOSED, nearest_place

WALL_NEAR = 2
"""Distance in nodes within which a closed node is near."""


def find_time_across(p, surface, walls, rule, gravity: float, most: float) -> float:
    """Return the longest step in which no particle crosses more terrain than it may, or `most` if that is shorter [s].

    Parameters
    ----------
    p : Particles
        All particles.
    surface : Surface
        Ground below them.
    walls : Raster or None
        Raster with closed nodes; None where no node is closed.
    rule : StepRule
        Bounds of a step.
    gravity : float
        Acceleration by gravity [m s-2].
    most : float
        Longest step by other limits [s].
    """
    raster = (np.empty(0, np.uint8), 0, 0, 1.0, 1.0, np.empty(0, bool)) if walls is None else walls
    place, ahead = np.empty(p.awake, np.int64), np.empty((2, p.awake))
    motion = p.velocity, p.thrust, gravity
    found, shortest = _look_ahead(p.x, p.y, motion, tuple(raster), rule.way, rule.longest_way, most, place, ahead)
    if found == 0:
        return float(shortest)
    there = surface.sample(ahead[0, :found], ahead[1, :found])
    here, curvature = (p.slope_x, p.slope_y), (p.curvature_xx, p.curvature_xy, p.curvature_yy)
    ways = rule.way, rule.longest_way, rule.turn
    return float(_cross(place[:found], here, (there.slope_x, there.slope_y), curvature, motion, ways, shortest))


@inner
def time_over(way, speed2, gain):
    """Return the time [s] for a way [m] at a squared speed [m2 s-2] that may gain `gain` per time [m s-2].

    v dt + 1/2 a dt^2 stays within the way; a is the largest acceleration by thrust and gravity, or deceleration by
    friction, so that stopping is resolved to this way as well.
    """
    return 2.0 * way / (np.sqrt(speed2) + np.sqrt(speed2 + 2.0 * gain * way) + 1e-300)


@inner
def _pace(i, motion):
    """Return the squared speed of particle `i` [m2 s-2] and its largest acceleration [m s-2]."""
    velocity, thrust, gravity = motion
    speed2 = velocity[0, i] ** 2 + velocity[1, i] ** 2 + velocity[2, i] ** 2
    return speed2, gravity + np.sqrt(thrust[0, i] ** 2 + thrust[1, i] ** 2 + thrust[2, i] ** 2)


@kernel
def _look_ahead(x, y, motion, raster, way, longest_way, most, place, ahead):
    """Find the particles that may go farther than `way`, and the place that each of them may reach.

    Parameters
    ----------
    x, y : ndarray, shape (n,)
        Position [m].
    motion : tuple
        Velocity [m s-1] and thrust [m s-2], shape (3, n), and gravity [m s-2].
    raster : Raster
        Nodes and their statuses; without nodes there are no walls.
    way, longest_way : float
        Way in a step over bending and over even ground [m].
    most : float
        Longest step by other limits [s].
    place : ndarray of int, shape (m,)
        Written: places of particles found, as many as there are. The m particles are awake.
    ahead : ndarray, shape (2, m)
        Written: position at the end of the longest way [m].

    Returns
    -------
    found : int
        Number of particles found.
    shortest : float
        Longest step for the others, at most `most` [s].
    """
    status, columns, rows, dx, dy, _ = raster
    velocity, found, shortest = motion[0], 0, most
    for i in range(place.size):
        speed2, gain = _pace(i, motion)
        time = time_over(way, speed2, gain)
        if time >= most:
            continue
        u, v = velocity[0, i], velocity[1, i]
        over_map = np.sqrt(u * u + v * v)
        # slower than what it may gain on the way, it may go anywhere
        short = speed2 < 2.0 * gain * way or over_map == 0.0
        if not short and status.size > 0:
            r, c = nearest_place(y[i], dy, rows), nearest_place(x[i], dx, columns)
            for row in range(max(r - WALL_NEAR, 0), min(r + WALL_NEAR + 1, rows)):
                for column in range(max(c - WALL_NEAR, 0), min(c + WALL_NEAR + 1, columns)):
                    short = short or status[row * columns + column] == CLOSED
        if short:
            shortest = min(shortest, time)
        else:
            place[found] = i
            ahead[0, found], ahead[1, found] = x[i] + longest_way * u / over_map, y[i] + longest_way * v / over_map
            found += 1
    return found, shortest


@kernel
def _cross(place, here, there, curvature, motion, ways, shortest):
    """Return the longest step in which particles cross no more than they may where the surface turns [s].

    Parameters
    ----------
    place : ndarray of int, shape (k,)
        Places of the particles.
    here : tuple of ndarray, shape (n,)
        Slopes of the bed, dz/dx and dz/dy, below all particles [-].
    there : tuple of ndarray, shape (k,)
        Slopes at the end of the longest way [-].
    curvature : tuple of ndarray, shape (n,)
        d2z/dx2, d2z/dxdy and d2z/dy2 below all particles [m-1].
    motion : tuple
        As in `_look_ahead`.
    ways : tuple of float
        Way in a step over bending and over even ground [m], and the largest turn of even ground [rad].
    shortest : float
        Longest step by other limits [s].
    """
    way, longest_way, most_turn = ways
    velocity = motion[0]
    for k in range(place.size):
        i = place[k]
        speed2, gain = _pace(i, motion)
        if time_over(way, speed2, gain) >= shortest:
            continue
        u, v = velocity[0, i], velocity[1, i]
        scale = longest_way / np.sqrt(u * u + v * v)
        # change of the slopes, which is at least the angle between the normals: to the end, and if the bend goes on
        to_end = np.sqrt((there[0][k] - here[0][i]) ** 2 + (there[1][k] - here[1][i]) ** 2)
        x = scale * (curvature[0][i] * u + curvature[1][i] * v)
        y = scale * (curvature[1][i] * u + curvature[2][i] * v)
        turn = max(to_end, np.sqrt(x * x + y * y))
        here_way = longest_way if turn <= most_turn else max(way, longest_way * most_turn / turn)
        shortest = min(shortest, time_over(here_way, speed2, gain))
    return shortest
