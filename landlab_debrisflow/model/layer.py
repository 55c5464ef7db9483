"""Layer of flow over the bed: depth, smoothing length and liquefaction pressure by its thickness."""

from typing import NamedTuple

import numpy as np

from ..core.jit import kernel
from ..core.structs import struct


@struct
class Layer(NamedTuple):
    """Layer of flow at n particles, arrays of shape (n,)."""

    thickness: np.ndarray  # (n,) slope-normal [m]
    cosine: np.ndarray  # (n,) of the slope of the bed [-]
    density: np.ndarray  # (n,) of the mixture [kg m-3]
    light: np.ndarray  # (n,) bool, whether a particle keeps its usual smoothing length
    usual_length: np.ndarray  # (n,) usual smoothing length [m]
    next_length: np.ndarray  # (n,) smoothing length that the sums over neighbours ask for [m]
    smoothing_length: np.ndarray  # (n,) [m]; written
    depth: np.ndarray  # (n,) vertical [m]; written
    liquefaction_pressure: np.ndarray  # (n,) effective normal stress without excess pore pressure [Pa]; written


@kernel
def follow_thickness(layer, bearing_density, gravity):
    """Write depth [m], smoothing length [m] and liquefaction pressure [Pa] of a layer of flow of a new thickness.

    Parameters
    ----------
    layer : Layer
        Layer at n particles.
    bearing_density : float
        Hydrostatic pressure at the base over normal gravity and thickness [kg m-3].
    gravity : float
        Acceleration by gravity [m s-2].
    """
    thickness, cosine, density, light, usual, next_length, smoothing_length, depth, liquefaction_pressure = layer
    for i in range(thickness.size):
        smoothing_length[i] = usual[i] if light[i] else next_length[i]
        depth[i] = thickness[i] / cosine[i]
        liquefaction_pressure[i] = (thickness[i] * cosine[i]) * ((density[i] - bearing_density) * gravity)
