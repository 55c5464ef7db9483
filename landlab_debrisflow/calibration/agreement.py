"""Agreement of two maps: critical success index, correlation."""

import numpy as np


def csi(modelled: np.ndarray, observed: np.ndarray) -> float:
    """Return the critical success index: hits over hits, misses and false alarms, the intersection over union [-].

    Parameters
    ----------
    modelled, observed : ndarray of bool, of one shape

    Examples
    --------
    >>> csi(np.array([True, True, False]), np.array([True, False, False]))
    0.5
    """
    union = np.sum(modelled | observed)
    return float(np.sum(modelled & observed) / union) if union else float("nan")


def correlation(modelled: np.ndarray, observed: np.ndarray) -> float:
    """Return Pearson's correlation of two arrays; NaN if one of them does not vary.

    Parameters
    ----------
    modelled, observed : ndarray, of one shape
    """
    if modelled.size < 2 or np.ptp(modelled) == 0.0 or np.ptp(observed) == 0.0:
        return float("nan")
    return float(np.corrcoef(modelled.ravel(), observed.ravel())[0, 1])
