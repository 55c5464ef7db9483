"""Coulomb friction on the effective normal stress."""

import math

import numpy as np

from ...core.parameters import declared, parameter
from ..contracts import BasalState


@declared
class Coulomb:
    """tau_b = sigma' tan(phi), sigma' = max(0, rho' g_n h_n - p_b), with g_n including the curvature of the bed.

    The excess pore pressure p_b lowers the effective normal stress; at full liquefaction nothing is
    left.

    References
    ----------
    Pastor et al. (2022), section 4.2; Terzaghi's effective stress.
    """

    basal_friction_angle: float = parameter(
        "deg", "friction angle between grains and bed, on effective stress",
        math.degrees(math.atan(0.6)), (0.0, 89.0), varies=True,
    )  # fmt: skip

    def basal_resistance(self, state: BasalState, yield_stress, drag) -> None:
        """Write the yield stress [Pa]; there is no drag."""
        np.multiply(np.tan(state.parameters.basal_friction_angle), state.effective_normal_stress, out=yield_stress)
        drag[:] = 0.0
