"""Fixed bins of the values of maps, for quantiles from integer counts."""

import numpy as np

PER_DECADE = 24
"""Bins in a decade: each is wider than the one below by the factor 10^(1/24), 10 %."""

RANGES = {
    "max_depth": (0.01, 100.0), "deposit_depth": (0.01, 100.0), "eroded_depth": (0.01, 100.0),
    "max_speed": (0.1, 100.0), "max_impact_pressure": (1e2, 1e7), "arrival_time": (0.1, 1e5),
}  # fmt: skip
"""Lowest and highest edge by map, in its unit: powers of ten."""


def bin_edges(name: str) -> np.ndarray:
    """Return the edges of the bins of a map, in its unit; a bin below them and one above are open.

    Parameters
    ----------
    name : str
        One of `RANGES`.

    Returns
    -------
    ndarray, shape (bins + 1,)

    Examples
    --------
    >>> edges = bin_edges("max_depth")
    >>> edges.size, float(edges[24].round(9)), float((edges[1] / edges[0]).round(4))
    (97, 0.1, 1.1007)
    """
    low, high = np.log10(RANGES[name])
    return 10.0 ** (low + np.arange(round((high - low) * PER_DECADE) + 1) / PER_DECADE)


def bin_values(name: str) -> np.ndarray:
    """Return the value that stands for each bin: 0 below the lowest edge, the geometric middle, the highest edge.

    Parameters
    ----------
    name : str
        One of `RANGES`.

    Returns
    -------
    ndarray, shape (bins + 2,)
    """
    edges = bin_edges(name)
    return np.concatenate([[0.0], np.sqrt(edges[:-1] * edges[1:]), edges[-1:]])


def bin_of_rank(histogram: np.ndarray, rank: np.ndarray) -> np.ndarray:
    """Return the index of the bin that holds the member of a rank.

    Parameters
    ----------
    histogram : ndarray of int, shape (..., bins)
    rank : ndarray of int, shape (...)
        From 1.

    Returns
    -------
    ndarray of int, shape (...)
    """
    below = np.cumsum(histogram, axis=-1, dtype=np.int64) < np.asarray(rank)[..., None]
    return below.sum(axis=-1)
