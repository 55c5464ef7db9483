"""Erosion of a bed that liquefies under the flow."""

import numpy as np

from ...core.parameters import declared, parameter
from ..contracts import BasalState


@declared
class LiquefiedBed:
    """e_R = 2 tan(phi) sigma'/(rho v cos(theta)), at most a highest rate: a bed that liquefies bears no shear stress.

    Symbols: e_R erosion rate per map area [m s-1]; phi, `basal_friction_angle` [deg]; sigma' effective normal stress at
    the base [Pa]; rho density of the mixture [kg m-3]; v speed [m s-1]; theta slope of the bed; h_n slope-normal
    thickness [m]; g gravity [m s-2].

    All the friction of the flow then accelerates soil: E = 2 mu g h_n cos(theta) (1 - lambda)/v normal to the
    bed, E/cos(theta) per map area. mu = tan(phi) is the flow's coefficient, not the bed's; lambda is pore pressure over
    normal stress, both total, so rho g h_n cos(theta) (1 - lambda) is sigma', the effective normal stress. Below a
    speed nothing erodes. The highest rate is by default the highest one measured, and the law mostly gives this rate:
    without it, flows metres deep would erode metres within seconds.

    References
    ----------
    Iverson (2012), J. Geophys. Res. 117, F03006; 5 to 10 cm/s were measured by Reid et al. (2011).
    """

    basal_friction_angle: float = parameter(
        "deg", "friction angle between grains and bed, on effective stress: that of the friction law",
        float(np.degrees(np.arctan(0.6))), (0.0, 89.0), varies=True,
    )  # fmt: skip
    highest_rate: float = parameter("m s-1", "erosion rate per map area not exceeded", 0.1, (0.0, None), varies=True)
    least_speed: float = parameter("m s-1", "speed below which nothing erodes", 0.1, (1e-6, None))

    def entrainment_rate(self, state: BasalState, out) -> None:
        """Write the demanded erosion rate per map area into `out`, shape (n,) [m s-1], of a `state`.

        Parameters
        ----------
        state : BasalState
            Base of the flow under n particles.
        out : ndarray, shape (n,)
            Written: bed volume per map area and time, >= 0 [m s-1].
        """
        here, tiny = state.parameters, np.finfo(float).tiny
        friction = 2.0 * np.tan(here.basal_friction_angle) * state.stress.effective_normal
        friction *= state.depth / np.maximum(state.thickness, tiny)  # per map area: over cos(theta)
        np.divide(friction, state.density * np.maximum(state.speed, here.least_speed), out=out)
        np.minimum(out, here.highest_rate, out=out)
        out[state.speed < here.least_speed] = 0.0
