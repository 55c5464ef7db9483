"""Scenes that ratios.py measures, as a program of its own that any version runs: ``python -P ratio_scenes.py FOLDER``.

Reads requests from its input, one a line: a JSON list of the name of a function of `SCENES` and its keywords; answers
each with a JSON mapping of what one run took and found. FOLDER has the grounds that another process has written, so
that all versions run on the same ones (ratios.write_grounds).

Laws, loading, material and numerics are written out: no default of one version enters. Only the public interface is
used, but for `counted`, which counts steps and times the sums over neighbours where the version has them.
"""

import gc
import importlib
import json
import logging
import math
import sys
import time
import tracemalloc
from contextlib import ExitStack, contextmanager
from dataclasses import fields
from pathlib import Path
from unittest import mock

import numpy as np
from landlab import RasterModelGrid

from landlab_debrisflow import DebrisFlow, Numerics

FRICTION_ANGLE = math.degrees(math.atan(0.6))
COULOMB = {
    "law": "coulomb", "basal_friction_angle": FRICTION_ANGLE, "cohesion": 0.0, "viscosity": 0.0,
    "velocity_profile": "linear",
}  # fmt: skip
VOELLMY = {"law": "voellmy", "basal_friction_angle": FRICTION_ANGLE, "cohesion": 0.0, "turbulent_coefficient": 500.0}
ALE = {
    "law": "ale", "levels": 11, "loading_source": "overburden", "scheme": "default", "bed_contact": "dirichlet",
    "tolerance": 3e-3, "source_includes_erosion": False,
}  # fmt: skip
MATERIAL = {
    "solid_density": 2650.0, "water_density": 1000.0, "porosity": 0.4, "bed_porosity": 0.4, "water_table_ratio": 1.0,
    "basal_slip_ratio": 0.0, "coefficient_of_consolidation": 4e-4, "bed_pressure_ratio": 0.65,
    "bed_loading_coefficient": 0.0, "initial_pressure_ratio": 0.65, "initial_pressure_profile": "basal_layer",
    "basal_layer_fraction": 0.1, "gravity": 9.81,
}  # fmt: skip
TWO_PHASE = {"law": "two_phase", "drag": "darcy", "stiffness": 2.5e5, "manning_coefficient": 0.0}
NUMERICS = {
    "threads": 1, "settle": True, "courant_number": 0.6, "advective_courant_number": 0.5, "shock_viscosity": 1.0,
    "rest_energy": 1e-4, "arrival_depth": 0.01,
}  # fmt: skip
PLACED = 1e-9
"""How long the first call runs, which places the release and is not timed [s]."""

SUMS = (
    ("landlab_debrisflow.model.step", "sort_into_cells"),
    ("landlab_debrisflow.physics.flow.one_phase", "sum_over_neighbours"),
)
"""Modules and the names in them whose time is that of density and force, in all versions; not all have all."""


class Count:
    """Lengths of steps, CPU times at their ends, and CPU time in sums [s]; particles advanced in all steps."""

    def __init__(self):
        self.lengths, self.ends, self.particle_steps, self.sums = [], [], 0, 0.0

    @property
    def steps(self) -> int:
        """Number of steps."""
        return len(self.lengths)

    @property
    def between(self) -> float:
        """CPU time of a step after the first, without what a call costs once [s]."""
        return (self.ends[-1] - self.ends[0]) / (self.steps - 1) if self.steps > 1 else math.nan


@contextmanager
def counted():
    """Count the steps inside the block; yields a `Count`."""
    found, step = Count(), importlib.import_module("landlab_debrisflow.model.step")
    advance = step.advance

    def one_step(simulation, dt):
        advance(simulation, dt)
        found.lengths.append(dt)
        found.ends.append(time.process_time())
        found.particle_steps += simulation.particles.awake

    def timed(original):
        def sums(*arguments, **keywords):
            begin = time.process_time()
            try:
                return original(*arguments, **keywords)
            finally:
                found.sums += time.process_time() - begin

        return sums

    with ExitStack() as stack:
        stack.enter_context(mock.patch.object(step, "advance", one_step))
        for place, name in SUMS:
            module = importlib.import_module(place)
            if hasattr(module, name):
                stack.enter_context(mock.patch.object(module, name, timed(getattr(module, name))))
        yield found


def measured(work, *arguments) -> dict[str, float]:
    """Run something; return CPU and wall time [s], steps and particle steps."""
    with counted() as count:
        wall, cpu = time.perf_counter(), time.process_time()
        work(*arguments)
        cpu, wall = time.process_time() - cpu, time.perf_counter() - wall
    found = {name: getattr(count, name) for name in ("steps", "particle_steps", "sums", "between")}
    return {"cpu": cpu, "wall": wall} | found


# ---- flows ----


def grid_of(name: str) -> RasterModelGrid:
    """Return one of the grounds of the folder."""
    with np.load(Path(sys.argv[1]) / f"{name}.npz") as kept:
        grid = RasterModelGrid(
            tuple(kept["shape"]), xy_spacing=tuple(kept["spacing"]), xy_of_lower_left=tuple(kept["corner"])
        )
        grid.status_at_node = kept["status"]
        for field in ("topographic__elevation", "soil__depth", "debris_flow__release_depth"):
            grid.add_field(field, kept[field], at="node")
    return grid


def flow_on(grid, *, count, erosion, numerics=None, **keywords) -> DebrisFlow:
    """Return a flow with all of its numbers; `erosion` is the growth rate [m-1]."""
    known = {field.name for field in fields(Numerics)}
    chosen = NUMERICS | {"particle_count": count} | (numerics or {})
    return DebrisFlow(
        grid,
        **{"flow": "one_phase", "friction": COULOMB, "column": ALE, "material": MATERIAL} | keywords,
        erosion={"law": "growth", "growth_rate": erosion} if erosion else "none",
        numerics={name: value for name, value in chosen.items() if name in known},
    )


def cap_of(count, threads=1) -> DebrisFlow:
    """Return the cap of the similarity solution, placed: 35 degrees, friction 25, 80 m by 4 m, dry, on nodes of 2 m."""
    angle = math.radians(35.0)
    cos = math.cos(angle)
    grid = RasterModelGrid((111, 146), xy_spacing=(2.0 * cos, 2.0), xy_of_lower_left=(-110.0 * cos, -110.0))
    s, y = grid.x_of_node / cos, grid.y_of_node
    depth = 4.0 * np.maximum(0.0, 1.0 - (s**2 + y**2) / 6400.0) / cos
    grid.add_field("topographic__elevation", -math.tan(angle) * grid.x_of_node + depth, at="node")
    grid.add_field("debris_flow__release_depth", depth, at="node")
    flow = flow_on(
        grid, count=count, erosion=0.0, column="none", friction=COULOMB | {"basal_friction_angle": 25.0},
        material=MATERIAL | {"water_density": 0.0}, numerics={"settle": False, "threads": threads},
    )  # fmt: skip
    flow.run_one_step(PLACED)
    return flow


VALLEY = {"erosion": 3e-3}
"""Keywords of `flow_on` in the valley."""


def valley_of(count, **keywords) -> DebrisFlow:
    """Return the stand-in for Tsing Shan."""
    return flow_on(grid_of("valley"), count=count, **VALLEY | keywords)


# ---- scenes ----


def cap(count, duration, threads=1):
    """Measure steps of the cap: sums, kicks and drift, no column and no erosion."""
    return measured(cap_of(count, threads).run_one_step, duration)


def valley(count, duration, threads=1):
    """Measure steps of the valley, release placed: erosion and columns, too."""
    flow = valley_of(count, numerics={"threads": threads})
    flow.run_one_step(PLACED)
    return measured(flow.run_one_step, duration)


def fixed(duration, counts=(50, 100, 200, 400, 800)):
    """Measure the CPU time of a step of the valley without particles: the line through some numbers of them.

    What a call costs once is left out.
    """
    awake, cost = [], []
    for count in counts:
        found = valley(count, duration)
        awake.append(found["particle_steps"] / found["steps"])
        cost.append(found["between"])
    slope, start = np.polyfit(awake, cost, 1)
    return {"start": float(start), "slope": float(slope)}


def to_rest(count, shorter=1):
    """Measure the event in the valley, placing and settling included, in steps `shorter` so many times."""
    numerics = {name: NUMERICS[name] / shorter for name in ("courant_number", "advective_courant_number")}
    return event(valley_of(count, numerics=numerics))


def s1000(friction, counts):
    """Measure S-1000 to rest with some numbers of particles one after the other: lists of times and findings."""
    law = {"voellmy": VOELLMY, "coulomb": COULOMB}[friction]
    pressure = {"bed_pressure_ratio": 0.3, "initial_pressure_ratio": 0.3, "initial_pressure_profile": "linear"}
    runs = [
        event(flow_on(grid_of("s1000"), count=count, erosion=1e-3, friction=law, material=MATERIAL | pressure))
        for count in counts
    ]
    return {name: [run[name] for run in runs] for name in runs[0]}


def event(flow) -> dict[str, float]:
    """Measure an event to rest: cost, end [s], eroded volume [m3], and the distance from the top of the release of 99 %
    of the deposit and of its centre of mass [m].
    """
    grid = flow.grid
    failing = np.flatnonzero(grid.at_node["debris_flow__release_depth"])
    top = failing[grid.at_node["topographic__elevation"][failing].argmax()]
    found = measured(flow.run_until_rest)
    distance = np.hypot(grid.x_of_node - grid.x_of_node[top], grid.y_of_node - grid.y_of_node[top])
    order = np.argsort(distance)
    deposit = grid.at_node["debris_flow__deposit_depth"][order]
    behind = np.cumsum(deposit)
    front = distance[order][np.searchsorted(behind, 0.99 * behind[-1])]
    centre = np.average(distance[order], weights=deposit)
    return found | {
        "end": flow.elapsed_time, "run_out": float(front), "centre": float(centre),
        "eroded": float(flow.budget["eroded"]),
    }  # fmt: skip


def phases(count, begin, duration):
    """Measure a step of two phases of as many particles each, and of one: CPU times of a step and their ratio."""
    cost = {}
    for name, law in (("one", "one_phase"), ("two", TWO_PHASE)):
        flow = valley_of(count, flow=law, numerics={"settle": False})
        flow.run_one_step(begin)
        found = measured(flow.run_one_step, duration)
        cost[name] = found["cpu"] / found["steps"]
    return cost | {"ratio": cost["two"] / cost["one"]}


def memory(side):
    """Measure bytes per node that a component holds on a square raster: when made, after a call, and of the latter what
    is not fields of the grid.
    """
    held = {}
    for nodes in (40, side):  # the first loads the kernels
        grid = RasterModelGrid((nodes, nodes), xy_spacing=5.0)
        x, y = grid.x_of_node, grid.y_of_node
        near = np.hypot(x - 2.5 * nodes, y - 2.5 * nodes) < 20.0
        grid.add_field("topographic__elevation", 0.5 * (5.0 * nodes - x), at="node")
        grid.add_full("soil__depth", 2.0, at="node")
        grid.add_field("debris_flow__release_depth", 1.5 * near, at="node")
        gc.collect()
        given = set(grid.at_node)
        tracemalloc.start()
        flow = flow_on(grid, count=1500, erosion=3e-3, friction=VOELLMY)
        held["made"] = tracemalloc.get_traced_memory()[0] / nodes**2
        flow.run_one_step(5.0)
        gc.collect()
        held["called"] = tracemalloc.get_traced_memory()[0] / nodes**2
        held["own"] = held["called"] - sum(grid.at_node[name].nbytes for name in set(grid.at_node) - given) / nodes**2
        tracemalloc.stop()
    return held


SCENES = {one.__name__: one for one in (cap, valley, fixed, to_rest, s1000, phases, memory)}


def answer(scenes) -> None:
    """Answer requests for some functions by name."""
    for line in sys.stdin:
        name, keywords = json.loads(line)
        print(json.dumps(scenes[name](**keywords)), flush=True)


if __name__ == "__main__":
    logging.getLogger("landlab_debrisflow").setLevel(logging.ERROR)
    answer(SCENES)
