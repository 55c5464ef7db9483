"""Scales of an event before it is computed: duration and thickness, each to a factor of two or so."""

import math

SLOPE = math.radians(30.0)
"""Slope down which the block of `sliding_time` slides [rad]."""

APPARENT_FRICTION = 0.3
"""Apparent friction of this block, and the tangent of its travel angle [-]."""

SPREAD = 20.0
"""Area that a debris flow inundates over its volume to the power 2/3 [-]."""


def sliding_time(fall: float, gravity: float) -> float:
    """Return the time in which a block slides down a slope and comes to rest on flat ground [s].

    Parameters
    ----------
    fall : float
        Height over which it slides [m].
    gravity : float
        [m s-2].

    Returns
    -------
    float
        With a slope of 30 degrees and an apparent friction of 0.3, 7.3 (fall/gravity)^1/2 [s].

    Examples
    --------
    >>> round(sliding_time(500.0, 9.81))
    52
    """
    acceleration = gravity * (math.sin(SLOPE) - APPARENT_FRICTION * math.cos(SLOPE))
    speed = math.sqrt(2.0 * acceleration * max(fall, 0.0) / math.sin(SLOPE))
    return speed / acceleration + speed / (APPARENT_FRICTION * gravity)


def runout_thickness(volume: float) -> float:
    """Return the mean thickness of a debris flow of a volume [m3], spread over the ground that it inundates [m].

    References
    ----------
    Griswold & Iverson (2008): the area is 20 volume^(2/3), of debris flows without volcanic clay.

    Examples
    --------
    >>> [round(runout_thickness(volume), 3) for volume in (8.0, 8000.0)]  # a flume, a hillslope
    [0.1, 1.0]
    """
    return volume ** (1.0 / 3.0) / SPREAD
