"""The default scheme: it advances the excess pore pressure of all columns in one call.

A column whose base is impermeable is kept as the waves it decays in (`closed`), exact at every step. One
that erodes has its base prescribed, so nobody needs its profile: it is kept as pressures at levels and
advanced when it has grown by some per cent, when its base changes, or for output (`eroding`).
"""

import math

import numpy as np

from ...core.jit import kernel
from ..contracts import BASE_IMPERMEABLE, BASE_PRESCRIBED
from .closed import DIFFUSION_CAP, close, closed_pressure, gained_limits, look, open_up
from .eroding import bring
from .layer import is_seen
from .memory import (
    BASE,
    BED_PRESSURE,
    CLOSED,
    CONTACT,
    CURRENT_LOAD,
    DIFFUSION,
    ERODING,
    FLUX,
    HELD,
    JUST,
    LEVELS,
    LOAD,
    OWED,
    SEALED,
    SOURCE,
    TOUCHED,
    VOLUME,
)  # fmt: skip
from .scheme import OVERBURDEN, PROPORTIONAL, UNLOADED

STRIDE = 1.5  # growth of a column in one advance over the square root of the tolerance (benchmarks/column.py)
LOOK_SHARE = 0.25  # of the tolerance, for what a closed column may be wrong between two looks
BED_SHARE = 0.25  # of that growth: pressure of the bed or by a source since the last advance, over the load
GRADED = 0.5  # growth in one advance over that since the base changed: the layer over it is young at first
ROUNDING = 1e-9  # of the bounds, within which a wave need not be looked at


@kernel
def hold(columns, i, load, thickness, lower):
    """Hold the levels of one column between suction and liquefaction, and count what that takes off."""
    profile = columns.profile
    cells = profile.shape[1] - 1
    removed = 0.0
    for k in range(cells):
        overburden, pressure = load * (cells - k) / cells, profile[i, k]
        held = min(max(pressure, -lower * overburden), overburden)
        removed += abs(pressure - held) * (0.5 if k == 0 else 1.0)
        profile[i, k] = held
    columns.clipped[i] += removed * thickness / cells


@kernel
def contact_of(base, entrained, flux):
    """Return what a column stands on, a value of CONTACT."""
    if base == BASE_PRESCRIBED:
        return HELD
    if entrained <= 0.0:
        return CLOSED
    if base == BASE_IMPERMEABLE:
        return SEALED
    return FLUX if flux else ERODING


@kernel
def passed_in(coefficient_times_dt, thickness, volume, before):
    """Return c_v t / h^2 of a step.

    Squared is the thickness before times that after, were there erosion only: exact for a constant rate.
    """
    square, passed = thickness * thickness * max(before, 0.0), coefficient_times_dt * volume
    if passed < DIFFUSION_CAP * square:
        return passed / square
    return DIFFUSION_CAP if passed > 0.0 else 0.0


@kernel
def changed(memory, forcing, flux, out):
    """Write which columns stand on something else than before the step; return how many."""
    bases, entrained, count = forcing.base, forcing.entrained, 0
    for i in range(entrained.size):
        if memory[i, CONTACT] != contact_of(bases[min(i, bases.size - 1)], entrained[i], flux):
            out[count] = i
            count += 1
    return count


@kernel
def switch(columns, i, forcing, scheme, work):
    """Change what one column stands on."""
    profile, memory, load = columns.profile, columns.memory, forcing.liquefaction_pressure[i]
    volume, old_load = forcing.volume[i] - forcing.entrained[i], memory[i, CURRENT_LOAD]
    if old_load == 0.0:  # nothing is remembered of it
        old_load = load * volume / forcing.volume[i] if forcing.volume[i] > 0.0 else load
        memory[i, CURRENT_LOAD] = old_load
    jump, content = 0.0, 0.0
    if memory[i, CONTACT] == CLOSED:
        open_up(profile, memory, i, scheme.waves, work)
    elif memory[i, CONTACT] != LEVELS:
        ending = memory[i, CONTACT] != LEVELS  # not a literal: numba would compile it all once more
        jump, content = bring(profile, memory, i, volume, old_load, ending, scheme, work)
        if forcing.bounded:
            hold(columns, i, old_load, forcing.thickness[i], forcing.water_to_buoyant)
    contact = contact_of(forcing.base[min(i, forcing.base.size - 1)], forcing.entrained[i], scheme.flux)
    if contact == CLOSED:
        close(profile, memory, i, jump, content, scheme.waves, work)
        return
    bed = forcing.bed_pressure[min(i, forcing.bed_pressure.size - 1)]
    if scheme.loading != UNLOADED and load > 0.0:  # a bed of constant ratio had it before the step too
        bed *= old_load / load
    memory[i, CONTACT], memory[i, JUST] = contact, 1.0
    memory[i, VOLUME], memory[i, LOAD], memory[i, DIFFUSION] = volume, old_load, 0.0
    memory[i, BED_PRESSURE] = memory[i, BASE] = bed
    memory[i, SOURCE], memory[i, OWED], memory[i, TOUCHED] = 0.0, 0.0, volume


@kernel
def account(memory, forcing, dt, basal_pressure, scheme, due):
    """Put one step of the flow on what every column is owed, write the base; return how many are ``due``."""
    # a loop of its own, over plain arrays (those of a tuple are counted at every access): most columns are not due
    volumes, loads, thicknesses = forcing.volume, forcing.liquefaction_pressure, forcing.thickness
    entrained, beds, sources = forcing.entrained, forcing.bed_pressure, forcing.porosity_source
    coefficients, lower, bounded = forcing.coefficient_of_consolidation, forcing.water_to_buoyant, forcing.bounded
    loading, tolerance, stride, count = scheme.loading, scheme.tolerance, STRIDE * math.sqrt(scheme.tolerance), 0
    for i in range(basal_pressure.size):
        volume, load, old_load = volumes[i], loads[i], memory[i, CURRENT_LOAD]
        coefficient, gain = coefficients[min(i, coefficients.size - 1)], sources[min(i, sources.size - 1)] * dt
        passed = passed_in(coefficient * dt, thicknesses[i], volume, volume - entrained[i])
        memory[i, CURRENT_LOAD] = load
        if memory[i, CONTACT] == CLOSED:
            pressure, error = closed_pressure(memory, i, passed, load, old_load, gain, loading)
            is_due = error > LOOK_SHARE * tolerance * load
            if bounded:
                is_due |= beyond(memory, i, load, lower)
                pressure = min(max(pressure, -lower * load), load)
        else:
            pressure = beds[min(i, beds.size - 1)]
            start, whole = memory[i, VOLUME], memory[i, LOAD] * volume
            memory[i, DIFFUSION] = min(memory[i, DIFFUSION] + passed, DIFFUSION_CAP)
            memory[i, BED_PRESSURE] = pressure
            memory[i, SOURCE] += gain
            is_due = volume - start > min(stride * start, GRADED * (start - memory[i, TOUCHED]))
            is_due |= abs(load * start - whole) > stride * whole
            old_load, least = memory[i, LOAD], BED_SHARE * stride * load
            is_due |= abs(pressure * old_load - memory[i, BASE] * load) > least * old_load
            is_due |= abs(memory[i, SOURCE]) > least
            is_due |= stride == 0.0 or memory[i, CONTACT] >= FLUX
        basal_pressure[i] = pressure
        if is_due:
            due[count] = i
            count += 1
    return count


@kernel
def beyond(memory, i, load, lower):
    """Return whether a closed column may have left its bounds somewhere."""
    _, _, least, most = gained_limits(memory, i)
    slack = ROUNDING * load
    return most > load + slack or least < -lower * load - slack


@kernel
def advance_due(columns, i, forcing, scheme, work):
    """Advance one column that is due; return the pressure at its base."""
    profile, memory, waves = columns.profile, columns.memory, scheme.waves
    load, volume, thickness = forcing.liquefaction_pressure[i], forcing.volume[i], forcing.thickness[i]
    lower, contact = forcing.water_to_buoyant, memory[i, CONTACT]
    if contact == CLOSED:
        look(profile, memory, i, waves, work)
        if forcing.bounded and beyond(memory, i, load, lower):
            open_up(profile, memory, i, waves, work)
            hold(columns, i, load, thickness, lower)
            close(profile, memory, i, 0.0, 0.0, waves, work)
        pressure, _ = closed_pressure(memory, i, 0.0, load, load, 0.0, scheme.loading)
        return min(max(pressure, -lower * load), load) if forcing.bounded else pressure
    if contact == SEALED:
        # soil that comes in has the pressure of the base, and is loaded with it
        memory[i, BASE] = memory[i, BED_PRESSURE] = profile[i, 0]
        unstrained = memory[i, LOAD] * volume / memory[i, VOLUME] if memory[i, VOLUME] > 0.0 else load
        if scheme.loading == OVERBURDEN:
            memory[i, BED_PRESSURE] += load - unstrained
        elif scheme.loading == PROPORTIONAL and unstrained > 0.0:
            memory[i, BED_PRESSURE] *= load / unstrained
    grown = 1.0 - memory[i, VOLUME] / volume if scheme.stretching else 0.0
    if contact >= FLUX or memory[i, JUST] == 0.0 or is_seen(waves.eta.size, grown, memory[i, DIFFUSION]):
        bring(profile, memory, i, volume, load, contact >= FLUX, scheme, work)
        if forcing.bounded:
            hold(columns, i, load, thickness, lower)
    return profile[i, 0] if contact >= FLUX else memory[i, BED_PRESSURE]


@kernel
def advance_columns(columns, forcing, dt, basal_pressure, scheme):
    """Account for one step of the flow, advance the columns for which it is due, write the base.

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
    work, due = np.empty((2, columns.profile.shape[1])), np.empty(basal_pressure.size, np.int64)
    for k in range(changed(columns.memory, forcing, scheme.flux, due)):
        switch(columns, due[k], forcing, scheme, work)
    for k in range(account(columns.memory, forcing, dt, basal_pressure, scheme, due)):
        basal_pressure[due[k]] = advance_due(columns, due[k], forcing, scheme, work)


@kernel
def bring_columns(columns, forcing, scheme):
    """Turn every column into pressures at levels, as they are now; arguments as in `advance_columns`."""
    profile, memory = columns.profile, columns.memory
    work = np.empty((2, profile.shape[1]))
    for i in range(profile.shape[0]):
        if memory[i, CONTACT] == CLOSED:
            open_up(profile, memory, i, scheme.waves, work)
        elif memory[i, CONTACT] != LEVELS:
            load = forcing.liquefaction_pressure[i]
            bring(profile, memory, i, forcing.volume[i], load, memory[i, CONTACT] != LEVELS, scheme, work)
            if forcing.bounded:
                hold(columns, i, load, forcing.thickness[i], forcing.water_to_buoyant)
