"""Thresholds and quantiles that a hazard map is asked for."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from ..core.checks import in_range
from ..core.errors import ParameterError
from ..core.hints import did_you_mean
from ..record.written_maps import LEAST_DEPTH

DEPTH, ARRIVAL = "max_depth", "arrival_time"

THRESHOLDS: dict[str, tuple[float, ...]] = {
    "max_depth": (0.5, 1.0, 2.0), "max_speed": (1.0, 3.0, 10.0), "max_impact_pressure": (3e3, 3e4, 1e5),
    "deposit_depth": (0.2, 0.5, 1.0),
}  # fmt: skip
"""Thresholds by default [m, m s-1, Pa, m]."""

QUANTILES = 0.05, 0.5, 0.95
"""Quantiles by default."""


class Questions(NamedTuple):
    """Thresholds and quantiles of a hazard map.

    Attributes
    ----------
    thresholds : dict of str to tuple of float
        Increasing, by map, in the unit of the map.
    quantiles : tuple of float
        Increasing, in (0, 1).
    least_depth : float
        Depth below which a flow leaves no peak [m].
    """

    thresholds: dict[str, tuple[float, ...]]
    quantiles: tuple[float, ...] = QUANTILES
    least_depth: float = LEAST_DEPTH


def check_questions(
    kept: Sequence[str], thresholds: Mapping[str, Any] | None, quantiles: Any, least_depth: float = LEAST_DEPTH
) -> Questions:
    """Return thresholds and quantiles that an ensemble can answer.

    Parameters
    ----------
    kept : sequence of str
        Names of the maps that the members have kept.
    thresholds : mapping of str to sequence of float, or None
        By map; None: those of `THRESHOLDS` whose maps are kept.
    quantiles : sequence of float
    least_depth : float
        [m]

    Returns
    -------
    Questions

    Raises
    ------
    ParameterError
        If a map is not kept, thresholds are not positive or do not increase, or a quantile is not in (0, 1).

    Examples
    --------
    >>> check_questions(["max_depth"], {"max_depth": 1}, [0.5]).thresholds
    {'max_depth': (1.0,)}
    """
    in_range("hazard: least_depth", least_depth, 0.0, unit="m")
    if DEPTH not in kept:
        raise ParameterError(
            f"hazard: the members have not kept {DEPTH}, which tells where the flow came; run the ensemble with it "
            f"(maps: [{DEPTH}, ...]); kept are {', '.join(kept)}"
        )
    if thresholds is None:
        return Questions(
            {name: bounds for name, bounds in THRESHOLDS.items() if name in kept},
            _increasing("quantiles", quantiles, 1.0), float(least_depth),
        )  # fmt: skip
    if not isinstance(thresholds, Mapping) or not thresholds:
        raise ParameterError(
            f"hazard: thresholds must be a mapping of maps to numbers, such as max_depth: [0.5, 1], got {thresholds!r}"
        )
    found = {}
    for name, bounds in thresholds.items():
        allowed = [one for one in kept if one != ARRIVAL]
        if name not in allowed:
            raise ParameterError(
                f"hazard: the members have kept no map {name!r} for thresholds{did_you_mean(name, allowed)}; there are "
                f"{', '.join(allowed)}; members keep others if the key maps of the ensemble names them before it runs"
            )
        found[str(name)] = _increasing(f"thresholds of {name}", bounds)
    return Questions(found, _increasing("quantiles", quantiles, 1.0), float(least_depth))


def _increasing(name: str, given: Any, below: float = np.inf) -> tuple[float, ...]:
    """Return positive numbers in increasing order."""
    values = given if isinstance(given, Iterable) and not isinstance(given, str) else [given]
    try:
        numbers = tuple(float(value) for value in values)
    except (TypeError, ValueError) as error:
        raise ParameterError(f"hazard: {name} must be numbers, got {given!r:.60}") from error
    if not numbers:
        raise ParameterError(f"hazard: {name} must be at least one number, got none")
    in_range(f"hazard: {name}", np.array(numbers), 0.0, below, open_ends=(True, True))
    if any(high <= low for low, high in pairwise(numbers)):
        raise ParameterError(f"hazard: {name} must increase, got {', '.join(f'{one:g}' for one in numbers)}")
    return numbers
