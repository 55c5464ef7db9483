"""The sine waves in which the pressure of a column diffuses: each decays by itself, exactly.

Over an impermeable base the waves are ``sin(w eta)`` with ``w = (j + 1/2) pi``, over a prescribed one
``w = (j + 1) pi``; ``eta = y/h``. Levels see the waves that fit between them and mistake all shorter
ones for those. For a smooth profile nothing is lost by that. But loading, a base pressure that changes
and a base that has just closed or opened each bring in the profile ``eta``, whose waves fall off slowly.
That part gets its own coefficients, and what the shorter waves have in it a tail of its own.
"""

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from .....core.jit import inner

IMPERMEABLE, PRESCRIBED = 0, 1
TAIL_END, TAIL_POINTS = 1.6, 256  # the table of the tail runs over sqrt(c_v t / h^2) * cells: exp(-pi^2 1.6^2) = 1e-11
OCTAVES = 4  # of waves too short for the levels, seen at an impermeable base
BRIEF = 1e-6  # c_v t / h^2 below which the gain of a wave is taken as linear in time (its formula cancels)


class Waves(NamedTuple):
    """Constants of the waves; the first axis is the base, `IMPERMEABLE` or `PRESCRIBED`."""

    shapes: np.ndarray  # (2, waves, levels but the surface); 1 at an impermeable base
    project: np.ndarray  # (2, levels but the surface, waves); levels -> amplitudes
    ramp: np.ndarray  # (2, 2, waves): what eta has of each wave; the same over the squared wave number
    uniform: np.ndarray  # (2, 2, waves): the same of 1 at all levels
    pattern: np.ndarray  # (2, levels but the surface): eta less its waves
    tail: np.ndarray  # (2, points): how that part decays
    eta: np.ndarray  # (levels but the surface,)
    squares: np.ndarray  # (waves,), squared wave numbers over an impermeable base
    octaves: np.ndarray  # (OCTAVES,), what eta has at an impermeable base of shorter waves, by octave
    octave_rate: float  # at which the first of these decays; the next four times as fast, and so on


@lru_cache(maxsize=8)
def waves_of(levels: int) -> Waves:
    """Return the waves of a column.

    Parameters
    ----------
    levels : int
        Number of levels, base and surface included.

    Notes
    -----
    ``eta`` is ``sum 2 (-1)^j / w^2 sin(w eta)`` over an impermeable base and ``sum 2 (-1)^j / w sin(w eta)``
    over a prescribed one (Carslaw & Jaeger, 1959, section 3.3).
    """
    cells = levels - 1
    index = np.arange(cells)
    eta = 1.0 - index / cells
    sign = (-1.0) ** index
    numbers = np.array([(index + 0.5) * np.pi, (index + 1.0) * np.pi])
    shapes = np.sin(numbers[:, :, None] * eta)
    shapes[0] *= sign[:, None]
    shapes[1, :, 0] = 0.0  # sin(j pi), exactly
    shapes[1, -1, :] = 0.0  # the wave that the levels cannot see
    project = shapes * (2.0 / cells)
    project[:, :, 0] *= 0.5  # the base level stands for half a cell
    ramp = np.array([2.0 / numbers[0] ** 2, 2.0 * sign / numbers[1]])
    ramp[1, -1] = 0.0
    uniform = project.sum(axis=2)
    pattern = eta - np.einsum("bj,bjk->bk", ramp, shapes)
    pattern[1, 0] = 0.0  # a prescribed base is what it is
    squares = numbers**2
    return Waves(
        shapes, np.ascontiguousarray(project.transpose(0, 2, 1)), np.stack([ramp, ramp / squares], 1),
        np.stack([uniform, uniform / squares], 1), pattern,
        np.array([_tail(cells, kind) for kind in (IMPERMEABLE, PRESCRIBED)]), eta, squares[0],
        _octaves(cells, pattern[IMPERMEABLE, 0]), 2.0 * (np.pi * cells) ** 2,
    )  # fmt: skip


def _octaves(cells: int, whole: float) -> np.ndarray:
    """Return what eta has at the base in octaves of waves, from the number of cells on; the last has all the rest."""
    parts = [
        np.sum(2.0 / ((np.arange(cells << octave, cells << octave + 1) + 0.5) * np.pi) ** 2)
        for octave in range(OCTAVES - 1)
    ]
    return np.array([*parts, whole - sum(parts)])


def _tail(cells: int, kind: int) -> np.ndarray:
    """Tabulate how the part of eta in waves too short for the levels decays, where it is largest."""
    table = []
    for passed in (np.linspace(0.0, TAIL_END, TAIL_POINTS) / cells) ** 2:
        last = 4000 * cells if passed == 0.0 else int(np.sqrt(40.0 / passed) / np.pi)  # exp(-40) is nothing
        index = np.arange(cells, max(last, cells + 1))
        if kind == IMPERMEABLE:  # seen at the base
            number = (index + 0.5) * np.pi
            part = 2.0 / number**2
        else:  # seen one level above it
            number = (index + 1.0) * np.pi
            part = 2.0 * (-1.0) ** index / number * np.sin(number * (1.0 - 1.0 / cells))
        table.append(np.sum(part * np.exp(-(number**2) * passed)))
    return np.array(table) / table[0]


@inner
def tail_left(passed, cells, table):
    """Return what is left of a tail of 1 after ``passed`` = c_v t / h^2."""
    position = math.sqrt(passed) * (cells * (TAIL_POINTS - 1) / TAIL_END)
    if position >= TAIL_POINTS - 1:
        return 0.0
    low = int(position)
    return table[low] + (position - low) * (table[low + 1] - table[low])


@inner
def limits(profile, i, low, high, eta):
    """Return the least and largest pressure, and pressure over eta, of one column, a base and the surface.

    Diffusion and stretching leave a column between these: a constant and a line through the surface that
    once enclose it do so for ever.
    """
    low, high = min(low, 0.0), max(high, 0.0)
    least, most = low, high
    for k in range(eta.size):
        pressure = profile[i, k]
        ratio = pressure / eta[k]
        low, high, least, most = min(low, pressure), max(high, pressure), min(least, ratio), max(most, ratio)
    return low, high, least, most


@inner
def evolve(profile, i, kind, passed, base, new_base, kink, lift, source, waves, work):
    """Let the levels of one column diffuse by ``passed`` = c_v t / h^2 while they are loaded.

    Over a prescribed base the pressure there runs from ``base`` to ``new_base`` and ``kink`` is what the
    column has at the base above ``base`` at first; over an impermeable base, ``base`` and ``new_base`` are
    0 and ``kink`` is dp/d(eta) there at first. Every grain gains ``lift * eta + source`` evenly in time.
    Nothing is left outside what it started from, neither the pressure nor the pressure over eta.
    """
    cells = profile.shape[1] - 1
    push = lift - (new_base - base)
    if kind == PRESCRIBED:
        profile[i, 0] = base + kink
    low, high, least, most = limits(profile, i, base, base, waves.eta)
    ramp, uniform, pattern, project = waves.ramp[kind], waves.uniform[kind], waves.pattern[kind], waves.project[kind]
    shapes, eta, amplitudes = waves.shapes[kind], waves.eta, work
    for j in range(cells):
        amplitudes[j] = kink * ramp[0, j]
    for k in range(cells):
        part = profile[i, k] - (base + kink) * eta[k]
        for j in range(cells):
            amplitudes[j] += project[k, j] * part
        profile[i, k] = new_base * eta[k]
    gain = min(source, 0.0), max(source, 0.0)
    low, high = min(low, new_base) + min(lift, 0.0) + gain[0], max(high, new_base) + max(lift, 0.0) + gain[1]
    # a line through the surface that encloses the column may move as the load does, and must enclose the base
    least, most = min(least + lift + cells * gain[0], new_base), max(most + lift + cells * gain[1], new_base)
    # exp(-wave^2 passed) without an exponential for every wave
    lowest = math.exp(-0.25 * math.pi * math.pi * passed)
    factor = lowest**8
    decay, ratio = (lowest**4, lowest**12) if kind == PRESCRIBED else (lowest, factor)
    brief = passed < BRIEF
    rate = 0.0 if brief else 1.0 / passed
    for j in range(cells):
        if brief:
            gained = push * ramp[0, j] + source * uniform[0, j]
            amplitude = amplitudes[j] * decay + 0.5 * (1.0 + decay) * gained
        else:
            settled = (push * ramp[1, j] + source * uniform[1, j]) * rate
            amplitude = (amplitudes[j] - settled) * decay + settled
        for k in range(cells):
            profile[i, k] += amplitude * shapes[j, k]
        decay *= ratio
        ratio *= factor
    # a ramp has had, in the mean, 4/9 of the time (a tail goes with the square root of it)
    tail = kink * tail_left(passed, cells, waves.tail[kind]) + push * tail_left(passed / 2.25, cells, waves.tail[kind])
    for k in range(cells):
        pressure = profile[i, k] + tail * pattern[k]
        profile[i, k] = min(max(pressure, low, least * eta[k]), high, most * eta[k])
    if kind == PRESCRIBED:
        profile[i, 0] = new_base
