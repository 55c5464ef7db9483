"""Time in which particles may cross the terrain: half a node in a step, or nearly a whole one where the ground is even.

Forces act where a step begins and ends, so a step must be short where the ground bends: friction in a curve and the
impulse of a kink follow from the bed at these two places. Where the surface turns by less than `TURN` on the way, a
step of nearly a node sees all of it. A particle with a closed node near it keeps the short way, too: walls stop it at
the middle between two nodes. No step is as long as a node, unless the user asks for this, so that none leads through a
wall one node thick.
"""

import numpy as np

from ..core.jit import allocating_kernel, inner
from ..core.lanes import lane_surroundings
from ..spatial.raster import CLOSED, Raster, is_walled, nearest_place
from ..terrain.surface import slopes_at

WALL_NEAR = 2
"""Distance in nodes within which a closed node is near."""

NO_WALLS = Raster(np.empty(0, np.uint8), 0, 0, 1.0, 1.0, np.empty(0, bool))
"""A raster without nodes."""


def find_time_across(p, surface, walls, rule, gravity: float, short_times, most: float) -> float:
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
    short_times : ndarray, shape (awake,)
        Time in which each particle may go the way that is short enough anywhere [s].
    most : float
        Longest step by other limits [s].
    """
    motion, slopes = (p.velocity, p.thrust, gravity), (p.slope_x, p.slope_y)
    curvature = p.curvature_xx, p.curvature_xy, p.curvature_yy
    ways, ground = (rule.way, rule.longest_way, rule.turn), (surface.values, surface.dx, surface.dy)
    return float(_cross((p.x, p.y), slopes, curvature, motion, ground, walls or NO_WALLS, ways, short_times, most))


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


@inner
def _is_wall_near(row, column, status, columns, rows):
    """Return whether a closed node lies within `WALL_NEAR` rows and columns of a node of a `Raster`."""
    for r in range(max(row - WALL_NEAR, 0), min(row + WALL_NEAR + 1, rows)):
        for c in range(max(column - WALL_NEAR, 0), min(column + WALL_NEAR + 1, columns)):
            if status[r * columns + c] == CLOSED:
                return True
    return False


@inner
def _way_by_turn(turn, ways):
    """Return how far a particle may go where the surface turns by an angle [rad] on the longest way [m]."""
    way, longest_way, most_turn = ways
    return longest_way if turn <= most_turn else max(way, longest_way * most_turn / turn)


@allocating_kernel
def _cross(position, slopes, curvature, motion, ground, raster, ways, short_times, most):
    """Return the longest step in which particles cross no more than they may where the surface turns [s].

    The first loop knows only how the surface bends below the particles; what it finds is not too short. The second
    looks at the end of the longest way of those particles that could make it shorter, which are few.

    Parameters
    ----------
    position : tuple of ndarray, shape (n,)
        Map coordinates x and y of all particles [m].
    slopes : tuple of ndarray, shape (n,)
        Slopes of the bed, dz/dx and dz/dy, below all particles [-].
    curvature : tuple of ndarray, shape (n,)
        d2z/dx2, d2z/dxdy and d2z/dy2 below all particles [m-1].
    motion : tuple
        Velocity [m s-1] and thrust [m s-2], shape (3, n), and gravity [m s-2].
    ground : tuple
        Elevation of nodes with their rim [m], and node spacings [m] (`Surface`).
    raster : Raster
        Nodes and their statuses; without nodes there are no walls.
    ways : tuple of float
        Way in a step over bending and over even ground [m], and the largest turn of even ground [rad].
    short_times : ndarray, shape (m,)
        Time for the first of these ways, of the m particles that are awake [s].
    most : float
        Longest step by other limits [s].
    """
    (x, y), (values, spacing_x, spacing_y) = position, ground
    velocity, way, longest_way = motion[0], ways[0], ways[1]
    status, columns, rows, dx, dy, walled = raster
    place, bend, found, shortest = np.empty(short_times.size, np.int64), np.empty(short_times.size), 0, most
    for i in range(short_times.size):
        if short_times[i] >= shortest:
            continue
        speed2, gain = _pace(i, motion)
        u, v = velocity[0, i], velocity[1, i]
        over_map = np.sqrt(u * u + v * v)
        # slower than what it may gain on the way, it may go anywhere
        short = speed2 < 2.0 * gain * way or over_map == 0.0
        if not short and status.size > 0:
            row, column = nearest_place(y[i], dy, rows), nearest_place(x[i], dx, columns)
            short = is_walled(row, column, walled, columns) and _is_wall_near(row, column, status, columns, rows)
        if short:
            shortest = short_times[i]
            continue
        # change of the slopes, which is at least the angle between the normals, if the bend goes on
        scale = longest_way / over_map
        along_x = scale * (curvature[0][i] * u + curvature[1][i] * v)
        along_y = scale * (curvature[1][i] * u + curvature[2][i] * v)
        turn = np.sqrt(along_x * along_x + along_y * along_y)
        place[found], bend[found] = i, turn
        found += 1
        shortest = min(shortest, time_over(_way_by_turn(turn, ways), speed2, gain))
    around = lane_surroundings()
    for k in range(found):
        i = place[k]
        if short_times[i] >= shortest:
            continue
        speed2, gain = _pace(i, motion)
        u, v = velocity[0, i], velocity[1, i]
        over_map = np.sqrt(u * u + v * v)
        there_x, there_y = x[i] + longest_way * u / over_map, y[i] + longest_way * v / over_map
        slope_x, slope_y = slopes_at(values, spacing_x, spacing_y, there_x, there_y, around)
        to_end = np.sqrt((slope_x - slopes[0][i]) ** 2 + (slope_y - slopes[1][i]) ** 2)
        shortest = min(shortest, time_over(_way_by_turn(max(to_end, bend[k]), ways), speed2, gain))
    return shortest
