"""Which observers look after a step, and what becomes of the call if one of them fails."""

import numpy as np

from ..core.constants import EVERY_STEP
from .interruption import Interruption


def at_start(observers) -> list:
    """Return those who look before the first step of a call."""
    return [observer for observer in observers if observer.interval <= EVERY_STEP]


def after_step(observers, began: float, time: float) -> list:
    """Return those of whose interval a step from `began` to `time` [s] crosses a multiple.

    Rounding lets no multiple be missed or crossed twice.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> second = SimpleNamespace(interval=1.0)
    >>> [len(after_step([second], *step)) for step in ((0.0, 0.9), (0.9, 3.1), (3.1, 4.0 - 1e-15), (4.0 - 1e-15, 4.5))]
    [0, 1, 1, 0]
    """

    def crossed(interval):
        return np.floor(time / interval * (1.0 + 1e-12)) > np.floor(began / interval * (1.0 + 1e-12))

    return [o for o in observers if time - began >= o.interval or crossed(o.interval)]


def look(flow, observers, interruption: Interruption) -> None:
    """Let observers look; whoever fails does not keep the others from it."""
    for observer in observers:
        try:
            observer.observe(flow)
        except BaseException as failure:  # also Ctrl-C for the second time: nothing is half done here
            interruption.note(failure)
