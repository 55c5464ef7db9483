"""Pressures of a mixture of grains and water before the sums over neighbours, and the mixture after them."""

from typing import NamedTuple

import numpy as np

from ...core.jit import allocating_kernel, kernel
from ...core.structs import struct
from ..contracts import WATER

MOST_CROSSED = 4.0
"""Largest cross term that is allowed: flows have up to 2, but a particle of almost no mass beside others has 1e15
[-]."""


@struct
class Phased(NamedTuple):
    """Mixture at n particles, each of grains or of water.

    Attributes
    ----------
    phase : ndarray of int8, shape (n,)
        MIXTURE, which are the grains, or WATER.
    share : ndarray, shape (n,)
        Fraction of the thickness that belongs to the particle's own phase [-].
    cross_term : ndarray, shape (n,)
        Change of the total thickness with the own smoothing length; see `spatial.cross_summation.CrossPhaseSums` [-].
    mean_pressure : ndarray, shape (n,)
        Depth mean of the excess pore pressure [Pa].
    own_thickness : ndarray, shape (n,)
        Slope-normal thickness of the particle's own phase [m].
    cos_slope : ndarray, shape (n,)
        Cosine of the slope of the bed [-].
    gradient_term : ndarray, shape (n,)
        Grad-h term Omega of the particle's own phase [-].
    """

    phase: np.ndarray
    share: np.ndarray
    cross_term: np.ndarray
    mean_pressure: np.ndarray
    own_thickness: np.ndarray
    cos_slope: np.ndarray
    gradient_term: np.ndarray


@allocating_kernel
def press(mixture, solid_density, water_density, gravity):
    """Return the pressures by which particles push their own phase and the mixture, and the celerity by weight.

    Parameters
    ----------
    mixture : Phased
        Mixture at n particles.
    solid_density, water_density : float
        Densities of grains and water [kg m-3].
    gravity : float
        Acceleration by gravity [m s-2].

    Returns
    -------
    within : ndarray, shape (n,)
        Thrust on the own phase over own thickness squared, Omega and density [m s-2].
    shared : ndarray, shape (n,)
        Thrust on both phases over total thickness squared [N m-3].
    celerity : ndarray, shape (n,)
        [m s-1]
    """
    phase, share, cross_term, mean_pressure, own_thickness, cosine, gradient_term = mixture
    buoyant_density = solid_density - water_density
    within, shared, celerity = np.empty(phase.size), np.empty(phase.size), np.empty(phase.size)
    for i in range(phase.size):
        in_water, own, normal_gravity = phase[i] == WATER, share[i], gravity * cosine[i]
        thickness = own_thickness[i] / own
        # water has the pressure of the grains around it, at most the largest that its own thickness can bear
        solid_fraction = 1.0 - own if in_water else own
        least = -0.5 * water_density * normal_gravity
        most = 0.5 * buoyant_density * solid_fraction * normal_gravity
        pressure = min(max(mean_pressure[i] / thickness, least), most)
        crossed = min(max(cross_term[i], -MOST_CROSSED), MOST_CROSSED)
        shared[i] = pressure - least
        thrust = shared[i] * (1.0 - crossed)
        if not in_water:
            thrust += 0.5 * buoyant_density * normal_gravity / own - pressure / (own * own)
        within[i] = thrust / (gradient_term[i] * (water_density if in_water else solid_density))
        celerity[i] = np.sqrt(normal_gravity * thickness)
    return within, shared, celerity


@struct
class OverOther(NamedTuple):
    """Sums of m particles over the other phase, and their plain sum over the own one.

    Attributes
    ----------
    own_thickness, other_thickness : ndarray, shape (m,)
        Plain sums for the thickness of the own and of the other phase [m].
    mean_pressure : ndarray, shape (m,)
        Mean over the other phase of its excess pore pressure [Pa].
    force : ndarray, shape (3, m)
        Force per volume [N m-3].
    """

    own_thickness: np.ndarray
    other_thickness: np.ndarray
    mean_pressure: np.ndarray
    force: np.ndarray


@kernel
def mix(computed, phase, found, solid_density, water_density, acceleration, share, mean_pressure):
    """Add the force over the other phase to the acceleration; write share and mean pressure of the mixture.

    Parameters
    ----------
    computed : ndarray of bool, shape (n,)
        Particles that have new sums; the others are left as they are. There may be further ones beyond the first m.
    phase : ndarray of int8, shape (n,)
        MIXTURE, which are the grains, or WATER.
    found : OverOther
        Sums of m particles.
    solid_density, water_density : float
        Densities of grains and water [kg m-3].
    acceleration : ndarray, shape (3, m)
        Added to [m s-2].
    share : ndarray, shape (m,)
        Fraction of the thickness that belongs to the own phase [-].
    mean_pressure : ndarray, shape (m,)
        Written for water: depth mean of the excess pore pressure of the grains around [Pa].
    """
    own_thickness, other_thickness, pressure_around, force = found
    for i in range(share.size):
        if computed[i]:
            in_water = phase[i] == WATER
            volume_per_mass = 1.0 / (water_density if in_water else solid_density)
            for d in range(3):
                acceleration[d, i] += force[d, i] * volume_per_mass
            share[i] = own_thickness[i] / (own_thickness[i] + other_thickness[i])
            if in_water:
                mean_pressure[i] = pressure_around[i]
