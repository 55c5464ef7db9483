"""A run that can be killed: starts, or goes on from its checkpoint, and writes digests of all that it ends with.

python -m benchmarks.kill_child FOLDER
"""

import hashlib
import json
import sys
from pathlib import Path

import numpy as np
from landlab import RasterModelGrid

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.record import Checkpoints, MapSeries, Series, Snapshots, write_atomically

CHECKPOINT, RESULT, MAPS = "event.nc", "result.json", "maps"
INTERVAL = 0.15
"""Wall time between checkpoints [s]."""

TIMES = np.arange(0.5, 40.0, 0.5)
"""When the flow is measured [s]."""


def valley() -> RasterModelGrid:
    """Return rough ground of which 2000 m3 are about to fail, above a foot with walls."""
    grid, rng = RasterModelGrid((60, 140), xy_spacing=5.0), np.random.default_rng(15)
    x, y = grid.x_of_node, grid.y_of_node
    z = 0.45 * np.maximum(0.0, 450.0 - x) + 0.1 * abs(y - 150.0) + rng.normal(0.0, 0.05, x.size)
    grid.add_field("topographic__elevation", z, at="node")
    grid.add_full("soil__depth", 3.0, at="node")
    near = np.hypot(x - 80.0, y - 150.0) < 18.0
    grid.add_field("debris_flow__release_depth", np.where(near, 2.0, 0.0), at="node")
    grid.status_at_node[(abs(x - 500.0) < 8.0) & (abs(y - 130.0) < 18.0)] = grid.BC_NODE_IS_CLOSED
    return grid


def measured(flow) -> dict:
    """Return volumes and how far the flow is [m3, m]."""
    return {"eroded": flow.budget["eroded"], "farthest": flow.particles.x.values.max(initial=0.0)}


def digest(dataset) -> str:
    """Return a digest of all numbers of a Dataset, and of its attributes but the date."""
    found = hashlib.blake2b(digest_size=16)
    for name in sorted(dataset.variables):
        found.update(name.encode() + np.ascontiguousarray(dataset[name].values).tobytes())
    found.update(repr(sorted((k, str(v)) for k, v in dataset.attrs.items() if k != "date_created")).encode())
    return found.hexdigest()


def result(flow, snapshots, series, folder: Path) -> dict:
    """Return digests of fields, particles, columns, budget, counters and outputs."""
    fields = {name: hashlib.blake2b(values.tobytes()).hexdigest() for name, values in flow.grid.at_node.items()}
    files = sorted((folder / MAPS).iterdir())
    found = {"particles": flow.particles, "columns": flow.columns, "maps": flow.maps}
    found |= {"snapshots": snapshots.dataset, "series": series.dataset}
    counted = flow.diagnostics
    return fields | {name: digest(dataset) for name, dataset in found.items()} | {
        "budget": repr(flow.budget), "phases": repr(flow.budget_by_phase), "time": repr(flow.elapsed_time),
        "counters": repr((counted.steps, counted.smallest_step, counted.share_asleep)),
        "files": [file.name for file in files], "sizes": [file.stat().st_size for file in files],
    }  # fmt: skip


def main(folder: Path) -> None:
    path, directory = folder / CHECKPOINT, folder / MAPS
    directory.mkdir(exist_ok=True)
    series = Series(TIMES, measured)
    snapshots = Snapshots(2.0, variables=["debris_flow__depth", "debris_flow__eroded_depth"])
    observers = [snapshots, series, MapSeries(2.0, directory, replace=True), Checkpoints(path, INTERVAL)]
    if path.exists():
        flow = DebrisFlow.load(path, observers=observers)
    else:
        flow = DebrisFlow(valley(), numerics={"particle_count": 600}, observers=observers)
    flow.run_until_rest()
    words = json.dumps(result(flow, snapshots, series, folder), indent=1)
    write_atomically(folder / RESULT, lambda temporary: temporary.write_text(words))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
