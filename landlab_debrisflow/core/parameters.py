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
>>> from landlab_debrisflow.core.values import from_mapping
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
from typing import Any, TypeVar, dataclass_transform

import numpy as np

from .docstrings import with_parameters
from .values import NodeValues, checked, name_of

T = TypeVar("T")


def parameter(
    unit: str, meaning: str, default: Any, bounds: tuple[float | None, float | None] = (None, None),
    choices: Collection[str] | None = None, kind: type = float, varies: bool = False, *,
    open_below: bool = False, timed: bool = False, remedy: str = "", file: bool = False, items: type | None = None,
    coordinates: str | None = None, named: bool = False, length: int | None = None, words: Collection[str] = (),
    derivation: type | None = None,
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
        float, int, bool or str, which without `choices` is any text; tuple for one number or a list of them; dict for
        a mapping that is checked elsewhere.
    varies : bool
        Whether it may vary in space: then the name of a field at nodes, or an array over them, will do for a number.
    open_below : bool
        Whether the lower bound itself is refused.
    timed : bool
        Whether a function of time will do for a number.
    remedy : str
        Advice that ends the refusal of a number.
    file : bool
        Whether the name of a file will do for a number; with the kind str, whether the text is the name of a file.
    items : type, optional
        Declared class, of which the parameter is a list of instances, or of mappings that describe them.
    coordinates : {"points", "lines", "polygons", "table"}, optional
        Features that may be written as nested lists of x and y; "table" is a list of pairs.
    named : bool
        Whether these features have names: then a mapping of names to them will do.
    length : int, optional
        Number of values of a list, of the kind tuple; with `choices` one of these words will do for the list. Without
        `length`, a list with `choices` holds words, any number of them.
    words : tuple of str
        Words that will do for a number.
    derivation : type, optional
        Declared class with an attribute ``value`` that follows from its parameters: then a mapping of these may stand
        for the number, and the value is kept.

    Returns
    -------
    dataclasses.Field
        With these in its ``metadata``, by name.
    """
    if choices is not None and kind is not tuple:
        kind = str
    low, high = bounds
    metadata = {
        "unit": unit, "meaning": meaning, "choices": None if choices is None else tuple(choices), "kind": kind,
        "numbers": choices if isinstance(choices, Mapping) else None, "varies": varies, "timed": timed,
        "bounds": (-math.inf if low is None else low, math.inf if high is None else high),
        "open_below": open_below, "remedy": remedy, "file": file, "items": items, "coordinates": coordinates,
        "named": named, "length": length, "words": tuple(words), "derivation": derivation,
    }  # fmt: skip
    return dataclasses.field(default=default, metadata=metadata)


@dataclass_transform(frozen_default=True, kw_only_default=True)
def declared(cls: type[T]) -> type[T]:
    """Make a frozen, keyword-only dataclass that checks its parameters when an instance is built.

    A method ``_agree`` of the class is called last, to check parameters against each other. The docstring gets a
    section ``Parameters`` from the declarations. Messages name the class, or its attribute ``keyword`` if it has one.

    Parameters
    ----------
    cls : type, whose fields are made by `parameter`

    Returns
    -------
    type, which raises ParameterError where an instance is built with a value that is not allowed
    """

    def check(self):
        for field in dataclasses.fields(self):
            value = checked(name_of(type(self)), field.name, field, getattr(self, field.name))
            object.__setattr__(self, field.name, value)
        if hasattr(self, "_agree"):
            self._agree()

    made: Any = cls
    made.__post_init__ = check  # dataclass() looks for __post_init__ only while it runs
    made = dataclasses.dataclass(frozen=True, kw_only=True)(made)
    made.__doc__ = with_parameters(made.__doc__, dataclasses.fields(made))
    return made


def on_nodes(obj: Any, fields: Mapping[str, Any]) -> Any:
    """Return all that a law reads of its parameters: numbers as arrays over nodes, or of length 1, in SI units.

    Parameters
    ----------
    obj : object
        Object of a class made by `declared`; anything else has no parameters.
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
