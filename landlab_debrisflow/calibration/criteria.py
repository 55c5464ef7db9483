"""Criteria by which members are weighted: the likelihood of stated errors, or a tolerance on a distance."""

from typing import NamedTuple, Protocol

import numpy as np

from ..core.errors import InputError
from .model_error import ErrorModel
from .proposal import effective_size

BISECTIONS = 60
"""Halvings with which the exponent of a likelihood is found: its rounding is reached."""


class Level(NamedTuple):
    """Weights of all members at one step of a calibration.

    Attributes
    ----------
    value : float
        Exponent of the likelihood, in [0, 1], or tolerance of the distance [-].
    weights : ndarray, shape (members,)
        Sum 1.
    """

    value: float
    weights: np.ndarray

    @property
    def size(self) -> float:
        """Effective sample size [-]."""
        return effective_size(self.weights)


class Criterion(Protocol):
    """Rule that turns misfits into weights."""

    def relaxed(self, misfits: np.ndarray, log_ratio: np.ndarray, size: float) -> Level:
        """Return the strictest level whose effective sample size is still `size`.

        Parameters
        ----------
        misfits : ndarray, shape (members, observations)
            Simulated less observed, in the units of the observations; NaN after a failure, inf where nothing came.
        log_ratio : ndarray, shape (members,)
            Logarithm of prior over proposal.
        size : float
        """
        ...

    def final(self, misfits: np.ndarray, log_ratio: np.ndarray, size: float) -> Level:
        """Return the level of the posterior; parameters as of `relaxed`."""
        ...

    def best(self, misfits: np.ndarray) -> int:
        """Return the number of the best member."""
        ...

    def of_observations(self, columns: list[int]) -> "Criterion":
        """Return the criterion of some of the observations, by their numbers."""
        ...


class Likelihood:
    """Likelihood of stated errors, raised to an exponent that grows from 0 to 1 (Del Moral, Doucet & Jasra 2006).

    Parameters
    ----------
    errors : ErrorModel

    Attributes
    ----------
    errors : ErrorModel
    """

    def __init__(self, errors: ErrorModel):
        self.errors = errors

    def relaxed(self, misfits: np.ndarray, log_ratio: np.ndarray, size: float) -> Level:
        """Return the level of the largest exponent that leaves an effective sample size, as `Criterion` says."""
        log_likelihood = self.errors.log_likelihood(misfits)
        _check_reached(log_likelihood)
        strict = _level(1.0, log_ratio, log_likelihood)
        if strict.size >= size:
            return strict
        loose = _level(0.0, log_ratio, log_likelihood)
        size = min(size, 0.5 * loose.size)
        low, high = 0.0, 1.0
        for _ in range(BISECTIONS):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if _level(middle, log_ratio, log_likelihood).size >= size else (low, middle)
        return _level(low, log_ratio, log_likelihood)

    def final(self, misfits: np.ndarray, log_ratio: np.ndarray, size: float) -> Level:
        """Return the level of the whole likelihood."""
        log_likelihood = self.errors.log_likelihood(misfits)
        _check_reached(log_likelihood)
        return _level(1.0, log_ratio, log_likelihood)

    def best(self, misfits: np.ndarray) -> int:
        """Return the number of the member with the largest likelihood."""
        return int(np.argmax(self.errors.log_likelihood(misfits)))

    def of_observations(self, columns: list[int]) -> "Likelihood":
        """Return the likelihood of some of the observations, by their numbers."""
        return Likelihood(self.errors.of_observations(columns))


class Tolerance:
    """Largest distance of members that count: approximate Bayesian computation (Beaumont et al. 2009).

    The distance is the root mean square of the misfits over observations, each over its median absolute deviation
    between the members of the first generation, which are drawn from the prior.

    Parameters
    ----------
    first : int
        Number of members of the first generation.
    labels : sequence of str
        Names of the observations, for messages.
    """

    def __init__(self, first: int, labels: list[str]):
        self._first, self._labels = first, labels

    def distances(self, misfits: np.ndarray) -> np.ndarray:
        """Return the distance of each member, shape (members,) [-]; inf after a failure.

        Parameters
        ----------
        misfits : ndarray, shape (members, observations)
            Those of the first generation come first.
        """
        own = np.where(np.isfinite(misfits[: self._first]), misfits[: self._first], np.nan)
        known = np.isfinite(own).any(axis=0)
        scale = np.zeros(own.shape[1])
        scale[known] = np.nanmedian(abs(own[:, known] - np.nanmedian(own[:, known], axis=0)), axis=0)
        for label, value in zip(self._labels, scale, strict=True):
            if not value > 0.0:
                raise InputError(
                    f"calibration: {label} is equal in half of the members drawn from the prior, or missing: no "
                    "distance can be told; leave it out, or state its error sd"
                )
        squares = np.where(np.isnan(misfits), np.inf, misfits / scale) ** 2
        found: np.ndarray = np.sqrt(np.mean(squares, axis=1))
        return found

    def relaxed(self, misfits: np.ndarray, log_ratio: np.ndarray, size: float) -> Level:
        """Return the level of the least tolerance that leaves an effective sample size, as `Criterion` says."""
        distances = self.distances(misfits)
        order = np.argsort(distances, kind="stable")
        weights = np.exp(log_ratio - log_ratio.max())
        sums, squares = np.cumsum(weights[order]), np.cumsum(weights[order] ** 2)
        enough = np.flatnonzero(np.isfinite(distances[order]) & (sums**2 / squares >= size))
        finite = np.flatnonzero(np.isfinite(distances[order]))
        _check_reached(np.where(np.isfinite(distances), 0.0, -np.inf))
        last = order[enough[0] if enough.size else finite[-1]]
        counted = np.where(distances <= distances[last], weights, 0.0)
        return Level(float(distances[last]), counted / counted.sum())

    def final(self, misfits: np.ndarray, log_ratio: np.ndarray, size: float) -> Level:
        """Return the level of the posterior: of the least tolerance that leaves twice the effective sample size."""
        return self.relaxed(misfits, log_ratio, 2.0 * size)

    def best(self, misfits: np.ndarray) -> int:
        """Return the number of the member with the least distance."""
        return int(np.argmin(self.distances(misfits)))

    def of_observations(self, columns: list[int]) -> "Tolerance":
        """Return the tolerance of some of the observations, by their numbers."""
        return Tolerance(self._first, [self._labels[k] for k in columns])


def _level(exponent: float, log_ratio: np.ndarray, log_likelihood: np.ndarray) -> Level:
    inside = np.isfinite(log_likelihood)
    logs = np.where(inside, log_ratio + exponent * np.where(inside, log_likelihood, 0.0), -np.inf)
    weights = np.exp(logs - logs.max())
    return Level(exponent, weights / weights.sum())


def _check_reached(logs: np.ndarray) -> None:
    if not np.isfinite(logs).any():
        raise InputError(
            f"calibration: none of {logs.size} members has a value at every observation: runs failed, or nothing came "
            "there; widen the distributions, or leave out the observation that is not reached"
        )
