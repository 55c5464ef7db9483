"""Coulomb friction and cohesion with Voellmy's drag, which grows with the square of the speed."""

import math

import numpy as np

from ...core.parameters import declared, parameter
from ..contracts import BasalState
from .shear import strength


@declared
class Voellmy:
    """tau_b = c + sigma' tan(phi) + rho g v^2/xi: friction and a drag that grows with the square of the speed.

    Symbols: tau_b basal shear stress [Pa]; c, `cohesion` [Pa]; phi, `basal_friction_angle` [deg]; sigma' effective
    normal stress [Pa]; rho density and rho' buoyant density [kg m-3]; g gravity and g_n normal gravity [m s-2]; v speed
    [m s-1]; xi, `turbulent_coefficient` [m s-2]; h_n slope-normal thickness [m]; p_b excess pore pressure at the base
    [Pa]; theta slope of the bed; mu_a apparent friction [-].

    sigma' = max(0, rho' g_n h_n - p_b). The terminal speed on a plane follows from
    v^2 = xi (h_n (sin(theta) - mu_a cos(theta)) - c/(rho g)).

    References
    ----------
    Voellmy (1955); Hungr (1995).
    """

    basal_friction_angle: float = parameter(
        "deg", "friction angle between grains and bed, on effective stress",
        math.degrees(math.atan(0.6)), (0.0, 89.0), varies=True,
    )  # fmt: skip
    cohesion: float = parameter("Pa", "strength without normal stress; no pore pressure lowers it", 0.0, (0.0, None),
                                varies=True)  # fmt: skip
    turbulent_coefficient: float = parameter(
        "m s-2", "Voellmy's xi: large means little drag", 500.0, (1.0, None), varies=True
    )

    def basal_resistance(self, state: BasalState, yield_stress, drag) -> None:
        """Write `yield_stress`, c + friction [Pa], and `drag`, rho g v / xi [Pa s m-1], each (n,), from a `state`.

        Parameters
        ----------
        state : BasalState
            Base of the flow under n particles.
        yield_stress : ndarray, shape (n,)
            Written: stress that holds a body at rest, >= 0 [Pa].
        drag : ndarray, shape (n,)
            Written: other resistance over speed, >= 0 [Pa s m-1].
        """
        here = state.parameters
        strength(here.cohesion, here.basal_friction_angle, state, yield_stress)
        np.multiply(state.material.gravity / here.turbulent_coefficient, state.density * state.speed, out=drag)
