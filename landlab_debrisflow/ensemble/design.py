"""Design of an ensemble: the values of every member."""

import json
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from ..core.errors import ParameterError
from ..core.names import legal_name
from ..record.attributes import variable_attributes
from ..scene.content import SceneContent
from .correlation import correlated
from .distributions import Choices, Distribution, NoiseRealisations, choices_text, distribution_of
from .names import Name, find_name
from .sampling import Points, all_combinations, default_members, draw_points


class Varied(NamedTuple):
    """Value of a scene with its distribution.

    Attributes
    ----------
    name : Name
    distribution : Distribution
    """

    name: Name
    distribution: Distribution


def varied_values(vary: Mapping[str, Any], content: SceneContent) -> tuple[Varied, ...]:
    """Return the varied values of a scene with their distributions.

    Parameters
    ----------
    vary : mapping of str to object
        Distributions by dotted name, as `distribution_of` reads them.
    content : SceneContent

    Returns
    -------
    tuple of Varied

    Raises
    ------
    ParameterError
        If a name or a distribution cannot be used, or two names mean the same value.
    """
    if not isinstance(vary, Mapping) or not vary:
        raise ParameterError(
            f"ensemble: vary must be a mapping of dotted names to distributions, got {vary!r:.60}; such as "
            "friction.basal_friction_angle: {normal: {mean: 28, sd: 2}}"
        )
    found: list[Varied] = []
    for key, given in vary.items():
        name = find_name(key, content)
        for other in found:
            shorter, longer = sorted((name.path, other.name.path), key=len)
            if longer[: len(shorter)] == shorter:
                raise ParameterError(f"ensemble: {other.name.key} and {key} vary the same value; keep one")
        found.append(Varied(name, distribution_of(name, given)))
    return tuple(found)


def make_design(
    varied: Sequence[Varied], method: str, members: int | None, seed: int, replicates: int | None = None,
    correlation: Any = None,
) -> xr.Dataset:  # fmt: skip
    """Draw the members of an ensemble.

    Parameters
    ----------
    varied : sequence of Varied
    method : str
        One of `SAMPLINGS` of the keys of an ensemble.
    members : int, optional
        Number of members; by default 256, of factorial all combinations.
    seed : int
    replicates : int, optional
        Number of independent samples of a Latin hypercube or of Sobol's sequence.
    correlation : optional
        Rank correlations, as `correlated` reads them.

    Returns
    -------
    xarray.Dataset
        Over ``member``: a variable for each varied value, with its dotted name as the attribute ``key``, and
        ``replicate``.

    Raises
    ------
    ParameterError
        If the method cannot give so many members.
    """
    if method == "factorial":
        if correlation is not None:
            raise ParameterError("ensemble: correlation is not for factorial, which has all combinations; leave it out")
        columns = _combinations(varied, members)
        return make_dataset(varied, columns, np.zeros(len(columns[0]), int))
    count = default_members(method, len(varied)) if members is None else members
    points = draw_points(method, count, len(varied), seed, replicates)
    if correlation is not None:
        if method == "saltelli":
            raise ParameterError("ensemble: Sobol indices are defined for independent values; leave correlation out")
        keys = [one.name.key for one in varied]
        points = Points(correlated(points, keys, correlation, method == "latin_hypercube"), points.replicate)
    columns = [one.distribution.values_at(points.uniform[:, k]) for k, one in enumerate(varied)]
    return make_dataset(varied, columns, points.replicate)


def _combinations(varied: Sequence[Varied], members: int | None) -> list[np.ndarray]:
    for one in varied:
        if not isinstance(one.distribution, Choices):
            raise ParameterError(f"ensemble: factorial needs a list of choices for {one.name.key}")
    choices = [one.distribution for one in varied if isinstance(one.distribution, Choices)]
    index = all_combinations([len(one.values) for one in choices])
    if members not in (None, len(index)):
        raise ParameterError(f"ensemble: factorial has {len(index)} members, all combinations; got members {members}")
    return [
        np.asarray(one.values)[index[:, k]] if one.numeric else index[:, k] for k, one in enumerate(choices)
    ]  # fmt: skip


def make_dataset(varied: Sequence[Varied], columns: Sequence[np.ndarray], replicate: np.ndarray) -> xr.Dataset:
    """Return a design from the values of its members.

    Parameters
    ----------
    varied : sequence of Varied
    columns : sequence of ndarray, shape (members,)
        Values of each, in their order.
    replicate : ndarray of int, shape (members,)

    Returns
    -------
    xarray.Dataset
        As `make_design` returns it.
    """
    variables: dict[str, Any] = {}
    for one, values in zip(varied, columns, strict=True):
        name = one.name
        attributes = variable_attributes(name.unit, name.meaning) | {"key": name.key}
        if (choices := choices_text(one.distribution)) is not None:
            attributes["choices"] = choices
        if isinstance(one.distribution, NoiseRealisations):
            attributes |= one.distribution._asdict()
        variables[legal_name(name.key.replace(".", "__").replace(" ", "_"))] = ("member", values, attributes)
    variables["replicate"] = ("member", replicate, variable_attributes("-", "number of the independent sample"))
    return xr.Dataset(variables, {"member": np.arange(replicate.size)})


def design_keys(design: xr.Dataset) -> dict[str, str]:
    """Return the dotted names of the values in a design, by variable."""
    return {str(name): str(values.attrs["key"]) for name, values in design.data_vars.items() if "key" in values.attrs}


def member_values(design: xr.Dataset, member: int) -> dict[str, Any]:
    """Return the values of a member by dotted name; the choice itself where the design holds the index of a list.

    Parameters
    ----------
    design : xarray.Dataset
        As `make_design` returns it.
    member : int

    Returns
    -------
    dict of str to object
    """
    values = {}
    for variable, key in design_keys(design).items():
        number = design[variable].values[member].item()
        choices = design[variable].attrs.get("choices")
        values[key] = number if choices is None else json.loads(choices)[number]
    return values
