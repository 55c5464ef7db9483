"""Sampling errors of probabilities: Wilson's interval, and the scatter between independent replicates."""

import math
from typing import NamedTuple

import numpy as np
from scipy import stats

CONFIDENCE = 0.95
"""Probability that an interval is meant to hold the true value with."""

Z = float(stats.norm.ppf(0.5 + 0.5 * CONFIDENCE))
"""Quantile of the normal distribution of the interval."""

LEAST_REPLICATES = 8
"""Least number of replicates whose scatter tells an error: the scatter itself is known to a quarter then."""


class Estimate(NamedTuple):
    """Probability with its sampling error; arrays of one shape.

    Attributes
    ----------
    probability : ndarray
    standard_error : ndarray
        NaN where none is known.
    low, high : ndarray
        Ends of the 95 % interval; NaN where none is known.
    """

    probability: np.ndarray
    standard_error: np.ndarray
    low: np.ndarray
    high: np.ndarray


def wilson(count: np.ndarray, trials: float) -> Estimate:
    """Return the probability of an event from independent trials, with Wilson's score interval.

    Unlike the normal interval it does not collapse where the event came never or always. The standard error is half
    the interval over its quantile of the normal distribution.

    Parameters
    ----------
    count : ndarray
        Trials in which the event came.
    trials : float
        Number of trials, > 0.

    Returns
    -------
    Estimate

    References
    ----------
    Wilson, E. B. (1927). Probable inference, the law of succession, and statistical inference. Journal of the American
    Statistical Association, 22(158), 209-212. https://doi.org/10.1080/01621459.1927.10502953

    Examples
    --------
    >>> found = wilson(np.array([0, 50]), 100)
    >>> found.high.round(3), found.low.round(3)
    (array([0.037, 0.596]), array([0.   , 0.404]))
    """
    p, square = np.asarray(count, float) / trials, Z * Z / trials
    centre = (p + 0.5 * square) / (1.0 + square)
    half = np.sqrt(p * (1.0 - p) * square + 0.25 * square * square) / (1.0 + square)
    low, high = np.where(p == 0.0, 0.0, centre - half), np.where(p == 1.0, 1.0, centre + half)
    return Estimate(p, half / Z, low, high)


def from_replicates(counts: np.ndarray, trials: np.ndarray) -> Estimate:
    """Return the probability of an event from independent replicates, with the error from their scatter.

    The members of a replicate depend on each other, as the strata of a Latin hypercube do; replicates do not. With
    trials n_r of N, the variance is R / (R - 1) sum (n_r / N)^2 (p_r - p)^2, and the interval is that of Student's
    distribution with R - 1 degrees of freedom. Where all replicates agree, as where the event never came, their scatter
    says nothing: there the interval is Wilson's, that of a random sample. The variance of a Latin hypercube of m
    members is at most m / (m - 1) times that of a random sample (Owen 1997), so the interval is a fair bound.

    Parameters
    ----------
    counts : ndarray, shape (replicates, ...)
        Trials of each replicate in which the event came.
    trials : ndarray, shape (replicates,)
        Number of trials of each, > 0.

    Returns
    -------
    Estimate

    References
    ----------
    Owen, A. B. (1997). Monte Carlo variance of scrambled net quadrature. SIAM Journal on Numerical Analysis, 34(5),
    1884-1910. https://doi.org/10.1137/S0036142994277468
    """
    trials = np.asarray(trials, float)
    number, whole = trials.size, trials.sum()
    column = trials.reshape(-1, *[1] * (counts.ndim - 1))
    plain = wilson(counts.sum(axis=0), whole)
    scatter = (column / whole) ** 2 * (counts / column - plain.probability) ** 2
    error = np.sqrt(number / (number - 1.0) * scatter.sum(axis=0))
    half = float(stats.t.ppf(0.5 + 0.5 * CONFIDENCE, number - 1)) * error
    # the probability of replicates without scatter differs from each of theirs by rounding
    agree = error <= 1e-9
    p = plain.probability
    low, high = np.maximum(p - half, 0.0), np.minimum(p + half, 1.0)
    return Estimate(
        p, np.where(agree, plain.standard_error, error), np.where(agree, plain.low, low),
        np.where(agree, plain.high, high),
    )  # fmt: skip


def without_error(count: np.ndarray, trials: float) -> Estimate:
    """Return the share of trials in which an event came, without an error."""
    p = np.asarray(count, float) / trials
    nothing = np.full(p.shape, np.nan)
    return Estimate(p, nothing, nothing, nothing)


def members_needed(standard_error: float = 0.05, ratio: float = 1.0) -> int:
    """Return how many members give a standard error at worst, where the probability is a half.

    Parameters
    ----------
    standard_error : float
        Standard error of a probability, in (0, 0.5).
    ratio : float
        Variance over that of a random sample of as many members.

    Returns
    -------
    int

    Examples
    --------
    >>> members_needed(0.05), members_needed(0.05, ratio=0.5)
    (100, 50)
    """
    return max(1, math.ceil(0.25 * ratio / standard_error**2 - 1e-9))
