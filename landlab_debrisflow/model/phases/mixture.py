"""Porosity at grains and water, the pore pressure that changes it, and the waves of both."""

from typing import NamedTuple

import numpy as np

from ...core.jit import allocating_kernel, inner, kernel
from ...core.structs import struct
from ...physics.contracts import WATER
from .momentum import FORGOTTEN

LEAST_FRACTION = 1e-6
"""Least fraction of the volume that is assumed for either phase [-]."""

DRAINAGE = 3.0
"""Rate at which the mean pressure drains between readings of the columns, over c_v/h^2: a steady source S gives
S h^2/(3 c_v), as in a column."""


@kernel
def end_of_grains(phase):
    """Return the place behind the last grain of particles, whose `phase` is MIXTURE or WATER, shape (n,) of int8."""
    end = phase.size
    while end > 0 and phase[end - 1] == WATER:
        end -= 1
    return end


@kernel
def find_mixture(phase, phase_fraction, own_thickness, solid_density, water_density, porosity, density, thickness):
    """Write the mixture at each particle, and keep the fraction of its phase within (0, 1).

    Parameters
    ----------
    phase : ndarray of int8, shape (n,)
        MIXTURE, which are the grains, or WATER.
    phase_fraction : ndarray, shape (n,)
        Fraction of the thickness that belongs to the particle's own phase, changed in place [-].
    own_thickness : ndarray, shape (n,)
        Slope-normal thickness of that phase [m].
    solid_density, water_density : float
        Densities of grains and water [kg m-3].
    porosity, density, thickness : ndarray, shape (n,)
        Written: pores over the whole [-], density [kg m-3], and thickness of both phases [m].
    """
    for i in range(phase.size):
        phase_fraction[i] = min(max(phase_fraction[i], LEAST_FRACTION), 1.0 - LEAST_FRACTION)
        porosity[i] = phase_fraction[i] if phase[i] == WATER else 1.0 - phase_fraction[i]
        thickness[i] = own_thickness[i] / phase_fraction[i]
        # water has no buoyant weight, so that its liquefaction pressure is 0
        mixed = solid_density + porosity[i] * (water_density - solid_density)
        density[i] = water_density if phase[i] == WATER else mixed


@allocating_kernel
def pressure_by_porosity(phase, porosity_before, porosity, stiffness, dt):
    """Return the pore pressure that a change of porosity makes at grains, shape (n,) [Pa s-1].

    Parameters
    ----------
    phase : ndarray of int8, shape (n,)
        MIXTURE, which are the grains, or WATER.
    porosity_before, porosity : ndarray, shape (n,)
        Pores over the whole, before and after `dt` seconds [-].
    stiffness : float
        K, volumetric stiffness of the skeleton [Pa].
    dt : float
        [s]
    """
    source, rate = np.zeros(phase.size), stiffness / dt
    for i in range(phase.size):
        if phase[i] != WATER:
            source[i] = rate * np.log((1.0 - porosity_before[i]) / (1.0 - porosity[i]))
    return source


@struct
class PoreWater(NamedTuple):
    """Pore water of n particles and its drainage.

    Attributes
    ----------
    phase : ndarray of int8, shape (n,)
        MIXTURE, which are the grains, or WATER.
    porosity : ndarray, shape (n,)
        Pores over the whole [-].
    thickness : ndarray, shape (n,)
        Slope-normal thickness of both phases [m].
    phase_drag : ndarray, shape (n,)
        Drag between the phases, per area and relative velocity [Pa s m-1].
    consolidation : ndarray, shape (n,)
        Coefficient of consolidation [m2 s-1].
    """

    phase: np.ndarray
    porosity: np.ndarray
    thickness: np.ndarray
    phase_drag: np.ndarray
    consolidation: np.ndarray


@kernel
def follow_source(water, cosine, liquefaction_pressure, source, unit_weight, dt, mean):
    """Add the source to the mean pressure of grains while it drains, and clip it between suction and liquefaction.

    Parameters
    ----------
    water : PoreWater
        Pore water of n particles.
    cosine : ndarray, shape (n,)
        Cosine of the slope of the bed [-].
    liquefaction_pressure : ndarray, shape (n,)
        [Pa]
    source : ndarray, shape (n,) or (1,)
        [Pa s-1]
    unit_weight : float
        Unit weight of water [N m-3].
    dt : float
        Duration of the step [s].
    mean : ndarray, shape (n,)
        Depth mean of the excess pore pressure, changed in place [Pa].
    """
    phase, _, thickness, _, consolidation = water
    for i in range(phase.size):
        if phase[i] != WATER:
            gained = mean[i]
            if dt > 0.0:
                x = dt * DRAINAGE * consolidation[i] / (thickness[i] * thickness[i])
                reached = _reached(x)
                gained = (1.0 - x * reached) * gained + dt * source[min(i, source.size - 1)] * reached
            lowest, highest = -0.5 * unit_weight * thickness[i] * cosine[i], 0.5 * liquefaction_pressure[i]
            mean[i] = min(max(gained, lowest), highest)


@allocating_kernel
def stiffen(water, solid_density, water_density, stiffness, dt):
    """Return the part of the squared celerity by the stiffness of the skeleton, shape (n,) [m2 s-2].

    Waves in which water moves against grains have K n (1/rho_w + n/((1 - n) rho_s)). Drag reduces the velocity that a
    force reaches in a step, and drainage the pressure.

    Parameters
    ----------
    water : PoreWater
        Pore water of n particles.
    solid_density, water_density : float
        Densities of grains and water [kg m-3].
    stiffness : float
        K, volumetric stiffness of the skeleton [Pa].
    dt : float
        Duration of the step [s].
    """
    _, porosity, thickness, phase_drag, consolidation = water
    squared = np.empty(porosity.size)
    for i in range(squared.size):
        n, h = porosity[i], thickness[i]
        lightness = n / water_density + n * n / ((1.0 - n) * solid_density)
        dragged = _reached(dt * phase_drag[i] / (h * n * n) * lightness)
        squared[i] = stiffness * lightness * dragged * _reached(dt * DRAINAGE * consolidation[i] / (h * h))
    return squared


@inner
def _reached(x):
    """Return (1 - exp(-x))/x [-]: the fraction left of a constant gain during which x e-foldings of decay pass."""
    if x < BRIEF:
        return 1.0 - x * (0.5 - x * (1.0 / 6.0 - x / 24.0))
    return 1.0 / x if x > FORGOTTEN else -np.expm1(-x) / x


BRIEF = 1e-3
"""Number of e-foldings below which four terms of the series have all digits."""
