"""Cost of an event on a small and on a large raster: nodes touched, and CPU times taken in turns."""

import os
import statistics
import time

from benchmarks.speed_engine import counting
from landlab_debrisflow import DebrisFlow
from validation.rasters import raster, touched_by, valley

SYSTEM_APART = "call, the system's apart"
SMALL, LARGE = {"nodes": 200, "offset": 0}, {"nodes": 2000, "offset": 900}


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
