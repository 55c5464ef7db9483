"""Particles that have not changed for some steps, of which the sums over neighbours need not be done again."""

from ..core.jit import kernel

STILL = 1e-3
"""Displacement over smoothing length, and relative change of volume, below which the sums over neighbours are not
computed again: their error is of this order."""


@kernel
def count_still_steps(position, volume, smoothing_length, reference_position, reference_volume, still_steps):
    """Count the steps since each particle moved or grew noticeably, in place.

    Parameters
    ----------
    position : Position
        Position of the particles [m].
    volume, smoothing_length : ndarray, shape (n,)
        [m3] and [m]
    reference_position, reference_volume : ndarray, shape (3, n) and (n,)
        Position [m] and volume [m3] when the particle last counted as changed.
    still_steps : ndarray of int, shape (n,)
    """
    x, y, z = position
    for i in range(x.size):
        at = reference_position[:, i]
        moved = (x[i] - at[0]) ** 2 + (y[i] - at[1]) ** 2 + (z[i] - at[2]) ** 2
        grown = abs(volume[i] - reference_volume[i])
        if moved > (STILL * smoothing_length[i]) ** 2 or grown > STILL * volume[i]:
            at[0], at[1], at[2], reference_volume[i] = x[i], y[i], z[i], volume[i]
            still_steps[i] = 0
        else:
            still_steps[i] += 1


@kernel
def disturb(x, y, support, gone_x, gone_y, gone_support, still_steps):
    """Let particles at x, y [m] within the support [m] of particles that have gone count as changed, in place.

    `x`, `y`, `support` have shape (n,), `gone_x`, `gone_y`, `gone_support` shape (m,), all in m; `still_steps`, int,
    shape (n,), is set to 0 for these particles.
    """
    for k in range(gone_x.size):
        for i in range(x.size):
            reach = max(support[i], gone_support[k])
            if (x[i] - gone_x[k]) ** 2 + (y[i] - gone_y[k]) ** 2 < reach * reach:
                still_steps[i] = 0
