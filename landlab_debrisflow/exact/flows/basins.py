"""Thacker's paraboloid: water that swings or breathes in a basin without friction."""

import numpy as np
from numpy.typing import ArrayLike

from .plane import GRAVITY, cut_dry


def basin(x: ArrayLike, y: ArrayLike = 0.0, radius: float = 10.0, depth: float = 1.0) -> np.ndarray:
    """Return the elevation of Thacker's paraboloid [m], 0 on the circle ``radius``, ``-depth`` in the middle.

    Parameters
    ----------
    x, y : array_like
        Position from the middle [m].
    radius, depth : float
        Radius and depth of the basin filled to its rim [m].

    Returns
    -------
    ndarray, shape of `x` and `y` broadcast
    """
    return depth * ((np.asarray(x, dtype=float) ** 2 + np.asarray(y, dtype=float) ** 2) / radius**2 - 1.0)


def thacker_planar_period(radius: float = 10.0, depth: float = 1.0, gravity: float = GRAVITY) -> float:
    """Return the period of `thacker_planar` [s], ``2 pi radius/(2 g depth)^(1/2)``.

    Parameters
    ----------
    radius, depth : float
        Radius and depth of the basin [m].
    gravity : float
        Acceleration by gravity [m s-2].

    Examples
    --------
    >>> round(thacker_planar_period(), 2)
    14.19
    """
    return float(2.0 * np.pi * radius / np.sqrt(2.0 * gravity * depth))


def thacker_planar(
    x: ArrayLike,
    y: ArrayLike,
    time: float,
    radius: float = 10.0,
    depth: float = 1.0,
    orbit: tuple[float, float] = (5.0, 5.0),
    gravity: float = GRAVITY,
) -> tuple[np.ndarray, ...]:
    """Return depth and velocities of a flat surface that swings in a paraboloid.

    A cap of constant shape whose centre moves on ``(a cos(w t), b sin(w t))``, any orbit of the oscillator ``w = (2 g
    h0)^(1/2)/radius``. Equal a and b in ``orbit = (a, b)`` give Thacker's circle; ``b = 0`` gives a start from rest and
    a motion along ``x``, which with ``y = 0`` is also the solution in one dimension.

    Parameters
    ----------
    x, y : array_like
        Position from the middle of the basin [m].
    time : float
        Time since the start [s].
    radius, depth : float
        Radius and depth of the basin [m].
    orbit : tuple of float
        a and b, half axes of the orbit of the centre [m].
    gravity : float
        Acceleration by gravity [m s-2].

    Returns
    -------
    h, u, v : ndarray, shape of `x` and `y` broadcast
        Depth [m] and velocities [m s-1].

    References
    ----------
    Thacker (1981).
    """
    frequency = np.sqrt(2.0 * gravity * depth) / radius
    cos, sin = np.cos(frequency * time), np.sin(frequency * time)
    x, y = np.asarray(x, dtype=float) - orbit[0] * cos, np.asarray(y, dtype=float) - orbit[1] * sin
    return cut_dry(-basin(x, y, radius, depth), -orbit[0] * frequency * sin, orbit[1] * frequency * cos)


def thacker_curved_period(radius: float = 10.0, depth: float = 1.0, gravity: float = GRAVITY) -> float:
    """Return the period of `thacker_curved` [s], half of that of `thacker_planar`.

    Parameters
    ----------
    radius, depth : float
        Radius and depth of the basin [m].
    gravity : float
        Acceleration by gravity [m s-2].
    """
    return float(2.0 * np.pi * radius / np.sqrt(8.0 * gravity * depth))


def thacker_curved(
    x: ArrayLike,
    y: ArrayLike,
    time: float,
    radius: float = 10.0,
    depth: float = 1.0,
    first_radius: float = 8.0,
    gravity: float = GRAVITY,
) -> tuple[np.ndarray, ...]:
    """Return depth and velocities of a circular cap that breathes in a paraboloid, from rest.

    ``A = (a^4 - r0^4)/(a^4 + r0^4)``; with squares, as it is often printed, the edge would start at ``(a r0)^(1/2)``.

    Parameters
    ----------
    x, y : array_like
        Position from the middle of the basin [m].
    time : float
        Time since the start [s].
    radius, depth : float
        Radius and depth of the basin [m].
    first_radius : float
        Radius of the edge at time 0 [m].
    gravity : float
        Acceleration by gravity [m s-2].

    Returns
    -------
    h, u, v : ndarray, shape of `x` and `y` broadcast
        Depth [m] and velocities [m s-1].

    References
    ----------
    Thacker (1981).
    """
    frequency = np.sqrt(8.0 * gravity * depth) / radius
    swing = (radius**4 - first_radius**4) / (radius**4 + first_radius**4)
    root, squeeze = np.sqrt(1.0 - swing**2), 1.0 - swing * np.cos(frequency * time)
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    h = depth * (root / squeeze - (x**2 + y**2) / radius**2 * (root / squeeze) ** 2)
    rate = 0.5 * frequency * swing * np.sin(frequency * time) / squeeze
    return cut_dry(h, rate * x, rate * y)
