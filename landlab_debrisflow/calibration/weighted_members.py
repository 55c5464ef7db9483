"""Weighted members of a calibration: values, intervals, scores."""

import json
from collections.abc import Mapping, Sequence
from functools import cached_property

import numpy as np
import xarray as xr

from ..core.errors import InputError
from ..core.hints import did_you_mean
from ..ensemble import EnsembleResults
from .criteria import Criterion, Likelihood
from .event import EventRuns, Prior
from .intervals import weighted_quantiles
from .sampler import Sample
from .scores import Members, Score, score_members


class WeightedMembers:
    """Members of all generations of a calibration with their weights.

    Parameters
    ----------
    sample : Sample
    prior : Prior
    runs : tuple of EventRuns
        Events in their order.
    results : mapping of str to sequence of EnsembleResults
        Generations by event.
    criterion : Criterion

    Attributes
    ----------
    sample, prior, runs, results, criterion
        As the parameters.
    """

    def __init__(
        self, sample: Sample, prior: Prior, runs: tuple[EventRuns, ...],
        results: Mapping[str, Sequence[EnsembleResults]], criterion: Criterion,
    ) -> None:  # fmt: skip
        self.sample, self.prior, self.runs, self.criterion = sample, prior, runs, criterion
        self.results = {name: list(generations) for name, generations in results.items()}

    @property
    def is_abc(self) -> bool:
        """Whether the result is approximate Bayesian computation, without stated errors."""
        return not isinstance(self.criterion, Likelihood)

    @property
    def weights(self) -> np.ndarray:
        """Weights of the members of all generations, shape (members,); sum 1."""
        return self.sample.level.weights

    @property
    def effective_size(self) -> float:
        """Effective sample size of the weights [-]."""
        return self.sample.level.size

    @property
    def best(self) -> int:
        """Number of the member with the largest weight without the proposal: likelihood, or the least distance."""
        return self.criterion.best(self.sample.misfits)

    @cached_property
    def members(self) -> xr.Dataset:
        """Values of all members over ``member``, with ``weight``, ``generation``, and ``misfit`` over observations."""
        design = self.prior.design(self.sample.uniform).drop_vars("replicate")
        labels = [f"{one.name}: {each.label}" if one.name else each.label for one in self.runs for each in one.bound]
        return design.assign_coords(observation=labels).assign(
            weight=("member", self.weights, {"long_name": "posterior weight"}),
            generation=("member", self.sample.generation),
            misfit=(("member", "observation"), self.sample.misfits, {"long_name": "simulated less observed"}),
        )

    def quantile(self, probability: float | Sequence[float]) -> dict[str, np.ndarray]:
        """Return quantiles of the posterior by dotted name, in the units of the values.

        Parameters
        ----------
        probability : float or sequence of float
            In [0, 1].

        Returns
        -------
        dict of str to ndarray
            Of the shape of `probability`; words, files and realisations of noise have none.
        """
        columns = {self.members[name].attrs["key"]: self.members[name] for name in self._columns()}
        return {
            key: weighted_quantiles(values.values, self.weights, np.asarray(probability, float))
            for key, values in columns.items() if not {"choices", "rms"} & set(values.attrs)
        }  # fmt: skip

    def interval(self, part: float = 0.9) -> dict[str, tuple[float, float]]:
        """Return the intervals between equal tails that hold a part of the posterior, by dotted name.

        Parameters
        ----------
        part : float
            In (0, 1) [-].

        Returns
        -------
        dict of str to tuple of float
        """
        if not 0.0 < part < 1.0:
            raise InputError(f"calibration: the part of an interval must lie in (0, 1), got {part!r}")
        found = self.quantile([0.5 * (1.0 - part), 0.5 * (1.0 + part)])
        return {key: (float(low), float(high)) for key, (low, high) in found.items()}

    def probabilities(self, key: str) -> dict[str, float]:
        """Return the posterior probabilities of the different values of a list of choices.

        Parameters
        ----------
        key : str
            Dotted name.

        Returns
        -------
        dict of str to float
            By the value as text.
        """
        names = {self.members[name].attrs["key"]: name for name in self._columns()}
        if key not in names:
            raise InputError(
                f"calibration: {key!r} does not vary{did_you_mean(key, names)}; varied: {', '.join(names)}"
            )
        values = self.members[names[key]]
        choices = json.loads(values.attrs["choices"]) if "choices" in values.attrs else None
        found: dict[str, float] = {}
        for value, weight in zip(values.values.tolist(), self.weights, strict=True):
            text = str(value if choices is None else choices[value])
            found[text] = found.get(text, 0.0) + float(weight)
        return found

    def scores(self, event: str | None = None) -> list[Score]:
        """Return scores of posterior, best member and prior against the observations of an event.

        Parameters
        ----------
        event : str, optional
            Name of the event, where there are several.

        Returns
        -------
        list of Score
        """
        runs = self.event(event)
        return score_members(runs, {
            "posterior": self.members_of(runs.name, self.weights),
            "best member": self.members_of(runs.name, np.eye(self.weights.size)[self.best]),
            "prior": self.members_of(runs.name, self.prior_weights),
        })  # fmt: skip

    @property
    def prior_weights(self) -> np.ndarray:
        """Weights of the prior, on the first generation alone, shape (members,)."""
        first = self.sample.generation == 0
        return first / first.sum()

    def event(self, name: str | None) -> EventRuns:
        """Return the runs of an event by its name, or of the only event without a name."""
        known = [one.name for one in self.runs]
        if name is None and len(known) == 1:
            return self.runs[0]
        if name not in known:
            raise InputError(f"calibration: event must be one of {', '.join(known)}, got {name!r}")
        return self.runs[known.index(name)]

    def columns_of(self, name: str) -> slice:
        """Return the observations of an event as a slice of all misfits."""
        first = 0
        for one in self.runs:
            if one.name == name:
                break
            first += len(one.bound)
        return slice(first, first + len(self.event(name).bound))

    def members_of(self, name: str, weights: np.ndarray) -> Members:
        """Return the members of an event with weights."""
        return Members(self.results[name], weights, self.sample.misfits[:, self.columns_of(name)])

    def _columns(self) -> list[str]:
        return [str(name) for name, values in self.members.data_vars.items() if "key" in values.attrs]
