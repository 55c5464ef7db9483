"""A bed that does not erode."""

from ...core.parameters import declared
from ..contracts import BasalState


@declared
class NoErosion:
    """e_R = 0: a bed that does not erode.

    References
    ----------
    The balance of mass of Pastor et al. (2022) without its source.
    """

    def entrainment_rate(self, state: BasalState, out) -> None:
        """Write zeros [m s-1]."""
        out[:] = 0.0
