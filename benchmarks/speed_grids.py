"""Cost of an event on a small and on a large raster: nodes touched, CPU times taken in turns, memory.

    python -m benchmarks.speed_grids [NODES ...]

prints the memory alone, on rasters of so many nodes squared; `PYTHON -P benchmarks/speed_grids.py` that of another
version of the package, installed elsewhere.
"""

import logging
import os
import statistics
import sys
import time
import tracemalloc
from pathlib import Path
from typing import NamedTuple

from landlab_debrisflow import DebrisFlow

if not __package__:  # run as a file: the package that is installed goes before that of the checkout
    sys.path.append(str(Path(__file__).parents[1]))
from benchmarks.speed_engine import counting
from validation.rasters import raster, touched_by, valley

SYSTEM_APART = "call, the system's apart"
SMALL, LARGE = {"nodes": 200, "offset": 0}, {"nodes": 2000, "offset": 900}


class Memory(NamedTuple):
    """Memory of an event over the nodes of its raster, as Python counts what it hands out [B]."""

    fields: float  # that the component adds to the grid
    after: float  # besides these, that the component holds after a call
    most: float  # besides the fields, in a call


def memory(nodes: int, offset: int) -> Memory:
    """Return the memory of an event in the valley of `raster`, whose kernels are loaded, over its nodes."""
    grid = raster(nodes, offset)
    before = set(grid.at_node)
    tracemalloc.start()
    try:
        flow = DebrisFlow(grid, numerics={"particle_count": 1500})
        flow.run_one_step(20.0)
        after, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    fields = sum(grid.at_node[name].nbytes for name in set(grid.at_node) - before)
    return Memory(*(value / nodes**2 for value in (fields, after - fields, most - fields)))


def compare(pairs):
    """Return counts on both rasters, and medians of CPU times and of their ratios, taken in turns.

    Returns
    -------
    touched : list of Touched
    times : dict
        CPU of all steps, of the call, of that but what the system took to hand out memory, and of the call with the
        making of the component, small and large [s]; the ratio.
    """
    touched = [touched_by(valley(**one)) for one in (SMALL, LARGE)]
    rows = {"steps": [], "call": [], SYSTEM_APART: [], "call and component": []}
    for _ in range(pairs):
        both = {name: [] for name in rows}
        for one in (SMALL, LARGE):
            grid = raster(**one)
            begin = time.process_time()
            flow = DebrisFlow(grid, numerics={"particle_count": 1500})
            made = time.process_time() - begin
            with counting() as done:
                begin = os.times()
                flow.run_until_rest()
                end = os.times()
            own = end.user - begin.user
            call = own + end.system - begin.system
            for name, taken in zip(rows, (done.cpu, call, own, call + made), strict=True):
                both[name].append(taken)
        for name, taken in both.items():
            rows[name].append(taken)
    times = {}
    for name, taken in rows.items():
        small, large = (statistics.median(t[k] for t in taken) for k in (0, 1))
        times[name] = small, large, statistics.median(t[1] / t[0] for t in taken)
    return touched, times


def main() -> None:
    """Print the memory on rasters of the sizes that the command line gives."""
    logging.getLogger("landlab_debrisflow").setLevel(logging.ERROR)
    valley(**SMALL).run_one_step(20.0)  # loads the kernels
    print("nodes  B per node in fields  held besides after a call  most besides in it")
    for nodes in map(int, sys.argv[1:] or ("200", "2000")):
        found = memory(nodes, LARGE["offset"] if nodes >= LARGE["nodes"] else 0)
        print(f"{nodes:5d}  {found.fields:20.1f}  {found.after:25.1f}  {found.most:18.1f}", flush=True)


if __name__ == "__main__":
    main()
