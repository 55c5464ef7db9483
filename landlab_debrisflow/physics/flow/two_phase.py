"""Grains and water with velocities of their own."""

from typing import ClassVar

import numpy as np

from ...core.parameters import declared, parameter
from ...spatial.cells import cells_of_phase
from ...spatial.cross_summation import CrossPhaseInput, CrossPhaseSums, sum_over_other_phase
from ...spatial.summation import SummationInput, plain_thickness, sum_over_neighbours
from ..contracts import WATER, FlowState
from .mixture import OverOther, Phased, mix, press


@declared
class TwoPhase:
    """rho_k h_k dv_k/dt = - grad(thrust of phase k) +- h C_d (v_w - v_s) + ...: k is grains or water.

    With the thrust of the effective stress, E = rho' g_n h^2/2 - h p, and of the pore pressure,
    P = rho_w g_n h^2/2 + h p, p being the depth mean of the excess pore pressure, the force per area is
    - grad E - (1 - n) grad P on grains and - n grad P on water, the terms in grad n and grad(n h p) included.
    Drag: Darcy C_d = n^2/k_w, or C_d = n (1 - n) (rho_s - rho_w) g/(V_T n^m).

    References
    ----------
    Pastor et al. (2022), eqs. 10, 11, 21 and 23; without excess pore pressure Pitman & Le (2005); drag of Anderson &
    Jackson (1967).
    """

    drag: str = parameter("-", "drag between grains and water", "darcy", choices=("darcy", "anderson_jackson"))
    hydraulic_conductivity: float = parameter(
        "m s-1", "of Darcy's drag; by default that of the material's coefficient of consolidation and the stiffness",
        None, (1e-15, 1e6),
    )  # fmt: skip
    terminal_velocity: float = parameter(
        "m s-1", "of a single grain that sinks in water, of Anderson & Jackson's drag", 0.1, (1e-12, 1e6)
    )
    drag_exponent: float = parameter(
        "-", "m of Anderson & Jackson's drag: that of Richardson & Zaki (1954) less 1", 3.65, (0.0, 10.0)
    )
    stiffness: float = parameter(
        "Pa", "volumetric stiffness of the skeleton of grains, K_v over alpha", 2.5e5, (0.0, 1e12)
    )
    manning_coefficient: float = parameter("s m-1/3", "Manning's n of the bed, for the water alone", 0.0, (0.0, 1.0))

    number_of_phases: ClassVar[int] = 2

    def drag_coefficient(self, porosity, material):
        """Return C_d, drag between the phases per volume and relative velocity.

        Parameters
        ----------
        porosity : ndarray, shape (n,)
            Pores over the whole [-].
        material : Material
            Densities [kg m-3] and gravity [m s-2].

        Returns
        -------
        ndarray, shape (n,)
            [Pa s m-2]
        """
        if self.drag == "darcy":
            conductivity = self.hydraulic_conductivity
            if conductivity is None:
                return porosity**2 * self.stiffness / material.coefficient_of_consolidation
            return porosity**2 * material.water_density * material.gravity / conductivity
        weight = (material.solid_density - material.water_density) * material.gravity
        return porosity ** (1.0 - self.drag_exponent) * (1.0 - porosity) * weight / self.terminal_velocity

    def coefficient_of_consolidation(self, porosity, material):
        """Return c_v = K n^2/C_d (eq. 19), with which columns consolidate, from the drag between the phases.

        Parameters
        ----------
        porosity : ndarray, shape (n,)
            n, pores over the whole [-].
        material : Material
            As in `drag_coefficient`.

        Returns
        -------
        ndarray, shape (n,)
            [m2 s-1], of K, the parameter `stiffness` [Pa].
        """
        return self.stiffness * porosity**2 / self.drag_coefficient(porosity, material)

    def interact(self, state: FlowState, cells, shock_viscosity: float, threads: int, sums):
        """Write the sums and the mixture of each phase; return the cells of grains and the cells of water.

        Parameters
        ----------
        state : FlowState
            The n particles and ghosts of both phases.
        cells : Cells
            Cell list over all of them.
        shock_viscosity : float
            Strength of the viscosity at shocks [-].
        threads : int
            Number of threads.
        sums : Sums
            Written for the particles in cells that are awake, as is ``state.mixture.written``.

        Returns
        -------
        tuple of Cells
            Cell lists of grains and of water.
        """
        mixture, material = state.mixture, state.mixture.material
        densities = material.solid_density, material.water_density
        water = mixture.phase == WATER
        of_phases = cells_of_phase(cells, ~water), cells_of_phase(cells, water)
        phased = Phased(
            phase=mixture.phase,
            share=mixture.share,
            cross_term=mixture.cross_term,
            mean_pressure=mixture.mean_pressure,
            own_thickness=state.thickness,
            cos_slope=state.cos_slope,
            gradient_term=state.smoothing.gradient_term,
        )
        within, shared, celerity = press(phased, *densities, state.gravity)
        given = SummationInput(
            position=state.position,
            velocity=state.velocity,
            volume=state.volume,
            smoothing_length=state.smoothing.length,
            longest=state.smoothing.longest,
            pressure_coefficient=within,
            celerity=celerity,
            thickness=state.thickness,
            convergence=state.thickening,
            inertia=np.ones(celerity.size),
        )
        given_cross = CrossPhaseInput(
            position=state.position,
            volume=state.volume,
            smoothing_length=state.smoothing.length,
            pressure_coefficient=shared,
            averaged=mixture.mean_pressure,
        )
        n, written = sums.thickness.size, mixture.written
        cross_sums = CrossPhaseSums(
            thickness=np.zeros(n), cross_term=written.cross_term, mean=np.zeros(n), force=np.zeros((3, n))
        )
        sum_over_neighbours(cells, given, shock_viscosity, sums, threads, of_phases)
        sum_over_other_phase(*of_phases, given_cross, cross_sums, threads)
        found = OverOther(
            own_thickness=plain_thickness(state.volume[:n], state.smoothing.length[:n], sums),
            other_thickness=cross_sums.thickness,
            mean_pressure=cross_sums.mean,
            force=cross_sums.force,
        )
        mix(
            cells.computed, mixture.phase, found, *densities, sums.acceleration, written.share, written.mean_pressure
        )  # fmt: skip
        return of_phases
