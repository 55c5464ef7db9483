"""Peak maps: the flow at nodes, now and at its peak. Fields and Datasets are made of this.

Peaks count where the flow is deeper than what counts as arrival: a node has arrival time, peak depth, peak speed and
all the others, or none. The last 1e-32 m3 of a tent moves at full speed, too. Two of the peaks are what obstacles are
designed for.

**Impact pressure** is the dynamic pressure density x speed^2, in the mean over the volume at a node: the flux of
momentum through a square metre across the flow. The empirical factor on it (1.5 for Hungr et al., 1984; 3 to 5 for
Zhang, 1993), the static pressure and single boulders are for the reader to put on.

**Run-up** is the height of the surface, bed plus depth, above the lowest bed which that matter has come over. Downhill
that is the depth. On raised terrain it is what is measured in the field and in flumes, depth plus rise above the foot
(Iverson, George & Logan, 2016): v^2/(2g) for a thin body without friction.

**Closed nodes** hold no flow. They show what the open nodes beside their four faces do: impact with the part of the
velocity that is towards the face, on the map, and the run-up there. At a wall across the flow that is the depth behind
the bore it sends back. A depth-integrated flow has no jet: one could splash to impact pressure / (2 density g).
"""

import numpy as np

from ..core.jit import kernel
from ..physics.contracts import WATER
from ..spatial.transfer import Nodes, scatter
from .kinematics import CLOSED
from .particles import Particles

CURRENT = ("depth", "speed", "basal_excess_pore_pressure", "basal_peclet_number")
UPDATE_FRACTION = 0.5
"""Part of a node spacing that matter or waves may cross between two updates: no node is passed unseen."""

PEAKS = (
    "max_depth", "max_speed", "max_basal_pressure_ratio", "max_basal_peclet_number", "arrival_time",
    "max_impact_pressure", "max_run_up",
)  # fmt: skip

PHASES = ("solid_depth", "solid_speed", "water_speed")
"""Shown besides, of grains and water, if they move by themselves."""

VOLUME, WAY, PRESSURE, LIQUEFACTION, PECLET, IMPACT, SURFACE, GRAINS, GRAIN_WAY, TOWARDS = range(10)
"""What is summed at every node, times volume: speed, what columns tell of grains, impact pressure, height of the
surface over the lowest bed; the volume of grains, and their speed."""

FACES = 4
"""From `TOWARDS` on, if there are closed nodes: impact towards faces in the east, west, north, south."""


class PeakMaps:
    """Writes node arrays; only nodes under the flow, and closed ones beside them, are looked at.

    Parameters
    ----------
    nodes : Nodes
        The raster.
    status : ndarray, shape (nodes,)
        Node statuses as Landlab numbers them.
    fields : mapping of str to ndarray, shape (nodes,)
        Arrays named as in `CURRENT` and `PEAKS`, and `PHASES` if there are two, written in place; arrival_time is -1
        where nothing came.
    arrival_depth : float
        Depth that counts as arrival, and for the peaks [m].
    time : float
        Of the event, now [s].
    """

    def __init__(self, nodes: Nodes, status, fields, arrival_depth: float, time: float):
        self._nodes, self._status, self._arrival_depth = nodes, status, arrival_depth
        self._walled = bool(np.any(status == CLOSED))
        self._now, self._peaks = [fields[name] for name in CURRENT], [fields[name] for name in PEAKS]
        self._phases = [fields[name] for name in PHASES if name in fields]
        self._sums = np.zeros((nodes.core.size, TOWARDS + FACES * self._walled))
        self._scratch = np.empty(nodes.core.size, np.int64)
        self._under = np.flatnonzero(fields["depth"])  # nodes under the flow at the last update
        self._passed, self._then = (
            0.0,
            time,
        )  # way of the fastest since then [m]; when that was last counted [s]

    @property
    def under(self):
        """Nodes that showed the flow at the last update."""
        return self._under

    def is_due(self, time: float, fastest: float) -> bool:
        """Return whether something, at most at speed `fastest` [m s-1], may have got on since the last update."""
        self._passed += fastest * (time - self._then)
        self._then = time
        return self._passed > UPDATE_FRACTION * min(self._nodes.dx, self._nodes.dy)

    def record(self, particles: Particles, density, time: float) -> None:
        """Show where the particles are now and keep the peaks; `density` is one for all or of each [kg m-3]."""
        p, self._passed, self._then = particles, 0.0, time
        for field in self._now + self._phases:
            field[self._under] = 0.0
        if p.count == 0:
            self._under = self._under[:0]
            return
        values = np.empty((p.count, self._sums.shape[1]))
        _weight_by_volume(
            self._walled, p.volume, p.velocity, p.basal_excess_pore_pressure, p.liquefaction_pressure,
            p.basal_peclet_number, np.broadcast_to(density, p.count), p.z, p.lowest_z, p.depth, p.phase, values,
        )  # fmt: skip
        self._under = scatter(self._nodes, p.x, p.y, p.spread, values, self._sums, self._scratch).copy()
        if self._walled:
            least = self._arrival_depth * self._nodes.area
            _record_walls(self._under, self._sums, least, self._nodes.columns, self._status, *self._peaks[-2:])
        self._show_phases(self._under)
        _record(self._under, self._sums, self._nodes.area, time, self._arrival_depth, *self._now, *self._peaks)

    def _show_phases(self, at):
        for field in self._phases[:1]:
            whole, way, grains, grain_way = self._sums[at].T[[VOLUME, WAY, GRAINS, GRAIN_WAY]]
            field[at] = grains / self._nodes.area
            self._phases[1][at] = np.divide(grain_way, grains, out=np.zeros(at.size), where=grains > 0.0)
            water = whole - grains
            left = np.maximum(way - grain_way, 0.0)
            self._phases[2][at] = np.divide(left, water, out=np.zeros(at.size), where=water > 1e-12 * whole)

    def clear(self) -> None:
        """Take depth and speed off the nodes; pressure and Péclet number stay as they were last."""
        for field in self._now[:2] + self._phases:
            field[self._under] = 0.0
        self._under = self._under[:0]


@kernel
def _weight_by_volume(
    walled, volume, velocity, pressure, liquefaction, peclet, density, z, lowest_z, depth, phase, values
):
    """Write the quantities to be averaged over the volume at nodes, times volume."""
    for i in range(volume.size):
        m, u, v, to = volume[i], velocity[0, i], velocity[1, i], values[i]
        speed2 = u * u + v * v + velocity[2, i] ** 2
        grains = m if phase[i] != WATER else 0.0  # it is they that have pore pressure
        to[VOLUME], to[WAY], to[GRAINS], to[GRAIN_WAY] = m, m * np.sqrt(speed2), grains, grains * np.sqrt(speed2)
        to[PRESSURE], to[LIQUEFACTION] = grains * pressure[i], grains * liquefaction[i]
        to[PECLET] = grains * peclet[i]
        to[IMPACT], to[SURFACE] = m * density[i] * speed2, m * (z[i] - lowest_z[i] + depth[i])
        if walled:
            momentum = m * density[i]
            to[TOWARDS], to[TOWARDS + 1] = momentum * max(u, 0.0) ** 2, momentum * min(u, 0.0) ** 2
            to[TOWARDS + 2], to[TOWARDS + 3] = momentum * max(v, 0.0) ** 2, momentum * min(v, 0.0) ** 2


@kernel
def _record_walls(at, sums, least, columns, status, max_impact, max_run_up):
    """Record the peaks at closed nodes beside nodes with more than the `least` volume [m3]."""
    rows = status.size // columns
    for k in range(at.size):
        n = at[k]
        if not sums[n, VOLUME] > least:
            continue
        r, c = n // columns, n % columns
        for side in range(4):
            beside_r, beside_c = r, c
            if side < 2:
                beside_c += 1 - 2 * side
            else:
                beside_r += 5 - 2 * side
            if 0 <= beside_r < rows and 0 <= beside_c < columns:
                wall = beside_r * columns + beside_c
                if status[wall] == CLOSED:
                    max_impact[wall] = max(max_impact[wall], sums[n, TOWARDS + side] / sums[n, VOLUME])
                    max_run_up[wall] = max(max_run_up[wall], sums[n, SURFACE] / sums[n, VOLUME])


@kernel
def _record(
    at, sums, area, time, arrival_depth, depth, speed, pressure, peclet,
    max_depth, max_speed, max_ratio, max_peclet, arrival, max_impact, max_run_up,
):  # fmt: skip
    for k in range(at.size):
        n = at[k]
        volume = sums[n, VOLUME]
        depth[n], speed[n] = volume / area, sums[n, WAY] / volume
        if sums[n, GRAINS] > 0.0:
            pressure[n], peclet[n] = sums[n, PRESSURE] / sums[n, GRAINS], sums[n, PECLET] / sums[n, GRAINS]
        if depth[n] > arrival_depth:
            max_depth[n], max_speed[n] = max(max_depth[n], depth[n]), max(max_speed[n], speed[n])
            max_peclet[n] = max(max_peclet[n], peclet[n])
            if sums[n, LIQUEFACTION] > 0.0:
                max_ratio[n] = max(max_ratio[n], min(1.0, sums[n, PRESSURE] / sums[n, LIQUEFACTION]))
            max_impact[n] = max(max_impact[n], sums[n, IMPACT] / volume)
            max_run_up[n] = max(max_run_up[n], sums[n, SURFACE] / volume)
            if arrival[n] < 0.0:
                arrival[n] = time
        for v in range(sums.shape[1]):
            sums[n, v] = 0.0
