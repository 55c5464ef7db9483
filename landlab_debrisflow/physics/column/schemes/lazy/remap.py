"""Remap of a column that erodes: grains keep their depth while new soil comes in at the base.

With ``eta = y/h`` a grain moves from ``eta`` to ``stretch * eta``, ``stretch`` being the volume before over the volume
after. This is exact over any interval (docs/theory.md#column; eq. 35 of Pastor et al., 2022, integrated). Effective
stress is interpolated where grains bear their overburden, so that liquefied soil stays liquefied. No new extreme
appears. Interpolation does not conserve the content of the column to the last digit; restoring it would make an error
of first order in the level spacing.
"""

from .....core.jit import inner


@inner
def cubic_between(values, cells, low, position):
    """Return the cubic through four of ``values`` around ``position``, which lies between the levels `low` and next.

    `values`, shape (levels,), are at levels from the surface downwards; `cells` is the number of levels less 1;
    `position` is the depth below the surface in cells [-].
    """
    if cells < 3:
        return values[low] + (position - low) * (values[low + 1] - values[low])
    first = min(max(low - 1, 0), cells - 3)
    x = position - first
    return 0.5 * (
        (x - 2.0) * (x - 3.0) * (x * values[first + 1] - (x - 1.0) / 3.0 * values[first])
        + x * (x - 1.0) * ((x - 2.0) / 3.0 * values[first + 3] - (x - 3.0) * values[first + 2])
    )


@inner
def interpolate(values, ratios, cells, position):
    """Return the cubic through four of ``values``, clipped to the two that enclose ``position``.

    `values`, shape (levels,), are effective stresses from the surface downwards [Pa], `ratios` the same over their
    depth in cells; `cells` is the number of levels less 1; `position` is the depth below the surface in cells [-].

    The ratio of the result to the position is clipped, too, to the ratios of the two (beside the surface, to those of
    the next two).
    """
    low = min(int(position), cells - 1)
    cubic = cubic_between(values, cells, low, position)
    cubic = min(max(cubic, min(values[low], values[low + 1])), max(values[low], values[low + 1]))
    one, other = ratios[max(low, 1)], ratios[low + 1 if low > 0 else 2]
    return min(max(cubic, min(one, other) * position), max(one, other) * position)


@inner
def remap_profile(profile, i, stretch, load, new_load, carried, work):
    """Stretch one column, and fill its lower end with the soil that came in.

    Parameters
    ----------
    profile : ndarray, shape (n, levels)
        Row ``i`` is written [Pa].
    stretch : float
        Volume before over volume after, < 1 [-].
    load, new_load : float
        Overburden at the base before and after [Pa].
    carried : tuple of float
        ``(weight, scale, entry, new_entry)``: the grains carry ``scale * (weight * load * eta - p)``; ``entry`` and
        ``new_entry`` are its values in the soil that comes in first and last, at the base [Pa].
    work : ndarray, shape (2, levels)
        Scratch.
    """
    cells = profile.shape[1] - 1
    weight, scale, entry, new_entry = carried
    old, ratios = work[0], work[1]
    width, pull = 1.0 / cells, 1.0 / stretch
    for k in range(cells + 1):  # m counts levels from the surface
        m = cells - k
        old[m] = scale * (weight * load * (m * width) - profile[i, k])
        ratios[m] = old[m] / max(m, 1)
    for m in range(cells + 1):
        eta = m * width
        if eta <= stretch:
            value = interpolate(old, ratios, cells, m * pull)
        else:  # soil that came in when the base was at the present depth of this level
            value = entry + (eta - stretch) / (1.0 - stretch) * (new_entry - entry)
        profile[i, cells - m] = weight * new_load * eta - value
