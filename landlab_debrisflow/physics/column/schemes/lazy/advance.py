"""The default scheme: it advances the excess pore pressure of all columns in one call.

A column whose base is impermeable is kept as the modes it decays in (`impermeable_base`), exact at every step. One
that erodes has its base prescribed, so that its profile is not needed: it is kept as pressures at levels and
advanced when it has grown by some per cent, when its base changes, or for output (`prescribed_base`).

Each stage is a kernel of its own that goes through a list of columns and is called from here. One kernel
that called them all would be compiled with a copy of each, and most of them twice.
"""

import numpy as np

from ..contact import IMPERMEABLE, INFLOW, SEALED
from .bookkeeping import AT_LEVELS, CHANGED, EXCESS, IN_MODES, DueColumns, accumulate, set_contact
from .flux_base import grow_by_flux, impermeable_inflow
from .impermeable_base import advance_modes, clip_modes, to_levels, to_modes
from .modes import modes_of
from .prescribed_base import commit, diffuse, grow
from .state import lazy_columns

ROUNDING = 1e-9
"""Pressure out of bounds over the load that a column in modes may have just after an update [-]."""


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
        Written: the excess pore pressure that friction feels [Pa].
    scheme : Scheme
        Choices of the law.
    """
    columns, count, levels = lazy_columns(columns), basal_pressure.size, columns.profile.shape[1]
    due = DueColumns(np.empty((3, count), np.int64), np.zeros(3, np.int64))
    accumulate(columns, np.arange(count), forcing, dt, basal_pressure, scheme, due, EXCESS)
    if due.counts[CHANGED]:
        changed = due.take(CHANGED)
        _switch(columns, changed, forcing, basal_pressure, scheme)
        accumulate(columns, changed, forcing, dt, basal_pressure, scheme, due, EXCESS)
    if due.counts[AT_LEVELS]:
        _advance_levels(columns, due.take(AT_LEVELS), forcing, basal_pressure, False, scheme)
    if due.counts[IN_MODES]:
        advanced = due.take(IN_MODES)
        advance_modes(columns, advanced, modes_of(levels))
        accumulate(columns, advanced, forcing, 0.0, basal_pressure, scheme, due, ROUNDING)  # the base as it is now
        if due.counts[IN_MODES]:
            out_of_bounds = due.take(IN_MODES)
            clip_modes(columns, out_of_bounds, forcing, modes_of(levels))
            accumulate(columns, out_of_bounds, forcing, 0.0, basal_pressure, scheme, due, EXCESS)


def synchronise_columns(columns, forcing, scheme):
    """Turn every column into pressures at levels, as they are now; arguments as in `advance_columns`."""
    count = columns.profile.shape[0]
    _synchronise(lazy_columns(columns), np.arange(count), forcing, np.empty(count), scheme)


def _switch(columns, selected, forcing, basal_pressure, scheme):
    """Put some columns on another base."""
    before = forcing._replace(
        volume=forcing.volume - forcing.entrained, liquefaction_pressure=columns.state["load"].copy()
    )
    _synchronise(columns, selected, before, basal_pressure, scheme)
    closing, modes = np.empty(selected.size, np.int64), modes_of(columns.profile.shape[1])
    if count := set_contact(columns, selected, forcing, scheme, closing):
        to_modes(columns, closing[:count], modes)
        advance_modes(columns, closing[:count], modes)


def _synchronise(columns, selected, forcing, basal_pressure, scheme):
    """Turn some columns into pressures at levels, as they are now."""
    contact = columns.state["contact"][selected]
    if (in_modes := selected[contact == IMPERMEABLE]).size:
        modes = modes_of(columns.profile.shape[1])
        advance_modes(columns, in_modes, modes)
        to_levels(columns, in_modes, modes)
        commit(columns, in_modes, forcing, basal_pressure)
    if (others := selected[contact > IMPERMEABLE]).size:
        _advance_levels(columns, others, forcing, basal_pressure, True, scheme)


def _advance_levels(columns, selected, forcing, basal_pressure, ending, scheme):
    """Advance some columns at levels from their last update to the present, and clip them.

    Unless their contact is ``ending``, diffusion that is to come after the remap is deferred to the next update. If it
    ends, the jump at a base that has just changed, which levels do not see yet, and the content of the layer over it,
    over that jump and the thickness, are remembered.
    """
    contact, volume = columns.state["contact"][selected], forcing.volume[selected]
    modes = modes_of(columns.profile.shape[1])
    if (some := selected[contact == SEALED]).size:
        impermeable_inflow(columns, some, forcing, scheme)
    growing = scheme.moves_with_grains & (volume > columns.state["volume_at_update"][selected])
    if (some := selected[growing & (contact < INFLOW)]).size:
        grow(columns, some, forcing, ending, scheme, modes)
    if (some := selected[growing & (contact >= INFLOW)]).size:
        grow_by_flux(columns, some, forcing, scheme, modes)
    if (some := selected[~growing]).size:
        diffuse(columns, some, forcing, ending, scheme, modes)
    commit(columns, selected, forcing, basal_pressure)
