"""An implicit scheme of first order, bounded for any step.

Finite volumes around the levels, in time backward Euler, in space Patankar's hybrid differencing (1980, chapter 5):
central up to a cell Péclet number of 2, beyond it upwind and without diffusion. The matrix has no positive value
off its diagonal and rows that sum to one, so that no new extreme appears. One solve per step.

The step grows the column by ``e = V1/V0 - 1``. With e, not log(V1/V0), the content changes by the flux through the
base less the flux through the surface, to rounding.
"""

import numpy as np

from ....core.jit import allocating_kernel, inner
from .contact import INFLOW
from .stepwise import CONTACT, DIFFUSION, GROWTH, begin_step, end_step, is_prescribed


@allocating_kernel
def advance_upwind(columns, forcing, dt, basal_pressure, scheme):
    """Advance all columns by one step of the flow.

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
    work = np.empty(cells)
    for i in range(profile.shape[0]):
        contact, growth, bed = steps[i, CONTACT], steps[i, GROWTH], beds[min(i, beds.size - 1)]
        prescribed = is_prescribed(contact)
        if prescribed:
            profile[i, 0] = bed
        inflow = growth * cells if contact == INFLOW else 0.0
        advection = growth if scheme.moves_with_grains else 0.0
        _solve(profile, i, advection, steps[i, DIFFUSION] * cells * cells, prescribed, inflow, bed, work)
    end_step(columns, forcing, basal_pressure)


@inner
def _solve(profile, i, advection, diffusion, prescribed, inflow, bed, work):
    """Solve for one column at the end of the step, by the algorithm of Thomas from the base to the surface.

    `profile`, shape (n, levels), is changed in row `i` [Pa]; `prescribed` tells whether the bed prescribes the base;
    `bed` is its pressure [Pa]; `work` is scratch, shape (levels - 1,).

    ``advection`` is the Courant number of the face one cell below the surface; at other faces it grows in proportion to
    their depth. ``diffusion`` is the cell Fourier number. The flux through the base is ``inflow`` times the excess of
    the pressure of the bed over that of the base: ``c_v p_x = -e_R (p_b - p)``.
    """
    cells = profile.shape[1] - 1
    up, down = _face(advection * (cells - 0.5), diffusion)
    work[0] = 0.0
    if not prescribed:  # the base level has half a cell
        whole = 1.0 / (1.0 + 2.0 * (down + inflow))
        profile[i, 0] = (profile[i, 0] + 2.0 * inflow * bed) * whole
        work[0] = 2.0 * down * whole
    for k in range(1, cells):
        from_below = up
        up, down = _face(advection * (cells - k - 0.5), diffusion)
        whole = 1.0 / (1.0 + down + from_below * (1.0 - work[k - 1]))
        profile[i, k] = (profile[i, k] + from_below * profile[i, k - 1]) * whole
        work[k] = down * whole
    for k in range(cells - 1, -1, -1):
        profile[i, k] += work[k] * profile[i, k + 1]


@inner
def _face(courant, diffusion):
    """Return the weights of a face: of the level below it on the one above, and of the one above on it [-].

    `courant` is the Courant number of the face and `diffusion` the cell Fourier number [-].
    """
    down = max(diffusion - 0.5 * courant, 0.0)
    return down + courant, down
