"""SPH sums over neighbours on a surface: thickness, and the symmetric gradient that pushes.

Smoothing kernel: Wendland C2 in two dimensions (Wendland 1995; Dehnen & Aly 2012), support 2 l,

    W = 7/(4 pi l^2) (1 - q)^4 (1 + 4 q),   q = r / 2 l,

with r the chord in space. The smoothing length follows the thickness, l = 1.4 (V/h)^(1/2), and the
sums carry the corresponding gradient terms (Springel & Hernquist 2002; Price 2012): without them
nothing converges in a spreading flow.

The formulas stand in the loops that use them: numba's cache watches only a function's own file.
What the pairs need is first packed in the order of the cells. Every cell then copies its neighbourhood,
row by row of cells, into a small contiguous scratch, fills it up to whole vectors with points that are
too far to matter, and loops over it without branches: the compiler turns that into vector code.
"""

import numpy as np

from ..core.jit import kernel
from .cells import Cells, over_cells

SMOOTHING_RATIO = 1.4
"""Smoothing length over particle spacing (V/h)^(1/2) [-]."""

SELF_WEIGHT = 0.9764
"""Weight of a particle's own term, with which a regular lattice sums to its exact thickness: with the
plain Wendland sum it comes out 0.67 % too deep on square and hexagonal lattices alike."""

LEAST_GRADIENT_TERM = 0.4
"""Floor of the grad-h term: it vanishes for a particle without neighbours, whose thickness is undefined."""

_LANES = 8  # doubles in the widest vector register
_FAR = 1e30  # where the filling points stand [m]

_NORM = 7.0 / (4.0 * np.pi)


def sum_thickness(cells: Cells, x, y, z, volume, smoothing_length, longest, out, threads=1):
    """Sum the slope-normal thickness and take one Newton step towards a consistent smoothing length.

    Parameters
    ----------
    cells : Cells
        Built with support 2 `smoothing_length`.
    x, y, z, volume : ndarray, shape (n,)
        Position on the surface [m] and volume [m3].
    smoothing_length : ndarray, shape (n,)
        Present values [m].
    longest : ndarray, shape (n,)
        Cap of the smoothing length [m]; at the cap the length is fixed and the plain sum holds.

    out : tuple of three ndarray, shape (n,)
        Written where cells are awake: slope-normal thickness [m]; Omega of the grad-h formulation [-];
        the next smoothing length [m].

    Notes
    -----
    With h(l) = ratio^2 V / l^2 and the sum S(l), Newton on h - S(l(h)) = 0 has the slope
    Omega = 1 + l/(2h) dS/dl, so h - (h - S)/Omega is exact to second order in the change since the
    length was set: one pass per time step is enough.
    """
    packed = np.stack((x, y, z, volume, smoothing_length))[:, cells.order]
    over_cells(
        _thickness, cells, threads, cells.order, cells.start, cells.near, cells.near_start, packed, longest, *out,
    )  # fmt: skip


@kernel
def _neighbourhood(first, last, near, packed, scratch):
    """Copy the particles near[first:last] into `scratch`; return their number, rounded up to whole vectors."""
    m = last - first
    for v in range(scratch.shape[0]):
        for k in range(m):
            scratch[v, k] = packed[v, near[first + k]]
    while m % _LANES:
        for v in range(scratch.shape[0]):
            scratch[v, m] = 0.0
        scratch[0, m] = _FAR
        m += 1
    return m


@kernel
def _thickness(
    first, last, order, start, near, near_start, packed, longest, thickness, gradient_term, next_length,
):  # fmt: skip
    scratch = np.empty((4, order.size + _LANES))
    for cell in range(first, last):
        m = _neighbourhood(near_start[cell], near_start[cell + 1], near, packed, scratch)
        if m == 0:
            continue
        for k in range(start[cell], start[cell + 1]):
            i, volume = order[k], packed[3, k]
            xi, yi, zi, li = packed[0, k], packed[1, k], packed[2, k], packed[4, k]
            inverse = 0.5 / li
            total, change = 0.0, 0.0
            for j in range(m):
                dx, dy, dz = xi - scratch[0, j], yi - scratch[1, j], zi - scratch[2, j]
                q = np.sqrt(dx * dx + dy * dy + dz * dz) * inverse
                t = max(0.0, 1.0 - q)
                t3 = t * t * t * scratch[3, j]
                total += t3 * t * (1.0 + 4.0 * q)
                change += t3 * q * q
            own = (SELF_WEIGHT - 1.0) * volume
            # dW/dl = -(1/l) (2 W + q dW/dq), and q d/dq [(1-q)^4 (1+4q)] = -20 q^2 (1-q)^3
            slope = -(2.0 * (total + own) - 20.0 * change) * _NORM / (li * li * li)
            total = (total + own) * _NORM / (li * li)
            if li >= longest[i]:
                h, omega = total, 1.0
            else:
                h = SMOOTHING_RATIO * SMOOTHING_RATIO * volume / (li * li)
                omega = max(LEAST_GRADIENT_TERM, 1.0 + 0.5 * li / h * slope)
                h -= min(max((h - total) / omega, -h), 0.5 * h)
            thickness[i], gradient_term[i] = h, omega
            next_length[i] = min(longest[i], SMOOTHING_RATIO * np.sqrt(volume / h))


def sum_pressure_gradient(cells: Cells, x, y, z, velocity, volume, smoothing_length, strength, celerity, thickness,
                          viscosity, acceleration, thickening, threads=1):  # fmt: skip
    """Sum the symmetric pressure gradient with shock viscosity: an acceleration.

    a_i = - sum_j V_j [(s_i + P) grad W(l_i) + (s_j + P) grad W(l_j)],
    P = (viscosity / 4) (c_i + c_j - 3 w) (-w) / h_ij for approaching pairs, w = min(0, v_ij . r_ij / r).

    Equal and opposite between any two particles of equal volume, so momentum is conserved to round-off.
    The signal velocity c_i + c_j - 3 w is that of Monaghan (1997).

    Parameters
    ----------
    x, y, z, volume, smoothing_length, thickness, celerity : ndarray, shape (n,)
    velocity : ndarray, shape (3, n)
    strength : ndarray, shape (n,)
        g_n / (2 Omega) [m s-2].
    viscosity : float
        Strength of the shock viscosity [-].

    acceleration : ndarray, shape (3, n)
        Written where cells are awake [m s-2].
    thickening : ndarray, shape (n,)
        Likewise: -h div v, the rate at which converging flow thickens, without the grad-h term [m s-1].
    """
    reach = volume * (5.0 * _NORM) / smoothing_length**4
    packed = np.stack(
        (x, y, z, *velocity, 0.5 / smoothing_length, reach, strength, celerity, thickness, volume)
    )[:, cells.order]  # fmt: skip
    over_cells(
        _pressure_gradient, cells, threads, cells.order, cells.start, cells.near, cells.near_start,
        packed, viscosity, acceleration, thickening,
    )  # fmt: skip


@kernel
def _pressure_gradient(
    first, last, order, start, near, near_start, packed, viscosity, acceleration, thickening,
):  # fmt: skip
    scratch = np.empty((12, order.size + _LANES))
    for cell in range(first, last):
        m = _neighbourhood(near_start[cell], near_start[cell + 1], near, packed, scratch)
        if m == 0:
            continue
        for k in range(start[cell], start[cell + 1]):
            i, volume = order[k], packed[11, k]
            if volume < 0.0:  # a hole pulls, and is not moved: see model/release.py
                acceleration[0, i], acceleration[1, i], acceleration[2, i], thickening[i] = 0.0, 0.0, 0.0, 0.0
                continue
            xi, yi, zi, ui, vi, wi = packed[0, k], packed[1, k], packed[2, k], packed[3, k], packed[4, k], packed[5, k]
            inverse, own, si, ci, hi = packed[6, k], packed[7, k] / volume, packed[8, k], packed[9, k], packed[10, k]
            ax, ay, az, inflow = 0.0, 0.0, 0.0, 0.0
            for j in range(m):
                dx, dy, dz = xi - scratch[0, j], yi - scratch[1, j], zi - scratch[2, j]
                r = np.sqrt(dx * dx + dy * dy + dz * dz)
                ti, tj = max(0.0, 1.0 - r * inverse), max(0.0, 1.0 - r * scratch[6, j])
                closing = -((ui - scratch[3, j]) * dx + (vi - scratch[4, j]) * dy + (wi - scratch[5, j]) * dz)
                both = hi + scratch[10, j]
                approach = max(0.0, closing) / (r * both + 1e-300)  # speed over the sum of thicknesses
                shock = 0.5 * viscosity * (ci + scratch[9, j] + 3.0 * approach * both) * approach
                # grad W = -5 * 7/(4 pi l^4) (1 - q)^3 r
                pull = own * scratch[11, j] * ti * ti * ti
                push = pull * (si + shock) + scratch[7, j] * tj * tj * tj * (scratch[8, j] + shock)
                ax += push * dx
                ay += push * dy
                az += push * dz
                inflow += pull * closing
            acceleration[0, i], acceleration[1, i], acceleration[2, i] = ax, ay, az
            thickening[i] = inflow
