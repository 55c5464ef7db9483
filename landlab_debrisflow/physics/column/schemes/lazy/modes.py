"""The sine modes in which the pressure of a column diffuses: each decays by itself, exactly.

Over an impermeable base the modes are ``sin(w eta)`` with ``w = (j + 1/2) pi``, over a prescribed one
``w = (j + 1) pi``; ``eta = y/h``. Levels resolve only modes longer than two spacings; shorter modes would appear as
longer ones. A smooth profile has no short modes. But loading, a change of the basal pressure and a change of the
contact at the base each add the profile ``eta``, whose amplitudes fall off slowly with the wave number. So the
amplitudes of ``eta`` are taken from their formula, and the modes of ``eta`` that are too short for the levels are added
as a tabulated tail.
"""

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from .....core.jit import inner
from .state import BANDS

NEUMANN, DIRICHLET = 0, 1  # conditions at the base, first axis of the constants: no flux; a given pressure
# end of the table of the tail, in sqrt(c_v t / h^2) * cells, where exp(-pi^2 1.6^2) = 1e-11 is left
TAIL_END, TAIL_POINTS = 1.6, 256
BRIEF = 1e-6  # c_v t / h^2 below which the gain of a mode is linear in time, because the exact formula loses digits


class Modes(NamedTuple):
    """Constants of the modes of a column [-]; the first axis is the condition at the base, `NEUMANN` or `DIRICHLET`.

    Attributes
    ----------
    shapes : ndarray, shape (2, modes, levels - 1)
        Shape of each mode at the levels below the surface; 1 at an impermeable base.
    project : ndarray, shape (2, levels - 1, modes)
        Matrix that turns values at levels into amplitudes.
    ramp : ndarray, shape (2, 2, modes)
        Amplitudes of eta; the quotient of these and the squared wave number.
    uniform : ndarray, shape (2, 2, modes)
        Amplitudes of 1 at all levels; the quotient of these and the squared wave number.
    pattern : ndarray, shape (2, levels - 1)
        eta less the sum of its resolved modes.
    tail : ndarray, shape (2, points)
        Decay of this difference.
    eta : ndarray, shape (levels - 1,)
        1 at the base, 0 at the surface, which is left out.
    squares : ndarray, shape (modes,)
        Squared wave numbers over an impermeable base.
    bands : ndarray, shape (BANDS,)
        eta at an impermeable base in shorter modes, by bands of an octave.
    band_rate : float
        Rate of decay of the first band; each further band decays four times as fast.
    """

    shapes: np.ndarray
    project: np.ndarray
    ramp: np.ndarray
    uniform: np.ndarray
    pattern: np.ndarray
    tail: np.ndarray
    eta: np.ndarray
    squares: np.ndarray
    bands: np.ndarray
    band_rate: float


@lru_cache(maxsize=8)
def modes_of(levels: int) -> Modes:
    """Return the modes of a column.

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
    shapes[1, :, 0] = 0.0  # sin(j pi) is 0, without rounding
    shapes[1, -1, :] = 0.0  # the mode whose zeros are the levels
    project = shapes * (2.0 / cells)
    project[:, :, 0] *= 0.5  # the base level stands for half a cell
    ramp = np.array([2.0 / numbers[0] ** 2, 2.0 * sign / numbers[1]])
    ramp[1, -1] = 0.0
    uniform = project.sum(axis=2)
    pattern = eta - np.einsum("bj,bjk->bk", ramp, shapes)
    pattern[1, 0] = 0.0  # the pressure at a prescribed base is given
    squares = numbers**2
    return Modes(
        shapes, np.ascontiguousarray(project.transpose(0, 2, 1)), np.stack([ramp, ramp / squares], 1),
        np.stack([uniform, uniform / squares], 1), pattern,
        np.array([_tail(cells, condition) for condition in (NEUMANN, DIRICHLET)]), eta, squares[0],
        _bands(cells, pattern[NEUMANN, 0]), 2.0 * (np.pi * cells) ** 2,
    )  # fmt: skip


def _bands(cells: int, whole: float) -> np.ndarray:
    """Return eta at the base by octaves of modes, beginning at the number of cells; the last band has the rest [-]."""
    octaves = [
        np.sum(2.0 / ((np.arange(cells << band, cells << band + 1) + 0.5) * np.pi) ** 2) for band in range(BANDS - 1)
    ]
    return np.array([*octaves, whole - sum(octaves)])


def _tail(cells: int, condition: int) -> np.ndarray:
    """Tabulate the decay of the part of eta in modes too short for the levels, where it is largest [-].

    `cells` is the number of intervals between levels, `condition` is `NEUMANN` or `DIRICHLET`; the table has shape
    (TAIL_POINTS,).
    """
    table = []
    for diffusion in (np.linspace(0.0, TAIL_END, TAIL_POINTS) / cells) ** 2:
        # modes below exp(-40) are left out
        last = 4000 * cells if diffusion == 0.0 else int(np.sqrt(40.0 / diffusion) / np.pi)
        index = np.arange(cells, max(last, cells + 1))
        if condition == NEUMANN:  # at the base
            number = (index + 0.5) * np.pi
            amplitude = 2.0 / number**2
        else:  # one level above the base
            number = (index + 1.0) * np.pi
            amplitude = 2.0 * (-1.0) ** index / number * np.sin(number * (1.0 - 1.0 / cells))
        table.append(np.sum(amplitude * np.exp(-(number**2) * diffusion)))
    return np.array(table) / table[0]


@inner
def tail_after(diffusion, cells, table):
    """Return the tail after ``diffusion`` = c_v t / h^2 over the tail at the start [-].

    `cells` is the number of intervals between levels; `table`, shape (TAIL_POINTS,), is a row of `Modes.tail`.
    """
    position = math.sqrt(diffusion) * (cells * (TAIL_POINTS - 1) / TAIL_END)
    if position >= TAIL_POINTS - 1:
        return 0.0
    low = int(position)
    return table[low] + (position - low) * (table[low + 1] - table[low])


@inner
def bounds_of(profile, i, low, high, eta):
    """Return bounds of one column [Pa]: least and largest pressure, and pressure over eta, with a base and the surface.

    `profile` has shape (n, levels) [Pa], of which row `i` is read; `low` and `high` bound the pressure of the base
    [Pa]; `eta`, shape (levels - 1,), is 1 at the base and 0 at the surface, which is left out.

    Diffusion and stretching keep a column within these bounds: a constant, or a line through the surface, that encloses
    the profile once encloses it for ever.
    """
    low, high = min(low, 0.0), max(high, 0.0)
    low_slope, high_slope = low, high
    for k in range(eta.size):
        pressure = profile[i, k]
        slope = pressure / eta[k]
        low, high = min(low, pressure), max(high, pressure)
        low_slope, high_slope = min(low_slope, slope), max(high_slope, slope)
    return low, high, low_slope, high_slope


@inner
def diffuse_profile(profile, i, condition, diffusion, base, new_base, kink, load_gain, source_gain, modes, work):
    """Diffuse one column, kept at levels, while it is loaded.

    Neither the pressure nor the pressure over eta leaves the range of its values at the start.

    Parameters
    ----------
    profile : ndarray, shape (n, levels)
        Row ``i`` is written [Pa].
    condition : int
        At the base, `NEUMANN` or `DIRICHLET`.
    diffusion : float
        c_v t / h^2 [-].
    base, new_base : float
        Pressure at a given base at the start and at the end; 0 over an impermeable base [Pa].
    kink : float
        Pressure of the column above ``base`` at a given base, at the start; dp/d(eta) at an impermeable base [Pa].
    load_gain, source_gain : float
        The pressure at every grain gains ``load_gain * eta + source_gain``, evenly in time [Pa].
    modes : Modes
        Modes of columns with this number of levels.
    work : ndarray, shape (levels - 1,) or longer
        Scratch.
    """
    cells = profile.shape[1] - 1
    push = load_gain - (new_base - base)
    if condition == DIRICHLET:
        profile[i, 0] = base + kink
    low, high, low_slope, high_slope = bounds_of(profile, i, base, base, modes.eta)
    ramp, uniform, pattern = modes.ramp[condition], modes.uniform[condition], modes.pattern[condition]
    project, shapes, eta, amplitudes = modes.project[condition], modes.shapes[condition], modes.eta, work
    for j in range(cells):
        amplitudes[j] = kink * ramp[0, j]
    for k in range(cells):
        above_ramp = profile[i, k] - (base + kink) * eta[k]
        for j in range(cells):
            amplitudes[j] += project[k, j] * above_ramp
        profile[i, k] = new_base * eta[k]
    loss, gain = min(source_gain, 0.0), max(source_gain, 0.0)
    low, high = min(low, new_base) + min(load_gain, 0.0) + loss, max(high, new_base) + max(load_gain, 0.0) + gain
    # lines through the surface that enclose the column move with the load, and must enclose the base
    low_slope = min(low_slope + load_gain + cells * loss, new_base)
    high_slope = max(high_slope + load_gain + cells * gain, new_base)
    # factors exp(-number^2 diffusion), by products instead of one exponential for each mode
    lowest = math.exp(-0.25 * math.pi * math.pi * diffusion)
    factor = lowest**8
    decay, ratio = (lowest**4, lowest**12) if condition == DIRICHLET else (lowest, factor)
    brief = diffusion < BRIEF
    rate = 0.0 if brief else 1.0 / diffusion
    for j in range(cells):
        if brief:
            gained = push * ramp[0, j] + source_gain * uniform[0, j]
            amplitude = amplitudes[j] * decay + 0.5 * (1.0 + decay) * gained
        else:
            steady = (push * ramp[1, j] + source_gain * uniform[1, j]) * rate
            amplitude = (amplitudes[j] - steady) * decay + steady
        for k in range(cells):
            profile[i, k] += amplitude * shapes[j, k]
        decay *= ratio
        ratio *= factor
    # pressure that came evenly in time has diffused, in the mean, for 4/9 of it: a tail grows with its square root
    table = modes.tail[condition]
    tail = kink * tail_after(diffusion, cells, table) + push * tail_after(diffusion / 2.25, cells, table)
    for k in range(cells):
        pressure = profile[i, k] + tail * pattern[k]
        profile[i, k] = min(max(pressure, low, low_slope * eta[k]), high, high_slope * eta[k])
    if condition == DIRICHLET:
        profile[i, 0] = new_base
