"""SPH sums over neighbours on a surface, in one pass: thickness, and the symmetric gradient that pushes.

Smoothing kernel: Wendland C2 in two dimensions (Wendland 1995; Dehnen & Aly 2012), support 2 l,

    W = 7/(4 pi l^2) (1 - q)^4 (1 + 4 q),   q = r / 2 l,

with r the chord in space. The smoothing length follows the thickness, l = 1.4 (V/h)^(1/2), and the
sums carry the corresponding gradient terms (Springel & Hernquist 2002; Price 2012): without them
nothing converges in a spreading flow.

What the pairs need is first packed in the order of the cells, in 32 bits: positions as whole numbers of a
2^-23 of the width of a cell, so their differences are exact and the same seen from either side; the
rest as floats, whose rounding, 6e-8, is far below what the sums are wrong by. Every cell then copies its
neighbourhood, one stretch for every row of cells, into a small contiguous scratch and loops over it
without branches: the compiler turns that into vector code, with one reciprocal root and no division a pair.

The formulas stand in the loops that use them: numba's cache watches only a function's own file.
"""

from typing import NamedTuple

import numpy as np

from ..core.jit import approximate_kernel, inner, kernel
from .cells import Cells, over_cells

SMOOTHING_RATIO = 1.4
"""Smoothing length over particle spacing (V/h)^(1/2) [-]."""

SELF_WEIGHT = 0.9764
"""Weight of a particle's own term, with which a regular lattice sums to its exact thickness: with the
plain Wendland sum it comes out 0.67 % too deep on square and hexagonal lattices alike."""

LEAST_GRADIENT_TERM = 0.4
"""Floor of the grad-h term: it vanishes for a particle without neighbours, whose thickness is undefined."""

NORM = 7.0 / (4.0 * np.pi)
SLOPE = NORM / SMOOTHING_RATIO**2
PLACES_PER_CELL = 2.0**23  # +-2^31 of them are 256 cells: far beyond any window
LANES = 16  # floats in the widest vector register
_X, _Y, _Z = 0, 1, 2  # rows of what is packed as whole numbers
_U, _V, _W, _INVERSE, _REACH, _STRENGTH, _CELERITY, _THINNESS, _CONVERGENCE, _VOLUME = range(10)  # and as floats

# numba computes in double where a constant is one; and an index that may be negative is not vectorised
_F, _U64 = np.float32, np.uint64
_ZERO, _ONE, _THREE, _FOUR, _TINY = _F(0.0), _F(1.0), _F(3.0), _F(4.0), _F(1e-12)


class Moving(NamedTuple):
    """What the sums read of n particles. Those beyond the size of `Sums` act on others and are not moved."""

    x: np.ndarray  # position on the surface, (n,) [m]
    y: np.ndarray
    z: np.ndarray
    velocity: np.ndarray  # (3, n) [m s-1]
    volume: np.ndarray  # (n,) [m3]; a hole, < 0, pulls: see model/release/release.py
    smoothing_length: np.ndarray  # (n,) [m]
    longest: np.ndarray  # (n,) cap of the smoothing length [m]; there it is fixed and the plain sum holds
    strength: np.ndarray  # (n,) thrust over thickness^2, Omega and reference density: inertia g_n / (2 Omega) [m s-2]
    celerity: np.ndarray  # (n,) of waves [m s-1]
    thickness: np.ndarray  # (n,) slope-normal, of the last time [m]
    thickening: np.ndarray  # (n,) -h div v, of the last time [m s-1]
    inertia: np.ndarray  # (n,) density over a reference density [-]


class Sums(NamedTuple):
    """What they write, where cells are awake."""

    thickness: np.ndarray  # (n,) slope-normal [m]
    gradient_term: np.ndarray  # (n,) Omega of the grad-h formulation [-]
    next_length: np.ndarray  # (n,) smoothing length for the next time [m]
    acceleration: np.ndarray  # (3, n) [m s-2]
    thickening: np.ndarray  # (n,) -h div v, the rate at which converging flow thickens, without grad-h term [m s-1]


def sum_over_neighbours(cells: Cells, moving: Moving, viscosity: float, sums: Sums, threads: int = 1) -> None:
    """Sum thickness and pressure gradient, with shock viscosity.

    Parameters
    ----------
    cells : Cells
        Built with support 2 ``smoothing_length``.
    moving : Moving
    viscosity : float
        Strength of the shock viscosity [-].
    sums : Sums
        Written where cells are awake.
    threads : int

    Notes
    -----
    inertia_i a_i = - sum_j V_j [(s_i + P) grad W(l_i) + (s_j + P) grad W(l_j)],
    P = (viscosity / 4) (c_i + c_j - 3 w) (-w) / max(h_i, h_j), w = min(0, v_ij . r_ij / r + k r): pairs that approach
    faster than in the uniform convergence k = min(-div v/2 of i, of j), k >= 0, which is no shock and must not be
    damped. Equal and opposite between any two particles of equal volume. The signal velocity c_i + c_j - 3 w is
    that of Monaghan (1997).

    The sum S(l) of thickness wants to be h(l) = ratio^2 V / l^2. Newton on h - S(l(h)) = 0 has the slope
    Omega = 1 + l/(2h) dS/dl, so h - (h - S)/Omega is exact to second order in the change since the
    length was set: one pass per time step is enough. The strength has Omega of the pass before.
    """
    n = moving.x.size
    places, packed = np.empty((3, n + LANES), np.int32), np.empty((10, n + LANES), np.float32)
    quantum = cells.size / PLACES_PER_CELL
    _pack(cells.order, *moving[:6], *moving[7:11], quantum, places, packed)
    over_cells(
        _sum, cells, threads, cells.columns, cells.order, cells.start, cells.reach, cells.box, cells.window,
        cells.awake, places, packed, quantum, viscosity, moving.volume, moving.smoothing_length, moving.longest,
        moving.inertia, *sums,
    )  # fmt: skip


def plain_thickness(volume, smoothing_length, sums: Sums):
    """Return the plain sums S(l) that `sum_over_neighbours` made, the whole weight of a particle itself included.

    Compared with the sum over another phase at the same place they have the same errors: where both phases lie alike
    their parts come out exactly.

    Parameters
    ----------
    volume, smoothing_length : ndarray, shape (n,)
        [m3], [m] with which it was called.
    sums : Sums

    Returns
    -------
    ndarray, shape (n,)
        [m]
    """
    per_area = volume / smoothing_length**2
    before = SMOOTHING_RATIO**2 * per_area  # Newton: thickness = before - (before - S)/Omega
    return before - (before - sums.thickness) * sums.gradient_term + (1.0 - SELF_WEIGHT) * NORM * per_area


@kernel
def _pack(
    order, x, y, z, velocity, volume, length, strength, celerity, thickness, thickening, quantum, places, packed
):  # fmt: skip
    """Put particles in the order of cells; lengths become numbers of quanta."""
    per_metre, x0, y0, z0 = 1.0 / quantum, x[0], y[0], z[0]
    for k in range(order.size):
        i = order[k]
        places[_X, k] = np.int32(np.int64((x[i] - x0) * per_metre))  # wraps around, and so do differences
        places[_Y, k] = np.int32(np.int64((y[i] - y0) * per_metre))
        places[_Z, k] = np.int32(np.int64((z[i] - z0) * per_metre))
        packed[_U, k], packed[_V, k], packed[_W, k] = velocity[0, i], velocity[1, i], velocity[2, i]
        l2 = length[i] * length[i]
        packed[_INVERSE, k] = 0.5 * quantum / length[i]
        packed[_REACH, k] = volume[i] * (5.0 * NORM) / (l2 * l2)
        packed[_STRENGTH, k], packed[_CELERITY, k] = strength[i], celerity[i]
        thinness = 1.0 / thickness[i]
        packed[_THINNESS, k], packed[_VOLUME, k] = thinness, volume[i]
        packed[_CONVERGENCE, k] = 0.5 * quantum * max(0.0, thickening[i] * thinness)


@inner
def copy_neighbourhood(cell, columns, start, reach, box, window, places, packed, where, what):
    """Copy the particles that may act on a cell into the scratch; return their number, rounded up to whole vectors."""
    rows = (start.size - 1) // columns
    row, column, w, m = cell // columns, cell % columns, window[cell], 0
    for r in range(max(row - w, 0), min(row + w, rows - 1) + 1):
        low, high = -1, -1
        for q in range(max(column - w, 0), min(column + w, columns - 1) + 1):
            d = r * columns + q
            gap_x = max(box[0, d] - box[1, cell], box[0, cell] - box[1, d], 0.0)
            gap_y = max(box[2, d] - box[3, cell], box[2, cell] - box[3, d], 0.0)
            distance = max(reach[d], reach[cell])
            if gap_x * gap_x + gap_y * gap_y < distance * distance:
                low = d if low < 0 else low
                high = d
        if low >= 0:  # a row of cells is one stretch of sorted particles; whole vectors of it, the rest is overwritten
            first, here = _U64(start[low]), _U64(m)
            count = start[high + 1] - start[low]
            whole = _U64(count + LANES - 1) // _U64(LANES) * _U64(LANES)
            for v in range(where.shape[0]):
                for k in range(whole):
                    where[v, here + k] = places[v, first + k]
            for v in range(what.shape[0]):
                for k in range(whole):
                    what[v, here + k] = packed[v, first + k]
            m += count
    for k in range(m, m + LANES):  # fill up with what weighs nothing
        where[_X, k], where[_Y, k], where[_Z, k] = 0, 0, 0
        for v in range(what.shape[0]):
            what[v, k] = _ZERO
    return (m + LANES - 1) // LANES * LANES


@approximate_kernel
def _sum(
    first, last, columns, order, start, reach, box, window, awake, places, packed, quantum, viscosity,
    volumes, lengths, longest, inertia, thickness, gradient_term, next_length, acceleration, thickening,
):  # fmt: skip
    where, what = np.empty((3, order.size + 2 * LANES), np.int32), np.empty((10, order.size + 2 * LANES), np.float32)
    quarter = _F(0.25 * viscosity)
    for cell in range(first, last):
        if start[cell] == start[cell + 1] or not awake[cell]:
            continue
        m = copy_neighbourhood(cell, columns, start, reach, box, window, places, packed, where, what)
        for k in range(start[cell], start[cell + 1]):
            i = order[k]
            if i >= thickness.size:
                continue
            volume, length = volumes[i], lengths[i]
            xi, yi, zi = places[_X, k], places[_Y, k], places[_Z, k]
            ui, vi, wi = packed[_U, k], packed[_V, k], packed[_W, k]
            inverse, own = packed[_INVERSE, k], packed[_REACH, k] / packed[_VOLUME, k]
            si, ci = packed[_STRENGTH, k], packed[_CELERITY, k]
            thin, uniform = packed[_THINNESS, k], packed[_CONVERGENCE, k]
            total, change, ax, ay, az, inflow = _ZERO, _ZERO, _ZERO, _ZERO, _ZERO, _ZERO
            for j in range(m):
                dx = _F(np.int32(xi - where[_X, j]))
                dy = _F(np.int32(yi - where[_Y, j]))
                dz = _F(np.int32(zi - where[_Z, j]))
                r2 = dx * dx + dy * dy + dz * dz + _TINY
                inverse_r = _ONE / np.sqrt(r2)
                r = r2 * inverse_r
                q = r * inverse
                ti, tj = max(_ZERO, _ONE - q), max(_ZERO, _ONE - r * what[_INVERSE, j])
                closing = (what[_U, j] - ui) * dx + (what[_V, j] - vi) * dy + (what[_W, j] - wi) * dz
                approach = max(_ZERO, closing - min(uniform, what[_CONVERGENCE, j]) * r2) * inverse_r
                shock = (
                    quarter * (ci + what[_CELERITY, j] + _THREE * approach) * approach
                    * min(thin, what[_THINNESS, j])
                )  # fmt: skip
                # W = norm/l^2 (1 - q)^4 (1 + 4 q), grad W = -5 norm/l^4 (1 - q)^3 r
                pull = what[_VOLUME, j] * ti * ti * ti
                total += pull * ti * (_ONE + _FOUR * q)
                change += pull * q * q
                pull *= own
                push = pull * (si + shock) + what[_REACH, j] * tj * tj * tj * (what[_STRENGTH, j] + shock)
                ax += push * dx
                ay += push * dy
                az += push * dz
                inflow += pull * closing
            scale = quantum / inertia[i]
            acceleration[0, i], acceleration[1, i], acceleration[2, i] = ax * scale, ay * scale, az * scale
            thickening[i] = inflow * quantum
            # dW/dl = -(1/l) (2 W + q dW/dq), and q d/dq [(1-q)^4 (1+4q)] = -20 q^2 (1-q)^3; with h = ratio^2 V / l^2
            # the slope l/(2h) dS/dl of the sum has no l left
            mass = total + (SELF_WEIGHT - 1.0) * volume
            per_area = 1.0 / (length * length)
            thick = mass * NORM * per_area
            if length >= longest[i]:
                h, omega = thick, 1.0
            else:
                h = SMOOTHING_RATIO * SMOOTHING_RATIO * volume * per_area
                omega = max(LEAST_GRADIENT_TERM, 1.0 - (mass - 10.0 * change) * SLOPE / volume)
                h -= min(max((h - thick) / omega, -h), 0.5 * h)
            thickness[i], gradient_term[i] = h, omega
            next_length[i] = min(longest[i], SMOOTHING_RATIO * np.sqrt(volume / h))
