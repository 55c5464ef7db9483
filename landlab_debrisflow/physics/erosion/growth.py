"""Erosion in proportion to depth and speed."""

from ...core.jit import kernel
from ...core.parameters import declared, parameter
from ..contracts import BasalState


@declared
class Growth:
    """e_R = E_s h v: the flow grows by the fraction E_s per metre of travel.

    McDougall & Hungr (2005), the law used by Pastor et al. (2022), section 4.2.3.
    """

    growth_rate: float = parameter("m-1", "relative growth of volume per metre of travel", 3e-3, (0.0, None))

    def entrainment_rate(self, state: BasalState, out) -> None:
        """Write the erosion rate asked for [m s-1]."""
        _rate(self.growth_rate, state.depth, state.speed, out)


@kernel
def _rate(growth_rate, depth, speed, out):
    for i in range(out.size):
        out[i] = growth_rate * depth[i] * speed[i]
