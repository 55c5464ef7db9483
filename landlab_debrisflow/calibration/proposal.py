"""Proposals of a calibration: normal kernels around weighted members and a part of the prior, in normal scores."""

from typing import NamedTuple

import numpy as np
from scipy import spatial, special, stats

from ..ensemble.distributions import ENDS

DEFENSIVE = 0.1
"""Part of a proposal that is the prior: weights of prior over proposal stay below its inverse."""

LEAST_VARIANCE = 1e-8
"""Variance that is added to that of the kernels, in units of the prior's: members may be alike."""


def normal_scores(uniform: np.ndarray) -> np.ndarray:
    """Return the normal scores of points of the unit cube, of the same shape; uniform points have standard normal ones.

    Parameters
    ----------
    uniform : ndarray, shape (n, dimensions)
        Coordinates in [0, 1).
    """
    scores: np.ndarray = special.ndtri(np.clip(uniform, *ENDS))
    return scores


def log_prior(scores: np.ndarray) -> np.ndarray:
    """Return the logarithm of the prior density in normal scores, shape (n,).

    Parameters
    ----------
    scores : ndarray, shape (n, dimensions)
    """
    density: np.ndarray = stats.norm.logpdf(scores).sum(axis=1)
    return density


class Proposal(NamedTuple):
    """Mixture of normal kernels of one covariance and of the prior, in normal scores.

    Attributes
    ----------
    centres : ndarray, shape (kernels, dimensions)
    weights : ndarray, shape (kernels,)
        Sum 1.
    root : ndarray, shape (dimensions, dimensions)
        Lower Cholesky factor of the covariance of a kernel.
    """

    centres: np.ndarray
    weights: np.ndarray
    root: np.ndarray

    @classmethod
    def around(cls, scores: np.ndarray, weights: np.ndarray) -> "Proposal":
        """Return the proposal around weighted members.

        The kernels have the covariance of the members times the square of Silverman's (1986, section 4.3.2) bandwidth
        (4 / ((d + 2) n))^(1 / (d + 4)), where n is the effective sample size.

        Parameters
        ----------
        scores : ndarray, shape (n, dimensions)
        weights : ndarray, shape (n,)
            Sum 1.

        Returns
        -------
        Proposal
        """
        kept = weights > 0.0
        scores, weights = scores[kept], weights[kept] / weights[kept].sum()
        dimensions = scores.shape[1]
        off = scores - weights @ scores
        covariance = (weights[:, None] * off).T @ off
        bandwidth = (4.0 / ((dimensions + 2.0) * effective_size(weights))) ** (1.0 / (dimensions + 4.0))
        root = np.linalg.cholesky(bandwidth**2 * covariance + LEAST_VARIANCE * np.eye(dimensions))
        return cls(scores, weights, root)

    def draw(self, count: int, random: np.random.Generator) -> np.ndarray:
        """Draw points of the unit cube.

        Parameters
        ----------
        count : int
        random : numpy.random.Generator

        Returns
        -------
        ndarray, shape (count, dimensions)
            The first ones are drawn from the prior, as many as its part of the mixture.
        """
        free, dimensions = prior_count(count), self.centres.shape[1]
        centre = self.centres[systematic(self.weights, count - free, random)]
        near = centre + random.standard_normal(centre.shape) @ self.root.T
        scores = np.concatenate([random.standard_normal((free, dimensions)), near])
        return np.clip(special.ndtr(scores), 0.0, np.nextafter(1.0, 0.0))

    def log_density(self, scores: np.ndarray, count: int) -> np.ndarray:
        """Return the logarithm of the density of a draw of `count` points at given normal scores, shape (n,).

        Parameters
        ----------
        scores : ndarray, shape (n, dimensions)
        count : int
            Number of points of the draw, of which a whole number is from the prior.
        """
        part = prior_count(count) / count
        whitened = [np.linalg.solve(self.root, each.T).T for each in (scores, self.centres)]
        squares = spatial.distance.cdist(*whitened, "sqeuclidean")
        norm = 0.5 * scores.shape[1] * np.log(2.0 * np.pi) + np.log(np.diag(self.root)).sum()
        kernels = special.logsumexp(np.log(self.weights) - 0.5 * squares, axis=1) - norm
        found: np.ndarray = np.logaddexp(np.log(part) + log_prior(scores), np.log1p(-part) + kernels)
        return found


def prior_count(count: int) -> int:
    """Return how many of the points of a proposal are drawn from the prior, at least one."""
    return max(1, round(DEFENSIVE * count))


def systematic(weights: np.ndarray, count: int, random: np.random.Generator) -> np.ndarray:
    """Return indices drawn by systematic resampling, each n w times to within one (Kitagawa 1996), shape (count,).

    Parameters
    ----------
    weights : ndarray, shape (n,)
        Sum 1.
    count : int
    random : numpy.random.Generator

    Examples
    --------
    >>> systematic(np.array([0.25, 0.0, 0.75]), 4, np.random.default_rng(0)).tolist()
    [0, 2, 2, 2]
    """
    ends = np.cumsum(weights)
    at = (np.arange(count) + random.random()) / count
    return np.minimum(np.searchsorted(ends / ends[-1], at, side="right"), len(weights) - 1)


def effective_size(weights: np.ndarray) -> float:
    """Return the effective sample size of weights, (sum w)^2 / sum w^2 (Kong 1992); 0 if all are zero.

    Examples
    --------
    >>> effective_size(np.array([0.5, 0.5, 0.0]))
    2.0
    """
    squares = float(np.sum(weights**2))
    return float(np.sum(weights)) ** 2 / squares if squares > 0.0 else 0.0
