"""Normal stress of the flow on the bed, with the curvature of the bed."""

from typing import NamedTuple

import numpy as np

from ..core.jit import kernel
from ..core.structs import struct


@struct
class BedLoad(NamedTuple):
    """Flow whose weight the bed bears, at n particles.

    Attributes
    ----------
    thickness : ndarray, shape (n,)
        Slope-normal thickness [m].
    density : ndarray, shape (n,)
        Density of the mixture [kg m-3].
    pressure : ndarray, shape (n,)
        Basal excess pore pressure [Pa].
    """

    thickness: np.ndarray
    density: np.ndarray
    pressure: np.ndarray


@struct
class Weighing(NamedTuple):
    """Constants by which a flow weighs on the bed.

    Attributes
    ----------
    gravity : float
        Acceleration by gravity [m s-2].
    bearing_density : float
        Hydrostatic pressure at the base over normal gravity and thickness [kg m-3].
    least_radius : float
        Least radius of curvature of the bed [m].
    """

    gravity: float
    bearing_density: float
    least_radius: float


@kernel
def press_on_bed(first, velocity, sample, cosine, load, weighing):
    """Return speed, normal gravity and effective normal stress at the base of particles.

    The centripetal part v.Hess(Z).v is capped at v^2 over the least radius: a raster resolves no smaller radius than
    its spacing, and noise of the elevation must not add to the load.

    Parameters
    ----------
    first : int
        Place of the first particle asked for.
    velocity : ndarray, shape (3, all)
        Velocity of all particles [m s-1].
    sample : SurfaceSample
        Bed below all particles.
    cosine : ndarray, shape (all,)
        Cosine of the slope of the bed [-].
    load : BedLoad
        Load of the n particles asked for.
    weighing : Weighing
        Constants by which the flow weighs on the bed.

    Returns
    -------
    speed : ndarray, shape (n,)
        [m s-1]
    normal_gravity : ndarray, shape (n,)
        Slope-normal gravity with the centripetal part [m s-2].
    effective_normal_stress : ndarray, shape (n,)
        [Pa]
    """
    _, _, _, curvature_xx, curvature_xy, curvature_yy = sample
    thickness, density, pressure = load
    gravity, bearing_density, least_radius = weighing
    n = thickness.size
    speed, normal_gravity, effective_normal_stress = np.empty(n), np.empty(n), np.empty(n)
    for k in range(n):
        i = first + k
        u, v, w = velocity[0, i], velocity[1, i], velocity[2, i]
        bend = u * u * curvature_xx[i] + 2.0 * u * v * curvature_xy[i] + v * v * curvature_yy[i]
        most = (u * u + v * v) / least_radius
        bend = min(max(bend, -most), most)
        speed[k] = np.sqrt(u * u + v * v + w * w)
        normal_gravity[k] = max(0.0, (gravity + bend) * cosine[i])
        stress = (density[k] - bearing_density) * normal_gravity[k] * thickness[k] - pressure[k]
        effective_normal_stress[k] = max(0.0, stress)
    return speed, normal_gravity, effective_normal_stress
