"""A bed that does not erode."""

from ...core.parameters import declared
from ..contracts import BasalState


@declared
class NoErosion:
    """e_R = 0: a bed that does not erode.

    Symbol: e_R erosion rate per map area [m s-1].

    References
    ----------
    The balance of mass of Pastor et al. (2022) without its source.
    """

    def entrainment_rate(self, state: BasalState, out) -> None:
        """Write an erosion rate of 0 into `out`, shape (n,) [m s-1], whatever the `state`.

        Parameters
        ----------
        state : BasalState
            Base of the flow under n particles.
        out : ndarray, shape (n,)
            Written: bed volume per map area and time, >= 0 [m s-1].
        """
        out[:] = 0.0
