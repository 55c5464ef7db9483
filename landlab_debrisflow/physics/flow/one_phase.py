"""Grains and water move together."""

from typing import ClassVar

import numpy as np

from ...core.parameters import declared
from ...spatial.summation import Moving, sum_over_neighbours
from ..contracts import FlowState


@declared
class OnePhase:
    """rho h dv/dt = -grad(1/2 rho g cos(theta) h^2) + ...: depth-averaged momentum of one phase, h slope-normal.

    References
    ----------
    Pastor et al. (2022), eq. 18, with the misprinted thrust mended.
    """

    number_of_phases: ClassVar[int] = 1

    def interact(self, state: FlowState, cells, shock_viscosity: float, threads: int, sums) -> None:
        """Write thickness, smoothing length, acceleration by pressure and thickening rate."""
        normal_gravity, inertia = state.gravity * state.cos_slope, state.density / state.density.max()
        moving = Moving(
            *state.position, state.velocity, state.volume, state.smoothing.length, state.smoothing.longest,
            0.5 * inertia * normal_gravity / state.smoothing.gradient_term, np.sqrt(normal_gravity * state.thickness),
            state.thickness, state.thickening, inertia,
        )  # fmt: skip
        sum_over_neighbours(cells, moving, shock_viscosity, sums, threads)
