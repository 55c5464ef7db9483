"""Check the values of declared parameters, and build declared classes from plain values."""

import dataclasses
import math
from collections.abc import Mapping
from numbers import Integral, Real
from typing import Any, TypeVar

import numpy as np

from .checks import in_range
from .coordinates import checked_coordinates
from .derived_number import DerivedNumber
from .errors import ParameterError
from .hints import did_you_mean, give_number, number_in, number_with_unit, python_value, same_word

T = TypeVar("T")

MOST_WHOLE = 1e18
"""Largest integer that is taken; arrays of numpy hold up to 9.2e18."""


class NodeValues:
    """A parameter given at every node: an array that compares, hashes and prints like a value.

    Parameters
    ----------
    values : ndarray, shape (nodes,)
        Any number at nodes that the grid will have closed, NaN included.

    Examples
    --------
    >>> NodeValues(np.array([1.0, 2.5])), NodeValues(np.array([1.0, 2.5])) == NodeValues(np.array([1.0, 2.5]))
    (<2 node values from 1 to 2.5>, True)
    """

    def __init__(self, values: np.ndarray) -> None:
        self.values = values.copy()
        self.values.flags.writeable = False

    def __reduce__(self):
        return NodeValues, (self.values,)  # a pickled array would come back writeable

    def __eq__(self, other):
        return isinstance(other, NodeValues) and np.array_equal(self.values, other.values, equal_nan=True)

    def __hash__(self):
        return hash(self.values.tobytes())

    def __repr__(self):
        given = self.values[~np.isnan(self.values)]
        span = f"from {given.min():g} to {given.max():g}" if given.size else "without a number"
        return f"<{self.values.size} node values {span}>"


def checked(owner: str, name: str, field: dataclasses.Field, value: Any) -> Any:
    """Return the value of a parameter, or of an argument, in its declared type.

    Parameters
    ----------
    owner, name : str
        Class and parameter, or function and argument.
    field : dataclasses.Field
        As `parameter` returns it.
    value : object

    Raises
    ------
    ParameterError
        If the value is not of that type or not allowed.
    """
    meta, name = field.metadata, f"{owner}: {name.removesuffix('_')}"
    kind, value = meta["kind"], python_value(value)
    if value is None and field.default is None:
        return None
    if meta["items"] is not None:
        return _checked_items(name, value, meta["items"])
    if meta["file"] and (isinstance(value, str) or (kind is str and not meta["coordinates"])):
        return _checked_file(name, value)
    if meta["coordinates"]:
        return checked_coordinates(name, value, meta["coordinates"], meta["named"])
    if dataclasses.is_dataclass(kind):
        return _checked_item(name, value, kind)
    if kind is dict:
        return _checked_mapping(name, value)
    if kind is tuple and meta["choices"] and meta["length"] is not None and isinstance(value, str):
        return _checked_word(name, value, meta["choices"])
    if kind is tuple and meta["choices"] and meta["length"] is None:
        return _checked_words(name, value, meta["choices"])
    if kind is tuple:
        return _checked_list(name, value, meta)
    if kind is str:
        return _checked_text(name, value) if meta["choices"] is None else _checked_word(name, value, meta["choices"])
    if kind is bool:
        if not isinstance(value, bool):
            raise ParameterError(f"{name} must be true or false, got {value!r}; give True or False without quotes")
        return value
    if meta["varies"] and not isinstance(value, Real):
        return _checked_on_nodes(name, value, meta)
    if (word := same_word(value, meta["words"])) is not None:
        return word
    return _checked_number(name, derived(name, value, meta), meta)


def _checked_on_nodes(name: str, value: Any, meta):
    """Return the name of a field, or an array of values as `NodeValues`; both are compared with the grid later."""
    named = isinstance(value, str) and number_in(value) is None and number_with_unit(value) is None
    if isinstance(value, NodeValues) or named:
        return value
    try:
        values = np.ma.filled(value, np.nan) if isinstance(value, np.ma.MaskedArray) else np.asarray(value)
    except ValueError:  # rows of different lengths
        values = np.empty(0)
    if values.ndim != 1 or values.size == 0 or values.dtype.kind not in "iuf":
        got = f"an array of shape {values.shape}" if isinstance(value, np.ndarray) else repr(value)
        remedy = give_number(value) if isinstance(value, str) else ""
        if values.ndim > 1:
            remedy = "; give array.reshape(-1), in the order of the grid's nodes, whose first row is the southern one"
        raise ParameterError(
            f"{name} must be a number [{meta['unit']}], the name of a field at nodes, or an array over them, "
            f"got {got}{remedy}"
        )
    return NodeValues(values.astype(float))


def _checked_items(name: str, value: Any, cls: type):
    """Return a tuple of instances of a declared class, from one of them or a list, or from mappings."""
    several = [value] if isinstance(value, Mapping | cls) else value
    if isinstance(several, str) or not hasattr(several, "__iter__"):
        raise ParameterError(f"{name} must be a mapping or a list of mappings, got {value!r}")
    for k, one in enumerate(several):
        if not isinstance(one, Mapping | cls):
            raise ParameterError(f"{name}[{k}] must be a mapping, got {one!r}")
    return tuple(one if isinstance(one, cls) else _item(f"{name}[{k}]", cls, one) for k, one in enumerate(several))


def derived(name: str, value: Any, meta: Mapping[str, Any]) -> Any:
    """Return the number that follows from parameters, an object or a mapping of a class in `meta`; else `value`.

    `name` is that of the number, for the message of a ParameterError.
    """
    cls = meta["derivation"]
    if cls is None or not isinstance(value, Mapping | cls):
        return value
    source = value if isinstance(value, cls) else _item(name, cls, value)
    return DerivedNumber(
        source.value, {field.name: getattr(source, field.name) for field in dataclasses.fields(source)}
    )


def _checked_item(name: str, value: Any, cls: type):
    """Return an instance of a declared class from one, or from a mapping."""
    if isinstance(value, cls):
        return value
    if not isinstance(value, Mapping):
        names = ", ".join(keys_of(cls))
        raise ParameterError(f"{name} must be a mapping with some of {names} (all have defaults), got {value!r:.60}")
    return _item(name, cls, value)


def _item(name: str, cls: type, mapping):
    try:
        return from_mapping(cls, mapping)
    except ParameterError as error:
        raise ParameterError(f"{name}: {error}") from error


def _checked_mapping(name: str, value: Any) -> dict[str, Any]:
    if not isinstance(value, Mapping) or not all(isinstance(key, str) for key in value):
        raise ParameterError(f"{name} must be a mapping of words to values, got {value!r:.60}")
    return dict(value)


def _checked_file(name: str, value: Any) -> str:
    if not isinstance(value, str) or not value.strip() or "\0" in value:
        raise ParameterError(f"{name} must be the name of a file, got {value!r}")
    return value


def _checked_word(name: str, value: Any, choices) -> str:
    if (word := same_word(value, choices)) is None:
        hint = did_you_mean(value, choices)
        raise ParameterError(f"{name} must be one of {', '.join(choices)}; got {value!r}{hint}")
    return word


def _checked_words(name: str, value: Any, choices) -> tuple[str, ...]:
    """Return one word, or some, as a tuple in which each stands once."""
    several = [value] if isinstance(value, str) else value
    if isinstance(several, Mapping) or not hasattr(several, "__iter__"):
        raise ParameterError(f"{name} must be a list of words out of {', '.join(choices)}; got {value!r}")
    return tuple(dict.fromkeys(_checked_word(f"{name}[{k}]", one, choices) for k, one in enumerate(several)))


def _checked_text(name: str, value: Any) -> str:
    if not isinstance(value, str) or not value.strip():
        raise ParameterError(f"{name} must be a text, got {value!r:.60}")
    return value


def _checked_list(name: str, value: Any, meta):
    """Return one number, or some, as a tuple of floats."""
    length = meta["length"]
    if length is not None and (isinstance(value, Real | str) or not hasattr(value, "__len__") or len(value) != length):
        raise ParameterError(f"{name} must be a list of {length} numbers [{meta['unit']}], got {value!r}")
    if isinstance(value, Real):
        return (_checked_number(name, value, meta),)
    if isinstance(value, str | Mapping) or not hasattr(value, "__iter__"):
        hint = give_number(value) if isinstance(value, str) else ""
        raise ParameterError(f"{name} must be a number or a list of numbers [{meta['unit']}], got {value!r}{hint}")
    return tuple(_checked_number(f"{name}[{k}]", python_value(number), meta) for k, number in enumerate(value))


def _checked_number(name: str, value: Any, meta):
    kind, unit = meta["kind"], meta["unit"]
    expected: Any = Integral if kind is int else Real
    if isinstance(value, bool) or not isinstance(value, expected):
        word, hint = "an integer" if kind is int else "a number", give_number(value, kind is int)
        others = "".join(f" or {other!r}" for other in meta["words"])
        if meta["derivation"] is not None:
            others += f", or a mapping of {', '.join(keys_of(meta['derivation']))}"
        hint = hint or did_you_mean(value, meta["words"])
        raise ParameterError(f"{name} must be {word} [{unit}]{others}, got {value!r}{hint}")
    try:
        number = float(value)
    except OverflowError:  # an integer too large for a float
        number = math.inf
    low, high = meta["bounds"]
    told = value if kind is int and abs(number) < MOST_WHOLE else number
    if kind is int and told is number:  # numpy's arrays of integers hold no larger one
        low, high = max(low, -MOST_WHOLE), min(high, MOST_WHOLE)
    in_range(name, told, low, high, unit, remedy=meta["remedy"], open_ends=(meta["open_below"], False))
    return int(value) if kind is int else value if isinstance(value, DerivedNumber) else number


def from_mapping(cls: type[T], mapping: Mapping[str, Any], relatives: Mapping[str, type] | None = None) -> T:
    """Build a declared class from plain values, as they come from YAML.

    Parameters
    ----------
    cls : type
        Made by `declared`.
    mapping : mapping
        Values of parameters by name.
    relatives : mapping of str to type, optional
        Other classes by name; if an unknown key is a parameter of one of these classes, the message says so.

    Raises
    ------
    ParameterError
        If a key is unknown (the message lists the legal ones with units) or a value is refused.
    """
    declaration: Any = cls
    names = keys_of(declaration)
    legal = {key: field.metadata["unit"] for key, field in names.items()}
    for key in mapping:
        if key not in legal:
            allowed = ", ".join(f"{name} [{unit}]" for name, unit in legal.items()) or "none"
            owners = [n for n, other in (relatives or {}).items() if key in keys_of(other)]
            hint = f" (it is one of {', '.join(owners)})" if owners else did_you_mean(key, legal)
            raise ParameterError(f"{name_of(cls)}: unknown key {key!r}{hint}; allowed: {allowed}")
    return cls(**{names[key].name: value for key, value in mapping.items()})


def keys_of(cls: Any) -> dict[str, dataclasses.Field]:
    """Return the declarations of a class by their keys in a mapping: the names, of `from_` without the underscore."""
    return {field.name.removesuffix("_"): field for field in dataclasses.fields(cls)}


def flat_keys_of(cls: Any) -> dict[str, dataclasses.Field]:
    """Return the declarations of a class by their keys, and with a dot those of a parameter that is declared itself."""
    found: dict[str, dataclasses.Field] = {}
    for key, field in keys_of(cls).items():
        found[key] = field
        if dataclasses.is_dataclass(kind := field.metadata["kind"]):
            found |= {f"{key}.{inner}": one for inner, one in keys_of(kind).items()}
    return found


def with_inner(obj: Any) -> list[Any]:
    """Return an object of a declared class, or another one, and the objects of declared classes that it holds."""
    values = [getattr(obj, field.name) for field in dataclasses.fields(obj)] if dataclasses.is_dataclass(obj) else []
    return [obj, *(value for value in values if dataclasses.is_dataclass(value) and not isinstance(value, type))]


def name_of(cls: type) -> str:
    """Return the name of a declared class in messages: its `keyword`, or the name of the class."""
    return getattr(cls, "keyword", cls.__name__)
