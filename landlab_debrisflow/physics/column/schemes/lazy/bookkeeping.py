"""Account of diffusion, load and source of every column, step by step, and the lists of columns that are due.

Most columns are not advanced in most steps. All columns pass through this loop, so it is kept short.
"""

import math

from .....core.jit import inner, kernel
from ..choices import OVERBURDEN, PROPORTIONAL, UNLOADED
from ..contact import IMPERMEABLE, INFLOW, SEALED, contact_of
from .boundary_layer import is_resolved
from .impermeable_base import bounds_with_gains

DIFFUSION_CAP = 1e12  # largest c_v t / h^2 that is counted: no pressure is left long before
# fraction of an evenly increasing load that has left the base, over the square root of c_v t / h^2
LOSS = 4.0 / (3.0 * math.sqrt(math.pi))
STRIDE = 1.5  # growth of a column in one update over the square root of the tolerance (benchmarks/column.py)
MODES_FRACTION = 0.25  # error of a column in modes between two updates, over the tolerance
# change of the pressure of the bed, or by a source, over the load that makes an update due, over STRIDE
BED_FRACTION = 0.25
# growth in one update over that since the contact began: steps are short while the layer over the base is young
GRADING = 0.5
EXCESS = 0.1  # excess over liquefaction, over the load, allowed above an impermeable base until the next update

CHANGED, IN_MODES, AT_LEVELS = range(3)
"""Lists of columns that `accumulate` writes: with a new contact; due in modes; due at levels."""


@inner
def diffusion_of(coefficient_times_dt, thickness, volume, before):
    """Return c_v t / h^2 of a step [-].

    `coefficient_times_dt` is c_v t [m2], `thickness` [m] and `volume` [m3] are after the step, `before` is the volume
    before it [m3].

    In place of h^2 stands the thickness after the step times that before it, with erosion as the only change: exact for
    a constant rate.
    """
    square, diffused = thickness * thickness * max(before, 0.0), coefficient_times_dt * volume
    if diffused < DIFFUSION_CAP * square:
        return diffused / square
    return DIFFUSION_CAP if diffused > 0.0 else 0.0


@inner
def accumulate_in_modes(column, diffusion, load, old_load, source, loading):
    """Add one step to the account of a column in modes and estimate the pressure at its base.

    Parameters
    ----------
    column : record of `state.LAYOUT`
        Written.
    diffusion : float
        c_v t / h^2 of the step [-].
    load, old_load : float
        Liquefaction pressure after and before the step [Pa].
    source : float
        Pressure gained at every level by a change of porosity [Pa].
    loading : int
        A value of `choices.LOADING`.

    Returns
    -------
    pressure, error : float
        Pressure at the base, and the bound of its error [Pa].
    high_slope : float
        Upper bound of the pressure over eta [Pa].
    lost : float
        Fraction of an even load since the update that has gone from the base [-].
    """
    diffusion = min(column.diffusion + diffusion, DIFFUSION_CAP)
    load_gain, scale, source_gain = column.load_gain, column.load_scale, column.source_gain + source
    variation = column.load_variation + abs(source_gain - column.source_gain)
    if loading == OVERBURDEN:
        load_gain += load - old_load
        variation += abs(load - old_load)
    elif loading == PROPORTIONAL and old_load > 0.0:
        scale *= load / old_load
    column.diffusion, column.load_gain, column.load_scale = diffusion, load_gain, scale
    column.source_gain, column.load_variation = source_gain, variation
    lost = LOSS * math.sqrt(diffusion)
    pressure = scale * (column.base_pressure + diffusion * (column.base_rate + diffusion * column.base_curvature))
    pressure += load_gain * max(1.0 - lost, 0.0) + source_gain
    error = column.remainder * scale * diffusion * diffusion * diffusion + lost * variation
    low, high, low_slope, high_slope = bounds_with_gains(column)
    return min(max(pressure, low, low_slope), high, high_slope), error, high_slope, lost


@kernel
def accumulate(state, selected, forcing, dt, basal_pressure, scheme, due, excess_allowed):
    """Add one step of the flow to the account of columns, write their basal pressure and list the columns that are due.

    Parameters
    ----------
    state : ndarray of `state.LAYOUT`, shape (n,)
        Written in place.
    selected : ndarray of int, shape (m,)
        Indices of the columns.
    forcing : tuple
        Members of the `ColumnForcing` of the step, without shearing.
    dt, basal_pressure
        As in `advance.advance_columns`.
    scheme : tuple
        Members of the `Scheme` of the law.
    due : ndarray of int, shape (3, m) or wider
        Written: indices of columns, one row for each of `CHANGED`, `IN_MODES` and `AT_LEVELS`. A column with a new
        contact is only listed.
    excess_allowed : float
        Pressure above liquefaction over the load, of a column in modes [-].

    Returns
    -------
    changed, in_modes, at_levels : int
        Lengths of the rows.
    """
    volumes, thicknesses, loads, entrained, beds, bases, sources, coefficients, lower, bounded = forcing
    levels, moves_with_grains, loading, _, flux, tolerance = scheme
    stride = STRIDE * math.sqrt(tolerance)
    changed, in_modes, at_levels = 0, 0, 0
    for i in selected:
        column = state[i]
        volume, load, old_load = volumes[i], loads[i], column.load
        before, contact = volume - entrained[i], column.contact
        if contact != contact_of(bases[min(i, bases.size - 1)], entrained[i], flux):
            if old_load == 0.0:  # a new column
                column.load = load * before / volume if volume > 0.0 else load
            due[CHANGED, changed] = i
            changed += 1
            continue
        coefficient, source = coefficients[min(i, coefficients.size - 1)], sources[min(i, sources.size - 1)] * dt
        diffusion = diffusion_of(coefficient * dt, thicknesses[i], volume, before)
        column.load = load
        if contact == IMPERMEABLE:
            pressure, error, high_slope, lost = accumulate_in_modes(column, diffusion, load, old_load, source, loading)
            # a film lacks suction: its magnitude counts, too
            allowed = MODES_FRACTION * tolerance * max(load, -pressure)
            is_due = error > allowed
            if bounded:
                # pressure above liquefaction higher in the column, to be clipped, would reach the base as a load does;
                # the base itself is clipped at once. Friction gets at most the suction allowed, even if the column
                # lacks more
                excess = max(high_slope - load, 0.0)
                is_due |= error + lost * excess > allowed or excess > excess_allowed * load
                pressure = min(max(pressure, -lower * load), load)
            basal_pressure[i] = pressure
            if is_due:
                due[IN_MODES, in_modes] = i
                in_modes += 1
            continue
        pressure = beds[min(i, beds.size - 1)]
        basal_pressure[i] = column.bed_pressure = pressure
        column.diffusion = min(column.diffusion + diffusion, DIFFUSION_CAP)
        column.source_gain += source
        is_due = _is_due_at_levels(column, volume, load, pressure, stride)
        if is_due and column.contact_is_new != 0.0:  # not before levels resolve the layer that forms over the base
            growth = 1.0 - column.volume_at_update / volume if moves_with_grains else 0.0
            is_due = is_resolved(levels - 1, growth, column.diffusion)
        if is_due or contact >= INFLOW:
            due[AT_LEVELS, at_levels] = i
            at_levels += 1
    return changed, in_modes, at_levels


@inner
def _is_due_at_levels(column, volume, load, pressure, stride):
    """Return whether a column at levels is to be advanced now: volume, load, bed or source have changed enough.

    Parameters
    ----------
    column : record of `LAYOUT`
        Memory of the column: volume, load, pressure at the base and source at its last update.
    volume, load, pressure : float
        Volume of the particle [m3], its liquefaction pressure [Pa] and the pressure of the bed [Pa] now.
    stride : float
        Largest relative change since the update that may be left for later [-]; 0: every step is due.
    """
    start, old_load = column.volume_at_update, column.load_at_update
    unstrained, change_allowed = old_load * volume, BED_FRACTION * stride * load
    is_due = volume - start > min(stride * start, GRADING * (start - column.volume_at_contact))
    is_due |= abs(load * start - unstrained) > stride * unstrained
    is_due |= abs(pressure * old_load - column.base_pressure * load) > change_allowed * old_load
    is_due |= abs(column.source_gain) > change_allowed
    is_due |= stride == 0.0
    return is_due


@kernel
def list_by_base(state, selected, volumes, moves_with_grains, lists):
    """List columns at levels by the action of the base.

    Parameters
    ----------
    state : ndarray of `state.LAYOUT`, shape (n,)
        Memory of the columns.
    selected : ndarray of int, shape (m,)
        Indices of the columns.
    volumes : ndarray, shape (n,)
        Volumes of the particles now [m3].
    moves_with_grains : bool
        Whether a column grows as its particle does.
    lists : ndarray of int, shape (4, m)
        Written: indices of columns, one row for each of the numbers returned.

    Returns
    -------
    sealed, grows, takes_in, stays : int
        Number of columns whose base is sealed; and of those that have grown over a base that the bed prescribes, that
        have grown by soil with a pressure of its own, and that have not grown since their last update.
    """
    sealed, grows, takes_in, stays = 0, 0, 0, 0
    for i in selected:
        column = state[i]
        if column.contact == SEALED:
            lists[0, sealed] = i
            sealed += 1
        if not (moves_with_grains and volumes[i] > column.volume_at_update):
            lists[3, stays] = i
            stays += 1
        elif column.contact < INFLOW:
            lists[1, grows] = i
            grows += 1
        else:
            lists[2, takes_in] = i
            takes_in += 1
    return sealed, grows, takes_in, stays


@kernel
def set_contact(columns, selected, forcing, scheme, closing):
    """Set the base contact of columns at levels for this step; list the columns that get an impermeable base.

    Parameters
    ----------
    columns : LazyColumns
        Written in place.
    selected : ndarray of int
        Indices of the columns.
    forcing : ColumnForcing
        The step.
    scheme : Scheme
        Choices of the law.
    closing : ndarray of int
        Written: indices of the columns over an impermeable base.

    Returns
    -------
    int
        Number of columns over an impermeable base.
    """
    loads, volumes, entrained = forcing.liquefaction_pressure, forcing.volume, forcing.entrained
    (_, state, _), beds, bases, count = columns, forcing.bed_pressure, forcing.base, 0
    for i in selected:
        contact = contact_of(bases[min(i, bases.size - 1)], entrained[i], scheme.flux)
        if contact == IMPERMEABLE:
            closing[count] = i
            count += 1
            continue
        column = state[i]
        bed, load, old_load, volume = beds[min(i, beds.size - 1)], loads[i], column.load, volumes[i]
        volume -= entrained[i]
        # for a constant ratio: the pressure of the bed before the step was less, as the load was
        if scheme.loading != UNLOADED and load > 0.0:
            bed *= old_load / load
        column.contact, column.contact_is_new = contact, 1.0
        column.volume_at_update, column.load_at_update, column.diffusion = volume, old_load, 0.0
        column.bed_pressure = column.base_pressure = bed
        column.source_gain, column.deferred_diffusion, column.volume_at_contact = 0.0, 0.0, volume
    return count
