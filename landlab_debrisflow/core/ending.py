"""Requests to end a run early: the innermost call that runs notes a request, and ends after its step."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

_NOTES: list[Callable[[], None]] = []


@contextmanager
def noting_requests(note: Callable[[], None]) -> Iterator[None]:
    """Give requests to end a run to a function while a block runs.

    Parameters
    ----------
    note : callable
        Called for each request, in the main thread.
    """
    _NOTES.append(note)
    try:
        yield
    finally:
        _NOTES.remove(note)


def request_end() -> None:
    """Ask the innermost call that runs to end after its step, as Ctrl-C does.

    Raises
    ------
    KeyboardInterrupt
        If no call runs, or as the call decides.
    """
    if not _NOTES:
        raise KeyboardInterrupt
    _NOTES[-1]()
