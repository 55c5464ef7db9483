"""Declare a parameter once: name, unit, meaning, default, bounds.

From that one line come the validation, the docstring of the class, the tables of the documentation, the attributes of
output files and the numbers in SI units that laws read.

>>> @declared
... class Growth:
...     growth_rate: float = parameter("m-1", "relative growth per metre", 3e-3, (0, None))
>>> Growth(growth_rate=-1.0)
Traceback (most recent call last):
    ...
landlab_debrisflow.core.errors.ParameterError: Growth: growth_rate must lie in [0, inf] m-1, got -1.0
>>> from_mapping(Growth, {"rate": 1.0})
Traceback (most recent call last):
    ...
landlab_debrisflow.core.errors.ParameterError: Growth: unknown key 'rate'; allowed: growth_rate [m-1]
"""

import dataclasses
import functools
import math
from collections import namedtuple
from collections.abc import Collection, Mapping
from numbers import Integral, Real
from typing import Any, TypeVar, dataclass_transform

import numpy as np

from .checks import in_range
from .docstrings import with_parameters
from .errors import ParameterError
from .hints import did_you_mean, give_number, number_in, python_value, same_word

T = TypeVar("T")


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
        return NodeValues, (self.values,)  # an array by itself would come out of a pickle writeable

    def __eq__(self, other):
        return isinstance(other, NodeValues) and np.array_equal(self.values, other.values, equal_nan=True)

    def __hash__(self):
        return hash(self.values.tobytes())

    def __repr__(self):
        given = self.values[~np.isnan(self.values)]
        span = f"from {given.min():g} to {given.max():g}" if given.size else "without a number"
        return f"<{self.values.size} node values {span}>"


def parameter(
    unit: str, meaning: str, default: Any, bounds: tuple[float | None, float | None] = (None, None),
    choices: Collection[str] | None = None, kind: type = float, varies: bool = False, *,
    open_below: bool = False, timed: bool = False, remedy: str = "",
) -> Any:  # fmt: skip
    """Declare one parameter of a class decorated with `declared`, or one argument of a function.

    Parameters
    ----------
    unit : str
        SI unit, ``"-"`` for none, or ``"deg"`` (laws then read radians).
    meaning : str
        One line for docstrings, tables and file attributes.
    default : object
        Value if the user says nothing; None means "not set".
    bounds : tuple of float or None
        Closed interval of allowed values; None is unbounded.
    choices : tuple of str, or mapping of str to float, optional
        Allowed words, for a parameter that is a choice and not a number; of a mapping, a law reads the number.
    kind : type
        float, int, bool or str; tuple for one number or a list of them.
    varies : bool
        Whether it may vary in space: then the name of a field at nodes, or an array over them, will do for a number.
    open_below : bool
        Whether the lower bound itself is refused.
    timed : bool
        Whether a function of time will do for a number.
    remedy : str
        Advice that ends the refusal of a number.

    Returns
    -------
    dataclasses.Field
        With these in its ``metadata``, by name.
    """
    if choices is not None:
        kind = str
    low, high = bounds
    metadata = {
        "unit": unit, "meaning": meaning, "choices": None if choices is None else tuple(choices), "kind": kind,
        "numbers": choices if isinstance(choices, Mapping) else None, "varies": varies, "timed": timed,
        "bounds": (-math.inf if low is None else low, math.inf if high is None else high),
        "open_below": open_below, "remedy": remedy,
    }  # fmt: skip
    return dataclasses.field(default=default, metadata=metadata)


@dataclass_transform(frozen_default=True, kw_only_default=True)
def declared(cls: type[T]) -> type[T]:
    """Make a frozen, keyword-only dataclass that checks its parameters when an instance is built.

    A method ``_agree`` of the class is called last, to check parameters against each other. The docstring gets a
    section ``Parameters`` from the declarations.

    Parameters
    ----------
    cls : type, whose fields are made by `parameter`

    Returns
    -------
    type, which raises ParameterError where an instance is built with a value that is not allowed
    """

    def check(self):
        for field in dataclasses.fields(self):
            value = checked(type(self).__name__, field.name, field, getattr(self, field.name))
            object.__setattr__(self, field.name, value)
        if hasattr(self, "_agree"):
            self._agree()

    made: Any = cls
    made.__post_init__ = check  # before dataclass() runs: it looks for the method only then
    made = dataclasses.dataclass(frozen=True, kw_only=True)(made)
    made.__doc__ = with_parameters(made.__doc__, dataclasses.fields(made))
    return made


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
    meta, name = field.metadata, f"{owner}: {name}"
    kind, value = meta["kind"], python_value(value)
    if value is None and field.default is None:
        return None
    if kind is tuple:
        return _checked_list(name, value, meta)
    if kind is str:
        choices = meta["choices"]
        if (word := same_word(value, choices)) is None:
            hint = did_you_mean(value, choices)
            raise ParameterError(f"{name} must be one of {', '.join(choices)}; got {value!r}{hint}")
        return word
    if kind is bool:
        if not isinstance(value, bool):
            raise ParameterError(f"{name} must be true or false, got {value!r}; give True or False without quotes")
        return value
    if meta["varies"] and not isinstance(value, Real):
        return _checked_on_nodes(name, value, meta)
    return _checked_number(name, value, meta)


def _checked_on_nodes(name: str, value: Any, meta):
    """Return the name of a field, or an array of values as `NodeValues`; both are compared with the grid later."""
    if isinstance(value, NodeValues) or (isinstance(value, str) and number_in(value) is None):
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


def on_nodes(obj: Any, fields: Mapping[str, Any]) -> Any:
    """Return all that a law reads of its parameters: numbers as arrays over nodes, or of length 1, in SI units.

    Parameters
    ----------
    obj : object
        Of a class made by `declared`; anything else has no parameters.
    fields : mapping of str to ndarray
        Arrays over nodes, by the names that parameters may be given as.

    Returns
    -------
    NamedTuple
        Of every numeric parameter that is set an ndarray of floats, shape (nodes,) or (1,), degrees as radians. The
        number of a choice, if choices have numbers, is an attribute beside them.
    """
    values, constants = {}, {}
    for field in dataclasses.fields(obj) if dataclasses.is_dataclass(obj) else ():
        value, meta = getattr(obj, field.name), field.metadata
        if meta.get("numbers"):
            constants[field.name] = meta["numbers"][value]
        if meta.get("kind") not in (float, int) or value is None:
            continue
        if isinstance(value, str):
            value = fields[value]
        array = value.values if isinstance(value, NodeValues) else np.atleast_1d(np.asarray(value, float))
        values[field.name] = np.radians(array) if meta["unit"] == "deg" else array
    return _struct(tuple(values), tuple(constants.items()))(*values.values())


@functools.cache
def _struct(names: tuple[str, ...], constants: tuple[tuple[str, float], ...]) -> type:
    """Return the type of named tuples with some names and constants: one type per signature, in a pickle, too."""
    cls = namedtuple("Parameters", names)  # type: ignore[misc]  # which names, is known when it runs
    return type("Parameters", (cls,), {
        "__doc__": "Parameters of a law in SI units, of which each is an ndarray, shape (n,) or (1,).",
        "__slots__": (), "__module__": __name__, **dict(constants),
        "__reduce__": lambda self: (_rebuilt, (names, constants, tuple(self))),
    })  # fmt: skip


def _rebuilt(names, constants, values):
    return _struct(names, constants)(*values)


def _checked_list(name: str, value: Any, meta):
    """Return one number, or some, as a tuple of floats."""
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
        raise ParameterError(f"{name} must be {word} [{unit}], got {value!r}{hint}")
    try:
        number = float(value)
    except OverflowError:  # of an integer
        number = math.inf
    told = value if kind is int and math.isfinite(number) else number
    low, high = meta["bounds"]
    in_range(name, told, low, high, unit, remedy=meta["remedy"], open_ends=(meta["open_below"], False))
    return int(value) if kind is int else number


def from_mapping(cls: type[T], mapping: Mapping[str, Any], relatives: Mapping[str, type] | None = None) -> T:
    """Build a declared class from plain values, as they come from YAML.

    Parameters
    ----------
    cls : type
        Made by `declared`.
    mapping : mapping
        Values of parameters by name.
    relatives : mapping of str to type, optional
        Other classes by name; a key that is unknown here may be one of theirs, and then that is said.

    Raises
    ------
    ParameterError
        If a key is unknown (the message lists the legal ones with units) or a value is refused.
    """
    declaration: Any = cls
    legal = {f.name: f.metadata["unit"] for f in dataclasses.fields(declaration)}
    for key in mapping:
        if key not in legal:
            allowed = ", ".join(f"{name} [{unit}]" for name, unit in legal.items()) or "none"
            owners = [n for n, other in (relatives or {}).items() if key in {f.name for f in dataclasses.fields(other)}]
            hint = f" (it is one of {', '.join(owners)})" if owners else did_you_mean(key, legal)
            raise ParameterError(f"{cls.__name__}: unknown key {key!r}{hint}; allowed: {allowed}")
    return cls(**mapping)
