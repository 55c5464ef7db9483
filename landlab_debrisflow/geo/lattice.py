"""Geometry of a raster of nodes on the map."""

from typing import NamedTuple

import numpy as np


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
    def bounds(self) -> tuple[float, float, float, float]:
        """West, south, east, north of the cells around the nodes [m]."""
        dx, dy = self.spacing
        west, south = self.lower_left[0] - 0.5 * dx, self.lower_left[1] - 0.5 * dy
        return west, south, west + self.shape[1] * dx, south + self.shape[0] * dy

    @property
    def area(self) -> float:
        """Map area of a node [m2]."""
        return self.spacing[0] * self.spacing[1]
