"""What the flow shows on the nodes: now, and at its peak. The maps are made of this."""

import numpy as np

from ..core.jit import kernel
from ..spatial.transfer import Nodes, scatter
from .particles import Particles

NOW = ("depth", "speed", "basal_excess_pore_pressure", "basal_peclet_number")
LOOK = 0.5
"""Part of a node spacing that matter or waves may cross between two looks: no node is passed unseen."""

PEAKS = ("max_depth", "max_speed", "max_basal_pressure_ratio", "max_basal_peclet_number", "arrival_time")


class Footprint:
    """Writes node arrays; only nodes under the flow are looked at.

    Parameters
    ----------
    nodes : Nodes
        The raster.
    fields : mapping of str to ndarray, shape (nodes,)
        Arrays named as in `NOW` and `PEAKS`, written in place; arrival_time is -1 where nothing came.
    arrival_depth : float
        Depth that counts as arrival [m].
    time : float
        Of the event, now [s].
    """

    def __init__(self, nodes: Nodes, fields, arrival_depth: float, time: float):
        self._nodes, self._arrival_depth = nodes, arrival_depth
        self._now, self._peaks = [fields[name] for name in NOW], [fields[name] for name in PEAKS]
        self._sums = np.zeros((5, nodes.core.size))
        self._scratch = np.empty(nodes.core.size, np.int64)
        self._under = np.flatnonzero(fields["depth"])  # nodes under the flow at the last look
        self._passed, self._then = 0.0, time  # way of the fastest since the last look [m]; when it was last counted [s]

    def follow(self, particles: Particles, time: float, fastest: float) -> None:
        """Record where something, at most at speed `fastest` [m s-1], may have got on since the last look."""
        self._passed += fastest * (time - self._then)
        self._then = time
        if self._passed > LOOK * min(self._nodes.dx, self._nodes.dy):
            self.record(particles, time)

    def record(self, particles: Particles, time: float) -> None:
        """Show where the particles are now and keep the peaks."""
        p, self._passed, self._then = particles, 0.0, time
        for field in self._now:
            field[self._under] = 0.0
        if p.count == 0:
            self._under = self._under[:0]
            return
        speed = np.sqrt(np.einsum("in,in->n", p.velocity, p.velocity))
        amounts = np.array([speed, p.basal_excess_pore_pressure, p.liquefaction_pressure, p.basal_peclet_number])
        values = np.concatenate([p.volume[None, :], amounts * p.volume])
        self._under = scatter(self._nodes, p.x, p.y, p.spread, values, self._sums, self._scratch).copy()
        _record(self._under, self._sums, self._nodes.area, time, self._arrival_depth, *self._now, *self._peaks)

    def clear(self) -> None:
        """Take depth and speed off the nodes; pressure and Péclet number stay as they were last."""
        for field in self._now[:2]:
            field[self._under] = 0.0
        self._under = self._under[:0]


@kernel
def _record(
    at, sums, area, time, arrival_depth, depth, speed, pressure, peclet,
    max_depth, max_speed, max_ratio, max_peclet, arrival,
):  # fmt: skip
    for k in range(at.size):
        n = at[k]
        volume = sums[0, n]
        depth[n], speed[n], pressure[n] = volume / area, sums[1, n] / volume, sums[2, n] / volume
        peclet[n] = sums[4, n] / volume
        max_depth[n], max_speed[n] = max(max_depth[n], depth[n]), max(max_speed[n], speed[n])
        max_peclet[n] = max(max_peclet[n], peclet[n])
        if sums[3, n] > 0.0:
            max_ratio[n] = max(max_ratio[n], min(1.0, sums[2, n] / sums[3, n]))
        if arrival[n] < 0.0 and depth[n] > arrival_depth:
            arrival[n] = time
        for v in range(sums.shape[0]):
            sums[v, n] = 0.0
