"""Decorators of numba, named here only, so that every kernel is compiled alike.

Kernels are cached on disk, release the interpreter lock (members of an ensemble and ranges of
cells run in threads) and may reorder sums, but never assume that numbers are finite: a NaN must
survive until the check after the step. A kernel must not call np.isfinite(v), which tests v - v: if v is a sum,
reordering simplifies v - v to 0. Compare abs(v) with infinity instead. The order of sums is decided when a kernel is
compiled, the same way every time: on one machine results are bit-equal, whichever process compiled it. Another
processor may get other bits.

Functions that Python calls (`kernel`) are compiled once and cached. Functions that a kernel calls (`inner`) are
compiled again as a part of every caller. A large function is therefore best called from one place, and a stage that
several places call is best a kernel of its own: a call from Python takes 3 to 6 us. `python -m benchmarks.start
--kernels` shows how long each kernel compiles. A kernel calls no kernel: see `inner`.
"""

from typing import Any

import numba
from numba.core import event as events
from numba.extending import register_jitable

__all__ = ["approximate_kernel", "events", "inner", "kernel"]

_REORDER = {"reassoc", "contract", "arcp", "nsz"}

_CHOICES: dict[str, Any] = {
    "nogil": True,
    "error_model": "numpy",
    "no_cfunc_wrapper": True,  # nothing is called from C
}

kernel: Any = numba.njit(cache=True, fastmath=_REORDER, **_CHOICES)
"""Decorator of functions that Python calls."""

approximate_kernel: Any = numba.njit(cache=True, fastmath=_REORDER | {"afn"}, **_CHOICES)
"""`kernel` for sums of floats whose reciprocal roots may be the processor's estimate, refined once (3e-7)."""

inner: Any = register_jitable(fastmath=_REORDER, forceinline=True, **_CHOICES)
"""Decorator of functions that only kernels call. Without an entry from Python and a file in the cache they cost half
the time to compile. Called from Python they run as plain Python.

Such a function always becomes a part of its callers. If it were a function of its own, the object code of every caller
would hold a copy of it by the same name, each with its own order of sums. A process calls the copy that it meets first,
and this is a different one when kernels are compiled than when they are loaded from the cache: results would depend on
the cache."""
