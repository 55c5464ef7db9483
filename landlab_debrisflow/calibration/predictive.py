"""Means of maps over weighted members: sums of batches in their order, whatever the workers were."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np
import xarray as xr

from ..core.checks import in_range
from ..core.errors import InputError
from ..core.hints import did_you_mean
from ..ensemble import EnsembleResults, MemberResult
from ..ensemble.result import ARRIVAL
from ..record.attributes import axis_attributes, variable_attributes
from ..record.georeference import georeferenced
from .place import unit_of

Term = Callable[[MemberResult], np.ndarray]
"""Function of a member that returns an array over its window."""


def weighted_sums(
    results: Sequence[EnsembleResults], weights: np.ndarray, terms: Mapping[str, Term]
) -> dict[str, np.ndarray]:
    """Return sums over members of weight times array, each shape (rows, columns).

    Parameters
    ----------
    results : sequence of EnsembleResults
        Generations of one event in their order.
    weights : ndarray, shape (members of all generations,)
    terms : mapping of str to callable
        Arrays of a member over its window, by name.

    Returns
    -------
    dict of str to ndarray
    """
    shape = results[0].lattice.shape
    total = {name: np.zeros(shape) for name in terms}
    first = 0
    for generation in results:
        parts, batch = {name: np.zeros(shape) for name in terms}, 0
        for one in generation.members():
            if one.member // generation.batch != batch:
                for name, part in parts.items():
                    total[name] += part
                    part[...] = 0.0
                batch = one.member // generation.batch
            weight = weights[first + one.member]
            if weight > 0.0 and not one.error:
                for name, term in terms.items():
                    parts[name][one.rows, one.columns] += weight * term(one)
        for name, part in parts.items():
            total[name] += part
        first += generation.design.sizes["member"]
    return total


def predictive_maps(
    results: Sequence[EnsembleResults], weights: np.ndarray, thresholds: Mapping[str, float | Sequence[float]]
) -> xr.Dataset:
    """Return means of maps over weighted members, and probabilities that maps exceed thresholds.

    Parameters
    ----------
    results : sequence of EnsembleResults
    weights : ndarray, shape (members of all generations,)
        Sum 1.
    thresholds : mapping of str to float or sequence of float
        By the name of a map, in its unit; an empty sequence asks for the mean alone.

    Returns
    -------
    xarray.Dataset
        Over ``y`` and ``x``: ``mean_of_max_depth``, and ``probability_of_max_depth`` over ``max_depth_threshold``, too,
        named as in `hazard.hazard_maps`; of the arrival time the mean over members that reach a node, and
        ``probability_of_reached``.

    Raises
    ------
    InputError
        If a map was not kept, or a threshold is not finite.
    """
    kept, terms = results[0].maps, {}
    levels = {name: np.atleast_1d(np.asarray(values, float)) for name, values in thresholds.items()}
    for name, values in levels.items():
        if name not in kept:
            raise InputError(
                f"calibration: the map {name!r} was not kept{did_you_mean(name, kept)}; kept are "
                f"{', '.join(kept)}; name it in maps"
            )
        in_range(f"calibration: threshold of {name}", values, error=InputError)
        terms[f"{name} mean"] = _mean_term(name)
        if name == ARRIVAL:
            terms[f"{name} came"] = lambda one: np.isfinite(one.maps[ARRIVAL])
        for value in () if name == ARRIVAL else values:
            terms[f"{name} {value}"] = _above_term(name, value)
    sums, lattice = weighted_sums(results, weights, terms), results[0].lattice
    axes = {"y": lattice.y, "x": lattice.x}
    maps = xr.Dataset(coords={name: (name, axis, axis_attributes(name)) for name, axis in axes.items()})
    for name, values in levels.items():
        mean = sums[f"{name} mean"]
        if name == ARRIVAL:
            came = sums[f"{name} came"]
            mean = np.divide(mean, came, out=np.full(came.shape, np.nan), where=came > 0.0)
            maps["probability_of_reached"] = (
                ("y", "x"),
                came,
                variable_attributes("-", "probability that the flow comes"),
            )
        elif values.size:
            maps[f"{name}_threshold"] = f"{name}_threshold", values, {"units": unit_of(name)}
            data = np.stack([sums[f"{name} {value}"] for value in values])
            words = variable_attributes("-", f"probability that {name} exceeds a threshold")
            maps[f"probability_of_{name}"] = (f"{name}_threshold", "y", "x"), data, words
        maps[f"mean_of_{name}"] = ("y", "x"), mean, variable_attributes(unit_of(name), f"mean of {name}")
    return georeferenced(maps, lattice.crs)


def _mean_term(name: str) -> Term:
    return lambda one: np.nan_to_num(one.maps[name].astype(float))


def _above_term(name: str, value: float) -> Term:
    return lambda one: one.maps[name] > value
