"""Blocks and endless slabs on a plane: sliding, growing by erosion, losing their pore pressure."""

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from ..columns import LINEAR, consolidation_modes
from .plane import GRAVITY, plane_gravity

MODES = 2000
"""Number of decaying modes of the pore pressure: with them the start of a linear profile is 1 to 1e-4."""


def sliding_block(
    time: ArrayLike, slope: float, friction: float, speed: float = 0.0, gravity: float = GRAVITY
) -> tuple[np.ndarray, np.ndarray]:
    """Return velocity and travel of a block or endless slab under Coulomb friction.

    Held at rest where friction is not overcome; one that is braked stops at
    ``speed/(gravity (friction cos(slope) - sin(slope)))`` and stays.

    Parameters
    ----------
    time : array_like
        Time since the start [s].
    slope : float
        Slope of the plane [rad].
    friction : float
        Apparent friction coefficient [-].
    speed : float
        At time 0, >= 0 [m s-1].
    gravity : float
        Acceleration by gravity [m s-2].

    Returns
    -------
    velocity, travel : ndarray, shape of `time`
        [m s-1, m].

    Examples
    --------
    >>> velocity, travel = sliding_block(2.0, np.radians(30.0), 0.0)
    >>> round(float(velocity), 2), round(float(travel), 2)
    (9.81, 9.81)
    """
    pull, moving = plane_gravity(slope, friction, gravity)[1], np.asarray(time, dtype=float)
    if pull < 0.0:
        moving = np.minimum(moving, -speed / pull)
    return speed + pull * moving, speed * moving + 0.5 * pull * moving**2


def eroding_block(
    time: ArrayLike, slope: float, friction: float, growth: float, slip: float = 0.0, gravity: float = GRAVITY
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return velocity, travel and thickness ratio of a block from rest that entrains ``growth h v``.

    ``dv/dt = a - growth (1 - slip) v^2``; eroded soil enters with ``slip`` times the velocity of the block.

    Parameters
    ----------
    time : array_like
        Time since the start [s].
    slope : float
        Slope of the plane [rad].
    friction : float
        Apparent friction coefficient [-].
    growth : float
        Growth rate of the volume per length of travel [m-1].
    slip : float
        Velocity of the eroded soil over that of the block [-].
    gravity : float
        Acceleration by gravity [m s-2].

    Returns
    -------
    velocity, travel, ratio : ndarray, shape of `time`
        [m s-1, m, -]; the ratio is thickness over that at time 0.

    References
    ----------
    McDougall & Hungr (2005).
    """
    pull, drag = max(0.0, plane_gravity(slope, friction, gravity)[1]), growth * (1.0 - slip)
    rate, time = np.sqrt(pull * drag), np.asarray(time, dtype=float)
    if rate == 0.0:
        velocity, travel = pull * time, 0.5 * pull * time**2
    else:
        velocity, travel = np.sqrt(pull / drag) * np.tanh(rate * time), np.log(np.cosh(rate * time)) / drag
    return velocity, travel, np.exp(growth * travel)


def consolidating_block(
    time: ArrayLike,
    slope: float,
    friction: float,
    ratio: float,
    consolidation_time: float,
    start: str = LINEAR,
    layer: float = 1.0,
    gravity: float = GRAVITY,
) -> tuple[np.ndarray, np.ndarray]:
    """Return velocity and travel of a block from rest on its own pore pressure, which drains at the surface.

    ``dv/dt = g (sin(slope) - friction (1 - ratio r(t)) cos(slope))`` with ``friction = (rho'/rho) tan(phi)`` and ``r``
    the basal pressure of `columns.consolidation`. Friction only grows, so the block stops once and for good.

    Parameters
    ----------
    time : array_like
        Time since the start [s].
    slope : float
        Slope of the plane [rad].
    friction : float
        Friction coefficient without excess pore pressure [-].
    ratio : float
        Basal excess pore pressure over its liquefaction value at time 0 [-].
    consolidation_time : float
        ``h^2/c_v`` [s].
    start : {"linear", "basal_layer"}
        Profile at time 0, as of `columns.consolidation`.
    layer : float
        Thickness of the basal layer over that of the block [-]; 1 is a uniform start.
    gravity : float
        Acceleration by gravity [m s-2].

    Returns
    -------
    velocity, travel : ndarray, shape of `time`
        [m s-1, m].

    References
    ----------
    Hutchinson (1986).
    """
    wave, weight = consolidation_modes(MODES, start, layer)
    rate = wave**2 / consolidation_time
    normal, pull = plane_gravity(slope, friction, gravity)
    lift = friction * normal * ratio * weight

    def velocity(t):
        return pull * t - np.expm1(-np.multiply.outer(t, rate)) @ (lift / rate)

    moving = np.asarray(time, dtype=float)
    if pull < 0.0:
        # by this time friction has taken all the speed that pore pressure can give
        last = (lift / rate).sum() / -pull
        tiny = 1e-9 * consolidation_time  # time 0 is a root, too, and not the one sought
        moves = pull + lift.sum() > 0.0
        moving = np.minimum(moving, brentq(velocity, tiny, 1.001 * last, xtol=1e-12) if moves else 0.0)
    decay = np.exp(-np.multiply.outer(moving, rate))
    return velocity(moving), 0.5 * pull * moving**2 + moving * (lift / rate).sum() - (1.0 - decay) @ (lift / rate**2)
