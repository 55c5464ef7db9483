"""Numbers and words of `solve_column` that may be functions of time, checked; refusals in its name."""

import dataclasses
from typing import Any, NoReturn

import numpy as np

from ..core.checks import in_range
from ..core.errors import ParameterError
from ..core.hints import did_you_mean, give_number
from ..core.values import derived
from ..physics.column_contracts import BaseContact
from .declarations import NUMBERS

ALLOWED = BaseContact.BY_EROSION, BaseContact.PRESCRIBED, BaseContact.IMPERMEABLE, BaseContact.DRAINED
BASE = {contact.name.lower(): contact for contact in ALLOWED}


def refuse(message: str) -> NoReturn:
    """Raise ParameterError on behalf of `solve_column`."""
    raise ParameterError(f"solve_column: {message}")


class History:
    """An argument of `NUMBERS`, or "base": one per column, or a function of time [s], checked at every call."""

    def __init__(self, name: str, given: Any):
        self.name, self.given = name, given
        self.varies = callable(given) and (name == "base" or NUMBERS[name].metadata["timed"])
        self.value = self._read(given(0.0), " at t = 0 s") if self.varies else self._read(given)

    def spread(self, count: int) -> None:
        """Repeat a single value for every column, in place."""
        self.value = np.array(np.broadcast_to(self.value, (count,)))

    def at(self, time: float) -> np.ndarray:
        """Return the values at a time [s], shape (column,)."""
        if not self.varies:
            return self.value
        value, count = self._read(self.given(time), f" at t = {time:g} s"), self.value.size
        if value.size not in (1, count):
            shape = f"returned shape {value.shape} at t = {time:g} s"
            refuse(f"{self.name} {shape}; a function must return one number, or {count}, one per column, at every time")
        return np.array(np.broadcast_to(value, (count,)))

    def _read(self, value, when=""):
        if self.name == "base":
            return _contacts(value, when)
        return checked_numbers(self.name, NUMBERS[self.name], value, when)


def checked_numbers(
    name: str, argument: dataclasses.Field, value: Any, when: str = "", each: str = "column"
) -> np.ndarray:
    """Return `value`, one number or one for ``each``, as array (0 or 1 dimensions); else raise ParameterError.

    `argument` declares the argument `name`: unit, bounds, remedy. `when` is text on the time, for the message.
    """
    array = float_array(derived(f"solve_column: {name}", value, meta := argument.metadata))
    if array is None or array.ndim > 1 or array.size == 0:
        got = f"{value!r}{give_number(value)}" if array is None else f"shape {array.shape}"
        refuse(f"{name} must be one number or one per {each}, got {got}{when}; {meta['remedy']}")
    low, high = meta["bounds"]
    in_range(
        f"solve_column: {name}", array, low, high, meta["unit"],
        lambda bad: f" for {each} {bad[0]}{when}" if array.ndim else when, meta["remedy"],
        open_ends=(meta["open_below"] or np.isinf(low), np.isinf(high)), form="g",
    )  # fmt: skip
    return array


def float_array(value: Any) -> np.ndarray | None:
    """Return real numbers, one or a sequence, as an array of floats of that shape; None for anything else."""
    try:
        array = np.asarray(value)
    except ValueError:  # rows of different lengths
        return None
    return array.astype(float) if array.dtype.kind in "iuf" else None


def _contacts(value, when="") -> np.ndarray:
    words = np.asarray(value, dtype=object)
    bad = [word for word in words.flat if not isinstance(word, str) or word not in BASE]
    if bad or words.ndim > 1 or words.size == 0:
        got = f"{bad[0]!r}{did_you_mean(bad[0], BASE)}" if bad else f"shape {words.shape}"
        refuse(f"base must be one of {', '.join(BASE)}, or one of these per column; got {got}{when}")
    return np.array([BASE[word] for word in words.flat], np.int8).reshape(words.shape)
