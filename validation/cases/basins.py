"""Cases of the flow suite on beds that are no planes: Thacker's basin, lakes, a curved channel.

The basins are a thousand times wider than deep, so that slope-normal and vertical thickness are one (slopes of
3e-3, differences of 1e-5).
"""

import math

import numpy as np
from landlab import RasterModelGrid

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.exact import flows
from validation.cases.dam_breaks import circular_dam_break as radial_dam_break
from validation.grids import dry_block, place, release
from validation.measure import Norms, Result, advance, body, compare, energy, momentum, norms
from validation.rivals.fixed_length import law_of_flow

G = 9.81
RADIUS = 1000.0  # of Thacker's basins, 1 m deep [m]
SWING = 500.0  # of the planar surface [m]
NODES = 50  # per radius


class LinearDrag:
    """A user's friction law: every velocity decays at the same rate [1/s], whatever the thickness."""

    def __init__(self, rate):
        self.rate = rate

    def basal_resistance(self, state, yield_stress, drag):
        """Write no yield stress, and the drag [Pa s/m]."""
        yield_stress[:] = 0.0
        drag[:] = self.rate * state.density * state.thickness


def on_bed(bed, depth, half, spacing, count, friction=None, mu=0.0):
    """Put a release ``depth(x, y)`` [m] on a bed ``bed(x, y)`` [m], both functions of x and y from the middle."""
    nodes = 2 * round(half / spacing) + 1
    grid = RasterModelGrid((nodes, nodes), xy_spacing=spacing, xy_of_lower_left=2 * (-spacing * (nodes // 2),))
    x, y = grid.x_of_node, grid.y_of_node
    grid.add_field("topographic__elevation", bed(x, y) + 0.0 * x, at="node")
    release(grid, depth(x, y), on_top=True)
    keywords = dry_block(mu, particle_count=count)
    keywords["friction"] = friction or keywords["friction"]
    return place(DebrisFlow(grid, flow=law_of_flow(), **keywords))


def _thacker(name, particles, periods, frequency, speed, solution, uniform) -> Result:
    def bed(x, y):
        return flows.basin(x, y, RADIUS)

    def depth(x, y):
        return solution(x, y, 0.0)[0]

    flow = on_bed(bed, depth, 1.1 * (RADIUS + SWING), RADIUS / NODES, particles)
    before = energy(flow)
    spent = advance(flow, periods * 2.0 * math.pi / frequency)
    end = flow.elapsed_time

    def fields(x, y):
        h, u, v = solution(x, y, end)
        return h, h * np.stack([u, v])

    b = body(flow)
    due = float(b.volume.sum()) * np.array([*(solution(0.0, 0.0, end)[1:] if uniform else (0.0, 0.0)), 0.0])
    scalars = {
        # of the energy that moves, not of that of lying in a basin
        "energy drift": (energy(flow) - before) / (0.5 * b.volume.sum() * speed**2),
        "momentum, error": float(np.hypot(*(momentum(flow)[0] - due)[:2])) / (b.volume.sum() * speed),
    }
    return compare(name, flow, round(math.sqrt(particles)), spent, fields, scalars=scalars)


def thacker_planar(particles, periods=2.25) -> Result:
    """A flat surface swings to and fro along x, from rest."""
    frequency = 2.0 * math.pi / flows.thacker_planar_period(RADIUS)

    def solution(x, y, t):
        return flows.thacker_planar(x, y, t, RADIUS, orbit=(SWING, 0.0))

    return _thacker("Thacker planar", particles, periods, frequency, SWING * frequency, solution, True)


def thacker_curved(particles, periods=2.25) -> Result:
    """A curved surface breathes, from rest at .8 of the radius."""
    frequency = 2.0 * math.pi / flows.thacker_curved_period(RADIUS)

    def solution(x, y, t):
        return flows.thacker_curved(x, y, t, RADIUS, first_radius=0.8 * RADIUS)

    swing = (1.0 - 0.8**4) / (1.0 + 0.8**4)
    return _thacker("Thacker curved", particles, periods, frequency, 0.5 * frequency * swing * RADIUS, solution, False)


def _lake(particles, wave, length, deep, rim=0.05, flat=40.0):
    """A round lake, level at 0: a floor with waves in both directions, and a rim that rises evenly."""

    def bed(x, y):
        r = np.hypot(x, y)
        inner = np.clip((flat - r) / 5.0, 0.0, 1.0)
        ripple = np.sin(2.0 * math.pi * x / length) * np.cos(2.0 * math.pi * y / length)
        return -deep + np.maximum(0.0, r - flat) * rim + wave * inner * ripple

    return bed, lambda x, y: np.maximum(0.0, -bed(x, y)), flat + deep / rim


def lake_damped(particles, rate=0.16, duration=150.0) -> Result:
    """A lake 1 m deep over waves of 5 cm by 20 m, damped until it is still: what is left of its surface, rms."""
    bed, depth, edge = _lake(particles, 0.05, 20.0, 1.0)
    flow = on_bed(bed, depth, edge + 10.0, 1.0, particles, LinearDrag(rate))
    spent = advance(flow, duration)

    def fields(x, y):
        return depth(x, y), np.zeros((2, np.size(x)))

    def inside(x, y):
        return np.hypot(x, y) < 30.0

    b, p = body(flow), flow.particles
    here = inside(b.x, b.y)
    surface = (p.z.values + p.depth.values)[here]
    scalars = {
        "surface rms [m]": float(surface.std()), "surface mean [m]": float(surface.mean()),
        "largest speed [m/s]": float(np.linalg.norm(b.velocity, axis=0)[here].max()),
    }  # fmt: skip
    scale = math.sqrt(G)
    return compare("lake, damped", flow, round(math.sqrt(particles)), spent, fields, inside, scale, scalars=scalars)


def lake_rough(particles, duration=30.0) -> Result:
    """A lake 2 m deep over waves of .5 m by 20 m: its first acceleration against g sin^3(theta), then its currents."""
    bed, depth, edge = _lake(particles, 0.5, 20.0, 2.0)
    flow = on_bed(bed, depth, edge + 10.0, 1.0, particles)
    flow.run_one_step(1e-3 - flow.elapsed_time)
    b = body(flow)
    here = np.hypot(b.x, b.y) < 30.0
    pushed = b.velocity[:, here] / flow.elapsed_time  # [m s-2]
    step = 1e-3
    x, y = b.x[here], b.y[here]
    slope = np.stack([bed(x + step, y) - bed(x - step, y), bed(x, y + step) - bed(x, y - step)]) / (2.0 * step)
    steep = np.hypot(*slope)
    sine = steep / np.sqrt(1.0 + steep**2)
    # along the bed, downwards: (x, y, z) = (-grad Z, -|grad Z|^2) / (|grad Z| (1 + |grad Z|^2)^(1/2))
    down = np.concatenate([-slope, -(steep**2)[None]]) / (steep * np.sqrt(1.0 + steep**2))
    residual = G * sine**3 * down
    fit = float(np.sum(pushed * residual) / np.sum(residual**2))
    noise = float(np.sqrt(np.mean(np.sum((pushed - residual) ** 2, axis=0))))
    spent = advance(flow, duration)

    def fields(x, y):
        return depth(x, y) / np.sqrt(1.0 + 0.0 * x), np.zeros((2, np.size(x)))

    def inside(x, y):
        return np.hypot(x, y) < 30.0

    b = body(flow)
    scalars = {
        "acceleration over g sin^3": fit, "rms of g sin^3 [m/s2]": float(np.sqrt(np.mean((G * sine**3) ** 2))),
        "rms of the rest [m/s2]": noise,
        "rms speed at the end [m/s]": float(np.sqrt(np.mean(np.sum(b.velocity[:, inside(b.x, b.y)] ** 2, axis=0)))),
    }  # fmt: skip
    scale = 2.0 * math.sqrt(2.0 * G)
    return compare("lake, rough", flow, round(math.sqrt(particles)), spent, fields, inside, scale, scalars=scalars)


def circular_dam_break(particles, ahead=0.1, duration=2.0) -> Result:
    """A cylinder of water, 10 m by 1 m, is set free over `ahead` [m] of water; a converged solution in the radius."""
    reach = 30.0 if ahead > 0.0 else 0.0

    def depth(x, y):
        r = np.hypot(x, y)
        return np.where(r < 10.0, 1.0, np.where(r < reach, ahead, 0.0))

    # the circle of the release is made of cells: 25 cm of them where they are few enough to be filled in time
    flow = on_bed(lambda x, y: 0.0 * x, depth, 32.0, 0.5 if ahead else 0.25, particles)
    before = energy(flow)
    spent = advance(flow, duration)
    end = flow.elapsed_time

    def fields(x, y):
        h, u, v = radial_dam_break(x, y, end, depth_ahead=ahead)
        return h, h * np.stack([u, v])

    def inside(x, y):
        return np.hypot(x, y) < 25.0

    scalars = {"energy drift": energy(flow) / before - 1.0}
    name = f"circular dam, {'wet' if ahead else 'dry'}"
    return compare(name, flow, round(math.sqrt(particles)), spent, fields, inside, scalars=scalars)


def curved_channel(particles, mu=0.0, duration=12.0, finest=None):
    """A cap runs down a channel that bends through a half circle of 60 m on a fall of 15 degrees.

    There is no exact solution: h and |hu| on the nodes are compared with those of `finest`, what this returned
    for many particles; without friction the energy must stay.

    Returns
    -------
    Result, depth and discharge on the nodes
    """
    bend, fall, wide = 60.0, math.tan(math.radians(15.0)), 20.0

    def bed(x, y):
        along = bend * np.arctan2(y, x)  # from the positive x-axis, counterclockwise; 0 at the release
        across = np.hypot(x, y) - bend
        # down along the arc; parabolic banks that turn straight
        bank = np.where(abs(across) < wide, across**2 / (2.0 * wide), abs(across) - 0.5 * wide)
        return -fall * np.where(along < -0.5 * math.pi * bend, along + 2.0 * math.pi * bend, along) + bank

    def cap(x, y):
        return 1.5 * np.maximum(0.0, 1.0 - (x - bend) ** 2 / 36.0 - y**2 / 144.0)

    flow = on_bed(bed, cap, 100.0, 1.0, particles, mu=mu)
    before = energy(flow)
    spent = advance(flow, duration)
    grid = flow.grid
    depth = grid.at_node["debris_flow__depth"].copy()
    discharge = depth * grid.at_node["debris_flow__speed"]
    b = body(flow)
    moving = 0.5 * float(np.sum(b.volume * np.sum(b.velocity**2, axis=0)))
    angle = np.degrees(np.arctan2(b.y, b.x))
    scalars = {
        "energy drift over kinetic energy": (energy(flow) - before) / moving if mu == 0.0 else math.nan,
        "mean way along the bend [deg]": float(angle.mean()),
        "front [deg]": float(np.quantile(angle, 0.99)),
        "outflow": flow.budget["outflow"],
        "fastest [m/s]": float(np.linalg.norm(b.velocity, axis=0).max()),
    }
    nothing = Norms(math.nan, math.nan, math.nan)
    errors = (nothing, nothing)
    if finest is not None:
        errors = norms(1.0, depth, finest[0]), norms(1.0, discharge, finest[1])
    return Result(
        "curved channel", "ours", round(math.sqrt(particles)), b.x.size, spent[1], spent[0], *errors, scalars
    ), (depth, discharge)
