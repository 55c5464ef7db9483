"""The excess pore pressure of a column at release."""

import numpy as np


def initial_profile(liquefaction_pressure, levels: int, ratio, profile: str, basal_layer_fraction):
    """Return the profiles of columns at release (docs/theory.md#start).

    Parameters
    ----------
    liquefaction_pressure : ndarray, shape (n,)
        Load of the columns [Pa].
    levels : int
        Number of levels, equally spaced, 0 at the base and the last at the surface.
    ratio : float or ndarray, shape (n,)
        Basal excess pore pressure over its liquefaction value [-].
    profile : {"linear", "uniform", "basal_layer"}
        Falling linearly to the surface; the same everywhere; or the same within a layer at the base
        and 0 above. At no level more than the liquefaction pressure there.
    basal_layer_fraction : float
        Thickness of that layer over that of the column [-].

    Returns
    -------
    ndarray, shape (n, levels)
        Excess pore pressure [Pa].

    Examples
    --------
    >>> initial_profile(np.array([100.0]), 5, 0.5, "uniform", 0.1)
    array([[50., 50., 50., 25.,  0.]])
    >>> initial_profile(np.array([100.0]), 5, 0.5, "basal_layer", 0.25)
    array([[50., 25.,  0.,  0.,  0.]])
    """
    eta = np.linspace(1.0, 0.0, levels)
    load = np.asarray(liquefaction_pressure, dtype=float)[:, None]
    base = np.asarray(ratio, dtype=float).reshape(-1, 1) * load
    if profile == "linear":
        return base * eta
    if profile == "basal_layer":
        # A level stands for the half cells beside it (one half cell at base and surface), and gets the fraction of them
        # that lies in the layer. So the sum over the levels is the content of the layer, whatever its thickness. If the
        # layer is thinner than half a cell, the base level starts below the pressure of the layer.
        cells = levels - 1
        below = cells * (1.0 - eta) - 0.5
        filled = np.clip(basal_layer_fraction * cells - below, 0.0, 1.0)
        filled[0] = min(1.0, 2.0 * basal_layer_fraction * cells)
        base = base * filled
    return np.minimum(base, load * eta)
