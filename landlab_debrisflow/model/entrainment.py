"""Entrainment: the soil that a flow asks of the bed, takes, and mixes in.

A particle asks for soil, and gets it, where it is in the middle of the step: halfway along its drift. Soil taken where
the step begins would lie half a step too far back, and make erosion of first order in the time step wherever the ground
changes: at an edge of erodible soil by half a step of travel.
"""

from typing import NamedTuple

import numpy as np

from ..core.arrays import value_at
from ..core.jit import kernel
from ..core.structs import struct
from ..physics.bed_state import SATURATED_BED, BedState
from ..physics.contracts import is_jump_condition
from ..spatial.raster import CORE, nearest_node
from .basal import BasalLaw, basal_state


@struct
class Soil(NamedTuple):
    """Soil that a flow takes up.

    Attributes
    ----------
    solid_fraction : float
        Part of its volume that a particle of grains keeps [-].
    slip_ratio : float
        Velocity at which it enters, over that of the flow [-].
    porosity : float
        Porosity of the soil [-].
    solid_density : float
        Density of its grains [kg m-3].
    bearing_density : float
        Density of the water in its pores [kg m-3].
    """

    solid_fraction: float
    slip_ratio: float
    porosity: float
    solid_density: float
    bearing_density: float


@struct
class Layer(NamedTuple):
    """Flow over the bed, at n particles.

    Attributes
    ----------
    depth : ndarray, shape (n,)
        Vertical depth [m].
    thickness : ndarray, shape (n,)
        Slope-normal thickness [m].
    share : ndarray, shape (n,)
        Fraction of the thickness that belongs to the particle's own phase [-].
    cosine : ndarray, shape (n,)
        Cosine of the slope of the bed [-].
    coefficient_of_consolidation : ndarray, shape (n,) or (1,)
        c_v [m2 s-1].
    """

    depth: np.ndarray
    thickness: np.ndarray
    share: np.ndarray
    cosine: np.ndarray
    coefficient_of_consolidation: np.ndarray


@struct
class Mixture(NamedTuple):
    """Matter of n particles, changed in place.

    Attributes
    ----------
    volume : ndarray, shape (n,)
        Volume of the particle [m3].
    porosity : ndarray, shape (n,)
        Pores over the whole [-].
    density : ndarray, shape (n,)
        Density of the mixture [kg m-3].
    """

    volume: np.ndarray
    porosity: np.ndarray
    density: np.ndarray


@struct
class Erosion(NamedTuple):
    """Record of the erosion by n particles, written in place.

    Attributes
    ----------
    rate : ndarray, shape (n,)
        Erosion rate per map area [m s-1].
    first_time : ndarray, shape (n,)
        Time of the first erosion [s]; NaN before.
    peclet_number : ndarray, shape (n,)
        Basal Péclet number of the last erosion [-].
    """

    rate: np.ndarray
    first_time: np.ndarray
    peclet_number: np.ndarray


EROSION_TIME = 0.5
"""Time within a step at which soil is taken, over the length of the step: the middle makes it second-order."""


def entrain(p, exchange, bed, erosion: BasalLaw, phases, prescribed, resistance, time: float, dt: float):
    """Take soil from the bed into the particles that are awake.

    Parameters
    ----------
    p : Particles
        All particles, before their drift; their nearest nodes become those of the middle of the step.
    exchange : Exchange
        State of the exchange between grains and water.
    bed : Bed
        Ground below the flow.
    erosion : BasalLaw
        Law of erosion and its parameters.
    phases : Phases
        Stages of a step that depend on the number of phases.
    prescribed : ndarray of int
        Particles whose motion is prescribed: these take no soil.
    resistance : tuple of ndarray, shape (awake,)
        Yield stress [Pa] and drag [Pa s m-1] of the friction law in this step.
    time, dt : float
        Beginning and length of the step [s].

    Returns
    -------
    ndarray, shape (awake,)
        Velocity after over velocity before [-].
    """
    bearing, material = phases.bearing(p), erosion.material
    x, y = p.x.copy(), p.y.copy()
    if bed.soil is not None:
        _go(x, y, p.velocity, bed.raster, EROSION_TIME * dt, p.nearest_node[: p.awake])
    rate = np.zeros(bearing.stop)
    demanded = np.empty(rate.size)
    erosion.law.entrainment_rate(_erosion_state(p, bearing, bed, erosion, resistance), rate)
    rate[prescribed[prescribed < rate.size]] = 0.0
    phases.limit_entrainment(exchange, rate)
    np.divide(rate * p.volume[bearing], p.depth[bearing] * p.share[bearing], out=demanded)
    demanded *= dt
    p.entrained_volume[bearing] = p.entrained_ratio[bearing] = 0.0
    if bed.soil is not None and demanded.any():
        footprints = bed.footprints(p, x, y)
        p.entrained_volume[bearing], p.entrained_ratio[bearing] = bed.erode(footprints, demanded)
        if bed.saturation is not None:
            dry_pores(p, bed, material)
    # the friction of the flow already contains the momentum of soil that a jump condition gives: as if it slipped along
    slip_ratio = 1.0 if is_jump_condition(erosion.law) else material.basal_slip_ratio
    soil = Soil(
        solid_fraction=phases.solid_fraction, slip_ratio=slip_ratio, porosity=material.soil_porosity,
        solid_density=material.solid_density, bearing_density=material.bearing_density,
    )  # fmt: skip
    layer = Layer(
        depth=p.depth, thickness=p.thickness, share=p.share, cosine=p.cos_slope,
        coefficient_of_consolidation=phases.coefficient_of_consolidation(p, bearing),
    )  # fmt: skip
    mixture = Mixture(volume=p.volume, porosity=p.porosity, density=p.density)
    erosion_record = Erosion(
        rate=p.entrainment_rate, first_time=p.first_erosion_time, peclet_number=p.basal_peclet_number
    )
    velocity_ratio = np.ones(p.awake)
    velocity_ratio[bearing] = _mix(p.entrained_volume[bearing], soil, layer, mixture, erosion_record, time, dt)
    phases.share_entrained(p, exchange)
    return velocity_ratio


def _erosion_state(p, bearing: slice, bed, erosion: BasalLaw, resistance):
    """Return the base under particles `p[bearing]` as a law reads it, a `BasalState`; arguments as in `entrain`."""
    yield_stress, drag = resistance
    nodes = p.nearest_node[bearing]
    state = basal_state(p, bearing, erosion, eroded_depth=bed.eroded_in_event(nodes))
    shear = yield_stress[bearing] + drag[bearing] * state.speed
    return state._replace(stress=state.stress._replace(shear=shear), bed=_bed_state(bed, nodes))


def _bed_state(bed, nodes) -> BedState:
    """Return the pore water of the bed at `nodes`, an array of int of shape (n,), for laws of erosion."""
    saturations = SATURATED_BED.saturations if bed.saturation is None else bed.saturation
    return BedState(bed.pressure_ratio, saturations, bed.drained, nodes)


def dry_pores(p, bed, material) -> None:
    """Lower the pressure ratio of entrained soil by the part of its pores that holds air.

    Of hydrostatic and excess pressure of the pore water a bed bears the part S, its degree of saturation (Bishop,
    1959). Above the hydrostatic pressure of the flow this is S r_b p_liq - (1 - S) rho_w g h_n cos(theta).

    Parameters
    ----------
    p : Particles
        All particles; the ratio of the soil that those awake have entrained is changed [-].
    bed : Bed
        Ground below the flow, with a degree of saturation.
    material : Material
        Densities.
    """
    taken = np.flatnonzero(p.entrained_volume[: p.awake])
    saturation = _bed_state(bed, p.nearest_node[taken]).degree_of_saturation
    water_to_buoyant = material.bearing_density / material.buoyant_density
    p.entrained_ratio[taken] = saturation * p.entrained_ratio[taken] - (1.0 - saturation) * water_to_buoyant


@kernel
def _go(x, y, velocity, raster, time, nearest):
    """Move points along straight ways for a time [s], in place, unless they end outside of core nodes.

    Parameters
    ----------
    x, y : ndarray, shape (n,)
        Position of the particles, of which the first m move [m].
    velocity : ndarray, shape (3, n)
        Their velocity [m s-1].
    raster : Raster
        Nodes, their statuses and spacing [m].
    time : float
        Duration of the motion [s].
    nearest : ndarray of int, shape (m,)
        Node nearest to each, changed in place.
    """
    status, columns, rows, dx, dy, _ = raster
    for i in range(nearest.size):
        new_x, new_y = x[i] + time * velocity[0, i], y[i] + time * velocity[1, i]
        node = nearest_node(new_x, new_y, dx, dy, columns, rows)
        if node >= 0 and status[node] == CORE:
            x[i], y[i], nearest[i] = new_x, new_y, node


@kernel
def _mix(entrained, soil, layer, mixture, erosion, time, dt):
    """Add entrained soil to the matter of particles, in place.

    The soil enters with the basal velocity v_b = `slip_ratio` v, and the flow accelerates it to v:
    d(v)/dt = - (v - v_b) dm/dt / m, so v goes like m^(slip_ratio - 1), m being the mass.

    Parameters
    ----------
    entrained : ndarray, shape (m,)
        Soil taken by the m particles that bear on the bed; changed to the volume that their own phase keeps [m3].
    soil : Soil
        Soil that the flow takes up.
    layer : Layer
        Flow over the bed, at n particles.
    mixture : Mixture
        Matter of the n particles, changed in place.
    erosion : Erosion
        Record of the erosion, written in place.
    time, dt : float
        Beginning and length of the step [s].

    Returns
    -------
    ndarray, shape (m,)
        Velocity after over velocity before [-].
    """
    solid_fraction, slip_ratio, soil_porosity, solid_density, bearing_density = soil
    depth, thickness, share, cosine, coefficient_of_consolidation = layer
    volume, porosity, density = mixture
    erosion_rate, first_time, peclet_number = erosion
    velocity_ratio = np.empty(entrained.size)
    for i in range(entrained.size):
        rate, before = entrained[i] * depth[i] * share[i] / (volume[i] * dt), volume[i]
        erosion_rate[i] = rate
        velocity_ratio[i] = 1.0
        if entrained[i] > 0.0:
            taken = entrained[i]
            entrained[i] = solid_fraction * taken
            volume[i] = before + entrained[i]
            velocity_ratio[i] = before / volume[i]
            if porosity[i] != soil_porosity:
                whole, old_density = before / share[i], density[i]
                porosity[i] = (porosity[i] * whole + soil_porosity * taken) / (whole + taken)
                density[i] = (1.0 - porosity[i]) * solid_density + porosity[i] * bearing_density
                if solid_fraction == 1.0:
                    velocity_ratio[i] *= old_density / density[i]
            if slip_ratio > 0.0:
                velocity_ratio[i] **= 1.0 - slip_ratio
            # as `column.diagnostics.basal_peclet_number`, without its arrays: this is done in every step
            peclet_number[i] = rate * cosine[i] * thickness[i] / value_at(coefficient_of_consolidation, i)
            if np.isnan(first_time[i]):
                first_time[i] = time
    return velocity_ratio
