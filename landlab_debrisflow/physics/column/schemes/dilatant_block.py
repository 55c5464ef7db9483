"""Implicit solution of the effective stress in a block of columns whose debris contracts or dilates.

Backward Euler. The solid fraction at the end of the step is eliminated, so that one unknown is left at each level, the
effective stress s, and with it ``l = ln((s + s_0)/(s_old + s_0))``. At a level, with ``D = 1 + m gd dt``,

    a l/(m D) - (gd dt/D) (m - m_eq(s)) - dt d(k_w (ds/dy - load/h))/dy = 0,

which rises with s, and whose Jacobian is an M-matrix: the solution is unique, and Newton's method finds it. The bounds
0 <= s <= suction are a part of the problem: a level stays on a bound while its residual presses it there. So debris
contracts no faster than its water leaves. The solid fraction follows from the same fluxes of water, so that the grains
gain what water leaves through the surface.

The columns of a block are solved side by side, one in each lane of the processor's vectors. A lane that has converged
is left alone: no column depends on its neighbours in a block.
"""

from typing import NamedTuple

import numpy as np

from ....core.jit import inner
from ....core.structs import struct
from ..dilatancy import DENSEST, LOOSEST, PERMEABILITY_RANGE, REFERENCE_FRACTION

LANES = 16
"""Columns of a block."""

ITERATIONS = 60
"""Most iterations: in the corners of all parameters a step takes up to 46 (benchmarks/dilatancy_stability.py)."""

CONVERGED = 1e-3
"""Largest change of s + s_0, over itself, in the last iteration. The error after it is of the order of its square."""

GOING, DONE = 1.0, 0.0
"""Whether a lane is still changed by iterations, as a factor of its changes."""

FACTOR = 2.5
"""Largest factor of s + s_0 in an iteration: the series of the logarithm holds to 1e-9."""

LITTLE_STRESS = 1e-9
"""Added to a stress that divides [Pa]."""

ROUNDING = 1e-10
"""Distance from suction, over the stress there, at which a level counts as on the bound [-]."""

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
def solve_block(block, rates, law, dt):
    """Advance the effective stress and the solid fraction of a block of columns by one step without erosion.

    Parameters
    ----------
    block : Block
        Effective stress and solid fraction at the levels from the surface down, changed in place.
    rates : Rates
        Shear, load and geometry of each column.
    law : Dilatant
        Constants of dilatancy.
    dt : float
        Duration of the step [s].

    Returns
    -------
    int
        Number of iterations.
    """
    _begin(block, rates, law, dt)
    stress = block[0]
    cells, state = stress.shape[0] - 1, np.empty(LANES)
    state[:] = GOING
    iterations = 0
    while iterations < ITERATIONS:
        iterations += 1
        for j in range(1, cells):
            _eliminate(block, rates, law, dt, j, j + 1, 1.0)
        _eliminate(block, rates, law, dt, cells, cells, 2.0)
        if not _substitute(block, rates, law, state):
            break
    _end(block, rates, law, dt)
    return iterations


@inner
def _begin(block, rates, law, dt):
    """Write what stays the same in the iterations of a step, and the stress of a base whose pressure is prescribed.

    The arguments are those of `solve_block`.
    """
    stress, fraction, logarithm, conductance, storage, eliminated, change = block
    shear, _, thickness, _, prescribed = rates
    cells = stress.shape[0] - 1
    for j in range(cells + 1):
        above, below = fraction[max(j, 1)], fraction[min(j + 1, cells)]
        faces, stores, logs, closed = conductance[j], storage[j], logarithm[j], 0.0 if j == cells else 1.0
        for b in range(LANES):
            width = thickness[b] / cells
            mean = 0.5 * (above[b] + below[b])
            faces[b] = closed * law.conductivity * relative_conductivity(mean) * dt / (width * width)
            stores[b] = law.compressibility / (above[b] * (1.0 + above[b] * shear[b] * dt))
            logs[b] = 0.0
    eliminated[0] = 0.0
    change[0] = 0.0
    for b in range(LANES):
        if prescribed[b] > NOT_PRESCRIBED:
            old, new = stress[cells, b] + law.reference_stress, prescribed[b] + law.reference_stress
            logarithm[cells, b], stress[cells, b] = np.log(new / old), prescribed[b]


@inner
def _eliminate(block, rates, law, dt, j, below, half):
    """Form the linear equations of one level in an iteration, and eliminate the levels above from them.

    Written are ``eliminated``, the factor of the change of the level `below`, and ``change``, what remains of the
    right-hand side [Pa]. `half` is 2 at the base, which has half a cell, and 1 elsewhere; the other arguments are those
    of `solve_block`.
    """
    stress, fraction, logarithm, conductance, storage, eliminated, change = block
    shear, load, _, most, prescribed = rates
    cells = stress.shape[0] - 1
    upper, here, lower, fractions = stress[j - 1], stress[j], stress[below], fraction[j]
    ups, downs, stores, logs = conductance[j - 1], conductance[j], storage[j], logarithm[j]
    above, above_change, factors, changes = eliminated[j - 1], change[j - 1], eliminated[j], change[j]
    prescribes, share = NOT_PRESCRIBED if below == j else np.inf, j / cells
    rate = dt / law.compressibility
    for b in range(LANES):
        gd, m, s, stored = shear[b], fractions[b], here[b], stores[b]
        shearing = stored * m * gd * rate
        storing, moved = s + law.reference_stress, law.inertia * gd * gd + s + LITTLE_STRESS
        both = 1.0 / (storing * moved)
        root = np.sqrt(law.viscosity * gd * storing * both)
        slowed = 1.0 / (1.0 + root)
        tends = law.critical * slowed
        steepness = 0.5 * tends * slowed * root * storing * both
        step, up, down = load[b] / cells, half * ups[b], downs[b]
        residual = stored * logs[b] - shearing * (m - tends)
        residual += up * (s - upper[b] - step) - down * (lower[b] - s - step)
        diagonal = stored * moved * both + shearing * steepness + up + down
        top = most[b] * share
        highest = top - ROUNDING * (top + law.reference_stress)
        # `and` and `or` would be branches, which keep the lanes from being computed together
        held = ((s <= 0.0) & (residual >= 0.0)) | ((s >= highest) & (residual <= 0.0)) | (prescribed[b] > prescribes)
        inverse = (0.0 if held else 1.0) / (diagonal - up * above[b])
        factors[b] = down * inverse
        changes[b] = (up * above_change[b] - residual) * inverse


@inner
def _substitute(block, rates, law, state):
    """Change the stress of lanes that are `GOING`, from the base to the surface; return whether one is going on.

    `state`, shape (LANES,), is changed to `DONE` where no level changed by more than `CONVERGED`; the other arguments
    are those of `solve_block`.
    """
    stress, _, logarithm, _, _, eliminated, change = block
    _, _, _, most, _ = rates
    cells, farthest = stress.shape[0] - 1, np.zeros(LANES)
    for j in range(cells, 0, -1):
        here, logs, factors, changes, below = stress[j], logarithm[j], eliminated[j], change[j], change[j + 1]
        share = j / cells
        for b in range(LANES):
            step = changes[b] + factors[b] * below[b]
            changes[b] = step
            old = here[b] + law.reference_stress
            new = min(max(old + step, old * (1.0 / FACTOR)), old * FACTOR)
            new = min(max(new, law.reference_stress), law.reference_stress + most[b] * share)
            new = old + state[b] * (new - old)
            here[b] = new - law.reference_stress
            logs[b] += log_of_ratio(new, old)
            farthest[b] = max(farthest[b], abs(new - old) - CONVERGED * new)
    going = 0.0
    for b in range(LANES):
        state[b] = GOING if farthest[b] > 0.0 else DONE
        going += state[b]
    return going > 0.0


@inner
def _end(block, rates, law, dt):
    """Write the solid fraction at the end of the step, from the fluxes of water of that time.

    At a base whose pressure is prescribed, water passes the base, too: the solid fraction there follows from the law of
    dilatancy. The surface level has the fraction of the level below. The arguments are those of `solve_block`.
    """
    stress, fraction, logarithm, conductance, _, _, _ = block
    shear, load, _, _, prescribed = rates
    cells = stress.shape[0] - 1
    for j in range(1, cells + 1):
        upper, here, lower, fractions = stress[j - 1], stress[j], stress[min(j + 1, cells)], fraction[j]
        ups, downs, half = conductance[j - 1], conductance[j], 2.0 if j == cells else 1.0
        for b in range(LANES):
            step, m, gd = load[b] / cells, fractions[b], shear[b]
            gain = half * ups[b] * (here[b] - upper[b] - step) - downs[b] * (lower[b] - here[b] - step)
            new = m / max(1.0 + gain, 0.5)
            if j == cells and prescribed[b] > NOT_PRESCRIBED:
                tends = equilibrium(here[b], law.viscosity * gd, law.inertia * gd * gd, law.critical)
                gained = law.compressibility * logarithm[j, b]
                new = (m + gained + m * gd * dt * tends) / (1.0 + m * gd * dt)
            fractions[b] = min(max(new, LOOSEST), DENSEST)
    fraction[0] = fraction[1]
