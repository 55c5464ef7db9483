"""Implicit solution of the effective stress in a block of columns whose debris contracts or dilates.

Backward Euler. The solid fraction at the end of the step is eliminated, so that one unknown is left at each level, the
effective stress s, and with it ``l = ln((s + s_0)/(s_old + s_0))``. At a level, with ``D = 1 + m gd dt``,

    a l/(m D) - (gd dt/D) (m - m_eq(s)) - dt d(k_w (ds/dy - load/h))/dy = 0,

which rises with s, and whose Jacobian is an M-matrix: the solution is unique, and Newton's method finds it. The bounds
0 <= s <= s_most, the stress at the lowest pore pressure, are a part of the problem: a level stays on a bound while its
residual presses it there. So debris contracts no faster than its water leaves. The solid fraction follows from the same
fluxes of water, so that the grains gain the volume that water leaves through the surface.

The columns of a block are solved side by side, one in each lane of the processor's vectors. A lane that has converged
is left alone: no column depends on its neighbours in a block.
"""

import numpy as np

from ....core.jit import inner
from ..dilatancy import DENSEST, LOOSEST
from .dilatant_block import (
    FACTOR,
    LANES,
    LITTLE_STRESS,
    NOT_PRESCRIBED,
    ROUNDING,
    equilibrium,
    log_of_ratio,
    relative_conductivity,
)

ITERATIONS = 60
"""Most iterations: in the corners of all parameters a step takes up to 46 (benchmarks/dilatancy_stability.py)."""

CONVERGED = 1e-3
"""Largest change of s + s_0, over itself, in the last iteration. What is left is of the order of its square, as is the
error that backward Euler makes of such a change."""

GOING, DONE = 1.0, 0.0
"""Whether a lane is still changed by iterations, as a factor of its changes."""


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
    scaled = np.empty(LANES)
    for b in range(LANES):
        width = thickness[b] / cells
        scaled[b] = law.conductivity * dt / (width * width)
    for j in range(cells + 1):
        above, below = fraction[max(j, 1)], fraction[min(j + 1, cells)]
        faces, stores, logs, closed = conductance[j], storage[j], logarithm[j], 0.0 if j == cells else 1.0
        for b in range(LANES):
            mean = 0.5 * (above[b] + below[b])
            faces[b] = closed * scaled[b] * relative_conductivity(mean)
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
    prescribes, eta = NOT_PRESCRIBED if below == j else np.inf, j / cells
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
        top = most[b] * eta
        highest = top - ROUNDING * (top + law.reference_stress)
        # `and` and `or` would be branches, which keep the lanes from being computed together
        fixed = ((s <= 0.0) & (residual >= 0.0)) | ((s >= highest) & (residual <= 0.0)) | (prescribed[b] > prescribes)
        inverse = (0.0 if fixed else 1.0) / (diagonal - up * above[b])
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
        eta = j / cells
        for b in range(LANES):
            step = changes[b] + factors[b] * below[b]
            changes[b] = step
            old = here[b] + law.reference_stress
            new = min(max(old + step, old * (1.0 / FACTOR)), old * FACTOR)
            new = min(max(new, law.reference_stress), law.reference_stress + most[b] * eta)
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
