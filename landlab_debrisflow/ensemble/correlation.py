"""Rank correlations between the varied values of an ensemble."""

import itertools
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from scipy import stats

from ..core.errors import ParameterError
from ..core.hints import did_you_mean
from .sampling import Points


def correlated(points: Points, keys: Sequence[str], correlation: Any, stratified: bool) -> np.ndarray:
    """Return points with rank correlations, by a Gaussian copula.

    The copula of rank correlation rho has the correlation 2 sin(pi rho / 6) of the normal variables (Pearson 1907).

    Parameters
    ----------
    points : Points
        Points without correlation.
    keys : sequence of str
        Dotted names of the dimensions.
    correlation : mapping or array_like
        ``{(a, b): rho}``, ``{a: {b: rho}}`` or the whole matrix, in the order of `keys`.
    stratified : bool
        Whether the points of each replicate keep their coordinates and only change partners, so that a Latin hypercube
        stays one (after Iman and Conover 1982).

    Returns
    -------
    ndarray, shape (members, dimensions)

    Raises
    ------
    ParameterError
        If a name is unknown or no distribution has these correlations.
    """
    matrix = 2.0 * np.sin(np.pi / 6.0 * rank_matrix(keys, correlation))
    np.fill_diagonal(matrix, 1.0)
    try:
        root = np.linalg.cholesky(matrix)
    except np.linalg.LinAlgError as error:
        least = float(np.linalg.eigvalsh(matrix)[0])
        raise ParameterError(
            f"ensemble: correlation: no values are correlated like this, the matrix is not positive definite (least "
            f"eigenvalue {least:.3g}); take smaller correlations"
        ) from error
    tiny = np.finfo(float).tiny
    normal = stats.norm.ppf(np.clip(points.uniform, tiny, np.nextafter(1.0, 0.0)))
    # a sum in a stated order: a product of matrices may differ in the last bit from machine to machine
    mixed = np.stack([sum(root[i, j] * normal[:, j] for j in range(i + 1)) for i in range(len(keys))], axis=1)
    if not stratified:
        return np.minimum(stats.norm.cdf(mixed), np.nextafter(1.0, 0.0))
    found = np.empty_like(mixed)
    for number in np.unique(points.replicate):
        inside = np.flatnonzero(points.replicate == number)
        for k in range(len(keys)):
            found[inside[np.argsort(mixed[inside, k], kind="stable")], k] = np.sort(points.uniform[inside, k])
    return found


def rank_matrix(keys: Sequence[str], correlation: Any) -> np.ndarray:
    """Return the matrix of rank correlations [-].

    Parameters
    ----------
    keys : sequence of str
        Dotted names in the order of rows and columns.
    correlation : mapping or array_like
        As for `correlated`.

    Returns
    -------
    ndarray, shape (keys, keys)

    Raises
    ------
    ParameterError
        If a name is unknown, or a number is none of a correlation.

    Examples
    --------
    >>> rank_matrix(["a", "b", "c"], {("a", "c"): 0.5})[0].tolist()
    [1.0, 0.0, 0.5]
    """
    if isinstance(correlation, Mapping):
        matrix = np.eye(len(keys))
        for one, other, value in _pairs(correlation):
            i, j = (_index(key, keys) for key in (one, other))
            if i == j:
                raise ParameterError(f"ensemble: correlation: {one} with itself is 1; leave it out")
            matrix[i, j] = matrix[j, i] = _checked(f"{one} with {other}", value)
        return matrix
    try:
        matrix = np.asarray(correlation, float)
    except (TypeError, ValueError):
        matrix = np.zeros((0, 0))
    shape = (len(keys), len(keys))
    if matrix.shape != shape or not np.array_equal(matrix, matrix.T) or not np.all(np.diag(matrix) == 1.0):
        raise ParameterError(
            f"ensemble: correlation must be a mapping of pairs of names to rank correlations, or a symmetric matrix "
            f"{shape[0]} x {shape[1]} with 1 on its diagonal, got {correlation!r:.80}"
        )
    for i, j in itertools.combinations(range(len(keys)), 2):
        _checked(f"{keys[i]} with {keys[j]}", matrix[i, j])
    return matrix


def _pairs(correlation: Mapping[Any, Any]):
    for key, value in correlation.items():
        if isinstance(key, tuple) and len(key) == 2:
            yield (*key, value)
        elif isinstance(value, Mapping):
            for other, number in value.items():
                yield key, other, number
        else:
            raise ParameterError(
                f"ensemble: correlation: a pair of names is needed, such as {{a: {{b: 0.5}}}}, got {key!r}: {value!r}"
            )


def _index(key: Any, keys: Sequence[str]) -> int:
    if key not in keys:
        raise ParameterError(
            f"ensemble: correlation: {key!r} does not vary{did_you_mean(key, keys)}; varied: {', '.join(keys)}"
        )
    return list(keys).index(key)


def _checked(label: str, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float | np.number) or not -1.0 < value < 1.0:
        raise ParameterError(f"ensemble: correlation: {label} must lie in (-1, 1), got {value!r}")
    return float(value)
