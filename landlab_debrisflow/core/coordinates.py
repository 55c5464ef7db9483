"""Check coordinates given as nested lists: points, lines, polygons, tables of two columns."""

import math
from collections.abc import Mapping
from numbers import Real
from typing import Any

import numpy as np

from .errors import ParameterError
from .hints import give_number, python_value

Pair = tuple[float, float]

FORMS = {
    "points": (0, 1, "a point [x, y] or a list of points"),
    "lines": (1, 2, "a line [[x, y], [x, y], ...] or a list of lines"),
    "polygons": (1, 3, "a polygon [[x, y], [x, y], [x, y], ...] or a list of polygons"),
    "table": (1, 2, "a list of pairs"),
}
"""Levels of lists in one feature around its pairs, fewest pairs of a feature, and how it is written."""


def checked_coordinates(name: str, value: Any, form: str, named: bool = False) -> tuple:
    """Return coordinates as nested tuples of floats.

    Parameters
    ----------
    name : str
        Name of the parameter, for messages.
    value : object
        Nested lists, or arrays; with `named` also a mapping of names to one feature each.
    form : {"points", "lines", "polygons", "table"}
        Kind of feature.
    named : bool
        Whether features have names.

    Returns
    -------
    tuple
        Points as pairs, lines and polygons as tuples of pairs, a table as the pairs of its rows; with `named` a pair of
        name and feature for each.

    Raises
    ------
    ParameterError
        If the value is something else, or a number is not finite.

    Examples
    --------
    >>> checked_coordinates("output: gauges", {"bridge": [10, 20]}, "points", named=True)
    (('bridge', (10.0, 20.0)),)
    >>> checked_coordinates("release: polygons", [[0, 0], [10, 0], [10, 10]], "polygons")
    (((0.0, 0.0), (10.0, 0.0), (10.0, 10.0)),)
    """
    levels, fewest, written = FORMS[form]
    if named and isinstance(value, Mapping):
        if not value:
            raise ParameterError(f"{name} has no entry; leave it out, or give name: {written.split(' or ')[0]}")
        for label in value:
            if not isinstance(label, str) or not label.strip():
                raise ParameterError(f"{name}: names must be words, got {label!r}")
        return tuple((key, _feature(f"{name}: {key}", one, levels, fewest, written)) for key, one in value.items())
    if named and isinstance(value, tuple) and all(len(one) == 2 and isinstance(one[0], str) for one in value):
        return checked_coordinates(name, dict(value), form, named)
    depth = _depth(value)
    if depth == 0:
        form = f"a mapping of names to {written.split(' or ')[0]}" if named else written
        raise ParameterError(f"{name} must be the name of a file or {form}, got {_told(value)}")
    if form == "table":
        return _feature(name, value, levels, fewest, written)
    features = [value] if depth == levels + 1 else value
    if len(features) == 0:
        raise ParameterError(f"{name} is empty; leave it out, or give {written}")
    label = (lambda k: name) if depth == levels + 1 else (lambda k: f"{name}[{k}]")
    found = tuple(_feature(label(k), one, levels, fewest, written) for k, one in enumerate(features))
    return tuple((str(k + 1), one) for k, one in enumerate(found)) if named else found


def _depth(value) -> int:
    """Return how many levels of lists are around the first number."""
    depth = 0
    while isinstance(value, list | tuple | np.ndarray) and not (isinstance(value, np.ndarray) and value.ndim == 0):
        depth += 1
        if len(value) == 0:
            break
        value = value[0]
    return depth


def _feature(name, value, levels, fewest, written) -> tuple:
    """Return one pair, or the tuple of pairs of a line or polygon."""
    if not isinstance(value, list | tuple | np.ndarray):
        raise ParameterError(f"{name} must be {written.split(' or ')[0]}, got {_told(value)}")
    if levels == 0:
        return _pair(name, value)
    pairs = tuple(_pair(f"{name}[{k}]", one) for k, one in enumerate(value))
    if len(pairs) < fewest:
        raise ParameterError(f"{name} must have at least {fewest} pairs, got {len(pairs)}")
    return pairs


def _pair(name, value) -> Pair:
    value = python_value(value)
    if not isinstance(value, list | tuple | np.ndarray) or len(value) != 2:
        raise ParameterError(f"{name} must be two numbers in brackets, such as [500, 20.5], got {_told(value)}")
    x, y = (_number(name, python_value(number)) for number in value)
    return x, y


def _number(name, value) -> float:
    try:
        number = math.nan if isinstance(value, bool) or not isinstance(value, Real) else float(value)
    except OverflowError:  # an integer too large for a float
        number = math.inf
    if not math.isfinite(number):
        raise ParameterError(f"{name} must be two finite numbers, got {_told(value)}{give_number(value)}")
    return number


def _told(value) -> str:
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."
