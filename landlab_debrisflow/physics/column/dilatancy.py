"""Dilatancy: debris that contracts or dilates as it is sheared, and so makes its own pore pressure."""

from typing import NamedTuple

import numpy as np

from ...core.parameters import declared, parameter

LOOSEST, DENSEST = 0.3, 0.74
"""Bounds of the solid fraction [-]: grains that hardly touch, and the densest packing of equal spheres."""

REFERENCE_FRACTION = 0.6
"""Solid fraction at which `permeability` is given [-] (George & Iverson, 2014, eq. 2.7)."""

PERMEABILITY_RANGE = 0.04
"""Change of the solid fraction that changes the permeability by a factor e [-] (George & Iverson, 2014, eq. 2.7)."""


class Dilatant(NamedTuple):
    """Constants of dilatancy as kernels read them.

    Attributes
    ----------
    critical : float
        Solid fraction that slow shear neither raises nor lowers [-].
    conductivity : float
        Permeability at the reference fraction over viscosity of the pore fluid [m2 Pa-1 s-1].
    viscosity : float
        Viscosity of the pore fluid [Pa s].
    inertia : float
        Density of the grains times the square of their diameter [kg m-1].
    compressibility : float
        Change of the solid fraction with the logarithm of the effective stress [-].
    reference_stress : float
        Stress added to the effective stress in the compressibility [Pa].
    """

    critical: float
    conductivity: float
    viscosity: float
    inertia: float
    compressibility: float
    reference_stress: float


@declared
class Dilatancy:
    """tan(psi) = m - m_crit/(1 + sqrt(N)): sheared debris tends to the solid fraction of its stress and shear rate.

    Symbols: psi angle of dilatancy; m solid fraction [-]; m_crit, `critical_solid_fraction` [-]; N dimensionless
    shear rate, mu gd/(rho_s gd^2 delta^2 + sigma') [-]; mu, `pore_fluid_viscosity` [Pa s]; gd shear rate
    2 (v - v_b)/h_n [s-1]; rho_s density of the grains [kg m-3]; delta, `grain_diameter` [m]; sigma' effective normal
    stress of the level [Pa].

    The excess pore pressure p follows from alpha (dp/dt - dL/dt) + gd tan(psi) = d(k_w dp/dy)/dy, the solid fraction
    from dm/dt = -m d(k_w dp/dy)/dy, with the depth y below the surface, the load L = rho' g_n y, the compressibility
    alpha = a/(m (sigma' + sigma_0)), a `compressibility`, sigma_0 `reference_stress`, and k_w = k exp((0.6 -
    m)/0.04)/mu, k `permeability`. Water that leaves the grains stays above them, in the volume of the flow.

    References
    ----------
    Iverson & George (2014), Proc. R. Soc. A 470, 20130819; George & Iverson (2014), Proc. R. Soc. A 470, 20130820.

    Examples
    --------
    >>> Dilatancy().critical_solid_fraction
    0.64
    """

    critical_solid_fraction: float = parameter(
        "-", "solid fraction that slow shear neither raises nor lowers", 0.64, (LOOSEST, DENSEST)
    )
    permeability: float = parameter("m2", "k, of the grains' skeleton at a solid fraction of 0.6", 5e-9, (0.0, 1e-3))
    pore_fluid_viscosity: float = parameter("Pa s", "of water with suspended fines", 5e-3, (1e-5, 1e3))
    grain_diameter: float = parameter("m", "of grains whose collisions count in the shear rate", 1e-3, (0.0, 1.0))
    compressibility: float = parameter(
        "-", "change of the solid fraction with the logarithm of the effective stress", 0.017, (1e-4, 0.5)
    )
    reference_stress: float = parameter("Pa", "added to the effective stress in the compressibility", 1e3, (1.0, 1e6))

    def constants(self, solid_density: float) -> Dilatant:
        """Return the constants that kernels read, for grains of `solid_density` [kg m-3]."""
        return Dilatant(
            critical=self.critical_solid_fraction, conductivity=self.permeability / self.pore_fluid_viscosity,
            viscosity=self.pore_fluid_viscosity, inertia=solid_density * self.grain_diameter**2,
            compressibility=self.compressibility, reference_stress=self.reference_stress,
        )  # fmt: skip

    def conductivity(self, solid_fraction):
        """Return k_w = k exp((0.6 - m)/0.04)/mu, of the shape of `solid_fraction` m [-], in m2 Pa-1 s-1."""
        relative = np.exp((REFERENCE_FRACTION - solid_fraction) / PERMEABILITY_RANGE)
        return self.permeability / self.pore_fluid_viscosity * relative

    def coefficient_of_consolidation(self, solid_fraction, effective_stress):
        """Return c_v = k_w m (sigma' + sigma_0)/a of debris in some state.

        Parameters
        ----------
        solid_fraction : float or ndarray
            m [-].
        effective_stress : float or ndarray
            sigma' [Pa].

        Returns
        -------
        float or ndarray
            Diffusivity of the excess pore pressure [m2 s-1].

        Examples
        --------
        The flume of George & Iverson (2014): 0.1 to 0.2 m deep, hydrostatic.

        >>> float(Dilatancy().coefficient_of_consolidation(0.62, 1000.0).round(3))
        0.044
        """
        conductivity = self.conductivity(solid_fraction)
        return conductivity * solid_fraction * (effective_stress + self.reference_stress) / self.compressibility
