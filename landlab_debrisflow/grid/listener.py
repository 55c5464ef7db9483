"""The border while the model runs: rows are copied, peaks recorded, observers called, and the end is written."""

from collections.abc import Callable
from threading import get_ident

from ..model.schedule import due_after_step, due_at_start
from .interruption import Interruption
from .owned import OwnedByFlow
from .reports import Reports
from .write import FieldWriter


class CallListener(OwnedByFlow):
    """Listener to a run: `Simulation.run` tells it of every step and asks it whether to end.

    Observers see the grid as the end of a call would leave it, which is then taken back. Further methods of observers
    are called, too: ``prepare(grid, setup)`` when the component is built, where observers refuse a grid or setup that
    does not fit, and again when it adopts a plan; ``follow(particles, began, time)`` after every step, with the
    particles as they are, and before the first step of a call with ``began`` equal to ``time``; ``keep(flow,
    broken_off)`` between two steps, when all have seen the last one.

    Parameters
    ----------
    flow : DebrisFlow
        Component that is shown to its observers.
    writer : FieldWriter
        Writes the fields of the component.
    interruption : Interruption

    Attributes
    ----------
    reports : Reports
        Messages at the end of a call.
    requests : list of callable
        To be called without arguments as soon as the run is between two steps, once each.
    paused : int or None
        Thread of a call that is between two steps, all observers having seen the last one; None: there is none.
    """

    def __init__(self, flow, writer: FieldWriter, interruption: Interruption):
        super().__init__(flow)
        self._writer, self._interruption = writer, interruption
        self.reports, self.requests, self.paused = Reports(flow), [], None
        for observer in flow._observers:
            if callable(getattr(observer, "prepare", None)):
                observer.prepare(flow.grid, flow.setup)

    def begun(self) -> None:
        """Prepare maps and accounts: the model lies on its bed, particles of the release are made."""
        self._writer.begin()

    def started(self, idle: bool) -> None:
        """Keep rows and show the flow before the first step; `idle`: nothing moves yet."""
        self._writer.keep_rows()
        time = self._writer.simulation.time
        self._follow(time, time)
        if not idle:
            self._show(due_at_start(self.flow._observers))
        self._pause()

    def stepped(self, began: float, time: float, idle: bool) -> None:
        """Record peaks and show the flow after a step from `began` to `time` [s]; `idle`: nothing moves any more."""
        self._writer.follow_step()
        self._follow(began, time)
        observers = self.flow._observers
        self._show(observers if idle else due_after_step(observers, began, time))
        self._pause()

    def interrupted(self) -> bool:
        """Return whether the run is to end before the next step."""
        return self._interruption.requested

    def broken_off(self) -> None:
        """Let observers keep the state of a run that ends before its time."""
        self._pause(broken_off=True)

    def ended(self, stop_at_rest: bool, before_settling: Callable[[], None] | None = None) -> None:
        """Show the end of a run `before_settling`, write results, settle mass at rest, log messages."""
        sim = self._writer.simulation
        if before_settling is not None:
            with self._writer.present():
                before_settling()
        with self._interruption.deferred():
            self._writer.close(settle=sim.at_rest and sim.setup.numerics.settle)
            self.reports.log_messages(stop_at_rest)

    def _follow(self, began: float, time: float) -> None:
        """Tell observers of a step from `began` to `time` [s], even if one of them fails."""
        particles = self._writer.simulation.particles
        for observer in self.flow._observers:
            if callable(getattr(observer, "follow", None)):
                self._call(observer.follow, particles, began, time)
        particles.departed = None  # observers that have failed are not called again

    def _show(self, observers) -> None:
        """Show the flow to all observers, even if one of them fails."""
        if not observers:
            return
        with self._writer.present():
            for observer in observers:
                self._call(observer.observe, self.flow)

    def _pause(self, broken_off: bool = False) -> None:
        """Carry out requests of the step, then let observers keep the state; `broken_off`: the run ends here."""
        keepers = [observer for observer in self.flow._observers if callable(getattr(observer, "keep", None))]
        if not (keepers or self.requests):
            return
        self.paused = get_ident()
        requests, self.requests = self.requests, []
        for request in requests:
            self._call(request)
        for observer in keepers:
            self._call(observer.keep, self.flow, broken_off)
        self.paused = None

    def _call(self, observe, *arguments) -> None:
        """Call an observer and note its failure."""
        try:
            observe(*arguments)
        except BaseException as failure:  # a second Ctrl-C, too: the step is complete here
            self._interruption.add_failure(failure)
