"""Grains and water move together."""

from typing import ClassVar

import numpy as np

from ...core.jit import allocating_kernel
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
        coefficient, celerity, inertia = _pressure_of(
            state.cos_slope, state.density, state.smoothing.gradient_term, state.thickness, state.gravity
        )
        given = SummationInput(
            position=state.position,
            velocity=state.velocity,
            volume=state.volume,
            smoothing_length=state.smoothing.length,
            longest=state.smoothing.longest,
            pressure_coefficient=coefficient,
            celerity=celerity,
            thickness=state.thickness,
            convergence=state.thickening,
            inertia=inertia,
        )
        sum_over_neighbours(cells, given, shock_viscosity, sums, threads)


@allocating_kernel
def _pressure_of(cosine, density, gradient_term, thickness, gravity):
    """Return pressure coefficient [m s-2], celerity [m s-1] and inertia [-] as `SummationInput` has them, shape (3, n).

    Cosine of the slope [-], density [kg m-3], grad-h term [-] and slope-normal thickness [m] of the particles have
    shape (n,); `gravity` is in m s-2.
    """
    n, densest = density.size, 0.0
    found = np.empty((3, n))
    coefficient, celerity, inertia = found[0], found[1], found[2]
    for i in range(n):
        densest = max(densest, density[i])
    for i in range(n):
        inertia[i] = density[i] / densest
        coefficient[i] = 0.5 * inertia[i] * (gravity * cosine[i]) / gradient_term[i]
        celerity[i] = np.sqrt(gravity * cosine[i] * thickness[i])
    return found
