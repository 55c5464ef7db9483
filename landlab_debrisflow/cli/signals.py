"""Signals of batch systems and terminals that end a run as Ctrl-C does, after its step and with a checkpoint."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from ..core.ending import request_end

ENDING = ("SIGTERM", "SIGHUP")
"""Names of the signals, where the system has them."""


class EndingSignal:
    """Number of the signal that asked for the end.

    Attributes
    ----------
    number : int
        SIGINT, of Ctrl-C, unless another one came.
    """

    def __init__(self) -> None:
        self.number = int(signal.SIGINT)

    def _handle(self, number: int, frame: FrameType | None) -> None:
        self.number = number
        request_end()  # not by SIGINT: shells let their background jobs ignore that one


@contextmanager
def ending_signals() -> Iterator[EndingSignal]:
    """Let signals end a run in a block as Ctrl-C does, unless they are ignored, as under ``nohup``."""
    ending, earlier = EndingSignal(), {}
    if threading.current_thread() is threading.main_thread():
        for name in ENDING:
            number = getattr(signal, name, None)
            if number is not None and signal.getsignal(number) is signal.SIG_DFL:
                earlier[number] = signal.signal(number, ending._handle)
    try:
        yield ending
    finally:
        for number, handler in earlier.items():
            signal.signal(number, handler)
