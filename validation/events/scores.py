"""Measures that events have in common, beside those of `landlab_debrisflow.calibration.agreement`."""

from collections.abc import Iterable, Mapping

import numpy as np


def precision(modelled: np.ndarray, observed: np.ndarray) -> float:
    """Return the fraction of the modelled cells that are observed; NaN without modelled cells."""
    return _ratio(np.sum(modelled & observed), np.sum(modelled))


def recall(modelled: np.ndarray, observed: np.ndarray) -> float:
    """Return the fraction of the observed cells that are modelled; NaN without observed cells."""
    return _ratio(np.sum(modelled & observed), np.sum(observed))


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
