"""A column over an impermeable base: kept as the waves it decays in, exact after any time.

Friction needs its pressure at every step, but between two looks at the waves a parabola serves, whose
error the waves bound. Loads since the last look lift the base by what it bears; what it loses of them to
the column above goes with the square root of time.
"""

import math

import numpy as np

from .....core.jit import inner, kernel
from ..choices import OVERBURDEN, PROPORTIONAL
from .boundary_layer import layer, layer_content, wave_of_layer
from .modes import BRIEF, IMPERMEABLE, OCTAVES, limits
from .state import (  # fmt: skip
    BED_PRESSURE,
    BEND,
    CLOSED,
    CONTACT,
    CONTENT,
    GAIN,
    HIGH,
    JUMP,
    LAYER,
    LEAST,
    LEVELS,
    LIFT,
    LOW,
    MOST,
    PASSED,
    PRESSURE,
    RATE,
    REMAINDER,
    SCALE,
    SWING,
    TAIL,
)

DIFFUSION_CAP = 1e12  # c_v t / h^2; far beyond what leaves nothing
LOSS = 4.0 / (3.0 * math.sqrt(math.pi))  # of a load put on evenly, over the square root of c_v t / h^2


@inner
def base_slope(profile, i, cells):
    """Return dp/d(eta) at the base as seen from inside, no steeper than twice the lowest cell [Pa]."""
    step, next_step = profile[i, 0] - profile[i, 1], profile[i, 1] - profile[i, 2]
    slope = 1.5 * step - 0.5 * next_step
    return min(max(slope, min(0.0, 2.0 * step)), max(0.0, 2.0 * step)) * cells


@kernel
def close(profile, memory, which, waves):
    """Turn the levels of some columns into the waves they decay in over an impermeable base; `look` at them next.

    Over the base there may be a layer that levels hardly see, of some jump and content (`prescribed_base`). It is taken
    as what has diffused from a base held at that jump, and goes into the waves by itself: those of the levels get what
    levels have of its content, the shorter ones what they lack at the base.
    """
    cells = profile.shape[1] - 1
    levels, parts = np.empty(cells), np.empty(cells)
    for i in which:
        jump, content = memory[i, JUMP], memory[i, CONTENT]
        bed = memory[i, BED_PRESSURE] if jump != 0.0 else profile[i, 0]
        passed, removed, kept = 0.25 * math.pi * content * content, 0.0, 0.0
        low, high, least, most = limits(profile, i, min(bed, profile[i, 0]), max(bed, profile[i, 0]), waves.eta)
        if jump != 0.0:
            missing = cells * layer_content(0.0, passed)
            for k in range(1, cells):
                share = layer(k / cells, 0.0, passed)
                missing -= share
                profile[i, k] -= jump * share
                removed += jump * share
            share = min(max(2.0 * missing, 0.0), 1.0)  # as in `boundary_layer.base_share`
            profile[i, 0] -= jump * share
            removed += 0.5 * jump * share
            for j in range(cells):
                parts[j] = jump * wave_of_layer(math.sqrt(waves.squares[j]), passed)
                kept += parts[j] * 0.5 * cells * waves.uniform[IMPERMEABLE, 0, j]
        share = removed / kept if kept != 0.0 else 0.0  # 1 but for the levels' own error
        slope = base_slope(profile, i, cells)
        unseen = bed - profile[i, 0]
        for k in range(cells):
            levels[k] = profile[i, k] - slope * waves.eta[k]
        for j in range(cells):
            amplitude = slope * waves.ramp[IMPERMEABLE, 0, j]
            for k in range(cells):
                amplitude += waves.project[IMPERMEABLE, k, j] * levels[k]
            if share != 0.0:
                amplitude, unseen = amplitude + share * parts[j], unseen - share * parts[j]
            profile[i, j] = amplitude
        for octave in range(OCTAVES):  # by the wave in its middle; the last has what is left
            part = 0.0
            if share != 0.0:
                part = cells * 2**octave * jump * wave_of_layer(math.sqrt(waves.octave_rate) * 2**octave, passed)
                part = unseen if octave == OCTAVES - 1 else math.copysign(min(abs(part), abs(unseen)), unseen)
            memory[i, LAYER + octave] = part
            unseen -= part
        for octave in range(OCTAVES):
            memory[i, TAIL + octave] = slope * waves.octaves[octave]
        memory[i, CONTACT] = CLOSED
        memory[i, LOW], memory[i, HIGH], memory[i, LEAST], memory[i, MOST] = low, high, least, most
        memory[i, PASSED] = memory[i, LIFT] = memory[i, GAIN] = memory[i, SWING] = 0.0
        memory[i, SCALE] = 1.0


@kernel
def open_up(profile, memory, which, waves):
    """Turn the waves of some columns, just looked at, into pressures at levels."""
    cells = profile.shape[1] - 1
    levels = np.empty(cells)
    for i in which:
        _synthesise(profile, memory, i, waves, levels)
        low, high, least, most, lost = memory[i, LOW], memory[i, HIGH], memory[i, LEAST], memory[i, MOST], 0.0
        for k in range(cells):
            eta = waves.eta[k]
            profile[i, k] = min(max(levels[k], low, least * eta), high, most * eta)
            lost += (levels[k] - profile[i, k]) * (0.5 if k == 0 else 1.0)
        # what the bounds took off goes into the base level, as far as they let it: the content does not jump
        profile[i, 0] = min(max(profile[i, 0] + 2.0 * lost, low, least), high, most)
        profile[i, cells] = 0.0
        memory[i, CONTACT], memory[i, JUMP] = LEVELS, 0.0


@kernel
def look(profile, memory, which, waves):
    """Let the waves of some columns decay by what has passed since the last look, under the loads since then."""
    ramp, uniform = waves.ramp[IMPERMEABLE], waves.uniform[IMPERMEABLE]
    cells = profile.shape[1] - 1
    factors = np.empty(cells)
    for i in which:
        passed, lift, scale, gain = memory[i, PASSED], memory[i, LIFT], memory[i, SCALE], memory[i, GAIN]
        decay = math.exp(-0.25 * math.pi * math.pi * passed)
        square = decay * decay
        factor = square * square
        factor = factor * factor
        ratio = factor
        for j in range(cells):  # exp(-wave^2 passed), with one exponential for all
            factors[j] = decay
            decay *= ratio
            ratio *= factor
        if lift != 0.0 or gain != 0.0:
            # what a wave gains: exactly, but linear in time where that formula cancels
            brief = passed < BRIEF
            rate, now = (0.0, 0.5) if brief else (1.0 / passed, 0.0)
            for j in range(cells):
                settled = rate * (lift * ramp[1, j] + gain * uniform[1, j])
                gained = now * (lift * ramp[0, j] + gain * uniform[0, j])
                profile[i, j] = (profile[i, j] * scale - settled + gained) * factors[j] + settled + gained
        else:
            for j in range(cells):
                profile[i, j] *= scale * factors[j]
        square = waves.octave_rate
        decay = math.exp(-square * passed)
        for octave in range(OCTAVES):
            x = square * passed
            evenly = (1.0 - decay) / x if x > BRIEF else 1.0 - 0.5 * x
            memory[i, LAYER + octave] *= scale * decay
            memory[i, TAIL + octave] = memory[i, TAIL + octave] * scale * decay + lift * waves.octaves[octave] * evenly
            decay *= decay
            decay *= decay
            square *= 4.0
        _bend(profile, memory, i, waves)
        low, high, least, most = gained_limits(memory, i)
        memory[i, LOW], memory[i, HIGH] = low, high
        memory[i, LEAST], memory[i, MOST] = least + cells * min(gain, 0.0), most + cells * max(gain, 0.0)
        memory[i, PASSED] = memory[i, LIFT] = memory[i, GAIN] = memory[i, SWING] = 0.0
        memory[i, SCALE] = 1.0


@inner
def _bend(profile, memory, i, waves):
    """Remember of one column its pressure at the base, the parabola in c_v t / h^2 it goes by, and its remainder."""
    pressure, rate, bend, remainder = 0.0, 0.0, 0.0, 0.0
    square = waves.octave_rate
    for octave in range(OCTAVES):
        amplitude = memory[i, TAIL + octave] + memory[i, LAYER + octave]
        first = square * amplitude
        second = square * first
        pressure += amplitude
        rate += first
        bend += second
        remainder += square * abs(second)
        square *= 4.0
    for j in range(profile.shape[1] - 1):
        square, amplitude = waves.squares[j], profile[i, j]
        first = square * amplitude
        second = square * first
        pressure += amplitude
        rate += first
        bend += second
        remainder += square * abs(second)
    memory[i, PRESSURE] = pressure
    memory[i, RATE], memory[i, BEND], memory[i, REMAINDER] = -rate, bend / 2.0, remainder / 6.0


@kernel
def hold(profile, memory, which, waves, loads, thicknesses, lower, clipped):
    """Hold some columns, just looked at, between suction and liquefaction at their levels; count what that takes off.

    Waves too short for the levels stay as they are.
    """
    cells = profile.shape[1] - 1
    levels = np.empty(cells)
    for i in which:
        _synthesise(profile, memory, i, waves, levels)
        load, removed = loads[i], 0.0
        for k in range(cells):
            most = load * waves.eta[k]
            taken = levels[k] - min(max(levels[k], -lower * most), most)
            removed += abs(taken) * (0.5 if k == 0 else 1.0)
            if taken != 0.0:
                for j in range(cells):
                    profile[i, j] -= waves.project[IMPERMEABLE, k, j] * taken
        clipped[i] += removed * thicknesses[i] / cells
        memory[i, LOW], memory[i, HIGH] = max(memory[i, LOW], -lower * load), min(memory[i, HIGH], load)
        memory[i, LEAST], memory[i, MOST] = max(memory[i, LEAST], -lower * load), min(memory[i, MOST], load)
        _bend(profile, memory, i, waves)


@inner
def _synthesise(profile, memory, i, waves, levels):
    """Write the pressures of one column at the levels; of a thin layer they see no more than its content."""
    tail = 0.0
    for octave in range(OCTAVES):
        tail += memory[i, TAIL + octave]
    tail /= waves.pattern[IMPERMEABLE, 0]
    for k in range(levels.size):
        levels[k] = tail * waves.pattern[IMPERMEABLE, k]
    for j in range(levels.size):
        for k in range(levels.size):
            levels[k] += profile[i, j] * waves.shapes[IMPERMEABLE, j, k]


@inner
def gained_limits(memory, i):
    """Return the limits of one column with what has been put on it since the last look; see `modes.limits`."""
    lift, scale, gain = memory[i, LIFT], memory[i, SCALE], memory[i, GAIN]
    fall, rise = min(lift, 0.0) + min(gain, 0.0), max(lift, 0.0) + max(gain, 0.0)
    return (
        memory[i, LOW] * scale + fall, memory[i, HIGH] * scale + rise,
        min(memory[i, LEAST] * scale + lift + min(gain, 0.0), 0.0),
        max(memory[i, MOST] * scale + lift + max(gain, 0.0), 0.0),
    )  # fmt: skip


@inner
def closed_pressure(memory, i, passed, load, old_load, gain, loading):
    """Put one step on a column and look at its base.

    Returns the pressure there, by how much that may be wrong, its limits over eta, and what part of an even load
    since the last look has gone from the base. The load has changed from ``old_load`` to ``load`` and every grain
    gained ``gain`` evenly.
    """
    passed = min(memory[i, PASSED] + passed, DIFFUSION_CAP)
    lift, scale, gain = memory[i, LIFT], memory[i, SCALE], memory[i, GAIN] + gain
    swing = memory[i, SWING] + abs(gain - memory[i, GAIN])
    if loading == OVERBURDEN:
        lift += load - old_load
        swing += abs(load - old_load)
    elif loading == PROPORTIONAL and old_load > 0.0:
        scale *= load / old_load
    memory[i, PASSED], memory[i, LIFT], memory[i, SCALE] = passed, lift, scale
    memory[i, GAIN], memory[i, SWING] = gain, swing
    lost = LOSS * math.sqrt(passed)
    pressure = scale * (memory[i, PRESSURE] + passed * (memory[i, RATE] + passed * memory[i, BEND]))
    pressure += lift * max(1.0 - lost, 0.0) + gain
    error = memory[i, REMAINDER] * scale * passed * passed * passed + lost * swing
    low, high, least, most = gained_limits(memory, i)
    return min(max(pressure, low, least), high, most), error, least, most, lost
