"""Messages of a command: errors and warnings on standard error, progress on a terminal or as lines, a log in a file."""

import logging
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rich.console import Console

from ..core.errors import OutputError
from ..core.words import printable
from ..record.files import check_writable
from ..record.monitor import Monitor

PACKAGE = logging.getLogger("landlab_debrisflow")
PROGRESS = "landlab_debrisflow.progress"


class OneLine(logging.Formatter):
    """One line for each message, without control characters."""

    def format(self, record: logging.LogRecord) -> str:
        """Return the line of a record."""
        text = printable(record.getMessage())
        if record.levelno >= logging.WARNING:
            text = f"{record.levelname.lower()}: {text}"
        return f"{self.formatTime(record, '%Y-%m-%d %H:%M:%S')} {text}" if self.usesTime() else text

    def usesTime(self) -> bool:
        """Return whether lines begin with the time."""
        return "asctime" in (self._fmt or "")


class _MonitoredHandler(logging.StreamHandler):
    """Handler that ends the line of a monitor before it writes."""

    def __init__(self, monitor: Monitor):
        super().__init__(sys.stderr)
        self._monitor = monitor

    def emit(self, record: logging.LogRecord) -> None:
        self._monitor.close()
        super().emit(record)


@contextmanager
def messages(quiet: bool = False, verbose: bool = False, log_file: Path | None = None) -> Iterator[Monitor]:
    """Send the messages of the package in a block to the terminal and to a log file; yield the monitor of the run.

    On a terminal progress is one line, elsewhere a line every half minute with the time of day.

    Parameters
    ----------
    quiet : bool
        Whether standard error gets errors only.
    verbose : bool
        Whether standard error gets further messages of the package, besides warnings.
    log_file : Path, optional
        File to which all messages are appended, progress as well.

    Raises
    ------
    OutputError
        If the file cannot be written.
    """
    terminal = Console(stderr=True).is_terminal
    monitor = Monitor(live=terminal and not quiet)
    handler = _MonitoredHandler(monitor)
    handler.setFormatter(OneLine(None if terminal else "%(asctime)s"))
    handler.setLevel(logging.ERROR if quiet else logging.INFO)
    handler.addFilter(lambda record: _is_shown(record, terminal, verbose))
    handlers: list[logging.Handler] = [handler]
    if log_file is not None:
        try:
            check_writable(log_file)
            handlers.append(logging.FileHandler(log_file, encoding="utf-8"))
        except OSError as error:
            raise OutputError(f"cannot write {log_file}: {error.strerror}; choose another file for --log") from error
        handlers[-1].setFormatter(OneLine("%(asctime)s"))
    level, propagate = PACKAGE.level, PACKAGE.propagate
    PACKAGE.setLevel(logging.INFO)
    PACKAGE.propagate = False
    for one in handlers:
        PACKAGE.addHandler(one)
    try:
        yield monitor
    finally:
        monitor.close()
        for one in handlers:
            PACKAGE.removeHandler(one)
            one.close()
        PACKAGE.setLevel(level)
        PACKAGE.propagate = propagate


def _is_shown(record: logging.LogRecord, terminal: bool, verbose: bool) -> bool:
    if record.name == PROGRESS:
        return not terminal
    if record.module == "interruption":  # the error in which the command ends says so
        return False
    return verbose or record.levelno >= logging.WARNING
