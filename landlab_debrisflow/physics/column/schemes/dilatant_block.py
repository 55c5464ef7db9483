"""A block of columns whose debris contracts or dilates: its arrays, and the laws of a level in every lane.

The columns of a block are computed side by side, one in each lane of the processor's vectors (`dilatant_solution`).
"""

from typing import NamedTuple

import numpy as np

from ....core.jit import inner
from ....core.structs import struct
from ..dilatancy import PERMEABILITY_RANGE, REFERENCE_FRACTION

LANES = 32
"""Columns of a block."""

FACTOR = 2.5
"""Largest factor of s + s_0 in an iteration: the series of the logarithm holds to 1e-9."""

LITTLE_STRESS = 1e-9
"""Added to a stress that divides [Pa]."""

ROUNDING = 1e-10
"""Distance from the highest effective stress, over this stress, at which a level counts as on the bound [-]."""

NOT_PRESCRIBED = -1.0
"""Prescribed stress of a base without one [Pa]."""


@struct
class Block(NamedTuple):
    """Columns of a block, with scratch.

    Attributes
    ----------
    stress : ndarray, shape (levels, LANES)
        Effective stress at the levels, from the surface down [Pa].
    fraction : ndarray, shape (levels, LANES)
        Solid fraction [-].
    logarithm : ndarray, shape (levels, LANES)
        Logarithm of the stress plus the reference stress, over that at the start of the step [-].
    conductance : ndarray, shape (levels, LANES)
        k_w dt/dy^2 of the face below each level [Pa-1]; 0 below the base.
    storage : ndarray, shape (levels, LANES)
        a/(m D), with the solid fraction m at the start of the step and D = 1 + m gd dt [-].
    eliminated : ndarray, shape (levels, LANES)
        Factor of the change of the next lower level [-].
    change : ndarray, shape (levels, LANES)
        Change of the stress in an iteration [Pa].
    """

    stress: np.ndarray
    fraction: np.ndarray
    logarithm: np.ndarray
    conductance: np.ndarray
    storage: np.ndarray
    eliminated: np.ndarray
    change: np.ndarray


@struct
class Rates(NamedTuple):
    """Shear, load and geometry of the columns of a block.

    Attributes
    ----------
    shear : ndarray, shape (LANES,)
        Shear rate [s-1].
    load : ndarray, shape (LANES,)
        Effective stress at the base without excess pore pressure [Pa].
    thickness : ndarray, shape (LANES,)
        Slope-normal [m].
    most : ndarray, shape (LANES,)
        Effective stress at the base at the lowest pore pressure, that of the air [Pa].
    prescribed : ndarray, shape (LANES,)
        Effective stress that the bed prescribes at the base [Pa]; `NOT_PRESCRIBED`: none.
    """

    shear: np.ndarray
    load: np.ndarray
    thickness: np.ndarray
    most: np.ndarray
    prescribed: np.ndarray


@inner
def log_of_ratio(new, old):
    """Return ln(new/old) of two positive numbers that are apart by a factor of 2.5 at most; error below 1e-9.

    `new` and `old` have one unit.
    """
    z = (new - old) / (new + old)
    q = z * z
    series = 1.0 / 15.0 + q * (1.0 / 17.0 + q * (1.0 / 19.0 + q / 21.0))
    series = 1.0 / 9.0 + q * (1.0 / 11.0 + q * (1.0 / 13.0 + q * series))
    return 2.0 * z * (1.0 + q * (1.0 / 3.0 + q * (0.2 + q * (1.0 / 7.0 + q * series))))


@inner
def relative_conductivity(solid_fraction):
    """Return exp((0.6 - m)/0.04) for a solid fraction m in [0.3, 0.74] [-]; relative error below 1e-8."""
    y = (REFERENCE_FRACTION - solid_fraction) / (32.0 * PERMEABILITY_RANGE)
    value = 1.0 + y / 4.0 * (1.0 + y / 5.0 * (1.0 + y / 6.0 * (1.0 + y / 7.0)))
    value = 1.0 + y * (1.0 + y / 2.0 * (1.0 + y / 3.0 * value))
    for _ in range(5):
        value *= value
    return value


@inner
def equilibrium(stress, viscous, collisional, critical):
    """Return the solid fraction to which shear drives debris [-].

    `stress` is the effective stress [Pa]; `viscous` is mu gd, `collisional` rho_s gd^2 delta^2 [Pa]; `critical` is
    m_crit [-].
    """
    return critical / (1.0 + np.sqrt(viscous / (collisional + stress + LITTLE_STRESS)))


@inner
def describe_base(block, rates, law, dilatancy, coefficient):
    """Write the tangent of the angle of dilatancy [-] and the coefficient of consolidation [m2 s-1] of the base.

    `dilatancy` and `coefficient` have the shape (LANES,); the other arguments are those of `solve_block`.
    """
    cells, shear = block[0].shape[0] - 1, rates[0]
    stress, fraction = block[0][cells], block[1][cells]
    for b in range(LANES):
        gd, m = shear[b], fraction[b]
        dilatancy[b] = m - equilibrium(stress[b], law.viscosity * gd, law.inertia * gd * gd, law.critical)
        storing = (stress[b] + law.reference_stress) / law.compressibility
        coefficient[b] = law.conductivity * relative_conductivity(m) * m * storing
