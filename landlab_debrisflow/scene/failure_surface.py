"""Surface of rupture under the outline of a landslide, so that its body can leave the scar."""

from typing import Any

import numpy as np
from scipy.optimize import brentq

from ..core.checks import in_range
from ..core.errors import InputError
from ..core.hints import did_you_mean
from .failure_kinds import KINDS
from .outline import CALLER, read_outline

ALL = 1.0 - 1e-12
"""Fraction of the largest body that can leave, from which on the largest body is taken [-]."""


def failure_surface(
    inside: Any,
    elevation: Any,
    spacing: float | tuple[float, float],
    *,
    kind: str = "tapered",
    mean_depth: float | None = None,
    largest_depth: float | None = None,
    volume: float | None = None,
    floor_fall: float = 0.8,
) -> np.ndarray:
    """Return the vertical depth of the body that fails within an outline [m].

    A uniform depth inside a polygon digs a pit with upright walls: at the lower rim its floor lies below the ground
    outside, and most of the mass piles up against this wall. Here no floor lies below the place where the fall line of
    the ground leaves the outline, so that the scar can empty, and the volume is kept to rounding.

    Parameters
    ----------
    inside : array_like, shape (rows, columns)
        Nodes of the outline, as bool, or the fraction of every cell that lies inside, 0 to 1. The outermost rows
        and columns are outside.
    elevation : array_like, shape (rows, columns)
        Elevation of the ground before the failure [m], first row southern; NaN where nothing can leave (no data).
    spacing : float or tuple of float
        Distance of nodes, or of columns and of rows [m].
    kind : str
        ``"tapered"``: the same depth everywhere but towards the lower rim, where the floor falls less than the ground.
        ``"sloping_local_base_level"``: the floor that curves evenly, by Jaboyedoff et al. (2004).
        ``"ellipsoid"``: half of one with the axes of the outline, cut at it.
        ``"uniform"``: the same depth everywhere. Only this kind digs a pit; it is meant for `lay_on_top`.
    mean_depth, largest_depth, volume : float, optional
        Exactly one of them: volume over area of the outline [m], largest depth at a node [m], or volume [m3].
    floor_fall : float
        For ``"tapered"``: fall of the floor over that of the ground above the lower rim, from 0, level, to less than 1.
        Where floor_fall times the slope of the ground is less than the friction, some of the mass stays.

    Returns
    -------
    ndarray, shape (rows, columns)
        Vertical depth [m], 0 outside. In a cell of which a fraction fails it is the mean over the whole cell.

    Raises
    ------
    InputError
        If an argument is not usable, or if no scar of such a size within the outline could empty; the message
        tells the largest one that could.

    Notes
    -----
    Where the ground lies D above the exit of its fall line, no kind is deeper than D. ``"tapered"`` has

        h = min(d, (1 - floor_fall) D)

    On a slope theta its rim is d / ((1 - floor_fall) tan(theta)) wide, 14 m for 1 m on 20 degrees. Upper and side rims
    are not tapered: no mass has to leave over them. If an outline falls by less than d / (1 - floor_fall) in total, the
    whole body is rim. If the size asks for a deeper body, the floor falls less, until it is level.

    The sloping local base level is the limit of repeated lowering: every node above the mean of its neighbours less a
    tolerance C is lowered to this value, z = min(ground, mean - C). Its fixed point is the solution of an obstacle
    problem, which is solved directly: laplacian(z) = 4 C / spacing^2 where z lies below the ground. The size asked for
    determines C. C is negative under a ridge if the size is less than that with C = 0.

    References
    ----------
    Jaboyedoff et al. (2004, 2009, 2020).

    Examples
    --------
    A polygon of 20 m by 20 m on a slope of 30 degrees, the depth along its fall line:

    >>> x, y = np.meshgrid(np.arange(0.0, 60.0, 2.0), np.arange(0.0, 40.0, 2.0))
    >>> inside = (abs(x - 25.0) < 10.0) & (abs(y - 20.0) < 10.0)
    >>> depth = failure_surface(inside, -0.577 * x, 2.0, largest_depth=1.0)
    >>> depth[10, 7:19].round(2)
    array([0.  , 1.  , 1.  , 1.  , 1.  , 1.  , 1.  , 0.92, 0.69, 0.46, 0.23,
           0.  ])
    >>> depth = failure_surface(inside, -0.577 * x, 2.0, kind="sloping_local_base_level", volume=300.0)
    >>> float(round(depth.sum() * 2.0**2, 9)), float(depth.max().round(2))
    (300.0, 1.45)
    """
    if kind not in KINDS:
        raise InputError(f"{CALLER}unknown kind {kind!r}{did_you_mean(kind, KINDS)}; allowed: {', '.join(KINDS)}")
    asked, value = _size_asked(mean_depth=mean_depth, largest_depth=largest_depth, volume=volume)
    in_range(f"{CALLER}floor_fall", floor_fall, 0.0, 1.0, open_ends=(False, True), error=InputError)
    outline = read_outline(inside, elevation, spacing)
    family = KINDS[kind](outline, floor_fall)
    unit = {"mean_depth": outline.area, "volume": 1.0}.get(asked)

    def size(depth) -> float:
        return float(depth.max() if unit is None else (depth * outline.fraction).sum() * outline.cell_area / unit)

    most = size(family.largest)
    if value > most:
        raise InputError(
            f"{CALLER}{asked} is {value:g}, but of this outline no body of more than {most:.4g} can leave: the ground "
            f"falls by {outline.fall.max():.3g} m at most to the lower rim. Ask for less, draw a larger outline, or "
            "lay the release on top of the ground (lay_on_top)"
        )
    if value >= ALL * most:
        depth = family.largest
    else:
        high = family.first
        while size(family.depth(high)) < value:
            high = family.least + 2.0 * (high - family.least)
        width = high - family.least
        number = brentq(lambda x: size(family.depth(x)) - value, family.least, high, xtol=1e-13 * width)
        depth = family.depth(number)
    if (found := size(depth)) <= 0.0:
        raise InputError(f"{CALLER}{asked} is {value:g}, too small for a body; ask for more")
    return depth * outline.fraction * (value / found)


def _size_asked(**sizes: float | None) -> tuple[str, float]:
    """Return name and value of the only size that is given [m or m3]."""
    given = {name: value for name, value in sizes.items() if value is not None}
    if len(given) != 1:
        raise InputError(f"{CALLER}give exactly one of {', '.join(sizes)}, got {', '.join(given) or 'none'}")
    ((name, value),) = given.items()
    unit = "m3" if name == "volume" else "m"
    in_range(f"{CALLER}{name}", value, 0.0, np.inf, unit, open_ends=(True, True), error=InputError)
    return name, float(value)
