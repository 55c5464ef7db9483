"""Maps of probabilities and quantiles over the members of an ensemble."""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ..core.version import __version__
from ..ensemble import EnsembleResults
from ..grid.fields import NODE_FIELDS, OUTPUT_PREFIX
from ..record.attributes import axis_attributes, file_attributes, quantity_attributes, variable_attributes
from ..record.georeference import georeferenced
from ..record.written_maps import LEAST_DEPTH
from .bins import PER_DECADE, RANGES
from .census import Census, completed_members, take_census
from .counting import REACHED, EventCounts, Histogram, above, without_films
from .errors import CONFIDENCE, Estimate
from .quantiles import quantile_maps
from .questions import QUANTILES, check_questions
from .scale import HazardScale, check_scale, class_events

FIELDS = {field.name.removeprefix(OUTPUT_PREFIX): field for field in NODE_FIELDS}

PARTS = {
    "": "probability that {}", "_standard_error": "standard error of the probability that {}",
    "_low": "lower end of the interval of the probability that {}",
    "_high": "upper end of the interval of the probability that {}",
}  # fmt: skip
"""Endings of the variables of a probability, and their meanings."""


def hazard_maps(
    results: EnsembleResults | str | os.PathLike[str],
    thresholds: Mapping[str, Any] | None = None,
    quantiles: Any = QUANTILES,
    *,
    least_depth: float = LEAST_DEPTH,
    scale: HazardScale | None = None,
    independent: bool | None = None,
) -> xr.Dataset:
    """Return probabilities and quantiles of the maps of an ensemble at every node, with their sampling errors.

    Members that failed, or that have not been run yet, are left out: probabilities are shares of the members that came
    to their end. The sampling error is Wilson's interval where the sampling is random. That of a Latin hypercube and of
    Sobol's sequence comes from the scatter of at least eight replicates; other designs have none, and the attribute
    ``no_sampling_error`` says why.

    Quantiles come from counts in fixed bins, 24 in a decade: they are the geometric middle of a bin, whose edges lie
    5 % below and above. Their interval is that between the members of two ranks, which holds the quantile of a random
    sample in 95 % of all samples.

    Parameters
    ----------
    results : EnsembleResults, str or Path
        Results of an ensemble, or its store; finished or not.
    thresholds : mapping of str to sequence of float, optional
        By the name of a map, in its unit, such as ``{"max_depth": [0.5, 1.0]}``.
    quantiles : sequence of float
        Shares of the members, in (0, 1).
    least_depth : float
        Members in which the flow at a node was never as deep leave no peak there [m].
    scale : HazardScale, optional
        Hazard classes whose probabilities are wanted, too.
    independent : bool, optional
        For a table of members: whether they are an independent random sample.

    Returns
    -------
    xarray.Dataset
        Over ``y`` and ``x``: ``probability_of_max_depth`` over ``max_depth_threshold`` and so on, with endings
        ``_standard_error``, ``_low`` and ``_high``; ``probability_of_reached``; ``quantile_of_max_depth`` over
        ``quantile``, with ``_low`` and ``_high``, of the arrival time among the members that reach a node;
        ``probability_of_class`` over ``hazard_class``: that class or a more severe one.

    Raises
    ------
    InputError
        If the store cannot be read, or no member has come to its end.
    ParameterError
        If a map is not kept, thresholds do not increase, or a quantile is not in (0, 1).
    """
    results = results if isinstance(results, EnsembleResults) else EnsembleResults.open(Path(results))
    asked = check_questions(results.maps, thresholds, quantiles, least_depth)
    if scale is not None:
        check_scale(scale, results.maps)
    census, shape = take_census(results, independent), results.lattice.shape
    events = [REACHED, *(above(name, bound) for name, bounds in asked.thresholds.items() for bound in bounds)]
    if scale is not None:
        events += class_events(scale)
    counts = EventCounts(events, shape, census.trials.size, census.members)
    histograms = [Histogram(name, shape, census.members) for name in results.maps if name in RANGES]
    for member in completed_members(results):
        values = without_films(member, asked.least_depth)
        counts.add(int(census.group[member.member]), member, values)
        for histogram in histograms:
            histogram.add(member, values)
    found = _probabilities(census, counts, asked.thresholds, scale)
    for histogram in histograms:
        field = FIELDS[histogram.name]
        found |= quantile_maps(histogram, asked.quantiles, census, field.doc, field.unit)
    x, y = results.lattice.x, results.lattice.y
    axes = {"y": ("y", y, axis_attributes("y")), "x": ("x", x, axis_attributes("x"))}
    dataset = xr.Dataset(found, axes | _coordinates(asked.thresholds, asked.quantiles, scale))
    return georeferenced(
        dataset.assign_attrs(_attributes(results, census, asked.least_depth, scale)), results.lattice.crs
    )


def _probabilities(
    census: Census, counts: EventCounts, thresholds: Mapping[str, tuple[float, ...]], scale: HazardScale | None
) -> dict[str, Any]:
    """Return the variables of all probabilities."""
    estimates = [census.estimate(counts.counts[:, k]) for k in range(len(counts.events))]
    found, k = _variables("probability_of_reached", ("y", "x"), estimates[0], "the flow comes"), 1
    for name, bounds in thresholds.items():
        several = _stacked(estimates[k : k + len(bounds)])
        words = f"{FIELDS[name].doc} exceeds a threshold"
        found |= _variables(f"probability_of_{name}", (f"{name}_threshold", "y", "x"), several, words)
        k += len(bounds)
    if scale is not None:
        words = f"a hazard class of {scale.name}, or a more severe one, is reached"
        found |= _variables("probability_of_class", ("hazard_class", "y", "x"), _stacked(estimates[k:]), words)
    return found


def _stacked(estimates: list[Estimate]) -> Estimate:
    return Estimate(*(np.stack(parts) for parts in zip(*estimates, strict=True)))


def _variables(name: str, dims: tuple[str, ...], estimate: Estimate, words: str) -> dict[str, Any]:
    return {
        name + ending: (dims, part.astype(np.float32), variable_attributes("-", meaning.format(words)))
        for (ending, meaning), part in zip(PARTS.items(), estimate, strict=True)
    }


def _coordinates(
    thresholds: Mapping[str, tuple[float, ...]], quantiles: tuple[float, ...], scale: HazardScale | None
) -> dict[str, Any]:
    found: dict[str, Any] = {
        "quantile": ("quantile", list(quantiles), variable_attributes("-", "share of the members"))
    }
    for name, bounds in thresholds.items():
        words = variable_attributes(FIELDS[name].unit, f"threshold of {FIELDS[name].doc}")
        found[f"{name}_threshold"] = (f"{name}_threshold", list(bounds), words)
    if scale is not None:
        names = [one.name for one in scale.classes]
        found["hazard_class"] = ("hazard_class", names, {"long_name": f"hazard class of {scale.name}"})
    return found


def _attributes(
    results: EnsembleResults, census: Census, least_depth: float, scale: HazardScale | None
) -> dict[str, Any]:
    told = {"wilson": "Wilson's score interval", "replicates": "scatter between replicates", "": "none"}[census.method]
    found = file_attributes() | {
        "title": f"hazard of {results.scene.get('name') or 'an ensemble'}", "ensemble_digest": results.digest,
        "sampling": census.sampling, "sampling_error": told, "version": __version__,
    }  # fmt: skip
    numbers = {
        "members": census.members, "members_completed": census.completed, "members_failed": census.failed,
        "members_not_run": census.missing, "failed_share": census.failed / (census.failed + census.completed),
        "replicates": int((census.trials > 0).sum()) if census.method == "replicates" else 1, "confidence": CONFIDENCE,
        "bins_per_decade": PER_DECADE,
    }  # fmt: skip
    found |= {
        name: value for key, number in numbers.items() for name, value in quantity_attributes(key, number).items()
    }
    found |= quantity_attributes("least_depth", least_depth, "m")
    if census.reason:
        found["no_sampling_error"] = census.reason
    if census.missing:
        found["remark"] = f"{census.missing} of {census.members} members have not been run yet"
    if scale is not None:
        found |= {"hazard_scale": scale.name, "hazard_scale_source": scale.source}
    return found
