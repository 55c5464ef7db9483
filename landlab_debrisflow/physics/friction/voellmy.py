"""Coulomb friction with Voellmy's drag, which grows with the square of the speed."""

import math

from ...core.jit import kernel
from ...core.parameters import declared, parameter
from ..contracts import BasalState


@declared
class Voellmy:
    """tau_b = max(0, rho' g_n h_n - p_b) tan(phi) + rho g v^2 / xi.

    Voellmy (1955); Hungr (1995). The terminal speed on a plane follows from
    v^2 = xi h_n (sin(theta) - mu_a cos(theta)).
    """

    basal_friction_angle: float = parameter(
        "deg", "friction angle between grains and bed, on effective stress",
        math.degrees(math.atan(0.6)), (0.0, 89.0),
    )  # fmt: skip
    turbulent_coefficient: float = parameter("m s-2", "Voellmy's xi: large means little drag", 500.0, (1.0, None))

    def basal_resistance(self, state: BasalState, yield_stress, drag) -> None:
        """Write the yield stress [Pa] and the drag per speed, rho g v / xi [Pa s m-1]."""
        _resist(
            math.tan(self.si.basal_friction_angle), state.density * state.gravity / self.turbulent_coefficient,
            state.buoyant_density, state.normal_gravity, state.thickness, state.excess_pore_pressure,
            state.speed, yield_stress, drag,
        )  # fmt: skip


@kernel
def _resist(tan_phi, factor, buoyant_density, normal_gravity, thickness, pressure, speed, yield_stress, drag):
    for i in range(thickness.size):
        stress = buoyant_density * normal_gravity[i] * thickness[i] - pressure[i]
        yield_stress[i] = max(0.0, stress) * tan_phi
        drag[i] = factor * speed[i]
