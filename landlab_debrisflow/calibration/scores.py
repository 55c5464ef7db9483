"""Scores of weighted members against the observations of an event."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from ..ensemble import EnsembleResults
from .agreement import correlation, csi
from .event import EventRuns
from .observed_maps import DepositOutline, ElevationChange
from .place import Place
from .predictive import weighted_sums

SEEDS = 8
"""Realisations of the noise of a survey, over which scores of a perfect model are averaged."""


class Members(NamedTuple):
    """Members of an event with weights.

    Attributes
    ----------
    results : sequence of EnsembleResults
    weights : ndarray, shape (members,)
        Sum 1.
    misfits : ndarray, shape (members, observations)
    """

    results: Sequence[EnsembleResults]
    weights: np.ndarray
    misfits: np.ndarray


class Score(NamedTuple):
    """Score of several sets of members.

    Attributes
    ----------
    name : str
    unit : str
    values : dict of str to float
        By the name of the set.
    reference : float
        Value of a perfect model, or observed value; NaN: not known.
    meaning : str
        Meaning of the reference.
    """

    name: str
    unit: str
    values: dict[str, float]
    reference: float
    meaning: str

    def words(self) -> str:
        """Return the score as a line."""
        unit = "" if self.unit == "-" else f" {self.unit}"
        found = ", ".join(f"{name} {value:.3g}" for name, value in self.values.items())
        return f"{found}{unit}" + ("" if np.isnan(self.reference) else f"; {self.meaning} {self.reference:.3g}{unit}")


def score_members(runs: EventRuns, sets: dict[str, Members]) -> list[Score]:
    """Return the scores of sets of members: misfits of all observations, and agreement of maps.

    Parameters
    ----------
    runs : EventRuns
    sets : dict of str to Members

    Returns
    -------
    list of Score
    """
    scores = []
    for k, bound in enumerate(runs.bound):
        values = {name: rms(one.misfits[:, k], one.weights) for name, one in sets.items()}
        floor = np.nan if bound.stated is None else bound.stated.sd
        unit = bound.unit if bound.unit != "-" else _unit_of_measure(bound.label, next(iter(sets.values())))
        scores.append(Score(f"misfit of {bound.label}", unit, values, floor, "noise floor"))
    for one in runs.observations:
        if isinstance(one, ElevationChange):
            observed = one.observed(runs.place)
            maps = {name: mean_change(members, runs.place) for name, members in sets.items()}
            scores += _change_scores(one, observed, maps, runs.place)
        if isinstance(one, DepositOutline):
            scores.append(_outline_score(one, sets, runs.place))
    return scores


def rms(misfits: np.ndarray, weights: np.ndarray) -> float:
    """Return the root mean square of weighted misfits; failures do not count, inf where nothing came.

    Parameters
    ----------
    misfits, weights : ndarray, shape (members,)

    Examples
    --------
    >>> rms(np.array([3.0, np.nan, -3.0]), np.array([0.25, 0.5, 0.25]))
    3.0
    """
    known = ~np.isnan(misfits) & (weights > 0.0)
    if not known.any():
        return float("nan")
    return float(np.sqrt(np.average(misfits[known] ** 2, weights=weights[known])))


def mean_change(members: Members, place: Place) -> np.ndarray:
    """Return the mean change of elevation over weighted members, shape (rows, columns) [m].

    Parameters
    ----------
    members : Members
    place : Place
    """
    sums = weighted_sums(
        members.results, members.weights,
        {"change": lambda one: one.maps["deposit_depth"].astype(float) + one.maps["depth"] - one.maps["eroded_depth"]},
    )  # fmt: skip
    released = np.concatenate([one.measures["budget_released"].values for one in members.results])
    known = np.isfinite(released)
    weights = members.weights[known] / members.weights[known].sum()
    if not place.released.any():
        return sums["change"]
    change: np.ndarray = sums["change"] - place.released * (weights @ released[known]) / place.volume
    return change


def _unit_of_measure(label: str, members: Members) -> str:
    """Return the unit of an observed measure, which only runs know; "-" for none."""
    known = members.results[0].measures
    unit = str(known[label].attrs["units"]) if label in known else "1"
    return "-" if unit == "1" else unit


def _change_scores(
    one: ElevationChange, observed: np.ndarray, maps: dict[str, np.ndarray], place: Place
) -> Iterator[Score]:
    """Yield index, correlation and lowered volume outside of the release and inside."""
    known, source = np.isfinite(observed), place.released > 0.0
    for words, region in (("outside of the release", known & ~source), ("inside the release", known & source)):
        if not region.any():
            continue
        seen = observed[region]
        found = {name: _measures(change[region], seen, one.threshold, place) for name, change in maps.items()}
        perfect = np.full(3, np.nan)
        if one.sd is not None:
            noise = [np.random.default_rng(seed).normal(0.0, one.sd, seen.shape) for seed in range(SEEDS)]
            perfect = np.mean([_measures(seen, seen + each, one.threshold, place) for each in noise], axis=0)
        lowered = float(np.maximum(-seen, 0.0).sum()) * place.lattice.area
        references = (perfect[0], "perfect model"), (perfect[1], "perfect model"), (lowered, "observed")
        for k, (name, unit) in enumerate((("CSI of change", "-"), ("correlation", "-"), ("volume lowered", "m3"))):
            values = {label: measures[k] for label, measures in found.items()}
            yield Score(f"{name} {words}", unit, values, *references[k])


def _measures(change: np.ndarray, seen: np.ndarray, threshold: float, place: Place) -> tuple[float, float, float]:
    here, there = abs(change) > threshold, abs(seen) > threshold
    lowered = float(np.maximum(-change, 0.0).sum()) * place.lattice.area
    return csi(here, there), correlation(change[here | there], seen[here | there]), lowered


def _outline_score(one: DepositOutline, sets: dict[str, Members], place: Place) -> Score:
    inside, values = one.inside(place) >= 0.5, {}
    for name, members in sets.items():
        terms = {"covered": lambda run: run.maps["deposit_depth"] + run.maps["depth"] > one.threshold}
        values[name] = csi(weighted_sums(members.results, members.weights, terms)["covered"] >= 0.5, inside)
    return Score("CSI of the deposit", "-", values, float("nan"), "")
