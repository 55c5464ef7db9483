"""The event: clock, loop, release, rest and settling."""

import numpy as np

from ..core.errors import SimulationError
from ..physics.column.initial import initial_profile
from ..terrain.bed import Bed
from . import activity, bed_load, step
from .inflow.source import Inflow
from .kinematics import CLOSED
from .numerics import Numerics
from .outflow import Outflow
from .particles import Particles
from .phases.one_phase import Single
from .phases.two_phase import Mixture
from .release.origins import Origins
from .release.release import release_particles
from .rest import Rest
from .stopped import Stopped
from .time_step import Pace
from .variables import particle_variables

FIRST_SWEEPS = 8
"""Passes that make thickness and smoothing length agree after a release."""


class Simulation:
    """All that moves, and when.

    Parameters
    ----------
    physics : Setup
        Laws and material.
    numerics : Numerics
    inflow : Inflow, optional
    """

    def __init__(self, physics, numerics: Numerics, inflow: Inflow | None = None):
        self.physics, self.numerics, self.inflow = physics, numerics, inflow or Inflow()
        self.matter = Mixture(physics) if physics.two_phases else Single(physics)
        laws = (physics.flow, physics.friction, physics.erosion, physics.column, self.matter)
        self.particles = Particles(physics.column.levels, particle_variables(physics.column, laws))
        self.origins = Origins()
        self.time = 0.0
        self.outflow, self.settled_solid = Outflow(), 0.0  # the latter: grains laid into the bed so far [m3]
        self.rest = Rest()
        self.stopped = Stopped()
        self._changed = True  # terrain or particles are new: neighbours and forces must be found again
        self.bed = self.status = self.parameters = None
        self.walled = False  # whether there are closed nodes
        # what the stages of a step hand on to each other, per particle (model/step.py)
        self.ground = self.cosine = self.survey = None
        self.computed = np.zeros(0, bool)  # whose sums over neighbours were done in this step
        self.granted = self.granted_ratio = np.zeros(0)
        self.owed = np.zeros(0)
        self.node = np.zeros(0, int)  # the nearest one
        self._steps, self._pace = 0, Pace()

    def on(self, bed: Bed, status, parameters, changed: bool) -> None:
        """Put the simulation on a bed for the call that follows.

        Parameters
        ----------
        bed : Bed
        status : ndarray, shape (nodes,)
            Node statuses as Landlab numbers them.
        parameters : mapping of str to NamedTuple
            For every kind of law those of its parameters that may vary in space (`core.parameters.on_nodes`).
        changed : bool
            Whether the terrain differs from what the last call left.
        """
        self.bed, self.status, self.parameters = bed, status, parameters
        self.walled = bool(np.any(status == CLOSED))
        self._changed |= changed
        if changed:
            self.rest.set_free(self.particles)
        bed_load.press(self)

    def begin(self, bed: Bed, given, listener) -> None:
        """Put the simulation on a bed and make particles of what fails.

        Parameters
        ----------
        bed : Bed
            The ground after it has failed.
        given : GridInput
            Terrain, release and parameters of laws, as plain arrays (`grid/read.py`).
        listener : object
            Its `begun()` is called at the end.
        """
        self.on(bed, given.terrain.status, given.parameters, given.terrain.changed)
        if given.release.nodes.size:
            self.release(given.release.nodes, given.release.depth)
        listener.begun()

    def run(self, bed: Bed, given, end: float, stop_at_rest: bool, listener) -> bool:
        """Begin on a bed and advance, as `begin` and `advance`; call `listener.started(idle)` before the first step."""
        self.begin(bed, given, listener)
        if not (stop_at_rest and self.at_rest):
            self.start(end)
            listener.started(self.idle)
        return self.advance(end, stop_at_rest, listener)

    def extent(self) -> tuple[float, float]:
        """Return least and largest y of what may change the ground in a step [m]; nothing: the first is larger."""
        y, raster = self.particles.y, self.bed.nodes
        ends = [(y.min(), y.max())] if y.size else []
        if nodes := self.origins.span:  # to which may return what never moved
            ends.append((nodes[0] // raster.columns * raster.dy, nodes[1] // raster.columns * raster.dy))
        ends += [source.y_range for source in self.inflow.sources if not self.inflow.over]
        return min((a for a, _ in ends), default=np.inf), max((b for _, b in ends), default=-np.inf)

    def release(self, nodes, depth) -> None:
        """Turn failing ground into particles at rest on the bed below.

        Parameters
        ----------
        nodes : ndarray of int
            Where it fails.
        depth : ndarray
            Vertical thickness that fails there [m].
        """
        p, material = self.particles, self.physics.material
        new = release_particles(self, nodes, depth)
        self._find_everything(FIRST_SWEEPS)
        bed_load.press(self)
        load = p.liquefaction_pressure[new]
        p.excess_pore_pressure[new] = initial_profile(
            load, p.levels, material.initial_pressure_ratio, material.initial_pressure_profile,
            material.basal_layer_fraction,
        )  # fmt: skip
        p.basal_excess_pore_pressure[new] = p.excess_pore_pressure[new, 0]
        step.consolidate(self, 0.0)
        self.rest.look(p)
        self._pace.restart()

    def _find_everything(self, sweeps: int = 1) -> None:
        """Find ground, thickness and forces anew where particles or terrain changed by other hands."""
        p = self.particles
        activity.wake_all(self)
        self.granted, self.granted_ratio = np.zeros((2, p.count))
        step.find_ground(self)
        p.still_steps[:] = 0
        for _ in range(sweeps):
            step.interact(self)
        step.check(self)
        self.matter.take_up(self)  # nothing; and what the porosity is now, it is not by the flow
        self._changed = False

    @property
    def idle(self) -> bool:
        """Whether nothing moves now (also when there is nothing)."""
        return self.particles.count == 0 or self.rest.all

    @property
    def at_rest(self) -> bool:
        """Whether nothing moves, and nothing will flow in."""
        return self.idle and self.inflow.over

    def start(self, end: float) -> None:
        """Get ready for the first step of a call that goes until `end` [s]."""
        self.wait(end)
        if self.particles.count:
            step.check(self)

    def advance(self, end: float, stop_at_rest: bool = False, listener=None) -> bool:
        """Advance until exactly `end` [s], or until rest, or until somebody interrupts.

        Parameters
        ----------
        end : float
            [s]
        stop_at_rest : bool
            Return as soon as all is at rest; `time` tells when.
        listener : object, optional
            Before every step `interrupted()` is called, and ends the advance if it returns True; after every step
            `stepped(began, time, idle)`, with the times of its two ends [s] and whether nothing moves any more.

        Returns
        -------
        bool
            True if all is done; False if it was interrupted: another advance to the same end goes on to the bit.
        """
        while self.time < end and not self.at_rest:
            if listener is not None and listener.interrupted():
                return False
            if self.idle:
                self.wait(end)
                continue
            began, left = self.time, end - self.time
            dt = self._next_step(left)
            if self.time + dt == self.time:
                raise SimulationError("time step", None, self.time, dt)
            step.advance(self, dt)
            self.time = end if dt == left else self.time + dt
            self._steps += 1
            if self.matter.sleeps and self._steps % activity.STEPS_BETWEEN_LOOKS == 0 and self.particles.count:
                activity.fall_asleep(self)
            self.rest.judge(self)
            if listener is not None:
                listener.stepped(began, self.time, self.idle)
        if not stop_at_rest and self.time < end:
            self._pass_time(end)
        return True

    def catch_up(self) -> None:
        """Bring the columns of particles asleep to the present."""
        activity.catch_up(self)

    def wait(self, end: float) -> None:
        """While nothing moves, let time pass until `end` [s] or until something flows in."""
        self._wake()
        if self.idle and self.time < end:
            self._pass_time(max(self.time, min(end, self.inflow.next_time)))
            if self.inflow.enter(self, self.time):
                self._changed = True
                self.rest.look(self.particles)
                self._wake()
                self.inflow.hold(self, self.time)

    def _wake(self) -> None:
        """Find everything anew if terrain or particles have changed."""
        if self._changed and self.particles.count:
            self._find_everything()

    def _pass_time(self, end: float) -> None:
        """Let time pass for what is at rest: its pore pressure still drains."""
        if self.particles.count:
            self.granted, self.granted_ratio = np.zeros((2, self.particles.awake))
            step.consolidate(self, end - self.time)
        self.time = end

    def _next_step(self, left: float) -> float:
        longest = self._pace.longest(self.survey.longest_step, self.survey.energy)
        longest = min(longest, self.inflow.latest(self.time) - self.time)
        if left <= longest:
            return left
        return 0.5 * left if left <= 2.0 * longest else longest  # no sliver for the last step

    def held(self, which: slice, pressure):
        """Return which particles friction would hold at rest under some basal excess pore pressure [Pa], shape (n,)."""
        return step.held(self, which, pressure)

    def set_free(self) -> None:
        """Let what was arrested move again."""
        self.rest.set_free(self.particles)

    def resting_depth(self):
        """Return nodes and the depth of particles that lie still on them [m]."""
        p = self.particles
        still = ~np.any(p.velocity, axis=0) & (p.volume > 0.0)
        if not still.any():
            return np.empty(0, np.int64), np.empty(0)
        x, y, spread, volume, origin = p.x[still], p.y[still], p.spread[still], p.volume[still], p.origin[still]
        back = self.origins.unmoved(origin, x, y, 0.5 * spread, self.bed.nodes.core)
        nodes, depth = self.bed.depth_of(x, y, spread, (1.0 - back) * volume)
        returning = back > 0.0
        old, given = self.origins.returned(origin[returning], (back * volume)[returning])
        every, place = np.unique(np.concatenate([nodes, old]), return_inverse=True)
        return every, np.bincount(place, np.concatenate([depth, given / self.bed.nodes.area]), every.size)

    def columns_now(self):
        """Return the excess pore pressure at all levels, brought to the present, shape (n, levels) [Pa]."""
        now = self.particles
        if now.count == 0:  # also before there is a bed
            return now.excess_pore_pressure
        self.particles = now.copy()  # looking must not change how a law keeps its columns
        try:
            none, every = np.zeros(now.count), slice(now.count)
            state = step.columns(self.particles, every)
            self.physics.column.synchronise(state, step.forcing(self, every, none, none))
            return state.profile
        finally:
            self.particles = now

    def settle(self):
        """Lay the mass into the bed and forget the particles.

        Returns
        -------
        nodes : ndarray of int
            Nodes that received material.
        depth : ndarray
            Depth laid on each [m].
        """
        p = self.particles
        self.settled_solid += float(self.matter.solid_volume(p).sum())
        nodes, depth = self.resting_depth()
        self.bed.lay_down(nodes, depth)
        p.keep(np.zeros(p.count, bool))
        self.origins, self.rest = Origins(), Rest()
        return nodes, depth
