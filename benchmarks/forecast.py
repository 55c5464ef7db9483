"""Compare forecasts of runs with what the runs took: duration, steps, wall time, and the end that a monitor expects.

    DEBRISFLOW_DATA=... python -m benchmarks.forecast > benchmarks/forecast.txt

A factor is that of the forecast over what it was. The CPU time of a run is that of its steps. An end that is seen, by
the monitor at a quarter, half and three quarters of the wall time, is over that of the run; "<=": a bound. Without
DEBRISFLOW_DATA the scene of S-1000 is left out.
"""

import argparse
import os
import tempfile
from pathlib import Path
from time import perf_counter, process_time

import numpy as np
from rich.console import Console
from rich.table import Table

from landlab_debrisflow import Scene
from landlab_debrisflow.record import Monitor
from landlab_debrisflow.run.forecast import forecast
from landlab_debrisflow.run.runner import run_scene
from landlab_debrisflow.scene.read_yaml import read_yaml

EXAMPLES = Path(__file__).parents[1] / "examples" / "scenes"
OUTLINE = [[400020, 5200145], [400050, 5200145], [400050, 5200170], [400020, 5200170]]
GULLY = {
    "terrain": {"example": "gully", "soil_depth": 2.0}, "release": {"polygons": OUTLINE, "depth": 1.5},
    "output": {"max_duration": 600.0},
}  # fmt: skip
QUARTERS = (0.25, 0.5, 0.75)


class Expecting(Monitor):
    """Monitor that keeps the ends that it expects."""

    def __init__(self):
        super().__init__(live=False)
        self.ends, self.clock = [], []

    def follow(self, particles, began, time):
        before = self.line
        self.clock.append(process_time())
        super().follow(particles, began, time)
        left = self._estimate.remaining()
        if self.line != before and left is not None:
            self.ends.append((perf_counter(), left))


def cases(data: str | None):
    """Yield name, mapping and folder of the scenes."""
    for count in (300, 2000, 8000):
        yield f"gully, {count} particles", GULLY | {"numerics": {"particle_count": count}}, Path()
    two = {"flow": {"law": "two_phase"}, "numerics": {"particle_count": 1000}}
    yield "gully, two phases", GULLY | two, Path()
    classical = {"column": "classical", "friction": {"law": "coulomb"}, "numerics": {"particle_count": 2000}}
    yield "gully, classical column", GULLY | classical, Path()
    for path in sorted(EXAMPLES.glob("*.yaml")):
        if path.stem == "s1000":
            if data:
                for count in (1000, 4000):
                    mapping = read_yaml(path).mapping
                    yield (
                        f"S-1000, {count} particles",
                        mapping | {"numerics": {"particle_count": count}},
                        Path(data, "s1000"),
                    )
        else:
            yield f"example {path.stem}", read_yaml(path).mapping, EXAMPLES


def measure(mapping, folder: Path):
    """Return the forecast of a scene, its own wall time [s], and record, wall time [s] and monitor of its run."""
    scene = Scene.from_mapping(mapping, folder)
    began = perf_counter()
    expected = forecast(scene)
    own = perf_counter() - began
    with tempfile.TemporaryDirectory() as name:
        output = dict(mapping.get("output") or {}) | {"directory": str(Path(name, "out"))}
        monitor, began = Expecting(), perf_counter()
        results = run_scene(Scene.from_mapping(mapping | {"output": output}, folder), monitor=monitor)
        return expected, own, results.record, perf_counter() - began, monitor, began


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", help="word in the names of the scenes to run")
    options = parser.parse_args()
    console = Console(width=150)
    console.print(f"load of the machine before: {os.getloadavg()[0]:.1f}, cores: {os.cpu_count()}")
    forecast(Scene.from_mapping(GULLY | {"numerics": {"particle_count": 100}}))  # loads kernels
    table = Table(title="forecast / run", title_justify="left")
    heads = ("scene", "duration [s]", "factor", "steps", "factor", "CPU [s]", "factor", "check took [s]")
    for head in (*heads, *(f"end seen at {100 * part:.0f} %" for part in QUARTERS)):
        table.add_column(head, justify="left" if head == "scene" else "right")
    factors = []
    for name, mapping, folder in cases(os.environ.get("DEBRISFLOW_DATA")):
        if options.only not in name:
            continue
        expected, own, record, wall, monitor, began = measure(mapping, folder)
        pairs = (
            (expected.duration, record.elapsed_time),
            (expected.steps, record.steps),
            (expected.seconds, monitor.clock[-1] - monitor.clock[0]),
        )
        cells = [cell for one, other in pairs for cell in (f"{other:.0f}", f"{one / other:.2f}")]
        factors.append([one / other for one, other in pairs])
        seen = []
        for part in QUARTERS:
            ends = [(at - began + left.seconds, left.bound) for at, left in monitor.ends if at - began <= part * wall]
            seen.append(f"{'<= ' if ends[-1][1] else ''}{ends[-1][0] / wall:.2f}" if ends else "-")
        table.add_row(name, *cells, f"{own:.1f}", *seen)
    console.print(table)
    if factors:
        worst = np.exp(np.abs(np.log(factors)).max(axis=0))
        middle = np.exp(np.median(np.abs(np.log(factors)), axis=0))
        for word, one, other in zip(("duration", "steps", "CPU time"), middle, worst, strict=True):
            console.print(f"{word}: within a factor of {one:.2f} in half of the scenes, {other:.2f} in all")
    console.print(f"load of the machine after: {os.getloadavg()[0]:.1f}")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
