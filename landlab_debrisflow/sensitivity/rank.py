"""Rank correlations between the varied values of an ensemble and its measures."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from scipy import stats

from ..core.errors import InputError
from ..ensemble.design import design_keys
from ..ensemble.results import EnsembleResults
from .selection import ESTIMATE, LOWER, UPPER, check_confidence, chosen_measures, number_variables, sensitivity_dataset

UNDETERMINED = 1e-10
"""Variance of ranks, over that before, which is left by rounding alone where other values determine a value."""


def rank_correlations(
    results: EnsembleResults, measures: str | Sequence[str] | None = None, confidence: float = 0.95
) -> xr.Dataset:
    """Correlate the ranks of measures with the ranks of varied values.

    Spearman's correlation tells how steadily a measure grows (1) or falls (-1) with a value, linearly or not. The
    partial rank correlation is that of the parts of both which ranks of further values do not explain linearly: it
    separates values that were drawn correlated, and shows a small effect beside a large one. A measure that rises and
    falls again with a value has a rank correlation near 0 with it; `sobol_indices` see such an effect.

    Intervals are those of Fisher's z = atanh r with the variance (1 + r^2 / 2) / (n - 3) for n members. They are for
    members drawn at random, and near enough for Latin hypercubes and Sobol's sequence (``python -m
    benchmarks.sensitivity`` counts how often they hold the truth). Of a saltelli design the first and the last member
    of each base point count, since members between them repeat the coordinates of these two. All combinations of a
    factorial design are no sample, and have no interval. Partial rank correlations have none: where values determine a
    measure almost wholly, they depend on the number of members, and Fisher's interval is far too narrow.

    Parameters
    ----------
    results : EnsembleResults
        Members of any sampling, finished or not.
    measures : str or sequence of str, optional
        Names of measures; by default all.
    confidence : float
        Level of the intervals, in ]0, 1[.

    Returns
    -------
    xarray.Dataset
        ``rank_correlation`` and ``partial_rank_correlation`` over ``measure`` and ``parameter``, NaN where a measure or
        a value is constant, the partial one also where further values determine the value or the measure;
        ``rank_correlation_interval`` over ``bound``; ``members`` that count for each measure: those that failed or lack
        it do not. Words, files and noise have no ranks: the attribute ``left_out`` names them.

    Raises
    ------
    InputError, ParameterError
        If a measure is unknown, or no varied value is a number.

    References
    ----------
    Spearman (1904); Bonett & Wright (2000), doi:10.1007/BF02294183, variance of z; Iman & Conover (1980),
    doi:10.1080/03610928008827996, and Helton & Davis (2003), doi:10.1016/S0951-8320(03)00058-9, partial rank
    correlations.
    """
    check_confidence(confidence)
    found, (variables, left_out) = chosen_measures(results, measures), number_variables(results.design)
    if not variables:
        raise InputError(
            f"rank_correlations: {', '.join(left_out)} cannot be ranked, no other value varies; vary a number, or "
            "take sobol_indices"
        )
    chosen = _independent_members(results)
    values = np.column_stack([results.design[name].values[chosen] for name in variables]).astype(float)
    shape = len(found.data_vars), len(variables)
    whole, partial, members = np.full((*shape, 3), np.nan), np.full((*shape, 1), np.nan), np.zeros(shape[0], int)
    for k, measure in enumerate(found.data_vars.values()):
        there = np.isfinite(measure.values[chosen])
        members[k] = there.sum()
        if members[k] > 1:
            both = correlations(values[there], measure.values[chosen][there])
            whole[k, :, ESTIMATE], partial[k, :, ESTIMATE] = both
    if results.sampling != "factorial":
        ends = correlation_interval(whole[..., ESTIMATE], members[:, None], confidence)
        whole[..., LOWER], whole[..., UPPER] = ends
    return sensitivity_dataset(
        results, found, variables,
        {
            "rank_correlation": (whole, "Spearman's rank correlation"),
            "partial_rank_correlation": (partial, "rank correlation without the effect of further values"),
        },
        ("members", members, "members that the correlations are from"),
        {"confidence": confidence, "left_out": ", ".join(left_out)},
    )  # fmt: skip


def _independent_members(results: EnsembleResults) -> np.ndarray:
    """Return the numbers of the members that share no values by design."""
    members = np.arange(results.design.sizes["member"])
    if results.sampling != "saltelli":
        return members
    points = members.reshape(-1, len(design_keys(results.design)) + 2)
    return points[:, [0, -1]].ravel()


def correlations(values: np.ndarray, measure: np.ndarray) -> np.ndarray:
    """Return rank and partial rank correlations of a measure with each value.

    Parameters
    ----------
    values : ndarray, shape (members, values)
    measure : ndarray, shape (members,)

    Returns
    -------
    ndarray, shape (2, values)
        NaN where the measure or a value is constant, or further values determine it.

    Examples
    --------
    >>> values = np.array([[1.0, 3.0], [2.0, 1.0], [3.0, 4.0], [4.0, 2.0]])
    >>> correlations(values, np.array([1.0, 2.0, 4.0, 8.0]))[0].round(2).tolist()
    [1.0, 0.0]
    """
    ranks, rank = _ranks(values), _ranks(measure[:, None])[:, 0]
    found = np.empty((2, ranks.shape[1]))
    for k in range(ranks.shape[1]):
        others = np.delete(ranks, k, axis=1)
        found[0, k] = _correlation(ranks[:, k], rank)
        found[1, k] = _correlation(_remainder(ranks[:, k], others), _remainder(rank, others))
    return found


def _ranks(values: np.ndarray) -> np.ndarray:
    """Return ranks of each column less their mean, shape (members, columns)."""
    return stats.rankdata(values, axis=0) - 0.5 * (len(values) + 1)


def _remainder(ranks: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Return ranks less their linear function of other ranks, shape (members,); 0 if only rounding is left."""
    left = ranks - others @ np.linalg.lstsq(others, ranks, rcond=None)[0]
    return left if left @ left > UNDETERMINED * (ranks @ ranks) else np.zeros_like(left)


def _correlation(one: np.ndarray, other: np.ndarray) -> float:
    """Return the correlation of two parts with mean 0, NaN if one of them is 0."""
    squares = (one @ one) * (other @ other)
    return float(np.clip(one @ other / np.sqrt(squares), -1.0, 1.0)) if squares > 0.0 else np.nan


def correlation_interval(correlation: Any, count: Any, confidence: float) -> tuple[Any, Any]:
    """Return the ends of the interval of a rank correlation from a random sample; NaN of three members or fewer.

    Parameters
    ----------
    correlation : float or ndarray
    count : int or ndarray
        Number of members.
    confidence : float

    Returns
    -------
    tuple of float or ndarray

    References
    ----------
    Bonett & Wright (2000), doi:10.1007/BF02294183.

    Examples
    --------
    >>> [round(float(end), 4) for end in correlation_interval(0.8699639, 15, 0.95)]
    [0.5841, 0.9638]
    """
    free = np.where(np.asarray(count) > 3, np.asarray(count, float) - 3.0, np.nan)
    half = stats.norm.ppf(0.5 + 0.5 * confidence) * np.sqrt((1.0 + 0.5 * np.square(correlation)) / free)
    with np.errstate(divide="ignore"):  # atanh of 1
        z = np.arctanh(correlation)
    return np.tanh(z - half), np.tanh(z + half)
