"""Geometry of a raster of nodes on the map."""

import math
from typing import NamedTuple

import numpy as np

Bounds = tuple[float, float, float, float]

FARTHEST = 1e8
"""Largest coordinate on a map [m]; the equator has 4e7 m, and no projection in metres goes much beyond."""


class Window(NamedTuple):
    """Rectangle of nodes of a lattice.

    Attributes
    ----------
    rows, columns : slice
        From the southern row and the western column, with a start and a stop.
    """

    rows: slice
    columns: slice

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return self.rows.stop - self.rows.start, self.columns.stop - self.columns.start


class Lattice(NamedTuple):
    """Nodes of a raster on the map.

    Arrays over nodes have the shape (rows, columns), their first row is the southern one.

    Attributes
    ----------
    shape : tuple of int
        Rows and columns.
    spacing : tuple of float
        dx, dy [m].
    lower_left : tuple of float
        Map coordinates x, y of the first node, the centre of the south-western cell [m].
    crs : str or None
        Coordinate reference system as WKT, None if it is not known.

    Examples
    --------
    >>> lattice = Lattice((2, 3), (10.0, 10.0), (500000.0, 4100000.0), None)
    >>> lattice.x
    array([500000., 500010., 500020.])
    >>> lattice.bounds
    (499995.0, 4099995.0, 500025.0, 4100015.0)
    """

    shape: tuple[int, int]
    spacing: tuple[float, float]
    lower_left: tuple[float, float]
    crs: str | None = None

    @property
    def x(self) -> np.ndarray:
        """Map coordinates of the columns, shape (columns,) [m]."""
        return self.lower_left[0] + self.spacing[0] * np.arange(self.shape[1])

    @property
    def y(self) -> np.ndarray:
        """Map coordinates of the rows, from south to north, shape (rows,) [m]."""
        return self.lower_left[1] + self.spacing[1] * np.arange(self.shape[0])

    @property
    def bounds(self) -> Bounds:
        """West, south, east, north of the cells around the nodes [m]."""
        dx, dy = self.spacing
        west, south = self.lower_left[0] - 0.5 * dx, self.lower_left[1] - 0.5 * dy
        return west, south, west + self.shape[1] * dx, south + self.shape[0] * dy

    @property
    def area(self) -> float:
        """Map area of a node [m2]."""
        return self.spacing[0] * self.spacing[1]

    @property
    def size(self) -> int:
        """Number of nodes."""
        return self.shape[0] * self.shape[1]

    @property
    def window(self) -> Window:
        """All nodes as a window."""
        return Window(slice(0, self.shape[0]), slice(0, self.shape[1]))

    def window_around(self, bounds: Bounds) -> Window:
        """Return the nodes whose cells touch a rectangle of the map, cut at the edges, perhaps no node.

        Parameters
        ----------
        bounds : tuple of float
            West, south, east, north [m].
        """
        west, south = self.bounds[:2]
        axes = []
        for low, high, origin, step, count in (
            (bounds[1], bounds[3], south, self.spacing[1], self.shape[0]),
            (bounds[0], bounds[2], west, self.spacing[0], self.shape[1]),
        ):
            # a rectangle that ends at the edge of a cell, to rounding, does not touch the next one
            first, last = (low - origin) / step + 1e-6, (high - origin) / step - 1e-6
            start = math.floor(min(max(first, 0.0), count))
            axes.append(slice(start, max(start, math.ceil(max(min(last, count), 0.0)))))
        return Window(*axes)

    def cut(self, window: Window) -> "Lattice":
        """Return the lattice of a window."""
        x0, y0 = self.lower_left
        corner = (x0 + self.spacing[0] * window.columns.start, y0 + self.spacing[1] * window.rows.start)
        return self._replace(shape=window.shape, lower_left=corner)


def extent(bounds: Bounds) -> str:
    """Return a rectangle of the map in words.

    Examples
    --------
    >>> extent((500000.0, 4100000.0, 500100.0, 4100050.5))
    'x 500000 to 500100 m, y 4100000 to 4100050.5 m'
    """
    west, south, east, north = (f"{round(value, 2):.12g}" for value in bounds)
    return f"x {west} to {east} m, y {south} to {north} m"
