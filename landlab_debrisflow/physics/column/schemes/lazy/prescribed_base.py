"""A column whose base the bed prescribes: kept as pressures at levels, brought forward some steps at once.

It diffuses, is stretched (`remap`), and diffuses again. How much of the diffusion comes last follows
from what it has left of the stretching by the end, half where little diffuses; it is joined to the first
of the next time. Over a base that has just changed, a layer forms that levels do not resolve (`boundary_layer`).

The base level stands for half a cell. A base that starts to erode fills it first; a profile does not
jump on a switch, and a base that chatters pumps nothing in.
"""

import math

import numpy as np

from .....core.jit import inner, kernel
from ..choices import OVERBURDEN, PROPORTIONAL, UNLOADED
from .boundary_layer import base_share, is_seen, layer, layer_content
from .modes import IMPERMEABLE, PRESCRIBED, evolve, limits
from .remap import stretch_profile
from .state import (  # fmt: skip
    BASE,
    BED_PRESSURE,
    CONTACT,
    CONTENT,
    DIFFUSION,
    FLUX,
    JUMP,
    JUST,
    LOAD,
    OWED,
    SOURCE,
    VOLUME,
)

LEAST_STRETCH = 1e-9  # volume before over volume after: of what was there before, nothing is left
LAYER_END = 0.05  # c_v t / h^2 up to which the layer over a base that has just changed does not feel the surface


@inner
def strain_of(load, old_load, volume, start):
    """Return the change of the load but by erosion; a column that has none left is emptied by its bounds."""
    return load * start / (old_load * volume) if old_load > 0.0 and load > 0.0 and volume > 0.0 else 1.0


@kernel
def diffuse(profile, memory, which, volumes, loads, ending, scheme, waves):
    """Let some columns diffuse under what loads them while grains keep their place."""
    cells = profile.shape[1] - 1
    work = np.empty(cells)
    for i in which:
        volume, load, start, old_load = volumes[i], loads[i], memory[i, VOLUME], memory[i, LOAD]
        base, new_base, touched = memory[i, BASE], memory[i, BED_PRESSURE], profile[i, 0]
        passed, lift, scale = memory[i, OWED] + memory[i, DIFFUSION], 0.0, 1.0
        strained = strain_of(load, old_load, volume, start)
        if scheme.loading == OVERBURDEN:
            growth = volume / start if start > 0.0 else 1.0
            lift = load - old_load if scheme.literal else 0.5 * old_load * (1.0 + growth) * (strained - 1.0)
        elif scheme.loading == PROPORTIONAL:
            scale = math.sqrt(strained)
        for k in range(cells):
            profile[i, k] *= scale
        just, flux = memory[i, JUST] > 0.0, memory[i, CONTACT] >= FLUX
        kind, held, new_held = (IMPERMEABLE, 0.0, 0.0) if flux else (PRESCRIBED, base * scale, new_base / scale)
        kink = (touched - base) * scale if just and not flux else 0.0
        evolve(profile, i, kind, passed, held, new_held, kink, lift, memory[i, SOURCE], waves, work)
        for k in range(cells):
            profile[i, k] *= scale
        memory[i, SOURCE] = memory[i, OWED] = memory[i, JUMP] = 0.0
        if flux:
            continue
        profile[i, 0] = new_base
        if just and ending and not is_seen(cells, 0.0, passed):
            carried = touched * scale * scale + lift
            jump, first_jump = new_base - carried, (base - touched) * scale * scale
            if jump != 0.0:
                # what came evenly since then is as two jumps of half of it (Gauss), and sent two thirds as much in
                evenly = min(max(1.0 - first_jump / jump, 0.0), 1.0)
                _end(profile, memory, i, carried, jump, evenly, 0.0, passed)


@kernel
def grow(profile, memory, which, volumes, loads, ending, scheme, waves):
    """Let some columns diffuse and grow by soil that comes in at a prescribed base.

    What is carried along with the grains is ``weight * load * eta - p``, the effective stress or less the
    pressure; ``entry`` is that of the soil that comes in.
    """
    cells = profile.shape[1] - 1
    work = np.empty((2, cells + 1))
    for i in which:
        volume, load, start, old_load = volumes[i], loads[i], memory[i, VOLUME], memory[i, LOAD]
        base, new_base, touched = memory[i, BASE], memory[i, BED_PRESSURE], profile[i, 0]
        stretch = max(start / volume, LEAST_STRETCH)
        first, last, source, last_source = parts_of(memory, i, stretch, PRESCRIBED)
        weight, scale, entry, new_entry = 0.0, 1.0, -base, -new_base
        if scheme.loading == OVERBURDEN:
            weight, entry, new_entry = 1.0, old_load - base, load - new_base
        elif scheme.loading == PROPORTIONAL:
            scale = strain_of(load, old_load, volume, start)
            entry = entry * scale
        # over a base that has just changed: the column as if it had not, and the layer that forms over it
        diffusion = memory[i, DIFFUSION]
        fresh = memory[i, JUST] > 0.0 and diffusion < LAYER_END
        low, high, least, most = limits(profile, i, base, base, waves.eta)
        held, jump, new_jump = base, 0.0, 0.0
        if fresh:  # what would have come in has the ratio of the base, so that a constant ratio stays one
            held, carried = touched, scale * (weight * old_load - touched)
            growth = 1.0 if scheme.loading == UNLOADED else 1.0 / stretch
            jump, new_jump = carried - entry, carried * growth - new_entry
            entry, new_entry = carried, carried * growth
        evolve(profile, i, PRESCRIBED, first, held, held, touched - held, 0.0, source, waves, work[0])
        stretch_profile(profile, i, stretch, old_load, load, weight, scale, entry, new_entry, work)
        if scheme.literal:
            load_literally(profile, i, stretch, load)
        inside = weight * load - new_entry
        memory[i, SOURCE], memory[i, OWED], memory[i, JUMP] = last_source, last, 0.0
        if ending or fresh:
            evolve(profile, i, PRESCRIBED, last, inside, inside, 0.0, 0.0, last_source, waves, work[0])
            memory[i, SOURCE] = memory[i, OWED] = 0.0
        profile[i, 0] = new_base
        if not fresh:
            continue
        # what encloses the column moves as its grains and their load do, and must enclose the base
        loaded, grown, passed = weight * (load - old_load / stretch), 1.0 - stretch, diffusion * stretch
        larger, pull = max(scale, 1.0), scale / stretch
        limit = (
            min(low * larger, new_base) + min(loaded, 0.0), max(high * larger, new_base) + max(loaded, 0.0),
            min(least * pull + loaded, new_base), max(most * pull + loaded, new_base),
        )  # fmt: skip
        _add_layer(profile, i, jump, new_jump, grown, passed, limit, waves.eta)
        if ending and not is_seen(cells, grown, passed):
            _end(profile, memory, i, inside, new_base - inside, 0.0, grown, passed)


@inner
def parts_of(memory, i, stretch, kind):
    """Return what is to diffuse before and after the stretching, and what comes with it from a source of pressure."""
    diffusion = memory[i, DIFFUSION]
    after = passed_after(diffusion, kind)
    # the thickness was another one before the stretching than after it
    first, last = memory[i, OWED] + (diffusion - after) / stretch, after * stretch
    last_source = memory[i, SOURCE] * last / (diffusion * stretch) if diffusion > 0.0 else 0.0
    return first, last, memory[i, SOURCE] - last_source, last_source


@kernel
def settle(columns, which, forcing, basal_pressure):
    """Remember of some columns how they are now, and hold their levels between suction and liquefaction.

    What that takes off is counted. Where the bed does not prescribe the pressure at the base it is written.
    """
    profile, memory, lower = columns.profile, columns.memory, forcing.water_to_buoyant
    volumes, loads, thicknesses = forcing.volume, forcing.liquefaction_pressure, forcing.thickness
    cells = profile.shape[1] - 1
    for i in which:
        load = loads[i]
        memory[i, JUST], memory[i, VOLUME], memory[i, LOAD] = 0.0, volumes[i], load
        memory[i, BASE], memory[i, DIFFUSION] = memory[i, BED_PRESSURE], 0.0
        if forcing.bounded:
            removed = 0.0
            for k in range(cells):
                overburden, pressure = load * (cells - k) / cells, profile[i, k]
                held = min(max(pressure, -lower * overburden), overburden)
                removed += abs(pressure - held) * (0.5 if k == 0 else 1.0)
                profile[i, k] = held
            columns.clipped[i] += removed * thicknesses[i] / cells
        if memory[i, CONTACT] >= FLUX:
            basal_pressure[i] = profile[i, 0]


@inner
def _end(profile, memory, i, carried, jump, evenly, grown, passed):
    """Fill the half cell of the base level as far as was reached over a base that has just changed by ``jump``.

    A part of the jump, ``evenly``, came evenly since then, the rest at once.
    """
    cells, share = profile.shape[1] - 1, 0.0
    for part, time in ((1.0 - evenly, 1.0), (0.5 * evenly, 0.2113), (0.5 * evenly, 0.7887)):
        if part > 0.0:
            share += part * base_share(cells, grown, time * passed)
    profile[i, 0] = carried + share * jump
    memory[i, JUMP], memory[i, CONTENT] = jump, (1.0 - evenly / 3.0) * layer_content(grown, passed)


@inner
def passed_after(passed, kind):
    """Return how much of the diffusion of an advance is to come after its stretching.

    The slowest wave then keeps as much of what is stretched as if the two went on together.
    """
    rate = math.pi * math.pi * (1.0 if kind == PRESCRIBED else 0.25)
    x = rate * passed
    if x < 1e-3:
        return passed * (0.5 - x / 24.0)
    return math.log(x / -math.expm1(-x)) / rate


@inner
def load_literally(profile, i, stretch, load):
    """Add what the whole dh/dt loads the grains with while new soil comes in below them."""
    cells = profile.shape[1] - 1
    for k in range(cells):
        eta = (cells - k) / cells
        profile[i, k] -= load * eta * math.log(max(stretch, eta))


@inner
def _add_layer(profile, i, jump, new_jump, grown, passed, limit, eta):
    """Add what a base that has just changed by ``jump``, and in the end by ``new_jump``, has sent into a column.

    ``limit`` holds the least and largest pressure, and over eta, that it may have.
    """
    cells = profile.shape[1] - 1
    low, high, least, most = limit
    for k in range(1, cells):
        distance = 1.0 - eta[k]
        share = layer(distance, grown, passed) - layer(2.0 - distance, grown, passed)
        early = min(distance / grown, 1.0) if grown > 0.0 else 0.0
        pressure = profile[i, k] + share * (new_jump + early * (jump - new_jump))
        profile[i, k] = min(max(pressure, low, least * eta[k]), high, most * eta[k])
