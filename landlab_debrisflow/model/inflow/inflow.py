"""Rows of particles that enter across a line, as hydrographs say.

All particles of a hydrograph have the same volume, and a whole number of them is its volume exactly. Particles enter in
rows: a row stands for the volume that crosses the line while it passes, and its middle crosses the line when half of
this volume has crossed. The times at which rows enter are fixed from the beginning and do not depend on the time steps.

A free edge directly behind the line would let the inflow spread backwards. So, as with the inflow buffers usual in
SPH (Lastiwka et al. 2009; Federico et al. 2012), particles keep the prescribed velocity and thickness
until they have passed a strip as long as their support: every particle beyond the strip then has all its neighbours.
"""

import numpy as np

from ...physics.column.driver import forcing_at_rest
from ...physics.column.initial import initial_profile
from ...physics.column_contracts import BaseContact, is_dilatant
from ...physics.contracts import MIXTURE
from ...spatial.summation import SMOOTHING_RATIO
from ..column_forcing import ColumnPhysics, column_state, shearing_of
from ..release.placing import THICKNESS_RANGE
from .source import Source

FREE = -1
"""Number of the row of particles outside of the strips, whose motion is not prescribed."""

NONE = np.zeros(0, int)


class Inflow:
    """Inflow of a simulation: its sources and the rows of particles that enter.

    Parameters
    ----------
    hydrographs : sequence of Hydrograph
        Lines [m], discharge [m3 s-1] and velocity [m s-1] against time.
    numerics : Numerics, optional
        `particle_count` counts the particles of all hydrographs together; `particle_spacing` is the spacing where the
        inflow is thickest.
    lower_left : array_like, shape (2,)
        Map coordinates of the lower left node [m].

    Attributes
    ----------
    rows_entered : int
        Rows that have entered so far.
    directions : ndarray, shape (sources, 2)
        Unit vectors in which the sources flow.
    """

    def __init__(self, hydrographs=(), numerics=None, lower_left=(0.0, 0.0)):
        self.sources = []
        if hydrographs:
            total, thickest = sum(h.volume for h in hydrographs), max(h.largest_thickness for h in hydrographs)
            volume = total / numerics.count_for(total / thickest)
            self.sources = [Source(h, volume, lower_left) for h in hydrographs]
        rows = sorted((*row, k) for k, source in enumerate(self.sources) for row in source.rows())
        self._time, self._thickness, count, source = (np.array(c) for c in zip(*rows, strict=True)) if rows else (
            np.zeros(0), np.zeros(0), np.zeros(0, int), np.zeros(0, int)
        )  # fmt: skip
        self._count, self._source = count, source
        self._each = np.array([s.particle_volume for s in self.sources])[source]
        self._sum = np.concatenate([[0.0], np.cumsum(count * self._each)])
        self._place = np.zeros(source.size, int)  # number of the row among the rows of its source
        for k in range(len(self.sources)):
            self._place[source == k] = np.arange(np.count_nonzero(source == k))
        self.rows_entered, self.directions = 0, np.zeros((len(self.sources), 2))

    def copy(self) -> "Inflow":
        """Return an independent copy; a run replaces attributes and changes none of them in place."""
        other = object.__new__(Inflow)
        vars(other).update(vars(self))
        return other

    @property
    def rows(self) -> int:
        """Number of rows that enter altogether."""
        return self._time.size

    @property
    def over(self) -> bool:
        """Whether all volume of the hydrographs has entered."""
        return self.rows_entered == self._time.size

    @property
    def next_time(self) -> float:
        """Elapsed time at which the next row enters [s]; infinite if there is no further row."""
        return np.inf if self.over else float(self._time[self.rows_entered])

    @property
    def latest_step(self) -> float:
        """Time until which a step may go [s]: no more than a row's distance behind the next one that enters."""
        if self.over:
            return np.inf
        source, time = self.sources[self._source[self.rows_entered]], self.next_time
        distance = source.strip / (2.0 * SMOOTHING_RATIO)
        return time + distance / max(source.at(time, source.velocity), 1e-300)

    def latest(self, time: float) -> float:
        """Return until when a step that begins at `time` may go [s]: `latest_step`, but past no bend of a series."""
        if not self.sources:
            return np.inf
        soon = time + 1e-9 * (1.0 + abs(time))
        return min([self.latest_step, *(float(t) for source in self.sources for t in source.times if t > soon)])

    @property
    def volume(self) -> float:
        """Volume of the rows that have entered so far [m3]."""
        return float(self._sum[self.rows_entered])

    def aim(self, surface) -> None:
        """Direct the sources before the first row enters; see `Source.direction`."""
        if self.sources and self.rows_entered == 0:
            self.directions = np.array([source.direction(surface) for source in self.sources])

    def enter(self, p, surface, columns: ColumnPhysics, time: float) -> bool:
        """Add the rows that cross the line until `time` [s], moved on to their place then; free rows beyond the strip.

        `p` are the particles, `surface` is the ground that they enter.

        Returns
        -------
        bool
            Whether anything entered.
        """
        first = self.rows_entered
        if not self.sources:
            return False
        self.rows_entered = max(first, int(np.searchsorted(self._time, time, side="right")))
        for row in range(first, self.rows_entered):
            self._add(p, surface, columns, row, time)
        self._set_free(p, time)
        return self.rows_entered > first

    def prescribe_velocity(self, p, time: float) -> None:
        """Give the particles in the strips the velocity prescribed at `time` [s]."""
        if (which := self.prescribed(p)).size == 0:
            return
        speed, direction = self._motion(p.inflow_row[which], time)
        fall = np.einsum("in,in->n", direction, np.array([p.slope_x[which], p.slope_y[which]]))
        p.velocity[:, which] = speed / np.sqrt(1.0 + fall**2) * np.array([*direction, fall])

    def prescribe_thickness(self, p, phase_fractions) -> None:
        """Give the particles in the strips the thickness they entered with; see `Phases.phase_fractions`."""
        if (which := self.prescribed(p)).size == 0:
            return
        part = np.array([part for _, part in phase_fractions])[p.phase[which]]
        p.share[which] = part
        thickness = part * self._thickness[p.inflow_row[which]]
        p.own_thickness[which], p.gradient_term[which] = thickness, 1.0
        p.next_smoothing_length[which] = _smoothing_length(p.volume[which], thickness, p.least_thickness[which])

    def prescribed(self, p):
        """Return the places of particles with prescribed motion, which are awake."""
        return np.flatnonzero(p.inflow_row[: p.awake] != FREE) if self.sources else NONE

    def _motion(self, rows, time):
        """Return speed [m s-1] and direction, shape (2, n), of particles of some rows."""
        speed = np.array([source.at(time, source.velocity) for source in self.sources])
        return speed[self._source[rows]], self.directions[self._source[rows]].T

    def _set_free(self, p, time):
        which = self.prescribed(p)
        rows = p.inflow_row[which]
        for k, source in enumerate(self.sources):
            passed = source.way(time) - source.way(self._time[rows]) >= source.strip
            stopped = time >= source.times[-1] or source.at(time, source.discharge) == 0.0
            p.inflow_row[which[(self._source[rows] == k) & (passed | stopped)]] = FREE

    def _add(self, p, surface, columns, row, time):
        """Add the particles of one row (its number) to `p` at their places at `time` [s], with new columns."""
        material, source = columns.material, self.sources[self._source[row]]
        direction = self.directions[self._source[row]]
        count, thickness, volume = self._count[row], self._thickness[row], self._each[row]
        # neighbouring rows are shifted by half a particle; no row reaches past the ends of the line
        share = (np.arange(count) + (0.5 if count == 1 else (0.25, 0.75)[self._place[row] % 2])) / count
        x, y = source.start[:, None] + share * (source.end - source.start)[:, None]
        fall = direction @ surface.sample(x, y)[1:3]
        step = (source.way(time) - source.way(self._time[row])) / np.sqrt(1.0 + fall**2)
        x, y = x + step * direction[0], y + step * direction[1]
        below = surface.sample(x, y)
        slant = np.sqrt(1.0 + below.slope_x**2 + below.slope_y**2)
        load = material.buoyant_density * material.gravity * thickness / slant
        ratio = material.initial_pressure_ratio
        if source.hydrograph.pressure_ratio is not None:
            ratio = source.at(self._time[row], *source.hydrograph.series("pressure_ratio"))
        profile = initial_profile(
            load, p.levels, ratio, material.initial_pressure_profile, material.basal_layer_fraction
        )  # fmt: skip
        least = THICKNESS_RANGE * source.hydrograph.largest_thickness
        length = _smoothing_length(volume, thickness, least)
        for phase, part in columns.phases.phase_fractions:
            borne = load if phase == MIXTURE else np.zeros(count)
            new = p.append(
                count, x=x, y=y, z=below.elevation, phase=phase, share=part, volume=part * volume,
                released_volume=part * volume, depth=thickness * slant, thickness=thickness,
                own_thickness=part * thickness, least_thickness=part * least, smoothing_length=length,
                next_smoothing_length=length, liquefaction_pressure=borne,
                excess_pore_pressure=profile if phase == MIXTURE else 0.0, porosity=material.porosity,
                porosity_before=material.porosity, density=material.density, inflow_row=row,
            )  # fmt: skip
            _start_columns(p, new, borne, columns)


def _start_columns(p, new: slice, load, columns: ColumnPhysics) -> None:
    """Tell the column law of the new columns of `p[new]`, with their `load`, shape (n,) [Pa]."""
    p.basal_excess_pore_pressure[new] = p.excess_pore_pressure[new, 0]
    forcing = forcing_at_rest(
        p.volume[new],
        p.thickness[new],
        load,
        base=BaseContact.IMPERMEABLE,
        coefficient_of_consolidation=columns.phases.coefficient_of_consolidation(p, new),
        water_to_buoyant=columns.water_to_buoyant,
    )
    if is_dilatant(columns.law):
        forcing = forcing._replace(shearing=shearing_of(columns.material, np.zeros_like(load), load))
    columns.law.advance(column_state(p, new), forcing, 0.0, p.basal_excess_pore_pressure[new])


def _smoothing_length(volume, thickness, least):
    return SMOOTHING_RATIO * np.sqrt(volume / np.maximum(thickness, least))
