"""Entrainment: the soil that a flow asks of the bed, takes, and mixes in."""

import numpy as np

from ..core.jit import kernel
from .basal import BasalLaw, basal_state


def entrain(p, exchange, bed, erosion: BasalLaw, phases, prescribed, time: float, dt: float):
    """Take soil from the bed into the particles that are awake.

    Parameters
    ----------
    p : Particles
    exchange : Exchange
    bed : Bed
    erosion : BasalLaw
    phases : Phases
    prescribed : ndarray of int
        Particles whose motion is prescribed: they take nothing.
    time, dt : float
        Beginning and length of the step [s].

    Returns
    -------
    ndarray, shape (awake,)
        Velocity after over velocity before [-].
    """
    awake, material = slice(p.awake), erosion.material
    rate, demanded, velocity_ratio = np.zeros(p.awake), np.empty(p.awake), np.empty(p.awake)
    eroded_depth = bed.eroded_in_event(p.nearest_node[awake])
    erosion.law.entrainment_rate(basal_state(p, awake, erosion, eroded_depth=eroded_depth), rate)
    rate[prescribed] = 0.0
    phases.limit_entrainment(exchange, rate)
    np.divide(rate * p.volume[awake], p.depth[awake] * p.share[awake], out=demanded)
    demanded *= dt
    entrained, p.entrained_ratio[awake] = bed.erode(p.x[awake], p.y[awake], p.spread[awake], demanded)
    p.entrained_volume[awake] = entrained
    _mix(
        p.entrained_volume[awake], phases.solid_fraction, dt, time, phases.coefficient_of_consolidation(p, awake),
        material.basal_slip_ratio, material.soil_porosity, material.solid_density, material.bearing_density, p.depth,
        p.thickness, p.share, p.cos_slope, p.volume, p.porosity, p.density, p.entrainment_rate, p.first_erosion_time,
        p.basal_peclet_number, velocity_ratio,
    )  # fmt: skip
    phases.share_entrained(p, exchange)
    return velocity_ratio


@kernel
def _mix(
    entrained, solid_fraction, dt, time, coefficient_of_consolidation, slip_ratio, soil_porosity, solid_density,
    bearing_density, depth, thickness, share, cosine, volume, porosity, density, entrainment_rate, first_erosion_time,
    basal_peclet_number, velocity_ratio,
):  # fmt: skip
    """Add the entrained soil [m3], in place, and replace it by the volume that the particle's own phase takes.

    The soil enters with the basal velocity v_b = `slip_ratio` v, and the flow accelerates it to v:
    d(v)/dt = - (v - v_b) dm/dt / m, so v goes like m^(slip_ratio - 1), m being the mass.
    """
    for i in range(entrained.size):
        rate, before = entrained[i] * depth[i] * share[i] / (volume[i] * dt), volume[i]
        entrainment_rate[i] = rate
        velocity_ratio[i] = 1.0
        if entrained[i] > 0.0:
            soil = entrained[i]
            entrained[i] = solid_fraction * soil
            volume[i] = before + entrained[i]
            velocity_ratio[i] = before / volume[i]
            if porosity[i] != soil_porosity:
                whole, was = before / share[i], density[i]
                porosity[i] = (porosity[i] * whole + soil_porosity * soil) / (whole + soil)
                density[i] = (1.0 - porosity[i]) * solid_density + porosity[i] * bearing_density
                if solid_fraction == 1.0:
                    velocity_ratio[i] *= was / density[i]
            if slip_ratio > 0.0:
                velocity_ratio[i] **= 1.0 - slip_ratio
            # as `column.diagnostics.basal_peclet_number`, without its arrays: this is done in every step
            coefficient = coefficient_of_consolidation[min(i, coefficient_of_consolidation.size - 1)]
            basal_peclet_number[i] = rate * cosine[i] * thickness[i] / coefficient
            if np.isnan(first_erosion_time[i]):
                first_erosion_time[i] = time
