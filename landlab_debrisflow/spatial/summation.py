"""SPH sums over neighbours on a surface, in one pass: thickness, and the symmetric gradient that pushes.

Smoothing kernel: Wendland C2 in two dimensions (Wendland 1995; Dehnen & Aly 2012), support 2 l,

    W = 7/(4 pi l^2) (1 - q)^4 (1 + 4 q),   q = r / 2 l,

with r the chord in space. The smoothing length follows the thickness, l = 1.4 (V/h)^(1/2), and the
sums carry the corresponding gradient terms (Springel & Hernquist 2002; Price 2012): without them
nothing converges in a spreading flow.

Particles are first packed in the order of the cells, in 32 bits (packing.py). Every cell then copies its
neighbourhood into a small contiguous scratch and loops over it without branches: the compiler turns the loop into
vector code, with one reciprocal root and no division per pair.

The formulas stand in the loops that use them: numba's cache watches only a function's own file.
"""

from typing import NamedTuple

import numpy as np

from ..core.jit import approximate_kernel, kernel
from .cells import Cells, over_cells
from .packing import LANES, Position, copy_neighbourhood, empty_packed

SMOOTHING_RATIO = 1.4
"""Smoothing length over particle spacing (V/h)^(1/2) [-]."""

SELF_WEIGHT = 0.9764
"""Weight of a particle's own term with which a regular lattice sums to its exact thickness: the plain Wendland sum is
0.67 % too deep, on square and on hexagonal lattices."""

LEAST_GRADIENT_TERM = 0.4
"""Floor of the grad-h term: it vanishes for a particle without neighbours, whose thickness is undefined."""

NORM = 7.0 / (4.0 * np.pi)
SLOPE = NORM / SMOOTHING_RATIO**2
_X, _Y, _Z = 0, 1, 2  # rows of `Packed.places`
# rows of `Packed.values`
_U, _V, _W, _INVERSE, _REACH, _COEFFICIENT, _CELERITY, _THINNESS, _CONVERGENCE, _VOLUME = range(10)

# a constant in double precision would make numba compute in double
_F = np.float32
_ZERO, _ONE, _THREE, _FOUR, _TINY = _F(0.0), _F(1.0), _F(3.0), _F(4.0), _F(1e-12)


class SummationInput(NamedTuple):
    """State of n particles that the sums read; particles beyond the size of `Sums` act, and get no sums.

    Attributes
    ----------
    position : Position
        On the surface [m].
    velocity : ndarray, shape (3, n)
        Velocity tangent to the bed [m s-1].
    volume : ndarray, shape (n,)
        Volume [m3]; a negative volume pulls, see model/release/placing.py.
    smoothing_length : ndarray, shape (n,)
        1.4 spacings [m].
    longest : ndarray, shape (n,)
        Cap of the smoothing length [m]; there it is fixed and the plain sum holds.
    pressure_coefficient : ndarray, shape (n,)
        Depth-integrated pressure over thickness^2, Omega and reference density: inertia g_n / (2 Omega) [m s-2].
    celerity : ndarray, shape (n,)
        Celerity of waves [m s-1].
    thickness : ndarray, shape (n,)
        Slope-normal, of the last time [m].
    convergence : ndarray, shape (n,)
        -h div v, of the last time [m s-1].
    inertia : ndarray, shape (n,)
        Density over a reference density [-].
    """

    position: Position
    velocity: np.ndarray
    volume: np.ndarray
    smoothing_length: np.ndarray
    longest: np.ndarray
    pressure_coefficient: np.ndarray
    celerity: np.ndarray
    thickness: np.ndarray
    convergence: np.ndarray
    inertia: np.ndarray


class Sums(NamedTuple):
    """Results of the sums, written where cells are awake.

    Attributes
    ----------
    thickness : ndarray, shape (n,)
        Slope-normal [m].
    gradient_term : ndarray, shape (n,)
        Omega of the grad-h formulation [-].
    next_length : ndarray, shape (n,)
        Smoothing length for the next time [m].
    acceleration : ndarray, shape (3, n)
        Acceleration by pressure [m s-2].
    convergence : ndarray, shape (n,)
        -h div v, the rate at which converging flow thickens, without grad-h term [m s-1].
    """

    thickness: np.ndarray
    gradient_term: np.ndarray
    next_length: np.ndarray
    acceleration: np.ndarray
    convergence: np.ndarray


def sum_over_neighbours(cells: Cells, given: SummationInput, viscosity: float, sums: Sums, threads: int = 1) -> None:
    """Sum thickness and pressure gradient, with shock viscosity.

    Parameters
    ----------
    cells : Cells
        Built with support 2 ``smoothing_length``.
    given : SummationInput
        State of the particles.
    viscosity : float
        Strength of the shock viscosity [-].
    sums : Sums
        Written where cells are awake.
    threads : int
        Number of threads.

    Notes
    -----
    inertia_i a_i = - sum_j V_j [(s_i + P) grad W(l_i) + (s_j + P) grad W(l_j)],
    P = (viscosity / 4) (c_i + c_j - 3 w) (-w) / max(h_i, h_j), w = min(0, v_ij . r_ij / r + k r): pairs that approach
    faster than in the uniform convergence k = min(-div v/2 of i, of j), k >= 0, which is no shock and must not be
    damped. Equal and opposite between any two particles of equal volume. The signal velocity c_i + c_j - 3 w is
    that of Monaghan (1997).

    The smoothing length is sought at which the sum S(l) of thickness equals h(l) = ratio^2 V / l^2. Newton on h -
    S(l(h)) = 0 has the slope
    Omega = 1 + l/(2h) dS/dl, so h - (h - S)/Omega is exact to second order in the change since the
    length was set: one pass per time step is enough. The pressure coefficient has Omega of the pass before.
    """
    packed = empty_packed(cells, values=10)
    plain = tuple(given.position), *given[1:]  # kernels are called faster with plain tuples (core/structs.py)
    _pack(cells.order, plain, packed)
    over_cells(_sum, cells, threads, tuple(cells), packed, plain, viscosity, tuple(sums))


def plain_thickness(volume, smoothing_length, sums: Sums):
    """Return the plain sums S(l) that `sum_over_neighbours` made, the whole weight of a particle itself included.

    They have the same errors as the sums over the other phase at the same place: where the particles of both phases lie
    alike, the fractions of the phases are exact.

    Parameters
    ----------
    volume, smoothing_length : ndarray, shape (n,)
        [m3], [m] given to `sum_over_neighbours`.
    sums : Sums
        Results of the sums.

    Returns
    -------
    ndarray, shape (n,)
        [m]
    """
    per_area = volume / smoothing_length**2
    before = SMOOTHING_RATIO**2 * per_area  # Newton: thickness = before - (before - S)/Omega
    return before - (before - sums.thickness) * sums.gradient_term + (1.0 - SELF_WEIGHT) * NORM * per_area


@kernel
def _pack(order, given, packed):
    """Put particles in the order of cells; lengths become numbers of quanta.

    Parameters
    ----------
    order : ndarray of int, shape (m,)
        Particle at each sorted place, of the n of `given`.
    given : SummationInput
        State of the particles.
    packed : Packed
        Written, ten values of each particle.
    """
    position, velocity, volume, length, _, coefficient, celerity, thickness, convergence, _ = given
    x, y, z = position
    places, values, quantum = packed
    per_metre, x0, y0, z0 = 1.0 / quantum, x[0], y[0], z[0]
    for k in range(order.size):
        i = order[k]
        # integers wrap around, and so do their differences, which are right again
        places[_X, k] = np.int32(np.int64((x[i] - x0) * per_metre))
        places[_Y, k] = np.int32(np.int64((y[i] - y0) * per_metre))
        places[_Z, k] = np.int32(np.int64((z[i] - z0) * per_metre))
        values[_U, k], values[_V, k], values[_W, k] = velocity[0, i], velocity[1, i], velocity[2, i]
        l2 = length[i] * length[i]
        values[_INVERSE, k] = 0.5 * quantum / length[i]
        values[_REACH, k] = volume[i] * (5.0 * NORM) / (l2 * l2)
        values[_COEFFICIENT, k], values[_CELERITY, k] = coefficient[i], celerity[i]
        thinness = 1.0 / thickness[i]
        values[_THINNESS, k], values[_VOLUME, k] = thinness, volume[i]
        values[_CONVERGENCE, k] = 0.5 * quantum * max(0.0, convergence[i] * thinness)


@approximate_kernel
def _sum(first, last, cells, packed, given, viscosity, sums):
    """Sum over the neighbours of the particles of cells ``first`` to ``last`` - 1 that are awake.

    Parameters
    ----------
    first, last : int
    cells : Cells
        Cell list over the particles.
    packed : Packed
        Values of all particles, by `_pack`.
    given : SummationInput
        With n particles.
    viscosity : float
        Strength of the viscosity of shocks [-].
    sums : Sums
        Written, for at most n particles.
    """
    _, _, order, start, _, _, _, awake, _ = cells
    places, values, quantum = packed
    _, _, volumes, lengths, longest, _, _, _, _, inertia = given
    thickness, gradient_term, next_length, acceleration, convergence = sums
    room = order.size + 2 * LANES
    near_places, near = np.empty((3, room), np.int32), np.empty((10, room), np.float32)
    scratch = near_places, near, quantum
    quarter = _F(0.25 * viscosity)
    for cell in range(first, last):
        if start[cell] == start[cell + 1] or not awake[cell]:
            continue
        m = copy_neighbourhood(cell, cells, packed, scratch)
        for k in range(start[cell], start[cell + 1]):
            i = order[k]
            if i >= thickness.size:
                continue
            volume, length = volumes[i], lengths[i]
            xi, yi, zi = places[_X, k], places[_Y, k], places[_Z, k]
            ui, vi, wi = values[_U, k], values[_V, k], values[_W, k]
            inverse, own = values[_INVERSE, k], values[_REACH, k] / values[_VOLUME, k]
            si, ci = values[_COEFFICIENT, k], values[_CELERITY, k]
            thin, uniform = values[_THINNESS, k], values[_CONVERGENCE, k]
            total, change, ax, ay, az, inflow = _ZERO, _ZERO, _ZERO, _ZERO, _ZERO, _ZERO
            for j in range(m):
                dx = _F(np.int32(xi - near_places[_X, j]))
                dy = _F(np.int32(yi - near_places[_Y, j]))
                dz = _F(np.int32(zi - near_places[_Z, j]))
                r2 = dx * dx + dy * dy + dz * dz + _TINY
                inverse_r = _ONE / np.sqrt(r2)
                r = r2 * inverse_r
                q = r * inverse
                ti, tj = max(_ZERO, _ONE - q), max(_ZERO, _ONE - r * near[_INVERSE, j])
                closing = (near[_U, j] - ui) * dx + (near[_V, j] - vi) * dy + (near[_W, j] - wi) * dz
                approach = max(_ZERO, closing - min(uniform, near[_CONVERGENCE, j]) * r2) * inverse_r
                shock = (
                    quarter * (ci + near[_CELERITY, j] + _THREE * approach) * approach
                    * min(thin, near[_THINNESS, j])
                )  # fmt: skip
                # W = norm/l^2 (1 - q)^4 (1 + 4 q), grad W = -5 norm/l^4 (1 - q)^3 r
                pull = near[_VOLUME, j] * ti * ti * ti
                total += pull * ti * (_ONE + _FOUR * q)
                change += pull * q * q
                pull *= own
                push = pull * (si + shock) + near[_REACH, j] * tj * tj * tj * (near[_COEFFICIENT, j] + shock)
                ax += push * dx
                ay += push * dy
                az += push * dz
                inflow += pull * closing
            scale = quantum / inertia[i]
            acceleration[0, i], acceleration[1, i], acceleration[2, i] = ax * scale, ay * scale, az * scale
            convergence[i] = inflow * quantum
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
