"""Danger levels: hazard classes and return periods together, after a declared matrix."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from ..core.checks import in_range
from ..core.errors import ParameterError
from ..core.hints import did_you_mean
from ..record.attributes import file_attributes, quantity_attributes, variable_attributes
from ..record.georeference import crs_of, georeferenced
from .maps import hazard_maps
from .scale import SWISS, HazardScale


class HazardMatrix(NamedTuple):
    """Danger level by hazard class and return period.

    Attributes
    ----------
    name : str
    levels : tuple of str
        Danger levels, from the least to the greatest one; nodes without any have the number 0.
    colours : tuple of str
        Colour of each level, as ``#rrggbb``.
    periods : tuple of float
        Longest return period of each column, increasing [a]; the last one may be infinite.
    table : dict of str to tuple of str
        By the name of a hazard class: its level in each column.
    source : str
        Document that declares the matrix.
    """

    name: str
    levels: tuple[str, ...]
    colours: tuple[str, ...]
    periods: tuple[float, ...]
    table: dict[str, tuple[str, ...]]
    source: str

    def level(self, hazard_class: str, period: float) -> int:
        """Return the number of the danger level of a class with a return period [a], from 1.

        Parameters
        ----------
        hazard_class : str
        period : float
            Return period [a].

        Returns
        -------
        int

        Examples
        --------
        >>> [SWISS_LEVELS.levels[SWISS_LEVELS.level("strong", period) - 1] for period in (30, 300, 1000)]
        ['high', 'high', 'residual']
        """
        column = int(np.searchsorted(self.periods, period))
        return self.levels.index(self.table[hazard_class][column]) + 1


SWISS_LEVELS = HazardMatrix(
    "Swiss danger levels of debris flows", ("residual", "low", "medium", "high"),
    ("#fff7bc", "#ffe14d", "#4a90d9", "#d7301f"), (30.0, 100.0, 300.0, np.inf),
    {"medium": ("medium", "medium", "low", "residual"), "strong": ("high", "high", "high", "residual")},
    "Matrix of debris flows (flusso detrito) of Canton Ticino, as programmed in its QGIS plugin PZP "
    "(https://github.com/opengisch/pzp). The plugin lets an expert raise two fields: medium intensity to 30 years from "
    "medium (blue) to high (red), and to 300 years from low (yellow) to medium (blue)",
)  # fmt: skip
"""Danger levels of debris flows in Switzerland: high (red), medium (blue), low (yellow), residual (yellow-white)."""


def hazard_matrix(
    results: Mapping[float, Any], scale: HazardScale = SWISS, matrix: HazardMatrix = SWISS_LEVELS,
    probability: float = 0.5, **others: Any,
) -> xr.Dataset:  # fmt: skip
    """Return the danger level at every node from ensembles of several return periods.

    For each period a node has the most severe hazard class that at least a share `probability` of the members reaches
    or exceeds. The danger level is the greatest one of all periods.

    Parameters
    ----------
    results : mapping of float to EnsembleResults, str, Path or Dataset
        By return period [a]: results of an ensemble of that period, its store, or its `hazard_maps` with this scale.
    scale : HazardScale
    matrix : HazardMatrix
    probability : float
        In (0, 1).
    **others
        Further arguments of `hazard_maps`.

    Returns
    -------
    xarray.Dataset
        ``danger_level``, 0 for none and 1 for the least one, over ``y`` and ``x``; ``class_number`` over ``period``,
        too.

    Raises
    ------
    InputError, ParameterError
        As in `hazard_maps`; if a class or a period is not in the matrix, or nodes differ.

    Examples
    --------
    >>> hazard_matrix({0: None})
    Traceback (most recent call last):
        ...
    landlab_debrisflow.core.errors.ParameterError: hazard: return period must lie in (0, inf) a, got 0.0
    """
    in_range("hazard: probability", probability, 0.0, 1.0, open_ends=(True, True))
    check_matrix(matrix, scale)
    if not isinstance(results, Mapping) or not results:
        raise ParameterError("hazard: give results by return period [a], such as {30: first, 100: second}")
    periods = sorted(float(period) for period in results)
    longest = matrix.periods[-1]
    in_range("hazard: return period", np.array(periods), 0.0, longest, "a", open_ends=(True, np.isinf(longest)))
    given = {float(period): one for period, one in results.items()}
    maps = [_with_classes(given[period], scale, others) for period in periods]
    first = maps[0]
    for one in maps[1:]:
        if not (first.x.equals(one.x) and first.y.equals(one.y)):
            raise ParameterError("hazard: ensembles of several return periods must have the same nodes")
    numbers = np.stack([class_number(one, probability) for one in maps])
    levels = np.zeros_like(numbers)
    for j, period in enumerate(periods):
        row = np.array([0, *(matrix.level(one.name, period) for one in scale.classes)], np.uint8)
        levels[j] = row[numbers[j]]
    words = variable_attributes("-", f"danger level: 0 none, {_numbered(matrix.levels)}")
    words |= _flags(matrix.levels, matrix.colours)
    names = [one.name for one in scale.classes]
    classes = variable_attributes("-", f"hazard class: 0 none, {_numbered(names)}") | _flags(names)
    period_words = variable_attributes("a", "return period")
    found = xr.Dataset(
        {"danger_level": (("y", "x"), levels.max(axis=0), words),
         "class_number": (("period", "y", "x"), numbers, classes)},
        {"y": first.y, "x": first.x, "period": ("period", periods, period_words)},
        file_attributes() | {
            "hazard_scale": scale.name, "hazard_scale_source": scale.source, "hazard_matrix": matrix.name,
            "hazard_matrix_source": matrix.source, "title": "danger levels",
            "ensemble_digest": ", ".join(str(one.attrs["ensemble_digest"]) for one in maps),
        } | quantity_attributes("probability_of_class", float(probability)),
    )  # fmt: skip
    return georeferenced(found, crs_of(first))


def class_number(maps: xr.Dataset, probability: float) -> np.ndarray:
    """Return the number of the most severe class that a share of the members reaches, 0 for none.

    Parameters
    ----------
    maps : xarray.Dataset
        As `hazard_maps` returns them, with a scale.
    probability : float
        In (0, 1).

    Returns
    -------
    ndarray of int, shape (rows, columns)
    """
    reached = maps.probability_of_class.values >= np.float32(probability)
    return reached.sum(axis=0).astype(np.uint8)  # a severe class is never more probable than a less severe one


def check_matrix(matrix: HazardMatrix, scale: HazardScale) -> None:
    """Refuse a matrix that does not fit a scale.

    Parameters
    ----------
    matrix : HazardMatrix
    scale : HazardScale

    Raises
    ------
    ParameterError
    """
    for one in scale.classes:
        if one.name not in matrix.table:
            raise ParameterError(
                f"hazard: {matrix.name} has no class {one.name!r} of {scale.name}; it has {', '.join(matrix.table)}"
            )
    for name, row in matrix.table.items():
        if len(row) != len(matrix.periods):
            raise ParameterError(
                f"hazard: {matrix.name} must have a level for each of {len(matrix.periods)} periods, got {len(row)} "
                f"for the class {name}"
            )
        if unknown := [level for level in row if level not in matrix.levels]:
            raise ParameterError(
                f"hazard: {matrix.name} has no level {unknown[0]!r}{did_you_mean(unknown[0], matrix.levels)}; there "
                f"are {', '.join(matrix.levels)}"
            )


def _with_classes(given: Any, scale: HazardScale, others: dict[str, Any]) -> xr.Dataset:
    """Return hazard maps with the classes of a scale."""
    maps = given if isinstance(given, xr.Dataset) else hazard_maps(given, scale=scale, **others)
    if maps.attrs.get("hazard_scale") != scale.name:
        raise ParameterError(f"hazard: maps of a return period lack the classes of {scale.name}; give them that scale")
    return maps


def level_names(levels: xr.DataArray) -> tuple[list[str], list[str]]:
    """Return names and colours in the attributes of danger levels or of hazard classes, from number 1.

    Parameters
    ----------
    levels : xarray.DataArray
        Danger levels or class numbers of `hazard_matrix`, or of a file of them.

    Returns
    -------
    names, colours : list of str
        Names with blanks as underscores; no colours of classes.

    Raises
    ------
    KeyError
        If there are no such attributes.
    """
    return levels.attrs["flag_meanings"].split()[1:], levels.attrs.get("flag_colors", "").split()[1:]


def _flags(names: Sequence[str], colours: Sequence[str] = ()) -> dict[str, Any]:
    """Return the CF attributes of numbers with names; colours as land cover of ESA CCI has them."""
    found: dict[str, Any] = {
        "flag_values": np.arange(len(names) + 1, dtype=np.uint8),
        "flag_meanings": " ".join(["none", *("_".join(name.split()) for name in names)]),
    }
    return found | ({"flag_colors": " ".join(["#ffffff", *colours])} if colours else {})


def _numbered(names: Any) -> str:
    return ", ".join(f"{k} {name}" for k, name in enumerate(names, 1))
