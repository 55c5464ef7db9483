"""Maps of quantiles, from histograms at every node."""

from typing import Any

import numpy as np
from scipy import stats

from ..record.attributes import variable_attributes
from .bins import PER_DECADE, bin_of_rank, bin_values
from .census import Census
from .counting import Histogram
from .errors import CONFIDENCE
from .questions import ARRIVAL

ENDS = ("", ""), ("_low", "lower end of the interval of the "), ("_high", "upper end of the interval of the ")
"""Endings of the variables of a quantile, and beginnings of their meanings."""

BINS = f"{PER_DECADE} in a decade; the quantile of the members lies within a bin, whose edges are 5 % below and above"


def quantile_maps(
    histogram: Histogram, quantiles: tuple[float, ...], census: Census, meaning: str, unit: str
) -> dict[str, Any]:
    """Return the quantiles of a map and their intervals, as variables of a Dataset.

    Members in which nothing came to a node count with the value 0; for the arrival time they do not count.

    Parameters
    ----------
    histogram : Histogram
    quantiles : tuple of float
    census : Census
    meaning, unit : str
        Of the map.

    Returns
    -------
    dict
        ``quantile_of_...`` over ``quantile``, ``y`` and ``x``, with the endings ``_low`` and ``_high``, the values of
        the ranks of `rank_intervals`; NaN where no error is told or members are too few.
    """
    values, of_arrival = bin_values(histogram.name), histogram.name == ARRIVAL
    shape = histogram.counts.shape[:2]
    found = np.full((3, len(quantiles), *shape), np.nan if of_arrival else 0.0, np.float32)
    table = np.array([rank_intervals(quantile, census.completed) for quantile in quantiles])
    if not of_arrival:
        found[table[:, :, -1].T == 0] = np.nan
    for row in range(shape[0]):  # a cumulative sum over all rows at once would take the memory of all
        counts = histogram.counts[row]
        came = counts.sum(axis=-1, dtype=np.int64)
        nodes = np.flatnonzero(came)
        trials = came[nodes] if of_arrival else np.full(nodes.size, census.completed)
        full = counts[nodes].astype(np.int64)
        full[:, 0] += trials - came[nodes]
        for k in range(len(quantiles)):
            for j, rank in enumerate(table[k][:, trials]):
                taken = values[bin_of_rank(full, np.maximum(rank, 1))]
                found[j, k, row, nodes] = np.where(rank > 0, taken, np.nan)
    if not census.method:
        found[1:] = np.nan
    among = ", among the members that reach the node" if of_arrival else ""
    return {
        f"quantile_of_{histogram.name}{ending}": (
            ("quantile", "y", "x"), found[j],
            variable_attributes(unit, f"{prefix}quantile of {meaning}{among}") | {"bins": BINS},
        )
        for j, (ending, prefix) in enumerate(ENDS)
    }  # fmt: skip


def rank_intervals(quantile: float, most: int) -> np.ndarray:
    """Return the ranks of a quantile and of the ends of its 95 % interval, for samples of 0 to `most` members.

    The number of members of a random sample below a quantile of the distribution is binomial; between the members of
    the two ranks the quantile lies in at least 95 % of all samples, whatever the distribution.

    Parameters
    ----------
    quantile : float
        In (0, 1).
    most : int

    Returns
    -------
    ndarray of int, shape (3, most + 1)
        From 1; 0 where the sample is too small for an end.

    Examples
    --------
    >>> rank_intervals(0.5, 100)[:, 100].tolist(), rank_intervals(0.95, 10)[:, 10].tolist()
    ([50, 40, 61], [10, 8, 0])
    """
    trials, tail = np.arange(most + 1), 0.5 * (1.0 - CONFIDENCE)
    rank = np.ceil(quantile * trials - 1e-9)
    low, high = stats.binom.ppf(tail, trials, quantile), stats.binom.ppf(1.0 - tail, trials, quantile) + 1.0
    return np.stack([rank, low, np.where(high > trials, 0.0, high)]).astype(np.int64)
