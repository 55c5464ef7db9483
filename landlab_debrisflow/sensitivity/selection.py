"""Choice of measures and varied values for sensitivities, and the Dataset of results."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from ..core.errors import InputError, ParameterError
from ..core.hints import did_you_mean
from ..ensemble.design import design_keys
from ..ensemble.names import NOISE
from ..ensemble.results import EnsembleResults
from ..record.attributes import variable_attributes

ESTIMATE, LOWER, UPPER = range(3)
"""Places of an estimate and of the ends of its interval in the last axis of arrays."""


def chosen_measures(results: EnsembleResults, measures: str | Sequence[str] | None) -> xr.Dataset:
    """Return the measures of an ensemble that are asked for.

    Parameters
    ----------
    results : EnsembleResults
    measures : str, sequence of str or None
        Names; None: all.

    Returns
    -------
    xarray.Dataset
        Over ``member``.

    Raises
    ------
    InputError
        If no member is done, or there is no measure of a name.
    """
    found = results.measures
    if not found.data_vars:
        raise InputError(f"sensitivity: {results!r} has no measures; run members first")
    names = list(found.data_vars) if measures is None else [measures] if isinstance(measures, str) else list(measures)
    for name in names:
        if name not in found.data_vars:
            raise InputError(
                f"sensitivity: there is no measure {name!r}{did_you_mean(name, map(str, found.data_vars))}; there are "
                f"{', '.join(map(str, found.data_vars))}"
            )
    return found[names]


def number_variables(design: xr.Dataset) -> tuple[list[str], list[str]]:
    """Return the variables of a design that are numbers, and the dotted names of further varied values.

    Words, files and realisations of noise stand in a design as indices, whose order means nothing.

    Parameters
    ----------
    design : xarray.Dataset

    Returns
    -------
    tuple of list of str
    """
    keys = design_keys(design)
    others = [
        name for name, key in keys.items() if "choices" in design[name].attrs or key.endswith(f".{NOISE}")
    ]  # fmt: skip
    return [name for name in keys if name not in others], [keys[name] for name in others]


def check_confidence(confidence: float) -> None:
    """Refuse a level of confidence outside of ]0, 1[."""
    if isinstance(confidence, bool) or not isinstance(confidence, int | float) or not 0.0 < confidence < 1.0:
        raise ParameterError(f"sensitivity: confidence must lie between 0 and 1, such as 0.95, got {confidence!r}")


def sensitivity_dataset(
    results: EnsembleResults, measures: xr.Dataset, variables: Sequence[str],
    estimates: Mapping[str, tuple[np.ndarray, str]], counts: tuple[str, np.ndarray, str], attributes: Mapping[str, Any],
) -> xr.Dataset:  # fmt: skip
    """Return sensitivities with their intervals as a Dataset.

    Parameters
    ----------
    results : EnsembleResults
    measures : xarray.Dataset
        Measures over ``member``.
    variables : sequence of str
        Variables of the design.
    estimates : mapping of str to tuple of ndarray and str
        By name: estimates with their lower and upper bounds, shape (measures, variables, 3), or without these, shape
        (measures, variables, 1), and their meaning.
    counts : tuple of str, ndarray and str
        Name, values, shape (measures,), and meaning of the number behind the estimates of each measure.
    attributes : mapping of str to object
        Attributes of the Dataset.

    Returns
    -------
    xarray.Dataset
        Over ``measure``, ``parameter`` and ``bound``: a variable for each estimate, and its interval.
    """
    data: dict[str, Any] = {}
    for name, (found, meaning) in estimates.items():
        data[name] = ("measure", "parameter"), found[..., ESTIMATE], variable_attributes("1", meaning)
        if found.shape[-1] > 1:
            ends = variable_attributes("1", f"interval of {meaning}")
            data[f"{name}_interval"] = ("measure", "parameter", "bound"), found[..., LOWER:], ends
    name, numbers, meaning = counts
    data[name] = "measure", numbers, variable_attributes("1", meaning)
    design = results.design
    coordinates = {
        "measure": list(map(str, measures.data_vars)),
        "measure_units": ("measure", [one.attrs["units"] for one in measures.data_vars.values()]),
        "parameter": [design[name].attrs["key"] for name in variables],
        "parameter_units": ("parameter", [design[name].attrs["units"] for name in variables]),
        "bound": ["lower", "upper"],
    }
    known = {"sampling": results.sampling, "digest": results.digest, "failed_members": len(results.failures)}
    return xr.Dataset(data, coordinates, known | dict(attributes))
