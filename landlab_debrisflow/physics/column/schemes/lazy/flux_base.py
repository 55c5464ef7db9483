"""Columns that grow at a base without prescribed pressure: entrained soil brings only its own pressure.

Nothing diffuses in from the bed, so that the content of the column is conserved to the last digit.
"""

from .....core.jit import inner, kernel
from ..choices import OVERBURDEN, PROPORTIONAL
from .modes import NEUMANN, diffuse_profile
from .prescribed_base import LEAST_STRETCH, add_loading_by_erosion, load_strain, split_diffusion
from .remap import remap_profile


@kernel
def impermeable_inflow(columns, selected, present, scheme):
    """Give the soil that comes into columns the pressure of their base [Pa], and load it.

    Written is the pressure of the bed in the memory of the columns; arguments as in `grow_by_flux`.
    """
    profile, state, _ = columns
    volumes, loads = present
    for i in selected:
        column, volume, load = state[i], volumes[i], loads[i]
        start = column.volume_at_update
        column.base_pressure = column.bed_pressure = profile[i, 0]
        unstrained = column.load_at_update * volume / start if start > 0.0 else load
        if scheme.loading == OVERBURDEN:
            column.bed_pressure += load - unstrained
        elif scheme.loading == PROPORTIONAL and unstrained > 0.0:
            column.bed_pressure *= load / unstrained


@kernel
def grow_by_flux(columns, selected, present, scheme, modes, work):
    """Diffuse columns that grow by soil that brings its own pressure alone; see `prescribed_base.grow`.

    Parameters
    ----------
    columns : LazyColumns
        Written in place.
    selected : ndarray of int
        Indices of the columns.
    present : Present
    scheme : Scheme
        Choices of the law.
    modes : Modes
        Modes of columns with this number of levels.
    work : ndarray, shape (2, levels)
        Scratch.
    """
    profile, state, _ = columns
    volumes, loads = present
    for i in selected:
        column = state[i]
        volume, load, start, old_load = volumes[i], loads[i], column.volume_at_update, column.load_at_update
        base, new_base = column.base_pressure, column.bed_pressure
        stretch = max(start / volume, LEAST_STRETCH)
        first, last, source, last_source = split_diffusion(column, stretch, NEUMANN)
        weight, scale, entry, new_entry = 0.0, 1.0, -base, -new_base
        if scheme.loading == OVERBURDEN:
            weight, entry, new_entry = 1.0, old_load - base, load - new_base
        elif scheme.loading == PROPORTIONAL:
            scale = load_strain(load, old_load, volume, start)
            entry = entry * scale
        diffuse_profile(profile, i, NEUMANN, first, 0.0, 0.0, 0.0, 0.0, source, modes, work[0])
        # effective stress of the grains that were at the base, under the present load
        at_base = weight * old_load / stretch - scale * profile[i, 0]
        content = scale * _effective(profile, i, weight * old_load)
        content = stretch * content + (1.0 - stretch) * 0.5 * (entry + new_entry)
        remap_profile(profile, i, stretch, old_load, load, (weight, scale, entry, new_entry), work)
        _restore(profile, i, weight * load, content, min(at_base, new_entry), max(at_base, new_entry))
        if scheme.loads_by_erosion:
            add_loading_by_erosion(profile, i, stretch, load)
        diffuse_profile(profile, i, NEUMANN, last, 0.0, 0.0, 0.0, 0.0, last_source, modes, work[0])
        column.source_gain = column.deferred_diffusion = column.layer_jump = 0.0


@inner
def _effective(profile, i, load):
    """Return the mean of ``load * eta - p`` of one column [Pa].

    `profile`, shape (n, levels), is read in row `i` [Pa]; `load` is the liquefaction pressure [Pa].
    """
    cells = profile.shape[1] - 1
    content = 0.5 * (load - profile[i, 0])
    for k in range(1, cells):
        content += load * (cells - k) / cells - profile[i, k]
    return content / cells


@inner
def _restore(profile, i, load, content, low, high):
    """Restore the content of one column that remap and rounding changed: nothing diffuses in from the bed.

    `profile`, shape (n, levels), is changed in row `i`; `load` is its load, `content` the mean of load * eta - p that
    it is to have [Pa].

    The base level takes the difference as far as its bounds ``low`` and ``high`` [Pa] allow. The rest goes to the
    levels above, none of which may exceed the level below, both over eta.
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
