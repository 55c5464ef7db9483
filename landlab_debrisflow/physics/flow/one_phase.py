"""Grains and water move together."""

from typing import ClassVar

import numpy as np

from ...core.parameters import declared
from ...spatial.summation import SummationInput, sum_over_neighbours
from ..contracts import FlowState


@declared
class OnePhase:
    """rho h dv/dt = -grad(1/2 rho g cos(theta) h^2) + ...: depth-averaged momentum of one phase, h slope-normal.

    Symbols: rho density [kg m-3]; h slope-normal thickness [m]; v velocity along the bed [m s-1]; t time [s]; g gravity
    [m s-2]; theta slope of the bed; grad along the bed [m-1].

    References
    ----------
    Pastor et al. (2022), eq. 18, with the misprinted thrust mended.
    """

    number_of_phases: ClassVar[int] = 1

    def interact(self, state: FlowState, cells, shock_viscosity: float, threads: int, sums) -> None:
        """Write thickness [m], smoothing length [m], acceleration by pressure [m s-2] and convergence [m s-1].

        Parameters
        ----------
        state : FlowState
            The n particles and ghosts.
        cells : Cells
            Cell list over them.
        shock_viscosity : float
            Strength of the viscosity at shocks [-].
        threads : int
            Number of threads.
        sums : Sums
            Written for the particles in cells that are awake.
        """
        normal_gravity, inertia = state.gravity * state.cos_slope, state.density / state.density.max()
        given = SummationInput(
            position=state.position,
            velocity=state.velocity,
            volume=state.volume,
            smoothing_length=state.smoothing.length,
            longest=state.smoothing.longest,
            pressure_coefficient=0.5 * inertia * normal_gravity / state.smoothing.gradient_term,
            celerity=np.sqrt(normal_gravity * state.thickness),
            thickness=state.thickness,
            convergence=state.thickening,
            inertia=inertia,
        )
        sum_over_neighbours(cells, given, shock_viscosity, sums, threads)
