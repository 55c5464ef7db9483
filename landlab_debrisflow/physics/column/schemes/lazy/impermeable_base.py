"""Columns over an impermeable base, kept as amplitudes of decaying modes, exact after any time.

Friction needs the basal pressure at every step. Between two updates of the modes a parabola in time gives it, with an
error that the modes bound. A load that comes after the update raises the basal pressure by its own amount; the part
that diffuses away from the base grows with the square root of time.
"""

import math

from .....core.jit import inner, kernel
from ..contact import BY_EROSION, IMPERMEABLE
from .boundary_layer import boundary_layer, layer_content, mode_of_layer
from .modes import BRIEF, NEUMANN, bounds_of
from .state import BANDS


@inner
def base_slope(profile, i, cells):
    """Return dp/d(eta) at the base, extrapolated from above, at most twice that of the lowest cell [Pa].

    `profile`, shape (n, levels), is read in row `i` [Pa]; `cells` is the number of intervals between levels.
    """
    step, next_step = profile[i, 0] - profile[i, 1], profile[i, 1] - profile[i, 2]
    slope = 1.5 * step - 0.5 * next_step
    return min(max(slope, min(0.0, 2.0 * step)), max(0.0, 2.0 * step)) * cells


@kernel
def to_modes(columns, selected, modes, work):
    """Turn columns at levels into modes over an impermeable base; `advance_modes` comes next.

    Over the base there may be a boundary layer too thin for the levels, with a known jump and content
    (`prescribed_base`). It is represented as diffusion from a base held at that jump, and is turned into modes
    separately: the modes that levels resolve get the part of its content that levels hold, the shorter modes the part
    that is missing at the base.

    Parameters
    ----------
    columns : LazyColumns
        Written in place.
    selected : ndarray of int
        Indices of the columns.
    modes : Modes
        Modes of columns with this number of levels.
    work : ndarray, shape (2, levels)
        Scratch.
    """
    profile, state, _ = columns
    cells = profile.shape[1] - 1
    levels, of_layer = work[0, :cells], work[1, :cells]
    for i in selected:
        column = state[i]
        jump, content = column.layer_jump, column.layer_content
        bed = column.bed_pressure if jump != 0.0 else profile[i, 0]
        diffusion, removed, kept = 0.25 * math.pi * content * content, 0.0, 0.0
        low, high, low_slope, high_slope = bounds_of(
            profile, i, min(bed, profile[i, 0]), max(bed, profile[i, 0]), modes.eta
        )
        if jump != 0.0:
            missing = cells * layer_content(0.0, diffusion)
            for k in range(1, cells):
                pressure = boundary_layer(k / cells, 0.0, diffusion)
                missing -= pressure
                profile[i, k] -= jump * pressure
                removed += jump * pressure
            filling = min(max(2.0 * missing, 0.0), 1.0)  # the same as `boundary_layer.basal_filling`
            profile[i, 0] -= jump * filling
            removed += 0.5 * jump * filling
            for j in range(cells):
                of_layer[j] = jump * mode_of_layer(math.sqrt(modes.squares[j]), diffusion)
                kept += of_layer[j] * 0.5 * cells * modes.uniform[NEUMANN, 0, j]
        scale = removed / kept if kept != 0.0 else 0.0  # differs from 1 by the error of the levels
        slope = base_slope(profile, i, cells)
        unseen = bed - profile[i, 0]
        for k in range(cells):
            levels[k] = profile[i, k] - slope * modes.eta[k]
        for j in range(cells):
            amplitude = slope * modes.ramp[NEUMANN, 0, j]
            for k in range(cells):
                amplitude += modes.project[NEUMANN, k, j] * levels[k]
            if scale != 0.0:
                amplitude, unseen = amplitude + scale * of_layer[j], unseen - scale * of_layer[j]
            profile[i, j] = amplitude
        for band in range(BANDS):  # each band by its middle mode; the last one takes the rest
            amplitude = 0.0
            if scale != 0.0:
                amplitude = cells * 2**band * jump * mode_of_layer(math.sqrt(modes.band_rate) * 2**band, diffusion)
                amplitude = unseen if band == BANDS - 1 else math.copysign(min(abs(amplitude), abs(unseen)), unseen)
            column.layer_bands[band] = amplitude
            unseen -= amplitude
        for band in range(BANDS):
            column.unresolved_bands[band] = slope * modes.bands[band]
        column.contact, column.layer_jump = IMPERMEABLE, 0.0
        column.lowest_pressure, column.highest_pressure = low, high
        column.lowest_slope, column.highest_slope = low_slope, high_slope
        _forget_loads(column)


@inner
def _forget_loads(column):
    """Begin a new account of diffusion [-], load and source [Pa] since the last update in the memory of one column."""
    column.diffusion = column.load_gain = column.source_gain = column.load_variation = 0.0
    column.load_scale = 1.0


@kernel
def to_levels(columns, selected, modes, work):
    """Turn columns in modes, just updated, into pressures at levels; arguments as in `to_modes`."""
    profile, state, _ = columns
    cells = profile.shape[1] - 1
    levels = work[0, :cells]
    for i in selected:
        column = state[i]
        _synthesise(profile, column, i, modes, levels)
        low, high, lost = column.lowest_pressure, column.highest_pressure, 0.0
        low_slope, high_slope = column.lowest_slope, column.highest_slope
        for k in range(cells):
            eta = modes.eta[k]
            profile[i, k] = min(max(levels[k], low, low_slope * eta), high, high_slope * eta)
            lost += (levels[k] - profile[i, k]) * (0.5 if k == 0 else 1.0)
        # the base level takes the pressure that the bounds cut off, as far as its own bounds allow, to keep the content
        profile[i, 0] = min(max(profile[i, 0] + 2.0 * lost, low, low_slope), high, high_slope)
        profile[i, cells] = 0.0
        column.contact, column.layer_jump = BY_EROSION, 0.0


@kernel
def advance_modes(columns, selected, modes, work):
    """Update columns in modes: let them decay under the loads since the last update; arguments as in `to_modes`."""
    profile, state, _ = columns
    ramp, uniform = modes.ramp[NEUMANN], modes.uniform[NEUMANN]
    cells = profile.shape[1] - 1
    factors = work[0]
    for i in selected:
        column = state[i]
        diffusion, load_gain, source_gain = column.diffusion, column.load_gain, column.source_gain
        scale = column.load_scale
        decay = math.exp(-0.25 * math.pi * math.pi * diffusion)
        square = decay * decay
        factor = square * square
        factor = factor * factor
        ratio = factor
        for j in range(cells):  # factors exp(-number^2 diffusion), by products instead of one exponential for each mode
            factors[j] = decay
            decay *= ratio
            ratio *= factor
        if load_gain != 0.0 or source_gain != 0.0:
            # gain of a mode: exact, or linear in time where the exact formula loses digits
            brief = diffusion < BRIEF
            rate, now = (0.0, 0.5) if brief else (1.0 / diffusion, 0.0)
            for j in range(cells):
                steady = rate * (load_gain * ramp[1, j] + source_gain * uniform[1, j])
                gained = now * (load_gain * ramp[0, j] + source_gain * uniform[0, j])
                profile[i, j] = (profile[i, j] * scale - steady + gained) * factors[j] + steady + gained
        else:
            for j in range(cells):
                profile[i, j] *= scale * factors[j]
        square = modes.band_rate
        decay = math.exp(-square * diffusion)
        unresolved_bands, layer_bands = column.unresolved_bands, column.layer_bands
        for band in range(BANDS):
            x = square * diffusion
            evenly = (1.0 - decay) / x if x > BRIEF else 1.0 - 0.5 * x
            layer_bands[band] *= scale * decay
            unresolved_bands[band] = unresolved_bands[band] * scale * decay + load_gain * modes.bands[band] * evenly
            decay *= decay
            decay *= decay
            square *= 4.0
        _expand_base(profile, column, i, modes)
        low, high, low_slope, high_slope = bounds_with_gains(column)
        column.lowest_pressure, column.highest_pressure = low, high
        column.lowest_slope = low_slope + cells * min(source_gain, 0.0)
        column.highest_slope = high_slope + cells * max(source_gain, 0.0)
        _forget_loads(column)


@inner
def _expand_base(profile, column, i, modes):
    """Write the pressure at the base of one column, its parabola in c_v t / h^2 and the bound of the remainder [Pa].

    `profile`, shape (n, levels), holds amplitudes [Pa] in row `i`; `column`, the memory of the column, is written;
    `modes` are the constants of the modes.
    """
    pressure, rate, bend, remainder = 0.0, 0.0, 0.0, 0.0
    square = modes.band_rate
    unresolved_bands, layer_bands = column.unresolved_bands, column.layer_bands
    for band in range(BANDS):
        amplitude = unresolved_bands[band] + layer_bands[band]
        first = square * amplitude
        second = square * first
        pressure += amplitude
        rate += first
        bend += second
        remainder += square * abs(second)
        square *= 4.0
    for j in range(profile.shape[1] - 1):
        square, amplitude = modes.squares[j], profile[i, j]
        first = square * amplitude
        second = square * first
        pressure += amplitude
        rate += first
        bend += second
        remainder += square * abs(second)
    column.base_pressure = pressure
    column.base_rate, column.base_curvature, column.remainder = -rate, bend / 2.0, remainder / 6.0


@kernel
def clip_modes(columns, selected, forcing, modes, work):
    """Clip columns in modes, just updated, to liquefaction at their levels; count the pressure removed.

    `columns` are the `LazyColumns`, changed in place; `selected` are indices of some, int; `forcing` holds load [Pa]
    and thickness [m]; `work`, shape (2, levels), is scratch.

    Modes too short for the levels are not changed.
    """
    profile, state, clipped = columns
    loads, thicknesses = forcing.liquefaction_pressure, forcing.thickness
    cells = profile.shape[1] - 1
    levels = work[0, :cells]
    for i in selected:
        column = state[i]
        _synthesise(profile, column, i, modes, levels)
        load, removed = loads[i], 0.0
        for k in range(cells):
            taken = max(levels[k] - load * modes.eta[k], 0.0)
            removed += taken * (0.5 if k == 0 else 1.0)
            if taken > 0.0:
                for j in range(cells):
                    profile[i, j] -= modes.project[NEUMANN, k, j] * taken
        clipped[i] += removed * thicknesses[i] / cells
        column.highest_pressure = min(column.highest_pressure, load)
        column.highest_slope = min(column.highest_slope, load)
        _expand_base(profile, column, i, modes)


@inner
def _synthesise(profile, column, i, modes, levels):
    """Write the pressures of one column at the levels [Pa]; a thin layer enters the base level by its content only.

    `profile`, shape (n, levels), holds amplitudes [Pa] in row `i`, `column` is the memory of that column; `levels`,
    shape (levels - 1,), is written from the base upwards.
    """
    unresolved_bands, tail = column.unresolved_bands, 0.0
    for band in range(BANDS):
        tail += unresolved_bands[band]
    tail /= modes.pattern[NEUMANN, 0]
    for k in range(levels.size):
        levels[k] = tail * modes.pattern[NEUMANN, k]
    for j in range(levels.size):
        for k in range(levels.size):
            levels[k] += profile[i, j] * modes.shapes[NEUMANN, j, k]


@inner
def bounds_with_gains(column):
    """Return the bounds of one column with all gains since the last update [Pa]; see `modes.bounds_of`."""
    load_gain, scale, source_gain = column.load_gain, column.load_scale, column.source_gain
    fall = min(load_gain, 0.0) + min(source_gain, 0.0)
    rise = max(load_gain, 0.0) + max(source_gain, 0.0)
    return (
        column.lowest_pressure * scale + fall, column.highest_pressure * scale + rise,
        min(column.lowest_slope * scale + load_gain + min(source_gain, 0.0), 0.0),
        max(column.highest_slope * scale + load_gain + max(source_gain, 0.0), 0.0),
    )  # fmt: skip
