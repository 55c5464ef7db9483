"""Crossings of paths and a line."""

from typing import Any

import numpy as np

from .identities import places_of


def crossings(start: np.ndarray, end: np.ndarray, line: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Find where straight paths cross a line.

    Positions count as shifted by (d, d^2) with d -> 0. So no position lies on the line, and every crossing counts
    exactly once, at a vertex, too (simulation of simplicity, Edelsbrunner & Muecke, 1990).

    Parameters
    ----------
    start, end : ndarray, shape (2, n)
        x and y where the paths begin and end [m].
    line : ndarray, shape (m, 2)
        Vertices of the line [m].

    Returns
    -------
    path : ndarray of int, shape (k,)
        Number of the path, once for every crossing.
    fraction : ndarray, shape (k,)
        Part of the path that lies before the crossing [-].
    sign : ndarray, shape (k,)
        1 from right to left as seen along the line, -1 from left to right.

    Examples
    --------
    >>> crossings(np.array([[1.0], [-1.0]]), np.array([[1.0], [3.0]]), np.array([[0.0, 0.0], [2.0, 0.0]]))
    (array([0]), array([0.25]), array([1.]))
    """
    begin, stop = start[:, :, None], end[:, :, None]
    first, last = line[:-1].T[:, None], line[1:].T[:, None]
    along, way = last - first, stop - begin
    shifted = np.where(along[1] == 0.0, along[0], -along[1]) > 0.0  # side of a position on the line
    passed = np.where(way[1] == 0.0, -way[0], way[1]) > 0.0  # side of a vertex on the path
    before, after = _area(first, last, begin), _area(first, last, stop)
    left, arrives = (np.where(area == 0.0, shifted, area > 0.0) for area in (before, after))
    ends = (np.where(area == 0.0, passed, area > 0.0) for area in (_area(begin, stop, v) for v in (first, last)))
    path, segment = np.nonzero((left != arrives) & np.not_equal(*ends))
    before, after = before[path, segment], after[path, segment]
    return path, before / (before - after), np.where(arrives[path, segment], 1.0, -1.0)


def near(low: np.ndarray, high: np.ndarray, line: np.ndarray) -> np.ndarray:
    """Return the numbers of paths whose rectangle has a point in common with that of a line.

    Parameters
    ----------
    low, high : ndarray, shape (2, n)
        South-western and north-eastern corner of the rectangle around each path [m].
    line : ndarray, shape (m, 2)
        Vertices of the line [m].

    Returns
    -------
    ndarray of int
    """
    west, south = line.min(axis=0)
    east, north = line.max(axis=0)
    return np.flatnonzero((low[0] <= east) & (high[0] >= west) & (low[1] <= north) & (high[1] >= south))


def _area(first, last, point):
    """Return twice the area of the triangle of three points, > 0 if the third is to the left of the first two [m2]."""
    along, to = last - first, point - first
    return along[0] * to[1] - along[1] * to[0]


class Paths:
    """Paths of particles between two steps, in whatever order the particles are.

    Attributes
    ----------
    identity : ndarray of int, shape (n,)
        Numbers of the particles after the last step.
    position : ndarray, shape (2, n)
        x and y of the particles after the last step [m].
    """

    def __init__(self) -> None:
        self.identity, self.position = np.empty(0, np.int64), np.empty((2, 0))

    def begin(self, particles: Any) -> None:
        """Note where the particles are."""
        self.identity, self.position = particles.identity.copy(), np.array([particles.x, particles.y])

    def since(self, particles: Any) -> tuple[np.ndarray, np.ndarray]:
        """Return places, (k,), and former positions, (2, k) [m], of the particles that existed after the last step.

        Examples
        --------
        >>> from types import SimpleNamespace
        >>> paths, one = Paths(), np.array([1.0])
        >>> paths.begin(SimpleNamespace(identity=np.array([7, 3]), x=np.array([1.0, 2.0]), y=np.zeros(2)))
        >>> paths.since(SimpleNamespace(identity=np.array([3, 8])))
        (array([0]), array([[2.],
               [0.]]))
        """
        if np.array_equal(particles.identity, self.identity):
            return np.arange(self.identity.size), self.position
        before = places_of(particles.identity, self.identity)
        known = np.flatnonzero(before >= 0)
        return known, self.position[:, before[known]]
