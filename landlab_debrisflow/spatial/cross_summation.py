"""SPH sums of the particles of one phase over the particles of the other.

Smoothing kernel, smoothing lengths and layout are those of `summation`, where the formulas and their reasons stand. A
phase is a subset of the particles, in the cells of all of them.
"""

from typing import NamedTuple

import numpy as np

from ..core.jit import approximate_kernel, kernel
from ..core.lanes import LANES, lane_floats, lane_places
from ..core.threads import in_ranges
from .cells import Cells
from .groups import find_candidates, group
from .packing import Position, empty_packed, pack_place, quantum_of
from .summation import NORM, SLOPE

_X, _Y, _Z = 0, 1, 2  # rows of `Packed.places`
_INVERSE, _PUSH, _VOLUME, _AVERAGED = range(4)  # rows of `Packed.values`

# a constant in double precision would make numba compute in double
_F = np.float32
_ZERO, _ONE, _TWO, _FOUR, _FIVE, _TEN, _TINY = _F(0.0), _F(1.0), _F(2.0), _F(4.0), _F(5.0), _F(10.0), _F(1e-12)
_NORM, _SLOPE = _F(NORM), _F(SLOPE)

_U64 = np.uint64
_LANES = _U64(LANES)


class CrossPhaseInput(NamedTuple):
    """State of all n particles, of either phase, for the sums over the other phase.

    Attributes
    ----------
    position : Position
        On the surface [m].
    volume : ndarray, shape (n,)
        Volume of the particle [m3].
    smoothing_length : ndarray, shape (n,)
        1.4 spacings [m].
    pressure_coefficient : ndarray, shape (n,)
        Depth-integrated pressure on both phases over total thickness^2 [N m-3].
    averaged : ndarray, shape (n,)
        Quantity to be averaged, in any unit.
    """

    position: Position
    volume: np.ndarray
    smoothing_length: np.ndarray
    pressure_coefficient: np.ndarray
    averaged: np.ndarray


class CrossPhaseSums(NamedTuple):
    """Results of the sums over the other phase, written where cells are awake.

    Attributes
    ----------
    thickness : ndarray, shape (n,)
        Slope-normal thickness of the other phase [m].
    cross_term : ndarray, shape (n,)
        L/(2 own thickness) d(thickness of the other phase)/dl [-].
    mean : ndarray, shape (n,)
        Mean of the averaged quantity over the other phase, in its unit; 0 where there are no particles of this phase.
    force : ndarray, shape (3, n)
        Force per volume [N m-3]; is added to.
    """

    thickness: np.ndarray
    cross_term: np.ndarray
    mean: np.ndarray
    force: np.ndarray


def sum_over_other_phase(
    one: Cells, other: Cells, given: CrossPhaseInput, sums: CrossPhaseSums, threads: int = 1
) -> None:
    """Sum each of two phases over the other.

    Parameters
    ----------
    one, other : Cells
        Cells of the phases, made by `cells.cells_of_phase` of the same cells.
    given : CrossPhaseInput
        State of the particles of both phases.
    sums : CrossPhaseSums
        Written, the force added to, for particles below its size, where cells are awake.
    threads : int
        Number of threads.

    Notes
    -----
    f_i = - sum_j V_j [s_i grad W(l_i) + s_j grad W(l_j)]: V_i f_i and V_j f_j are equal and opposite.
    """
    packed = empty_packed(given.volume.size, 4, quantum_of(one))
    plain, found = (tuple(given.position), *given[1:]), tuple(sums)  # plain tuples: see core/structs.py
    _pack(plain, packed)
    for targets, sources in ((one, other), (other, one)):
        groups = group(targets)
        count, given_places = groups.first.size, (targets.order, targets.sorted)
        in_ranges(_sum, count, threads, tuple(groups), *given_places, tuple(sources), packed, found)


@kernel
def _pack(given, packed):
    """Write the state of particles in 32 bits; lengths become numbers of quanta.

    Parameters
    ----------
    given : CrossPhaseInput
        State of the particles of both phases.
    packed : Packed
        Written, four values of each particle.
    """
    position, volume, length, coefficient, averaged = given
    x, y, z = position
    places, values, quantum = packed
    per_metre, x0, y0, z0 = 1.0 / quantum, x[0], y[0], z[0]
    for i in range(volume.size):
        places[_X, i] = pack_place(x[i] - x0, per_metre)
        places[_Y, i] = pack_place(y[i] - y0, per_metre)
        places[_Z, i] = pack_place(z[i] - z0, per_metre)
        inverse = 1.0 / length[i]
        inverse2 = inverse * inverse
        values[_INVERSE, i], values[_VOLUME, i], values[_AVERAGED, i] = 0.5 * quantum * inverse, volume[i], averaged[i]
        values[_PUSH, i] = volume[i] * (5.0 * NORM) * inverse2 * inverse2 * coefficient[i]


@approximate_kernel
def _sum(first, last, groups, order, sorted_places, sources, packed, sums):
    """Sum over the other phase for the particles of groups ``first`` to ``last`` - 1.

    Parameters
    ----------
    first, last : int
    groups : Groups
        Groups of the phase that is summed for.
    order : ndarray of int, shape (m,)
        Particle of this phase at each sorted place, of the n particles.
    sorted_places : ndarray, shape (3, m + LANES)
        x, y and support at each of these places [m].
    sources : Cells
        Cells of the other phase.
    packed : Packed
        Values of all particles, by `_pack`.
    sums : CrossPhaseSums
        Written, the force added to.
    """
    starts, ends, _, _ = groups
    places, values, quantum = packed
    thickness, cross_term, mean, force = sums
    near, target = np.empty(places.shape[1] + LANES, np.uint32), lane_places()
    x, y, z = lane_places(), lane_places(), lane_places()
    inverse, push, volume = lane_floats(), lane_floats(), lane_floats()
    total, change, averaged = lane_floats(), lane_floats(), lane_floats()
    ax, ay, az = lane_floats(), lane_floats(), lane_floats()
    per_quantum = _TWO / _F(quantum)
    for g in range(first, last):
        m = find_candidates(g, groups, sorted_places, sources, near)
        begin, end = _U64(starts[g]), _U64(ends[g])
        for lane in range(_LANES):
            target[lane] = order[min(begin + lane, end - _U64(1))]  # lanes to spare repeat the last particle
        for lane in range(_LANES):
            i = _U64(target[lane])
            x[lane], y[lane], z[lane] = places[_X, i], places[_Y, i], places[_Z, i]
            inverse[lane], volume[lane] = values[_INVERSE, i], values[_VOLUME, i]
            push[lane] = values[_PUSH, i] / values[_VOLUME, i]
        for lane in range(LANES):
            total[lane] = change[lane] = averaged[lane] = ax[lane] = ay[lane] = az[lane] = _ZERO
        for s in range(m):
            j = _U64(sources[6][near[s]])
            xj, yj, zj = places[_X, j], places[_Y, j], places[_Z, j]
            inverse_j, push_j = values[_INVERSE, j], values[_PUSH, j]
            volume_j, averaged_j = values[_VOLUME, j], values[_AVERAGED, j]
            for lane in range(LANES):
                dx, dy, dz = _F(np.int32(x[lane] - xj)), _F(np.int32(y[lane] - yj)), _F(np.int32(z[lane] - zj))
                r2 = dx * dx + dy * dy + dz * dz + _TINY
                r = r2 * (_ONE / np.sqrt(r2))
                q = r * inverse[lane]
                t, tj = max(_ZERO, _ONE - q), max(_ZERO, _ONE - r * inverse_j)
                pull = volume_j * t * t * t
                weight = pull * t * (_FIVE - _FOUR * t)
                total[lane] += weight
                change[lane] += pull * q * q
                averaged[lane] += weight * averaged_j
                force_of_pair = pull * push[lane] + tj * tj * tj * push_j
                ax[lane] += force_of_pair * dx
                ay[lane] += force_of_pair * dy
                az[lane] += force_of_pair * dz
        for lane in range(end - begin):
            i = _U64(target[lane])
            if i >= _U64(thickness.size):
                continue
            force[0, i] += ax[lane] * quantum
            force[1, i] += ay[lane] * quantum
            force[2, i] += az[lane] * quantum
            per_metre = inverse[lane] * per_quantum
            thickness[i] = total[lane] * _NORM * per_metre * per_metre
            cross_term[i] = (_TEN * change[lane] - total[lane]) * _SLOPE / volume[lane]
            mean[i] = averaged[lane] / total[lane] if total[lane] > _ZERO else _ZERO
