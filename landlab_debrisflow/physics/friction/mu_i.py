"""Friction that grows with the inertial number of a granular flow."""

import numpy as np

from ...core.constants import THINNEST
from ...core.errors import ParameterError
from ...core.parameters import declared, parameter
from ..contracts import BasalState
from .shear import friction_coefficient

TINY = 1e-300
"""Added to a divisor, so that 0/0, without effective stress and speed, becomes 0."""


@declared
class MuI:
    """tau_b = sigma' (mu_s + (mu_2 - mu_s)/(1 + I_0/I)): granular friction that grows with the inertial number I.

    Symbols: tau_b basal shear stress and sigma' effective normal stress [Pa]; mu_s and mu_2, tangents of
    `static_friction_angle` and `limiting_friction_angle` [-]; I inertial number and I_0, `inertial_number` [-]; v mean
    speed and v_b speed at the base [m s-1]; d, `grain_diameter` [m]; h_n slope-normal thickness [m]; rho_s,
    `grain_density` [kg m-3].

    At the base of a flow with Bagnold's profile, u(z) - v_b ~ h^(3/2) - (h - z)^(3/2), whose mean shears it,
    I = (5/2) (v - v_b) d/(h_n (sigma'/rho_s)^(1/2)). Pore pressure enters through sigma', in the friction and in I:
    a nearly liquefied flow is inertial. Angles and I_0 are by default the values of glass beads.

    References
    ----------
    Jop, Forterre & Pouliquen (2006); at the base Gray & Edwards (2014), where sigma' = phi_c rho_s g h cos(theta).
    """

    static_friction_angle: float = parameter("deg", "of mu_s, for I = 0", 20.9, (0.0, 89.0), varies=True)
    limiting_friction_angle: float = parameter(
        "deg", "of mu_2, for large I; where it is below the static one, that holds", 32.76, (0.0, 89.0), varies=True
    )
    inertial_number: float = parameter("-", "I_0, at which half of the way is gone", 0.279, (1e-6, None), varies=True)
    grain_diameter: float = parameter("m", "d, for the inertial number", 0.01, (1e-6, 10.0), varies=True)
    grain_density: float = parameter("kg m-3", "rho_s, for the inertial number", 2650.0, (1.0, 1e5))

    def _agree(self):
        given = self.static_friction_angle, self.limiting_friction_angle
        if any(isinstance(angle, str) for angle in given):  # the name of a field, known on a grid only
            return
        low, high = (np.atleast_1d(getattr(angle, "values", angle)) for angle in given)
        if low.size != high.size and 1 not in (low.size, high.size):  # a wrong shape is refused on every grid
            return
        low, high = np.broadcast_arrays(low, high)
        # only values at closed nodes may be out of bounds
        bad = np.flatnonzero((high >= 0.0) & (high < low) & (low <= 89.0))
        if bad.size:
            raise ParameterError(
                f"MuI: limiting_friction_angle must be at least static_friction_angle, {low[bad[0]]:g} deg, got "
                f"{high[bad[0]]:g}: friction does not fall with speed in this law; exchange the two, or raise it"
            )

    def basal_resistance(self, state: BasalState, yield_stress, drag) -> None:
        """Write `yield_stress`, static friction [Pa], and `drag`, further friction over speed [Pa s m-1], each (n,).

        Parameters
        ----------
        state : BasalState
            Base of the flow under n particles.
        yield_stress : ndarray, shape (n,)
            Written: stress that holds a body at rest, >= 0 [Pa].
        drag : ndarray, shape (n,)
            Written: other resistance over speed, >= 0 [Pa s m-1].
        """
        here, stress = state.parameters, state.stress.effective_normal
        static = friction_coefficient(here.static_friction_angle, state)
        np.multiply(static, stress, out=yield_stress)
        more = np.maximum(friction_coefficient(here.limiting_friction_angle, state) - static, 0.0)
        # with I = c v/(h sigma'^(1/2)), sigma' (mu - mu_s)/v is multiplied by h sigma'^(1/2), which may be 0
        c = 2.5 * (1.0 - state.material.basal_slip_ratio) * np.sqrt(here.grain_density) * here.grain_diameter
        denominator = np.sqrt(stress)
        denominator *= np.maximum(state.thickness, THINNEST)
        denominator *= here.inertial_number
        denominator += c * state.speed
        denominator += TINY
        np.multiply(more * c, stress, out=drag)
        drag /= denominator
