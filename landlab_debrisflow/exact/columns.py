"""Closed forms of the excess pore pressure in a column (docs/theory.md#column-solutions), to test and to teach with.

Everything is dimensionless: heights over the thickness, ``xi`` = 0 at the base and 1 at the surface, times over the
consolidation time (``h^2 / c_v``), pressures over the basal pressure.
"""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import erf, erfc, erfcx

__all__ = [
    "basal_consolidation",
    "consolidation",
    "consolidation_modes",
    "constant_local_peclet",
    "front",
    "growing_column",
]

LINEAR, BASAL_LAYER = "linear", "basal_layer"
"""Profiles from which `consolidation` starts."""

MOST_MODES = 10_000
"""Most terms of a series: a linear profile is then 1 at the base at time 0, within 2e-5."""


def growing_column(xi: ArrayLike, time: float, peclet: float, start: float = 0.0) -> np.ndarray:
    """Return the pressure in a column that grows at a constant rate under a constant basal pressure.

    Heat equation on an interval that grows, summed over images so that every term is a product of an exponential and
    `erfcx` whose arguments are <= 0 and >= 0: no term overflows or cancels, whatever the Péclet number and the time.

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
    ndarray, shape of `xi`
        Excess pore pressure over the basal one [-].

    References
    ----------
    Pastor et al. (2022), eqs. 45-52.

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


def constant_local_peclet(xi: ArrayLike, peclet: float) -> np.ndarray:
    """Return the steady pressure [Pa] in a column whose erosion rate falls as it thickens, ``e_R h / c_v`` constant.

    ``Pe (1 - xi) dp/dxi = d2p/dxi2`` between 1 at the base and 0 at the surface.

    Parameters
    ----------
    xi : array_like
        Height above the base over the thickness [-].
    peclet : float
        ``e_R h / c_v`` [-], >= 0.

    Returns
    -------
    ndarray, shape of `xi`
        Excess pore pressure over the basal one [-].

    References
    ----------
    Pastor et al. (2022), eq. 35 without time.

    Examples
    --------
    >>> constant_local_peclet([0.0, 0.5, 1.0], 1.0).round(6)
    array([1.      , 0.560906, 0.      ])
    """
    eta = 1.0 - np.asarray(xi, dtype=float)
    root = np.sqrt(0.5 * peclet)
    return erf(root * eta) / erf(root) if root > 1e-8 else eta


def consolidation(xi: ArrayLike, time: float, start: str = LINEAR, layer: float = 1.0) -> np.ndarray:
    """Return the pressure in a column over an impermeable base that consolidates through its surface.

    Sum Terzaghi's series; terms below exp(-40) are left out.

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

    Returns
    -------
    ndarray, shape of `xi`
        Excess pore pressure over the basal one at time 0 [-].

    References
    ----------
    Terzaghi (1943); Carslaw & Jaeger (1959), section 3.4.

    Examples
    --------
    >>> [float(consolidation(0.0, time).round(4)) for time in (0.05, 0.2, 1.0)]
    [0.7477, 0.4959, 0.0687]
    """
    xi = np.asarray(xi, dtype=float)
    # all terms above exp(-40); at time 0 as many as the start of a linear profile needs
    terms = MOST_MODES if time <= 0.0 else int(min(MOST_MODES, 5.0 + np.sqrt(40.0 / time) / np.pi))
    wave, weight = consolidation_modes(terms, start, layer)
    return np.cos(xi[..., None] * wave) @ (weight * np.exp(-(wave**2) * time))


def basal_consolidation(time: ArrayLike, start: str = LINEAR, layer: float = 1.0, modes: int = 2000) -> np.ndarray:
    """Return the basal pressure of `consolidation` at many times.

    Parameters
    ----------
    time : array_like
        ``c_v t / h^2`` [-], >= 0.
    start, layer
        As in `consolidation`.
    modes : int
        Number of terms; 2000 leave an error of 1e-4 at time 0, and none soon after.

    Returns
    -------
    ndarray, shape of `time`
        Basal excess pore pressure over that at time 0 [-].

    Examples
    --------
    >>> basal_consolidation([0.05, 0.2, 1.0]).round(4)
    array([0.7477, 0.4959, 0.0687])
    """
    wave, weight = consolidation_modes(modes, start, layer)
    return np.exp(-np.multiply.outer(np.asarray(time, dtype=float), wave**2)) @ weight


def consolidation_modes(count: int, start: str = LINEAR, layer: float = 1.0) -> tuple[np.ndarray, np.ndarray]:
    """Return wave numbers and weights of the modes ``weight cos(wave xi) exp(-wave^2 time)`` of `consolidation`.

    Parameters
    ----------
    count : int
        Number of modes, the slowest first.
    start, layer
        As in `consolidation`.

    Returns
    -------
    wave, weight : ndarray, shape (count,)
        [-].
    """
    wave = (np.arange(count) + 0.5) * np.pi
    return wave, 2.0 / wave**2 if start == LINEAR else 2.0 * np.sin(wave * layer) / wave


def front(time_over_erosion_time: Any) -> Any:
    """Return the height of the front between old soil and new over the thickness, without diffusion [-].

    The old soil keeps its thickness while the column grows at a constant rate, so the front is at
    ``y/h = 1/(1 + t/T_e)`` below the surface.

    Parameters
    ----------
    time_over_erosion_time : array_like
        Time over ``T_e = h_0 / e_R`` [-], >= 0.

    Returns
    -------
    float or ndarray

    References
    ----------
    Pastor et al. (2022), eqs. 53-58.

    Examples
    --------
    >>> front(1.0)
    0.5
    """
    return 1.0 - 1.0 / (1.0 + time_over_erosion_time)
