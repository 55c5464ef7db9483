"""Cases of the flow suite that slide as one: blocks, growth by erosion, consolidation, rest and stopping.

Errors of a block are those of travel and speed, relative; it has no fields to compare, so its norms are empty.
The block is a parabolic cap so thin that it hardly spreads.
"""

import math

import numpy as np

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.exact import columns, flows
from validation import grids
from validation.cases.planes import plane
from validation.measure import Norms, Result, advance, body

G = 9.81
MU = 0.3  # friction of blocks that do not grow [-]
RADIUS = 50.0  # of a thin cap, across the slope [m]
NOTHING = Norms(math.nan, math.nan, math.nan)


def thin_cap(depth, radius=RADIUS):
    """Return a cap as a function of s and y [m]."""
    return lambda s, y: depth * np.maximum(0.0, 1.0 - (s**2 + y**2) / radius**2)


def middle(flow, cos, here=None):
    """Return mean place and speed along the slope [m, m/s] and the mean volume [m3]."""
    b = body(flow)
    here = np.ones(b.x.size, bool) if here is None else here
    weight = b.volume[here] / b.volume[here].sum()
    return (b.x[here] @ weight) / cos, (b.velocity[0][here] @ weight) / cos, b.volume.mean()


def _result(name, flow, spent, scalars) -> Result:
    n = flow.particles.sizes["particle"]
    scalars = {key: float(value) for key, value in scalars.items()}
    return Result(name, "ours", round(math.sqrt(n)), n, spent[1], spent[0], NOTHING, NOTHING, scalars)


def block(particles, degrees=30.0, mu=MU, duration=8.0) -> Result:
    """A thin cap of friction .3 on a plane, from rest; below its friction angle it must not move."""
    angle = math.radians(degrees)
    speed, way = flows.sliding_block(duration, angle, mu)
    flow = plane((-100.0, way + 100.0, -80.0, 80.0), 10.0, angle, thin_cap(0.02), mu, particles)
    start, *_ = middle(flow, math.cos(angle))
    spent = advance(flow, duration)
    end, found, _ = middle(flow, math.cos(angle))
    relative = max(float(way), 1e-300) if way > 0.0 else 1.0
    scalars = {"travel error" if way > 0.0 else "travel [m]": (end - start - way) / relative}
    if speed > 0.0:
        scalars["speed error"] = found / speed - 1.0
    return _result(f"block {degrees:g} deg", flow, spent, scalars)


def eroding_block(particles) -> Result:
    """Hungr's block: 30 degrees, friction .21, growth 3e-3 per metre, 20 s."""
    angle = math.radians(30.0)
    flow = plane((-150.0, 650.0, -140.0, 140.0), 20.0, angle, thin_cap(1e-3, 60.0), 0.21, particles,
                 erosion={"law": "growth", "growth_rate": 3e-3}, soil=1.0)  # fmt: skip
    speed, way, ratio = flows.eroding_block(20.0, angle, 0.21, 3e-3)
    start, _, volume = middle(flow, math.cos(angle))
    spent = advance(flow, 20.0)
    end, found, grown = middle(flow, math.cos(angle))
    errors = {"travel error": (end - start) / way - 1.0, "speed error": found / speed - 1.0}
    return _result("eroding block", flow, spent, errors | {"volume error": grown / volume / ratio - 1.0})


def consolidating_block(particles, degrees=25.0, duration=8.0) -> Result:
    """A saturated slab of 2 cm slides on its own pore pressure, which drains in 8 s; measured in its middle."""
    angle, thick, half = math.radians(degrees), 0.02, 50.0
    material = {"coefficient_of_consolidation": thick**2 / 8.0}
    mu = 0.6 * 990.0 / 1990.0  # buoyant over saturated density of the default material
    speed, way = flows.consolidating_block(duration, angle, mu, 0.65, 8.0)

    def slab(s, y):
        return np.where((abs(s) < half) & (abs(y) < half), thick, 0.0)

    flow = plane((-105.0, way + 105.0, -105.0, 105.0), 10.0, angle, slab, 0.0, particles,
                 saturated={"column": "ale", "material": material})  # fmt: skip
    b = body(flow)
    inner = (abs(b.x / math.cos(angle)) < 25.0) & (abs(b.y) < 25.0)
    start, *_ = middle(flow, math.cos(angle), inner)
    spent = advance(flow, duration)
    end, found, _ = middle(flow, math.cos(angle), inner)
    left = flow.particles.basal_excess_pore_pressure / flow.particles.liquefaction_pressure
    ratio = 0.65 * float(columns.basal_consolidation(duration / 8.0))
    scalars = {
        "travel error": (end - start) / way - 1.0, "speed error": found / speed - 1.0,
        "pressure ratio error": float(left.values[inner].mean()) / ratio - 1.0,
    }  # fmt: skip
    return _result("consolidating block", flow, spent, scalars)


def stopping_slab(particles) -> Result:
    """A cap slides 4 s down 30 degrees, finds itself on 5 degrees (the terrain is changed by others), and stops."""
    mu, first, second = 0.4, math.radians(30.0), math.radians(5.0)
    flow = plane((-100.0, 300.0, -80.0, 80.0), 10.0, first, thin_cap(2e-3), mu, particles)
    spent = advance(flow, 4.0)
    x, speed, _ = middle(flow, math.cos(first))
    grid = flow.grid
    grid.at_node["topographic__elevation"][:] = -math.tan(second) * grid.x_of_node
    begin = flow.elapsed_time
    flow.run_until_rest(100.0)
    stop = speed / (G * (mu * math.cos(second) - math.sin(second)))
    end, left, _ = middle(flow, math.cos(second))
    way = end - x * math.cos(first) / math.cos(second)  # the map position stays as the terrain changes
    held = flow.particles.x.values.copy()
    took = flow.elapsed_time - begin
    flow.run_one_step(100.0)
    scalars = {
        "time error": took / stop - 1.0, "travel error": way / (0.5 * speed * stop) - 1.0,
        "speed left [m/s]": left, "moved after [m]": np.abs(flow.particles.x.values - held).max(),
    }  # fmt: skip
    return _result("stopping slab", flow, spent, scalars)


def resting_slab(particles) -> Result:
    """A slab of 10 cm on 15 degrees under a friction of .4 for 100 s: to the last bit."""
    angle = math.radians(15.0)

    def slab(s, y):
        return np.where((abs(s) < 40.0) & (abs(y) < 40.0), 0.1, 0.0)

    flow = plane((-105.0, 105.0, -105.0, 105.0), 10.0, angle, slab, 0.4, particles)
    before = flow.particles.x.values.copy()
    spent = advance(flow, 100.0)
    return _result("resting slab", flow, spent, {"moved [m]": np.abs(flow.particles.x.values - before).max()})


def sliding_cap(angle, depth, duration, count=500):
    """Return travel and speed along the slope [m, m s-1] of a cap, and its flow: on nodes of 10 m, from rest."""
    grid = grids.inclined((15, 60), 10.0, math.tan(angle))
    grids.release_cap(grid, (100.0, 70.0), (RADIUS, RADIUS), depth, on_top=True)
    flow = grids.place(DebrisFlow(grid, **grids.dry_block(MU, particle_count=count)))
    before, *_ = grids.centre_of_mass(flow)
    flow.run_one_step(duration - flow.elapsed_time)
    after, speed, _ = grids.centre_of_mass(flow)
    return (after - before) / math.cos(angle), speed / math.cos(angle), flow


def growing_cap(step):
    """Return travel, speed and growth of a cap that erodes after 20 s [m, m s-1, -], in calls of `step` [s].

    30 degrees, friction .21, growth 3e-3 per metre. Soil is everywhere; the body digs by E h = 3e-6 of the slope only.
    """
    angle = math.radians(30.0)
    grid = grids.inclined((15, 40), 20.0, math.tan(angle), soil=1.0)
    grids.release_cap(grid, (100.0, 140.0), (60.0, 60.0), 1e-3, on_top=True)
    keywords = grids.dry_block(0.21, {"law": "growth", "growth_rate": 3e-3}, particle_count=300)
    flow = grids.place(DebrisFlow(grid, **keywords))
    start, _, volume = grids.centre_of_mass(flow)
    for _ in range(round(20.0 / step)):
        flow.run_one_step(step)
    x, speed, grown = grids.centre_of_mass(flow)
    return np.array([(x - start) / math.cos(angle), speed / math.cos(angle), grown / volume])
