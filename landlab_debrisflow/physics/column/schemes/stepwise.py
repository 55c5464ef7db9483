"""What the schemes that advance every column at every step share: how a step loads a column, and its bounds."""

import numpy as np

from ....core.jit import inner
from ...contracts import BASE_BY_EROSION, BASE_PRESCRIBED
from .choices import OVERBURDEN, PROPORTIONAL

# in `ColumnState.memory`: 1 once the column is known; load at the end of the last step; 1 if its base was prescribed
KNOWN, LOAD, HELD = range(3)

# what a step does to a column, one row each: its contact, volume entrained over volume before, c_v dt / h^2
CONTACT, GROWTH, PASSED = range(3)
IMPERMEABLE, PRESCRIBED, INFLOW = 0.0, 1.0, 2.0  # values of CONTACT

GROWTH_CAP = 1e9  # growth after which all is new
PASSED_CAP = 1e9  # c_v dt / h^2 after which nothing is left


@inner
def eta_of(levels):
    """Return the depth below the surface over the thickness, at the levels."""
    return 1.0 - np.arange(levels) / (levels - 1)


@inner
def begin_step(columns, forcing, dt, scheme):
    """Load all columns and return what else the step does to them, shape (n, 3)."""
    # taken out of their tuples once: numba counts references at every access
    volumes, loads, thicknesses = forcing.volume, forcing.liquefaction_pressure, forcing.thickness
    entrained, beds, bases = forcing.entrained, forcing.bed_pressure, forcing.base
    sources, coefficients = forcing.porosity_source, forcing.coefficient_of_consolidation
    profile, memory = columns.profile, columns.memory
    steps, eta = np.empty((profile.shape[0], 3)), eta_of(profile.shape[1])
    for i in range(profile.shape[0]):
        volume, load = volumes[i], loads[i]
        before = volume - entrained[i]
        contact = _contact(bases[min(i, bases.size - 1)], entrained[i], scheme.flux)
        old_load = memory[i, LOAD]
        if memory[i, KNOWN] == 0.0:  # nothing but erosion has changed it
            old_load = load * before / volume if volume > 0.0 else load
        if contact == PRESCRIBED and memory[i, HELD] == 0.0:
            bed = beds[min(i, beds.size - 1)]
            profile[i, 0] = bed * old_load / load if load > 0.0 else bed
        lift, scale = _loading(volume, before, load, old_load, scheme)
        _load(profile, i, eta, lift, scale, sources[min(i, sources.size - 1)] * dt, contact == PRESCRIBED)
        memory[i, KNOWN], memory[i, LOAD], memory[i, HELD] = 1.0, load, 1.0 if contact == PRESCRIBED else 0.0
        steps[i, CONTACT], steps[i, GROWTH] = contact, _over(entrained[i], before, GROWTH_CAP)
        # thickness before times thickness after, were there erosion only: exact for a constant rate of it
        passed = coefficients[min(i, coefficients.size - 1)] * dt * volume
        steps[i, PASSED] = _over(passed, thicknesses[i] * thicknesses[i] * before, PASSED_CAP)
    return steps


@inner
def _contact(base, entrained, flux):
    """Return what a column stands on in a step."""
    if base == BASE_PRESCRIBED:
        return PRESCRIBED
    if base == BASE_BY_EROSION and entrained > 0.0:
        return INFLOW if flux else PRESCRIBED
    return IMPERMEABLE


@inner
def _over(part, whole, cap):
    """Return ``part / whole``, at most ``cap``, and 0 for nothing of nothing."""
    if part == 0.0:
        return 0.0
    return cap if part >= cap * whole else part / whole  # a NaN stays one


@inner
def _loading(volume, before, load, old_load, scheme):
    """Return what loading adds to the pressure, over eta, and what it multiplies it by."""
    if scheme.loading == OVERBURDEN:
        if scheme.literal:
            return load - old_load, 1.0
        if volume > 0.0 and before > 0.0:
            # what lies on a grain: the grain keeps its depth, as at the start of the step, or its fraction of it
            share = before if scheme.stretching else 0.5 * (before + volume)
            return share * (load / volume - old_load / before), 1.0
    elif scheme.loading == PROPORTIONAL and old_load > 0.0 and volume > 0.0 and before > 0.0:
        return 0.0, load * before / (old_load * volume)
    return 0.0, 1.0


@inner
def _load(profile, i, eta, lift, scale, gain, held):
    """Add to one column what loading and a change of porosity do to it, the latter not where the base is held."""
    profile[i, 0] = scale * profile[i, 0] + lift + (0.0 if held else gain)
    for k in range(1, eta.size - 1):
        profile[i, k] = scale * profile[i, k] + lift * eta[k] + gain
    profile[i, eta.size - 1] = 0.0


@inner
def end_step(columns, forcing, basal_pressure):
    """Hold all columns between suction and liquefaction, count what that takes off, and write the base."""
    profile, clipped, lower = columns.profile, columns.clipped, forcing.water_to_buoyant
    loads, thicknesses, bounded = forcing.liquefaction_pressure, forcing.thickness, forcing.bounded
    cells, eta = profile.shape[1] - 1, eta_of(profile.shape[1])
    for i in range(profile.shape[0]):
        removed = 0.0
        for k in range(cells if bounded else 0):
            most, pressure = loads[i] * eta[k], profile[i, k]
            if pressure > most or pressure < -lower * most:  # a NaN stays one
                profile[i, k] = most if pressure > most else -lower * most
                removed += abs(pressure - profile[i, k]) * (0.5 if k == 0 else 1.0)
        if removed > 0.0:
            clipped[i] += removed * thicknesses[i] / cells
        basal_pressure[i] = profile[i, 0]
