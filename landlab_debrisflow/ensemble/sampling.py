"""Points in the unit cube from which the members of an ensemble are drawn."""

import inspect
import itertools
import warnings
from typing import NamedTuple

import numpy as np
from scipy.stats import qmc

from ..core.errors import ParameterError

MEMBERS, REPLICATES = 256, 8
"""Members if no number is given, and independent samples of which Latin hypercube and Sobol then consist: the scatter
between these tells the sampling error."""

BASE_POINTS = 64
"""Base points of a design of Saltelli if no number of members is given."""

GENERATOR = "rng" if "rng" in inspect.signature(qmc.Sobol).parameters else "seed"
"""Name by which scipy takes a generator, another one before version 1.15."""


class Points(NamedTuple):
    """Points in the unit cube.

    Attributes
    ----------
    uniform : ndarray, shape (members, dimensions)
        Coordinates in [0, 1).
    replicate : ndarray of int, shape (members,)
        Number of the independent sample that a member belongs to.
    """

    uniform: np.ndarray
    replicate: np.ndarray


def draw_points(method: str, members: int, dimensions: int, seed: int, replicates: int | None = None) -> Points:
    """Draw points in the unit cube.

    Parameters
    ----------
    method : {"random", "latin_hypercube", "sobol", "saltelli"}
    members : int
        Number of points.
    dimensions : int
        Number of varied values.
    seed : int
        Equal seeds give equal points.
    replicates : int, optional
        Number of independent samples of a Latin hypercube or of Sobol's sequence.

    Returns
    -------
    Points

    Raises
    ------
    ParameterError
        If the method cannot give so many points.

    Examples
    --------
    >>> points = draw_points("latin_hypercube", 16, 2, seed=1, replicates=2)
    >>> sorted((8 * points.uniform[points.replicate == 0, 1]).astype(int).tolist())
    [0, 1, 2, 3, 4, 5, 6, 7]
    """
    if method == "random":
        _no_replicates(method, replicates)
        return Points(np.random.default_rng(seed).random((members, dimensions)), np.zeros(members, int))
    if method == "saltelli":
        _no_replicates(method, replicates)
        return _saltelli(members, dimensions, seed)
    count = _replicates(members, replicates)
    sizes = [members // count + (k < members % count) for k in range(count)]
    if method == "sobol":
        _check_powers(members, count, sizes)
    parts = []
    for k, size in enumerate(sizes):
        generator = np.random.default_rng([seed, k])
        if method == "sobol":
            parts.append(_sobol(dimensions, size, generator))
        else:
            parts.append(qmc.LatinHypercube(dimensions, **{GENERATOR: generator}).random(size))
    return Points(np.concatenate(parts), np.repeat(np.arange(count), sizes))


def _no_replicates(method: str, replicates: int | None) -> None:
    if replicates not in (None, 1):
        raise ParameterError(f"ensemble: replicates are for latin_hypercube and sobol, not {method}; leave them out")


def _replicates(members: int, replicates: int | None) -> int:
    """Return the number of independent samples, by default 8 of two members or more each."""
    if replicates is None:
        return REPLICATES if members >= 2 * REPLICATES else 1
    if not 1 <= replicates <= members:
        raise ParameterError(f"ensemble: replicates must lie in [1, {members}], the members, got {replicates}")
    return replicates


def _check_powers(members: int, count: int, sizes: list[int]) -> None:
    if members % count or sizes[0] & (sizes[0] - 1):
        below = count * 2 ** max(0, (members // count).bit_length() - 1)
        raise ParameterError(
            f"ensemble: sobol needs a power of two of members in each of {count} replicates, got {members}; give "
            f"{below} or {2 * below}"
        )


def _sobol(dimensions: int, size: int, generator: np.random.Generator) -> np.ndarray:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # sizes are powers of two
        return qmc.Sobol(dimensions, **{GENERATOR: generator}).random(size)


def default_members(method: str, dimensions: int) -> int:
    """Return the number of members of an ensemble for which none is given."""
    return BASE_POINTS * (dimensions + 2) if method == "saltelli" else MEMBERS


def saltelli_base(members: int, dimensions: int) -> int:
    """Return the number of base points of a design of Saltelli, each of which has `dimensions` + 2 members."""
    return members // (dimensions + 2)


def _saltelli(members: int, dimensions: int, seed: int) -> Points:
    """Return A, A with column k of B for each k, and B, of each base point, in the order that SALib reads."""
    base = saltelli_base(members, dimensions)
    if members % (dimensions + 2) or base < 2 or base & (base - 1):
        below = (dimensions + 2) * 2 ** max(1, base.bit_length() - 1)
        raise ParameterError(
            f"ensemble: saltelli needs {dimensions + 2} members, two more than varied values, for each of a power of "
            f"two of base points, got {members}; give {below} or {2 * below}"
        )
    both = _sobol(2 * dimensions, base, np.random.default_rng([seed, 0]))
    first, second = both[:, :dimensions], both[:, dimensions:]
    points = np.repeat(first[:, None, :], dimensions + 2, axis=1)
    for k in range(dimensions):
        points[:, k + 1, k] = second[:, k]
    points[:, -1] = second
    return Points(points.reshape(members, dimensions), np.zeros(members, int))


def all_combinations(counts: list[int]) -> np.ndarray:
    """Return the indices of all combinations of lists of some lengths, shape (combinations, lists).

    Examples
    --------
    >>> all_combinations([2, 2]).tolist()
    [[0, 0], [0, 1], [1, 0], [1, 1]]
    """
    return np.array(list(itertools.product(*map(range, counts))), int).reshape(-1, len(counts))
