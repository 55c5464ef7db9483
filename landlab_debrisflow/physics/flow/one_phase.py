"""Grains and water move together."""

import numpy as np

from ...core.parameters import declared
from ...spatial.summation import sum_pressure_gradient
from ..contracts import FlowState


@declared
class OnePhase:
    """Depth-averaged momentum of one phase: rho h dv/dt = - grad(1/2 rho g cos(theta) h^2) + ...

    Pastor et al. (2022), eq. 18, with the misprinted thrust mended; h is slope-normal.
    """

    def thrust(self, state: FlowState, cells, shock_viscosity: float, threads: int, acceleration, thickening) -> None:
        """Write the acceleration by pressure, (3, n) [m s-2], and the thickening rate, (n,) [m s-1]."""
        normal_gravity = state.gravity * state.cos_slope
        sum_pressure_gradient(
            cells, state.x, state.y, state.z, state.velocity, state.volume, state.smoothing_length,
            0.5 * normal_gravity / state.gradient_term, np.sqrt(normal_gravity * state.thickness),
            state.thickness, shock_viscosity, acceleration, thickening, threads,
        )  # fmt: skip
