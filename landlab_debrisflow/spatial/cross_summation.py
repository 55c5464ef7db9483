"""SPH sums of the particles of one phase over those of another, and partners with whom they exchange momentum.

The same smoothing kernel, smoothing lengths and layout as in `summation`, which has the formulas and the reasons. A
phase is a part of the particles, in the cells of all of them.
"""

from typing import NamedTuple

import numpy as np

from ..core.jit import approximate_kernel, kernel
from .cells import Cells, over_cells
from .summation import LANES, NORM, PLACES_PER_CELL, SLOPE, copy_neighbourhood

MOST_PARTNERS = 32
"""Room for the partners of a particle; there are some 6, and the rest counts for those beyond."""

PARTNER_RADIUS = 1.0
"""Distance to the farthest partner over smoothing length [-]."""

NEAREST = 0.1
"""Distance over that of the farthest within which all partners count alike. The weights are those of Franke & Nielson
(1980), ((R - r)/(R r))^2, but finite: most of all counts who is nearest. A mean over all around lies behind where the
velocity grows towards an edge, as it does at every front, and would hold grains back there, and push water ahead."""

_X, _Y, _Z = 0, 1, 2
_INVERSE, _REACH, _STRENGTH, _VOLUME, _CARRIED = range(5)

# numba computes in double where a constant is one
_F = np.float32
_ZERO, _ONE, _FOUR, _TINY = _F(0.0), _F(1.0), _F(4.0), _F(1e-12)


class Crossing(NamedTuple):
    """What the sums across read of all n particles, of whatever phase."""

    x: np.ndarray  # position on the surface, (n,) [m]
    y: np.ndarray
    z: np.ndarray
    volume: np.ndarray  # (n,) [m3]
    smoothing_length: np.ndarray  # (n,) [m]
    strength: np.ndarray  # (n,) thrust of what both phases share over total thickness^2 [N m-3]
    carried: np.ndarray  # (n,) any quantity to be averaged


class Across(NamedTuple):
    """What they write, where cells are awake."""

    thickness: np.ndarray  # (n,) of the other phase [m]
    cross_term: np.ndarray  # (n,) l/(2 own thickness) d(thickness of the other phase)/dl [-]
    mean: np.ndarray  # (n,) of the quantity that the other phase carries; 0 where there is none
    force: np.ndarray  # (3, n) per volume [N m-3], added to


def cells_of(cells: Cells, belongs) -> Cells:
    """Return the cells with some of the particles only.

    Parameters
    ----------
    cells : Cells
    belongs : ndarray of bool, shape (n,)
    """
    here = belongs[cells.order]
    before = np.concatenate([[0], np.cumsum(here)])
    return cells._replace(order=cells.order[here], start=before[cells.start])


def sum_across(one: Cells, other: Cells, crossing: Crossing, out: Across, threads: int = 1) -> None:
    """Sum each of two phases over the other.

    Parameters
    ----------
    one, other : Cells
        Of the phases, made by `cells_of` of the same cells.
    crossing : Crossing
    out : Across
        Written, the force added to, for particles below its size, where cells are awake.
    threads : int

    Notes
    -----
    f_i = - sum_j V_j [s_i grad W(l_i) + s_j grad W(l_j)]: V_i f_i and V_j f_j are equal and opposite.
    """
    quantum, packed = one.size / PLACES_PER_CELL, []
    for cells in (one, other):
        room = cells.order.size + LANES
        packed.append((np.empty((3, room), np.int32), np.empty((5, room), np.float32)))
        _pack(cells.order, *crossing, quantum, *packed[-1])
    for targets, sources, to, of in ((one, other, *packed), (other, one, *packed[::-1])):
        over_cells(
            _sum, targets, threads, targets.columns, targets.order, targets.start, sources.start, targets.reach,
            targets.box, targets.window, targets.awake, *to, *of, quantum, *out,
        )  # fmt: skip


@kernel
def _pack(order, x, y, z, volume, length, strength, carried, quantum, places, packed):
    """Put particles in the order of cells; lengths become numbers of quanta."""
    per_metre, x0, y0, z0 = 1.0 / quantum, x[0], y[0], z[0]
    for k in range(order.size):
        i = order[k]
        places[_X, k] = np.int32(np.int64((x[i] - x0) * per_metre))
        places[_Y, k] = np.int32(np.int64((y[i] - y0) * per_metre))
        places[_Z, k] = np.int32(np.int64((z[i] - z0) * per_metre))
        l2 = length[i] * length[i]
        packed[_INVERSE, k] = 0.5 * quantum / length[i]
        packed[_REACH, k] = volume[i] * (5.0 * NORM) / (l2 * l2)
        packed[_STRENGTH, k], packed[_VOLUME, k], packed[_CARRIED, k] = strength[i], volume[i], carried[i]


@approximate_kernel
def _sum(
    first, last, columns, order, start, source_start, reach, box, window, awake, places, packed, source_places,
    source_packed, quantum, thickness, cross_term, mean, force,
):  # fmt: skip
    room = source_places.shape[1] + LANES
    where, what = np.empty((3, room), np.int32), np.empty((5, room), np.float32)
    for cell in range(first, last):
        if start[cell] == start[cell + 1] or not awake[cell]:
            continue
        m = copy_neighbourhood(
            cell, columns, source_start, reach, box, window, source_places, source_packed, where, what
        )
        for k in range(start[cell], start[cell + 1]):
            i = order[k]
            if i >= thickness.size:
                continue
            xi, yi, zi = places[_X, k], places[_Y, k], places[_Z, k]
            inverse, si = packed[_INVERSE, k], packed[_STRENGTH, k]
            own = packed[_REACH, k] / packed[_VOLUME, k]
            total, change, carried, ax, ay, az = _ZERO, _ZERO, _ZERO, _ZERO, _ZERO, _ZERO
            for j in range(m):
                dx = _F(np.int32(xi - where[_X, j]))
                dy = _F(np.int32(yi - where[_Y, j]))
                dz = _F(np.int32(zi - where[_Z, j]))
                r2 = dx * dx + dy * dy + dz * dz + _TINY
                r = r2 * (_ONE / np.sqrt(r2))
                q = r * inverse
                ti, tj = max(_ZERO, _ONE - q), max(_ZERO, _ONE - r * what[_INVERSE, j])
                pull = what[_VOLUME, j] * ti * ti * ti
                weight = pull * ti * (_ONE + _FOUR * q)
                total += weight
                change += pull * q * q
                carried += weight * what[_CARRIED, j]
                push = pull * own * si + what[_REACH, j] * tj * tj * tj * what[_STRENGTH, j]
                ax += push * dx
                ay += push * dy
                az += push * dz
            force[0, i] += ax * quantum
            force[1, i] += ay * quantum
            force[2, i] += az * quantum
            # own = 5 norm / l^4
            thickness[i] = total * np.sqrt(own * (NORM / 5.0))
            cross_term[i] = (10.0 * change - total) * SLOPE / packed[_VOLUME, k]
            mean[i] = carried / total if total > _ZERO else _ZERO


class Partners(NamedTuple):
    """With which particles of the other phase each particle of one exchanges momentum, and in which parts."""

    of: np.ndarray  # (m,) those that have partners
    count: np.ndarray  # (m,) how many
    index: np.ndarray  # (m, MOST_PARTNERS) which
    weight: np.ndarray  # (m, MOST_PARTNERS) their parts, which sum to 1 [-]


def find_partners(targets: Cells, sources: Cells, x, y, z, volume, smoothing_length) -> Partners:
    """Find the partners of some particles among others.

    Parameters
    ----------
    targets, sources : Cells
        As in `sum_across`.
    x, y, z, volume, smoothing_length : ndarray, shape (n,)
        Of particles that have and may be partners [m, m3]; the cells may have more behind them.
    """
    n = x.size
    of = targets.order[targets.order < n]
    partners = Partners(
        of, np.zeros(of.size, np.int64), np.empty((of.size, MOST_PARTNERS), np.int64),
        np.empty((of.size, MOST_PARTNERS)),
    )  # fmt: skip
    _find(
        n, targets.columns, targets.order, targets.start, sources.order, sources.start, targets.box, targets.window,
        x, y, z, volume, smoothing_length, *partners[1:],
    )  # fmt: skip
    return partners


@kernel
def _find(
    n, columns, order, start, source_order, source_start, box, window, x, y, z, volume, length, count, index, weight
):  # fmt: skip
    rows, row_of = (start.size - 1) // columns, 0
    for cell in range(start.size - 1):
        if start[cell] == start[cell + 1]:
            continue
        w = window[cell]
        row, column = cell // columns, cell % columns
        for k in range(start[cell], start[cell + 1]):
            i = order[k]
            if i >= n:
                continue
            radius, found, total = PARTNER_RADIUS * length[i], 0, 0.0
            nearest = (NEAREST * radius) ** 2
            for r in range(max(row - w, 0), min(row + w, rows - 1) + 1):
                for q in range(max(column - w, 0), min(column + w, columns - 1) + 1):
                    d = r * columns + q
                    gap_x = max(box[0, d] - x[i], x[i] - box[1, d], 0.0)
                    gap_y = max(box[2, d] - y[i], y[i] - box[3, d], 0.0)
                    if gap_x * gap_x + gap_y * gap_y > radius * radius:
                        continue
                    for s in range(source_start[d], source_start[d + 1]):
                        j = source_order[s]
                        if j >= n:
                            continue
                        r2 = (x[i] - x[j]) ** 2 + (y[i] - y[j]) ** 2 + (z[i] - z[j]) ** 2
                        if r2 < radius * radius and found < MOST_PARTNERS:
                            index[row_of, found] = j
                            weight[row_of, found] = volume[j] * (1.0 - np.sqrt(r2) / radius) ** 2 / (r2 + nearest)
                            total += weight[row_of, found]
                            found += 1
            for s in range(found):
                weight[row_of, s] /= total
            count[row_of] = found
            row_of += 1
