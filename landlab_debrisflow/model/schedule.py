"""Times at which a run calls its listener and observers: at its beginning, after steps, at multiples of intervals."""

import sys
from typing import Protocol

import numpy as np

EVERY_STEP = sys.float_info.min
"""Interval of observers that are called before the first step of a call and after every step [s]: shorter than any
step, so that each step crosses a multiple of the interval."""


class RunListener(Protocol):
    """Listener to `Simulation.run`."""

    def begun(self) -> None:
        """Take note that the flow lies on its bed and that particles of a release are made."""

    def started(self, idle: bool) -> None:
        """The first step is about to be made; `idle`: nothing moves yet."""

    def stepped(self, began: float, time: float, idle: bool) -> None:
        """A step from `began` to `time` [s] was made; `idle`: nothing moves any more."""

    def interrupted(self) -> bool:
        """Return whether the run is to end before the next step."""


def due_at_start(observers) -> list:
    """Return the observers that are called before the first step of a call."""
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
