"""Quantiles of weighted values."""

import numpy as np


def weighted_quantiles(values: np.ndarray, weights: np.ndarray, probability: np.ndarray) -> np.ndarray:
    """Return quantiles of weighted values, of the shape of `probability`.

    The distribution function is linear between the middles of the steps of the weighted one; of whole numbers the
    quantile is one of the values.

    Parameters
    ----------
    values, weights : ndarray, shape (n,)
        Weights >= 0.
    probability : ndarray
        In [0, 1].

    Examples
    --------
    >>> weighted_quantiles(np.array([1.0, 3.0, 2.0, 9.0]), np.array([1.0, 1.0, 1.0, 0.0]), np.array(0.5)).item()
    2.0
    """
    order = np.argsort(values, kind="stable")
    order = order[weights[order] > 0.0]
    ends = np.cumsum(weights[order])
    if values.dtype.kind in "iu":
        at = np.searchsorted(ends, probability * ends[-1])
        whole: np.ndarray = values[order][np.minimum(at, order.size - 1)]
        return whole
    middles = (ends - 0.5 * weights[order]) / ends[-1]
    return np.interp(probability, middles, values[order])
