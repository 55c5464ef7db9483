"""Erosion at a fixed rate, down to a depth set by the shear stress beyond a threshold."""

import numpy as np

from ...core.parameters import declared, parameter
from ..contracts import BasalState


@declared
class ShearExcess:
    """e_R = rate, while the eroded depth is below (dz/dtau) (tau - tau_c): down to a depth that shear stress sets.

    Symbols: e_R erosion rate per map area [m s-1]; rate, the parameter `erosion_rate` [m s-1]; tau shear stress at the
    base [Pa]; tau_c, `critical_shear_stress` [Pa]; dz/dtau, `erosion_depth_per_stress` [m Pa-1]; rho density of the
    mixture [kg m-3]; g gravity [m s-2]; h_n slope-normal thickness [m]; theta slope of the bed.

    tau = rho g h_n sin(theta) drives the flow; it is not the resistance of a friction law; both are equal where the
    flow neither gains nor loses speed. The eroded depth counts from the beginning of the event, at the node nearest to
    a particle. An event is over when no particle is left and none will flow in. At rest nothing erodes.

    References
    ----------
    Frank et al. (2015, 2017), the erosion module of RAMMS, from the Illgraben: depth against shear stress of Schürch et
    al. (2011), rate of Berger et al. (2011).
    """

    erosion_rate: float = parameter("m s-1", "rate at which the bed is lowered", 0.025, (0.0, None), varies=True)
    critical_shear_stress: float = parameter(
        "Pa", "shear stress above which the bed erodes", 1000.0, (0.0, None), varies=True
    )
    erosion_depth_per_stress: float = parameter(
        "m Pa-1", "depth that can be eroded, per shear stress beyond the critical one", 1e-4, (0.0, None), varies=True
    )

    def entrainment_rate(self, state: BasalState, out) -> None:
        """Write the demanded erosion rate per map area into `out`, shape (n,) [m s-1], of a `state`.

        Parameters
        ----------
        state : BasalState
            Base of the flow under n particles.
        out : ndarray, shape (n,)
            Written: bed volume per map area and time, >= 0 [m s-1].
        """
        here, h_n, h = state.parameters, state.thickness, state.depth
        # sin(theta), from cos(theta) = h_n/h
        sine = np.sqrt(np.maximum(0.0, (h - h_n) * (h + h_n))) / np.maximum(h, np.finfo(float).tiny)
        excess = state.density * state.material.gravity * h_n * sine - here.critical_shear_stress
        erodes = (here.erosion_depth_per_stress * excess > state.eroded_depth) & (state.speed > 0.0)
        np.multiply(here.erosion_rate, erodes, out=out)
