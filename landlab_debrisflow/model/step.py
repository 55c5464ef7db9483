"""One time step, as a list of stages that reads like the governing equations.

Kick - erode and drift - kick, symmetric in time, hence second-order: the forces at the end of a step
are those at the beginning of the next. Only the first ``particles.awake`` particles are advanced; the bed below and
changed neighbours are examined for all particles, to find those that must wake (activity.py).
"""

import numpy as np

from ..core.errors import SimulationError
from ..core.threads import over_particles
from ..physics.contracts import FlowState, MixtureState, MixtureSums, Position, Smoothing
from ..spatial.cells import sort_into_cells
from ..spatial.raster import Raster
from ..spatial.summation import SMOOTHING_RATIO, Sums
from . import activity, entrainment
from .basal import BasalLaw, basal_resistance
from .bed_load import load_bed
from .column_forcing import ColumnPhysics, column_forcing, column_state, forcing_of, present_profiles
from .entrainment import entrain
from .kinematics import NOWHERE, Place, drift, follow_bed, stop_at_walls
from .layer import Layer, follow_thickness
from .stillness import count_still_steps, disturb
from .surroundings import Surroundings
from .time_step import StepLimits, reduce_particles
from .walls import ghost_particles

STEPS_TO_SLEEP = 4
"""Number of steps without change (`stillness.STILL`) after which a particle is left out of the sums over neighbours:
its smoothing length has then converged."""

NO_RESISTANCE = np.empty(0), np.empty(0)
"""Yield stress and drag of no particles."""

KICK, ENTRAINMENT, DRIFT, SUMMATION, COLUMNS, LIMITS = range(6)
"""Places of the stages in `diagnostics.STAGES`."""


def advance(simulation, dt: float) -> None:
    """Advance the simulation by one step of `dt` seconds."""
    state, phases, setup = simulation.state, simulation.phases, simulation.setup
    p, exchange, inflow, end = state.particles, state.exchange, state.inflow, state.time + dt
    bed, walls, friction, erosion, columns, _ = simulation.surroundings
    material, threads = setup.material, setup.numerics.threads
    clock = state.counters.clock()
    resistance = friction_and_kick(p, exchange, friction, phases, walls, 0.5 * dt, threads)
    inflow.prescribe_velocity(p, state.time + 0.5 * dt)
    clock.lap(KICK)
    prescribed = inflow.prescribed(p)
    velocity_ratio = entrain(p, exchange, bed, erosion, phases, prescribed, resistance, state.time, dt, threads)
    clock.lap(ENTRAINMENT)
    move(p, bed, velocity_ratio, state.outflow, phases, state.time, dt, threads)
    inflow.enter(p, bed.surface, columns, end)
    sample_bed(p, bed, material.gravity, dt, threads)
    clock.lap(DRIFT)
    interact(p, exchange, setup.flow, setup.numerics, columns, inflow, walls, state.time)
    activity.wake(p, activity.disturbed(p))
    clock.lap(SUMMATION)
    load_bed(p, bed, material, end, dt if bed.soil is None else (1.0 - entrainment.EROSION_TIME) * dt)
    consolidate(p, exchange, columns, inflow.prescribed(p), dt, threads)
    clock.lap(COLUMNS)
    friction_and_kick(p, exchange, friction, phases, walls, 0.5 * dt, threads)
    inflow.prescribe_velocity(p, end)
    clock.lap(KICK)
    state.limits = find_limits(p, phases, simulation.surroundings, state.time, dt, threads)
    if walls is not None:
        state.stopped.count(p, end)
    clock.lap(LIMITS)


def friction_and_kick(p, exchange, friction: BasalLaw, phases, walls: Raster | None, dt: float, threads: int = 1):
    """Accelerate by gravity along the bed, pressure and basal resistance (implicit in time).

    Returned are yield stress [Pa] and drag [Pa s m-1] of the friction law, each of shape (awake,).

    `p` are the particles, whose velocities of the awake ones are changed [m s-1]; `exchange` is the state of the
    exchange between phases; `walls` is None where no node is closed; `dt` is in s; `threads` is the number of threads.
    """
    if p.count == 0:  # all particles have left in this step, and the partners are still those of before
        return NO_RESISTANCE
    yield_stress, drag = np.zeros((2, p.awake))

    def resist(which: slice) -> None:
        basal_resistance(p, which, friction, out=(yield_stress[which], drag[which]))

    over_particles(resist, phases.bearing(p).stop, threads)
    phases.kick(p, exchange, p.velocity, yield_stress, drag, p.rest_speed[: p.awake], dt, threads)
    if walls is not None:
        stop_at_walls(p.x, p.y, p.velocity, p.surface_sample, tuple(walls), 2.0 * dt, p.touched_wall[: p.awake])
    return yield_stress, drag


def move(p, bed, velocity_ratio, outflow, phases, time: float, dt: float, threads: int = 1) -> None:
    """Drift along the bed; particles over an open boundary are taken out and counted.

    Parameters
    ----------
    p : Particles
        All particles.
    bed : Bed
        Ground below the flow.
    velocity_ratio : ndarray, shape (awake,)
        Velocity after over velocity before entrainment [-].
    outflow : Outflow
        Volumes that have left [m3].
    phases : Phases
        Stages of a step that depend on the number of phases.
    time, dt : float
        Beginning and length of the step [s].
    threads : int
        Number of threads.

    Raises
    ------
    SimulationError
        If a position is not a number.
    """
    eroded, position, exit_node = p.entrained_volume[: p.awake].any(), (p.x, p.y, p.z), np.empty(p.awake, np.int64)
    raster = tuple(bed.raster)

    def drift_some(which: slice) -> bool:
        if eroded:  # the bed is lower: the flow does not gain energy by this fall
            bed.surface.elevation_into(p.x[which], p.y[which], p.z[which])
        return drift(
            which.start, position, p.velocity, velocity_ratio[which], raster, dt, p.expected_elevation,
            p.touched_wall, exit_node[which],
        )  # fmt: skip

    p.departed = None
    if not any(over_particles(drift_some, p.awake, threads)):
        return
    if exit_node.min() == NOWHERE:
        place = int(np.argmin(exit_node))
        raise SimulationError("velocity", int(p.identity[place]), time, float(p.velocity[:, place].sum()))
    gone = np.flatnonzero(exit_node >= 0)
    p.departed = p.at(gone)
    outflow.count(exit_node[gone], p.volume[gone], phases.solid_volume(p)[gone])
    support = 2.0 * p.smoothing_length
    disturb(p.x, p.y, support, p.x[gone], p.y[gone], support[gone], p.still_steps)
    stay = np.ones(p.count, bool)
    stay[gone] = False
    p.keep(stay)


def sample_bed(p, bed, gravity: float, dt: float = 0.0, threads: int = 1) -> None:
    """Read the terrain under all particles and turn their velocities into its tangent plane, after a drift or not.

    `bed` is the `Bed` of the call, `gravity` is in m s-2; `dt` is the duration of the drift [s], 0 if nothing drifted:
    then only the bed has changed. Written are elevation, cosine, nearest node and velocity of the particles `p`.
    `threads` is the number of threads.
    """
    sample = np.empty(p.count), *p.surface_sample[1:]  # p.z itself is updated by `follow_bed`
    place = Place(
        x=p.x, y=p.y, z=p.z, cosine=p.cos_slope, lowest_z=p.lowest_z, nearest_node=p.nearest_node,
        expected_elevation=p.expected_elevation,
    )  # fmt: skip
    raster, position, reference = tuple(bed.raster), (p.x, p.y, p.z), (p.reference_position, p.reference_volume)

    def sample_some(which: slice) -> None:
        bed.surface.sample_into(p.x[which], p.y[which], tuple(values[which] for values in sample))
        follow_bed(which.start, which.stop, sample, p.velocity, place, raster, gravity, dt)
        count_still_steps(which.start, which.stop, position, p.volume, p.smoothing_length, *reference, p.still_steps)

    over_particles(sample_some, p.count, threads)


def interact(p, exchange, flow, numerics, columns: ColumnPhysics, inflow, walls: Raster | None, time: float) -> None:
    """Sum over neighbours: slope-normal thickness, which the smoothing length follows, and thrust.

    Parameters
    ----------
    p : Particles
        All particles.
    exchange : Exchange
        State of the exchange between grains and water.
    flow : FlowLaw
        Law of the flow.
    numerics : Numerics
        Threads, shock viscosity and other numerical choices.
    columns : ColumnPhysics
        Law, material and boundary of the columns.
    inflow : Inflow
        Inflow to come.
    walls : Raster or None
        None: no node is closed.
    time : float
        Time to which the columns of particles that wake are advanced [s].
    """
    if p.count == 0:
        return
    material, phases = columns.material, columns.phases
    state, changed = _flow_state(p, material), p.still_steps < STEPS_TO_SLEEP
    if walls is not None:
        state, changed = ghost_particles(state, changed, walls, p.touched_wall)
    cells = sort_into_cells(state.position.x, state.position.y, 2.0 * state.smoothing.length, changed)
    p.summed[:] = cells.computed[: p.count]
    activity.catch_up(p, time, columns, activity.disturbed(p))  # under the thickness of the time asleep
    sums = Sums(
        thickness=p.own_thickness,
        gradient_term=p.gradient_term,
        next_length=p.next_smoothing_length,
        acceleration=p.thrust,
        convergence=p.thickening,
    )
    cells_of_phases = flow.interact(state, cells, numerics.shock_viscosity, numerics.threads, sums)
    inflow.prescribe_thickness(p, phases.phase_fractions)
    phases.after_summation(p, exchange, cells_of_phases)
    layer = Layer(
        thickness=p.thickness, cosine=p.cos_slope, density=p.density, light=p.light, usual_length=p.usual_length,
        next_length=p.next_smoothing_length, smoothing_length=p.smoothing_length, depth=p.depth,
        liquefaction_pressure=p.liquefaction_pressure,
    )  # fmt: skip
    follow_thickness(layer, material.bearing_density, material.gravity)


def _flow_state(p, material) -> FlowState:
    """Return the particles as the flow law sees them, without ghosts.

    `p` are the particles, n; `material` has densities [kg m-3] and gravity [m s-2].
    """
    longest, mixture = SMOOTHING_RATIO * np.sqrt(p.volume / p.least_thickness), None
    np.copyto(longest, p.usual_length, where=p.light)
    if hasattr(p, "cross_term"):
        found = MixtureSums(p.share, p.cross_term, p.mean_excess_pore_pressure)
        mixture = MixtureState(p.phase, *found, material, found)
    return FlowState(
        position=Position(p.x, p.y, p.z),
        velocity=p.velocity,
        volume=p.volume,
        smoothing=Smoothing(p.smoothing_length, longest, p.gradient_term),
        thickness=p.own_thickness,
        thickening=p.thickening,
        cos_slope=p.cos_slope,
        density=p.density,
        gravity=material.gravity,
        mixture=mixture,
    )


def consolidate(p, exchange, columns: ColumnPhysics, prescribed, dt: float, threads: int = 1) -> None:
    """Advance the pore-pressure columns by the forcing of the step.

    `p` are the particles, `exchange` is the state of the exchange between phases; `prescribed` are the places of
    particles whose motion is given in an inflow strip; `dt` is in s; `threads` is the number of threads.
    """
    phases = columns.phases
    bearing = phases.bearing(p)
    forcing = column_forcing(p, bearing, columns, p.entrained_volume[bearing], p.entrained_ratio[bearing])
    forcing = phases.column_forcing(p, forcing, prescribed, dt)

    def advance_some(which: slice) -> None:
        base = p.basal_excess_pore_pressure[which]
        columns.law.advance(column_state(p, which), forcing_of(forcing, which), dt, base)

    over_particles(advance_some, bearing.stop, threads)
    phases.update_mean_pressure(p, exchange, forcing, lambda: present_profiles(p, bearing, columns), dt)


def find_limits(p, phases, surroundings: Surroundings, time: float, dt: float = 0.0, threads: int = 1) -> StepLimits:
    """Return the limits of the next step, after one of `dt` seconds that began at `time` [s].

    `p` are the particles, `phases` gives the stiffness beside weight; `dt` is 0 before the first step; `threads` is the
    number of threads.

    Raises
    ------
    SimulationError
        If the position or velocity of a particle is not finite.
    """
    stiff = phases.celerity_squared(p, dt)
    gravity = surroundings.friction.material.gravity
    ground = surroundings.bed.surface, surroundings.walls
    limits = reduce_particles(p, gravity, surroundings.step_rule, stiff, ground, threads)
    if (place := limits.broken) >= 0:
        for name in ("velocity", "thrust", "thickness", "basal_excess_pore_pressure"):
            value = float(getattr(p, name)[..., place].sum())
            if not np.isfinite(value):
                raise SimulationError(name, int(p.identity[place]), time, value)
    return limits
