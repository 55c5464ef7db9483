"""Ctrl-C while workers run batches: kept while these start, and never lost in a callback of a library."""

import signal
import threading
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from multiprocessing import resource_tracker

from ..core.ending import noting_requests


@contextmanager
def interrupts_later() -> Iterator[None]:
    """Keep Ctrl-C until the end of a block; threads and processes that begin in the block never get it.

    A terminal sends Ctrl-C to workers, too; the process that started them ends them in order.
    """
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    resource_tracker.ensure_running()  # its start, within that of the first worker, would let Ctrl-C through again
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


class Interrupts:
    """Context that notes Ctrl-C, to raise it where it is asked; a second one is raised at once.

    Python drops an exception that a signal raises in a finaliser, such as ``Future.__del__`` of dask, and the ensemble
    would run on. A handler of the user's program in place of Python's own stays.
    """

    def __init__(self) -> None:
        self._heard = False
        self._ends = ExitStack()

    def __enter__(self) -> "Interrupts":
        if threading.current_thread() is threading.main_thread():
            self._ends.enter_context(noting_requests(self._note))
            if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
                signal.signal(signal.SIGINT, lambda number, frame: self._note())
                self._ends.callback(signal.signal, signal.SIGINT, signal.default_int_handler)
        return self

    def __exit__(self, *_: object) -> None:
        self._ends.close()

    def check(self) -> None:
        """Raise KeyboardInterrupt if Ctrl-C was heard in this context.

        Raises
        ------
        KeyboardInterrupt
        """
        if self._heard:
            raise KeyboardInterrupt

    def _note(self) -> None:
        if self._heard:
            raise KeyboardInterrupt
        self._heard = True
