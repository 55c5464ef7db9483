"""SPH sums over neighbours on a surface, in one pass: thickness, and the symmetric gradient that pushes.

Smoothing kernel: Wendland C2 in two dimensions (Wendland 1995; Dehnen & Aly 2012), support 2 l,

    W = 7/(4 pi l^2) (1 - q)^4 (1 + 4 q),   q = r / 2 l,

with r the chord in space. The smoothing length follows the thickness, l = 1.4 (V/h)^(1/2), and the
sums carry the corresponding gradient terms (Springel & Hernquist 2002; Price 2012): without them
nothing converges in a spreading flow.

State is first packed in 32 bits (packing.py). A group of particles, one in each lane of the vector unit, then goes
over its list of candidates (groups.py), whose values are the same for all lanes: vector code without branches, with one
reciprocal root and no division per pair.

The formulas stand in the loops that use them: numba's cache watches only a function's own file.
"""

import numpy as np

from ..core.jit import approximate_kernel, kernel
from ..core.lanes import LANES, lane_floats, lane_places
from ..core.threads import in_ranges
from .cells import Cells
from .groups import find_candidates, group
from .packing import empty_packed, pack_place, quantum_of
from .sums import SummationInput, Sums

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
_U, _V, _W, _INVERSE, _REACH, _PUSH, _CELERITY, _THINNESS, _CONVERGENCE, _VOLUME = range(10)

# a constant in double precision would make numba compute in double
_F = np.float32
_ZERO, _ONE, _TWO, _FOUR, _FIVE, _TINY = _F(0.0), _F(1.0), _F(2.0), _F(4.0), _F(5.0), _F(1e-12)

_U64 = np.uint64
_LANES = _U64(LANES)


def sum_over_neighbours(
    cells: Cells, given: SummationInput, viscosity: float, sums: Sums, threads: int = 1, phases: tuple[Cells, ...] = ()
) -> None:
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
    phases : tuple of Cells
        Cells of phases whose particles have neighbours of their own phase only; none if all are of one phase.

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
    count = given.volume.size
    packed, found = empty_packed(count, 10, quantum_of(cells)), np.empty((6, count), np.float32)
    plain = tuple(given.position), *given[1:]  # kernels are called faster with plain tuples (core/structs.py)
    _pack(plain, viscosity, packed)
    for of_phase in phases or (cells,):
        groups = group(of_phase)
        in_ranges(_sum, groups.first.size, threads, tuple(groups), tuple(of_phase), packed, found)
    _finish(cells.computed, packed[-1], found, plain, tuple(sums))


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
def _pack(given, viscosity, packed):
    """Write the state of particles in 32 bits.

    Lengths become numbers of quanta; velocities are tripled, and thinness has the viscosity over 12, because the
    viscosity of shocks needs them so.

    Parameters
    ----------
    given : SummationInput
        State of the particles.
    viscosity : float
        Strength of the viscosity of shocks [-].
    packed : Packed
        Written, ten values of each particle.
    """
    position, velocity, volume, length, _, coefficient, celerity, thickness, convergence, _ = given
    x, y, z = position
    places, values, quantum = packed
    per_metre, x0, y0, z0 = 1.0 / quantum, x[0], y[0], z[0]
    for i in range(volume.size):
        places[_X, i] = pack_place(x[i] - x0, per_metre)
        places[_Y, i] = pack_place(y[i] - y0, per_metre)
        places[_Z, i] = pack_place(z[i] - z0, per_metre)
        values[_U, i], values[_V, i] = 3.0 * velocity[0, i], 3.0 * velocity[1, i]
        values[_W, i] = 3.0 * velocity[2, i]
        inverse, thinness = 1.0 / length[i], 1.0 / thickness[i]
        inverse2 = inverse * inverse
        reach = volume[i] * (5.0 * NORM) * inverse2 * inverse2
        values[_INVERSE, i], values[_REACH, i] = 0.5 * quantum * inverse, reach
        values[_PUSH, i], values[_CELERITY, i] = reach * coefficient[i], celerity[i]
        values[_THINNESS, i], values[_VOLUME, i] = viscosity / 12.0 * thinness, volume[i]
        values[_CONVERGENCE, i] = 1.5 * quantum * max(0.0, convergence[i] * thinness)


@approximate_kernel
def _sum(first, last, groups, cells, packed, found):
    """Sum over the neighbours of the particles of groups ``first`` to ``last`` - 1.

    Parameters
    ----------
    first, last : int
    groups : Groups
        Groups of particles.
    cells : Cells
        Cell list over all particles, n.
    packed : Packed
        Values of all particles, by `_pack`.
    found : ndarray of float32, shape (6, n)
        Written: sum of the weights and of their change with the length, both of volume, the force per inertia in three
        directions per quantum, and three times the convergence.
    """
    starts, ends, _, _ = groups
    order, sorted_places = cells[6], cells[9]
    places, values, _ = packed
    near = np.empty(order.size + LANES, np.uint32)
    target = lane_places()
    x, y, z = lane_places(), lane_places(), lane_places()
    u, v, w, inverse, own, push = (
        lane_floats(),
        lane_floats(),
        lane_floats(),
        lane_floats(),
        lane_floats(),
        lane_floats(),
    )
    celerity, thin, uniform = lane_floats(), lane_floats(), lane_floats()
    sum0, sum1, sum2, inflow = lane_floats(), lane_floats(), lane_floats(), lane_floats()
    ax, ay, az = lane_floats(), lane_floats(), lane_floats()
    for g in range(first, last):
        m = find_candidates(g, groups, sorted_places, cells, near)
        begin, end = _U64(starts[g]), _U64(ends[g])
        for lane in range(_LANES):
            target[lane] = order[min(begin + lane, end - _U64(1))]  # lanes to spare repeat the last particle
        for lane in range(_LANES):
            i = _U64(target[lane])
            x[lane], y[lane], z[lane] = places[_X, i], places[_Y, i], places[_Z, i]
            u[lane], v[lane], w[lane] = values[_U, i], values[_V, i], values[_W, i]
            inverse[lane], own[lane] = values[_INVERSE, i], values[_REACH, i] / values[_VOLUME, i]
            push[lane] = values[_PUSH, i] / values[_VOLUME, i]
            celerity[lane], thin[lane] = values[_CELERITY, i], values[_THINNESS, i]
            uniform[lane] = values[_CONVERGENCE, i]
        for lane in range(LANES):
            sum0[lane] = sum1[lane] = sum2[lane] = inflow[lane] = ax[lane] = ay[lane] = az[lane] = _ZERO
        for s in range(m):
            j = _U64(order[near[s]])
            xj, yj, zj = places[_X, j], places[_Y, j], places[_Z, j]
            uj, vj, wj = values[_U, j], values[_V, j], values[_W, j]
            inverse_j, reach_j, push_j = values[_INVERSE, j], values[_REACH, j], values[_PUSH, j]
            celerity_j, thin_j = values[_CELERITY, j], values[_THINNESS, j]
            uniform_j, volume_j = values[_CONVERGENCE, j], values[_VOLUME, j]
            for lane in range(LANES):
                dx, dy, dz = _F(np.int32(x[lane] - xj)), _F(np.int32(y[lane] - yj)), _F(np.int32(z[lane] - zj))
                r2 = dx * dx + dy * dy + dz * dz + _TINY
                inverse_r = _ONE / np.sqrt(r2)
                r = r2 * inverse_r
                t, tj = max(_ZERO, _ONE - r * inverse[lane]), max(_ZERO, _ONE - r * inverse_j)
                closing = (uj - u[lane]) * dx + (vj - v[lane]) * dy + (wj - w[lane]) * dz
                approach = max(_ZERO, closing - min(uniform[lane], uniform_j) * r2) * inverse_r
                shock = (celerity[lane] + celerity_j + approach) * approach * min(thin[lane], thin_j)
                # with t = 1 - q: W = norm/l^2 (5 t^4 - 4 t^5), grad W = -5 norm/l^4 t^3 r
                t2 = t * t
                pull = volume_j * t * t2
                sum0[lane] += pull
                sum1[lane] += pull * t
                sum2[lane] += pull * t2
                inflow[lane] += pull * closing
                force = pull * (push[lane] + own[lane] * shock) + tj * tj * tj * (push_j + reach_j * shock)
                ax[lane] += force * dx
                ay[lane] += force * dy
                az[lane] += force * dz
        for lane in range(end - begin):
            i = _U64(target[lane])
            found[0, i] = _FIVE * sum1[lane] - _FOUR * sum2[lane]
            found[1, i] = sum0[lane] - _TWO * sum1[lane] + sum2[lane]
            found[2, i], found[3, i], found[4, i] = ax[lane], ay[lane], az[lane]
            found[5, i] = inflow[lane] * own[lane]


@kernel
def _finish(computed, quantum, found, given, sums):
    """Make thickness, length, acceleration and convergence of sums.

    Parameters
    ----------
    computed : ndarray of bool, shape (n,)
        Whether the sums of a particle were made.
    quantum : float
        [m]
    found : ndarray of float32, shape (6, n)
        Sums, by `_sum`.
    given : SummationInput
        With n particles.
    sums : Sums
        Written, for at most n particles.
    """
    _, _, volumes, lengths, longest, _, _, _, _, inertia = given
    thickness, gradient_term, next_length, acceleration, convergence = sums
    for i in range(thickness.size):
        if not computed[i]:
            continue
        volume, length = volumes[i], lengths[i]
        scale = quantum / inertia[i]
        for axis in range(3):
            acceleration[axis, i] = found[2 + axis, i] * scale
        convergence[i] = found[5, i] * quantum * (1.0 / 3.0)
        # dW/dl = -(1/l) (2 W + q dW/dq), and q d/dq [(1-q)^4 (1+4q)] = -20 q^2 (1-q)^3; with h = ratio^2 V / l^2
        # the slope l/(2h) dS/dl of the sum has no l left
        mass = found[0, i] + (SELF_WEIGHT - 1.0) * volume
        per_area = 1.0 / (length * length)
        thick = mass * NORM * per_area
        h = SMOOTHING_RATIO * SMOOTHING_RATIO * volume * per_area
        omega = max(LEAST_GRADIENT_TERM, 1.0 - (mass - 10.0 * found[1, i]) * SLOPE / volume)
        h -= min(max((h - thick) / omega, -h), 0.5 * h)
        fixed = length >= longest[i]
        h, omega = thick if fixed else h, 1.0 if fixed else omega
        thickness[i], gradient_term[i] = h, omega
        next_length[i] = min(longest[i], SMOOTHING_RATIO * np.sqrt(volume / h))
