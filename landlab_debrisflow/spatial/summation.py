"""SPH sums over neighbours on a surface: thickness, and the symmetric gradient that pushes.

Smoothing kernel: Wendland C2 in two dimensions (Wendland 1995; Dehnen & Aly 2012), support 2 l,

    W = 7/(4 pi l^2) (1 - q)^4 (1 + 4 q),   q = r / 2 l,

with r the chord in space. The smoothing length follows the thickness, l = 1.4 (V/h)^(1/2), and the
sums carry the corresponding gradient terms (Springel & Hernquist 2002; Price 2012): without them
nothing converges in a spreading flow.

The formulas stand in the loops that use them: numba's cache watches only a function's own file.
Every cell first copies its neighbourhood into a small contiguous scratch and then loops over it
without branches, which the compiler turns into vector code.
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

_NORM = 7.0 / (4.0 * np.pi)


def thickness(cells: Cells, x, y, z, volume, smoothing_length, longest, threads=1):
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

    Returns
    -------
    thickness, gradient_term, smoothing_length : ndarray, shape (n,)
        Slope-normal thickness [m]; Omega of the grad-h formulation [-]; the next smoothing length [m].

    Notes
    -----
    With h(l) = ratio^2 V / l^2 and the sum S(l), Newton on h - S(l(h)) = 0 has the slope
    Omega = 1 + l/(2h) dS/dl, so h - (h - S)/Omega is exact to second order in the change since the
    length was set: one pass per time step is enough.
    """
    n = x.size
    out = np.empty((3, n))
    over_cells(
        _thickness, cells, threads, cells.order, cells.start, cells.reach, cells.window, cells.columns,
        cells.rows, cells.size, x, y, z, volume, smoothing_length, longest, out,
    )  # fmt: skip
    return out


@kernel
def _thickness(first, last, order, start, reach, window, columns, rows, size, x, y, z, volume, length, longest, out):
    near = np.empty((4, order.size))
    for cell in range(first, last):
        if start[cell] == start[cell + 1]:
            continue
        row, column, w = cell // columns, cell % columns, window[cell]
        m = 0
        for r in range(max(row - w, 0), min(row + w, rows - 1) + 1):
            for q in range(max(column - w, 0), min(column + w, columns - 1) + 1):
                other = r * columns + q
                gap_x, gap_y = max(abs(q - column) - 1, 0) * size, max(abs(r - row) - 1, 0) * size
                if gap_x * gap_x + gap_y * gap_y >= reach[cell] * reach[cell]:
                    continue
                for k in range(start[other], start[other + 1]):
                    j = order[k]
                    near[0, m], near[1, m], near[2, m], near[3, m] = x[j], y[j], z[j], volume[j]
                    m += 1
        for k in range(start[cell], start[cell + 1]):
            i = order[k]
            xi, yi, zi, li = x[i], y[i], z[i], length[i]
            inverse = 0.5 / li
            total, change = 0.0, 0.0
            for j in range(m):
                dx, dy, dz = xi - near[0, j], yi - near[1, j], zi - near[2, j]
                q = np.sqrt(dx * dx + dy * dy + dz * dz) * inverse
                t = max(0.0, 1.0 - q)
                t3 = t * t * t * near[3, j]
                total += t3 * t * (1.0 + 4.0 * q)
                change += t3 * q * q
            own = (SELF_WEIGHT - 1.0) * volume[i]
            # dW/dl = -(1/l) (2 W + q dW/dq), and q d/dq [(1-q)^4 (1+4q)] = -20 q^2 (1-q)^3
            slope = -(2.0 * (total + own) - 20.0 * change) * _NORM / (li * li * li)
            total = (total + own) * _NORM / (li * li)
            if li >= longest[i]:
                h, omega = total, 1.0
            else:
                h = SMOOTHING_RATIO * SMOOTHING_RATIO * volume[i] / (li * li)
                omega = max(LEAST_GRADIENT_TERM, 1.0 + 0.5 * li / h * slope)
                h -= min(max((h - total) / omega, -h), 0.5 * h)
            out[0, i] = h
            out[1, i] = omega
            out[2, i] = min(longest[i], SMOOTHING_RATIO * np.sqrt(volume[i] / h))


def pressure_gradient(cells: Cells, x, y, z, velocity, volume, smoothing_length, strength, celerity, thickness,
                      viscosity, threads=1):
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

    Returns
    -------
    acceleration : ndarray, shape (3, n)
        [m s-2]
    thickening : ndarray, shape (n,)
        -h div v, the rate at which converging flow thickens, without the grad-h term [m s-1].
    """
    acceleration, thickening = np.empty((3, x.size)), np.empty(x.size)
    over_cells(
        _pressure_gradient, cells, threads, cells.order, cells.start, cells.reach, cells.window, cells.columns,
        cells.rows, cells.size, x, y, z, velocity, volume, smoothing_length, strength, celerity, thickness,
        viscosity, acceleration, thickening,
    )  # fmt: skip
    return acceleration, thickening


@kernel
def _pressure_gradient(
    first, last, order, start, reach, window, columns, rows, size, x, y, z, velocity, volume, length, strength,
    celerity, thickness, viscosity, acceleration, thickening,
):  # fmt: skip
    near = np.empty((12, order.size))
    for cell in range(first, last):
        if start[cell] == start[cell + 1]:
            continue
        row, column, w = cell // columns, cell % columns, window[cell]
        m = 0
        for r in range(max(row - w, 0), min(row + w, rows - 1) + 1):
            for q in range(max(column - w, 0), min(column + w, columns - 1) + 1):
                other = r * columns + q
                gap_x, gap_y = max(abs(q - column) - 1, 0) * size, max(abs(r - row) - 1, 0) * size
                if gap_x * gap_x + gap_y * gap_y >= max(reach[cell], reach[other]) ** 2:
                    continue
                for k in range(start[other], start[other + 1]):
                    j = order[k]
                    near[0, m], near[1, m], near[2, m] = x[j], y[j], z[j]
                    near[3, m], near[4, m], near[5, m] = velocity[0, j], velocity[1, j], velocity[2, j]
                    l2 = length[j] * length[j]
                    near[6, m] = 0.5 / length[j]
                    near[7, m] = volume[j] * 5.0 * _NORM / (l2 * l2)
                    near[8, m] = strength[j]
                    near[9, m] = celerity[j]
                    near[10, m] = thickness[j]
                    near[11, m] = volume[j]
                    m += 1
        for k in range(start[cell], start[cell + 1]):
            i = order[k]
            if volume[i] < 0.0:  # a hole pulls, and is not moved: see model/release.py
                acceleration[0, i], acceleration[1, i], acceleration[2, i], thickening[i] = 0.0, 0.0, 0.0, 0.0
                continue
            xi, yi, zi, si, ci, hi = x[i], y[i], z[i], strength[i], celerity[i], thickness[i]
            ui, vi, wi = velocity[0, i], velocity[1, i], velocity[2, i]
            inverse = 0.5 / length[i]
            own = 5.0 * _NORM / length[i] ** 4
            ax, ay, az, inflow = 0.0, 0.0, 0.0, 0.0
            for j in range(m):
                dx, dy, dz = xi - near[0, j], yi - near[1, j], zi - near[2, j]
                r = np.sqrt(dx * dx + dy * dy + dz * dz)
                ti, tj = max(0.0, 1.0 - r * inverse), max(0.0, 1.0 - r * near[6, j])
                du, dv, dw = ui - near[3, j], vi - near[4, j], wi - near[5, j]
                closing = -(du * dx + dv * dy + dw * dz)
                approach = max(0.0, closing) / (r + 1e-300)
                speed = ci + near[9, j] + 3.0 * approach
                shock = 0.5 * viscosity * speed * approach / (hi + near[10, j])
                # grad W = -5 * 7/(4 pi l^4) (1 - q)^3 r
                pull = own * near[11, j] * ti * ti * ti
                push = pull * (si + shock) + near[7, j] * tj * tj * tj * (near[8, j] + shock)
                ax += push * dx
                ay += push * dy
                az += push * dz
                inflow += pull * closing
            acceleration[0, i], acceleration[1, i], acceleration[2, i] = ax, ay, az
            thickening[i] = inflow
