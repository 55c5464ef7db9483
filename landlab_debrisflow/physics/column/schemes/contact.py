"""Condition at the base of a column in one step, and its values as kernels read them."""

from ....core.jit import inner
from ...column_contracts import BaseContact

# numba does not convert members of an enumeration to floats
BY_EROSION = int(BaseContact.BY_EROSION)
IMPERMEABLE = int(BaseContact.IMPERMEABLE)
PRESCRIBED = int(BaseContact.PRESCRIBED)
ERODING = int(BaseContact.ERODING)
INFLOW = int(BaseContact.INFLOW)
SEALED = int(BaseContact.SEALED)


@inner
def contact_of(base, entrained, flux):
    """Return the `BaseContact` of a column in a step: one of `IMPERMEABLE` to `SEALED`.

    Parameters
    ----------
    base : int
        `BaseContact` given for the step.
    entrained : float
        Volume that came in [m3].
    flux : bool
        Whether soil from the bed brings its own pressure and no more.
    """
    if base == PRESCRIBED:
        return PRESCRIBED
    if entrained <= 0.0:
        return IMPERMEABLE
    if base == IMPERMEABLE:
        return SEALED
    return INFLOW if flux or base == INFLOW else ERODING
