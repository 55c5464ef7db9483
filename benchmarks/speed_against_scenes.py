"""Scenes that speed_against.py times, as a program of its own that either version runs: ``python -P
speed_against_scenes.py``.

Reads names of scenes from its input, one a line, and answers each with the CPU time that one run of it takes [s].
Uses the public interface only, because everything else has other names in another version. So a stage is not timed by
itself but by a scene in which it takes most of the time; what a scene does not use is switched off.
"""

import logging
import sys
import time
from collections.abc import Callable
from functools import partial

import numpy as np
from landlab import RasterModelGrid

from landlab_debrisflow import DebrisFlow, solve_column

BARE = {"erosion": "none", "column": "none", "friction": "coulomb"}
PLACED = 0.01
"""How long the first call runs, which places the release and is not timed [s]."""


def gully(particles, radius=20.0, **keywords):
    """Return a flow down a gully, on nodes of 5 m."""
    grid = RasterModelGrid((61, 161), xy_spacing=5.0)
    x, y = grid.x_of_node, grid.y_of_node
    grid.add_field("topographic__elevation", np.maximum(0.0, 0.5 * (500.0 - x)) + 0.1 * abs(y - 150.0), at="node")
    grid.add_full("soil__depth", 2.0, at="node")
    grid.add_field("debris_flow__release_depth", 1.5 * (np.hypot(x - 60.0, y - 150.0) < radius), at="node")
    return DebrisFlow(grid, **{"friction": "voellmy", "numerics": {"particle_count": particles}} | keywords)


def timed(work: Callable, *arguments) -> float:
    begin = time.process_time()
    work(*arguments)
    return time.process_time() - begin


def steps(particles, duration, **keywords) -> float:
    """Time a call in which a release that has been placed moves."""
    flow = gully(particles, **keywords)
    flow.run_one_step(PLACED)
    return timed(flow.run_one_step, duration)


def a_step(particles, **keywords) -> float:
    """Time one of the steps of a second, two seconds after the release: all that a call does, over its steps."""
    flow = gully(particles, **keywords)
    flow.run_one_step(2.0)
    before = flow.diagnostics.steps
    return timed(flow.run_one_step, 1.0) / (flow.diagnostics.steps - before)


def placing(particles) -> float:
    return timed(gully(particles, **BARE).run_one_step, 1e-9)


def event(particles, **keywords) -> float:
    return timed(gully(particles, **keywords).run_until_rest, 60.0)


def both_columns(particles) -> float:
    """Time what the demo does: the same event with either column, at as many levels."""
    material = {"initial_pressure_profile": "basal_layer"}
    laws = ({"law": name, "levels": 41} for name in ("ale", "classical"))
    return sum(event(particles, column=law, material=material) for law in laws)


def calls(particles, count) -> float:
    """Time calls of a step or so: reading, checking and writing the grid."""
    flow = gully(particles)
    flow.run_one_step(5.0)
    return timed(lambda: [flow.run_one_step(0.02) for _ in range(count)])


def looks(particles, count) -> float:
    """Time what a flow shows."""
    flow = gully(particles)
    flow.run_one_step(5.0)
    return timed(lambda: [(flow.maps, flow.particles, flow.columns, flow.budget) for _ in range(count)])


def inflow(duration) -> float:
    surge = {
        "line_start": (100.0, 130.0), "line_end": (100.0, 170.0), "times": [0.0, 60.0], "discharge": 80.0,
        "velocity": 4.0,
    }  # fmt: skip
    return steps(800, duration, inflow=surge)


def columns(count, seconds, **arguments) -> float:
    """Time columns by themselves, brought forward together."""
    given = {
        "thickness": np.linspace(0.5, 3.0, count), "loading": 9810.0, "coefficient_of_consolidation": 4e-4,
        "initial": "linear", "basal_pressure": 3e3, "times": [seconds], "step": 0.05,
    }  # fmt: skip
    return timed(partial(solve_column, **given | arguments))


ERODING = {"entrainment_rate": 0.02}
CLOSED = {"base": "impermeable", "divergence_rate": lambda t: 0.01 * np.sin(t), "entrainment_rate": 0.0}
SCENES = {
    "placing of 9000 particles": partial(placing, 9000),
    "sums: steps of 6000, no column, no erosion": partial(steps, 6000, 6.0, **BARE),
    "steps of 300 particles": partial(steps, 300, 60.0),
    "steps of 1500": partial(steps, 1500, 20.0),
    "steps of 6000": partial(steps, 6000, 5.0),
    "two phases of 600": partial(steps, 600, 20.0, flow="two_phase"),
    "a step of 10000 in one phase": partial(a_step, 10000),
    "a step of 10000 in each of two phases": partial(a_step, 10000, flow="two_phase"),
    "event of 60 s, 800 particles": partial(event, 800),
    "either column, 41 levels, 60 s, 800": partial(both_columns, 800),
    "inflow": partial(inflow, 30.0),
    "loaded bed": partial(steps, 1500, 18.0, material={"bed_loading_coefficient": 0.6, "bed_drainage_time": 120.0}),
    "bingham": partial(steps, 1500, 18.0, **BARE | {"friction": "bingham"}),
    "herschel_bulkley": partial(steps, 1500, 18.0, **BARE | {"friction": "herschel_bulkley"}),
    "mu_i": partial(steps, 1500, 18.0, **BARE | {"friction": "mu_i"}),
    "liquefied_bed, classical": partial(steps, 1500, 12.0, erosion="liquefied_bed", column="classical"),
    "120 short calls": partial(calls, 800, 120),
    "60 looks at all that is shown": partial(looks, 1500, 60),
    "2000 columns, eroding": partial(columns, 2000, 120.0, **ERODING),
    "2000 columns, closed, loaded": partial(columns, 2000, 120.0, **CLOSED),
    "2000 columns, every step": partial(columns, 2000, 60.0, advance="every_step", **ERODING),
    "2000 columns, lax_wendroff": partial(columns, 2000, 60.0, scheme="lax_wendroff", **ERODING),
    "2000 columns, upwind": partial(columns, 2000, 60.0, scheme="upwind", **ERODING),
}


def main() -> None:
    logging.getLogger("landlab_debrisflow").setLevel(logging.ERROR)
    for line in sys.stdin:
        print(SCENES[line.strip()](), flush=True)


if __name__ == "__main__":
    main()
