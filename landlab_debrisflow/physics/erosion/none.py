"""A bed that does not erode."""

from ...core.parameters import declared
from ..contracts import BasalState


@declared
class NoErosion:
    """e_R = 0."""

    def entrainment_rate(self, state: BasalState, out) -> None:
        """Write zeros [m s-1]."""
        out[:] = 0.0
