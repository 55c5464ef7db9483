"""What maps written as a run goes cost: python -m benchmarks.looks [--repeats N] [--particles N] [--duration S]

An eroding flow of 1e5 m3 on 1000 x 1000 nodes of 5 m goes down a valley for 600 s: alone; with an observer that does
nothing 100 times, for which the border writes the present into the fields and takes it back; and with a `MapSeries` of
100 maps. Each run is a process of its own, in turns. CPU time is that of the call (user and system), medians; memory is
the largest resident size of the process. At last all maps are put into one file, in another process.
"""

import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from landlab import RasterModelGrid
from rich.console import Console
from rich.table import Table

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.record import MapSeries, combine_maps

NODES, SPACING, VOLUME, LOOKS = 1000, 5.0, 1e5, 100
KINDS = "alone", "an observer that does nothing", "a series of maps"


class Idle:
    """Observer that does nothing."""

    def __init__(self, interval):
        self.interval = interval

    def observe(self, flow):
        """Do nothing."""


def valley(particles, observers):
    """Return a flow in a valley that falls by 0.15 to 0.4 over its length."""
    grid = RasterModelGrid((NODES, NODES), xy_spacing=SPACING)
    x, y = grid.x_of_node, grid.y_of_node - 0.5 * NODES * SPACING
    fall = 1.0 - x / (NODES * SPACING)
    grid.add_field("topographic__elevation", NODES * SPACING * (0.15 * fall + 0.12 * fall**2) + 0.1 * abs(y), at="node")
    grid.add_full("soil__depth", 6.0, at="node")
    cap = np.maximum(0.0, 1.0 - ((x - 300.0) ** 2 + y**2) / 120.0**2)
    grid.add_field("debris_flow__release_depth", cap * VOLUME / (cap.sum() * SPACING**2), at="node")
    friction = {"law": "voellmy", "basal_friction_angle": 8.0, "turbulent_coefficient": 60.0}
    numerics = {"particle_count": particles, "settle": False}
    erosion = {"law": "growth", "growth_rate": 2e-4}
    return DebrisFlow(grid, friction=friction, erosion=erosion, numerics=numerics, observers=observers)


def child(kind, particles, duration, directory):
    """Run one kind and print CPU time [s], largest memory [bytes], maps, steps and how long it moved [s]."""
    if kind == "combine":
        begin = time.process_time()
        path = combine_maps(directory, Path(directory) / "all.nc")
        found = {"cpu": time.process_time() - begin, "size": path.stat().st_size}
    else:
        valley(50, ()).run_one_step(1.0)  # kernels are loaded
        interval = duration / LOOKS
        observers = {KINDS[0]: (), KINDS[1]: Idle(interval)}.get(kind)
        observers = MapSeries(interval, directory, replace=True) if observers is None else observers
        flow = valley(particles, observers)
        begin = time.process_time()
        flow.run_one_step(duration)
        found = {"cpu": time.process_time() - begin, "steps": flow.diagnostics.steps, "at_rest": flow.at_rest}
        found |= {"eroded": flow.budget["eroded"], "outflow": flow.budget["outflow"]}
        if kind == KINDS[2]:
            found |= {"maps": len(observers.files), "size": sum(path.stat().st_size for path in observers.files)}
    print(json.dumps(found | {"memory": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024}))


def measure(kind, particles, duration, directory):
    """Return what a run in a process of its own printed."""
    command = [sys.executable, "-m", "benchmarks.looks", "--child", kind, "--directory", directory]
    command += ["--particles", str(particles), "--duration", str(duration)]
    return json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE, env=os.environ).stdout)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--particles", type=int, default=5000)
    parser.add_argument("--duration", type=float, default=600.0)
    parser.add_argument("--child")
    parser.add_argument("--directory")
    given = parser.parse_args()
    if given.child:
        child(given.child, given.particles, given.duration, given.directory)
        return
    runs = {kind: [] for kind in KINDS}
    with tempfile.TemporaryDirectory() as directory:
        for _ in range(given.repeats):
            for kind in KINDS:
                runs[kind].append(measure(kind, given.particles, given.duration, directory))
        combined = measure("combine", given.particles, given.duration, directory)
    table = Table(title=f"{given.particles} particles, {NODES} x {NODES} nodes, {given.duration:g} s, {LOOKS} looks")
    for words in ("", "CPU [s]", "per look [ms]", "of the run [%]", "memory [MB]", "beside the run [MB]"):
        table.add_column(words, justify="right" if words else "left")
    cpu, memory = ({kind: statistics.median(run[name] for run in runs[kind]) for kind in KINDS}
                   for name in ("cpu", "memory"))  # fmt: skip
    for kind in KINDS:
        more, beside = cpu[kind] - cpu[KINDS[0]], (memory[kind] - memory[KINDS[0]]) / 1e6
        share = f"{100.0 * more / cpu[KINDS[0]]:.1f}"
        table.add_row(kind, f"{cpu[kind]:.2f}", f"{1000.0 * more / LOOKS:.1f}", share, f"{memory[kind] / 1e6:.0f}",
                      f"{beside:.0f}")  # fmt: skip
    console, last = Console(width=120), runs[KINDS[2]][-1]
    console.print(table)
    console.print(
        f"{last['steps']} steps, {last['maps']} maps of {last['size'] / 1e6:.1f} MB in all, eroded "
        f"{last['eroded']:.0f} m3, outflow {last['outflow']:.0f} m3, at rest: {last['at_rest']}"
    )
    console.print(f"combine_maps: {combined['cpu']:.2f} s of CPU, {combined['size'] / 1e6:.1f} MB, memory "
                  f"{combined['memory'] / 1e6:.0f} MB")  # fmt: skip


if __name__ == "__main__":
    main()
