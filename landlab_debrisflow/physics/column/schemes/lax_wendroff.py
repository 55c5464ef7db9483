"""The paper's scheme: Lax-Wendroff for the advection, then explicit diffusion, in sub-steps (eqs. 40 to 44).

Kept to compare with. It is of second order where the profile is smooth, but overshoots at sharp fronts once the
cell Péclet number is well above one, the more so the smaller the Courant number (docs/theory.md#failures). A base that
starts to be prescribed has its new pressure at once.
"""

import math

import numpy as np

from ....core.jit import inner, kernel
from .stepwise import CONTACT, GROWTH, PASSED, PRESCRIBED, begin_step, end_step

MOST_SUBSTEPS = 100_000


@kernel
def advance_lax_wendroff(columns, forcing, dt, basal_pressure, scheme):
    """Advance all columns by one step of the flow.

    Sub-steps are no longer than ``min(dx/e_R, dx^2/2c_v)``. A column that would need more than `MOST_SUBSTEPS` is
    filled with NaN, for the check after the step to find.

    Parameters
    ----------
    columns : ColumnState
        Written in place.
    forcing : ColumnForcing
        The step.
    dt : float
        Duration [s].
    basal_pressure : ndarray, shape (n,)
        Written: the excess pore pressure that friction feels [Pa].
    scheme : Scheme
        Which law it is.
    """
    steps = begin_step(columns, forcing, dt, scheme)
    profile, beds = columns.profile, forcing.bed_pressure
    cells = profile.shape[1] - 1
    for i in range(profile.shape[0]):
        growth = steps[i, GROWTH] if scheme.stretching else 0.0
        passed = steps[i, PASSED]
        advective, diffusive = cells * growth, 2.0 * cells * cells * passed
        if advective <= MOST_SUBSTEPS and diffusive <= MOST_SUBSTEPS:
            held, bed = steps[i, CONTACT] == PRESCRIBED, beds[min(i, beds.size - 1)]
            _take_substeps(profile, i, math.ceil(max(advective, diffusive)), growth, passed, held, bed)
        else:  # or not a number
            profile[i, :] = np.nan
    end_step(columns, forcing, basal_pressure)


@inner
def _take_substeps(profile, i, count, growth, passed, held, bed):
    """Advance one column in ``count`` sub-steps; the pressure of a base that is held goes to ``bed`` evenly."""
    cells, first = profile.shape[1] - 1, profile[i, 0]
    for m in range(count):
        if growth > 0.0:
            _advect(profile, i, growth / (count + m * growth))
        if held:
            profile[i, 0] = first + (bed - first) * ((m + 1.0) / count)
        if passed > 0.0:
            _diffuse(profile, i, passed * cells * cells / count, held)
    if held:
        profile[i, 0] = bed


@inner
def _advect(profile, i, grown):
    """Take one Lax-Wendroff step, with ``(A p_x)_x`` in its second-order term, in which a column grows by ``grown``."""
    cells = profile.shape[1] - 1
    # e_R dt/h such that 1 + e + e^2/2, by which the scheme multiplies a linear profile, is 1 + grown: a constant ratio
    # survives. To the order of the scheme it is ln(1 + grown).
    e = 2.0 * grown / (1.0 + math.sqrt(1.0 + 2.0 * grown))
    below = profile[i, 0]  # has no slope if the base is impermeable, and is overwritten if not
    for k in range(1, cells):
        here, above = profile[i, k], profile[i, k + 1]
        courant = e * (cells - k)
        second = (courant - 0.5 * e) * (above - here) - (courant + 0.5 * e) * (here - below)
        profile[i, k] = here - 0.5 * courant * (above - below - second)
        below = here


@inner
def _diffuse(profile, i, number, held):
    """Take one explicit step of diffusion with the cell Fourier number ``number``; mirrored at a base not held."""
    below = profile[i, 0]
    if not held:
        profile[i, 0] += 2.0 * number * (profile[i, 1] - below)
    for k in range(1, profile.shape[1] - 1):
        here = profile[i, k]
        profile[i, k] = here + number * (profile[i, k + 1] - 2.0 * here + below)
        below = here
