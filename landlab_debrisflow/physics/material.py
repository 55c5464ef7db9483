"""Material of the debris, and the pore pressure at release."""

from typing import Any

import numpy as np

from ..core.constants import GRAVITY
from ..core.errors import ParameterError
from ..core.parameters import declared, parameter
from .consolidation import Consolidation


@declared
class Material:
    """Debris, saturated or (with ``water_density=0``) dry; the defaults are the values of Tsing Shan.

    The basal friction acts on the *buoyant* weight, so its angle is that of the grains. The apparent angle of a
    saturated flow is about half as large.

    Examples
    --------
    >>> Material().density, Material().buoyant_density
    (1990.0, 990.0)
    >>> Material(water_density=0.0).buoyant_density, Material(water_table_ratio=0.0).buoyant_density
    (1590.0, 1590.0)

    The coefficient of consolidation may follow from permeability and stiffness; the number is kept:

    >>> sand = {"permeability": 1e-10, "pore_fluid_viscosity": 0.001, "stiffness": 2.5e5}
    >>> round(Material(coefficient_of_consolidation=sand).coefficient_of_consolidation, 6)
    0.025
    """

    solid_density: float = parameter("kg m-3", "density of the grains", 2650.0, (1.0, 1e5))
    water_density: float = parameter("kg m-3", "density of the pore water; 0 = dry", 1000.0, (0.0, 1e5))
    porosity: float = parameter("-", "volume fraction of the pores", 0.4, (0.0, 0.99))
    bed_porosity: float = parameter("-", "of the soil of the bed; by default that of the debris", None, (0.0, 0.99))
    water_table_ratio: float = parameter(
        "-", "height of the water table over thickness: 1 = saturated, 0 = dry; pores above hold air", 1.0, (0.0, 1.0)
    )
    basal_slip_ratio: float = parameter(
        "-", "velocity at the base over the mean; soil that comes in is sped up to the rest of it", 0.0, (0.0, 1.0)
    )
    coefficient_of_consolidation: float = parameter(
        "m2 s-1", "diffusivity of excess pore pressure", 4e-4, (0.0, 1e6), derivation=Consolidation
    )
    bed_pressure_ratio: float = parameter(
        "-", "excess pore pressure of the bed over its liquefaction value", 0.65, (0.0, 1.0)
    )
    bed_degree_of_saturation: float = parameter(
        "-", "water over pores of the bed; below 1 its pore pressure counts by this part only", 1.0, (0.0, 1.0)
    )
    bed_loading_coefficient: float = parameter(
        "-", "part of the flow's weight that pore water of the bed takes up at once; above 0 the pressure of the bed "
        "follows from this, not from a ratio", 0.0, (0.0, 1.0),
    )  # fmt: skip
    bed_drainage_time: float = parameter(
        "s", "time in which excess pore pressure of the bed falls to 1/e; by default it does not drain", None,
        (1e-3, None),
    )  # fmt: skip
    initial_pressure_ratio: float = parameter(
        "-", "basal excess pore pressure over its liquefaction value at release", 0.65, (0.0, 1.0)
    )
    initial_pressure_profile: str = parameter(
        "-", "shape of the profile at release", "linear", choices=("linear", "uniform", "basal_layer")
    )
    basal_layer_fraction: float = parameter(
        "-", "thickness of the basal layer over that of the column", 0.1, (0.0, 1.0)
    )
    gravity: float = parameter("m s-2", "acceleration of gravity", GRAVITY, (1e-3, 1e3))

    def _agree(self):
        if self.solid_density <= self.water_density:
            raise ParameterError(
                f"Material: solid_density must exceed water_density, {self.water_density:g} kg m-3, got "
                f"{self.solid_density:g}: debris that floats has no friction; for dry debris set water_density to 0; "
                "units are kg m-3, in which grains have some 2650"
            )

    @property
    def density(self) -> float:
        """Density of the mixture [kg m-3]."""
        return self.density_of(self.porosity)

    @property
    def buoyant_density(self) -> float:
        """Density of the mixture less the buoyancy of the pore water [kg m-3]."""
        return self.density - self.bearing_density

    @property
    def bearing_density(self) -> float:
        """Hydrostatic pressure at the base over normal gravity and thickness [kg m-3]."""
        return self.water_table_ratio * self.water_density

    @property
    def soil_porosity(self) -> float:
        """Porosity of the soil of the bed [-]."""
        return self.porosity if self.bed_porosity is None else self.bed_porosity

    def density_of(self, porosity: np.ndarray | float) -> Any:
        """Return the density of a mixture of some porosity [kg m-3].

        Parameters
        ----------
        porosity : float or ndarray
            Pores over the whole [-], 0 to 1.

        Returns
        -------
        float or ndarray
            Density of grains and pore water, of the shape of `porosity` [kg m-3].
        """
        return (1.0 - porosity) * self.solid_density + porosity * self.bearing_density
