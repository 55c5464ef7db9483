"""One time step, as a list of stages that reads like the governing equations.

Kick - erode and drift - kick, symmetric in time, hence second-order: the forces at the end of a step
are those at the beginning of the next.
"""

import numpy as np

from ..core.errors import SimulationError
from ..physics.column.peclet import basal_peclet_number
from ..physics.contracts import BASE_BY_EROSION, BASE_PRESCRIBED, BasalState, ColumnForcing, ColumnState, FlowState
from ..spatial.cells import sort_into_cells
from ..spatial.summation import SMOOTHING_RATIO, sum_thickness
from .motion import basal_state, count_still_steps, drift, kick, stop_at_walls, turn

STEPS_TO_SLEEP = 4
"""Steps after which what did not change (`motion.STILL`) is left out of the sums over neighbours: the
smoothing length has then settled."""

BY_EROSION = np.array([BASE_BY_EROSION], np.int8)
"""What columns stand on where nothing is drained."""

NO_SOURCE = np.zeros(1)
"""Pressure by a change of porosity [Pa s-1]: one phase has none."""


def advance(sim, dt: float) -> None:
    """Advance the simulation by one step of `dt` seconds."""
    friction_and_kick(sim, 0.5 * dt)
    dilution = entrain(sim, dt)
    move(sim, dt, dilution)
    sim.inflow.enter(sim, sim.time + dt)
    find_ground(sim)
    find_depth(sim)
    consolidate(sim, dt)
    push(sim)
    friction_and_kick(sim, 0.5 * dt)
    sim.inflow.hold(sim, sim.time + dt)
    check(sim)


def friction_and_kick(sim, dt: float) -> None:
    """Gravity along the bed, thrust and basal resistance, taken implicitly."""
    p, material = sim.particles, sim.physics.material
    yield_stress, drag = np.empty(p.count), np.empty(p.count)
    sim.physics.friction.basal_resistance(_base(sim), yield_stress, drag)
    mass = material.density * p.thickness
    kick(p.velocity, p.thrust, sim.ground, sim.cosine, yield_stress, drag, mass, material.gravity, sim.rest_speed, dt)
    nodes = sim.bed.nodes
    stop_at_walls(
        p.x, p.y, p.velocity, sim.ground, nodes.dx, nodes.dy, nodes.columns, sim.status, 2.0 * dt, p.touched_wall
    )


def entrain(sim, dt: float):
    """Ask soil of the bed, take what it grants; return volume before over volume after."""
    p = sim.particles
    p.entrainment_rate[:] = 0.0
    sim.physics.erosion.entrainment_rate(_base(sim), p.entrainment_rate)
    p.entrainment_rate[sim.inflow.held(p)] = 0.0
    wanted = p.entrainment_rate * p.volume / p.depth * dt
    sim.granted, sim.granted_ratio = sim.bed.erode(p.x, p.y, p.spread, wanted)
    p.entrainment_rate[:] = sim.granted * p.depth / (p.volume * dt)
    p.first_erosion_time[(sim.granted > 0.0) & np.isnan(p.first_erosion_time)] = sim.time
    before = p.volume.copy()
    p.volume += sim.granted
    return before / p.volume


def move(sim, dt: float, dilution) -> None:
    """Drift along the bed; those over an open boundary are taken out and counted."""
    p, nodes = sim.particles, sim.bed.nodes
    left = np.empty(p.count, np.int64)
    drift(p.x, p.y, p.velocity, dilution, nodes.dx, nodes.dy, nodes.columns, sim.status, dt, left, p.touched_wall)
    check(sim)
    gone = left >= 0
    if gone.any():
        sim.count_outflow(left[gone], p.volume[gone])
        p.keep(~gone)
        p.still_steps[:] = 0  # those beside it have lost a neighbour, and may be asleep
        sim.granted, sim.granted_ratio = sim.granted[~gone], sim.granted_ratio[~gone]


def find_ground(sim) -> None:
    """Read the terrain under the particles and turn their velocities into its tangent plane."""
    p = sim.particles
    sim.ground = sim.bed.surface.sample(p.x, p.y)
    sim.cosine = 1.0 / np.sqrt(1.0 + sim.ground[1] ** 2 + sim.ground[2] ** 2)
    p.z[:] = sim.ground[0]
    sim.drained = sim.bed.is_drained(p.x, p.y)
    turn(p.velocity, sim.ground, sim.cosine)
    count_still_steps(p.x, p.y, p.z, p.volume, p.smoothing_length, p.anchor, p.anchor_volume, p.still_steps)


def find_depth(sim) -> None:
    """Sum the slope-normal thickness over neighbours; the smoothing length follows it."""
    p, material = sim.particles, sim.physics.material
    if p.count == 0:
        return
    sim.cells = sort_into_cells(p.x, p.y, 2.0 * p.smoothing_length, p.still_steps < STEPS_TO_SLEEP)
    longest = SMOOTHING_RATIO * np.sqrt(p.volume / p.least_thickness)
    sum_thickness(
        sim.cells, p.x, p.y, p.z, p.volume, p.smoothing_length, longest,
        (p.thickness, p.gradient_term, p.next_smoothing_length), sim.numerics.threads,
    )  # fmt: skip
    sim.inflow.hold_thickness(p)
    p.depth[:] = p.thickness / sim.cosine
    p.liquefaction_pressure[:] = material.buoyant_density * material.gravity * p.thickness * sim.cosine


def consolidate(sim, dt: float) -> None:
    """Advance the pore-pressure columns with what the flow did to them."""
    p, material = sim.particles, sim.physics.material
    c_v = material.coefficient_of_consolidation
    sim.physics.column.advance(columns(p), forcing(sim), dt, p.basal_excess_pore_pressure)
    eroding = sim.granted > 0.0
    peclet = basal_peclet_number(p.entrainment_rate[eroding] * sim.cosine[eroding], p.thickness[eroding], c_v)
    p.basal_peclet_number[eroding] = peclet


def push(sim) -> None:
    """Thrust: the acceleration by the flow's own pressure."""
    p, numerics = sim.particles, sim.numerics
    if p.count == 0:
        return
    state = FlowState(
        p.x, p.y, p.z, p.velocity, p.volume, p.thickness, p.smoothing_length, p.gradient_term, sim.cosine,
        sim.physics.material.gravity,
    )  # fmt: skip
    sim.physics.flow.thrust(state, sim.cells, numerics.shock_viscosity, numerics.threads, p.thrust, p.thickening)
    p.smoothing_length[:] = p.next_smoothing_length


def check(sim) -> None:
    """Raise SimulationError if anything that moves is not finite."""
    for name in ("velocity", "thickness", "basal_excess_pore_pressure"):
        values = getattr(sim.particles, name)
        if not np.isfinite(values.sum()):
            bad = ~np.isfinite(values)
            particle = int(np.nonzero(bad)[-1][0]) if bad.any() else 0
            raise SimulationError(name, particle, sim.time, float(values[..., particle].sum()))


def columns(p) -> ColumnState:
    """Return the particles' arrays as the column law knows them."""
    return ColumnState(p.excess_pore_pressure, p.column_memory, p.column_clipped)


def forcing(sim) -> ColumnForcing:
    """Return what the last step did to the columns."""
    p, material = sim.particles, sim.physics.material
    bed_pressure, base = sim.granted_ratio * p.liquefaction_pressure, BY_EROSION
    if sim.drained is not None:
        bed_pressure[sim.drained] = 0.0
        base = np.where(sim.drained, BASE_PRESCRIBED, BASE_BY_EROSION).astype(np.int8)
    return ColumnForcing(
        p.volume, p.thickness, p.liquefaction_pressure, sim.granted, bed_pressure, base,
        NO_SOURCE, np.array([material.coefficient_of_consolidation]),
        material.water_density / material.buoyant_density, True,
    )  # fmt: skip


def _base(sim) -> BasalState:
    p, material, nodes = sim.particles, sim.physics.material, sim.bed.nodes
    speed, normal_gravity, liquefaction = np.empty(p.count), np.empty(p.count), np.empty(p.count)
    basal_state(
        p.velocity, sim.ground, sim.cosine, p.thickness, material.gravity, material.buoyant_density,
        min(nodes.dx, nodes.dy), speed, normal_gravity, liquefaction,
    )  # fmt: skip
    return BasalState(
        p.depth, p.thickness, speed, normal_gravity, liquefaction, p.basal_excess_pore_pressure,
        material.density, material.buoyant_density, material.gravity,
    )  # fmt: skip
