"""Grains and water with velocities of their own."""

from typing import ClassVar

import numpy as np

from ...core.parameters import declared, parameter
from ...spatial.cells import cells_of_phase
from ...spatial.cross_summation import CrossPhaseInput, CrossPhaseSums, sum_over_other_phase
from ...spatial.summation import SummationInput, plain_thickness, sum_over_neighbours
from ..contracts import WATER, FlowState

MOST_CROSSED = 4.0
"""Largest cross term that is allowed: flows have up to 2, but a particle of almost no mass beside others has 1e15
[-]."""


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
        water = mixture.phase == WATER
        of_phases = cells_of_phase(cells, ~water), cells_of_phase(cells, water)
        normal_gravity, thickness = state.gravity * state.cos_slope, state.thickness / mixture.share
        density = np.where(water, material.water_density, material.solid_density)
        within, shared = self._pressure_coefficients(state, water, normal_gravity, thickness)
        given = SummationInput(
            position=state.position,
            velocity=state.velocity,
            volume=state.volume,
            smoothing_length=state.smoothing.length,
            longest=state.smoothing.longest,
            pressure_coefficient=within / density,
            celerity=np.sqrt(normal_gravity * thickness),
            thickness=state.thickness,
            convergence=state.thickening,
            inertia=np.ones(density.size),
        )
        given_cross = CrossPhaseInput(
            position=state.position,
            volume=state.volume,
            smoothing_length=state.smoothing.length,
            pressure_coefficient=shared,
            averaged=mixture.mean_pressure,
        )
        n, written = sums.thickness.size, mixture.written
        computed = cells.computed[:n]
        cross_sums = CrossPhaseSums(
            thickness=np.zeros(n), cross_term=written.cross_term, mean=np.zeros(n), force=np.zeros((3, n))
        )
        sum_over_neighbours(cells, given, shock_viscosity, sums, threads, of_phases)
        sum_over_other_phase(*of_phases, given_cross, cross_sums, threads)
        np.add(sums.acceleration, cross_sums.force / density[:n], out=sums.acceleration, where=computed)
        own = plain_thickness(state.volume[:n], state.smoothing.length[:n], sums)
        np.divide(own, own + cross_sums.thickness, out=written.share, where=computed)
        np.copyto(written.mean_pressure, cross_sums.mean, where=computed & water[:n])
        return of_phases

    @staticmethod
    def _pressure_coefficients(state: FlowState, water, normal_gravity, thickness):
        """Return thrust over own thickness squared and Omega, and thrust over total thickness squared [N m-3].

        `cross_term` tells how the total thickness at a particle changes with its own smoothing length.
        `water` (bool) tells the phase, `normal_gravity` is across the bed [m s-2], `thickness` is that of both phases
        [m], all of shape (n,).
        """
        mixture = state.mixture
        material, share = mixture.material, mixture.share
        # water has the pressure of the grains around it, at most the largest that its own thickness can bear
        grain_weight = (material.solid_density - material.water_density) * np.where(water, 1.0 - share, share)
        bounds = -0.5 * material.water_density * normal_gravity, 0.5 * grain_weight * normal_gravity
        pressure = np.clip(mixture.mean_pressure / thickness, *bounds)
        shared = 0.5 * material.water_density * normal_gravity + pressure
        grains = 0.5 * (material.solid_density - material.water_density) * normal_gravity / share - pressure / share**2
        crossed = np.clip(mixture.cross_term, -MOST_CROSSED, MOST_CROSSED)
        within = shared * (1.0 - crossed) + np.where(water, 0.0, grains)
        return within / state.smoothing.gradient_term, shared
