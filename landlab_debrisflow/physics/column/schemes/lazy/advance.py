"""The default scheme: it advances the excess pore pressure of all columns in one call.

A column whose base is impermeable is kept as the waves it decays in (`impermeable_base`), exact at every step. One
that erodes has its base prescribed, so nobody needs its profile: it is kept as pressures at levels and
advanced when it has grown by some per cent, when its base changes, or for output (`prescribed_base`).

Each stage is a kernel of its own that goes through a list of columns and is called from here. One kernel
that called them all would be compiled with a copy of each, and most of them twice.
"""

import numpy as np

from .bookkeeping import BEYOND, CHANGED, DUE_LEVELS, DUE_WAVES, account, stand
from .flux_base import grow_by_flux, seal
from .impermeable_base import close, hold, look, open_up
from .modes import waves_of
from .prescribed_base import diffuse, grow, settle
from .state import CLOSED, CONTACT, CURRENT_LOAD, FLUX, LEVELS, SEALED, VOLUME

ROUNDING = 1e-9
"""Part of the load by which a closed column may be beyond its bounds once it was looked at."""


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
    memory, cells, due = columns.memory, columns.profile.shape[1] - 1, np.empty((3, basal_pressure.size), np.int64)

    def count(which, dt, waves=0, levels=0, slack=BEYOND):
        return account(memory, which, forcing, dt, basal_pressure, scheme, cells, due, waves, levels, slack)

    changed, waves, levels = count(np.arange(basal_pressure.size), dt)
    if changed:
        which = due[CHANGED, :changed]
        _switch(columns, which, forcing, basal_pressure, scheme)
        _, waves, levels = count(which, dt, waves, levels)
    if levels:
        _advance_levels(columns, due[DUE_LEVELS, :levels], forcing, basal_pressure, False, scheme)
    if waves:
        which = due[DUE_WAVES, :waves].copy()
        look(columns.profile, memory, which, waves_of(cells + 1))
        _, beyond, _ = count(which, 0.0, slack=ROUNDING)  # the base as it is seen now, and who is beyond its bounds
        if beyond:
            which = due[DUE_WAVES, :beyond].copy()
            hold(
                columns.profile, memory, which, waves_of(cells + 1), forcing.liquefaction_pressure, forcing.thickness,
                forcing.water_to_buoyant, columns.clipped,
            )  # fmt: skip
            count(which, 0.0)


def bring_columns(columns, forcing, scheme):
    """Turn every column into pressures at levels, as they are now; arguments as in `advance_columns`."""
    count = columns.profile.shape[0]
    _to_levels(columns, np.arange(count), forcing, np.empty(count), scheme)


def _switch(columns, which, forcing, basal_pressure, scheme):
    """Change what some columns stand on."""
    memory, closing = columns.memory, np.empty(which.size, np.int64)
    before = forcing._replace(
        volume=forcing.volume - forcing.entrained, liquefaction_pressure=memory[:, CURRENT_LOAD].copy()
    )
    _to_levels(columns, which, before, basal_pressure, scheme)
    if count := stand(memory, which, forcing, scheme, closing):
        _to_waves(columns, closing[:count])


def _to_levels(columns, which, forcing, basal_pressure, scheme):
    """Turn some columns into pressures at levels, as they are now."""
    profile, contact = columns.profile, columns.memory[which, CONTACT]
    if (closed := which[contact == CLOSED]).size:
        waves = waves_of(profile.shape[1])
        look(profile, columns.memory, closed, waves)
        open_up(profile, columns.memory, closed, waves)
        settle(columns, closed, forcing, basal_pressure)
    if (others := which[contact > CLOSED]).size:
        _advance_levels(columns, others, forcing, basal_pressure, True, scheme)


def _to_waves(columns, which):
    """Turn some columns, kept at levels, into waves."""
    waves = waves_of(columns.profile.shape[1])
    close(columns.profile, columns.memory, which, waves)
    look(columns.profile, columns.memory, which, waves)


def _advance_levels(columns, which, forcing, basal_pressure, ending, scheme):
    """Bring some columns kept at levels from where they were last advanced to the present, and hold their bounds.

    Unless their contact is ``ending``, diffusion that is to come after the stretching is left to the next time. If it
    ends, the jump at a base that has just changed, which levels do not see yet, and the content of the layer over it,
    over that jump and the thickness, are remembered.
    """
    profile, memory, volume, load = columns.profile, columns.memory, forcing.volume, forcing.liquefaction_pressure
    contact, waves = memory[which, CONTACT], waves_of(profile.shape[1])
    if (sealed := which[contact == SEALED]).size:
        seal(profile, memory, sealed, volume, load, scheme)
    growing = scheme.stretching & (contact != LEVELS) & (volume[which] > memory[which, VOLUME])
    if (some := which[growing & (contact < FLUX)]).size:
        grow(profile, memory, some, volume, load, ending, scheme, waves)
    if (some := which[growing & (contact >= FLUX)]).size:
        grow_by_flux(profile, memory, some, volume, load, scheme, waves)
    if (some := which[~growing & (contact != LEVELS)]).size:
        diffuse(profile, memory, some, volume, load, ending, scheme, waves)
    settle(columns, which, forcing, basal_pressure)
