"""Notice of kernels that are compiled, which takes long once after an installation."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from .jit import events


class _Listener(events.Listener):
    """Calls a function when numba begins to compile a kernel that it did not find in its cache."""

    def __init__(self, notify: Callable[[], None]):
        self._notify = notify

    def on_start(self, event):
        """Notify of a compilation that begins."""
        self._notify()

    def on_end(self, event):
        """Let a compilation end."""


@contextmanager
def compilations(notify: Callable[[], None]) -> Iterator[None]:
    """Call `notify` whenever the compilation of a kernel begins within a block; kernels from the cache are loaded.

    Examples
    --------
    >>> begun = []
    >>> with compilations(lambda: begun.append("compiling")):
    ...     with events.trigger_event("numba:compile"):  # as numba does
    ...         pass
    >>> begun
    ['compiling']
    """
    with events.install_listener("numba:compile", _Listener(notify)):
        yield
