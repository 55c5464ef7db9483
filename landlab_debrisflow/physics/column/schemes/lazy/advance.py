"""The default scheme: it advances the excess pore pressure of all columns in one call.

A column whose base is impermeable is kept as the modes it decays in (`impermeable_base`), exact at every step. A column
that erodes has a prescribed pressure at its base, so that friction does not need its profile: it is kept as pressures
at levels and advanced when it has grown by some per cent, when its base changes, or for output (`prescribed_base`).

Each stage is a kernel of its own that goes through a list of columns and is called from here. A single kernel that
called all stages would be compiled with a copy of each stage, of most stages with two.
"""

import numpy as np

from ..contact import IMPERMEABLE
from .bookkeeping import AT_LEVELS, CHANGED, EXCESS, IN_MODES, accumulate, list_by_base, set_contact
from .flux_base import grow_by_flux, impermeable_inflow
from .impermeable_base import advance_modes, clip_modes, to_levels, to_modes
from .modes import modes_of
from .prescribed_base import commit, diffuse, grow
from .state import LazyColumns, Present, records

ROUNDING = 1e-9
"""Largest excess of pressure over its bounds, over the load, that a column in modes may have just after an update
[-]."""
NONE_DUE = (0, 0, 0)


def advance_columns(columns, forcing, dt, basal_pressure, scheme):
    """Account for one step of the flow, advance the columns that are due, write the basal pressure.

    Parameters
    ----------
    columns : ColumnState
        Written in place.
    forcing : ColumnForcing
        The step.
    dt : float
        Duration [s].
    basal_pressure : ndarray, shape (n,)
        Written: the excess pore pressure at the base, for friction [Pa].
    scheme : Scheme
        Choices of the law.
    """
    state, every = records(columns.memory), np.arange(basal_pressure.size)
    due, given = np.empty((3, every.size), np.int64), _account(forcing, dt, basal_pressure, scheme)
    counts = accumulate(state, every, *given, due, EXCESS)
    if counts == NONE_DUE:
        return
    columns = LazyColumns(profile=columns.profile, state=state, clipped=columns.clipped)
    if count := counts[CHANGED]:
        changed, due_then = due[CHANGED, :count], np.empty((3, count), np.int64)
        _switch(columns, changed, forcing, basal_pressure, scheme)
        counts_then = accumulate(state, changed, *given, due_then, EXCESS)
        _update(columns, due_then, counts_then, forcing, basal_pressure, scheme)
    _update(columns, due, counts, forcing, basal_pressure, scheme)


def _account(forcing, dt, basal_pressure, scheme):
    """Return the arguments of `accumulate` that belong to a step: with plain tuples, see `core.structs`."""
    return forcing[:-1], dt, basal_pressure, tuple(scheme)


def synchronise_columns(columns, forcing, scheme):
    """Turn every column into pressures at levels, as they are now; arguments as in `advance_columns`."""
    count, state = columns.profile.shape[0], records(columns.memory)
    columns = LazyColumns(profile=columns.profile, state=state, clipped=columns.clipped)
    _synchronise(columns, np.arange(count), forcing, np.empty(count), scheme)


def _update(columns, due, counts, forcing, basal_pressure, scheme):
    """Advance the columns that `accumulate` has listed as due to the present.

    `due`, int, shape (3, n), lists the columns in its rows `AT_LEVELS` and `IN_MODES`, `counts` how many of each.
    `columns` are the `LazyColumns`, changed in place; `forcing` is the `ColumnForcing` of the step; `basal_pressure`,
    shape (n,), is written [Pa]; `scheme` holds the choices of the law.
    """
    if count := counts[AT_LEVELS]:
        _advance_levels(columns, due[AT_LEVELS, :count], forcing, basal_pressure, False, scheme)
    if count := counts[IN_MODES]:
        selected, modes = due[IN_MODES, :count].copy(), modes_of(scheme.levels)
        work = np.empty((2, scheme.levels))
        advance_modes(columns, selected, modes, work)
        # write the present basal pressure, and list the columns that are out of bounds
        _, state, _ = columns
        given = _account(forcing, 0.0, basal_pressure, scheme)
        counts = accumulate(state, selected, *given, due, ROUNDING)
        if count := counts[IN_MODES]:
            selected = due[IN_MODES, :count].copy()
            clip_modes(columns, selected, forcing, modes, work)
            accumulate(state, selected, *given, due, EXCESS)


def _switch(columns, selected, forcing, basal_pressure, scheme):
    """Put some columns on a base with another contact.

    `columns` are the `LazyColumns`, changed in place; `selected` are indices of columns, int; `forcing` is the
    `ColumnForcing` of the step; `basal_pressure`, shape (n,), is written [Pa]; `scheme` holds the choices of the law.
    """
    _, state, _ = columns
    before = forcing._replace(
        volume=forcing.volume - forcing.entrained, liquefaction_pressure=state["load"].copy()
    )  # fmt: skip
    _synchronise(columns, selected, before, basal_pressure, scheme)
    closing, modes = np.empty(selected.size, np.int64), modes_of(scheme.levels)
    work = np.empty((2, scheme.levels))
    if count := set_contact(columns, selected, forcing, scheme, closing):
        to_modes(columns, closing[:count], modes, work)
        advance_modes(columns, closing[:count], modes, work)


def _synchronise(columns, selected, forcing, basal_pressure, scheme):
    """Turn some columns into pressures at levels, as they are now.

    `columns` are the `LazyColumns`, changed in place; `selected` are indices of columns, int; `forcing` is the
    `ColumnForcing` of the step; `basal_pressure`, shape (n,), is written [Pa]; `scheme` holds the choices of the law.
    """
    _, state, _ = columns
    contact = state["contact"][selected]
    if (in_modes := selected[contact == IMPERMEABLE]).size:
        modes, work = modes_of(scheme.levels), np.empty((2, scheme.levels))
        advance_modes(columns, in_modes, modes, work)
        to_levels(columns, in_modes, modes, work)
        commit(columns, in_modes, forcing[:-1], basal_pressure)
    if (others := selected[contact > IMPERMEABLE]).size:
        _advance_levels(columns, others, forcing, basal_pressure, True, scheme)


def _advance_levels(columns, selected, forcing, basal_pressure, ending, scheme):
    """Advance some columns at levels from their last update to the present, and clip them.

    `columns` are the `LazyColumns`, changed in place; `selected` are indices of columns, int; `forcing` is the
    `ColumnForcing` of the step; `basal_pressure`, shape (n,), is written [Pa]; `scheme` holds the choices of the law.

    Unless their contact is ``ending``, diffusion that is to come after the remap is deferred to the next update. If the
    contact ends, the columns remember the boundary layer that levels do not resolve yet: the jump of pressure at the
    base, and the content of the layer over jump and thickness.
    """
    _, state, _ = columns
    work = np.empty((2, scheme.levels))
    modes, lists = modes_of(scheme.levels), np.empty((4, selected.size), np.int64)
    present = Present(volume=forcing.volume, load=forcing.liquefaction_pressure)
    counts = list_by_base(state, selected, forcing.volume, scheme.moves_with_grains, lists)
    sealed, grows, takes_in, stays = (some[:count] for some, count in zip(lists, counts, strict=True))
    if sealed.size:
        impermeable_inflow(columns, sealed, present, scheme)
    if grows.size:
        grow(columns, grows, present, ending, scheme, modes, work)
    if takes_in.size:
        grow_by_flux(columns, takes_in, present, scheme, modes, work)
    if stays.size:
        diffuse(columns, stays, present, ending, scheme, modes, work)
    commit(columns, selected, forcing[:-1], basal_pressure)
