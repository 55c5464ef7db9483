"""Decorators of numba, named here only, so that every kernel is compiled alike.

Kernels are cached on disk, release the interpreter lock (members of an ensemble and ranges of
cells run in threads) and may reorder sums, but never assume that numbers are finite: a NaN must
survive until the check after the step. But in a kernel np.isfinite() asks whether v - v is a number, and of a v
that is itself a sum reordering makes that 0: compare abs(v) with infinity instead. The order of sums is decided when
a kernel is compiled, the same way every time: on one machine results are bit-equal, whichever process compiled it.
Another processor may get other bits.

Functions that Python calls are compiled once and cached. Functions that a kernel calls are compiled again as
a part of it, so a large function is best called from one place, and a stage that is called from
several is best a kernel that Python calls (3 to 6 us). `python -m benchmarks.start --kernels` shows
what each costs. A kernel calls no kernel: see `inner`.
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

Such a function always becomes a part of its callers. As a function of its own it would be in the object code of each of
them, by one name, reordered differently; a process calls the copy it meets first, which is another one when kernels are
compiled than when they are loaded."""
