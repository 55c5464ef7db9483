"""The event: clock, loop, release, rest and settling."""

import numpy as np

from ..core.errors import SimulationError
from ..physics.column.initial import initial_profile
from ..terrain.bed import Bed
from . import activity, step
from .basal import held_at_rest
from .bed_load import load_bed
from .column_forcing import present_profiles
from .deposit import resting_depth
from .diagnostics import Diagnostics
from .inflow.inflow import Inflow
from .particles import Particles
from .phases.one_phase import OnePhaseDynamics
from .phases.two_phase import TwoPhaseDynamics
from .release.origins import Origins
from .release.release import release_particles
from .rest import Bodies
from .schedule import RunListener
from .state import State
from .surroundings import Surroundings, surround
from .variables import particle_variables

FIRST_SWEEPS = 8
"""Passes that make thickness and smoothing length agree after a release."""


class Simulation:
    """A flow: its state, and the change of this state in time.

    Parameters
    ----------
    setup : Setup
        Laws, material and numerics.
    inflow : Inflow, optional
        Inflow to come; by default none.

    Attributes
    ----------
    state : State
        All that changes in a run, except the bed; replaced by an earlier copy to undo steps.
    surroundings : Surroundings or None
        Inputs of the call; None before the first one.
    phases : Phases
        Stages of a step that depend on the number of phases.
    """

    def __init__(self, setup, inflow: Inflow | None = None):
        self.setup, flow, column = setup, setup.flow, setup.column
        self.phases = OnePhaseDynamics(setup.material, column)
        if setup.two_phases:
            self.phases = TwoPhaseDynamics(flow, setup.material, column.stores_pressure)
        laws = (flow, setup.friction, setup.erosion, column, self.phases)
        particles = Particles(column.levels, particle_variables(column, laws))
        self.state = State(particles, inflow or Inflow())
        self.surroundings: Surroundings | None = None

    @property
    def particles(self) -> Particles:
        """The moving mass."""
        return self.state.particles

    @property
    def bed(self) -> Bed | None:
        """Bed of the call, or of the last one; None before the first one."""
        return None if self.surroundings is None else self.surroundings.bed

    @property
    def inflow(self) -> Inflow:
        """Inflow so far and to come."""
        return self.state.inflow

    @property
    def time(self) -> float:
        """Time now [s]."""
        return self.state.time

    @property
    def diagnostics(self) -> Diagnostics:
        """Cost of the run so far."""
        return self.state.counters.diagnostics

    def set_bed(self, bed: Bed, parameters, changed: bool = True) -> None:
        """Put the flow on a bed for the call that follows.

        Parameters
        ----------
        bed : Bed
            Ground below the flow.
        parameters : mapping of str to NamedTuple
            For friction and erosion those parameters of the law that may vary in space (`core.parameters.on_nodes`).
        changed : bool
            Whether the terrain has changed since the last call.
        """
        self.surroundings = surround(self.setup, self.phases, bed, parameters)
        self.state.outdated |= changed
        if changed:
            self.set_free()
        load_bed(self.particles, bed, self.setup.material, self.time)

    def begin(self, bed: Bed, given, listener: RunListener) -> None:
        """Put the flow on a bed and make particles of the release of a `GridInput`, which was taken off the bed."""
        self.set_bed(bed, given.parameters, given.terrain.changed)
        if given.release.nodes.size:
            self.release(given.release.nodes, given.release.depth, given.release.velocity)
        listener.begun()

    def run(self, bed: Bed, given, end: float, stop_at_rest: bool, listener: RunListener) -> bool:
        """Begin on a bed and advance to `end` [s]; parameters and return value as of `begin` and `advance`."""
        self.begin(bed, given, listener)
        if not (stop_at_rest and self.at_rest):
            self.start(end)
            listener.started(self.idle)
        return self.advance(end, stop_at_rest, listener)

    def release(self, nodes, depth, velocity=None) -> None:
        """Turn failing ground into particles on the bed below.

        Parameters
        ----------
        nodes : ndarray of int
            Where it fails.
        depth : ndarray
            Vertical thickness that fails there [m].
        velocity : ndarray, shape (2, n), optional
            Velocity over the map along x and y with which it fails [m s-1]; by default it is at rest.
        """
        state, p, material, bed = self.state, self.particles, self.setup.material, self.bed
        new = release_particles(p, state.origins, nodes, depth, bed, self.phases, self.setup.numerics, velocity)
        self._refresh(FIRST_SWEEPS)
        load_bed(p, bed, material, self.time)
        p.excess_pore_pressure[new] = initial_profile(
            p.liquefaction_pressure[new], p.levels, material.initial_pressure_ratio, material.initial_pressure_profile,
            material.basal_layer_fraction,
        )  # fmt: skip
        p.basal_excess_pore_pressure[new] = p.excess_pore_pressure[new, 0]
        self._consolidate(0.0)
        state.bodies.separate(p)
        state.control.restart()

    def _refresh(self, sweeps: int = 1) -> None:
        """Find bed, thickness and forces anew, in `sweeps` passes, after a release or a change of the terrain."""
        state, p, phases, near = self.state, self.particles, self.phases, self.surroundings
        setup = self.setup
        activity.wake_all(p, state.time, near.columns)
        p.entrained_volume[:], p.entrained_ratio[:] = 0.0, 0.0
        step.sample_bed(p, near.bed, self.setup.material.gravity)
        p.still_steps[:] = 0
        for _ in range(sweeps):
            step.interact(
                p, state.exchange, setup.flow, setup.numerics, near.columns, state.inflow, near.walls, state.time
            )
        self._find_limits()
        # no soil was entrained: this only notes the porosity, which the flow has not changed
        phases.share_entrained(p, state.exchange)
        state.outdated = False

    def _find_limits(self) -> None:
        state, near = self.state, self.surroundings
        state.limits = step.find_limits(self.particles, self.phases, near, state.time)

    def _consolidate(self, dt: float) -> None:
        prescribed = self.inflow.prescribed(self.particles)
        step.consolidate(self.particles, self.state.exchange, self.surroundings.columns, prescribed, dt)

    @property
    def idle(self) -> bool:
        """Whether nothing moves now (also when there is nothing)."""
        return self.particles.count == 0 or self.state.bodies.at_rest

    @property
    def at_rest(self) -> bool:
        """Whether the flow is at rest and no inflow is to come."""
        return self.idle and self.inflow.over

    def start(self, end: float) -> None:
        """Prepare the first step of a call that goes until `end` [s]."""
        self.idle_until(end)
        if self.particles.count:
            self._find_limits()

    def advance(self, end: float, stop_at_rest: bool = False, listener: RunListener | None = None) -> bool:
        """Advance until exactly `end` [s], until rest, or until the listener interrupts.

        Parameters
        ----------
        end : float
            [s]
        stop_at_rest : bool
            Return as soon as all is at rest; `time` tells when.
        listener : RunListener, optional
            Called after every step; it may end the advance before the next one.

        Returns
        -------
        bool
            True if all is done; False if it was interrupted: another advance to the same end goes on to the bit.
        """
        state = self.state
        while self.time < end and not self.at_rest:
            if listener is not None and listener.interrupted():
                return False
            if self.idle:
                self.idle_until(end)
                continue
            began, left = self.time, end - self.time
            dt = self._next_step(left)
            if self.time + dt == self.time:
                raise SimulationError("time step", None, self.time, dt)
            step.advance(self, dt)
            state.time = end if dt == left else state.time + dt
            state.counters.count(self.particles, dt)
            self._let_rest()
            if listener is not None:
                listener.stepped(began, self.time, self.idle)
        if not stop_at_rest and self.time < end:
            self._pass_time(end)
        return True

    def _let_rest(self) -> None:
        """Let particles that lie still fall asleep, and arrest bodies that have come to rest in the last step."""
        state, p = self.state, self.particles
        due = state.counters.steps % activity.STEPS_BETWEEN_CHECKS == 0
        if self.phases.sleeps and due and p.count:
            near = self.surroundings
            activity.fall_asleep(p, state.time, near.columns, near.friction, state.exchange, near.walls)
        rest_energy, gravity = self.setup.numerics.rest_energy, self.setup.material.gravity
        most_unheld = state.bodies.judge(p, rest_energy, gravity, state.time)
        if most_unheld is not None:
            awake = slice(p.awake)
            held = self.held_at_rest(awake, p.basal_excess_pore_pressure[awake])
            state.bodies.arrest(p, most_unheld, held, state.inflow.prescribed(p))

    def catch_up(self) -> None:
        """Bring the columns of particles asleep to the present."""
        activity.catch_up(self.particles, self.time, self.surroundings.columns)

    def idle_until(self, end: float) -> None:
        """While nothing moves, let time pass until `end` [s] or until something flows in."""
        self._refresh_if_outdated()
        if self.idle and self.time < end:
            self._pass_time(max(self.time, min(end, self.inflow.next_time)))
            p, state = self.particles, self.state
            if self.inflow.enter(p, self.bed.surface, self.surroundings.columns, self.time):
                state.outdated = True
                state.bodies.separate(p)
                self._refresh_if_outdated()
                self.inflow.prescribe_velocity(p, self.time)

    def _refresh_if_outdated(self) -> None:
        if self.state.outdated and self.particles.count:
            self._refresh()

    def _pass_time(self, end: float) -> None:
        """Let time pass for a flow at rest: its pore pressure still drains."""
        p = self.particles
        if p.count:
            p.entrained_volume[: p.awake], p.entrained_ratio[: p.awake] = 0.0, 0.0
            self._consolidate(end - self.time)
        self.state.time = end

    def _next_step(self, left: float) -> float:
        limits = self.state.limits
        longest = self.state.control.longest(limits.longest_step, limits.energy)
        longest = min(longest, self.inflow.latest(self.time) - self.time)
        if left <= longest:
            return left
        # two steps of equal length at the end, instead of a very short last one
        return 0.5 * left if left <= 2.0 * longest else longest

    def held_at_rest(self, which: slice, pressure):
        """Return which particles friction would hold at rest under some basal excess pore pressure [Pa], shape (n,)."""
        near, exchange = self.surroundings, self.state.exchange
        return held_at_rest(self.particles, which, pressure, near.friction, self.phases, exchange, near.walls)

    def set_free(self) -> None:
        """Set arrested particles free."""
        self.state.bodies.set_free(self.particles)

    def resting_depth(self):
        """Return nodes and the depth of particles that lie still on them [m]."""
        return resting_depth(self.particles, self.state.origins, self.bed)

    def columns_now(self):
        """Return the excess pore pressure at all levels, brought to the present, shape (n, levels) [Pa]."""
        if (p := self.particles).count == 0:  # the flow may have no bed yet
            return p.excess_pore_pressure
        return present_profiles(p, slice(p.count), self.surroundings.columns)

    def settle(self):
        """Lay the mass into the bed and forget the particles; return nodes and the depth laid on each [m]."""
        p, state = self.particles, self.state
        state.settled_solid += float(self.phases.solid_volume(p).sum())
        nodes, depth = self.resting_depth()
        self.bed.lay_down(nodes, depth)
        p.keep(np.zeros(p.count, bool))
        state.origins, state.bodies = Origins(), Bodies()
        return nodes, depth
