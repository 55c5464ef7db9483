"""Monitor of a run by the wall clock: one line on a terminal, in a notebook, or in a log every so often."""

import logging
import math
from collections.abc import Callable
from time import monotonic
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.words import duration_text, grouped
from .end_estimate import EndEstimate

if TYPE_CHECKING:
    from rich.console import Console

log = logging.getLogger("landlab_debrisflow.progress")

LIVE, LOGGED = 0.2, 30.0
"""Wall time between updates of a line that is shown, and between lines of a log [s]."""

COMPILING = "compiling kernels, once after an installation: 10 to 30 s"
"""Text shown while the first step waits for numba."""


class Monitor:
    """Observer that shows a run by the wall clock: time, moving volume, elevation of the front, speed, estimated end.

    On a terminal and in a notebook one line is renewed; in any case a line goes to the logger
    "landlab_debrisflow.progress" at the level INFO every half minute. Fields of the grid are not written for the
    monitor; between two updates it reads nothing but the clock. "At most" so much time left is the longest duration at
    the pace of the last half minute, "about" an estimate: see `EndEstimate`.

    Parameters
    ----------
    console : rich.console.Console, optional
        Where the line is shown; standard error by default. If this is no terminal, no line is shown.
    live : bool
        Whether a line is shown at all.
    clock : callable
        Returns the wall time [s].

    Attributes
    ----------
    line : str
        The last line.
    """

    interval = math.inf

    def __init__(
        self, console: "Console | None" = None, live: bool = True, clock: Callable[[], float] = monotonic
    ) -> None:
        self._clock = clock
        self._estimate = EndEstimate()
        self._display = _display(console) if live else None
        self._due = self._due_in_log = -math.inf
        self.line = self._said = self._logged = ""

    def expect(self, until: float = math.inf, rest_energy: float = 1e-4) -> None:
        """Estimate the end of a run that begins now.

        Parameters
        ----------
        until : float
            Elapsed time at which the run ends in any case [s]; infinite if there is none.
        rest_energy : float
            Kinetic energy over its peak at which the flow counts as at rest [-], of `Numerics`.
        """
        self._estimate = EndEstimate(until, rest_energy)

    def follow(self, particles: Any, began: float, time: float) -> None:
        """Show the flow after a step, if the last update is long enough ago.

        Parameters
        ----------
        particles : Particles
            As they move; only read.
        began, time : float
            Elapsed times between which the step was [s].
        """
        now = self._clock()
        if now < self._due:
            return
        self._due = now + (LIVE if self._display else 1.0)
        awake = slice(particles.awake)
        speed2 = np.einsum("ki,ki->i", particles.velocity[:, awake], particles.velocity[:, awake])
        volume, moving = particles.volume[awake], speed2 > 0.0
        self._estimate.add(now, time, float(np.dot(volume, speed2)))
        front = particles.z[awake][moving].min() if moving.any() else None
        words = f"{time:.1f} s, moving {grouped(volume[moving].sum())} m3"
        if front is not None:
            words += f" at up to {math.sqrt(speed2.max()):.1f} m/s, front at {front:.0f} m"
        self.line = words + self._end()
        self._show(now)

    def observe(self, flow: Any) -> None:
        """Show the flow when it comes to rest."""
        budget = flow.budget
        mass = f"{grouped(budget['moving'] + budget['deposited'])} m3"
        self.line = f"{flow.elapsed_time:.1f} s, {'at rest' if flow.at_rest else 'nothing moves'}, {mass} deposited"
        self._due_in_log = -math.inf
        self._show(self._clock())

    def close(self) -> None:
        """End the line that is shown, so that something else can be printed."""
        if self._display:
            self._display.close()

    def finish(self) -> None:
        """End the line that is shown, and log the last one if that was not done."""
        if self.line != self._logged:
            self._log()
        self.close()

    def _log(self) -> None:
        self._logged = self.line
        log.info("%s", self.line)

    def say(self, text: str) -> None:
        """Show a text in place of the line until the next step, for example why the first step takes long."""
        if text != self._said:
            log.info("%s", text)
        self._said = text
        if self._display:
            self._display.show(text)

    def _end(self) -> str:
        left = self._estimate.remaining()
        return "" if left is None else f", {'at most' if left.bound else 'about'} {duration_text(left.seconds)} left"

    def _show(self, now: float) -> None:
        if self._display:
            self._display.show(self.line)
        if now >= self._due_in_log:
            self._due_in_log = now + LOGGED
            self._log()


def _display(console: "Console | None") -> "TerminalLine | NotebookLine | None":
    from rich.console import Console  # imported here because loading takes 30 ms

    console = console or Console(stderr=True)
    if console.is_jupyter:
        return NotebookLine()
    return TerminalLine(console) if console.is_terminal and not console.is_dumb_terminal else None


class TerminalLine:
    """One line of a terminal that is written over.

    Parameters
    ----------
    console : rich.console.Console
    """

    def __init__(self, console: "Console"):
        self._console, self._open = console, False

    def show(self, text: str) -> None:
        """Write a text over the line, cut to the width of the terminal."""
        self._console.file.write(f"\r\x1b[2K{text[: self._console.width - 1]}")
        self._console.file.flush()
        self._open = True

    def close(self) -> None:
        """Go to the next line."""
        if self._open:
            self._console.file.write("\n")
            self._console.file.flush()
            self._open = False


class NotebookLine:
    """One line of a notebook's output that is replaced."""

    def __init__(self) -> None:
        self._handle: Any = None

    def show(self, text: str) -> None:
        """Show a text in place of the last one."""
        from IPython.display import display  # IPython is installed wherever a notebook runs

        data = {"text/plain": text}
        if self._handle is None:
            self._handle = display(data, raw=True, display_id=True)
        else:
            self._handle.update(data, raw=True)

    def close(self) -> None:
        """Leave the line as it is; the next text gets a new one."""
        self._handle = None
