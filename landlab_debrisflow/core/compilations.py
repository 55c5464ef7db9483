"""Notice of kernels that are compiled, which takes long once after an installation."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from .jit import events


class _Listener(events.Listener):
    """Calls a function once, when numba begins to compile the first kernel that it did not find in its cache."""

    def __init__(self, notify: Callable[[], None]):
        self._notify, self._notified = notify, False

    def on_start(self, event):
        """Notify of the first compilation that begins."""
        if not self._notified:
            self._notified = True
            self._notify()

    def on_end(self, event):
        """Let a compilation end."""


@contextmanager
def compilations(notify: Callable[[], None]) -> Iterator[None]:
    """Call `notify` when the first compilation of a kernel within a block begins; kernels from the cache are loaded.

    Examples
    --------
    >>> begun = []
    >>> with compilations(lambda: begun.append("compiling")):
    ...     for kernel in range(2):
    ...         with events.trigger_event("numba:compile"):  # as numba does
    ...             pass
    >>> begun
    ['compiling']
    """
    with events.install_listener("numba:compile", _Listener(notify)):
        yield
