"""Distributions of the varied values: from scipy.stats, from lists of choices, or from plain values as in YAML."""

import json
import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, Protocol

import numpy as np
from scipy import stats

from ..core.errors import ParameterError
from ..core.hints import did_you_mean, python_value
from ..scene.zones import RASTERS, VECTORS, has_suffix
from .names import NOISE, Name

FORMS = {
    "normal": ("mean", "sd"), "uniform": ("low", "high"), "lognormal": ("median", "sigma"),
    "triangular": ("low", "mode", "high"), "truncated_normal": ("mean", "sd", "low", "high"),
}  # fmt: skip
"""Distributions that plain values may name, and their parameters; sigma is the standard deviation of the logarithm."""

NEGLIGIBLE = 1e-9
"""Largest part of a distribution that may lie outside of the bounds: one of a thousand ensembles of a million members
then has a member outside, which is a failure."""

ENDS = 2.0**-54, 1.0 - 2.0**-53
"""Cumulative probabilities nearest to 0 and 1 at which a quantile is taken: at 0 and 1 it may be infinite."""

REALISATIONS = 2**31
"""Number of different realisations of noise."""


class Distribution(Protocol):
    """Distribution of a varied value, as a function of uniform numbers."""

    def values_at(self, uniform: np.ndarray) -> np.ndarray:
        """Return the values whose cumulative probabilities are given in [0, 1), of the same shape; an index of choices.

        Parameters
        ----------
        uniform : ndarray, shape (n,)
        """
        ...


class Numbers(NamedTuple):
    """Distribution of numbers.

    Attributes
    ----------
    quantile : callable
        Inverse of the cumulative distribution.
    whole : bool
        Whether the values are integers.
    """

    quantile: Any
    whole: bool

    def values_at(self, uniform: np.ndarray) -> np.ndarray:
        """Return the values at cumulative probabilities, shape (n,)."""
        found = np.asarray(self.quantile(np.clip(uniform, *ENDS)), float)
        return np.rint(found).astype(np.int64) if self.whole else found


class Choices(NamedTuple):
    """Distribution over a list.

    Attributes
    ----------
    values : tuple
        Numbers, words, files, coordinates or mappings.
    probabilities : tuple of float
        Probability of each.
    """

    values: tuple[Any, ...]
    probabilities: tuple[float, ...]

    @property
    def numeric(self) -> bool:
        """Whether all values are numbers, which then stand in the design; else indices of the list do."""
        return all(isinstance(value, int | float) and not isinstance(value, bool) for value in self.values)

    def values_at(self, uniform: np.ndarray) -> np.ndarray:
        """Return the values, or their indices, at cumulative probabilities, shape (n,)."""
        ends = np.cumsum(self.probabilities)
        index = np.minimum(np.searchsorted(ends / ends[-1], uniform, side="right"), len(self.values) - 1)
        return np.asarray(self.values)[index] if self.numeric else index


class NoiseRealisations(NamedTuple):
    """Noise on the elevation, of which every member has a realisation of its own.

    Attributes
    ----------
    rms : float
        Root mean square [m].
    length : float
        Distance at which the correlation has fallen to 1/e [m].
    """

    rms: float
    length: float

    def values_at(self, uniform: np.ndarray) -> np.ndarray:
        """Return the numbers of realisations, shape (n,)."""
        return np.minimum((uniform * REALISATIONS).astype(np.int64), REALISATIONS - 1)


def distribution_of(name: Name, given: Any) -> Distribution:
    """Return the distribution of a value that a user gave as a distribution, list or mapping.

    Parameters
    ----------
    name : Name
        Value that varies, with its bounds.
    given : object
        Frozen distribution of `scipy.stats`, list, or mapping such as ``{"normal": {"mean": 28, "sd": 2}}``,
        ``{"choices": [...], "probabilities": [...]}`` and for noise ``{"rms": 0.3, "length": 20}``.

    Returns
    -------
    Distribution

    Raises
    ------
    ParameterError
        If it is none of these, or if it leaves the bounds of the value; the message names the part outside.
    """
    label = f"ensemble: vary: {name.key}"
    if name.path[-1] == NOISE:
        return _noise(label, given)
    if isinstance(given, Mapping) and "choices" in given:
        if extra := given.keys() - {"choices", "probabilities"}:
            raise ParameterError(f"{label}: unknown key {min(extra)!r}; allowed: choices, probabilities")
        return _choices(name, label, given["choices"], given.get("probabilities"))
    if isinstance(given, list | tuple | np.ndarray):
        return _choices(name, label, given, None)
    frozen = _from_mapping(label, given) if isinstance(given, Mapping) else given
    quantile = getattr(frozen, "ppf", None) or getattr(frozen, "icdf", None)
    if quantile is None or not hasattr(frozen, "cdf"):
        raise ParameterError(
            f"{label}: a distribution of scipy.stats, a list or a mapping such as {{normal: {{mean: 28, sd: 2}}}} is "
            f"needed, got {given!r:.60}"
        )
    if name.number is None:
        raise ParameterError(f"{label} is not a number: give a list of choices, got {given!r:.60}")
    _check_bounds(name, label, frozen)
    return Numbers(quantile, name.number is int)


def _check_bounds(name: Name, label: str, frozen: Any) -> None:
    low, high = name.bounds
    below = float(frozen.cdf(low)) if math.isfinite(low) else 0.0
    above = 1.0 - float(frozen.cdf(high)) if math.isfinite(high) else 0.0
    if not name.open_below and below and float(frozen.cdf(np.nextafter(low, -np.inf))) == 0.0:
        below = 0.0  # choices of a discrete distribution may lie on the bound itself
    if below + above > NEGLIGIBLE:
        unit = "" if name.unit == "-" else f" {name.unit}"
        bracket = "(" if name.open_below else "["
        raise ParameterError(
            f"{label}: {100.0 * (below + above):.3g} % of the distribution lie outside {bracket}{low:g}, {high:g}]"
            f"{unit}; cut it, such as with truncated_normal: {{mean: , sd: , low: , high: }}, or take lognormal"
        )


def _from_mapping(label: str, given: Mapping[str, Any]) -> Any:
    """Return a frozen distribution of scipy from a mapping with one name."""
    if len(given) != 1 or not isinstance(next(iter(given)), str):
        raise ParameterError(f"{label}: one of {', '.join(FORMS)} or choices is needed, got {dict(given)!r:.80}")
    (form, inner), *_ = given.items()
    if form not in FORMS:
        raise ParameterError(
            f"{label}: unknown distribution {form!r}{did_you_mean(form, [*FORMS, 'choices'])}; allowed: "
            f"{', '.join(FORMS)}, choices"
        )
    wanted = FORMS[form]
    if not isinstance(inner, Mapping) or set(inner) != set(wanted):
        raise ParameterError(f"{label}: {form} needs {', '.join(wanted)}, got {inner!r:.80}")
    numbers = {key: _number(f"{label}: {form}: {key}", value) for key, value in inner.items()}
    return _frozen(f"{label}: {form}", form, **numbers)


def _frozen(label: str, form: str, *, mean=0.0, sd=1.0, low=0.0, high=1.0, median=1.0, sigma=1.0, mode=0.5) -> Any:
    for word, value in (("sd", sd), ("median", median), ("sigma", sigma)):
        if not value > 0.0:
            raise ParameterError(f"{label}: {word} must be more than 0, got {value:g}")
    if form in ("uniform", "triangular", "truncated_normal") and not low < high:
        raise ParameterError(f"{label}: low must be less than high, got {low:g} and {high:g}")
    if form == "normal":
        return stats.norm(mean, sd)
    if form == "uniform":
        return stats.uniform(low, high - low)
    if form == "lognormal":
        return stats.lognorm(sigma, scale=median)
    if form == "truncated_normal":
        return stats.truncnorm((low - mean) / sd, (high - mean) / sd, mean, sd)
    if not low <= mode <= high:
        raise ParameterError(f"{label}: mode must lie in [{low:g}, {high:g}], got {mode:g}")
    return stats.triang((mode - low) / (high - low), low, high - low)


def _choices(name: Name, label: str, values: Any, probabilities: Any) -> Choices:
    found = tuple(python_value(value) for value in (values if isinstance(values, Sequence | np.ndarray) else ()))
    if not found or isinstance(values, str):
        raise ParameterError(f"{label}: choices must be a list of one value or more, got {values!r:.60}")
    weights = [1.0] * len(found) if probabilities is None else probabilities
    if not isinstance(weights, list | tuple | np.ndarray) or len(weights) != len(found):
        raise ParameterError(f"{label}: {len(found)} choices need as many probabilities, got {probabilities!r:.60}")
    numbers = [_number(f"{label}: probabilities", weight) for weight in weights]
    if min(numbers) < 0.0 or not math.isclose(sum(numbers), 1.0 if probabilities is not None else len(found)):
        raise ParameterError(f"{label}: probabilities must be >= 0 and sum up to 1, got {numbers} with {sum(numbers)}")
    low, high = name.bounds
    for value in found:
        if isinstance(value, int | float) and not isinstance(value, bool):
            if not (low < value if name.open_below else low <= value) or not value <= high:
                bracket = "(" if name.open_below else "["
                raise ParameterError(f"{label}: choices must lie in {bracket}{low:g}, {high:g}], got {value!r}")
        elif name.number is not None:
            check_file(name, f"{label}: choices", value)
    total = sum(numbers)
    return Choices(found, tuple(number / total for number in numbers))


def check_file(name: Name, label: str, value: Any) -> None:
    """Refuse a value in place of a number unless it names a file of values over the map.

    Parameters
    ----------
    name : Name
        Value that is a number.
    label : str
        Beginning of the message.
    value : object

    Raises
    ------
    ParameterError
    """
    if not has_suffix(value, (*RASTERS, *VECTORS)):
        raise ParameterError(f"{label} must be numbers [{name.unit}] or names of rasters, got {value!r:.60}")


def _noise(label: str, given: Any) -> NoiseRealisations:
    if not isinstance(given, Mapping) or set(given) != {"rms", "length"}:
        raise ParameterError(f"{label}: a mapping of rms [m] and length [m] is needed, got {given!r:.60}")
    rms, length = (_number(f"{label}: {key}", given[key]) for key in ("rms", "length"))
    if not (rms > 0.0 and length > 0.0):
        raise ParameterError(f"{label}: rms and length must be more than 0 m, got {rms:g} and {length:g}")
    return NoiseRealisations(rms, length)


def _number(label: str, value: Any) -> float:
    number = python_value(value)
    if isinstance(number, bool) or not isinstance(number, int | float) or not math.isfinite(number):
        raise ParameterError(f"{label} must be a finite number, got {value!r:.60}")
    return float(number)


def choices_text(distribution: Distribution) -> str | None:
    """Return the list behind the indices of a design as JSON, None where the design holds the values themselves."""
    if isinstance(distribution, Choices) and not distribution.numeric:
        return json.dumps([_plain(value) for value in distribution.values])
    return None


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(one) for key, one in value.items()}
    if isinstance(value, list | tuple | np.ndarray):
        return [_plain(one) for one in value]
    return python_value(value)
