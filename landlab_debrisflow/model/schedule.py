"""When observers look at a flow: before the first step of a call, and after steps that cross multiples of intervals."""

import sys

import numpy as np

EVERY_STEP = sys.float_info.min
"""Interval of observers that look before the first step of a call and after each of its steps [s]: no step is so short,
so each crosses a multiple of it."""


def due_at_start(observers) -> list:
    """Return the observers that look before the first step of a call."""
    return [observer for observer in observers if observer.interval <= EVERY_STEP]


def due_after_step(observers, began: float, time: float) -> list:
    """Return the observers of whose interval a multiple lies in a step from `began` to `time` [s].

    Rounding lets no multiple be missed or crossed twice.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> second = SimpleNamespace(interval=1.0)
    >>> steps = (0.0, 0.9), (0.9, 3.1), (3.1, 4.0 - 1e-15), (4.0 - 1e-15, 4.5)
    >>> [len(due_after_step([second], *step)) for step in steps]
    [0, 1, 1, 0]
    """

    def crossed(interval):
        return np.floor(time / interval * (1.0 + 1e-12)) > np.floor(began / interval * (1.0 + 1e-12))

    return [o for o in observers if time - began >= o.interval or crossed(o.interval)]
