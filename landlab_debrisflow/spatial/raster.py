"""The raster of nodes: their statuses, their spacing, and the node nearest to a point.

Coordinates start at the lower left node, and nodes are numbered row by row from there.
"""

from typing import NamedTuple

import numpy as np

from ..core.jit import inner

CORE, FIXED_VALUE, FIXED_GRADIENT, LOOPED, CLOSED = range(5)
"""Node statuses as Landlab numbers them: only core nodes hold material, and closed ones are walls."""


BLOCK = 8
"""Nodes along the side of a block, for which the walls near it are noted."""


class Raster(NamedTuple):
    """A raster of nodes as kernels read it.

    Attributes
    ----------
    status : ndarray of uint8, shape (nodes,)
        CORE, CLOSED, or an open boundary.
    columns : int
        Nodes in a row.
    rows : int
        Number of rows.
    dx : float
        Node spacing in x [m].
    dy : float
        Node spacing in y [m].
    walled : ndarray of bool, shape (blocks,)
        Blocks of `BLOCK` x `BLOCK` nodes, row by row, that hold a closed node or touch a block which does: from a node
        of any other block a closed one is more than `BLOCK` nodes away.
    """

    status: np.ndarray
    columns: int
    rows: int
    dx: float
    dy: float
    walled: np.ndarray

    @classmethod
    def from_status(cls, status, spacing) -> "Raster":
        """Return the raster of node statuses, shape (rows, columns), with a spacing (dx, dy) [m].

        Examples
        --------
        >>> raster = Raster.from_status([[4, 4, 4, 4], [4, 0, 0, 4], [4, 4, 4, 4]], (2.0, 5.0))
        >>> raster.nearest(np.array([1.9, 3.1]), np.array([4.0, 7.0]))
        array([5, 6])
        """
        status = np.asarray(status, np.uint8)
        rows, columns = status.shape
        return cls(
            status=status.reshape(-1), columns=columns, rows=rows, dx=float(spacing[0]), dy=float(spacing[1]),
            walled=_walled_blocks(status),
        )  # fmt: skip

    @property
    def core(self):
        """Nodes that may hold material, ndarray of bool, shape (nodes,)."""
        return self.status == CORE

    @property
    def area(self) -> float:
        """Map area of a node [m2]."""
        return self.dx * self.dy

    @property
    def spacing(self) -> float:
        """Smaller one of the node spacings in x and y [m]."""
        return min(self.dx, self.dy)

    def nearest(self, x, y):
        """Return the nodes nearest to points x, y from the lower left node, each (n,) [m]; int, shape (n,)."""
        return nearest_line(y, self.dy).astype(int) * self.columns + nearest_line(x, self.dx).astype(int)


def _walled_blocks(status):
    """Return the blocks with a closed node in them or in a block that they touch, bool, shape (blocks,).

    `status` are node statuses, shape (rows, columns), of type uint8.
    """
    rows, columns = (-(-size // BLOCK) for size in status.shape)
    closed = status == CLOSED
    if not closed.any():
        return np.zeros(rows * columns, bool)
    padded = np.zeros((rows * BLOCK, columns * BLOCK), bool)
    padded[: closed.shape[0], : closed.shape[1]] = closed
    # the flags of eight nodes side by side are one integer of eight bytes
    blocks = np.pad((padded.view(np.uint64) != 0).reshape(rows, BLOCK, columns).any(axis=1), 1)
    near = blocks[:-2] | blocks[1:-1] | blocks[2:]
    return (near[:, :-2] | near[:, 1:-1] | near[:, 2:]).reshape(-1)


@inner
def is_walled(row, column, walled, columns):
    """Return whether a closed node may lie within `BLOCK` nodes of a node.

    `row` and `column` are those of the node, `walled` and `columns` those of a `Raster`.
    """
    return walled[row // BLOCK * ((columns + BLOCK - 1) // BLOCK) + column // BLOCK]


@inner
def nearest_line(coordinate, spacing):
    """Return the number of the row or column nearest to a coordinate [m], as a float, also beyond the edge."""
    return np.floor(coordinate / spacing + 0.5)


@inner
def nearest_place(coordinate, spacing, count):
    """Return which of `count` rows or columns of nodes is nearest to a coordinate [m]."""
    return min(max(int(nearest_line(coordinate, spacing)), 0), count - 1)


@inner
def nearest_node(x, y, dx, dy, columns, rows):
    """Return the node nearest to a point [m], or -1 if a coordinate is not a number.

    `x`, `y` are floats from the lower left node, `dx`, `dy` node spacings [m]; `columns` and `rows` are the shape of
    the raster.
    """
    if not (abs(x) < np.inf and abs(y) < np.inf):  # not isfinite(), which reordering breaks (core/jit.py)
        return -1
    return nearest_place(y, dy, rows) * columns + nearest_place(x, dx, columns)
