"""Decorators of numba, named here only, so that every kernel is compiled alike.

Kernels are cached on disk, release the interpreter lock (members of an ensemble and ranges of
cells run in threads) and may reorder sums, but never assume that numbers are finite: a NaN must
survive until the check after the step. A kernel must not call np.isfinite(v), which tests v - v: if v is a sum,
reordering simplifies v - v to 0. Compare abs(v) with infinity instead. The order of sums is decided when a kernel is
compiled, the same way every time: on one machine results are bit-equal, whichever process compiled it. Another
processor may get other bits.

While numba compiles, Python's garbage collection is off (`Uncollected`).

Functions that Python calls (`kernel`) are compiled once and cached. Functions that a kernel calls (`inner`) are
compiled again as a part of every caller. A large function is therefore best called from one place, and a stage that
several places call is best a kernel of its own: a call from Python takes 3 to 6 us. `python -m benchmarks.start
--kernels` shows how long each kernel compiles. A kernel calls no kernel: see `inner`.
"""

import gc
from threading import Lock
from typing import Any

import numba
from numba.core import event as events
from numba.extending import register_jitable

__all__ = ["allocating_kernel", "approximate_kernel", "events", "inner", "kernel"]

_REORDER = {"reassoc", "contract", "arcp", "nsz"}

_CHOICES: dict[str, Any] = {
    "nogil": True,
    "error_model": "numpy",
    "no_cfunc_wrapper": True,  # nothing is called from C
}

allocating_kernel: Any = numba.njit(cache=True, fastmath=_REORDER, **_CHOICES)
"""Decorator of functions that Python calls, and that may make arrays."""

kernel: Any = numba.njit(cache=True, fastmath=_REORDER, _nrt=False, **_CHOICES)
"""Decorator of functions that Python calls, and that make no array: `np.empty`, `copy` and sums of whole arrays do not
compile. numba then counts no references to arrays: a call with 15 of them takes 0.5 instead of 0.9 us (`python -m
benchmarks.start --calls`). The option has no public name; should a numba refuse it, kernels need only lose it."""

approximate_kernel: Any = numba.njit(cache=True, fastmath=_REORDER | {"afn"}, **_CHOICES)
"""`kernel` for sums of floats whose reciprocal roots may be the processor's estimate, refined once (3e-7)."""

inner: Any = register_jitable(fastmath=_REORDER, forceinline=True, **_CHOICES)
"""Decorator of functions that only kernels call. Without an entry from Python and a file in the cache they cost half
the time to compile. Called from Python they run as plain Python.

Such a function always becomes a part of its callers. If it were a function of its own, the object code of every caller
would hold a copy of it by the same name, each with its own order of sums. A process calls the copy that it meets first,
and this is a different one when kernels are compiled than when they are loaded from the cache: results would depend on
the cache."""


class Uncollected(events.Listener):
    """Switches garbage collection off when compilations begin, and on again after the last, if it was on before.

    A compilation makes some hundred thousand objects, most of which live as long as the kernel. The collector would go
    through them again and again and free next to nothing: a fifth of the first start of an event (`python -m
    benchmarks.start`). Afterwards they count as old, so that only the next full collection goes through them.
    Compilations are nested, because the functions that a kernel calls are compiled within it, and may run in several
    threads. numba also tells of the end of one that fails.
    """

    def __init__(self) -> None:
        self._lock, self._running, self._was_on = Lock(), 0, False

    def on_start(self, event: events.Event) -> None:
        """Count a compilation that begins; before the first, switch garbage collection off."""
        with self._lock:
            if self._running == 0:
                self._was_on = gc.isenabled()
                gc.disable()
            self._running += 1

    def on_end(self, event: events.Event) -> None:
        """Count a compilation that ends; after the last, switch garbage collection on."""
        with self._lock:
            self._running -= 1
            if self._running == 0 and self._was_on:
                if gc.get_freeze_count() == 0:  # what somebody else has frozen stays frozen
                    gc.freeze()
                    gc.unfreeze()
                gc.enable()


events.register("numba:compile", Uncollected())
