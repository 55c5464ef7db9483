"""One event on rasters of any size, and the nodes it touches: they are counted inside the engine."""

from contextlib import contextmanager
from unittest import mock

import numpy as np
from landlab import RasterModelGrid

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
    touched, erode, scatter, cover = Touched(), bed.take_soil, peak_maps.scatter, row_backup.RowBackup.keep_rows

    def counted_erode(*arguments):
        count, *given = erode(*arguments)
        touched.eroded.append(int(count))
        return count, *given

    def counted_scatter(*arguments):
        nodes = scatter(*arguments)
        touched.shown.append(int(nodes.size))
        return nodes

    def counted_cover(self, first, last):
        before = self.nodes.stop - self.nodes.start
        cover(self, first, last)
        touched.kept.append((self.nodes.stop - self.nodes.start - before) * len(self._arrays))

    with (
        mock.patch.object(bed, "take_soil", counted_erode),
        mock.patch.object(peak_maps, "scatter", counted_scatter),
        mock.patch.object(row_backup.RowBackup, "keep_rows", counted_cover),
    ):
        yield touched


def touched_by(flow) -> Touched:
    """Run a flow to rest; return the nodes that it touched."""
    with counting_nodes() as touched:
        flow.run_until_rest()
    return touched
