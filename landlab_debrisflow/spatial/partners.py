"""Partners: the particles of the other phase with which a particle exchanges momentum, and their weights."""

from typing import NamedTuple

import numpy as np

from ..core.jit import kernel
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

    Attributes
    ----------
    of : ndarray of int, shape (m,)
        Particles that have partners.
    count : ndarray of int, shape (m,)
        Number of partners of each.
    index : ndarray of int, shape (m, MOST_PARTNERS)
        Partners of each; places from `count` on are not used.
    weight : ndarray, shape (m, MOST_PARTNERS)
        Weights of the partners, which sum to 1 [-].
    """

    of: np.ndarray
    count: np.ndarray
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
    grains = targets.order[targets.order < position.x.size]
    partners = Partners(
        of=grains,
        count=np.zeros(grains.size, np.int64),
        index=np.empty((grains.size, MOST_PARTNERS), np.int64),
        weight=np.empty((grains.size, MOST_PARTNERS)),
    )
    _find(tuple(targets), tuple(sources), tuple(position), volume, smoothing_length, tuple(partners))
    return partners


@kernel
def _find(targets, sources, position, volume, length, partners):
    """Write index, weight and count of the partners.

    Parameters
    ----------
    targets, sources : Cells
        Cell lists of the two phases.
    position : Position
        Position of the particles [m].
    volume, length : ndarray, shape (n,)
        Volume [m3] and smoothing length [m].
    partners : Partners
        Written, except ``of``, which is in the order of the targets.
    """
    columns, rows, size, west, south, _, order, start, _, _, _, _, _ = targets
    _, _, _, _, _, _, source_order, source_start, _, _, _, _, _ = sources
    x, y, z = position
    _, count, index, weight = partners
    n, row_of = x.size, 0
    for cell in range(start.size - 1):
        if start[cell] == start[cell + 1]:
            continue
        for k in range(start[cell], start[cell + 1]):
            i = order[k]
            if i >= n:
                continue
            radius, found, total = PARTNER_RADIUS * length[i], 0, 0.0
            nearest = (NEAREST * radius) ** 2
            low_row, high_row = int((y[i] - radius - south) / size), int((y[i] + radius - south) / size)
            low, high = int((x[i] - radius - west) / size), int((x[i] + radius - west) / size)
            for r in range(max(low_row, 0), min(high_row, rows - 1) + 1):
                for d in range(r * columns + max(low, 0), r * columns + min(high, columns - 1) + 1):
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
