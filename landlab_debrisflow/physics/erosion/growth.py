"""Erosion in proportion to depth and speed."""

import numpy as np

from ...core.parameters import declared, parameter
from ..contracts import BasalState


@declared
class Growth:
    """e_R = E_s h v: the flow grows by the fraction E_s per metre of travel.

    Symbols: e_R erosion rate per map area [m s-1]; E_s, the parameter `growth_rate` [m-1]; h vertical depth [m];
    v speed along the bed [m s-1].

    References
    ----------
    McDougall & Hungr (2005); the law used by Pastor et al. (2022), section 4.2.3.
    """

    growth_rate: float = parameter(
        "m-1", "relative growth of volume per metre of travel", 3e-3, (0.0, None), varies=True
    )

    def entrainment_rate(self, state: BasalState, out) -> None:
        """Write the demanded erosion rate per map area into `out`, shape (n,) [m s-1], of a `state`.

        Parameters
        ----------
        state : BasalState
            Base of the flow under n particles.
        out : ndarray, shape (n,)
            Written: bed volume per map area and time, >= 0 [m s-1].
        """
        np.multiply(state.parameters.growth_rate * state.depth, state.speed, out=out)
