"""Parabolic caps and ridges that spread on a plane while they slide, from rest."""

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from .plane import GRAVITY, cut_dry, plane_gravity


def ridge_half_width(
    time: float, half_width: float = 10.0, depth: float = 1.0, slope: float = 0.0, gravity: float = GRAVITY
) -> tuple[float, float]:
    """Return the half width of a parabolic ridge [m] and its rate [m s-1].

    ``l'' = 3/2 g cos(slope) V/l^2`` with ``V = 4/3 h0 l0``. Its first integral is ``l'^2 = 3 g' V (1/l0 - 1/l)`` and
    its second, with ``s = l/l0``, ``t (3 g' V/l0^3)^(1/2) = (s (s - 1))^(1/2) + arcosh(s^(1/2))``.

    Parameters
    ----------
    time : float
        Time since its release at rest [s].
    half_width, depth : float
        At time 0: half width along the slope, slope-normal thickness in the middle [m].
    slope : float
        Slope of the plane [rad].
    gravity : float
        Acceleration by gravity [m s-2].

    Returns
    -------
    half_width, rate : float
    """
    rate = 2.0 * np.sqrt(gravity * np.cos(slope) * depth) / half_width  # (3 g' V / l0^3)^(1/2)

    def lateness(s):
        return np.sqrt(s * (s - 1.0)) + np.arccosh(np.sqrt(s)) - rate * time

    stretch = brentq(lateness, 1.0, 2.0 + rate * time, xtol=1e-14, rtol=1e-14)
    return half_width * stretch, half_width * rate * np.sqrt(1.0 - 1.0 / stretch)


def ridge(
    x: ArrayLike,
    time: float,
    half_width: float = 10.0,
    depth: float = 1.0,
    slope: float = 0.0,
    friction: float = 0.0,
    gravity: float = GRAVITY,
) -> tuple[np.ndarray, ...]:
    """Return thickness and velocity of a parabolic ridge that spreads in one dimension while it slides.

    The pressure coefficient is 1. Friction may have any value as long as the whole ridge moves down: either none, or
    ``tan(slope) - friction > 2 h0/l0``.

    Parameters
    ----------
    x : array_like
        Position down the plane, the middle at time 0 at 0 [m].
    time : float
        Time since its release at rest [s].
    half_width, depth : float
        At time 0: half width along the slope, slope-normal thickness in the middle [m].
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
        If the rear end would move up the slope.

    References
    ----------
    Savage & Hutter (1989).
    """
    pull = plane_gravity(slope, friction, gravity)[1]
    if friction > 0.0 and np.tan(slope) - friction <= 2.0 * depth / half_width:
        raise ValueError("the rear end would move up the slope, where friction changes its sign")
    width, rate = ridge_half_width(time, half_width, depth, slope, gravity)
    place = (np.asarray(x, dtype=float) - 0.5 * pull * time**2) / width
    return cut_dry(depth * half_width / width * (1.0 - place**2), pull * time + place * rate)


def cap_radius(
    time: ArrayLike, radius: float = 10.0, depth: float = 1.0, slope: float = 0.0, gravity: float = GRAVITY
) -> np.ndarray:
    """Return the radius of `cap` [m]: ``R^2 = R0^2 + 2 g cos(slope) h0 t^2``.

    Parameters
    ----------
    time : array_like
        Time since its release at rest [s].
    radius, depth, slope, gravity : float
        As in `cap`.

    Returns
    -------
    ndarray, shape of `time`
    """
    return np.sqrt(radius**2 + 2.0 * gravity * np.cos(slope) * depth * np.asarray(time, dtype=float) ** 2)


def cap(
    x: ArrayLike,
    y: ArrayLike,
    time: float,
    radius: float = 10.0,
    depth: float = 1.0,
    slope: float = 0.0,
    gravity: float = GRAVITY,
) -> tuple[np.ndarray, ...]:
    """Return thickness and velocities of a circular parabolic cap that spreads while it slides, without friction.

    The equations on a plane are those on a flat bed in a frame that falls with ``g sin(slope)``; there it is the
    limit of no basin of the curved free surface of Thacker (1981).

    Parameters
    ----------
    x, y : array_like
        Position down and across the plane, the centre at time 0 at the origin [m].
    time : float
        Time since its release at rest [s].
    radius, depth : float
        At time 0: radius on the plane, slope-normal thickness in the middle [m].
    slope : float
        Slope of the plane [rad].
    gravity : float
        Acceleration by gravity [m s-2].

    Returns
    -------
    h, u, v : ndarray, shape of `x` and `y` broadcast
        Thickness [m] and velocities [m s-1].

    References
    ----------
    Thacker (1981).
    """
    wide, pull = cap_radius(time, radius, depth, slope, gravity), plane_gravity(slope, 0.0, gravity)[1]
    x, y = np.asarray(x, dtype=float) - 0.5 * pull * time**2, np.asarray(y, dtype=float)
    rate = 2.0 * gravity * np.cos(slope) * depth * time / wide**2  # R'/R
    h = depth * (radius / wide) ** 2 * (1.0 - (x**2 + y**2) / wide**2)
    return cut_dry(h, pull * time + rate * x, rate * y)


def similarity_scales(
    time: float,
    length: float = 80.0,
    height: float = 4.0,
    slope: float = np.radians(35.0),
    friction: float = np.tan(np.radians(25.0)),
    gravity: float = GRAVITY,
) -> np.ndarray:
    """Return the lengths of `similarity` along and across the slope over the first one, and their rates.

    ``g'' = 2 B/(g^2 f)`` and ``f'' = 2 B/(g f^2) - C f'/((A - C) tau)`` with ``tau = t (gravity/length)^(1/2)``,
    ``A = sin(slope)``, ``B = cos(slope) height/length``, ``C = cos(slope) friction``; ``g = f = 1`` and at rest at 0.

    Parameters
    ----------
    time : float
        Time since its release at rest [s].
    length, height, slope, friction, gravity : float
        As in `similarity`.

    Returns
    -------
    ndarray, shape (4,)
        ``g, f, dg/dt, df/dt`` [-, -, s-1, s-1].
    """
    from scipy.integrate import solve_ivp  # imported here because loading takes a tenth of a second

    pull, spread, hold = np.sin(slope), np.cos(slope) * height / length, np.cos(slope) * friction
    # g'' and f'' at time 0, where f'/tau tends to f''
    second = np.array([2.0 * spread, 2.0 * spread * (pull - hold) / pull])
    # until `begin` the solution is a parabola, with an error of begin^4
    begin, end = 1e-3, time * np.sqrt(gravity / length)

    def rates(tau, state):
        g, f, dg, df = state
        return dg, df, 2.0 * spread / (g**2 * f), 2.0 * spread / (g * f**2) - hold * df / ((pull - hold) * tau)

    start = np.append(1.0 + 0.5 * second * min(begin, end) ** 2, second * min(begin, end))
    if end > begin:
        start = solve_ivp(rates, (begin, end), start, "DOP853", rtol=1e-12, atol=1e-14).y[:, -1]
    return start * np.array([1.0, 1.0, *2 * [np.sqrt(gravity / length)]])


def similarity(
    x: ArrayLike,
    y: ArrayLike,
    time: float,
    length: float = 80.0,
    height: float = 4.0,
    slope: float = np.radians(35.0),
    friction: float = np.tan(np.radians(25.0)),
    gravity: float = GRAVITY,
) -> tuple[np.ndarray, ...]:
    """Return thickness and velocities of a parabolic cap with Coulomb friction in two dimensions.

    Exact for friction linearised about the motion of the centre, ``-friction g cos(slope) (1, v/u_c)``; against full
    Coulomb friction it is off by some 1 % at 5 s.

    Parameters
    ----------
    x, y : array_like
        Position down and across the plane, the centre at time 0 at the origin [m].
    time : float
        Time since its release at rest [s].
    length, height : float
        At time 0: radius on the plane, slope-normal thickness in the middle [m].
    slope : float
        Slope of the plane [rad].
    friction : float
        Apparent friction coefficient [-].
    gravity : float
        Acceleration by gravity [m s-2].

    Returns
    -------
    h, u, v : ndarray, shape of `x` and `y` broadcast
        Thickness [m] and velocities [m s-1].

    References
    ----------
    Hutter, Siegel, Savage & Nohguchi (1993).
    """
    g, f, dg, df = similarity_scales(time, length, height, slope, friction, gravity)
    pull = plane_gravity(slope, friction, gravity)[1]
    x, y = np.asarray(x, dtype=float) - 0.5 * pull * time**2, np.asarray(y, dtype=float)
    h = height / (f * g) * (1.0 - (x / (length * g)) ** 2 - (y / (length * f)) ** 2)
    return cut_dry(h, pull * time + x * dg / g, y * df / f)
