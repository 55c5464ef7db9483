"""Coefficient of consolidation that follows from the permeability and the stiffness of debris."""

from ..core.errors import ParameterError
from ..core.parameters import declared, parameter


@declared
class Consolidation:
    """c_v = k K/mu_f: permeability and stiffness of the grains' skeleton over the viscosity of the fluid in its pores.

    All three must be given. The stiffness is 1/compressibility. It rises with the effective stress: K =
    m (sigma' + sigma_0)/a for a solid fraction m, with a = 0.017 and sigma_0 = 1 kPa in the flume of George & Iverson
    (2014), so debris of decimetres is softer than debris of metres.

    References
    ----------
    Terzaghi (1943); stiffness of debris: Iverson & George (2014).

    Examples
    --------
    Values with which George & Iverson (2014) computed the flume of the USGS; compressibility 2e-6 Pa-1 at the start:

    >>> Consolidation(permeability=5e-9, pore_fluid_viscosity=0.005, stiffness=1.0 / 2e-6).value
    0.5
    """

    permeability: float = parameter("m2", "k, intrinsic, of the grains' skeleton", None, (1e-25, 1e-3))
    pore_fluid_viscosity: float = parameter(
        "Pa s", "mu_f, dynamic; 0.001 of clear water, more with mud in it", None, (1e-6, 1e6)
    )
    stiffness: float = parameter("Pa", "K, of the skeleton when confined; 1/compressibility", None, (1.0, 1e13))

    def _agree(self):
        values = {"permeability": "m2", "pore_fluid_viscosity": "Pa s", "stiffness": "Pa"}
        if missing := [name for name in values if getattr(self, name) is None]:
            needed = ", ".join(f"{name} [{unit}]" for name, unit in values.items())
            raise ParameterError(
                f"Consolidation: not given: {', '.join(missing)}; c_v follows from {needed}; give them all, or c_v "
                "itself as a number [m2 s-1]"
            )

    @property
    def value(self) -> float:
        """Coefficient of consolidation, the diffusivity of excess pore pressure [m2 s-1]."""
        return self.permeability / self.pore_fluid_viscosity * self.stiffness
