"""Compare the cost of this checkout with that of an installed copy: ``python -m benchmarks.against PYTHON``.

PYTHON is the interpreter of an environment in which another version of the package is installed. Both run the same
scenes in turn, in processes of their own with warm caches of kernels, because one machine is not as fast from one hour
to the next. Printed are medians of CPU time and of the ratio of each pair, with its quartiles; below 1 this checkout is
faster.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table

SCENES = """
import json, logging, sys, time
from pathlib import Path
import numpy as np
from landlab import RasterModelGrid
from rich.console import Console
from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.demo import run_demo

logging.getLogger("landlab_debrisflow").setLevel(logging.ERROR)

def gully(particles, radius=20.0, **keywords):
    grid = RasterModelGrid((61, 161), xy_spacing=5.0)
    x, y = grid.x_of_node, grid.y_of_node
    grid.add_field("topographic__elevation", np.maximum(0.0, 0.5 * (500.0 - x)) + 0.1 * abs(y - 150.0), at="node")
    grid.add_full("soil__depth", 2.0, at="node")
    grid.add_field("debris_flow__release_depth", 1.5 * (np.hypot(x - 60.0, y - 150.0) < radius), at="node")
    return DebrisFlow(grid, friction="voellmy", numerics={"particle_count": particles}, **keywords)

def step(flow, duration):
    flow.run_one_step(0.01)  # what is found and built once
    before, cpu = flow._simulation._steps, time.process_time()
    flow.run_one_step(duration)
    return (time.process_time() - cpu) / (flow._simulation._steps - before)

def event(flow):
    cpu = time.process_time()
    flow.run_until_rest(60.0)
    return time.process_time() - cpu

found = {
    "step, 300 particles": lambda: step(gully(300), 30.0),
    "step, 1500 particles": lambda: step(gully(1500), 20.0),
    "step, 6000 particles": lambda: step(gully(6000), 8.0),
    "step, two phases of 600 particles": lambda: step(gully(600, flow="two_phase"), 10.0),
    "event of 60 s, 800 particles": lambda: event(gully(800)),
    "the demo's two runs": lambda: sum(
        one["CPU time [s]"] for one in run_demo(1500, Path(sys.argv[1]), Console(quiet=True)).values()
    ),
}
print(json.dumps({name: scene() for name, scene in found.items()}))
"""


def measure(python, folder: Path, path: str) -> dict[str, float]:
    """Return the CPU time of every scene under some interpreter [s]; `path` is put before its own packages."""
    environment = os.environ | {"NUMBA_CACHE_DIR": str(folder / "cache"), "PYTHONPATH": path, "MPLBACKEND": "Agg"}
    run = subprocess.run(
        [python, "-c", SCENES, str(folder)], cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    if run.returncode:
        raise SystemExit(f"{python} could not run the scenes:\n{run.stderr}")
    return json.loads(run.stdout.splitlines()[-1])


def main() -> None:
    """Measure in turn, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("python", help="interpreter of an environment with another version of the package")
    parser.add_argument("--pairs", type=int, default=15, help="how often both are measured")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as other:
        sides = (sys.executable, Path(one), str(Path(__file__).parents[1])), (arguments.python, Path(other), "")
        for side in sides:
            measure(*side)  # compiles
        pairs = []
        for k in range(arguments.pairs):
            order = sides if k % 2 == 0 else sides[::-1]
            times = [measure(*side) for side in order]
            pairs.append(times if k % 2 == 0 else times[::-1])
    table = Table(title=f"CPU time, medians of {arguments.pairs} pairs", title_justify="left")
    for column in ("", "here [ms]", "there [ms]", "ratio", "quartiles"):
        table.add_column(column, justify="left" if not column else "right")
    for name in pairs[0][0]:
        here, there = (np.array([pair[side][name] for pair in pairs]) for side in (0, 1))
        low, middle, high = np.quantile(here / there, [0.25, 0.5, 0.75])
        table.add_row(
            name, f"{1e3 * np.median(here):.3g}", f"{1e3 * np.median(there):.3g}", f"{middle:.3f}",
            f"{low:.3f} to {high:.3f}",
        )  # fmt: skip
    Console(width=120).print(table)


if __name__ == "__main__":
    main()
