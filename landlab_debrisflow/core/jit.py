"""The one place that names numba's decorator, so that every kernel is compiled alike.

Kernels are cached on disk, release the interpreter lock (members of an ensemble and ranges of
cells run in threads) and may reorder sums, but never assume that numbers are finite: a NaN must
survive until the check after the step. Reordering happens at compile time, so results stay
bit-equal from run to run.
"""

from typing import Any

import numba

kernel: Any = numba.njit(cache=True, nogil=True, error_model="numpy", fastmath={"reassoc", "contract", "arcp", "nsz"})
