"""Columns that grow at a base whose pressure is not prescribed: soil that comes in brings its own and no more.

Nothing diffuses in from the bed, so that the content of the column is held to the last digit.
"""

import numpy as np

from .....core.jit import inner, kernel
from ..choices import OVERBURDEN, PROPORTIONAL
from .modes import IMPERMEABLE, evolve
from .prescribed_base import LEAST_STRETCH, load_literally, parts_of, strain_of
from .remap import stretch_profile
from .state import BASE, BED_PRESSURE, JUMP, LOAD, OWED, SOURCE, VOLUME


@kernel
def seal(profile, memory, which, volumes, loads, scheme):
    """Let the soil that comes into some columns have the pressure of their base, and be loaded with it."""
    for i in which:
        volume, load = volumes[i], loads[i]
        memory[i, BASE] = memory[i, BED_PRESSURE] = profile[i, 0]
        unstrained = memory[i, LOAD] * volume / memory[i, VOLUME] if memory[i, VOLUME] > 0.0 else load
        if scheme.loading == OVERBURDEN:
            memory[i, BED_PRESSURE] += load - unstrained
        elif scheme.loading == PROPORTIONAL and unstrained > 0.0:
            memory[i, BED_PRESSURE] *= load / unstrained


@kernel
def grow_by_flux(profile, memory, which, volumes, loads, scheme, waves):
    """Let some columns diffuse and grow by soil that brings its own pressure alone; see `prescribed_base.grow`."""
    cells = profile.shape[1] - 1
    work = np.empty((2, cells + 1))
    for i in which:
        volume, load, start, old_load = volumes[i], loads[i], memory[i, VOLUME], memory[i, LOAD]
        base, new_base = memory[i, BASE], memory[i, BED_PRESSURE]
        stretch = max(start / volume, LEAST_STRETCH)
        first, last, source, last_source = parts_of(memory, i, stretch, IMPERMEABLE)
        weight, scale, entry, new_entry = 0.0, 1.0, -base, -new_base
        if scheme.loading == OVERBURDEN:
            weight, entry, new_entry = 1.0, old_load - base, load - new_base
        elif scheme.loading == PROPORTIONAL:
            scale = strain_of(load, old_load, volume, start)
            entry = entry * scale
        evolve(profile, i, IMPERMEABLE, first, 0.0, 0.0, 0.0, 0.0, source, waves, work[0])
        held = weight * old_load / stretch - scale * profile[i, 0]  # as deep as the base is now
        content = scale * _effective(profile, i, weight * old_load)
        content = stretch * content + (1.0 - stretch) * 0.5 * (entry + new_entry)
        stretch_profile(profile, i, stretch, old_load, load, weight, scale, entry, new_entry, work)
        _restore(profile, i, weight * load, content, min(held, new_entry), max(held, new_entry))
        if scheme.literal:
            load_literally(profile, i, stretch, load)
        evolve(profile, i, IMPERMEABLE, last, 0.0, 0.0, 0.0, 0.0, last_source, waves, work[0])
        memory[i, SOURCE] = memory[i, OWED] = memory[i, JUMP] = 0.0


@inner
def _effective(profile, i, load):
    """Return the mean of ``load * eta - p`` of one column [Pa]."""
    cells = profile.shape[1] - 1
    content = 0.5 * (load - profile[i, 0])
    for k in range(1, cells):
        content += load * (cells - k) / cells - profile[i, k]
    return content / cells


@inner
def _restore(profile, i, load, content, low, high):
    """Give one column what its content lacks: nothing diffuses in from the bed, so that it must not drift.

    The base level takes it between ``low`` and ``high``, and what is left goes to the levels above, none of which goes
    beyond the one below it, over eta.
    """
    cells = profile.shape[1] - 1
    profile[i, 0] = load
    lacking = cells * (content - _effective(profile, i, load))
    below = min(max(2.0 * lacking, low), high)
    profile[i, 0] = load - below
    lacking -= 0.5 * below
    for k in range(1, cells):
        carried = load * (cells - k) / cells - profile[i, k]
        below *= (cells - k) / (cells - k + 1.0)
        taken = min(max(lacking, min(below - carried, 0.0)), max(below - carried, 0.0))
        profile[i, k] -= taken
        lacking -= taken
        below = carried + taken
