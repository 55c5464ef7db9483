"""Scenes in which rules of time steps fail, as a program that any version runs: ``python -P step_scenes.py FOLDER``.

Requests and answers are those of ratio_scenes.py. The length of the step is a keyword, and the limit by node spacing is
lifted: shown is what a length of the step does, whatever rule would allow it.

bend         a thin slab without friction slides over a bend of the bed
edge         a slab slides onto ground that erodes, and off it again
surge        a slab falls into a body that lies on a slope of nearly the angle of friction
valley_at    the stand-in for Tsing Shan at some times, with steps shortened
"""

import math
import sys
from pathlib import Path

import numpy as np
from landlab import RasterModelGrid

from landlab_debrisflow import SimulationError

if not __package__:  # run as a file: the package that is installed goes before that of the checkout
    sys.path.append(str(Path(__file__).parents[1]))
from benchmarks.ratio_scenes import COULOMB, MATERIAL, PLACED, VALLEY, answer, counted, flow_on, grid_of

G, SPACING = 9.81, 5.0
DRY = MATERIAL | {"water_density": 0.0}
FALL = 60.0
"""Way over the map to the bend or edge [m]."""


class Watch:
    """Observer of a body: its energy per weight and the kinetic part [m], place [m], volume [m3], thickest part [m]."""

    def __init__(self, interval=math.inf):
        self.interval, self.rows = interval, []

    def observe(self, flow):
        """Note the state now."""
        p = flow.particles
        if p.sizes["particle"] == 0:
            return
        volume, h = p.volume.values, p.thickness.values
        cosine, mass = h / p.depth.values, volume.sum()
        kinetic = 0.5 * (p.velocity_x.values**2 + p.velocity_y.values**2 + p.velocity_z.values**2) / G
        total = kinetic + p.z.values + 0.5 * cosine * h
        x = p.x.values
        order = np.argsort(x)
        front = x[order][np.searchsorted(volume[order].cumsum(), 0.99 * mass)]
        means = [float((volume * values).sum() / mass) for values in (total, kinetic, x)]
        self.rows.append((flow.elapsed_time, *means, float(front), float(mass), float(h.max())))

    def found(self):
        """Return the series by name, as lists."""
        names = "time", "energy", "kinetic", "x", "front", "volume", "thickest"
        return {name: list(column) for name, column in zip(names, zip(*self.rows, strict=True), strict=True)}


def laid_on(elevation, thickness, columns, rows=9, soil=None, closed=False):
    """Return a grid with a bed, elevation(x) [m], under a release of thickness(x, y) [m], y from the middle."""
    grid = RasterModelGrid((rows, columns), xy_spacing=SPACING)
    x, y = grid.x_of_node, grid.y_of_node - 0.5 * SPACING * (rows - 1)
    depth = thickness(x, y)
    grid.add_field("topographic__elevation", elevation(x) + depth, at="node")
    grid.add_field("soil__depth", depth + (0.0 if soil is None else soil(x)), at="node")
    grid.add_field("debris_flow__release_depth", depth, at="node")
    if closed:
        grid.set_closed_boundaries_at_grid_edges(True, True, False, True)
    return grid


def watched(grid, duration, count, angle, *, dt=None, courant=None, erosion=0.0, looks=40):
    """Run a dry body; return the series of a `Watch`, and the lengths of its steps [s].

    Without `dt`, the length of all steps [s], they are those of the version, or of a Courant number past its check.
    """
    watch = Watch(duration / looks)
    flow = flow_on(
        grid, count=count, erosion=erosion, column="none", material=DRY, observers=[watch],
        friction=COULOMB | {"basal_friction_angle": angle}, numerics={"settle": False, "rest_energy": 0.0},
    )  # fmt: skip
    numerics = flow.setup.numerics
    if dt is not None or courant is not None:
        object.__setattr__(numerics, "courant_number", courant or 1e3)
        object.__setattr__(numerics, "advective_courant_number", 1e3 if dt else 2.0)
    flow.run_one_step(PLACED)
    watch.observe(flow)
    with counted() as count_of:
        if dt is None:
            flow.run_one_step(duration)
        else:
            for _ in range(int(duration / dt)):
                flow.run_one_step(dt)
            flow.run_one_step(duration - dt * int(duration / dt))
    return watch.found() | {"lengths": count_of.lengths}


def slab(centre, half_length, half_width, depth):
    """Return the thickness of a slab as a function of x and y."""
    return lambda x, y: depth * ((abs(x - centre) < half_length) & (abs(y) < half_width))


def slide(grid, count, angle, *, way, distance, pull, **keywords):
    """Run a slab that meets something after a `distance` [m] of its slope, with an acceleration `pull` [m s-2].

    `way` are the node spacings that it goes there in a step; None: as the version's rule allows. The series has the way
    that it went there in a step.
    """
    speed, arrival = math.sqrt(2.0 * pull * distance), math.sqrt(2.0 * distance / pull)
    dt = way and way * SPACING / speed
    found = watched(grid, arrival + 0.6 * distance / speed, count, angle, dt=dt, **keywords)
    at = min(np.searchsorted(np.cumsum(found["lengths"]), arrival), len(found["lengths"]) - 1)
    return found | {"way": found["lengths"][at] * speed / SPACING}


def bend(turn, way=None):
    """Slide over a bend of `turn` [rad], concave if positive."""
    low = math.radians(8.0)
    first, second = (low + turn, low) if turn > 0.0 else (low, low - turn)
    at = 30.0 + FALL

    def elevation(x):
        return 400.0 - np.where(x < at, math.tan(first) * x, math.tan(first) * at + math.tan(second) * (x - at))

    grid = laid_on(elevation, slab(30.0, 8.0, 8.0, 0.05), 61)
    distance, pull = FALL / math.cos(first), G * math.sin(first)
    return slide(grid, 60, 0.0, way=way, distance=distance, pull=pull)


def edge(way=None, growth=1e-3):
    """Slide over 50 m of ground that erodes; `x` is the centre less where it is without erosion in the same steps [m].

    The slab spreads, too, and its place depends on the length of the step without any soil.
    """
    slope, friction = math.radians(25.0), math.radians(20.0)
    at = 30.0 + FALL

    def over(erosion):
        grid = laid_on(
            lambda x: 400.0 - math.tan(slope) * x, slab(30.0, 8.0, 8.0, 0.5), 61,
            soil=lambda x: 3.0 * ((x > at) & (x < at + 50.0)),
        )  # fmt: skip
        pull = G * (math.sin(slope) - math.tan(friction) * math.cos(slope))
        distance = FALL / math.cos(slope)
        return slide(grid, 120, math.degrees(friction), way=way, distance=distance, pull=pull, erosion=erosion)

    found, bare = over(growth), over(0.0)
    return found | {"x": [found["x"][-1] - bare["x"][-1]]}


def surge(ratio, courant):
    """Let a slab of 1 m fall into a body of 4 m on 15 degrees whose pull is `ratio` of its friction.

    The body has the fastest waves and the shortest smoothing lengths. `courant` is the Courant number of the steps; a
    particle goes up to two nodes in one.
    """
    upper, lower = math.radians(30.0), math.radians(15.0)
    at = 100.0

    def elevation(x):
        return 400.0 - np.where(x < at, math.tan(upper) * x, math.tan(upper) * at + math.tan(lower) * (x - at))

    def thickness(x, y):
        body = 4.0 * np.clip((x - 115.0) / 40.0, 0.0, 1.0) * (x < 216.0)
        return (body + slab(60.0, 16.0, 1e9, 1.0)(x, y)) * (abs(y) < 12.6)

    grid = laid_on(elevation, thickness, 45, rows=7, closed=True)
    angle = math.degrees(math.atan(math.tan(lower) / ratio))
    try:
        found = watched(grid, 12.0, 2500, angle, courant=courant, looks=48)
    except SimulationError:  # the end of what has blown up
        return None
    return found if found["volume"][-1] > 0.999 * found["volume"][0] else None  # or was thrown over the walls


def valley_at(times, count, shorter=1):
    """Run the stand-in for Tsing Shan; return the series of a `Watch` at the given times [s]."""
    numerics = {"courant_number": 0.6 / shorter, "advective_courant_number": 0.5 / shorter, "settle": False}
    watch, flow = Watch(), flow_on(grid_of("valley"), count=count, numerics=numerics, **VALLEY)
    with counted() as count_of:
        for time in times:
            flow.run_one_step(time - flow.elapsed_time)
            watch.observe(flow)
    return watch.found() | {"lengths": count_of.lengths}


SCENES = {one.__name__: one for one in (bend, edge, surge, valley_at)}

if __name__ == "__main__":
    answer(SCENES)
