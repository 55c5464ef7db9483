"""Common part of the schemes that advance every column at every step: the load of a step, and the bounds."""

import numpy as np

from ....core.jit import inner
from .choices import OVERBURDEN, PROPORTIONAL
from .contact import ERODING, PRESCRIBED, contact_of

# places in `ColumnState.memory`: 1 once the column is known; load at the end of the last step [Pa]; 1 if its base was
# prescribed
IS_KNOWN, LAST_LOAD, WAS_PRESCRIBED = range(3)
SIZE = 3

# columns of the array of steps: `BaseContact`; volume entrained over volume before; diffusion c_v dt / h^2
CONTACT, GROWTH, DIFFUSION = range(3)

GROWTH_CAP = 1e9  # largest growth that is counted: no old soil is left long before
DIFFUSION_CAP = 1e9  # largest c_v dt / h^2 that is counted: no pressure is left long before


@inner
def eta_of(levels):
    """Return the depth below the surface over the thickness, at the levels."""
    return 1.0 - np.arange(levels) / (levels - 1)


@inner
def is_prescribed(contact):
    """Return whether the bed prescribes the pressure at the base."""
    return contact in (PRESCRIBED, ERODING)


@inner
def begin_step(columns, forcing, dt, scheme):
    """Load all columns and return contact, growth and diffusion of the step, shape (n, 3) [-].

    `columns` is a `ColumnState`, changed in place, `forcing` the `ColumnForcing`, `dt` in s, `scheme` the choices of
    the law.
    """
    # taken out of their tuples once: numba counts references at every access
    volumes, loads, thicknesses = forcing.volume, forcing.liquefaction_pressure, forcing.thickness
    entrained, beds, bases = forcing.entrained, forcing.bed_pressure, forcing.base
    sources, coefficients = forcing.porosity_source, forcing.coefficient_of_consolidation
    profile, memory = columns.profile, columns.memory
    steps, eta = np.empty((profile.shape[0], 3)), eta_of(profile.shape[1])
    for i in range(profile.shape[0]):
        volume, load = volumes[i], loads[i]
        before = volume - entrained[i]
        contact = contact_of(bases[min(i, bases.size - 1)], entrained[i], scheme.flux)
        prescribed = is_prescribed(contact)
        old_load = memory[i, LAST_LOAD]
        if memory[i, IS_KNOWN] == 0.0:  # a new column: only erosion has changed its load
            old_load = load * before / volume if volume > 0.0 else load
        if prescribed and memory[i, WAS_PRESCRIBED] == 0.0:
            bed = beds[min(i, beds.size - 1)]
            profile[i, 0] = bed * old_load / load if load > 0.0 else bed
        gain, scale = _loading(volume, before, load, old_load, scheme)
        _load(profile, i, eta, gain, scale, sources[min(i, sources.size - 1)] * dt, prescribed)
        memory[i, IS_KNOWN], memory[i, LAST_LOAD], memory[i, WAS_PRESCRIBED] = 1.0, load, 1.0 if prescribed else 0.0
        steps[i, CONTACT], steps[i, GROWTH] = contact, _over(entrained[i], before, GROWTH_CAP)
        # h^2 is thickness after times thickness before, with erosion as the only change: exact for a constant rate
        diffused = coefficients[min(i, coefficients.size - 1)] * dt * volume
        steps[i, DIFFUSION] = _over(diffused, thicknesses[i] * thicknesses[i] * before, DIFFUSION_CAP)
    return steps


@inner
def _over(numerator, denominator, cap):
    """Return the ratio, at most ``cap``, and 0 for nothing over nothing.

    `numerator` and `denominator` are floats in one unit, >= 0; ``cap`` is the largest ratio [-].
    """
    if numerator == 0.0:
        return 0.0
    return cap if numerator >= cap * denominator else numerator / denominator  # a NaN stays one


@inner
def _loading(volume, before, load, old_load, scheme):
    """Return the pressure over eta that loading adds [Pa], and the factor by which it scales the pressure [-].

    `volume` and `before` are volumes after and before the step [m3], `load` and `old_load` liquefaction pressures then
    [Pa].
    """
    if scheme.loading == OVERBURDEN:
        if scheme.loads_by_erosion:
            return load - old_load, 1.0
        if volume > 0.0 and before > 0.0:
            # volume above a grain, which keeps its depth (that at the start of the step) or its fraction of the depth
            carried = before if scheme.moves_with_grains else 0.5 * (before + volume)
            return carried * (load / volume - old_load / before), 1.0
    elif scheme.loading == PROPORTIONAL and old_load > 0.0 and volume > 0.0 and before > 0.0:
        return 0.0, load * before / (old_load * volume)
    return 0.0, 1.0


@inner
def _load(profile, i, eta, load_gain, scale, source_gain, prescribed):
    """Load one column, and add the pressure by a change of porosity except at a prescribed base [Pa].

    `profile`, shape (n, levels), is changed in row `i` [Pa]: it is multiplied by `scale` [-], then `load_gain` times
    `eta` and `source_gain` are added [Pa]; `eta` is 1 at the base, 0 at the surface; `prescribed` is bool.
    """
    profile[i, 0] = scale * profile[i, 0] + load_gain + (0.0 if prescribed else source_gain)
    for k in range(1, eta.size - 1):
        profile[i, k] = scale * profile[i, k] + load_gain * eta[k] + source_gain
    profile[i, eta.size - 1] = 0.0


@inner
def end_step(columns, forcing, basal_pressure):
    """Clip all columns to liquefaction, count the pressure removed [Pa m], and write the base, at least suction [Pa].

    `columns` is a `ColumnState`, changed in place; `forcing` holds load [Pa] and thickness [m]; `basal_pressure` has
    shape (n,).
    """
    profile, clipped, lower = columns.profile, columns.clipped, forcing.water_to_buoyant
    loads, thicknesses, bounded = forcing.liquefaction_pressure, forcing.thickness, forcing.bounded
    cells, eta = profile.shape[1] - 1, eta_of(profile.shape[1])
    for i in range(profile.shape[0]):
        removed = 0.0
        for k in range(cells if bounded else 0):
            most, pressure = loads[i] * eta[k], profile[i, k]
            if pressure > most:  # a NaN stays one
                profile[i, k] = most
                removed += (pressure - most) * (0.5 if k == 0 else 1.0)
        clipped[i] += removed * thicknesses[i] / cells
        basal_pressure[i] = profile[i, 0]
        if bounded and profile[i, 0] < -lower * loads[i]:
            basal_pressure[i] = -lower * loads[i]
