"""Coulomb friction on the effective normal stress."""

import math

from ...core.jit import kernel
from ...core.parameters import declared, parameter
from ..contracts import BasalState


@declared
class Coulomb:
    """tau_b = max(0, rho' g_n h_n - p_b) tan(phi), with g_n including the curvature of the bed.

    The excess pore pressure p_b lowers the effective normal stress; at full liquefaction nothing is
    left. Pastor et al. (2022), section 4.2; Terzaghi's effective stress.
    """

    basal_friction_angle: float = parameter(
        "deg", "friction angle between grains and bed, on effective stress",
        math.degrees(math.atan(0.6)), (0.0, 89.0),
    )  # fmt: skip

    def basal_resistance(self, state: BasalState, yield_stress, drag) -> None:
        """Write the yield stress [Pa]; there is no drag."""
        _resist(
            math.tan(self.si.basal_friction_angle), state.buoyant_density, state.normal_gravity,
            state.thickness, state.excess_pore_pressure, yield_stress, drag,
        )  # fmt: skip


@kernel
def _resist(tan_phi, buoyant_density, normal_gravity, thickness, pressure, yield_stress, drag):
    for i in range(thickness.size):
        stress = buoyant_density * normal_gravity[i] * thickness[i] - pressure[i]
        yield_stress[i] = max(0.0, stress) * tan_phi
        drag[i] = 0.0
