"""The paper's scheme: Lax-Wendroff for the advection, then explicit diffusion, in sub-steps (eqs. 40 to 44).

Kept to compare with. It is of second order where the profile is smooth, but overshoots at sharp fronts once the
cell Péclet number is well above one, the more so the smaller the Courant number (theory, section 5). A base that
starts to be prescribed has its new pressure at once. What a step loads and what is clipped is shared with `upwind`.
"""

import math

import numpy as np

from ...core.jit import kernel
from ..contracts import BASE_BY_EROSION, BASE_PRESCRIBED
from .scheme import OVERBURDEN, PROPORTIONAL

MOST_SUBSTEPS = 100_000

# in `ColumnState.memory`: 1 once the column is known; load at the end of the last step; 1 if its base was prescribed
KNOWN, LOAD, HELD = range(3)

# what a step does to a column, one row each: its contact, volume entrained over volume before, c_v dt / h^2
CONTACT, GROWTH, PASSED = range(3)
IMPERMEABLE, PRESCRIBED, INFLOW = 0.0, 1.0, 2.0  # values of CONTACT

GROWTH_CAP = 1e9  # growth after which all is new
PASSED_CAP = 1e9  # c_v dt / h^2 after which nothing is left


@kernel
def advance_lax_wendroff(columns, forcing, dt, basal_pressure, scheme):
    """Advance all columns by one step of the flow.

    Sub-steps are no longer than ``min(dx/e_R, dx^2/2c_v)``. A column that would need more than `MOST_SUBSTEPS` is
    filled with NaN, for the check after the step to find.

    Parameters
    ----------
    columns : ColumnState
        Written in place.
    forcing : ColumnForcing
        The step.
    dt : float
        Duration [s].
    basal_pressure : ndarray, shape (n,)
        Written: the excess pore pressure that friction feels [Pa].
    scheme : Scheme
        Which law it is.
    """
    steps = begin_step(columns, forcing, dt, scheme)
    profile, beds = columns.profile, forcing.bed_pressure
    cells = profile.shape[1] - 1
    for i in range(profile.shape[0]):
        growth = steps[i, GROWTH] if scheme.stretching else 0.0
        passed = steps[i, PASSED]
        advective, diffusive = cells * growth, 2.0 * cells * cells * passed
        if advective <= MOST_SUBSTEPS and diffusive <= MOST_SUBSTEPS:
            held, bed = steps[i, CONTACT] == PRESCRIBED, beds[min(i, beds.size - 1)]
            _take_substeps(profile, i, math.ceil(max(advective, diffusive)), growth, passed, held, bed)
        else:  # or not a number
            profile[i, :] = np.nan
    end_step(columns, forcing, basal_pressure)


@kernel
def _take_substeps(profile, i, count, growth, passed, held, bed):
    """Advance one column in ``count`` sub-steps; the pressure of a base that is held goes to ``bed`` evenly."""
    cells, first = profile.shape[1] - 1, profile[i, 0]
    for m in range(count):
        if growth > 0.0:
            _advect(profile, i, growth / (count + m * growth))
        if held:
            profile[i, 0] = first + (bed - first) * ((m + 1.0) / count)
        if passed > 0.0:
            _diffuse(profile, i, passed * cells * cells / count, held)
    if held:
        profile[i, 0] = bed


@kernel
def _advect(profile, i, grown):
    """Take one Lax-Wendroff step, with ``(A p_x)_x`` in its second-order term, in which a column grows by ``grown``."""
    cells = profile.shape[1] - 1
    # e_R dt/h such that 1 + e + e^2/2, by which the scheme multiplies a linear profile, is 1 + grown: a constant ratio
    # survives. To the order of the scheme it is ln(1 + grown).
    e = 2.0 * grown / (1.0 + math.sqrt(1.0 + 2.0 * grown))
    below = profile[i, 0]  # has no slope if the base is impermeable, and is overwritten if not
    for k in range(1, cells):
        here, above = profile[i, k], profile[i, k + 1]
        courant = e * (cells - k)
        second = (courant - 0.5 * e) * (above - here) - (courant + 0.5 * e) * (here - below)
        profile[i, k] = here - 0.5 * courant * (above - below - second)
        below = here


@kernel
def _diffuse(profile, i, number, held):
    """Take one explicit step of diffusion with the cell Fourier number ``number``; mirrored at a base not held."""
    below = profile[i, 0]
    if not held:
        profile[i, 0] += 2.0 * number * (profile[i, 1] - below)
    for k in range(1, profile.shape[1] - 1):
        here = profile[i, k]
        profile[i, k] = here + number * (profile[i, k + 1] - 2.0 * here + below)
        below = here


@kernel
def eta_of(levels):
    """Return the depth below the surface over the thickness, at the levels."""
    return 1.0 - np.arange(levels) / (levels - 1)


@kernel
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


@kernel
def _contact(base, entrained, flux):
    """Return what a column stands on in a step."""
    if base == BASE_PRESCRIBED:
        return PRESCRIBED
    if base == BASE_BY_EROSION and entrained > 0.0:
        return INFLOW if flux else PRESCRIBED
    return IMPERMEABLE


@kernel
def _over(part, whole, cap):
    """Return ``part / whole``, at most ``cap``, and 0 for nothing of nothing."""
    if part == 0.0:
        return 0.0
    return cap if part >= cap * whole else part / whole  # a NaN stays one


@kernel
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


@kernel
def _load(profile, i, eta, lift, scale, gain, held):
    """Add to one column what loading and a change of porosity do to it, the latter not where the base is held."""
    profile[i, 0] = scale * profile[i, 0] + lift + (0.0 if held else gain)
    for k in range(1, eta.size - 1):
        profile[i, k] = scale * profile[i, k] + lift * eta[k] + gain
    profile[i, eta.size - 1] = 0.0


@kernel
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
