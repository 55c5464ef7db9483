"""Sobol indices of the measures of an ensemble, from a design of Saltelli."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from ..core.errors import InputError, ParameterError
from ..ensemble.design import design_keys
from ..ensemble.results import EnsembleResults
from .selection import ESTIMATE, LOWER, UPPER, check_confidence, chosen_measures, sensitivity_dataset

NAMES = "first_order", "total_order"
LEAST = 32
"""Fewest base points: of 16, intervals by resampling are too narrow (``python -m benchmarks.sensitivity``)."""

LOST = 0.1
"""Largest share of base points that may be left out: members fail in a corner of the distributions, whose part in the
variance is then missing."""


def sobol_indices(
    results: EnsembleResults, measures: str | Sequence[str] | None = None, *, seed: int = 0, resamples: int = 1000,
    confidence: float = 0.95,
) -> xr.Dataset:  # fmt: skip
    """Estimate shares of the variance of measures by varied value, alone and with further values.

    The first-order index is the share of the variance that would go if the value were known; the total one the share
    that would stay if all further values were known. Their difference is due to interactions. Effects need be neither
    monotone nor of numbers: choices of words, files and noise have indices, too.

    The estimators are those of SALib. An interval is the estimate plus and minus the normal quantile times the standard
    deviation over resamples of the base points; 32 base points of Sobol's sequence or more scatter less than resamples
    do, so intervals are rather too wide. Near 0 and 1 estimates and intervals may leave [0, 1].

    Parameters
    ----------
    results : EnsembleResults
        Members of ``sampling="saltelli"``. Base points of which members are not there yet do not count. A base point
        with a member that failed, or without the measure, is left out whole.
    measures : str or sequence of str, optional
        Names of measures; by default all.
    seed : int
        Seed of the resampling.
    resamples : int
        Number of resamples.
    confidence : float
        Level of the intervals, in ]0, 1[.

    Returns
    -------
    xarray.Dataset
        ``first_order`` and ``total_order`` over ``measure`` and ``parameter``, NaN where a measure is constant or too
        many base points lack it; with ``_interval`` behind the name, their intervals over ``bound``; ``base_points``
        that count for each measure.

    Raises
    ------
    InputError
        If the members are of another sampling, too few base points are there, or more than a tenth of these holds a
        failure.
    ParameterError
        If a measure is unknown, or an argument out of its range.

    References
    ----------
    Sobol (2001), doi:10.1016/S0378-4754(00)00270-6; Saltelli et al. (2010), doi:10.1016/j.cpc.2009.09.018, designs and
    estimators; Herman & Usher (2017), doi:10.21105/joss.00097, SALib.
    """
    check_confidence(confidence)
    for name, value, least in (("seed", seed, 0), ("resamples", resamples, 2)):
        if isinstance(value, bool) or not isinstance(value, int) or value < least:
            raise ParameterError(f"sobol_indices: {name} must be a whole number of {least} or more, got {value!r}")
    if results.sampling != "saltelli":
        raise InputError(
            f"Sobol indices need sampling: saltelli; these members are of {results.sampling}: run an ensemble with it, "
            "or take rank_correlations"
        )
    found, variables = chosen_measures(results, measures), list(design_keys(results.design))
    step = len(variables) + 2
    complete = _complete_points(results, step)
    estimates = np.full((len(NAMES), len(found.data_vars), len(variables), 3), np.nan)
    counts = np.zeros(len(found.data_vars), int)
    for k, measure in enumerate(found.data_vars.values()):
        points = measure.values.reshape(-1, step)[complete]
        points = points[np.isfinite(points).all(axis=1)]
        counts[k] = len(points)
        if counts[k] >= (1.0 - LOST) * complete.sum() and np.ptp(points) > 0.0:
            estimates[:, k] = indices(points, seed, resamples, confidence)
    meanings = "share of the variance by the value alone", "share of the variance by the value alone and with others"
    return sensitivity_dataset(
        results, found, variables, dict(zip(NAMES, zip(estimates, meanings, strict=True), strict=True)),
        ("base_points", counts, "base points that the indices are from"),
        {"confidence": confidence, "seed": seed, "resamples": resamples},
    )  # fmt: skip


def _complete_points(results: EnsembleResults, step: int) -> np.ndarray:
    """Return whether all members of a base point are there, shape (base points,)."""
    complete = np.all(results.done.reshape(-1, step), axis=1)
    if complete.sum() < LEAST:
        raise InputError(
            f"sobol_indices: {complete.sum()} of {complete.size} base points are there, {LEAST} are needed; run more "
            f"members, {step} for each base point"
        )
    lost = {one.member // step for one in results.failures} & set(np.flatnonzero(complete).tolist())
    if len(lost) > LOST * complete.sum():
        raise InputError(
            f"sobol_indices: {len(lost)} of {complete.sum()} base points hold a member that failed, at most "
            f"{100.0 * LOST:.0f} % may be left out; results.failures tells why: narrow the distributions, or take "
            "rank_correlations"
        )
    return complete


def indices(points: np.ndarray, seed: int, resamples: int, confidence: float) -> np.ndarray:
    """Return first-order and total indices with their intervals.

    Parameters
    ----------
    points : ndarray, shape (base points, values + 2)
        Measures of the members of each base point.
    seed, resamples : int
    confidence : float

    Returns
    -------
    ndarray, shape (2, values, 3)
        Estimate, lower and upper bound.
    """
    number = points.shape[1] - 2
    problem = {"num_vars": number, "names": [str(k) for k in range(number)], "bounds": [[0.0, 1.0]] * number}
    # SALib takes the seed 0 for none
    found = _sobol().analyze(
        problem, points.ravel(), calc_second_order=False, num_resamples=resamples, conf_level=confidence, seed=seed + 1
    )  # fmt: skip
    estimates = np.empty((len(NAMES), number, 3))
    for kind, name in enumerate(("S1", "ST")):
        half = found[f"{name}_conf"]
        estimates[kind, :, ESTIMATE] = found[name]
        estimates[kind, :, LOWER], estimates[kind, :, UPPER] = found[name] - half, found[name] + half
    return estimates


def _sobol() -> Any:
    try:
        from SALib.analyze import sobol
    except ImportError as error:
        raise InputError('Sobol indices need SALib; pip install "landlab_debrisflow[ensemble]"') from error
    return sobol
