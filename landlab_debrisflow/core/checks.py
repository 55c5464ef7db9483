"""Refusal of values: the one place that compares with an allowed interval and words the error."""

import numpy as np

from .errors import ParameterError


def require(good, name: str, allowed: str, values, where="", remedy: str = "", form: str = "", error=ParameterError):
    """Raise an error unless all values are good: "name must allowed, got value where; remedy".

    Parameters
    ----------
    good : bool or array_like of bool
        Verdict on all values, or on each of them: the message then shows the first bad one.
    name : str
        Name of the argument, parameter or field, with its owner in front.
    allowed : str
        Words after "must".
    values : object
        Value or values given.
    where : str or callable
        Words after the value, or a function that makes them from the flat indices of all bad values.
    remedy : str
        Advice that ends the message.
    form : str
        Format of the value in the message; by default its `repr`.
    error : type
        Class of the error.

    Raises
    ------
    ParameterError
        Or the `error` asked for.

    Examples
    --------
    >>> require([True, False], "depth", "be >= 0 m", [1.0, -2.0], lambda bad: f" at node {bad[0]}", "dig less")
    Traceback (most recent call last):
        ...
    landlab_debrisflow.core.errors.ParameterError: depth must be >= 0 m, got -2.0 at node 1; dig less
    """
    if np.all(good):
        return
    bad = np.flatnonzero(~np.asarray(good))
    got = format(np.ravel(values)[bad[0]], form) if np.ndim(good) or form else repr(values)
    place = where(bad) if callable(where) else where
    raise error(f"{name} must {allowed}, got {got}{place}{f'; {remedy}' if remedy else ''}")


def in_range(
    name: str, values, low=-np.inf, high=np.inf, unit: str = "-", where="", remedy: str = "", *,
    open_ends=(False, False), ignored=False, refused=False, form: str = "", error=ParameterError,
) -> None:  # fmt: skip
    """Raise an error unless all values are finite and lie in an interval.

    Parameters
    ----------
    name : str
        Name of the argument, parameter or field, with its owner in front.
    values : float or ndarray
    low, high : float
        Ends of the interval, in `unit`.
    unit : str
        ``"-"`` for none.
    where, remedy, form, error
        As in `require`.
    open_ends : tuple of bool
        Whether low and high are themselves outside.
    ignored, refused : bool or ndarray of bool
        Values that are not checked, and values that are refused although they lie in the interval.

    Raises
    ------
    ParameterError
        Or the `error` asked for.

    Examples
    --------
    >>> in_range("angle", 95.0, 0.0, 90.0, "deg")
    Traceback (most recent call last):
        ...
    landlab_debrisflow.core.errors.ParameterError: angle must lie in [0, 90] deg, got 95.0
    """
    above = np.greater if open_ends[0] else np.greater_equal
    below = np.less if open_ends[1] else np.less_equal
    good = above(values, low) & below(values, high) & np.isfinite(values) & np.logical_not(refused) | ignored
    left, right = "(" if open_ends[0] else "[", ")" if open_ends[1] else "]"
    interval = f"lie in {left}{low:g}, {high:g}{right}" + ("" if unit == "-" else f" {unit}")
    require(good, name, interval, values, where, remedy, form, error)
