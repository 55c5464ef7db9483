"""Colour maps whose low end lets the relief through, so that a thin film never outshines a deep flow."""

from collections.abc import Sequence

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import Colormap, ListedColormap, LogNorm, Normalize

COLOURS = 256
FAINT, STRONG = 0.3, 0.92
"""Opacity of the low and of the high end."""

RISE = 0.3
"""Fraction of the scale over which opacity rises."""

QUICK_RISE = 0.12
"""Fraction of either half of a scale about 0 over which opacity rises: there is no deep flow to be outshone."""

PALE = 0.22
"""Fraction of a colour map at its pale end that is left out: a thin film would be brighter than the ground."""


def over_relief(name: str, *, diverging: bool = False, fading: bool = True) -> Colormap:
    """Return a colour map for values over a relief: faint where values are small, strong where they are large.

    Parameters
    ----------
    name : str
        Name of a matplotlib colour map. Of a map of one direction the pale end is that of small values; with ``_r`` it
        is that of large ones.
    diverging : bool
        Whether the middle is the value that is nothing, which is transparent.
    fading : bool
        Whether small values are faint; else all are as strong.

    Returns
    -------
    matplotlib.colors.Colormap
    """
    place = np.linspace(0.0, 1.0, COLOURS)
    if diverging:
        strength = np.abs(2.0 * place - 1.0)
        colours = colormaps[name](0.5 + 0.5 * np.sign(place - 0.5) * strength**0.6)
        colours[:, 3] = STRONG * np.clip(strength / QUICK_RISE, 0.0, 1.0) if fading else STRONG
    else:
        first, last = (0.0, 1.0 - PALE) if name.endswith("_r") else (PALE, 1.0)
        colours = colormaps[name](first + (last - first) * place)
        colours[:, 3] = np.interp(place, [0.0, RISE], [FAINT, STRONG]) if fading else STRONG
    return ListedColormap(colours, name=f"{name} over relief").with_extremes(bad=(0.0, 0.0, 0.0, 0.0))


def linear_norm(values: Sequence[np.ndarray], *, from_zero: bool = True, diverging: bool = False) -> Normalize:
    """Return a linear scale for arrays up to their largest value, or below it if few values stand far above.

    Parameters
    ----------
    values : sequence of ndarray
        NaN is missing.
    from_zero : bool
        Whether the scale begins at 0 even if no value is as small.
    diverging : bool
        Whether it is symmetrical about 0.

    Returns
    -------
    matplotlib.colors.Normalize
    """
    shown = finite(values)
    if shown.size == 0:
        return Normalize(-1.0 if diverging else 0.0, 1.0)
    if diverging:
        largest = _upper(np.abs(shown)) or 1.0
        return Normalize(-largest, largest)
    low, high = 0.0 if from_zero else float(shown.min()), _upper(shown)
    return Normalize(low, high if high > low else low + 1.0)


def log_norm(values: Sequence[np.ndarray]) -> LogNorm:
    """Return a logarithmic scale between whole powers of ten around the positive values, four decades at most.

    Parameters
    ----------
    values : sequence of ndarray
        NaN and what is not above 0 are missing.

    Returns
    -------
    matplotlib.colors.LogNorm
    """
    shown = finite(values)
    shown = shown[shown > 0.0]
    if shown.size == 0:
        return LogNorm(0.1, 10.0)
    high = np.ceil(np.log10(_upper(shown)))
    low = np.floor(np.log10(np.quantile(shown, 0.02)))
    return LogNorm(10.0 ** max(min(low, high - 1.0), high - 4.0), 10.0**high)


def extend_of(norm: Normalize, values: Sequence[np.ndarray]) -> str:
    """Return at which ends of a scale values lie beyond it: "neither", "min", "max" or "both"."""
    shown = finite(values)
    if isinstance(norm, LogNorm):
        shown = shown[shown > 0.0]
    if shown.size == 0:
        return "neither"
    low, high = float(norm.vmin or 0.0), float(norm.vmax or 0.0)
    slack = 1e-9 * (high - low)
    beyond = bool(shown.min() < low - slack), bool(shown.max() > high + slack)
    return {(False, False): "neither", (True, False): "min", (False, True): "max", (True, True): "both"}[beyond]


def finite(values: Sequence[np.ndarray]) -> np.ndarray:
    """Return all finite values of arrays in one, shape (n,)."""
    flat = np.concatenate([np.ravel(np.asarray(one, float)) for one in values]) if len(values) else np.empty(0)
    return flat[np.isfinite(flat)]


FAR = 1.5
"""Largest value over the 99.5 % quantile, above which few nodes would take the colours from all others."""


def _upper(shown: np.ndarray) -> float:
    largest, most = float(shown.max()), float(np.quantile(shown, 0.995))
    return most if 0.0 < most < largest / FAR else largest
