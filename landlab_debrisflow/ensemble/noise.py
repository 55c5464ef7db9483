"""Correlated noise on an elevation: the error of a DEM that stands in no report of its cells."""

import numpy as np
from scipy.ndimage import gaussian_filter1d

from ..geo.lattice import Lattice

TRUNCATED = 4.0
"""Half-width of the filter over its standard deviation."""


def correlated_noise(lattice: Lattice, rms: float, length: float, seed: tuple[int, int]) -> np.ndarray:
    """Return a realisation of Gaussian noise with the correlation exp(-(r / length)^2) over the nodes [m].

    White noise is filtered with a Gaussian of the standard deviation length / 2, whose convolution with itself is that
    correlation. The filter reads white noise beyond the edge, too, so that the noise is the same everywhere.

    Parameters
    ----------
    lattice : Lattice
        Nodes.
    rms : float
        Root mean square in the mean over realisations [m].
    length : float
        Distance at which the correlation is 1/e [m].
    seed : tuple of int
        Seed and number of the realisation: equal ones give equal noise.

    Returns
    -------
    ndarray, shape (rows, columns)

    Examples
    --------
    >>> lattice = Lattice((100, 100), (5.0, 5.0), (0.0, 0.0))
    >>> noise = correlated_noise(lattice, 0.3, 20.0, (1, 2))
    >>> bool(0.2 < noise.std() < 0.4), bool(np.array_equal(noise, correlated_noise(lattice, 0.3, 20.0, (1, 2))))
    (True, True)
    """
    dx, dy = lattice.spacing
    spreads = [0.5 * length / step for step in (dy, dx)]
    margins = [int(TRUNCATED * spread + 0.5) for spread in spreads]
    shape = [count + 2 * margin for count, margin in zip(lattice.shape, margins, strict=True)]
    values = np.random.default_rng(seed).standard_normal(shape)
    for axis, (spread, margin) in enumerate(zip(spreads, margins, strict=True)):
        impulse = np.zeros(2 * margin + 1)
        impulse[margin] = 1.0
        gain = np.sqrt(np.sum(_filtered(impulse, spread, 0) ** 2))
        values = _filtered(values, spread, axis) / gain
    rows, columns = (slice(margin, margin + count) for margin, count in zip(margins, lattice.shape, strict=True))
    return rms * values[rows, columns]


def _filtered(values: np.ndarray, spread: float, axis: int) -> np.ndarray:
    return gaussian_filter1d(values, spread, axis=axis, mode="constant", truncate=TRUNCATED)
