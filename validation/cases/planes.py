"""Cases of the flow suite on planes: dam breaks, caps, similarity solution.

Coordinates: s along the slope [m], y across; the raster holds x = s cos(theta). Terrain is a plane, so its
nodes may lie some particles apart. Every case returns a `Result`; `along` is the number of particles along
the direction that counts at release, not their total.

Dam breaks are one-dimensional in the middle of a body with free edges: what a free edge does travels inwards at
(g' h)^(1/2) at most. The reservoir is as long as it takes for the rarefaction from its rear, and as wide as it
takes for those from its sides, not to reach the measured strip of twelve particles before the end; `particles` and CPU
time are those of twelve rows, the mean over all. With ``walls=True`` twelve rows lie between closed nodes instead.
"""

import math

import numpy as np
from landlab import RasterModelGrid

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.exact import flows
from validation.grids import dry_block, place, release
from validation.measure import Result, advance, body, compare, energy
from validation.rivals.fixed_length import law_of_flow

G = 9.81
CELL = 6  # node spacing over particle spacing of the deepest reservoir
HALF_STRIP = 6  # half width of the measured strip in particle spacings
TRAVEL = 0.45  # of the reservoir's length, the way of the rarefaction until the end


def plane(extent, spacing, angle, thickness, mu, count, walls=False, erosion="none", soil=None, saturated=None,
          threads=1):  # fmt: skip
    """Put a release, ``thickness(s, y)`` slope-normal [m], on a plane that falls towards larger s.

    Parameters
    ----------
    extent : tuple
        First and last s, first and last y of the raster [m].
    spacing : float
        Node spacing on the slope [m].
    count : int
        Number of particles.
    saturated : dict, optional
        Keywords of DebrisFlow instead of a dry flow with friction `mu`.

    Returns
    -------
    DebrisFlow
        Placed, at rest; map x = s cos(theta).
    """
    cos = math.cos(angle)
    west, east, south, north = extent
    shape = round((north - south) / spacing) + 1, round((east - west) / spacing) + 1
    grid = RasterModelGrid(shape, xy_spacing=(spacing * cos, spacing), xy_of_lower_left=(west * cos, south))
    grid.add_field("topographic__elevation", -math.tan(angle) * grid.x_of_node, at="node")
    if walls:
        grid.set_closed_boundaries_at_grid_edges(False, True, False, True)
    if soil is not None:
        grid.add_full("soil__depth", soil, at="node")
    release(grid, thickness(grid.x_of_node / cos, grid.y_of_node) / cos, on_top=True)
    keywords = dry_block(mu, erosion, particle_count=count, threads=threads)
    if saturated is not None:
        keywords = {"erosion": erosion, "numerics": keywords["numerics"]} | saturated
    return place(DebrisFlow(grid, **{"flow": law_of_flow()} | keywords))


def dam_break(name, along, angle, mu, downstream, solution, walls=False, length=100.0) -> Result:
    """Run a reservoir `length` by 1 m, with `downstream` [m] of water below the dam at s = 0."""
    cos = math.cos(angle)
    d, celerity = length / along, math.sqrt(G * cos)
    duration = TRAVEL * length / celerity
    cell, away = CELL * d, celerity * duration
    drift = 0.5 * G * cos * (math.tan(angle) - mu) * duration**2  # of a body that slides as one
    # in cells, so that the dam and all sides lie between nodes
    long = math.ceil(length / cell)
    side = 1 if walls else math.ceil((1.2 * away + (HALF_STRIP + 12) * d) / cell)
    below = math.ceil(1.5 * away / cell) if downstream else 0  # shock, and the wave from its far end
    upper, lower = long + math.ceil(2.0 * away / cell) + 6, max(below, math.ceil((2.0 * away + drift) / cell)) + 6
    edge = side + (0.5 if walls else math.ceil(2.0 * away / cell) + 6.5)
    extent = tuple(cell * c for c in (0.5 - upper, lower - 0.5, -edge, edge))
    long, side, below = cell * long, cell * side, cell * below

    def thickness(s, y):
        within = abs(y) < side
        return within * np.where((s < 0.0) & (s > -long), 1.0, np.where((s > 0.0) & (s < below), downstream, 0.0))

    count = round(2.0 * side * (long + downstream * below) / d**2)
    flow = plane(extent, cell, angle, thickness, mu, count, walls)
    strip = HALF_STRIP * d * (2.0 if downstream else 1.0)
    before = energy(flow)
    spent = advance(flow, duration)
    end = flow.elapsed_time

    def fields(x, y):
        h, u = solution(x / cos, end)
        return h, np.stack([h * u, 0.0 * h])

    def inside(x, y):
        s = x / cos
        most = below - away / 3.0 - 6.0 * d if downstream else np.inf
        return (abs(y) < strip) & (s > drift - 1.1 * away) & (s < most)

    b = body(flow)
    found, here = b.x / cos, inside(b.x, b.y)
    # a strip of twelve is what the case is about: its part of the cost of all rows
    spent = spent[0] * min(1.0, HALF_STRIP * d / side), spent[1]
    scalars = {
        "particles in all": count,
        "energy drift": energy(flow) / before - 1.0 if mu == 0.0 else math.nan,
        "speed across over celerity": float(np.abs(b.velocity[1][here]).max()) / celerity,
    }
    if not downstream:
        # the front where 2 % of the reservoir lie beyond: the tip of a parabola has no volume to be made of
        last = np.sort(found[abs(b.y) < strip])[::-1][round(0.02 * length / d * 2.0 * HALF_STRIP)]
        # beyond x lie (2 c0 t - x)^3/(27 g' t^2) of Ritter's parabola
        tip = (27.0 * G * cos * end**2 * 0.02 * length) ** (1.0 / 3.0)
        scalars["2 % front, error over way"] = float(last - (2.0 * celerity * end + drift - tip)) / away
    result = compare(name, flow, along, spent, fields, inside, scalars=scalars)
    result.particles = round(count * min(1.0, HALF_STRIP * d / side))
    return result


def ritter(along, walls=False) -> Result:
    """A dam breaks on a flat dry bed without friction."""
    return dam_break("Ritter" + " walls" * walls, along, 0.0, 0.0, 0.0, flows.ritter, walls)


def stoker(along, walls=False) -> Result:
    """The same over a tenth of the depth: a shock."""
    return dam_break("Stoker" + " walls" * walls, along, 0.0, 0.0, 0.1, flows.stoker, walls)


def mangeney(along, walls=False, degrees=(22.0, 15.0), length=100.0, name="Mangeney") -> Result:
    """A dam breaks on a slope of 22 degrees with a friction angle of 15."""
    slope, friction = math.radians(degrees[0]), math.tan(math.radians(degrees[1]))

    def solution(s, t):
        return flows.mangeney(s, t, 1.0, slope, friction)

    return dam_break(name + " walls" * walls, along, slope, friction, 0.0, solution, walls, length)


def slope_dam_break(along) -> Result:
    """AvaFrame's dam break, 22 degrees and friction 21, for 5 s."""
    length = 5.0 * math.sqrt(G * math.cos(math.radians(22.0))) / TRAVEL  # 33.5 m
    return mangeney(along, degrees=(22.0, 21.0), length=length, name="dam break 22/21")


def cap(particles, degrees=30.0) -> Result:
    """A circular cap, 10 m by 1 m, spreads without friction for 5 s; velocities relative to its centre."""
    angle, duration = math.radians(degrees), 5.0
    radius, run = flows.cap_radius(duration, slope=angle), 0.5 * G * math.sin(angle) * duration**2
    extent = (-1.2 * radius, run + 1.3 * radius, -1.3 * radius, 1.3 * radius)

    def solution(s, y, t):
        return flows.cap(s, y, t, slope=angle)

    flow = plane(extent, 0.5, angle, lambda s, y: np.maximum(0.0, 1.0 - (s**2 + y**2) / 100.0), 0.0, particles)
    result = _cap(f"cap {degrees:g} deg", flow, angle, 0.0, duration, solution, round(math.sqrt(particles)))
    b = body(flow)
    along = math.sqrt(6.0) * float(np.std(b.x)) / math.cos(angle) / radius - 1.0
    across = math.sqrt(6.0) * float(np.std(b.y)) / radius - 1.0
    return _with(result, {"radius along, error": along, "radius across, error": across})


def ridge(along, degrees=30.0, friction_angle=20.0) -> Result:
    """A ridge 20 m wide and 100 m long spreads with friction for 5 s; measured in its middle."""
    angle, duration, friction = math.radians(degrees), 5.0, math.tan(math.radians(friction_angle))
    width, _ = flows.ridge_half_width(duration, slope=angle)
    run = 0.5 * G * (math.sin(angle) - friction * math.cos(angle)) * duration**2

    def solution(s, y, t):
        h, u = flows.ridge(s, t, slope=angle, friction=friction)
        return h, u, 0.0 * h

    def thickness(s, y):
        return (abs(y) < 50.0) * np.maximum(0.0, 1.0 - s**2 / 100.0)

    # as many particles along as across in the sense of a body of uniform thickness: V = 2/3 of the box
    count = round(along**2 * 5.0)
    flow = plane((-30.0, run + 45.0, -80.25, 79.75), 0.5, angle, thickness, friction, count)
    middle = abs(body(flow).y) < 10.0
    result = _cap("ridge", flow, angle, friction, duration, solution, along, lambda x, y: abs(y) < 10.0)
    half = math.sqrt(5.0) * float(np.std(body(flow).x[middle])) / math.cos(angle)
    return _with(result, {"half width, error": half / width - 1.0})


def similarity_body(particles, threads=1):
    """Put the cap of the similarity solution on its plane: 35 degrees, friction 25, 80 m by 4 m."""
    angle, friction = math.radians(35.0), math.tan(math.radians(25.0))

    def thickness(s, y):
        return 4.0 * np.maximum(0.0, 1.0 - (s**2 + y**2) / 6400.0)

    return plane((-110.0, 180.0, -110.0, 110.0), 2.0, angle, thickness, friction, particles, threads=threads)


def similarity(particles) -> Result:
    """AvaFrame's similarity solution: 35 degrees, friction 25, a cap of 80 m by 4 m, 5 s; absolute velocities."""
    angle, friction = math.radians(35.0), math.tan(math.radians(25.0))
    flow, along = similarity_body(particles), round(math.sqrt(particles))
    return _cap("similarity", flow, angle, friction, 5.0, flows.similarity, along, still=True)


def _cap(name, flow, angle, friction, duration, solution, along, inside=None, still=False) -> Result:
    """Compare a cap with its solution, in a frame that moves with its centre unless `still`."""
    before, cos = energy(flow), math.cos(angle)
    spent = advance(flow, duration)
    end = flow.elapsed_time
    centre = 0.0 if still else G * (math.sin(angle) - friction * cos) * end

    def fields(x, y):
        h, u, v = solution(x / cos, y, end)
        return h, h * np.stack([u - centre, v])

    result = compare(name, flow, along, spent, fields, inside, frame=centre)
    return _with(result, {"energy drift": energy(flow) / before - 1.0} if friction == 0.0 else {})


def _with(result, scalars):
    result.scalars.update({name: float(value) for name, value in scalars.items()})
    return result
