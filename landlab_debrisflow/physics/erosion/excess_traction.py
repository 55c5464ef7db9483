"""Erosion by the shear stress of the flow in excess of the strength of the bed."""

from typing import ClassVar

import numpy as np

from ...core.parameters import declared, parameter
from ..contracts import BasalState

ROUNDING = 1e-12
"""Excess over the normal stress [-] that is rounding only: a flow and a bed of one strength must not erode by it."""


@declared
class ExcessTraction:
    """e_R = (tau_b - s_b)/(rho_b (v - v_b) cos(theta)), at most a highest rate: stress beyond the bed's strength.

    Symbols: e_R erosion rate per map area [m s-1]; tau_b shear stress of the friction law at the base of the flow [Pa];
    s_b shear strength of the bed [Pa]; rho_b density of the soil [kg m-3]; v, v_b mean and basal speed of the flow
    [m s-1]; theta slope of the bed.

    s_b = c_b + max(0, sigma_n - p_bed) tan(phi_b), with c_b `bed_cohesion` [Pa], phi_b `bed_friction_angle` [deg],
    sigma_n = rho g_n h_n the total normal stress at the base [Pa], and p_bed = S (rho_w g_n h_n + r_b p_liq) the pore
    pressure of the bed below it [Pa]: S the bed's degree of saturation (`bed__degree_of_saturation`), rho_w g_n h_n
    hydrostatic pressure, r_b the bed's pressure ratio or that of a bed that the flow loads, p_liq liquefaction
    pressure. A wet, liquefied bed has no strength but cohesion; a dry one resists the whole weight and stays. Where
    tau_b exceeds s_b, the excess speeds soil up to the flow: tau_b, which the friction law applies to the flow, already
    contains the momentum of this soil, which is not taken a second time. Below a speed nothing erodes.

    References
    ----------
    Iverson (2012), J. Geophys. Res. 117, F03006; Iverson & Ouyang (2015), Rev. Geophys. 53, 27-58; the part S of pore
    pressure that counts is of Bishop (1959); 5 to 10 cm/s were measured by Reid et al. (2011).
    """

    bed_friction_angle: float = parameter(
        "deg", "friction angle of the bed, on effective stress", float(np.degrees(np.arctan(0.6))), (0.0, 89.0),
        varies=True,
    )  # fmt: skip
    bed_cohesion: float = parameter("Pa", "strength of the bed without normal stress", 0.0, (0.0, None), varies=True)
    highest_rate: float = parameter("m s-1", "erosion rate per map area not exceeded", 0.1, (0.0, None), varies=True)
    least_speed: float = parameter("m s-1", "speed below which nothing erodes", 0.1, (1e-6, None))

    is_jump_condition: ClassVar[bool] = True

    def entrainment_rate(self, state: BasalState, out) -> None:
        """Write the demanded erosion rate per map area into `out`, shape (n,) [m s-1], of a `state`.

        Parameters
        ----------
        state : BasalState
            Base of the flow under n particles.
        out : ndarray, shape (n,)
            Written: bed volume per map area and time, >= 0 [m s-1].
        """
        here, material, bed, tiny = state.parameters, state.material, state.bed, np.finfo(float).tiny
        normal = state.density * state.normal_gravity * state.thickness
        hydrostatic = material.bearing_density * state.normal_gravity * state.thickness
        pressure = bed.degree_of_saturation * (hydrostatic + bed.pressure_ratio * state.stress.liquefaction)
        strength = here.bed_cohesion + np.maximum(0.0, normal - pressure) * np.tan(here.bed_friction_angle)
        excess = state.stress.shear - strength
        excess[excess <= ROUNDING * normal] = 0.0
        excess *= state.depth / np.maximum(state.thickness, tiny)  # per map area: over cos(theta)
        speed = (1.0 - material.basal_slip_ratio) * np.maximum(state.speed, here.least_speed)
        soil_density = material.density_of(material.soil_porosity)
        with np.errstate(over="ignore"):  # soil that slips along as fast as the flow: bounded by the highest rate
            np.divide(excess, np.maximum(soil_density * speed, tiny), out=out)
        np.minimum(out, here.highest_rate, out=out)
        out[state.speed < here.least_speed] = 0.0
