"""A column whose base the bed prescribes: kept as pressures at levels, brought forward some steps at once.

It diffuses, is stretched (`stretch`), and diffuses again. How much of the diffusion comes last follows
from what it has left of the stretching by the end, half where little diffuses; it is joined to the first
of the next time. Over a base that has just changed, a layer forms that levels do not resolve (`layer`).

The base level stands for half a cell. A base that starts to erode fills it first; a profile does not
jump on a switch, and a base that chatters pumps nothing in.
"""

import math

from ...core.jit import kernel
from .layer import layer, layer_content
from .memory import BASE, BED_PRESSURE, CONTACT, DIFFUSION, FLUX, JUST, LOAD, OWED, SOURCE, VOLUME
from .scheme import OVERBURDEN, PROPORTIONAL
from .stretch import stretch_profile
from .waves import IMPERMEABLE, PRESCRIBED, evolve, limits

LEAST_STRETCH = 1e-9  # volume before over volume after: of what was there before, nothing is left
LAYER_END = 0.05  # c_v t / h^2 up to which the layer over a base that has just changed does not feel the surface


@kernel
def bring(profile, memory, i, volume, load, ending, scheme, work):
    """Bring one column kept at levels from where it was last advanced to ``volume`` and ``load``.

    Unless the contact is ``ending``, diffusion that is to come after the stretching is left to the next
    time.
    """
    start, old_load = memory[i, VOLUME], memory[i, LOAD]
    # change of the load but by erosion
    strained = load * start / (old_load * volume) if old_load > 0.0 and volume > 0.0 else 1.0
    if scheme.stretching and volume > start:
        _grow(profile, memory, i, max(start / volume, LEAST_STRETCH), load, strained, ending, scheme, work)
    else:
        _diffuse(profile, memory, i, volume / start if start > 0.0 else 1.0, load, strained, ending, scheme, work)
    memory[i, JUST], memory[i, VOLUME], memory[i, LOAD] = 0.0, volume, load
    memory[i, BASE], memory[i, DIFFUSION] = memory[i, BED_PRESSURE], 0.0


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
    just = memory[i, JUST] > 0.0
    if memory[i, CONTACT] >= FLUX:
        evolve(profile, i, IMPERMEABLE, passed, 0.0, 0.0, 0.0, lift, memory[i, SOURCE], scheme.waves, work[0])
    else:
        kink = (touched - base) * scale if just else 0.0
        evolve(
            profile, i, PRESCRIBED, passed, base * scale, new_base / scale, kink, lift, memory[i, SOURCE],
            scheme.waves, work[0],
        )  # fmt: skip
    for k in range(cells):
        profile[i, k] *= scale
    if memory[i, CONTACT] < FLUX:
        profile[i, 0] = new_base
        if just and ending:  # of the half cell of the base level only a part was reached
            carried = touched * scale * scale + lift
            profile[i, 0] = carried + min(4.0 * cells * math.sqrt(passed / math.pi), 1.0) * (new_base - carried)
    memory[i, SOURCE] = memory[i, OWED] = 0.0


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
        held = scale * (weight * old_load - profile[i, 0])
        content = scale * _effective(profile, i, weight * old_load)
        content = stretch * content + (1.0 - stretch) * 0.5 * (entry + new_entry)
        stretch_profile(profile, i, stretch, old_load, load, weight, scale, entry, new_entry, work[0])
        # the base level takes what the content lacks: with diffusion from below left out, it must not drift
        profile[i, 0] = weight * load
        lacking = 2.0 * cells * (content - _effective(profile, i, weight * load))
        profile[i, 0] -= min(max(lacking, min(held, new_entry)), max(held, new_entry))
        if scheme.literal:
            _load_literally(profile, i, stretch, load)
        evolve(profile, i, kind, last, 0.0, 0.0, 0.0, 0.0, last_source, waves, work[0])
        memory[i, SOURCE] = memory[i, OWED] = 0.0
        return
    # over a base that has just changed: the column as if it had not, and the layer that forms over it
    fresh = memory[i, JUST] > 0.0 and diffusion < LAYER_END
    limit = limits(profile, i, min(base, new_base), max(base, new_base), waves.eta)
    held, jump = (touched, scale * (weight * old_load - touched) - entry) if fresh else (base, 0.0)
    entry, new_entry = entry + jump, new_entry + jump
    evolve(profile, i, kind, first, held, held, touched - held, 0.0, source, waves, work[0])
    stretch_profile(profile, i, stretch, old_load, load, weight, scale, entry, new_entry, work[0])
    if scheme.literal:
        _load_literally(profile, i, stretch, load)
    inside, share = weight * load - new_entry, 1.0
    memory[i, SOURCE], memory[i, OWED] = last_source, last
    if ending or fresh:
        evolve(profile, i, kind, last, inside, inside, 0.0, 0.0, last_source, waves, work[0])
        memory[i, SOURCE] = memory[i, OWED] = 0.0
    if fresh:
        loaded = weight * old_load * (strained - 1.0)
        share = _add_layer(profile, i, jump, 1.0 - stretch, diffusion * stretch, loaded, limit, waves.eta)
    profile[i, 0] = inside + (share if ending else 1.0) * (new_base - inside)


@kernel
def _effective(profile, i, load):
    """Return the mean of ``load * eta - p`` of one column [Pa]."""
    cells = profile.shape[1] - 1
    content = 0.5 * (load - profile[i, 0])
    for k in range(1, cells):
        content += load * (cells - k) / cells - profile[i, k]
    return content / cells


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
def _add_layer(profile, i, jump, grown, passed, loaded, limit, eta):
    """Add what a base that has just changed by ``jump`` has sent into a column.

    ``limit`` holds the least and largest pressure, and over eta, that the column had and has at its base;
    ``loaded`` is what has been added to it by loading, over eta. Returns the share of the base level.
    """
    cells = profile.shape[1] - 1
    low, high, least, most = limit
    low, high = low + min(loaded, 0.0), high + max(loaded, 0.0)
    least, most = least + min(loaded, 0.0), most + max(loaded, 0.0)
    content = layer_content(grown, passed) * cells
    for k in range(1, cells):
        distance = 1.0 - eta[k]
        share = layer(distance, grown, passed) - layer(2.0 - distance, grown, passed)
        pressure = profile[i, k] + share * jump
        profile[i, k] = min(max(pressure, low, least * eta[k]), high, most * eta[k])
        content -= share
    return min(max(2.0 * content, 0.0), 1.0)
