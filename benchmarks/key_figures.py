"""Balances, travel of bodies, and the demo in numbers: ``python -m benchmarks.key_figures`` from a checkout.

Balance of volume and of elevation; travel of a cap on planes and of an eroding block against their closed forms; CPU
time of the demo with a cold and a warm cache of kernels; its run-out against the number of particles and of levels.
Keeps benchmarks/results/key_figures.json, from which tables of docs/accuracy.md are written.
"""

import argparse
import math
import os
import resource
import subprocess
import sys
import tempfile

import numpy as np

from benchmarks import charts, result_files
from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.cli.demo import LEVELS, MATERIAL, measure
from landlab_debrisflow.exact import flows
from landlab_debrisflow.scene import tsing_shan_valley
from validation.cases.blocks import MU, growing_cap, sliding_cap

PARTICLES = 2000
DEMO = """
import sys
from pathlib import Path
from rich.console import Console
from landlab_debrisflow.cli.demo import run_demo
measures = run_demo(1500, Path(sys.argv[1]), Console(quiet=True))
print(sum(one["CPU time [s]"] for one in measures.values()))
"""


def cap_travel(degrees: float) -> float:
    """Return the relative error of the travel of a cap of 2 cm by 100 m in 8 s."""
    angle = math.radians(degrees)
    travel, _, _ = sliding_cap(angle, 0.02, 8.0, PARTICLES)
    return travel / float(flows.sliding_block(8.0, angle, MU)[1]) - 1.0


def balances() -> tuple[float, float]:
    """Return the relative residuals of volume and of elevation change over the demo's event."""
    grid = tsing_shan_valley()
    before = grid.at_node["topographic__elevation"].copy()
    flow = DebrisFlow(grid, numerics={"particle_count": 1500})
    flow.run_until_rest()
    b, size = flow.budget, flow.budget["released"] + flow.budget["eroded"]
    rise = float(np.sum(grid.at_node["topographic__elevation"] - before)) * grid.dx * grid.dy
    return b["residual"] / size, (rise - (b["deposited"] - b["released"] - b["eroded"])) / size


def demo_cpu():
    """Return CPU times of the demo, rows cold and warm (median of three): its two runs, its whole process [s]."""
    with tempfile.TemporaryDirectory() as folder:
        environment = os.environ | {"NUMBA_CACHE_DIR": os.path.join(folder, "cache")}
        times = []
        for _ in range(4):
            start = resource.getrusage(resource.RUSAGE_CHILDREN)
            command = [sys.executable, "-c", DEMO, folder]
            done = subprocess.run(command, env=environment, check=True, capture_output=True, text=True)
            end = resource.getrusage(resource.RUSAGE_CHILDREN)
            process = end.ru_utime + end.ru_stime - start.ru_utime - start.ru_stime
            times.append((float(done.stdout.split()[-1]), process))
    return times[0], np.median(times[1:], axis=0)


SLOPES = (20.0, 30.0, 45.0)
"""Of the planes on which the cap slides [deg]."""

COUNTS = (750, 1500, 3000, 6000)
"""Particles of the demo's runs with its own columns."""

COLUMNS = tuple(
    {"law": law, "levels": levels, "scheme": scheme}
    for law in ("ale", "classical")
    for scheme in ("default", "upwind")
    for levels in (11, 41, 161)
)
"""Columns of the demo's runs with 750 particles."""


def front(column, particles: int) -> float:
    """Return the run-out of the demo's front beyond the 100 m contour [m]."""
    flow = DebrisFlow(tsing_shan_valley(), column=column, material=MATERIAL, numerics={"particle_count": particles})
    before = flow.maps
    flow.run_until_rest()
    return float(measure(flow, before)["run-out of the front beyond the 100 m contour [m]"])


def main():
    argparse.ArgumentParser(description=__doc__.splitlines()[0]).parse_args()
    volume, rise = balances()
    speed, travel, ratio = flows.eroding_block(20.0, math.radians(30.0), 0.21, 3e-3)
    error = growing_cap(0.25) / np.array([travel, speed, ratio]) - 1.0
    cold, warm = demo_cpu()
    runs = [
        ({"law": law, "levels": LEVELS, "scheme": "default"}, count) for law in ("ale", "classical") for count in COUNTS
    ]
    runs += [(column, COUNTS[0]) for column in COLUMNS]
    data = {
        "balance of volume": volume, "balance of elevation": rise,
        "travel of a cap": [{"slope [deg]": slope, "error": cap_travel(slope)} for slope in SLOPES],
        "eroding block": dict(zip(("travel", "speed", "growth"), error, strict=True)),
        "CPU time of the demo [s]": [
            {"cache": word, "runs": times[0], "process": times[1]} for word, times in (("cold", cold), ("warm", warm))
        ],
        "front of the demo": [
            column | {"particles": particles, "front [m]": front(column, particles)} for column, particles in runs
        ],
    }  # fmt: skip
    result_files.keep("key_figures", data, "python -m benchmarks.key_figures")
    charts.make("key_figures")


if __name__ == "__main__":
    main()
