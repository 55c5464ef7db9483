"""Print the figures the README quotes: ``python -m benchmarks.figures`` from the root of a checkout.

Balance of volume and of elevation; travel of a cap on planes and of an eroding block against their closed
forms; CPU time of the demo with a cold and a warm cache of kernels, and its run-out against the number of
particles. The cases are those of the tests, with more
particles. S-1000 is measured by ``python examples/s1000.py``.
"""

import itertools
import math
import os
import resource
import subprocess
import sys
import tempfile

import numpy as np
from rich.console import Console
from rich.table import Table

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


def fronts(columns, counts=(750,)) -> str:
    """Return the run-out of the demo's front beyond the 100 m contour, for columns and numbers of particles [m]."""
    found = []
    for column, particles in itertools.product(columns, counts):
        flow = DebrisFlow(tsing_shan_valley(), column=column, material=MATERIAL, numerics={"particle_count": particles})
        before = flow.maps
        flow.run_until_rest()
        found.append(measure(flow, before)["run-out of the front beyond the 100 m contour [m]"])
    return " ".join(f"{one:.0f}" for one in found)


def main():
    table = Table(title="Figures", title_justify="left")
    for heading in ("what", "measured", "to reach"):
        table.add_column(heading)
    volume, rise = balances()
    table.add_row("balance of volume over the demo's event, relative", f"{volume:.1e}", "1e-12")
    table.add_row("sum of elevation change against the balance, relative", f"{rise:.1e}", "1e-12")
    for degrees in (20.0, 30.0, 45.0):
        words = f"travel of a cap of {PARTICLES} particles on {degrees:g} deg, relative error"
        table.add_row(words, f"{cap_travel(degrees):.1e}", "1e-3")
    speed, travel, ratio = flows.eroding_block(20.0, math.radians(30.0), 0.21, 3e-3)
    error = growing_cap(0.25) / np.array([travel, speed, ratio]) - 1.0
    table.add_row("Hungr block at 20 s, relative error of x, v, h/h0", " ".join(f"{e:.1e}" for e in error), "1e-4")
    cold, warm = demo_cpu()
    for word, (runs, process), most in (("a cold", cold, 20), ("a warm", warm, 5)):
        words = f"CPU of the demo's two runs with {word} cache (of the whole process) [s]"
        table.add_row(words, f"{runs:.1f} ({process:.1f})", f"{most}")
    for column in ("ale", "classical"):
        words = f"front of the demo's {column} run with 750, 1500, 3000, 6000 particles [m]"
        columns = [{"law": column, "levels": LEVELS}]
        table.add_row(words, fronts(columns, (750, 1500, 3000, 6000)), "spread 5")
        for scheme in ("default", "upwind"):
            finer = [{"law": column, "levels": levels, "scheme": scheme} for levels in (11, 41, 161)]
            table.add_row(f"the same, 750 particles, {scheme} scheme, 11, 41, 161 levels", fronts(finer), "no spread")
    Console().print(table)


if __name__ == "__main__":
    main()
