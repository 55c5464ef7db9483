"""Observer that saves a flow by the clock on the wall."""

import os
from time import monotonic
from typing import Any

from .files import check_writable
from .observers import check_interval


class Checkpoints:
    """Saves the flow at intervals of wall time, and when a call is interrupted.

    The clock is read after every step, when all observers have been called. The checkpoint before the last one is kept
    beside it, under a name with ``.previous`` in it. `DebrisFlow.load` goes on from either.

    Parameters
    ----------
    path : str or os.PathLike
        File of the checkpoint.
    interval : float
        Wall time between checkpoints [s].

    Raises
    ------
    InputError
        If the interval is not > 0, or the file could not be written: before anything is computed.

    Examples
    --------
    >>> Checkpoints("event.checkpoint.nc", interval=300.0).wall_interval
    300.0
    """

    interval = float("inf")
    """Event time between calls of `observe` [s]: none are needed."""

    def __init__(self, path: str | os.PathLike[str], interval: float = 60.0) -> None:
        self.path, self.wall_interval = check_writable(path), check_interval(interval, type(self).__name__)
        self._last: float | None = None  # wall time [s]
        self._tried: float | None = None  # elapsed time of the step that was saved last [s]

    def observe(self, flow: Any) -> None:
        """Do nothing: checkpoints are made between steps."""

    def keep(self, flow: Any, broken_off: bool) -> None:
        """Save the flow if it is time to, or if the run is broken off.

        Parameters
        ----------
        flow : DebrisFlow
            The component between two steps.
        broken_off : bool
            Whether the call ends here before its time.

        Raises
        ------
        InputError
            If the file cannot be written; the checkpoint before stays.
        """
        now = monotonic()
        if self._last is None:
            self._last = now
        due = now - self._last >= self.wall_interval
        if broken_off:  # a save after this step that succeeded, or failed, is not repeated
            due = self._tried != flow.elapsed_time
        self._tried = None
        if due:
            self._last, self._tried = now, flow.elapsed_time
            flow.save(self.path)
            self._last = monotonic()
