"""Measures that events have in common: agreement of maps, correlation, noise."""

from collections.abc import Iterable, Mapping

import numpy as np


def csi(modelled: np.ndarray, observed: np.ndarray) -> float:
    """Return the critical success index of two maps of yes and no: hits over hits, misses and false alarms.

    The index is also called intersection over union. Two empty maps have no index, NaN.

    Examples
    --------
    >>> csi(np.array([True, True, False]), np.array([True, False, False]))
    0.5
    """
    return _ratio(np.sum(modelled & observed), np.sum(modelled | observed))


def precision(modelled: np.ndarray, observed: np.ndarray) -> float:
    """Return the fraction of the modelled cells that are observed; NaN without modelled cells."""
    return _ratio(np.sum(modelled & observed), np.sum(modelled))


def recall(modelled: np.ndarray, observed: np.ndarray) -> float:
    """Return the fraction of the observed cells that are modelled; NaN without observed cells."""
    return _ratio(np.sum(modelled & observed), np.sum(observed))


def correlation(modelled: np.ndarray, observed: np.ndarray) -> float:
    """Return Pearson's correlation of two arrays; NaN if one of them does not vary.

    Examples
    --------
    >>> round(correlation(np.array([0.0, 1.0, 2.0]), np.array([1.0, 3.0, 5.0])), 9)
    1.0
    """
    if modelled.size < 2 or np.ptp(modelled) == 0.0 or np.ptp(observed) == 0.0:
        return float("nan")
    return float(np.corrcoef(modelled.ravel(), observed.ravel())[0, 1])


def spread(rows: Iterable[Mapping[str, float]]) -> dict[str, float]:
    """Return the standard deviation of every measure over runs that differ in the discretisation only: the noise floor.

    Parameters
    ----------
    rows : iterable of mapping
        Scores of the runs.

    Returns
    -------
    dict
        By measure; NaN with fewer than two runs.
    """
    rows = list(rows)
    names = rows[0].keys() if rows else ()
    return {
        name: float(np.std([row.get(name, np.nan) for row in rows], ddof=1)) if len(rows) > 1 else float("nan")
        for name in names
    }


def _ratio(part: float, whole: float) -> float:
    return float(part / whole) if whole else float("nan")
