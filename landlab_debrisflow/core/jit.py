"""The one place that names numba's decorator, so that every kernel is compiled alike.

Kernels are cached on disk, release the interpreter lock (members of an ensemble and ranges of
cells run in threads) and may reorder sums, but never assume that numbers are finite: a NaN must
survive until the check after the step. Reordering happens at compile time, so results stay
bit-equal from run to run.
"""

from typing import Any

import numba

_REORDER = {"reassoc", "contract", "arcp", "nsz"}

kernel: Any = numba.njit(cache=True, nogil=True, error_model="numpy", fastmath=_REORDER)

approximate_kernel: Any = numba.njit(cache=True, nogil=True, error_model="numpy", fastmath=_REORDER | {"afn"})
"""The same for sums of floats whose reciprocal roots may be the processor's estimate, refined once (3e-7)."""
