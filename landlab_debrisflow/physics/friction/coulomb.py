"""Coulomb friction on the effective normal stress, with cohesion and a viscous part."""

import math

import numpy as np

from ...core.constants import THINNEST
from ...core.parameters import declared, parameter
from ..contracts import BasalState
from .shear import strength

SHEAR_AT_BASE = {"linear": 2.0, "parabolic": 3.0}
"""Shear rate at the base over (v - v_b)/h_n, v being the mean velocity, by velocity profile."""


@declared
class Coulomb:
    """tau_b = c + sigma' tan(phi) + k mu (v - v_b)/h_n: friction on the effective normal stress, with a viscous part.

    Symbols: tau_b basal shear stress [Pa]; c, `cohesion` [Pa]; phi, `basal_friction_angle` [deg]; sigma' effective
    normal stress [Pa]; mu, `viscosity` [Pa s]; v mean speed and v_b speed at the base [m s-1]; h_n slope-normal
    thickness [m]; rho' buoyant density [kg m-3]; g_n normal gravity [m s-2]; p_b excess pore pressure at the base [Pa].

    sigma' = max(0, rho' g_n h_n - p_b), with g_n including the curvature of the bed. The excess pore pressure p_b
    lowers it; at full liquefaction cohesion c and the viscous part are left. k is 2 for a velocity that grows linearly
    from v_b at the base to the surface, 3 for a parabola without shear at the surface: 2 mu v/h_n without slip,
    (4/3) mu v/h_n at v_b = v/3, 3 mu v/h_n. v_b/v is the material's `basal_slip_ratio`.

    References
    ----------
    Pastor et al. (2022), section 4.2; Terzaghi's effective stress.
    """

    basal_friction_angle: float = parameter(
        "deg", "friction angle between grains and bed, on effective stress",
        math.degrees(math.atan(0.6)), (0.0, 89.0), varies=True,
    )  # fmt: skip
    cohesion: float = parameter("Pa", "strength without normal stress; no pore pressure lowers it", 0.0, (0.0, None),
                                varies=True)  # fmt: skip
    viscosity: float = parameter("Pa s", "of the sheared mixture; 0.5 at Tsing Shan", 0.0, (0.0, None), varies=True)
    velocity_profile: str = parameter("-", "over the thickness, for the viscous part", "linear", choices=SHEAR_AT_BASE)

    def basal_resistance(self, state: BasalState, yield_stress, drag) -> None:
        """Write `yield_stress`, c + friction [Pa], and `drag`, the viscous part over speed [Pa s m-1], each (n,).

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
        factor = here.velocity_profile * (1.0 - state.material.basal_slip_ratio)
        np.divide(factor * here.viscosity, np.maximum(state.thickness, THINNEST), out=drag)
