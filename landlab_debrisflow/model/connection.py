"""Bodies of a flow: particles connected through neighbours."""

from typing import NamedTuple

import numpy as np

from ..core.jit import inner, kernel
from ..spatial.cells import sort_into_cells


class Spheres(NamedTuple):
    """Neighbourhoods of n particles: position x, y, z and the radius within which each has neighbours [m]."""

    x: np.ndarray  # (n,) position [m]
    y: np.ndarray  # (n,) [m]
    z: np.ndarray  # (n,) [m]
    support: np.ndarray  # (n,) radius within which a particle acts on others [m]


def find_bodies(x, y, z, support):
    """Return the number of the body of every particle; two neighbours belong to one body.

    Parameters
    ----------
    x, y, z, support : ndarray, shape (n,)
        Position, and the radius within which a particle has neighbours [m].

    Returns
    -------
    ndarray of int, shape (n,)

    Examples
    --------
    >>> find_bodies(np.array([0.0, 1.0, 9.0]), np.zeros(3), np.zeros(3), np.array([0.5, 2.0, 2.0]))
    array([0, 0, 1])
    """
    cells = sort_into_cells(x, y, support)
    parent = np.arange(x.size)
    spheres = Spheres(x=x, y=y, z=z, support=support)
    window = np.ceil(cells.reach / cells.size).astype(int)
    _join(spheres, cells.columns, cells.order, cells.start, window, parent, np.zeros(window.size, np.bool_))
    return np.unique(parent, return_inverse=True)[1]


@inner
def _root(parent, i):
    """Return the particle that stands for the body of particle `i`; shorten the chain of parents to it."""
    while parent[i] != i:
        parent[i] = parent[parent[i]]
        i = parent[i]
    return i


@inner
def _join_cells(spheres, order, one, other, parent):
    """Join neighbours in two cells; return whether all particles of the first cell are then of one body.

    A cell is the first place and the one after the last in `order`, int, shape (n,); `parent`, int, shape (n,), leads
    from each particle to the one that stands for its body; `spheres` are the `Spheres` of the n particles.
    """
    x, y, z, support = spheres
    first, last = one
    for k in range(first, last):
        i = order[k]
        root = _root(parent, i)
        for s in range(other[0], other[1]):
            j = order[s]
            if parent[j] == root:
                continue
            reach = max(support[i], support[j])
            if (x[i] - x[j]) ** 2 + (y[i] - y[j]) ** 2 + (z[i] - z[j]) ** 2 < reach * reach:
                met = _root(parent, j)
                parent[max(met, root)] = min(met, root)
                root = min(met, root)
    root, whole = _root(parent, order[first]), True
    for k in range(first + 1, last):
        whole &= _root(parent, order[k]) == root
    return whole


@kernel
def _join(spheres, columns, order, start, window, parent, whole):
    """Join neighbours to bodies: write for each particle the one that stands for its body.

    Parameters
    ----------
    spheres : Spheres
    columns, order, start
        As in `spatial.cells.Cells`.
    window : ndarray of int, shape (cells,)
        Number of cells in x and in y within which neighbours may lie.
    parent : ndarray of int, shape (n,)
        Each particle itself, on entry.
    whole : ndarray of bool, shape (cells,)
        Whether all particles of a cell are known to be of one body; false on entry.
    """
    for cell in range(start.size - 1):
        row, column, w = cell // columns, cell % columns, window[cell]
        here = start[cell], start[cell + 1]
        if here[0] == here[1]:
            continue
        for r in range(row, max(row - w, 0) - 1, -1):
            for q in range(min(column + w, columns - 1), max(column - w, 0) - 1, -1):  # the cell itself comes first
                other = r * columns + q
                if other > cell or start[other] == start[other + 1]:  # every pair of particles is examined once
                    continue
                first, second = order[here[0]], order[start[other]]
                if whole[cell] and whole[other] and _root(parent, first) == _root(parent, second):
                    continue
                whole[cell] = _join_cells(spheres, order, here, (start[other], start[other + 1]), parent)
    for i in range(parent.size):
        parent[i] = _root(parent, i)
