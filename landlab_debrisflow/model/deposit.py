"""Resting mass on the nodes, and the range in y that a step may change."""

import numpy as np

from ..core.jit import kernel


def resting_depth(p, origins, bed):
    """Return nodes, shape (k,), and the depth of particles that lie still on them, shape (k,) [m].

    Parameters
    ----------
    p : Particles
        All particles.
    origins : Origins
        Mass that never moved returns to the nodes from which it was taken.
    bed : Bed
        Ground below the flow.
    """
    still = ~np.any(p.velocity, axis=0) & (p.volume > 0.0)
    if not still.any():
        return np.empty(0, np.int64), np.empty(0)
    x, y, spacing, volume, origin = p.x[still], p.y[still], p.spacing[still], p.volume[still], p.origin[still]
    back, lying = origins.unmoved(origin, x, y, spacing, bed.raster.core), np.zeros(p.count)
    lying[still] = (1.0 - back) * volume
    nodes, depth = bed.depth_of(bed.footprints(p), lying)
    returning = back > 0.0
    old, given = origins.returned(origin[returning], (back * volume)[returning])
    every, place = np.unique(np.concatenate([nodes, old]), return_inverse=True)
    return every, np.bincount(place, np.concatenate([depth, given / bed.raster.area]), every.size)


@kernel
def _span(values):
    """Return the least and the largest of some values; infinity and its negative if there is none."""
    least, largest = np.inf, -np.inf
    for i in range(values.size):
        least, largest = min(least, values[i]), max(largest, values[i])
    return least, largest


def extent(p, origins, inflow, raster) -> tuple[float, float]:
    """Return least and largest y of the ground that a step may change [m]; the first is larger if there is none.

    `p` are the particles, `origins` the places of mass that has never moved, `inflow` the inflow to come, `raster` the
    nodes.
    """
    south, north = _span(p.y)
    if nodes := origins.span:  # nodes to which mass that never moved may return
        first, last = nodes[0] // raster.columns * raster.dy, nodes[1] // raster.columns * raster.dy
        south, north = min(south, first), max(north, last)
    for source in () if inflow.over else inflow.sources:
        first, last = source.y_range
        south, north = min(south, first), max(north, last)
    return south, north
