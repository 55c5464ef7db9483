"""One time step, as a list of stages that reads like the governing equations.

Kick - erode and drift - kick, symmetric in time, hence second-order: the forces at the end of a step
are those at the beginning of the next. Only the first ``particles.awake`` particles are advanced; ground and
neighbours are looked at for all, to notice who must wake (sleep.py).
"""

import numpy as np

from ..core.errors import SimulationError
from ..core.jit import kernel
from ..physics.contracts import (
    BasalState,
    BaseContact,
    ColumnForcing,
    ColumnState,
    FlowState,
    MixtureState,
)
from ..spatial.cells import sort_into_cells
from ..spatial.summation import SMOOTHING_RATIO, Sums
from . import activity, bed_load
from .kinematics import basal_state, count_still_steps, disturb, drift, follow_ground, stop_at_walls
from .time_step import survey, viscous_share
from .walls import mirror

STEPS_TO_SLEEP = 4
"""Steps after which what did not change (`kinematics.STILL`) is left out of the sums over neighbours: the
smoothing length has then settled."""

BY_EROSION = np.array([BaseContact.BY_EROSION], np.int8)
"""What columns stand on where nothing is drained."""

NO_SOURCE = np.zeros(1)
"""Pressure by a change of porosity [Pa s-1]: one phase has none."""


NOT_ASKED = np.zeros(1)
"""What friction laws get for the depth eroded [m]: to look it up takes time."""


def advance(sim, dt: float) -> None:
    """Advance the simulation by one step of `dt` seconds."""
    friction_and_kick(sim, 0.5 * dt)
    sim.inflow.hold(sim, sim.time + 0.5 * dt)
    dilution = entrain(sim, dt)
    move(sim, dt, dilution)
    sim.inflow.enter(sim, sim.time + dt)
    find_ground(sim, dt)
    interact(sim)
    activity.wake(sim, activity.disturbed(sim))
    bed_load.press(sim, dt)
    consolidate(sim, dt)
    friction_and_kick(sim, 0.5 * dt)
    sim.inflow.hold(sim, sim.time + dt)
    check(sim, dt)
    if sim.walled:
        sim.stopped.count(sim.particles, sim.time + dt)


def friction_and_kick(sim, dt: float) -> None:
    """Gravity along the bed, thrust and basal resistance, taken implicitly."""
    p, nodes = sim.particles, sim.bed.nodes
    m = p.awake
    yield_stress, drag = np.empty(m), np.empty(m)
    sim.physics.friction.basal_resistance(base(sim, slice(m), "friction"), yield_stress, drag)
    sim.matter.kick(sim, p.velocity, yield_stress, drag, p.rest_speed[:m], dt)
    if sim.walled:
        stop_at_walls(
            m, p.x, p.y, p.velocity, sim.ground, nodes.dx, nodes.dy, nodes.columns, sim.status, 2.0 * dt, p.touched_wall
        )


def entrain(sim, dt: float):
    """Ask soil of the bed, take what it grants; return velocity after over velocity before."""
    p, material = sim.particles, sim.physics.material
    m = p.awake
    rate, wanted, dilution = np.zeros(m), np.empty(m), np.empty(m)
    sim.physics.erosion.entrainment_rate(base(sim, slice(m), "erosion"), rate)
    rate[sim.inflow.held(p)] = 0.0
    sim.matter.refuse_soil(rate)
    np.divide(rate * p.volume[:m], p.depth[:m] * p.share[:m], out=wanted)
    wanted *= dt
    sim.granted, sim.granted_ratio = sim.bed.erode(p.x[:m], p.y[:m], p.spread[:m], wanted)
    _take_up(
        sim.granted, sim.matter.own_part, dt, sim.time, sim.matter.coefficient_of_consolidation(p, slice(m)),
        material.basal_slip_ratio,
        material.soil_porosity, material.solid_density, material.bearing_density, p.depth, p.thickness, p.share,
        sim.cosine, p.volume, p.porosity, p.density, p.entrainment_rate, p.first_erosion_time, p.basal_peclet_number,
        dilution,
    )  # fmt: skip
    sim.matter.take_up(sim)
    return dilution


@kernel
def _take_up(
    granted, own_part, dt, time, coefficient_of_consolidation, slip_ratio, soil_porosity, solid_density,
    bearing_density, depth, thickness, share, cosine, volume, porosity, density, entrainment_rate, first_erosion_time,
    basal_peclet_number, dilution,
):  # fmt: skip
    """Mix in the soil; what is not at the base already at the speed of the base is sped up by the flow.

    What is granted becomes what the own phase takes of it. d(v)/dt = - (v - v_b) dm/dt / m with v_b = `slip_ratio` v,
    so v goes like m^(slip_ratio - 1), m being the mass.
    """
    for i in range(granted.size):
        rate, before = granted[i] * depth[i] * share[i] / (volume[i] * dt), volume[i]
        entrainment_rate[i] = rate
        dilution[i] = 1.0
        if granted[i] > 0.0:
            soil = granted[i]
            granted[i] = own_part * soil
            volume[i] = before + granted[i]
            dilution[i] = before / volume[i]
            if porosity[i] != soil_porosity:
                whole, was = before / share[i], density[i]
                porosity[i] = (porosity[i] * whole + soil_porosity * soil) / (whole + soil)
                density[i] = (1.0 - porosity[i]) * solid_density + porosity[i] * bearing_density
                if own_part == 1.0:
                    dilution[i] *= was / density[i]
            if slip_ratio > 0.0:
                dilution[i] **= 1.0 - slip_ratio
            # as `column.peclet.basal_peclet_number`, without its arrays: this is done in every step
            coefficient = coefficient_of_consolidation[min(i, coefficient_of_consolidation.size - 1)]
            basal_peclet_number[i] = rate * cosine[i] * thickness[i] / coefficient
            if np.isnan(first_erosion_time[i]):
                first_erosion_time[i] = time


def move(sim, dt: float, dilution) -> None:
    """Drift along the bed; those over an open boundary are taken out and counted."""
    p, nodes = sim.particles, sim.bed.nodes
    left, sim.owed = np.empty(p.awake, np.int64), np.empty(p.awake)
    if sim.granted.any():  # the bed below has sunk: that is no fall of the flow
        p.z[: p.awake] = sim.bed.surface.sample(p.x[: p.awake], p.y[: p.awake])[0]
    drift(
        p.x, p.y, p.z, p.velocity, dilution, nodes.dx, nodes.dy, nodes.columns, sim.status, dt, sim.owed, left,
        p.touched_wall,
    )  # fmt: skip
    if left.size and left.min() < NOWHERE:
        place = int(np.argmin(left))
        raise SimulationError("velocity", int(p.identity[place]), sim.time, float(p.velocity[:, place].sum()))
    gone = np.flatnonzero(left >= 0)
    if gone.size:
        sim.outflow.count(left[gone], p.volume[gone], sim.matter.solid_volume(p)[gone])
        support = 2.0 * p.smoothing_length
        disturb(p.x, p.y, support, p.x[gone], p.y[gone], support[gone], p.still_steps)
        stay = np.ones(p.count, bool)
        stay[gone] = False
        stayed = stay[: p.awake]
        sim.granted, sim.granted_ratio, sim.owed = sim.granted[stayed], sim.granted_ratio[stayed], sim.owed[stayed]
        p.keep(stay)


NOWHERE = -1
"""What `drift` calls the node over which a particle left that did not leave; less for one that is not a number."""


def find_ground(sim, dt: float = 0.0) -> None:
    """Read the terrain under all particles and turn their velocities into its tangent plane, after a drift or not."""
    p, before = sim.particles, sim.particles.z.copy() if dt == 0.0 else None
    sim.ground, sim.cosine = sim.bed.surface.sample(p.x, p.y), np.empty(p.count)
    owed = sim.owed if dt > 0.0 else np.empty(0)
    follow_ground(sim.ground, p.velocity, sim.cosine, p.z, owed, sim.physics.material.gravity, dt)
    if dt == 0.0:  # nothing has moved but the ground: that is neither rise nor fall of the flow
        p.lowest_z += p.z - before
    np.minimum(p.lowest_z, p.z, out=p.lowest_z)
    sim.node = sim.bed.nodes.nearest(p.x, p.y)
    count_still_steps(p.x, p.y, p.z, p.volume, p.smoothing_length, p.anchor, p.anchor_volume, p.still_steps)


def interact(sim) -> None:
    """Sum over neighbours: slope-normal thickness, which the smoothing length follows, and thrust."""
    p, material, numerics = sim.particles, sim.physics.material, sim.numerics
    if p.count == 0:
        sim.computed = np.zeros(0, bool)
        return
    longest, light = SMOOTHING_RATIO * np.sqrt(p.volume / p.least_thickness), p.light
    np.copyto(longest, p.usual_length, where=light)
    mixture = MixtureState(p.share, p.cross_term, p.mean_excess_pore_pressure)
    state = FlowState(
        p.x, p.y, p.z, p.velocity, p.volume, p.smoothing_length, longest,
        p.own_thickness, p.thickening, p.gradient_term, sim.cosine, p.density, p.phase, p.share, p.cross_term,
        p.mean_excess_pore_pressure, material.gravity, material, mixture,
    )  # fmt: skip
    changed = p.still_steps < STEPS_TO_SLEEP
    if sim.walled:
        state, changed = mirror(state, changed, sim.bed.nodes, sim.status, p.touched_wall)
    cells = sort_into_cells(state.x, state.y, 2.0 * state.smoothing_length, changed)
    sim.computed = cells.computed[: p.count]
    activity.catch_up(sim, activity.disturbed(sim))  # under the thickness they slept under
    sums = Sums(p.own_thickness, p.gradient_term, p.next_smoothing_length, p.thrust, p.thickening)
    parts = sim.physics.flow.interact(state, cells, numerics.shock_viscosity, numerics.threads, sums)
    sim.inflow.hold_thickness(p, sim.matter.parts)
    sim.matter.found(p, parts)
    p.smoothing_length[:] = p.next_smoothing_length
    np.copyto(p.smoothing_length, p.usual_length, where=light)
    np.divide(p.thickness, sim.cosine, out=p.depth)
    np.multiply(p.thickness, sim.cosine, out=p.liquefaction_pressure)
    p.liquefaction_pressure *= (p.density - material.bearing_density) * material.gravity


def consolidate(sim, dt: float) -> None:
    """Advance the pore-pressure columns with what the flow did to them."""
    p = sim.particles
    awake = slice(p.awake)
    forced = sim.matter.force(sim, forcing(sim, awake, sim.granted, sim.granted_ratio), dt)
    sim.physics.column.advance(columns(p, awake), forced, dt, p.basal_excess_pore_pressure[awake])
    sim.matter.follow(sim, forced, dt)


def check(sim, dt: float = 0.0) -> None:
    """Look at the whole after a step of some length; raise SimulationError if anything that moves is not finite."""
    p, nodes = sim.particles, sim.bed.nodes
    sim.survey = survey(
        p, sim.computed, sim.cosine, sim.physics.material.gravity,
        sim.numerics.courant_number * viscous_share(sim.numerics.shock_viscosity), min(nodes.dx, nodes.dy),
        sim.matter.celerity_squared(sim, dt),
    )  # fmt: skip
    if (place := sim.survey.broken) >= 0:
        for name in ("velocity", "thrust", "thickness", "basal_excess_pore_pressure"):
            value = float(getattr(p, name)[..., place].sum())
            if not np.isfinite(value):
                raise SimulationError(name, int(p.identity[place]), sim.time, value)


def columns(p, which: slice) -> ColumnState:
    """Return some particles' arrays as the column law knows them."""
    return ColumnState(p.excess_pore_pressure[which], p.column_memory[which], p.column_clipped[which])


def forcing(sim, which: slice, granted, granted_ratio) -> ColumnForcing:
    """Return what the last step did to some columns; `granted` and its ratio are theirs."""
    p, material = sim.particles, sim.physics.material
    load = p.liquefaction_pressure[which]
    bed_pressure, bases = granted_ratio * load, BY_EROSION
    if sim.bed.drained is not None:
        drained = sim.bed.drained[sim.node[which]]
        bed_pressure[drained] = 0.0
        bases = np.where(drained, BaseContact.PRESCRIBED, BaseContact.BY_EROSION).astype(np.int8)
    return ColumnForcing(
        p.volume[which], p.thickness[which], load, granted, bed_pressure, bases,
        NO_SOURCE, sim.matter.coefficient_of_consolidation(p, which),
        material.bearing_density / material.buoyant_density, True,
    )  # fmt: skip


def held(sim, which: slice, pressure):
    """Return which particles friction would hold at rest under some basal excess pore pressure, shape (n,) [Pa]."""
    yield_stress, drag = np.empty((2, pressure.size))
    sim.physics.friction.basal_resistance(base(sim, which, "friction", pressure), yield_stress, drag)
    return sim.matter.held(sim, which, yield_stress, drag)


def base(sim, which: slice, kind: str, pressure=None) -> BasalState:
    """Return the base under some particles as a law of some kind knows it, by default under the `pressure` there is."""
    p, material, nodes = sim.particles, sim.physics.material, sim.bed.nodes
    depth, thickness, density = p.depth[which], p.thickness[which], p.density[which]
    pressure = p.basal_excess_pore_pressure[which] if pressure is None else pressure
    speed, normal_gravity, stress = np.empty((3, depth.size))
    basal_state(
        which.start or 0, p.velocity, sim.ground, sim.cosine, material.gravity, min(nodes.dx, nodes.dy),
        thickness, density, material.bearing_density, pressure, speed, normal_gravity, stress,
    )  # fmt: skip
    parameters = sim.parameters[kind]
    eroded_depth = sim.bed.eroded_in_event(sim.node[which]) if kind == "erosion" else NOT_ASKED
    here = (values if values.size == 1 else values[sim.node[which]] for values in parameters)
    return BasalState(
        depth, thickness, speed, normal_gravity, stress, p.liquefaction_pressure[which], pressure, density,
        eroded_depth, material.gravity, material.basal_slip_ratio, type(parameters)(*here),
    )  # fmt: skip
