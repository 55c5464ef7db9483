"""Errors of observations and of the model, as a likelihood over misfits."""

import dataclasses
import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy import special, stats

from ..core.checks import in_range

NODES = 128
"""Quantiles of the prior of a model error over which a likelihood is averaged; each then has a 128th of the prior."""


@dataclasses.dataclass(frozen=True, eq=False)
class ModelError:
    """Error of the model of which a scale is known; several observations may share one.

    The standard deviation of the error has a half-normal prior, and the likelihood of every member is averaged over it,
    which needs no run (Kennedy & O'Hagan 2001 for the error of a model beside that of observations).

    Parameters
    ----------
    scale : float
        Standard deviation of the normal distribution of which the prior is the upper half, > 0, in the unit of the
        observation, or with `relative` over the size of the observation [-].
    relative : bool
        Whether the error is relative to the observed value (of a map: to its root mean square).
    """

    scale: float
    relative: bool = False

    def __post_init__(self):
        in_range("calibration: ModelError: scale", self.scale, 0.0, open_ends=(True, False))

    @property
    def deviations(self) -> np.ndarray:
        """Standard deviations at equal steps of the prior, shape (nodes,), in the unit of the scale."""
        found: np.ndarray = self.scale * stats.halfnorm.ppf((np.arange(NODES) + 0.5) / NODES)
        return found


class Stated(NamedTuple):
    """Stated error of an observation.

    Attributes
    ----------
    sd : float
        Standard deviation of the observation, in its unit.
    count : float
        Number of independent values of which a misfit is the root mean square; 1 of a single value.
    size : float
        Size of the observed value, for a relative error, in its unit.
    model_error : ModelError or None
    """

    sd: float
    count: float
    size: float
    model_error: ModelError | None

    @property
    def largest(self) -> float:
        """Standard deviation with an error of the model of its stated scale, in the unit of the observation."""
        if self.model_error is None:
            return self.sd
        return math.hypot(self.sd, self.model_error.scale * (self.size if self.model_error.relative else 1.0))


class ErrorModel:
    """Gaussian errors of observations, independent of each other, and of the model.

    Parameters
    ----------
    stated : sequence of Stated
        Errors in the order of the observations.
    """

    def __init__(self, stated: Sequence[Stated]):
        self._stated = list(stated)
        self._groups: dict[ModelError | int, list[int]] = {}
        for k, one in enumerate(self._stated):
            self._groups.setdefault(k if one.model_error is None else one.model_error, []).append(k)

    @property
    def count(self) -> float:
        """Number of independent values of all observations."""
        return float(sum(one.count for one in self._stated))

    def of_observations(self, columns: Sequence[int]) -> "ErrorModel":
        """Return the errors of some of the observations, by their numbers."""
        return ErrorModel([self._stated[k] for k in columns])

    def log_likelihood(self, misfits: np.ndarray) -> np.ndarray:
        """Return the logarithm of the likelihood of each member, shape (members,).

        Parameters
        ----------
        misfits : ndarray, shape (members, observations)
            Simulated less observed; NaN or inf have the likelihood 0.
        """
        total = np.zeros(len(misfits))
        for error, members in self._groups.items():
            total += special.logsumexp(self._of_group(error, members, misfits), axis=1)
        return np.where(np.isfinite(misfits).all(axis=1), total, -np.inf)

    def model_errors(self, misfits: np.ndarray, weights: np.ndarray) -> dict[int, tuple[float, float, float]]:
        """Return mean and 90 % interval of the posterior standard deviation of each model error.

        Parameters
        ----------
        misfits : ndarray, shape (members, observations)
        weights : ndarray, shape (members,)
            Posterior weights, sum 1.

        Returns
        -------
        dict of int to tuple of float
            By the number of the first observation that has the error: mean, 5 and 95 % quantile, in the unit of the
            scale.
        """
        found, counted = {}, weights > 0.0
        for error, observations in self._groups.items():
            if isinstance(error, ModelError):
                logs = self._of_group(error, observations, misfits[counted])
                parts = np.exp(logs - special.logsumexp(logs, axis=1, keepdims=True))
                density, deviations = weights[counted] @ parts, error.deviations
                ends = np.searchsorted(np.cumsum(density), [0.05, 0.95]).clip(max=NODES - 1)
                found[observations[0]] = (float(density @ deviations), *map(float, deviations[ends]))
        return found

    def chi_square(self, misfits: np.ndarray) -> np.ndarray:
        """Return squared misfits over the variance of the observation alone, shape (members, observations) [-].

        The expectation of a model without error is the number of independent values of each observation.

        Parameters
        ----------
        misfits : ndarray, shape (members, observations)
        """
        sd, count = (np.array([getattr(one, name) for one in self._stated]) for name in ("sd", "count"))
        found: np.ndarray = count * (misfits / sd) ** 2
        return found

    def _of_group(self, error: ModelError | int, observations: list[int], misfits: np.ndarray) -> np.ndarray:
        """Return log likelihoods at the nodes of a prior, weights of the nodes included, shape (members, nodes)."""
        deviations = error.deviations if isinstance(error, ModelError) else np.zeros(1)
        logs = np.full((len(misfits), deviations.size), -np.log(deviations.size))
        for k in observations:
            one = self._stated[k]
            factor = one.size if one.model_error is not None and one.model_error.relative else 1.0
            variance = one.sd**2 + (factor * deviations) ** 2
            square = np.where(np.isfinite(misfits[:, k]), misfits[:, k], 0.0)[:, None] ** 2
            logs -= 0.5 * one.count * (np.log(2.0 * np.pi * variance) + square / variance)
        return logs
