"""Requests to end a call early, by Ctrl-C or by an observer that fails; both wait for the end of the step."""

import logging
import signal
import threading
from contextlib import ExitStack, contextmanager

from ..core.ending import noting_requests
from ..core.errors import InputError

log = logging.getLogger("landlab_debrisflow")


class Interruption:
    """Context of every call, which asks it between two steps whether an end is `requested`.

    Ctrl-C is noted instead of raised while a call runs in the main thread, unless the user's program has a handler of
    its own in place of Python's; so is a request of `core.ending.request_end`. A second one is raised at once, unless
    interruptions are `deferred`: within a step it undoes the call, as any failure in a step does; within an observer it
    counts as a failure of the observer.

    Attributes
    ----------
    failure : BaseException or None
        The first thing that an observer raised in this call.
    end : float or None
        Time until which the call is to go [s]; None before the first.

    Raises
    ------
    InputError
        When entered again from inside.
    """

    def __init__(self):
        self.failure = self.end = None
        self._running = self._asked = self._raised = False
        self._deferred = 0

    def __enter__(self):
        if self._running:
            raise InputError(
                "a call of run_one_step, run_until_rest or settle came while another one runs, as from an observer; "
                "observe(flow) may look at the flow but not run it: call when the run has ended"
            )
        self._asked, self._raised, self.failure, self._deferred = False, False, None, 0
        self._signals = ExitStack()
        if threading.current_thread() is threading.main_thread():
            self._signals.enter_context(noting_requests(self._note))
            if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
                signal.signal(signal.SIGINT, lambda number, frame: self._note())
                self._signals.callback(signal.signal, signal.SIGINT, signal.default_int_handler)
        self._running = True
        return self

    def __exit__(self, *_):
        self._deferred, self._running = 1, False
        self._signals.close()

    @property
    def running(self) -> bool:
        """Whether a call runs."""
        return self._running

    @contextmanager
    def deferred(self):
        """Defer interruptions to the end of the block, however often Ctrl-C is pressed."""
        self._deferred += 1
        try:
            yield
        finally:
            self._deferred -= 1

    def add_failure(self, failure: BaseException) -> None:
        """Note the failure of an observer, if only because Ctrl-C was raised in it."""
        self._raised = False
        if self.failure is None:
            self.failure = failure
        else:
            self.failure.add_note(f"another observer failed, too: {failure!r}")

    @property
    def requested(self) -> bool:
        """Whether the call shall end after the step."""
        return self._asked or self.failure is not None

    def raise_cause(self, time: float, done: bool) -> None:
        """Raise the cause of an interruption, if there was one, with its time [s] and how to go on."""
        cause = KeyboardInterrupt() if self.failure is None and self._asked else self.failure
        if cause is None:
            return
        then = "the call had come to its end" if done else "run_until_rest() or run_one_step(dt) goes on from there"
        words = f"{type(cause).__name__} at {time:.6g} s: everything computed until then is kept, and {then}"
        log.warning("%s", words)
        cause.add_note(words)
        raise cause

    def _note(self):
        if self._asked and not self._deferred and not self._raised:
            self._raised = True  # a further Ctrl-C must not interrupt the handling of this one
            raise KeyboardInterrupt
        self._asked = True
