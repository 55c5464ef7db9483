"""Digest of values, equal in every process, whatever the seed of hashes and the addresses of objects."""

import dataclasses
import re
from collections.abc import Mapping
from hashlib import blake2b
from types import CodeType, FunctionType, MethodType
from typing import Any

import numpy as np

from ..core.values import NodeValues


def digest(value: Any) -> str:
    """Return 32 hexadecimal digits that are equal for equal values, and differ otherwise.

    Examples
    --------
    >>> digest({"a": 1.0, "b": {2, 3}}) == digest({"b": {3, 2}, "a": 1.0}), digest(1.0) == digest(1.5)
    (True, False)
    """
    return blake2b(_token(value, ()).encode(), digest_size=16).hexdigest()


def text_of(obj: Any) -> str:
    """Return the printed form of an object, without its address."""
    return re.sub(" at 0x[0-9A-Fa-f]+", "", repr(obj))


def state_of(obj: Any) -> Any:
    """Return the attributes of an object by name, or its printed form if it shows none."""
    if dataclasses.is_dataclass(obj):
        return {field.name: getattr(obj, field.name, None) for field in dataclasses.fields(obj)}
    slots = [name for cls in type(obj).__mro__ for name in _tuple(getattr(cls, "__slots__", ()))]
    state = {name: getattr(obj, name) for name in slots if hasattr(obj, name) and not name.startswith("__")}
    state |= getattr(obj, "__dict__", {})
    return state or ({} if type(obj).__repr__ is object.__repr__ else text_of(obj))


def _tuple(names) -> tuple:
    return (names,) if isinstance(names, str) else tuple(names)


def _token(value: Any, inside: tuple) -> str:
    """Return the value as text; `inside` are the objects that it is a part of."""
    if isinstance(value, np.generic):
        value = value.item()
    if value is None or isinstance(value, bool | int | str | bytes):
        return repr(value)
    if isinstance(value, float | complex):
        return repr(value + 0.0)  # -0.0 and 0.0 are equal and get one text
    if isinstance(value, NodeValues):
        value = value.values
    if isinstance(value, np.ndarray) and value.dtype != object:
        return _array(value)
    if any(value is one for one in inside):
        return f"<{len(inside)}>"
    inside = (*inside, value)
    if isinstance(value, Mapping):
        return f"{{{','.join(sorted(f'{_token(k, inside)}:{_token(v, inside)}' for k, v in value.items()))}}}"
    if isinstance(value, list | tuple | np.ndarray):
        return f"[{','.join(_token(one, inside) for one in value)}]"
    if isinstance(value, set | frozenset):
        return f"<{','.join(sorted(_token(one, inside) for one in value))}>"
    if isinstance(value, type):
        return _path(value)
    if isinstance(value, FunctionType):
        return f"{_path(value)}{_token([value.__code__, value.__defaults__], inside)}"
    if isinstance(value, CodeType):
        return _token([value.co_code, value.co_names, value.co_consts], inside)
    if isinstance(value, MethodType):
        return _token([value.__func__, value.__self__], inside)
    return f"{_path(type(value))}{_token(state_of(value), inside)}"


def _array(values: np.ndarray) -> str:
    if values.dtype.kind in "fc":
        values = np.array(values)
        values += 0.0  # -0.0 and 0.0 count as equal, and so do all NaN
        values[np.isnan(values)] = np.nan
    return f"{values.dtype.str}{values.shape}{blake2b(np.ascontiguousarray(values).data, digest_size=16).hexdigest()}"


def _path(of) -> str:
    return f"{of.__module__}.{of.__qualname__}"
