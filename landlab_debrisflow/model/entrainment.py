"""Entrainment: the soil that a flow asks of the bed and takes.

A particle asks for soil, and gets it, where it is in the middle of the step: halfway along its drift. Soil taken where
the step begins would lie half a step too far back, and make erosion of first order in the time step wherever the ground
changes: at an edge of erodible soil by half a step of travel.
"""

import numpy as np

from ..core.jit import allocating_kernel, kernel
from ..core.threads import over_particles
from ..physics.bed_state import SATURATED_BED, BedState
from ..physics.contracts import is_jump_condition
from ..spatial.raster import CORE, nearest_node
from .basal import BasalLaw, basal_state
from .bed_load import load_bed
from .mixing import Erosion, Layer, Mixture, Soil, mix

EROSION_TIME = 0.5
"""Time within a step at which soil is taken, and the bed below it loaded, over the length of the step: the middle makes
erosion second-order."""


def entrain(
    p, exchange, bed, erosion: BasalLaw, phases, prescribed, resistance, time: float, dt: float, threads: int = 1
):
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
    threads : int
        Number of threads.

    Returns
    -------
    ndarray, shape (awake,)
        Velocity after over velocity before [-].
    """
    bearing, material = phases.bearing(p), erosion.material
    x, y = p.x, p.y
    if bed.soil is not None:
        x, y = _go(x, y, p.velocity, tuple(bed.raster), EROSION_TIME * dt, p.nearest_node[: p.awake])
        if bed.pore_pressure is not None:  # soil at the front brings the pressure that the front has made there
            load_bed(p, bed, material, time + EROSION_TIME * dt, EROSION_TIME * dt, bed.footprints(p, x, y))
    rate = np.zeros(bearing.stop)
    demanded = np.empty(rate.size)

    def ask_some(which: slice) -> None:
        erosion.law.entrainment_rate(_erosion_state(p, which, bed, erosion, resistance), rate[which])

    over_particles(ask_some, rate.size, threads)
    if prescribed.size:
        rate[prescribed[prescribed < rate.size]] = 0.0
    phases.limit_entrainment(exchange, rate)
    entrained, ratio = p.entrained_volume[bearing], p.entrained_ratio[bearing]
    if _demand(rate, p.volume, p.depth, p.share, dt, demanded) and bed.soil is not None:
        bed.erode(bed.footprints(p, x, y), demanded, out=(entrained, ratio))
        if bed.saturation is not None:
            dry_pores(p, bed, material)
    else:
        entrained[:] = ratio[:] = 0.0
    # the friction of the flow already contains the momentum of soil that a jump condition gives: as if it slipped along
    slip_ratio = 1.0 if is_jump_condition(erosion.law) else material.basal_slip_ratio
    soil = Soil(
        solid_fraction=phases.solid_fraction, slip_ratio=slip_ratio, porosity=material.soil_porosity,
        solid_density=material.solid_density, bearing_density=material.bearing_density,
    )  # fmt: skip
    velocity_ratio = np.empty(p.awake)
    velocity_ratio[rate.size :] = 1.0

    def mix_some(which: slice) -> None:
        layer = Layer(
            depth=p.depth, thickness=p.thickness, share=p.share, cosine=p.cos_slope,
            coefficient_of_consolidation=phases.coefficient_of_consolidation(p, which),
        )  # fmt: skip
        mixture = Mixture(volume=p.volume, porosity=p.porosity, density=p.density)
        erosion_record = Erosion(
            rate=p.entrainment_rate, first_time=p.first_erosion_time, peclet_number=p.basal_peclet_number
        )
        place = which.start, which.stop
        mix(*place, p.entrained_volume, soil, layer, mixture, erosion_record, time, dt, velocity_ratio)

    over_particles(mix_some, rate.size, threads)
    phases.share_entrained(p, exchange)
    return velocity_ratio


def _erosion_state(p, bearing: slice, bed, erosion: BasalLaw, resistance):
    """Return the base under particles `p[bearing]` as a law reads it, a `BasalState`; arguments as in `entrain`."""
    yield_stress, drag = resistance
    nodes = p.nearest_node[bearing]
    return basal_state(
        p, bearing, erosion, eroded_depth=bed.eroded_in_event(nodes),
        resistance=(yield_stress[bearing], drag[bearing]), bed=_bed_state(bed, nodes),
    )  # fmt: skip


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
def _demand(rate, volume, depth, share, dt, demanded):
    """Write the volume of soil that particles demand in a step, shape (m,) [m3]; return whether any demands soil.

    Parameters
    ----------
    rate : ndarray, shape (m,)
        Erosion rate per map area that the first m particles ask for [m s-1].
    volume, depth, share : ndarray, shape (n,)
        Volume [m3], depth of the flow [m] and fraction of the own phase [-] of all particles.
    dt : float
        Length of the step [s].
    demanded : ndarray, shape (m,)
        Written [m3].
    """
    for i in range(rate.size):
        demanded[i] = rate[i] * volume[i] / (depth[i] * share[i])
    found = False
    for i in range(rate.size):
        demanded[i] *= dt
        found |= demanded[i] != 0.0
    return found


@allocating_kernel
def _go(x, y, velocity, raster, time, nearest):
    """Return places of particles after straight ways for a time [s], shape (2, n) [m], none outside of core nodes.

    Parameters
    ----------
    x, y : ndarray, shape (n,)
        Position of the particles, of which the first m move; the others stay [m].
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
    place = np.empty((2, x.size))
    for i in range(x.size):
        place[0, i], place[1, i] = x[i], y[i]
    for i in range(nearest.size):
        new_x, new_y = x[i] + time * velocity[0, i], y[i] + time * velocity[1, i]
        node = nearest_node(new_x, new_y, dx, dy, columns, rows)
        if node >= 0 and status[node] == CORE:
            place[0, i], place[1, i], nearest[i] = new_x, new_y, node
    return place
