"""What every column is owed, step by step, and which are due.

Most columns are left alone in most steps. This is the loop that all of them pass through, so it is kept short.
"""

import math

from .....core.jit import inner, kernel
from ....contracts import BASE_IMPERMEABLE, BASE_PRESCRIBED
from ..choices import UNLOADED
from .boundary_layer import is_seen
from .impermeable_base import DIFFUSION_CAP, closed_pressure
from .state import (  # fmt: skip
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
    LOAD,
    OWED,
    SEALED,
    SOURCE,
    TOUCHED,
    VOLUME,
)

STRIDE = 1.5  # growth of a column in one advance over the square root of the tolerance (benchmarks/column.py)
LOOK_SHARE = 0.25  # of the tolerance, for what a closed column may be wrong between two looks
BED_SHARE = 0.25  # of that growth: pressure of the bed or by a source since the last advance, over the load
GRADED = 0.5  # growth in one advance over that since the base changed: the layer over it is young at first
BEYOND = 0.1  # of the load by which levels above a closed base may be beyond their bounds until they are looked at

CHANGED, DUE_WAVES, DUE_LEVELS = range(3)
"""Rows of the lists of columns that `account` writes: stands on something else; to be looked at; to be advanced."""


@inner
def contact_of(base, entrained, flux):
    """Return what a column stands on, a value of CONTACT."""
    if base == BASE_PRESCRIBED:
        return HELD
    if entrained <= 0.0:
        return CLOSED
    if base == BASE_IMPERMEABLE:
        return SEALED
    return FLUX if flux else ERODING


@inner
def passed_in(coefficient_times_dt, thickness, volume, before):
    """Return c_v t / h^2 of a step.

    Squared is the thickness before times that after, were there erosion only: exact for a constant rate.
    """
    square, passed = thickness * thickness * max(before, 0.0), coefficient_times_dt * volume
    if passed < DIFFUSION_CAP * square:
        return passed / square
    return DIFFUSION_CAP if passed > 0.0 else 0.0


@kernel
def account(memory, which, forcing, dt, basal_pressure, scheme, cells, due, waves, levels, slack):
    """Put one step of the flow on what some columns are owed, and write the pressure at their base.

    Parameters
    ----------
    memory : ndarray
        Of all columns.
    which : ndarray of int
        These columns.
    forcing, dt, basal_pressure, scheme
        As in `advance.advance_columns`.
    cells : int
        Number of levels less one.
    due : ndarray of int, shape (3, n)
        The rows `CHANGED`, `DUE_WAVES` and `DUE_LEVELS` are written. A column that stands on something else than
        before is put on the first of them, and nothing else is done with it.
    waves, levels : int
        How many are on the latter two rows already.
    slack : float
        Part of the load by which a closed column may be beyond its bounds.

    Returns
    -------
    changed, waves, levels : int
        How many are on the rows now.
    """
    # plain arrays: those of a tuple are counted at every access
    volumes, loads, thicknesses = forcing.volume, forcing.liquefaction_pressure, forcing.thickness
    entrained, beds, sources, bases = forcing.entrained, forcing.bed_pressure, forcing.porosity_source, forcing.base
    coefficients, lower, bounded = forcing.coefficient_of_consolidation, forcing.water_to_buoyant, forcing.bounded
    loading, tolerance, stride, changed = scheme.loading, scheme.tolerance, STRIDE * math.sqrt(scheme.tolerance), 0
    for i in which:
        volume, load, old_load = volumes[i], loads[i], memory[i, CURRENT_LOAD]
        before, contact = volume - entrained[i], memory[i, CONTACT]
        if contact != contact_of(bases[min(i, bases.size - 1)], entrained[i], scheme.flux):
            if old_load == 0.0:  # nothing is remembered of it
                memory[i, CURRENT_LOAD] = load * before / volume if volume > 0.0 else load
            due[CHANGED, changed] = i
            changed += 1
            continue
        coefficient, gain = coefficients[min(i, coefficients.size - 1)], sources[min(i, sources.size - 1)] * dt
        passed = passed_in(coefficient * dt, thicknesses[i], volume, before)
        memory[i, CURRENT_LOAD] = load
        if contact == CLOSED:
            pressure, error, least, most, lost = closed_pressure(memory, i, passed, load, old_load, gain, loading)
            is_due = error > LOOK_SHARE * tolerance * load
            if bounded:
                # it may have left its bounds somewhere. What that is worth reaches the base like a load does; the base
                # itself is held at once
                excess = max(most - load, -lower * load - least, 0.0)
                is_due |= error + lost * excess > LOOK_SHARE * tolerance * load or excess > slack * load
                pressure = min(max(pressure, -lower * load), load)
            basal_pressure[i] = pressure
            if is_due:
                due[DUE_WAVES, waves] = i
                waves += 1
            continue
        pressure, start, then = beds[min(i, beds.size - 1)], memory[i, VOLUME], memory[i, LOAD]
        basal_pressure[i] = memory[i, BED_PRESSURE] = pressure
        memory[i, DIFFUSION] = min(memory[i, DIFFUSION] + passed, DIFFUSION_CAP)
        memory[i, SOURCE] += gain
        whole, least = then * volume, BED_SHARE * stride * load
        is_due = volume - start > min(stride * start, GRADED * (start - memory[i, TOUCHED]))
        is_due |= abs(load * start - whole) > stride * whole
        is_due |= abs(pressure * then - memory[i, BASE] * load) > least * then
        is_due |= abs(memory[i, SOURCE]) > least
        is_due |= stride == 0.0
        if is_due and memory[i, JUST] != 0.0:  # levels must see the layer that forms over the base
            grown = 1.0 - start / volume if scheme.stretching else 0.0
            is_due = is_seen(cells, grown, memory[i, DIFFUSION])
        if is_due or contact >= FLUX:
            due[DUE_LEVELS, levels] = i
            levels += 1
    return changed, waves, levels


@kernel
def stand(memory, which, forcing, scheme, closing):
    """Put columns at levels on what they stand on now, but for those to close: list them and return their number."""
    loads, volumes, entrained = forcing.liquefaction_pressure, forcing.volume, forcing.entrained
    beds, bases, count = forcing.bed_pressure, forcing.base, 0
    for i in which:
        contact = contact_of(bases[min(i, bases.size - 1)], entrained[i], scheme.flux)
        if contact == CLOSED:
            closing[count] = i
            count += 1
            continue
        bed, load, old_load, volume = beds[min(i, beds.size - 1)], loads[i], memory[i, CURRENT_LOAD], volumes[i]
        volume -= entrained[i]
        if scheme.loading != UNLOADED and load > 0.0:  # a bed of constant ratio had it before the step too
            bed *= old_load / load
        memory[i, CONTACT], memory[i, JUST] = contact, 1.0
        memory[i, VOLUME], memory[i, LOAD], memory[i, DIFFUSION] = volume, old_load, 0.0
        memory[i, BED_PRESSURE] = memory[i, BASE] = bed
        memory[i, SOURCE], memory[i, OWED], memory[i, TOUCHED] = 0.0, 0.0, volume
    return count
