"""Fields of the flow on the nodes: now, and at its peak. The maps are made of them.

Peaks count only where the flow is deeper than the depth that counts as arrival, so that a node has an arrival time and
all peaks or none of them. Without a least depth the edge of a hat function, of perhaps 1e-32 m3, would count with its
full speed. Two of the peaks serve the design of obstacles.

**Impact pressure** is the dynamic pressure density x speed^2, in the mean over the volume at a node: the flux of
momentum through a square metre across the flow. The empirical factor on it (1.5 for Hungr et al., 1984; 3 to 5 for
Zhang, 1993), the static pressure and single boulders are not included.

**Run-up** is the height of the surface, bed plus depth, above the lowest bed which that matter has come over. Where a
flow only goes down, run-up is its depth. On rising ground it is the quantity measured in the field and in flumes, depth
plus rise above the foot (Iverson, George & Logan, 2016): v^2/(2g) for a thin body without friction.

**Closed nodes** hold no flow. They show values of the open nodes beside their four faces: the impact pressure of the
velocity component towards the face, on the map, and the run-up. At a wall across the flow the run-up is the depth
behind the bore that the wall reflects. A depth-integrated flow has no jet, which could splash as high as impact
pressure / (2 density g).
"""

import numpy as np

from ..core.jit import kernel
from ..physics.column.driver import depth_mean
from ..physics.contracts import WATER
from ..spatial.footprints import Footprints
from ..spatial.raster import CLOSED, Raster
from ..spatial.slots import with_places
from ..spatial.transfer import scatter
from .map_fields import CURRENT, PEAKS, PHASES, SOLID_FRACTION, Base, CurrentFields, Matter, PeakFields
from .particles import Particles

UPDATE_FRACTION = 0.5
"""Fraction of a node spacing that matter or waves may cross between two updates of the maps, so that no node is passed
over."""


VOLUME, WAY, PRESSURE, LIQUEFACTION, PECLET, IMPACT, SURFACE, GRAINS, GRAIN_WAY, TOWARDS = range(10)
"""Places of the sums at every node, each times volume: speed, quantities of the columns (of grains), impact pressure,
height of the surface over the lowest bed; the volume of grains, and their speed."""

FACES = 4
"""First place of the impact towards faces in the east, west, north and south, if there are closed nodes."""


class PeakMaps:
    """Maps of the flow now and of its peaks; only nodes under the flow, and closed ones beside them, are examined.

    Parameters
    ----------
    raster : Raster
        Nodes, their statuses and spacing [m].
    fields : mapping of str to ndarray, shape (nodes,)
        Arrays named as in `CURRENT` and `PEAKS`, and `PHASES` if there are two, written in place; arrival_time is -1
        where nothing came.
    arrival_depth : float
        Depth that counts as arrival, and for the peaks [m].
    time : float
        Time of the event, now [s].
    """

    def __init__(self, raster: Raster, fields, arrival_depth: float, time: float):
        self._raster, self._arrival_depth = raster, arrival_depth
        self._walled = bool(np.any(raster.status == CLOSED))
        self._current = CurrentFields(**{name: fields[name] for name in CURRENT})
        self._peaks = PeakFields(**{name: fields[name] for name in PEAKS})
        self._phases = [fields[name] for name in PHASES if name in fields]
        self._solid_fraction = fields.get(SOLID_FRACTION)
        further = FACES * self._walled + (self._solid_fraction is not None)
        self._sums, self._scratch = np.zeros((0, TOWARDS + further)), np.empty(0, np.int64)
        self._under = np.flatnonzero(fields["depth"])  # nodes under the flow at the last update
        # way of the fastest particle since then [m]; time up to which this way is counted [s]
        self._passed, self._then = 0.0, time

    @property
    def under(self):
        """Nodes that showed the flow at the last update, ndarray of int."""
        return self._under

    def variables(self) -> dict:
        """Return nodes under the flow at the last update and the way since, by name, as dimensions and values."""
        return {"under": ("shown", self._under), "passed": ((), self._passed), "then": ((), self._then)}

    def set_variables(self, variables) -> None:
        """Restore the last update that `variables` returned, values by name."""
        self._under = variables["under"]
        self._passed, self._then = float(variables["passed"]), float(variables["then"])

    def is_due(self, time: float, fastest: float) -> bool:
        """Return whether debris of the speed `fastest` [m s-1] may have reached a new node since the last update."""
        self._passed += fastest * (time - self._then)
        self._then = time
        return self._passed > UPDATE_FRACTION * self._raster.spacing

    def record(self, particles: Particles, footprints: Footprints, density, time: float) -> None:
        """Write the fields of now and the peaks that they exceed; `density` is of all particles or of each [kg m-3]."""
        p, self._passed, self._then = particles, 0.0, time
        mixture = () if self._solid_fraction is None else (self._solid_fraction,)
        for field in (*self._phases, *mixture):
            field[self._under] = 0.0
        if p.count == 0:
            for field in self._current:
                field[self._under] = 0.0
            self._under = self._under[:0]
            return
        density = density if np.shape(density) == p.volume.shape else np.full(p.count, density)
        matter = Matter(
            volume=p.volume, density=density, phase=p.phase, velocity=p.velocity, z=p.z, lowest_z=p.lowest_z,
            depth=p.depth,
        )  # fmt: skip
        base = Base(
            pressure=p.basal_excess_pore_pressure, liquefaction_pressure=p.liquefaction_pressure,
            peclet_number=p.basal_peclet_number,
        )  # fmt: skip
        values = np.empty((p.count, self._sums.shape[1]))
        _weight_by_volume(matter, base, self._walled, values)
        if self._solid_fraction is not None:
            values[:, -1] = p.volume * depth_mean(p.solid_fraction)
        *_, node = footprints
        if self._scratch.size < node.size:
            self._sums, self._scratch = with_places(self._sums, node.size), np.empty(node.size, np.int64)
        slots = scatter(footprints, values, self._sums, self._scratch)
        left, self._under = self._under, node[slots]
        if self._walled:
            least = self._arrival_depth * self._raster.area
            _record_walls(self._under, slots, self._sums, least, self._raster, self._peaks)
        self._show_phases(self._under, slots)
        if self._solid_fraction is not None:
            self._solid_fraction[self._under] = self._sums[slots, -1] / self._sums[slots, VOLUME]
        area = self._raster.area
        _record(left, self._under, slots, self._sums, area, time, self._arrival_depth, self._current, self._peaks)

    def _show_phases(self, at, slots):
        for field in self._phases[:1]:
            whole, way, grains, grain_way = self._sums[slots].T[[VOLUME, WAY, GRAINS, GRAIN_WAY]]
            field[at] = grains / self._raster.area
            self._phases[1][at] = np.divide(grain_way, grains, out=np.zeros(at.size), where=grains > 0.0)
            water = whole - grains
            left = np.maximum(way - grain_way, 0.0)
            self._phases[2][at] = np.divide(left, water, out=np.zeros(at.size), where=water > 1e-12 * whole)

    def clear(self) -> None:
        """Set depth and speed at the nodes to 0; pressure and Péclet number keep their last values."""
        for field in (*self._current[:2], *self._phases):
            field[self._under] = 0.0
        self._under = self._under[:0]


@kernel
def _weight_by_volume(matter, base, walled, values):
    """Write the quantities that are averaged over the volume at the nodes, times volume [m3].

    Parameters
    ----------
    matter : Matter
        Matter of n particles.
    base : Base
        Base of the n particles.
    walled : bool
        Whether there are closed nodes: then impact towards their faces is written, too.
    values : ndarray, shape (n, k)
        Written; in the order of `VOLUME` and those that follow.
    """
    volume, density, phase, velocity, z, lowest_z, depth = matter
    pressure, liquefaction_pressure, peclet_number = base
    for i in range(volume.size):
        m, u, v = volume[i], velocity[0, i], velocity[1, i]
        speed2 = u * u + v * v + velocity[2, i] ** 2
        speed, grains = np.sqrt(speed2), m if phase[i] != WATER else 0.0  # grains carry the columns
        values[i, VOLUME], values[i, WAY], values[i, GRAINS], values[i, GRAIN_WAY] = (
            m,
            m * speed,
            grains,
            grains * speed,
        )
        values[i, PRESSURE], values[i, LIQUEFACTION] = grains * pressure[i], grains * liquefaction_pressure[i]
        values[i, PECLET] = grains * peclet_number[i]
        values[i, IMPACT], values[i, SURFACE] = m * density[i] * speed2, m * (z[i] - lowest_z[i] + depth[i])
        if walled:
            momentum = m * density[i]
            values[i, TOWARDS] = momentum * max(u, 0.0) ** 2
            values[i, TOWARDS + 1] = momentum * min(u, 0.0) ** 2
            values[i, TOWARDS + 2] = momentum * max(v, 0.0) ** 2
            values[i, TOWARDS + 3] = momentum * min(v, 0.0) ** 2


@kernel
def _record_walls(nodes, slots, sums, least, raster, peaks):
    """Record impact pressure [Pa] and run-up [m] on closed nodes beside nodes with more than a least volume [m3].

    Parameters
    ----------
    nodes : ndarray of int, shape (k,)
        Nodes under the flow.
    slots : ndarray of int, shape (k,)
        Their slots.
    sums : ndarray, shape (slots, m)
        Values times volume, in the order of `VOLUME` and those that follow.
    least : float
        [m3]
    raster : Raster
        Nodes, their statuses and spacing [m].
    peaks : PeakFields
        Fields of the peaks, written in place.
    """
    status, columns, rows, _, _, _ = raster
    _, _, _, _, _, max_impact, max_run_up = peaks
    for k in range(nodes.size):
        n, slot = nodes[k], slots[k]
        if not sums[slot, VOLUME] > least:
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
                    max_impact[wall] = max(max_impact[wall], sums[slot, TOWARDS + side] / sums[slot, VOLUME])
                    max_run_up[wall] = max(max_run_up[wall], sums[slot, SURFACE] / sums[slot, VOLUME])


@kernel
def _record(left, nodes, slots, sums, area, time, arrival_depth, current, peaks):
    """Record the flow now and its peaks at nodes under it, and clear their sums.

    Parameters
    ----------
    left : ndarray of int, shape (m,)
        Nodes under the flow at the update before.
    nodes : ndarray of int, shape (k,)
        Nodes under the flow.
    slots : ndarray of int, shape (k,)
        Their slots.
    sums : ndarray, shape (slots, m)
        Values times volume, in the order of `VOLUME` and those that follow; 0 at these nodes on return.
    area : float
        Map area of a node [m2].
    time : float
        Elapsed time of the event [s].
    arrival_depth : float
        Depth that counts as arrival, and for the peaks [m].
    current : CurrentFields
        Fields of the flow now, written in place.
    peaks : PeakFields
        Fields of the peaks, written in place.
    """
    depth, speed, pressure, peclet = current
    max_depth, max_speed, max_ratio, max_peclet, arrival, max_impact, max_run_up = peaks
    for k in range(left.size):
        n = left[k]
        depth[n] = speed[n] = pressure[n] = peclet[n] = 0.0
    for k in range(nodes.size):
        n, slot = nodes[k], slots[k]
        volume = sums[slot, VOLUME]
        depth[n], speed[n] = volume / area, sums[slot, WAY] / volume
        if sums[slot, GRAINS] > 0.0:
            pressure[n], peclet[n] = sums[slot, PRESSURE] / sums[slot, GRAINS], sums[slot, PECLET] / sums[slot, GRAINS]
        if depth[n] > arrival_depth:
            max_depth[n], max_speed[n] = max(max_depth[n], depth[n]), max(max_speed[n], speed[n])
            max_peclet[n] = max(max_peclet[n], peclet[n])
            if sums[slot, LIQUEFACTION] > 0.0:
                max_ratio[n] = max(max_ratio[n], min(1.0, sums[slot, PRESSURE] / sums[slot, LIQUEFACTION]))
            max_impact[n] = max(max_impact[n], sums[slot, IMPACT] / volume)
            max_run_up[n] = max(max_run_up[n], sums[slot, SURFACE] / volume)
            if arrival[n] < 0.0:
                arrival[n] = time
        for v in range(sums.shape[1]):
            sums[slot, v] = 0.0
