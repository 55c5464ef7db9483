"""SPH sums of the particles of one phase over the particles of the other.

Smoothing kernel, smoothing lengths and layout are those of `summation`, where the formulas and their reasons stand. A
phase is a subset of the particles, in the cells of all of them.
"""

from typing import NamedTuple

import numpy as np

from ..core.jit import approximate_kernel, kernel
from .cells import Cells, over_cells
from .packing import LANES, Position, copy_neighbourhood, empty_packed
from .summation import NORM, SLOPE

_X, _Y, _Z = 0, 1, 2
_INVERSE, _REACH, _COEFFICIENT, _VOLUME, _AVERAGED = range(5)

# a constant in double precision would make numba compute in double
_F = np.float32
_ZERO, _ONE, _FOUR, _TINY = _F(0.0), _F(1.0), _F(4.0), _F(1e-12)


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


def cells_of_phase(cells: Cells, in_phase) -> Cells:
    """Return the cells with the particles of one phase only.

    Parameters
    ----------
    cells : Cells
        Cell list over the particles.
    in_phase : ndarray of bool, shape (n,)
        Whether each particle is of the phase.
    """
    here = in_phase[cells.order]
    before = np.concatenate([[0], np.cumsum(here)])
    return cells._replace(order=cells.order[here], start=before[cells.start])


def sum_over_other_phase(
    one: Cells, other: Cells, given: CrossPhaseInput, sums: CrossPhaseSums, threads: int = 1
) -> None:
    """Sum each of two phases over the other.

    Parameters
    ----------
    one, other : Cells
        Cells of the phases, made by `cells_of_phase` of the same cells.
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
    packed_one, packed_other = empty_packed(one, values=5), empty_packed(other, values=5)
    # kernels are called faster with plain tuples (core/structs.py)
    plain, found = (tuple(given.position), *given[1:]), tuple(sums)
    _pack(one.order, plain, packed_one)
    _pack(other.order, plain, packed_other)
    over_cells(_sum, one, threads, tuple(one), tuple(other), packed_one, packed_other, found)
    over_cells(_sum, other, threads, tuple(other), tuple(one), packed_other, packed_one, found)


@kernel
def _pack(order, given, packed):
    """Put particles in the order of cells; lengths become numbers of quanta.

    Parameters
    ----------
    order : ndarray of int, shape (m,)
        Particle at each sorted place, of the n of `given`.
    given : CrossPhaseInput
        State of the particles of both phases.
    packed : Packed
        Written, five values of each particle.
    """
    position, volume, length, coefficient, averaged = given
    x, y, z = position
    places, values, quantum = packed
    per_metre, x0, y0, z0 = 1.0 / quantum, x[0], y[0], z[0]
    for k in range(order.size):
        i = order[k]
        places[_X, k] = np.int32(np.int64((x[i] - x0) * per_metre))
        places[_Y, k] = np.int32(np.int64((y[i] - y0) * per_metre))
        places[_Z, k] = np.int32(np.int64((z[i] - z0) * per_metre))
        l2 = length[i] * length[i]
        values[_INVERSE, k] = 0.5 * quantum / length[i]
        values[_REACH, k] = volume[i] * (5.0 * NORM) / (l2 * l2)
        values[_COEFFICIENT, k], values[_VOLUME, k], values[_AVERAGED, k] = coefficient[i], volume[i], averaged[i]


@approximate_kernel
def _sum(first, last, targets, sources, packed, packed_sources, sums):
    """Sum over the other phase for the particles of cells ``first`` to ``last`` - 1 that are awake.

    Parameters
    ----------
    first, last : int
    targets, sources : Cells
        Cells of the phase that is summed for, and of the other.
    packed, packed_sources : Packed
        Both phases, by `_pack`.
    sums : CrossPhaseSums
        Written, the force added to.
    """
    _, _, order, start, _, _, _, awake, _ = targets
    places, values, quantum = packed
    thickness, cross_term, mean, force = sums
    room = packed_sources[0].shape[1] + LANES
    near_places, near = np.empty((3, room), np.int32), np.empty((5, room), np.float32)
    scratch = near_places, near, quantum
    for cell in range(first, last):
        if start[cell] == start[cell + 1] or not awake[cell]:
            continue
        m = copy_neighbourhood(cell, sources, packed_sources, scratch)
        for k in range(start[cell], start[cell + 1]):
            i = order[k]
            if i >= thickness.size:
                continue
            xi, yi, zi = places[_X, k], places[_Y, k], places[_Z, k]
            inverse, si = values[_INVERSE, k], values[_COEFFICIENT, k]
            own = values[_REACH, k] / values[_VOLUME, k]
            total, change, averaged, ax, ay, az = _ZERO, _ZERO, _ZERO, _ZERO, _ZERO, _ZERO
            for j in range(m):
                dx = _F(np.int32(xi - near_places[_X, j]))
                dy = _F(np.int32(yi - near_places[_Y, j]))
                dz = _F(np.int32(zi - near_places[_Z, j]))
                r2 = dx * dx + dy * dy + dz * dz + _TINY
                r = r2 * (_ONE / np.sqrt(r2))
                q = r * inverse
                ti, tj = max(_ZERO, _ONE - q), max(_ZERO, _ONE - r * near[_INVERSE, j])
                pull = near[_VOLUME, j] * ti * ti * ti
                weight = pull * ti * (_ONE + _FOUR * q)
                total += weight
                change += pull * q * q
                averaged += weight * near[_AVERAGED, j]
                push = pull * own * si + near[_REACH, j] * tj * tj * tj * near[_COEFFICIENT, j]
                ax += push * dx
                ay += push * dy
                az += push * dz
            force[0, i] += ax * quantum
            force[1, i] += ay * quantum
            force[2, i] += az * quantum
            # own = 5 norm / l^4
            thickness[i] = total * np.sqrt(own * (NORM / 5.0))
            cross_term[i] = (10.0 * change - total) * SLOPE / values[_VOLUME, k]
            mean[i] = averaged / total if total > _ZERO else _ZERO
