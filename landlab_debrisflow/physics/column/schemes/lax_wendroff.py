"""The paper's scheme: Lax-Wendroff for the advection, then explicit diffusion, in sub-steps (eqs. 40 to 44).

It is kept for comparison. It is of second order where the profile is smooth, but overshoots at sharp fronts once the
cell Péclet number is well above one, the more so the smaller the Courant number (docs/theory.md#failures). A base that
starts to be prescribed has its new pressure at once.
"""

import math

import numpy as np

from ....core.jit import allocating_kernel, inner
from .stepwise import CONTACT, DIFFUSION, GROWTH, begin_step, end_step, is_prescribed

MOST_SUBSTEPS = 100_000


@allocating_kernel
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
        Written: the excess pore pressure at the base, for friction [Pa].
    scheme : Scheme
        Choices of the law.
    """
    steps = begin_step(columns, forcing, dt, scheme)
    profile, beds = columns.profile, forcing.bed_pressure
    cells = profile.shape[1] - 1
    for i in range(profile.shape[0]):
        growth = steps[i, GROWTH] if scheme.moves_with_grains else 0.0
        diffusion = steps[i, DIFFUSION]
        advective, diffusive = cells * growth, 2.0 * cells * cells * diffusion
        if advective <= MOST_SUBSTEPS and diffusive <= MOST_SUBSTEPS:
            prescribed, bed = is_prescribed(steps[i, CONTACT]), beds[min(i, beds.size - 1)]
            _take_substeps(profile, i, math.ceil(max(advective, diffusive)), growth, diffusion, prescribed, bed)
        else:  # too many, or not a number
            profile[i, :] = np.nan
    end_step(columns, forcing, basal_pressure)


@inner
def _take_substeps(profile, i, count, growth, diffusion, prescribed, bed):
    """Advance one column in ``count`` sub-steps; the pressure of a prescribed base goes to ``bed`` [Pa] evenly.

    `profile`, shape (n, levels), is changed in row `i` [Pa]; `growth` is entrained volume over the volume before [-],
    `diffusion` c_v dt/h^2 [-], of all sub-steps; `prescribed` tells whether the bed prescribes the base.
    """
    cells, first = profile.shape[1] - 1, profile[i, 0]
    for m in range(count):
        if growth > 0.0:
            _advect(profile, i, growth / (count + m * growth))
        if prescribed:
            profile[i, 0] = first + (bed - first) * ((m + 1.0) / count)
        if diffusion > 0.0:
            _diffuse(profile, i, diffusion * cells * cells / count, prescribed)
    if prescribed:
        profile[i, 0] = bed


@inner
def _advect(profile, i, grown):
    """Take one Lax-Wendroff step, with ``(A p_x)_x`` in its second-order term, in which a column grows by ``grown``.

    `profile`, shape (n, levels), is changed in row `i` [Pa]; ``grown`` is a part of the thickness [-].
    """
    cells = profile.shape[1] - 1
    # e stands for e_R dt/h. The scheme multiplies a linear profile by 1 + e + e^2/2; e is chosen so that this is 1 +
    # grown, and a constant ratio stays one. To the order of the scheme e is ln(1 + grown).
    e = 2.0 * grown / (1.0 + math.sqrt(1.0 + 2.0 * grown))
    below = profile[i, 0]  # without slope if the base is impermeable; a prescribed base is overwritten
    for k in range(1, cells):
        here, above = profile[i, k], profile[i, k + 1]
        courant = e * (cells - k)
        second = (courant - 0.5 * e) * (above - here) - (courant + 0.5 * e) * (here - below)
        profile[i, k] = here - 0.5 * courant * (above - below - second)
        below = here


@inner
def _diffuse(profile, i, number, prescribed):
    """Take one explicit step of diffusion with the cell Fourier number ``number``; mirrored at an impermeable base.

    `profile`, shape (n, levels), is changed in row `i` [Pa]; `prescribed` tells whether the bed prescribes the base.
    """
    below = profile[i, 0]
    if not prescribed:
        profile[i, 0] += 2.0 * number * (profile[i, 1] - below)
    for k in range(1, profile.shape[1] - 1):
        here = profile[i, k]
        profile[i, k] = here + number * (profile[i, k + 1] - 2.0 * here + below)
        below = here
