"""Dam breaks: a reservoir of uniform depth is set free at ``x = 0``."""

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from .plane import GRAVITY, cut_dry, plane_gravity

START = 1e-200
"""A time so short that a dam break is still the step it starts from [s]."""


def ritter(x: ArrayLike, time: float, depth: float = 1.0, gravity: float = GRAVITY) -> tuple[np.ndarray, ...]:
    """Return depth and velocity of a dam break on a dry flat bed without friction.

    Parameters
    ----------
    x : array_like
        Position, the dam at 0 [m].
    time : float
        Time since the dam broke, >= 0 [s].
    depth : float
        Depth of the reservoir [m].
    gravity : float
        Acceleration by gravity [m s-2].

    Returns
    -------
    h, u : ndarray, shape of `x`
        Depth [m] and velocity [m s-1].

    References
    ----------
    Ritter (1892).

    Examples
    --------
    >>> h, u = ritter(0.0, 1.0)
    >>> bool(np.isclose(h, 4.0 / 9.0))
    True
    """
    return mangeney(x, time, depth, 0.0, 0.0, gravity)


def mangeney(
    x: ArrayLike, time: float, depth: float = 1.0, slope: float = 0.0, friction: float = 0.0, gravity: float = GRAVITY
) -> tuple[np.ndarray, ...]:
    """Return thickness and velocity of a dam break on a dry plane with Coulomb friction below its slope.

    Ritter's solution in a frame that falls with ``m = g cos(slope) (tan(slope) - friction)``: the reservoir as a
    whole moves at ``m t``, the front is at ``2 c0 t + m t^2/2`` and the rarefaction starts at ``-c0 t + m t^2/2``.

    Parameters
    ----------
    x : array_like
        Position down the plane, the dam at 0 [m].
    time : float
        Time since the dam broke, >= 0 [s].
    depth : float
        Slope-normal thickness of the reservoir [m].
    slope : float
        Slope of the plane [rad].
    friction : float
        Apparent friction coefficient [-].
    gravity : float
        Acceleration by gravity [m s-2].

    Returns
    -------
    h, u : ndarray, shape of `x`
        Thickness [m] and velocity [m s-1].

    Raises
    ------
    ValueError
        If friction holds the reservoir.

    References
    ----------
    Mangeney, Heinrich & Roche (2000).
    """
    normal, pull = plane_gravity(slope, friction, gravity)
    if pull < 0.0:
        raise ValueError("friction holds the reservoir: no solution of this form")
    celerity, x, time = np.sqrt(normal * depth), np.asarray(x, dtype=float), max(time, START)
    place = (x - 0.5 * pull * time**2) / time  # in the falling frame, over time
    wave = np.clip((2.0 * celerity - place) / 3.0, 0.0, celerity)
    return cut_dry(wave**2 / normal, 2.0 * (celerity - wave) + pull * time)


def mangeney_front(
    time: ArrayLike, depth: float = 1.0, slope: float = 0.0, friction: float = 0.0, gravity: float = GRAVITY
) -> np.ndarray:
    """Return the position of the front of `mangeney` [m].

    Parameters
    ----------
    time : array_like
        Time since the dam broke [s].
    depth, slope, friction, gravity : float
        As in `mangeney`.

    Returns
    -------
    ndarray, shape of `time`
    """
    (normal, pull), time = plane_gravity(slope, friction, gravity), np.asarray(time, dtype=float)
    return 2.0 * np.sqrt(normal * depth) * time + 0.5 * pull * time**2


def stoker_states(depth: float = 1.0, depth_ahead: float = 0.1, gravity: float = GRAVITY) -> tuple[float, float, float]:
    """Return depth and velocity between rarefaction and shock of `stoker`, and the speed of the shock.

    Parameters
    ----------
    depth, depth_ahead : float
        Depth of the reservoir, and of the water at rest below the dam, ``0 < depth_ahead < depth`` [m].
    gravity : float
        Acceleration by gravity [m s-2].

    Returns
    -------
    depth, velocity, shock : float
        [m, m s-1, m s-1].
    """

    def behind_shock(h):
        return (h - depth_ahead) * np.sqrt(0.5 * gravity * (h + depth_ahead) / (h * depth_ahead))

    def behind_rarefaction(h):
        return 2.0 * (np.sqrt(gravity * depth) - np.sqrt(gravity * h))

    middle = brentq(lambda h: behind_shock(h) - behind_rarefaction(h), depth_ahead, depth, xtol=1e-15, rtol=1e-14)
    velocity = behind_rarefaction(middle)
    return middle, velocity, middle * velocity / (middle - depth_ahead)


def stoker(
    x: ArrayLike, time: float, depth: float = 1.0, depth_ahead: float = 0.1, gravity: float = GRAVITY
) -> tuple[np.ndarray, ...]:
    """Return depth and velocity of a dam break on a wet flat bed without friction.

    Parameters
    ----------
    x : array_like
        Position, the dam at 0 [m].
    time : float
        Time since the dam broke, >= 0 [s].
    depth, depth_ahead : float
        Depth of the reservoir, and of the water at rest below the dam, ``0 < depth_ahead < depth`` [m].
    gravity : float
        Acceleration by gravity [m s-2].

    Returns
    -------
    h, u : ndarray, shape of `x`
        Depth [m] and velocity [m s-1].

    References
    ----------
    Stoker (1957), section 10.8.
    """
    middle, _, shock = stoker_states(depth, depth_ahead, gravity)
    celerity, x, time = np.sqrt(gravity * depth), np.asarray(x, dtype=float), max(time, START)
    wave = np.clip((2.0 * celerity - x / time) / 3.0, np.sqrt(gravity * middle), celerity)
    ahead = x > shock * time
    return np.where(ahead, depth_ahead, wave**2 / gravity), np.where(ahead, 0.0, 2.0 * (celerity - wave))
