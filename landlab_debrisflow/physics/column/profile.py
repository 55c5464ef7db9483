"""The kernel of the column laws: it advances the excess pore pressure of all columns in one call.

With ``eta = y/h`` the fraction of the depth below the surface, a grain keeps its depth while soil
comes in at the base, so that over any interval it moves from ``eta`` to ``a eta``, ``a`` being the
volume before over the volume after (theory, section 3; eq. 35 of Pastor et al., 2022, integrated).
An interval is taken as half of this deformation and of the loading, all of the diffusion, and the
other half: second order in the interval, while each part is exact by itself.

The deformation interpolates the effective stress, so that a liquefied grain stays so. The diffusion
evolves the sines through the levels by their own decay: no error in time and no limit on the step.
Both are held between the values they started from. A base that has just become impermeable finds a
slope that relaxes as the square root of time in a layer no level resolves; that part is evolved by
all its waves, and friction gets the law of the half space until levels can see it. A profile does not
jump on a switch: the base level keeps the pressure of the bed, that of the soil that came in last.
"""

import math
from typing import NamedTuple

import numpy as np

from ...core.jit import kernel
from .modes import Modes, column_modes

OVERBURDEN, PROPORTIONAL, UNLOADED = 0, 1, 2
LOADING = {"overburden": OVERBURDEN, "proportional": PROPORTIONAL, "none": UNLOADED}
# Values of ColumnState.eroding: is the profile that of such a base, or not yet?
IMPERMEABLE, JUST_IMPERMEABLE, PRESCRIBED, JUST_PRESCRIBED = -1, 0, 1, 2
# A column is advanced when one of these is exceeded since it was last. They follow from measuring the
# error of the pressure that friction feels (benchmarks/column.py) against the cost; what has the width
# of a level in it lets the error in time fall with the one in space.
GROWTH_DUE = 1.1  # volume over volume then
STRAIN_DUE = 1.0  # change of the load not by erosion, over the load, in widths of a level
DIFFUSION_DUE = 0.05  # c_v t / h^2 in widths of a level
LAYER_DUE = 0.5  # c_v t / h^2 in squared widths: when levels resolve the layer at a base just closed
SHARE_DUE, LEAST_DUE = 0.3, 1e-4  # c_v t / h^2 over that since the last switch, and the least
LOADED_DUE = 1.25e-5  # c_v t / h^2 times the squared change of the load over the load
DIFFUSION_CAP = 1e3  # c_v t / h^2 that leaves nothing


class Scheme(NamedTuple):
    """What tells one law from another."""

    stretching: bool  # grains keep their depth (ALE); else they keep their fraction of it (classical)
    loading: int  # a value of LOADING
    modes: Modes


def scheme_of(stretching: bool, loading_source: str, levels: int) -> Scheme:
    """Return the scheme of a law from its parameters."""
    return Scheme(stretching, LOADING[loading_source], column_modes(levels))


@kernel
def _interpolate(values, cells, position):
    """Return the cubic through four of ``values``, held between the two that enclose ``position``."""
    low = min(int(position), cells - 1)
    if cells < 3:
        cubic = values[low] + (position - low) * (values[low + 1] - values[low])
    else:
        first = min(max(low - 1, 0), cells - 3)
        x = position - first
        cubic = 0.5 * (
            (x - 2.0) * (x - 3.0) * (x * values[first + 1] - (x - 1.0) / 3.0 * values[first])
            + x * (x - 1.0) * ((x - 2.0) / 3.0 * values[first + 3] - (x - 3.0) * values[first + 2])
        )
    return min(max(cubic, min(values[low], values[low + 1])), max(values[low], values[low + 1]))


@kernel
def _deform(profile, i, grown, load, new_load, ratio, new_ratio, shed, scheme, old):
    """Stretch and load one column; ``grown`` is its volume before over the one after."""
    cells = profile.shape[1] - 1
    loading, stretch = scheme.loading, grown if scheme.stretching else 1.0
    weight, scale = (1.0, 1.0) if loading == OVERBURDEN else (0.0, 1.0)
    if loading == PROPORTIONAL:
        scale = new_load * grown / load if load > 0.0 else 0.0
    width, pull = 1.0 / cells, 1.0 / stretch
    for k in range(cells + 1):  # effective stress, or -p, counted from the surface
        old[cells - k] = weight * load * ((cells - k) * width) - profile[i, k]
    lift = weight * (new_load - shed)
    for k in range(cells):
        eta = (cells - k) * width
        if stretch == 1.0:
            profile[i, k] = lift * eta - scale * old[cells - k]
        elif eta <= stretch:
            profile[i, k] = lift * eta - scale * _interpolate(old, cells, (cells - k) * pull)
        else:  # soil that came in when the base was where this level is now
            part = (eta - stretch) / (1.0 - stretch)
            entry_load = load + part * (new_load - load)
            entry_ratio = ratio + part * (new_ratio - ratio)
            if loading == OVERBURDEN:
                profile[i, k] = eta * new_load - (1.0 - entry_ratio) * entry_load
            elif loading == PROPORTIONAL:
                profile[i, k] = entry_ratio * eta * new_load
            else:
                profile[i, k] = entry_ratio * entry_load


@kernel
def _base_slope(first, second, third, cells):
    """Return dp/d(eta) at the base as seen from inside, no steeper than twice the lowest cell [Pa]."""
    step = first - second
    slope = 1.5 * step - 0.5 * (second - third)
    return min(max(slope, min(0.0, 2.0 * step)), max(0.0, 2.0 * step)) * cells


@kernel
def _diffuse(profile, i, diffusion, prescribed, base, slope, modes, work):
    """Let one column diffuse by ``diffusion`` = c_v t / h^2; ``slope`` is what a closed base finds."""
    cells = profile.shape[1] - 1
    steady = base if prescribed else 0.0
    low, high = min(0.0, steady), max(0.0, steady)
    for k in range(cells):
        pressure = profile[i, k]
        if k > 0 or not prescribed:
            low, high = min(low, pressure), max(high, pressure)
        work[k] = pressure - steady * (cells - k) / cells
        profile[i, k] = steady * (cells - k) / cells
    work[0] *= 0.5  # the base level stands for half a cell
    kind = 1 if prescribed else 0
    # exp(-wave^2 diffusion), wave = (j + 1/2) pi or (j + 1) pi, without an exponential for every mode
    lowest = math.exp(-0.25 * math.pi * math.pi * diffusion)
    factor = lowest**8
    decay, ratio = (lowest**4, lowest**12) if prescribed else (lowest, factor)
    rest = factor ** (2 * cells * cells) if slope != 0.0 else 0.0
    for j in range(cells):
        if decay < 1e-18:
            break
        amplitude = 0.0
        for k in range(cells):
            amplitude += modes.shapes[kind, j, k] * work[k]
        amplitude *= decay
        if slope != 0.0:  # its relaxation is not seen by the levels: put its own coefficients in
            mirrored, unseen = modes.mirror[j], modes.unseen[j]
            missing = mirrored * math.exp(-modes.mirror_rates[j] * diffusion) + (unseen - mirrored) * rest
            amplitude += slope * modes.shapes[0, j, 0] * (missing - unseen * decay)
        for k in range(cells):
            profile[i, k] += amplitude * modes.shapes[kind, j, k]
        decay *= ratio
        ratio *= factor
    for k in range(cells):
        profile[i, k] = min(max(profile[i, k], low), high)


@kernel
def _carried(pressure, eta, load, new_load, loading):
    """Return the pressure of a grain at ``eta`` after a change of load without diffusion."""
    if loading == OVERBURDEN:
        return pressure + eta * (new_load - load)
    if loading == PROPORTIONAL:
        return pressure * new_load / load if load > 0.0 else 0.0
    return pressure


@kernel
def _pending(first, second, third, cells, closing, diffusion):
    """Return what diffusion adds at an impermeable base to the pressure of the lowest levels [Pa]."""
    if closing:  # a slope relaxes with the square root of time, the curvature with time
        slope = _base_slope(first, second, third, cells)
        bend = (first - 2.0 * second + third) * cells * cells
        return bend * diffusion - slope * math.sqrt(4.0 / math.pi * diffusion)
    return 2.0 * cells * cells * (second - first) * diffusion


@kernel
def _bring(columns, i, volume, load, thickness, erodes, lower, scheme, work):
    """Bring one column from where it was last advanced to ``volume`` and ``load``."""
    profile, start, old_load = columns.profile, columns.volume[i], columns.load[i]
    cells = profile.shape[1] - 1
    prescribed = columns.eroding[i] > 0
    ratio, diffusion, old_base = columns.bed_ratio[i], columns.diffusion[i], profile[i, 0]
    shed = 0.5 * columns.erosion_load[i]
    known = columns.eroding[i] == PRESCRIBED and old_load > 0.0
    old_ratio = old_base / old_load if known else ratio
    middle_load, middle_ratio = 0.5 * (old_load + load), 0.5 * (old_ratio + ratio)
    middle = 0.5 * (start + volume)  # the middle in time, too, while the bed gives at a constant rate
    first, second = 1.0, 1.0
    if prescribed and volume > start:
        first, second = start / middle, middle / volume
    _deform(profile, i, first, old_load, middle_load, old_ratio, middle_ratio, shed, scheme, work)
    if diffusion > 0.0:
        base = middle_ratio * middle_load
        slope = 0.0
        if columns.eroding[i] == JUST_IMPERMEABLE:
            slope = _base_slope(profile[i, 0], profile[i, 1], profile[i, 2], cells)
        _diffuse(profile, i, diffusion, prescribed, base, slope, scheme.modes, work)
    _deform(profile, i, second, middle_load, load, middle_ratio, ratio, shed, scheme, work)
    if prescribed:
        profile[i, 0] = ratio * load
        if columns.eroding[i] == JUST_PRESCRIBED and not erodes:
            # The base level stands for half a cell. A touch of erosion fills only a part of it: the
            # new soil and what diffused in. All of it, and a base that chatters would pump pressure.
            filled = 2.0 * cells * (1.0 - first * second + 2.0 * math.sqrt(diffusion / math.pi))
            untouched = _carried(old_base, 1.0, old_load, load, scheme.loading)
            profile[i, 0] = untouched + min(1.0, filled) * (ratio * load - untouched)
    columns.eroding[i] = PRESCRIBED if prescribed else IMPERMEABLE
    removed = 0.0
    for k in range(cells):
        eta, pressure = (cells - k) / cells, profile[i, k]
        bounded = min(max(pressure, -lower * eta * load), eta * load)
        removed += abs(pressure - bounded) * (0.5 if k == 0 else 1.0)
        profile[i, k] = bounded
    columns.clipped[i] += removed * thickness / cells
    columns.volume[i], columns.load[i] = volume, load
    columns.erosion_load[i] = columns.diffusion[i] = 0.0


@kernel
def advance_columns(columns, forcing, dt, basal_pressure, scheme):
    """Account for one step of the flow, advance the columns for which it is due, write the base.

    Parameters
    ----------
    columns : ColumnState
        Written in place.
    forcing : ColumnForcing
        The step; ``bed_pressure_ratio`` has one value or one per column.
    dt : float
        Duration [s].
    basal_pressure : ndarray, shape (n,)
        Written: the excess pore pressure that friction feels [Pa].
    scheme : Scheme
        Which law it is.
    """
    # arrays of a tuple are taken out once: numba counts references at every access
    volumes, loads, thicknesses = forcing.volume, forcing.liquefaction_pressure, forcing.thickness
    entrained, bed_ratios = forcing.entrained, forcing.bed_pressure_ratio
    coefficient_of_consolidation, water_to_buoyant = forcing.coefficient_of_consolidation, forcing.water_to_buoyant
    profile, last_volumes, last_loads = columns.profile, columns.volume, columns.load
    current_loads, pendings, sinces = columns.current_load, columns.diffusion, columns.diffusion_since_switch
    erosion_loads, bases, ratios = columns.erosion_load, columns.eroding, columns.bed_ratio
    cells = profile.shape[1] - 1
    width, loading = 1.0 / cells, scheme.loading
    work = np.empty(cells + 1)
    for i in range(basal_pressure.size):
        volume, load, thickness = volumes[i], loads[i], thicknesses[i]
        before, load_before = volume - entrained[i], current_loads[i]
        erodes = entrained[i] > 0.0
        if erodes != (bases[i] > 0):
            _bring(columns, i, before, load_before, thickness, erodes, water_to_buoyant, scheme, work)
            bases[i] = JUST_PRESCRIBED if erodes else JUST_IMPERMEABLE
            sinces[i] = 0.0
        current_loads[i] = load
        # h before times h after, were there erosion only: exact for a constant rate of it
        square = thickness * thickness * max(before, 0.0)
        passed = coefficient_of_consolidation * dt * volume
        if passed < DIFFUSION_CAP * square:
            passed /= square
        elif passed > 0.0:
            passed = DIFFUSION_CAP
        diffusion, since = min(pendings[i] + passed, DIFFUSION_CAP), min(sinces[i] + passed, DIFFUSION_CAP)
        pendings[i], sinces[i] = diffusion, since
        old_volume, old_load = last_volumes[i], last_loads[i]
        whole = old_load * volume
        strain = abs(load * old_volume - whole)
        closing = bases[i] == JUST_IMPERMEABLE
        due = strain * strain * diffusion > LOADED_DUE * whole * whole and not closing
        limit = LAYER_DUE * width * width if closing else min(DIFFUSION_DUE * width, SHARE_DUE * since + LEAST_DUE)
        due = due or diffusion > limit
        if erodes:
            ratios[i] = bed_ratios[min(i, bed_ratios.size - 1)]
            if not scheme.stretching:
                erosion_loads[i] += (load_before + load) * entrained[i] / (before + volume)
            due = due or volume > GROWTH_DUE * old_volume or strain > STRAIN_DUE * width * whole
        if due:
            _bring(columns, i, volume, load, thickness, erodes, water_to_buoyant, scheme, work)
            old_load, diffusion = load, 0.0
        if erodes:
            pressure = ratios[i] * load
        else:
            pressure = _carried(profile[i, 0], 1.0, old_load, load, loading)
            if diffusion > 0.0:
                middle = 0.5 * (old_load + load)
                first = _carried(profile[i, 0], 1.0, old_load, middle, loading)
                second = _carried(profile[i, 1], 1.0 - width, old_load, middle, loading)
                third = _carried(profile[i, 2], 1.0 - 2.0 * width, old_load, middle, loading)
                pressure += _pending(first, second, third, cells, closing, diffusion)
        basal_pressure[i] = min(max(pressure, -water_to_buoyant * load), load)


@kernel
def bring_columns(columns, forcing, scheme):
    """Bring every column to the present; arguments as in `advance_columns`."""
    work = np.empty(columns.profile.shape[1])
    for i in range(columns.volume.size):
        volume, load, thickness = forcing.volume[i], forcing.liquefaction_pressure[i], forcing.thickness[i]
        _bring(columns, i, volume, load, thickness, columns.eroding[i] > 0, forcing.water_to_buoyant, scheme, work)
        columns.current_load[i] = load
