"""What an event costs on a small and on a large raster: nodes touched are counted, CPU times taken in turns."""

import os
import statistics
import time
from contextlib import contextmanager
from unittest import mock

import numpy as np
from landlab import RasterModelGrid

from benchmarks.speed_engine import counting
from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.grid import row_backup
from landlab_debrisflow.model import peak_maps
from landlab_debrisflow.terrain import bed


def raster(nodes, offset, spacing=5.0, foot=100, axis=100, top=40, radius=20.0, depth=1.5):
    """Return a valley that falls by half to a flat foot, on a raster of `nodes` squared.

    Parameters
    ----------
    nodes : int
    offset : int
        Nodes by which all is shifted towards larger x and y.
    foot, axis, top : int
        Column at which the slope ends, row of the thalweg, column of the release, in nodes from the offset.
    """
    grid = RasterModelGrid((nodes, nodes), xy_spacing=spacing)
    x, y = grid.x_of_node - offset * spacing, grid.y_of_node - (offset + axis) * spacing
    z = grid.add_field("topographic__elevation", np.maximum(0.0, 0.5 * (foot * spacing - x)), at="node")
    z += 0.1 * abs(y)
    grid.add_full("soil__depth", 2.0, at="node")
    release = grid.add_zeros("debris_flow__release_depth", at="node")
    release[np.hypot(x - top * spacing, y) < radius] = depth
    return grid


def valley(particles=1500, **keywords):
    """Return a flow in the valley of `raster`."""
    return DebrisFlow(raster(**keywords), numerics={"particle_count": particles})


class Touched:
    """Nodes that were read or written, look by look."""

    def __init__(self):
        self.eroded, self.shown, self.kept = [], [], []


@contextmanager
def counting_nodes():
    """Count nodes that erosion shares out and that the record looks at, and those copied before a change."""
    touched, erode, scatter, cover = Touched(), bed._erode, peak_maps.scatter, row_backup.RowBackup.keep_rows

    def counted_erode(*arguments):
        count = erode(*arguments)
        touched.eroded.append(int(count))
        return count

    def counted_scatter(*arguments):
        nodes = scatter(*arguments)
        touched.shown.append(int(nodes.size))
        return nodes

    def counted_cover(self, first, last):
        before = self.nodes.stop - self.nodes.start
        cover(self, first, last)
        touched.kept.append((self.nodes.stop - self.nodes.start - before) * len(self._arrays))

    with (
        mock.patch.object(bed, "_erode", counted_erode),
        mock.patch.object(peak_maps, "scatter", counted_scatter),
        mock.patch.object(row_backup.RowBackup, "keep_rows", counted_cover),
    ):
        yield touched


def touched_by(flow) -> Touched:
    """Run a flow to rest; return what it touched."""
    with counting_nodes() as touched:
        flow.run_until_rest()
    return touched


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
