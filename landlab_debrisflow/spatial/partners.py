"""Partners: the particles of the other phase with which a particle exchanges momentum, and their weights."""

from typing import NamedTuple

import numpy as np

from ..core.jit import allocating_kernel
from .cells import Cells
from .packing import Position

MOST_PARTNERS = 32
"""Largest number of partners of a particle; it mostly has about 6, and partners beyond the largest number are left
out."""

PARTNER_RADIUS = 1.0
"""Distance to the farthest partner over smoothing length [-]."""

NEAREST = 0.1
"""Distance over that of the farthest partner within which all partners have equal weights. The weights are those of
Franke & Nielson (1980), ((R - r)/(R r))^2, made finite: the nearest partner counts most. An even mean over all
particles around would be biased at every front, where the velocity grows towards the edge: it would hold grains back
and push water ahead."""


class Partners(NamedTuple):
    """Partners of the other phase with which each particle of one phase exchanges momentum, and their weights.

    The pairs of all particles stand one after the other, those of particle ``of[k]`` at ``first[k]:first[k + 1]``.

    Attributes
    ----------
    of : ndarray of int, shape (m,)
        Particles that have partners.
    first : ndarray of int, shape (m + 1,)
        First pair of each, and the number of pairs.
    index : ndarray of int32, shape (pairs,)
        Partner of each pair: a particle, or of `reverse` its place in ``of``.
    weight : ndarray, shape (pairs,)
        Weight of each pair; as found those of a particle sum to 1 [-].
    """

    of: np.ndarray
    first: np.ndarray
    index: np.ndarray
    weight: np.ndarray


def find_partners(targets: Cells, sources: Cells, position: Position, volume, smoothing_length) -> Partners:
    """Find the partners of the particles of one phase among the other phase.

    Parameters
    ----------
    targets, sources : Cells
        Cells of the two phases, made by `cells.cells_of_phase` of the same cells.
    position : Position
        Position of the n particles that have, or may be, partners; the cells may hold further particles.
    volume, smoothing_length : ndarray, shape (n,)
        [m3], [m]
    """
    grains = np.sort(targets.order[targets.order < position.x.size])
    first = np.zeros(grains.size + 1, np.int64)
    index, weight = np.empty(grains.size * MOST_PARTNERS, np.int32), np.empty(grains.size * MOST_PARTNERS)
    found = Partners(of=grains, first=first, index=index, weight=weight)
    _find(tuple(targets), tuple(sources), tuple(position), volume, smoothing_length, tuple(found))
    return found._replace(index=index[: first[-1]].copy(), weight=weight[: first[-1]].copy())


def reverse(partners: Partners, others) -> Partners:
    """Return the pairs of `partners` sorted by the partner, as the `Partners` of the other phase.

    Parameters
    ----------
    partners : Partners
        Partners of m particles.
    others : ndarray of int, shape (l,)
        Particles that are, or may be, partners.

    Returns
    -------
    Partners
        Of `others`; the index of a pair is a place in ``partners.of``, and rises from pair to pair of a particle.
    """
    pairs = partners.index.size
    found = Partners(
        of=others, first=np.zeros(others.size + 1, np.int64), index=np.empty(pairs, np.int32), weight=np.empty(pairs)
    )
    _reverse(tuple(partners), tuple(found))
    return found


@allocating_kernel
def _find(targets, sources, position, volume, length, partners):
    """Write the pairs of all particles of the targets.

    Parameters
    ----------
    targets, sources : Cells
        Cell lists of the two phases.
    position : Position
        Position of the particles [m].
    volume, length : ndarray, shape (n,)
        Volume [m3] and smoothing length [m].
    partners : Partners
        Written, except ``of``; has room for `MOST_PARTNERS` pairs of each.
    """
    columns, rows, size, west, south, _, _, _, _, _, _, _, _ = targets
    _, _, _, _, _, _, source_order, source_start, _, _, _, _, _ = sources
    x, y, z = position
    of, first, index, weight = partners
    n, pair = x.size, 0
    packed = np.empty((4, source_order.size))
    for s in range(source_order.size):
        j = source_order[s]
        # a source without a place among the particles is out of reach
        packed[0, s] = x[j] if j < n else np.inf
        if j < n:
            packed[1, s], packed[2, s], packed[3, s] = y[j], z[j], volume[j]
    # squared distances of the sources in the cells around, then of those in reach; and their places in the cells
    distance2, near2 = np.empty(source_order.size), np.empty(source_order.size + 1)
    near = np.empty(source_order.size + 1, np.int32)
    for k in range(of.size):
        i, count = of[k], 0
        radius, px, py, pz = PARTNER_RADIUS * length[i], x[i], y[i], z[i]
        radius2, nearest, total = radius * radius, (NEAREST * radius) ** 2, 0.0
        low_row, high_row = int((py - radius - south) / size), int((py + radius - south) / size)
        low, high = int((px - radius - west) / size), int((px + radius - west) / size)
        low, high = max(low, 0), min(high, columns - 1)
        for r in range(max(low_row, 0), min(high_row, rows - 1) + 1):
            begin, end = source_start[r * columns + low], source_start[r * columns + high + 1]
            at_x, at_y, at_z = packed[0, begin:end], packed[1, begin:end], packed[2, begin:end]
            for s in range(at_x.size):
                dx, dy, dz = px - at_x[s], py - at_y[s], pz - at_z[s]
                distance2[s] = dx * dx + dy * dy + dz * dz
            for s in range(at_x.size):
                near[count], near2[count] = begin + s, distance2[s]
                count += distance2[s] < radius2
        count = min(count, MOST_PARTNERS)
        for s in range(count):
            index[pair + s] = source_order[near[s]]
            closeness, r2 = 1.0 - np.sqrt(near2[s]) / radius, near2[s]
            weight[pair + s] = packed[3, near[s]] * closeness * closeness / (r2 + nearest)
            total += weight[pair + s]
        for s in range(pair, pair + count):
            weight[s] /= total
        pair += count
        first[k + 1] = pair


@allocating_kernel
def _reverse(partners, reversed_partners):
    """Write the pairs of `partners` sorted by the partner, and for one partner in the order of `partners`.

    `reversed_partners` are the `Partners` with room for all pairs, written except ``of``.
    """
    of, first, index, weight = partners
    others, first_of, index_of, weight_of = reversed_partners
    last = 0
    for k in range(others.size):
        last = max(last, others[k])
    place = np.full(last + 1, -1, np.int32)
    for k in range(others.size):
        place[others[k]] = k
    for s in range(index.size):
        first_of[place[index[s]] + 1] += 1
    for k in range(others.size):
        first_of[k + 1] += first_of[k]
    following = first_of.copy()
    for k in range(of.size):
        for s in range(first[k], first[k + 1]):
            other = place[index[s]]
            index_of[following[other]], weight_of[following[other]] = k, weight[s]
            following[other] += 1
