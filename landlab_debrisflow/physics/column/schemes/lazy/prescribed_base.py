"""Columns over a prescribed base: kept as pressures at levels, updated once for several steps.

In an update a column diffuses, is stretched (`remap`), and diffuses again. The part of the diffusion after the remap
depends on the stretching, and is half if little diffuses; it is put off and joined to the first diffusion of the next
update. Over a base that has just changed, a layer forms that levels do not resolve (`boundary_layer`).

The base level stands for half a cell. If a base starts to erode, the boundary layer fills this half cell gradually. So
a profile does not jump when the contact changes, and a contact that changes back and forth pumps no pressure in.
"""

import math

from .....core.jit import inner, kernel
from ..choices import OVERBURDEN, PROPORTIONAL, UNLOADED
from ..contact import INFLOW
from .boundary_layer import basal_filling, boundary_layer, is_resolved, layer_content
from .modes import DIRICHLET, NEUMANN, bounds_of, diffuse_profile
from .remap import remap_profile

LEAST_STRETCH = 1e-9  # volume before over volume after below which no old soil is left
LAYER_END = 0.05  # largest c_v t / h^2 at which the layer over a base that has just changed has not reached the surface


@inner
def load_strain(load, old_load, volume, start):
    """Return the ratio of new to old load without erosion [-]; 1 without load, where the bounds empty the column.

    `load` and `old_load` are liquefaction pressures, `volume` and `start` volumes, now and at the last update [Pa, m3].
    """
    return load * start / (old_load * volume) if old_load > 0.0 and load > 0.0 and volume > 0.0 else 1.0


@kernel
def diffuse(columns, selected, present, ending, scheme, modes, work):
    """Diffuse and load columns whose grains keep their place; arguments as in `grow`.

    `columns` are the `LazyColumns`, changed in place; `selected` are indices of some, int.
    """
    profile, state, _ = columns
    volumes, loads = present
    cells = profile.shape[1] - 1
    for i in selected:
        column = state[i]
        volume, load, start, old_load = volumes[i], loads[i], column.volume_at_update, column.load_at_update
        base, new_base, base_level = column.base_pressure, column.bed_pressure, profile[i, 0]
        diffusion, load_gain, scale = column.deferred_diffusion + column.diffusion, 0.0, 1.0
        strain = load_strain(load, old_load, volume, start)
        if scheme.loading == OVERBURDEN:
            growth = volume / start if start > 0.0 else 1.0
            load_gain = 0.5 * old_load * (1.0 + growth) * (strain - 1.0)
            if scheme.loads_by_erosion:
                load_gain = load - old_load
        elif scheme.loading == PROPORTIONAL:
            scale = math.sqrt(strain)
        for k in range(cells):
            profile[i, k] *= scale
        is_new, flux = column.contact_is_new > 0.0, column.contact >= INFLOW
        condition, first, last = (NEUMANN, 0.0, 0.0) if flux else (DIRICHLET, base * scale, new_base / scale)
        kink = (base_level - base) * scale if is_new and not flux else 0.0
        diffuse_profile(
            profile, i, condition, diffusion, first, last, kink, load_gain, column.source_gain, modes, work[0]
        )
        for k in range(cells):
            profile[i, k] *= scale
        column.source_gain = column.deferred_diffusion = column.layer_jump = 0.0
        if flux:
            continue
        profile[i, 0] = new_base
        if is_new and ending and not is_resolved(cells, 0.0, diffusion):
            inside = base_level * scale * scale + load_gain
            jump, first_jump = new_base - inside, (base - base_level) * scale * scale
            if jump != 0.0:
                # a jump that came evenly in time acts as two jumps of half the size (Gauss); 2/3 as much has diffused
                # in
                evenly = min(max(1.0 - first_jump / jump, 0.0), 1.0)
                _fill_base_level(profile, column, i, (inside, jump, evenly), 0.0, diffusion)


@kernel
def grow(columns, selected, present, ending, scheme, modes, work):
    """Diffuse columns that grow by soil that comes in at a prescribed base.

    The grains carry ``weight * load * eta - p``, which is the effective stress or minus the pressure; ``entry`` is its
    value in the soil that comes in.

    Parameters
    ----------
    columns : LazyColumns
        Written in place.
    selected : ndarray of int
        Indices of the columns.
    present : Present
    ending : bool
        Whether this is the last update over this contact.
    scheme : Scheme
        Choices of the law.
    modes : Modes
        Modes of columns with this number of levels.
    work : ndarray, shape (2, levels)
        Scratch.
    """
    profile, state, _ = columns
    volumes, loads = present
    cells = profile.shape[1] - 1
    for i in selected:
        column = state[i]
        volume, load, start, old_load = volumes[i], loads[i], column.volume_at_update, column.load_at_update
        base, new_base, base_level = column.base_pressure, column.bed_pressure, profile[i, 0]
        stretch = max(start / volume, LEAST_STRETCH)
        first, last, source, last_source = split_diffusion(column, stretch, DIRICHLET)
        weight, scale, entry, new_entry = 0.0, 1.0, -base, -new_base
        if scheme.loading == OVERBURDEN:
            weight, entry, new_entry = 1.0, old_load - base, load - new_base
        elif scheme.loading == PROPORTIONAL:
            scale = load_strain(load, old_load, volume, start)
            entry = entry * scale
        # over a base that has just changed: advance the column as if it had not changed, then add the boundary layer
        diffusion = column.diffusion
        fresh = column.contact_is_new > 0.0 and diffusion < LAYER_END
        low, high, low_slope, high_slope = bounds_of(profile, i, base, base, modes.eta)
        given, jump, new_jump = base, 0.0, 0.0
        # the column without the layer takes in soil with its own ratio at the base, so that a constant ratio stays one
        if fresh:
            given, carried = base_level, scale * (weight * old_load - base_level)
            growth = 1.0 if scheme.loading == UNLOADED else 1.0 / stretch
            jump, new_jump = carried - entry, carried * growth - new_entry
            entry, new_entry = carried, carried * growth
        diffuse_profile(profile, i, DIRICHLET, first, given, given, base_level - given, 0.0, source, modes, work[0])
        remap_profile(profile, i, stretch, old_load, load, (weight, scale, entry, new_entry), work)
        if scheme.loads_by_erosion:
            add_loading_by_erosion(profile, i, stretch, load)
        inside = weight * load - new_entry
        column.source_gain, column.deferred_diffusion, column.layer_jump = last_source, last, 0.0
        if ending or fresh:
            diffuse_profile(profile, i, DIRICHLET, last, inside, inside, 0.0, 0.0, last_source, modes, work[0])
            column.source_gain = column.deferred_diffusion = 0.0
        profile[i, 0] = new_base
        if not fresh:
            continue
        # bounds of the column move with its grains and their load, and must enclose the base
        loaded, growth, diffusion = weight * (load - old_load / stretch), 1.0 - stretch, diffusion * stretch
        larger, pull = max(scale, 1.0), scale / stretch
        bounds = (
            min(low * larger, new_base) + min(loaded, 0.0), max(high * larger, new_base) + max(loaded, 0.0),
            min(low_slope * pull + loaded, new_base), max(high_slope * pull + loaded, new_base),
        )  # fmt: skip
        _add_layer(profile, i, (jump, new_jump), growth, diffusion, bounds, modes.eta)
        if ending and not is_resolved(cells, growth, diffusion):
            _fill_base_level(profile, column, i, (inside, new_base - inside, 0.0), growth, diffusion)


@inner
def split_diffusion(column, stretch, condition):
    """Return the diffusion before and after the remap [-], and the parts of the gain by a source in both [Pa]."""
    diffusion = column.diffusion
    after = diffusion_after(diffusion, condition)
    # c_v t / h^2 before the remap counts with the thickness before
    first, last = column.deferred_diffusion + (diffusion - after) / stretch, after * stretch
    last_source = column.source_gain * last / (diffusion * stretch) if diffusion > 0.0 else 0.0
    return first, last, column.source_gain - last_source, last_source


@kernel
def commit(columns, selected, forcing, basal_pressure):
    """Record the present as the last update of columns at levels, and clip them to liquefaction.

    `columns` are the `LazyColumns`, `selected` indices of some, int; `forcing` are the members of the `ColumnForcing`,
    without shearing; `basal_pressure` has shape (n,).

    Pressure removed by the clip is counted. Where the bed does not prescribe the basal pressure [Pa], it is written.
    """
    profile, state, clipped = columns
    volumes, thicknesses, loads, _, _, _, _, _, lower, bounded = forcing
    cells = profile.shape[1] - 1
    for i in selected:
        column, load = state[i], loads[i]
        column.contact_is_new, column.volume_at_update, column.load_at_update = 0.0, volumes[i], load
        column.base_pressure, column.diffusion = column.bed_pressure, 0.0
        if bounded:
            removed = 0.0
            for k in range(cells):
                pressure, most = profile[i, k], load * (cells - k) / cells
                profile[i, k] = min(pressure, most)
                removed += (pressure - profile[i, k]) * (0.5 if k == 0 else 1.0)
            clipped[i] += removed * thicknesses[i] / cells
        if column.contact >= INFLOW:
            suction = -lower * load if bounded else profile[i, 0]
            basal_pressure[i] = max(profile[i, 0], suction)


@inner
def _fill_base_level(profile, column, i, change, growth, diffusion):
    """Fill the half cell of the base level with the boundary layer over a base that has just changed.

    `profile`, shape (n, levels), is changed in row `i` [Pa], as is `column`, its memory; `growth` and `diffusion` are
    as in `boundary_layer` [-].

    ``change`` is the pressure inside [Pa], the jump of the base over it [Pa], and the fraction of the jump that came
    evenly in time; the rest came at once.
    """
    inside, jump, evenly = change
    cells, filling = profile.shape[1] - 1, 0.0
    for weight, time in ((1.0 - evenly, 1.0), (0.5 * evenly, 0.2113), (0.5 * evenly, 0.7887)):
        if weight > 0.0:
            filling += weight * basal_filling(cells, growth, time * diffusion)
    profile[i, 0] = inside + filling * jump
    column.layer_jump = jump
    column.layer_content = (1.0 - evenly / 3.0) * layer_content(growth, diffusion)


@inner
def diffusion_after(diffusion, condition):
    """Return the part of the diffusion of an update that comes after its remap [-].

    With this part the slowest mode decays as much as if diffusion and growth went on together.
    """
    rate = math.pi * math.pi * (1.0 if condition == DIRICHLET else 0.25)
    x = rate * diffusion
    if x < 1e-3:
        return diffusion * (0.5 - x / 24.0)
    return math.log(x / -math.expm1(-x)) / rate


@inner
def add_loading_by_erosion(profile, i, stretch, load):
    """Add the source by loading with the whole dh/dt, erosion included, to the letter of the paper [Pa].

    `profile`, shape (n, levels), is changed in row `i`; `stretch` is the volume before over that after [-], `load` the
    liquefaction pressure [Pa].
    """
    cells = profile.shape[1] - 1
    for k in range(cells):
        eta = (cells - k) / cells
        profile[i, k] -= load * eta * math.log(max(stretch, eta))


@inner
def _add_layer(profile, i, jumps, growth, diffusion, bounds, eta):
    """Add the layer over a base that has just changed; ``jumps`` are the jump at the start and at the end [Pa].

    `profile`, shape (n, levels), is changed in row `i` [Pa]; `growth` and `diffusion` are as in `boundary_layer`, `eta`
    is 1 at the base and 0 at the surface [-].

    ``bounds`` are the least and largest pressure, and pressure over eta, that the column may have [Pa].
    """
    cells = profile.shape[1] - 1
    jump, new_jump = jumps
    low, high, low_slope, high_slope = bounds
    for k in range(1, cells):
        distance = 1.0 - eta[k]
        layer = boundary_layer(distance, growth, diffusion) - boundary_layer(2.0 - distance, growth, diffusion)
        early = min(distance / growth, 1.0) if growth > 0.0 else 0.0
        pressure = profile[i, k] + layer * (new_jump + early * (jump - new_jump))
        profile[i, k] = min(max(pressure, low, low_slope * eta[k]), high, high_slope * eta[k])
