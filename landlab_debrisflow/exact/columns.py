"""Closed forms of the excess pore pressure in a column (docs/theory.md#column-solutions), to test and to teach with.

Everything is dimensionless: depths over the thickness, ``xi`` = 0 at the base and 1 at the surface,
times over the consolidation time (``h^2 / c_v``), pressures over the basal pressure.
"""

import numpy as np
from scipy.special import erf, erfc, erfcx


def growing_column(xi, time: float, peclet: float, start: float = 0.0) -> np.ndarray:
    """Column that grows at a constant rate under a constant basal pressure.

    Heat equation on an interval that grows (Pastor et al., 2022, eqs. 45-52), summed over images so
    that every term is a product of an exponential and `erfcx` whose arguments are <= 0 and >= 0: no
    term overflows or cancels, whatever the Péclet number and the time.

    Parameters
    ----------
    xi : array_like
        Height above the base over the *present* thickness [-].
    time : float
        Time over the consolidation time of the *initial* thickness [-], > 0.
    peclet : float
        ``e_R h_0 / c_v`` [-], >= 0.
    start : float
        Uniform pressure at time 0 over the basal pressure [-].

    Returns
    -------
    ndarray
        Excess pore pressure over the basal one [-].

    Examples
    --------
    >>> growing_column([0.1, 0.5], 1.0, 1.0).round(8)
    array([0.94089764, 0.5985924 ])
    """
    y = (1.0 - np.asarray(xi, dtype=float)) * (1.0 + peclet * time)
    root = 2.0 * np.sqrt(time)

    def image(k, c, depth):
        growth = np.exp(peclet * k * (k - c) - ((c - depth) / root) ** 2)
        return 0.5 * growth * erfcx((c - depth + 2.0 * peclet * k * time) / root)

    cold = 0.5 * (erfc((1.0 - y) / root) - erfc((1.0 + y) / root))
    warm = erf(y / root)
    for k in range(1, int(7.0 * np.sqrt(time)) + 8):
        for c in (2 * k - 1, 2 * k + 1):
            cold = cold + image(k, c, y) - image(k, c, -y)
        warm = warm + 2.0 * (image(k, 2 * k, y) - image(k, 2 * k, -y))
    return cold + start * (warm - cold)


def constant_local_peclet(xi, peclet: float) -> np.ndarray:
    """Steady profile of a column whose erosion rate falls as it thickens, ``e_R h / c_v`` constant.

    ``Pe (1 - xi) dp/dxi = d2p/dxi2`` (eq. 35 without time) between 1 at the base and 0 at the surface.

    Examples
    --------
    >>> constant_local_peclet([0.0, 0.5, 1.0], 1.0).round(6)
    array([1.      , 0.560906, 0.      ])
    """
    eta = 1.0 - np.asarray(xi, dtype=float)
    root = np.sqrt(0.5 * peclet)
    return erf(root * eta) / erf(root) if root > 1e-8 else eta


def consolidation(xi, time: float, start: str = "linear", layer: float = 1.0) -> np.ndarray:
    """Column over an impermeable base that consolidates through its surface.

    Terzaghi's series (1943; Carslaw & Jaeger, 1959, section 3.4).

    Parameters
    ----------
    xi : array_like
        Height above the base over the thickness [-]; 0 gives the basal pressure.
    time : float
        ``c_v t / h^2`` [-], >= 0.
    start : {"linear", "basal_layer"}
        1 at the base falling to 0 at the surface, or 1 within ``layer`` of the base and 0 above.
    layer : float
        Thickness of that layer over that of the column [-]; 1 is a uniform start.

    Examples
    --------
    >>> [float(consolidation(0.0, time).round(4)) for time in (0.05, 0.2, 1.0)]
    [0.7477, 0.4959, 0.0687]
    """
    xi = np.asarray(xi, dtype=float)
    # terms beyond exp(-40), and never fewer than a linear start needs at time 0 (error 2e-5)
    terms = 10_000 if time <= 0.0 else int(min(10_000, 5.0 + np.sqrt(40.0 / time) / np.pi))
    waves = (np.arange(terms) + 0.5) * np.pi
    share = 2.0 / waves**2 if start == "linear" else 2.0 * np.sin(waves * layer) / waves
    return np.cos(xi[..., None] * waves) @ (share * np.exp(-(waves**2) * time))


def front(time_over_erosion_time):
    """Height of the front between old soil and new over the thickness, without diffusion.

    The old soil keeps its thickness while the column grows at a constant rate, so the front is at
    ``y/h = 1/(1 + t/T_e)`` (Pastor et al., 2022, eqs. 53-58).

    Examples
    --------
    >>> front(1.0)
    0.5
    """
    return 1.0 - 1.0 / (1.0 + time_over_erosion_time)
