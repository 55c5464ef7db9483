"""Members that count in a hazard map: how many came to their end, and how the sampling error is told."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ..core.errors import InputError
from ..ensemble import EnsembleResults, MemberResult
from .errors import LEAST_REPLICATES, Estimate, from_replicates, wilson, without_error

REPLICATED = "latin_hypercube", "sobol"

REASONS = {
    "factorial": "a factorial design is no sample: probabilities are shares of its combinations, which count equally",
    "table": "whether the members of a table are a random sample is not known; with independent=True their error is "
    "Wilson's",
    "saltelli": "members of a saltelli design share their values; draw a latin_hypercube for a sampling error",
}
"""Why there is no sampling error, by sampling."""


class Census(NamedTuple):
    """Members of an ensemble that count.

    Attributes
    ----------
    sampling : str
    members : int
        Members of the ensemble.
    failed, missing : int
        Members that failed, and that have not been run yet.
    group : ndarray of int, shape (members,)
        Number of the replicate that a member counts in; all 0 where the error is not told from replicates.
    trials : ndarray of int, shape (groups,)
        Members of each replicate that came to their end.
    method : {"wilson", "replicates", ""}
        How the sampling error is told; "" if none is.
    reason : str
        Why no sampling error is told.
    """

    sampling: str
    members: int
    failed: int
    missing: int
    group: np.ndarray
    trials: np.ndarray
    method: str
    reason: str

    @property
    def completed(self) -> int:
        """Members that came to their end, of which shares are probabilities."""
        return int(self.trials.sum())

    def estimate(self, counts: np.ndarray) -> Estimate:
        """Return the probability of an event with its sampling error.

        Parameters
        ----------
        counts : ndarray of int, shape (groups, ...)
            Members of each replicate in which the event came.

        Returns
        -------
        Estimate
        """
        if self.method == "replicates":
            some = self.trials > 0
            return from_replicates(counts[some], self.trials[some])
        if self.method == "wilson":
            return wilson(counts.sum(axis=0), self.completed)
        return without_error(counts.sum(axis=0), self.completed)


def take_census(results: EnsembleResults, independent: bool | None = None) -> Census:
    """Return the members of an ensemble that count, and how the sampling error of their shares is told.

    Parameters
    ----------
    results : EnsembleResults
    independent : bool, optional
        Whether the members are an independent random sample; by default known from the sampling. For a table.

    Returns
    -------
    Census

    Raises
    ------
    InputError
        If no member has come to its end.
    """
    done, replicate = results.done, results.replicates
    counted = done.copy()
    failures = results.failures
    counted[[one.member for one in failures]] = False
    if not counted.any():
        first = f"; the first error: {failures[0].error}" if failures else "; run the ensemble first"
        raise InputError(
            f"hazard: none of the {done.size} members has come to its end, {len(failures)} have failed{first}"
        )
    method, reason = _method(results.sampling, np.unique(replicate[counted]).size, independent)
    group = replicate if method == "replicates" else np.zeros(done.size, int)
    trials = np.bincount(group[counted], minlength=int(group.max()) + 1)
    return Census(
        results.sampling, done.size, len(failures), int((~done).sum()), group, trials, method, reason
    )  # fmt: skip


def completed_members(results: EnsembleResults) -> Iterator[MemberResult]:
    """Yield the members that came to their end, one batch of maps in memory at a time."""
    return (one for one in results.members() if not one.error)


def _method(sampling: str, replicates: int, independent: bool | None) -> tuple[str, str]:
    if sampling == "random" or (independent and sampling == "table"):
        return "wilson", ""
    if sampling in REPLICATED:
        if replicates >= LEAST_REPLICATES:
            return "replicates", ""
        return "", (
            f"the sampling error of {sampling} is told by the scatter of {LEAST_REPLICATES} replicates or more, there "
            f"{'is' if replicates == 1 else 'are'} {replicates}; run more members"
        )
    return "", REASONS[sampling]
