"""A column whose base the bed prescribes: kept as pressures at levels, brought forward some steps at once.

It diffuses, is stretched (`stretch`), and diffuses again. How much of the diffusion comes last follows
from what it has left of the stretching by the end, half where little diffuses; it is joined to the first
of the next time. Over a base that has just changed, a layer forms that levels do not resolve (`layer`).

The base level stands for half a cell. A base that starts to erode fills it first; a profile does not
jump on a switch, and a base that chatters pumps nothing in.
"""

import math

from ...core.jit import kernel
from .layer import base_share, is_seen, layer, layer_content
from .memory import BASE, BED_PRESSURE, CONTACT, DIFFUSION, FLUX, JUST, LOAD, OWED, SOURCE, VOLUME
from .scheme import OVERBURDEN, PROPORTIONAL, UNLOADED
from .stretch import stretch_profile
from .waves import IMPERMEABLE, PRESCRIBED, evolve, limits

LEAST_STRETCH = 1e-9  # volume before over volume after: of what was there before, nothing is left
LAYER_END = 0.05  # c_v t / h^2 up to which the layer over a base that has just changed does not feel the surface


@kernel
def bring(profile, memory, i, volume, load, ending, scheme, work):
    """Bring one column kept at levels from where it was last advanced to ``volume`` and ``load``.

    Unless the contact is ``ending``, diffusion that is to come after the stretching is left to the next
    time. Returns the jump at a base that has just changed, which levels do not see if the contact ends
    now, and the content of the layer over it, over that jump and the thickness; else 0 and 0.
    """
    start, old_load = memory[i, VOLUME], memory[i, LOAD]
    # change of the load but by erosion; a column that has none left is emptied by its bounds
    strained = load * start / (old_load * volume) if old_load > 0.0 and load > 0.0 and volume > 0.0 else 1.0
    if scheme.stretching and volume > start:
        stretch = max(start / volume, LEAST_STRETCH)
        layer_now = _grow(profile, memory, i, stretch, load, strained, ending, scheme, work)
    else:
        growth = volume / start if start > 0.0 else 1.0
        layer_now = _diffuse(profile, memory, i, growth, load, strained, ending, scheme, work)
    memory[i, JUST], memory[i, VOLUME], memory[i, LOAD] = 0.0, volume, load
    memory[i, BASE], memory[i, DIFFUSION] = memory[i, BED_PRESSURE], 0.0
    return layer_now


@kernel
def _diffuse(profile, memory, i, growth, load, strained, ending, scheme, work):
    """Let one column diffuse under what loads it while grains keep their place."""
    cells = profile.shape[1] - 1
    old_load, touched = memory[i, LOAD], profile[i, 0]
    base, new_base = memory[i, BASE], memory[i, BED_PRESSURE]
    passed, lift, scale = memory[i, OWED] + memory[i, DIFFUSION], 0.0, 1.0
    if scheme.loading == OVERBURDEN:
        lift = load - old_load if scheme.literal else 0.5 * old_load * (1.0 + growth) * (strained - 1.0)
    elif scheme.loading == PROPORTIONAL:
        scale = math.sqrt(strained)
    for k in range(cells):
        profile[i, k] *= scale
    just, flux = memory[i, JUST] > 0.0, memory[i, CONTACT] >= FLUX
    kind, held, new_held = (IMPERMEABLE, 0.0, 0.0) if flux else (PRESCRIBED, base * scale, new_base / scale)
    kink = (touched - base) * scale if just and not flux else 0.0
    evolve(profile, i, kind, passed, held, new_held, kink, lift, memory[i, SOURCE], scheme.waves, work[0])
    for k in range(cells):
        profile[i, k] *= scale
    memory[i, SOURCE] = memory[i, OWED] = 0.0
    if flux:
        return 0.0, 0.0
    profile[i, 0] = new_base
    if not (just and ending) or is_seen(cells, 0.0, passed):
        return 0.0, 0.0
    # of the half cell of the base level only a part was reached
    carried = touched * scale * scale + lift
    jump, first_jump = new_base - carried, (base - touched) * scale * scale
    if jump == 0.0:
        return 0.0, 0.0
    # what came evenly since then is as two jumps of half of it (Gauss), and has sent two thirds as much into the column
    evenly = min(max(1.0 - first_jump / jump, 0.0), 1.0)
    late, early = base_share(cells, 0.0, 0.2113 * passed), base_share(cells, 0.0, 0.7887 * passed)
    share = (1.0 - evenly) * base_share(cells, 0.0, passed) + 0.5 * evenly * (late + early)
    profile[i, 0] = carried + share * jump
    return jump, (1.0 - evenly / 3.0) * layer_content(0.0, passed)


@kernel
def _grow(profile, memory, i, stretch, load, strained, ending, scheme, work):
    """Let one column diffuse and grow by soil that comes in at its base.

    What is carried along with the grains is ``weight * load * eta - p``, the effective stress or less the
    pressure; ``entry`` is that of the soil that comes in.
    """
    cells, waves = profile.shape[1] - 1, scheme.waves
    old_load, touched = memory[i, LOAD], profile[i, 0]
    base, new_base = memory[i, BASE], memory[i, BED_PRESSURE]
    diffusion, flux = memory[i, DIFFUSION], memory[i, CONTACT] >= FLUX
    kind = IMPERMEABLE if flux else PRESCRIBED
    after = passed_after(diffusion, kind)
    # the thickness was another one before the stretching than after it
    first, last = memory[i, OWED] + (diffusion - after) / stretch, after * stretch
    last_source = memory[i, SOURCE] * last / (diffusion * stretch) if diffusion > 0.0 else 0.0
    source = memory[i, SOURCE] - last_source
    weight, scale, entry, new_entry = 0.0, 1.0, -base, -new_base
    if scheme.loading == OVERBURDEN:
        weight, entry, new_entry = 1.0, old_load - base, load - new_base
    elif scheme.loading == PROPORTIONAL:
        scale = strained
        entry = entry * strained
    if flux:
        evolve(profile, i, kind, first, 0.0, 0.0, 0.0, 0.0, source, waves, work[0])
        held = weight * old_load / stretch - scale * profile[i, 0]  # as deep as the base is now
        content = scale * _effective(profile, i, weight * old_load)
        content = stretch * content + (1.0 - stretch) * 0.5 * (entry + new_entry)
        stretch_profile(profile, i, stretch, old_load, load, weight, scale, entry, new_entry, work)
        _restore(profile, i, weight * load, content, min(held, new_entry), max(held, new_entry))
        if scheme.literal:
            _load_literally(profile, i, stretch, load)
        evolve(profile, i, kind, last, 0.0, 0.0, 0.0, 0.0, last_source, waves, work[0])
        memory[i, SOURCE] = memory[i, OWED] = 0.0
        return 0.0, 0.0
    # over a base that has just changed: the column as if it had not, and the layer that forms over it
    fresh = memory[i, JUST] > 0.0 and diffusion < LAYER_END
    low, high, least, most = limits(profile, i, base, base, waves.eta)
    held, jump, new_jump = base, 0.0, 0.0
    if fresh:  # what would have come in has the ratio of the base, so that a constant ratio stays one
        held, carried = touched, scale * (weight * old_load - touched)
        growth = 1.0 if scheme.loading == UNLOADED else 1.0 / stretch
        jump, new_jump = carried - entry, carried * growth - new_entry
        entry, new_entry = carried, carried * growth
    evolve(profile, i, kind, first, held, held, touched - held, 0.0, source, waves, work[0])
    stretch_profile(profile, i, stretch, old_load, load, weight, scale, entry, new_entry, work)
    if scheme.literal:
        _load_literally(profile, i, stretch, load)
    inside = weight * load - new_entry
    memory[i, SOURCE], memory[i, OWED] = last_source, last
    if ending or fresh:
        evolve(profile, i, kind, last, inside, inside, 0.0, 0.0, last_source, waves, work[0])
        memory[i, SOURCE] = memory[i, OWED] = 0.0
    profile[i, 0] = new_base
    if not fresh:
        return 0.0, 0.0
    # what encloses the column moves as its grains and their load do, and must enclose the base
    loaded, grown, passed = weight * (load - old_load / stretch), 1.0 - stretch, diffusion * stretch
    larger, pull = max(scale, 1.0), scale / stretch
    limit = (
        min(low * larger, new_base) + min(loaded, 0.0), max(high * larger, new_base) + max(loaded, 0.0),
        min(least * pull + loaded, new_base), max(most * pull + loaded, new_base),
    )  # fmt: skip
    _add_layer(profile, i, jump, new_jump, grown, passed, limit, waves.eta)
    if not ending or is_seen(cells, grown, passed):
        return 0.0, 0.0
    profile[i, 0] = inside + base_share(cells, grown, passed) * (new_base - inside)
    return new_base - inside, layer_content(grown, passed)


@kernel
def _effective(profile, i, load):
    """Return the mean of ``load * eta - p`` of one column [Pa]."""
    cells = profile.shape[1] - 1
    content = 0.5 * (load - profile[i, 0])
    for k in range(1, cells):
        content += load * (cells - k) / cells - profile[i, k]
    return content / cells


@kernel
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


@kernel
def passed_after(passed, kind):
    """Return how much of the diffusion of an advance is to come after its stretching.

    The slowest wave then keeps as much of what is stretched as if the two went on together.
    """
    rate = math.pi * math.pi * (1.0 if kind == PRESCRIBED else 0.25)
    x = rate * passed
    if x < 1e-3:
        return passed * (0.5 - x / 24.0)
    return math.log(x / -math.expm1(-x)) / rate


@kernel
def _load_literally(profile, i, stretch, load):
    """Add what the whole dh/dt loads the grains with while new soil comes in below them."""
    cells = profile.shape[1] - 1
    for k in range(cells):
        eta = (cells - k) / cells
        profile[i, k] -= load * eta * math.log(max(stretch, eta))


@kernel
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
