"""Cost of a checkpoint of a large event: time and size, and its fraction of a run at the default interval.

python -m benchmarks.checkpoint
"""

import argparse
import statistics
import tempfile
import time
from pathlib import Path

import numpy as np
from landlab import RasterModelGrid

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.record import Checkpoints

LIMIT = 0.03
"""Most that checkpoints at the default interval may take of a run [-]."""


def event(nodes: int, particles: int, observers=()) -> DebrisFlow:
    """Return an eroding flow of 1e5 m3 that is about to begin, on rough ground, nodes 5 m apart."""
    grid, rng = RasterModelGrid((nodes, nodes), xy_spacing=5.0), np.random.default_rng(15)
    x, y = grid.x_of_node, grid.y_of_node
    side = 0.15 * abs(y - y.mean())
    grid.add_field("topographic__elevation", 0.4 * (x.max() - x) + side + rng.normal(0.0, 0.05, x.size), at="node")
    grid.add_field("soil__depth", rng.uniform(2.0, 3.0, x.size), at="node")
    near = np.hypot(x - 0.2 * x.max(), y - y.mean()) < 130.0
    grid.add_field("debris_flow__release_depth", np.where(near, 1e5 / (25.0 * near.sum()), 0.0), at="node")
    return DebrisFlow(grid, numerics={"particle_count": particles}, observers=observers)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--nodes", type=int, default=1000, help="along a side")
    parser.add_argument("--particles", type=int, default=5000)
    parser.add_argument("--repeats", type=int, default=5)
    options = parser.parse_args()
    saving = []
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "event.nc"

        class Saves:
            interval = 4.0

            def observe(self, flow):
                """Nothing: it saves between steps."""

            def keep(self, flow, broken_off):
                if len(saving) < options.repeats and flow.elapsed_time > 5.0 * (1 + len(saving)):
                    begin = time.perf_counter(), time.process_time()
                    flow.save(path)
                    saving.append((time.perf_counter() - begin[0], time.process_time() - begin[1]))

        flow = event(options.nodes, options.particles, [Saves()])
        flow.run_one_step(5.0 * (options.repeats + 1))
        size = path.stat().st_size
        begin = time.perf_counter()
        again = DebrisFlow.load(path, event(options.nodes, options.particles).grid, observers=[Saves()])
        loading = time.perf_counter() - begin
    wall, cpu = (statistics.median(taken[k] for taken in saving) for k in (0, 1))
    part = wall / Checkpoints("event.nc").wall_interval
    print(
        f"{options.nodes} x {options.nodes} nodes, {again.particles.sizes['particle']} particles, in a call at "
        f"{again.elapsed_time:.1f} s"
    )
    print(
        f"size {size / 1e6:.1f} MB; saved in {wall:.2f} s ({cpu:.2f} s of CPU), median of {len(saving)}; loaded with "
        f"a new grid in {loading:.2f} s"
    )
    print(f"at the default interval {100.0 * part:.2f} % of the time of a run, limit {100.0 * LIMIT:g} %")
    return int(part > LIMIT)


if __name__ == "__main__":
    raise SystemExit(main())
