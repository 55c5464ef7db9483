"""Gravity on a plane, and the edge of a flow: shared by the exact solutions."""

import numpy as np
from numpy.typing import ArrayLike

GRAVITY = 9.81
"""Acceleration of gravity [m s-2]."""


def plane_gravity(slope: float, friction: float, gravity: float) -> tuple[float, float]:
    """Return gravity across a plane, and gravity along it less the friction of a downward slide [m s-2]."""
    return gravity * np.cos(slope), gravity * (np.sin(slope) - friction * np.cos(slope))


def cut_dry(h: np.ndarray, *velocity: ArrayLike) -> tuple[np.ndarray, ...]:
    """Return thickness [m] and velocities [m s-1], both 0 where a formula gives no positive thickness."""
    wet = h > 0.0
    return (np.where(wet, h, 0.0), *(np.where(wet, value, 0.0) for value in velocity))
