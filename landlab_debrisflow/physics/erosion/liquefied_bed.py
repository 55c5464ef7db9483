"""Erosion of a bed that liquefies under the flow."""

import numpy as np

from ...core.parameters import declared, parameter
from ..contracts import BasalState


@declared
class LiquefiedBed:
    """E = 2 mu g h_n cos(theta) (1 - lambda) / v, normal to the bed; at most the highest rate, and 0 below some speed.

    Iverson (2012), for a bed that resists with nothing, so that all the friction of the flow, mu times its effective
    normal stress, goes into speeding up soil. mu is the friction coefficient of the flow (his mu_1, not the bed's) and
    lambda pore pressure over normal stress, both total: rho g h_n cos(theta) (1 - lambda) is the effective normal
    stress, so here E = 2 mu sigma' / (rho v) and e_R = E / cos(theta).
    """

    basal_friction_angle: float = parameter(
        "deg", "friction angle between grains and bed, on effective stress: that of the friction law",
        float(np.degrees(np.arctan(0.6))), (0.0, 89.0), varies=True,
    )  # fmt: skip
    highest_rate: float = parameter("m s-1", "erosion rate per map area not exceeded", 0.1, (0.0, None), varies=True)
    least_speed: float = parameter("m s-1", "speed below which nothing erodes", 0.1, (1e-6, None))

    def entrainment_rate(self, state: BasalState, out) -> None:
        """Write the erosion rate asked for [m s-1]."""
        here, tiny = state.parameters, np.finfo(float).tiny
        friction = 2.0 * np.tan(here.basal_friction_angle) * state.effective_normal_stress
        friction *= state.depth / np.maximum(state.thickness, tiny)  # over cos(theta)
        np.divide(friction, state.density * np.maximum(state.speed, self.least_speed), out=out)
        np.minimum(out, here.highest_rate, out=out)
        out[state.speed < self.least_speed] = 0.0
