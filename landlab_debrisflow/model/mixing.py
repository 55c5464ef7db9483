"""Mixing: entrained soil becomes matter of the particles that took it."""

from typing import NamedTuple

import numpy as np

from ..core.arrays import value_at
from ..core.jit import kernel
from ..core.structs import struct


@struct
class Soil(NamedTuple):
    """Soil that a flow takes up.

    Attributes
    ----------
    solid_fraction : float
        Part of its volume that a particle of grains keeps [-].
    slip_ratio : float
        Velocity at which it enters, over that of the flow [-].
    porosity : float
        Porosity of the soil [-].
    solid_density : float
        Density of its grains [kg m-3].
    bearing_density : float
        Density of the water in its pores [kg m-3].
    """

    solid_fraction: float
    slip_ratio: float
    porosity: float
    solid_density: float
    bearing_density: float


@struct
class Layer(NamedTuple):
    """Flow over the bed, at n particles.

    Attributes
    ----------
    depth : ndarray, shape (n,)
        Vertical depth [m].
    thickness : ndarray, shape (n,)
        Slope-normal thickness [m].
    share : ndarray, shape (n,)
        Fraction of the thickness that belongs to the particle's own phase [-].
    cosine : ndarray, shape (n,)
        Cosine of the slope of the bed [-].
    coefficient_of_consolidation : ndarray, shape (m,) or (1,)
        c_v of the m particles that are mixed [m2 s-1].
    """

    depth: np.ndarray
    thickness: np.ndarray
    share: np.ndarray
    cosine: np.ndarray
    coefficient_of_consolidation: np.ndarray


@struct
class Mixture(NamedTuple):
    """Matter of n particles, changed in place.

    Attributes
    ----------
    volume : ndarray, shape (n,)
        Volume of the particle [m3].
    porosity : ndarray, shape (n,)
        Pores over the whole [-].
    density : ndarray, shape (n,)
        Density of the mixture [kg m-3].
    """

    volume: np.ndarray
    porosity: np.ndarray
    density: np.ndarray


@struct
class Erosion(NamedTuple):
    """Record of the erosion by n particles, written in place.

    Attributes
    ----------
    rate : ndarray, shape (n,)
        Erosion rate per map area [m s-1].
    first_time : ndarray, shape (n,)
        Time of the first erosion [s]; NaN before.
    peclet_number : ndarray, shape (n,)
        Basal Péclet number of the last erosion [-].
    """

    rate: np.ndarray
    first_time: np.ndarray
    peclet_number: np.ndarray


@kernel
def mix(first, last, entrained, soil, layer, mixture, erosion, time, dt, velocity_ratio):
    """Add entrained soil to the matter of the particles from place `first` to `last` - 1, in place.

    The soil enters with the basal velocity v_b = `slip_ratio` v, and the flow accelerates it to v:
    d(v)/dt = - (v - v_b) dm/dt / m, so v goes like m^(slip_ratio - 1), m being the mass.

    Parameters
    ----------
    first, last : int
        Places of the particles.
    entrained : ndarray, shape (n,)
        Soil taken by each; changed to the volume that the own phase keeps [m3].
    soil : Soil
        Soil that the flow takes up.
    layer : Layer
        Flow over the bed, at n particles.
    mixture : Mixture
        Matter of the n particles, changed in place.
    erosion : Erosion
        Record of the erosion, written in place.
    time, dt : float
        Beginning and length of the step [s].
    velocity_ratio : ndarray, shape (n,)
        Written: velocity after over velocity before [-].
    """
    solid_fraction, slip_ratio, soil_porosity, solid_density, bearing_density = soil
    depth, thickness, share, cosine, coefficient_of_consolidation = layer
    volume, porosity, density = mixture
    erosion_rate, first_time, peclet_number = erosion
    for i in range(first, last):
        rate, before = entrained[i] * depth[i] * share[i] / (volume[i] * dt), volume[i]
        erosion_rate[i] = rate
        velocity_ratio[i] = 1.0
        if entrained[i] > 0.0:
            taken = entrained[i]
            entrained[i] = solid_fraction * taken
            volume[i] = before + entrained[i]
            velocity_ratio[i] = before / volume[i]
            if porosity[i] != soil_porosity:
                whole, old_density = before / share[i], density[i]
                porosity[i] = (porosity[i] * whole + soil_porosity * taken) / (whole + taken)
                density[i] = (1.0 - porosity[i]) * solid_density + porosity[i] * bearing_density
                if solid_fraction == 1.0:
                    velocity_ratio[i] *= old_density / density[i]
            if slip_ratio > 0.0:
                velocity_ratio[i] **= 1.0 - slip_ratio
            # as `column.diagnostics.basal_peclet_number`, without its arrays: this is done in every step
            peclet_number[i] = rate * cosine[i] * thickness[i] / value_at(coefficient_of_consolidation, i - first)
            if np.isnan(first_time[i]):
                first_time[i] = time
