"""Kinds of failing bodies: each a family of depths that grows with one number, from 0 to the largest that can leave."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_array, csc_array
from scipy.sparse.linalg import splu

from .fall_lines import SIDES
from .outline import Outline


class Family(NamedTuple):
    """Depths of failing bodies of one kind within one outline.

    Attributes
    ----------
    depth : callable
        Takes a number and returns the depth, shape (rows, columns) [m], which nowhere decreases with the number.
    least, first : float
        Number with which nothing fails, and a larger number to begin with.
    largest : ndarray, shape (rows, columns)
        Limit of the depth for large numbers [m].
    """

    depth: Callable[[float], np.ndarray]
    least: float
    first: float
    largest: np.ndarray


def uniform(outline: Outline, floor_fall: float) -> Family:
    """Return bodies of even depth [m], whether they can leave or not; `floor_fall` is not used."""
    return Family(lambda depth: depth * outline.inside, 0.0, 1.0, np.where(outline.inside, np.inf, 0.0))


def tapered(outline: Outline, floor_fall: float) -> Family:
    """Return bodies of even depth [m], except above the lower rim, where the floor falls less than the ground.

    `floor_fall` is the fall of the floor over that of the ground [-]; it is less if the whole body is rim, and the
    number then stands for the depth at the top.
    """
    fall = outline.fall
    highest = max(float(fall.max()), 1e-300)
    steep = 1.0 - floor_fall
    return Family(lambda depth: np.minimum(depth, max(steep, depth / highest) * fall), 0.0, highest, fall)


def ellipsoid(outline: Outline, floor_fall: float) -> Family:
    """Return lower halves of ellipsoids with the principal axes of the outline, cut at the outline [m].

    In plan the ellipse has the area moments of the outline; `floor_fall` is not used.
    """
    dx, dy = outline.spacing
    rows, columns = np.indices(outline.inside.shape)
    places, weight = np.stack([columns.ravel() * dx, rows.ravel() * dy]), outline.fraction.ravel()
    centred = places - np.average(places, axis=1, weights=weight)[:, None]
    moments = np.cov(places, aweights=weight, bias=True) + np.diag([dx * dx, dy * dy]) / 12.0
    # the variances of an ellipse are a quarter of the squares of its half axes
    variances, axes = np.linalg.eigh(moments)
    radius2 = ((axes.T @ centred) ** 2 / (4.0 * variances[:, None])).sum(axis=0).reshape(outline.inside.shape)
    shape = np.sqrt(np.maximum(0.0, 1.0 - radius2)) * outline.inside
    largest = np.where(shape > 0.0, outline.fall, 0.0)
    highest = max(float(largest.max()), 1e-300)
    return Family(lambda depth: np.minimum(depth * shape, outline.fall), 0.0, highest, largest)


def sloping_local_base_level(outline: Outline, floor_fall: float) -> Family:
    """Return bodies above floors that have the same Laplacian [m-1] wherever they lie below the ground [m].

    The number is the Laplacian; `floor_fall` is not used.
    """
    inside, ground = outline.inside, outline.elevation
    number = np.full(inside.shape, -1)
    rows, columns = np.nonzero(inside)
    number[rows, columns] = np.arange(rows.size)
    links, bend = np.zeros((2, rows.size))  # sum of the weights of the neighbours of each node; Laplacian of the ground
    entries = []
    for down, along in SIDES:
        there = rows + down, columns + along
        link = np.where(np.isfinite(ground[there]), outline.spacing[0 if along else 1] ** -2.0, 0.0)
        links += link
        bend += link * (np.nan_to_num(ground[there]) - ground[rows, columns])
        within = np.flatnonzero(number[there] >= 0)
        entries.append((-link[within], within, number[there][within]))
    entries.append((links, np.arange(rows.size), np.arange(rows.size)))
    values, row, column = (np.concatenate(parts) for parts in zip(*entries, strict=True))
    matrix = coo_array((values, (row, column)), shape=(rows.size, rows.size)).tocsc()
    obstacle = Obstacle(matrix)

    def depth(laplacian: float) -> np.ndarray:
        body = np.zeros(inside.shape)
        body[rows, columns] = obstacle.solve(laplacian, bend)
        return np.minimum(body, outline.fall)

    even = float(bend.min())  # with less curvature the floor would lie nowhere below the ground
    return Family(depth, even, even + float(outline.fall.max()) / outline.area, outline.fall)


class Obstacle:
    """Least u >= 0 with matrix u >= load, for one load after the other.

    Parameters
    ----------
    matrix : sparse array, shape (n, n)
        An M-matrix, such as a negative Laplacian.

    Notes
    -----
    The primal-dual active set method of Hintermüller et al. (2002), which ends after a finite number of steps. As long
    as u > 0 at the same places, u changes linearly with an even load: no system need be solved then.
    """

    def __init__(self, matrix: csc_array):
        self._matrix = matrix
        self._free = np.ones(matrix.shape[0], bool)  # where u > 0
        self._answers: np.ndarray | None = None

    def solve(self, even: float, uneven: np.ndarray) -> np.ndarray:
        """Return u for the load even - uneven, shape (n,); `uneven`, shape (n,), never changes."""
        load = even - uneven
        while True:
            if self._answers is None:
                self._answers = self._respond(np.stack([np.ones(load.size), -uneven], axis=1))
            u = self._answers @ [even, 1.0]
            changed = np.where(self._free, u > 0.0, self._matrix @ u < load)
            if np.array_equal(changed, self._free):
                return u
            self._free, self._answers = changed, None

    def _respond(self, loads: np.ndarray) -> np.ndarray:
        """Return the answers to loads, shape (n, 2), where u > 0; 0 elsewhere."""
        answers, places = np.zeros(loads.shape), np.flatnonzero(self._free)
        if places.size:
            answers[places] = splu(self._matrix[places][:, places].tocsc()).solve(loads[places])
        return answers


KINDS = {
    "tapered": tapered, "sloping_local_base_level": sloping_local_base_level, "ellipsoid": ellipsoid,
    "uniform": uniform,
}  # fmt: skip
