"""Synthetic gully above a fan: the ground of a first scene, for which no file is needed."""

import numpy as np

from ..geo.lattice import Lattice

CRS = "EPSG:32632"
LATTICE = Lattice((61, 141), (5.0, 5.0), (400000.0, 5200000.0), CRS)
"""300 m x 700 m with nodes every 5 m; the place on the map is invented."""
HEAD_SLOPE, FAN_SLOPE = 34.0, 6.0
"""Slope of the ground at its western and its eastern end [deg]."""
GULLY_DEPTH, GULLY_WIDTH = 12.0, 45.0
"""Depth below the banks, and width between points at 1/e of it [m]."""
FAN_APEX = 330.0
"""Distance of the fan's apex from the western edge [m]."""
SOIL_DEPTH = 2.0
"""Depth of erodible soil above the apex [m]; half of it at the toe."""


def gully() -> tuple[np.ndarray, np.ndarray, Lattice]:
    """Build a gully that winds down to the east and opens onto a fan.

    Returns
    -------
    elevation, soil : ndarray, shape (61, 141)
        [m]
    lattice : Lattice
        Place of the nodes.

    Examples
    --------
    >>> elevation, soil, lattice = gully()
    >>> elevation.shape, lattice.spacing, bool(elevation[30, 0] > elevation[30, 60] > elevation[30, 120])
    ((61, 141), (5.0, 5.0), True)
    """
    x, y = LATTICE.x - LATTICE.x[0], (LATTICE.y - LATTICE.y[0])[:, None]
    easing = _smooth_step((x - 40.0) / (FAN_APEX + 100.0))
    slope = np.tan(np.radians(HEAD_SLOPE + (FAN_SLOPE - HEAD_SLOPE) * easing))
    fall = np.concatenate([[0.0], np.cumsum(0.5 * (slope[1:] + slope[:-1]) * np.diff(x))])
    middle = 0.5 * y[-1, 0] + 14.0 * np.sin(x / 55.0) * (1.0 - easing)
    depth = GULLY_DEPTH * (1.0 - _smooth_step((x - FAN_APEX + 120.0) / 160.0))
    banks = depth * (1.0 - np.exp(-((2.0 * (y - middle) / GULLY_WIDTH) ** 2)))
    bulge = 2.5 * _smooth_step((x - FAN_APEX) / 150.0) * np.exp(-(((y - middle) / 90.0) ** 2))
    elevation = 900.0 + fall[-1] - fall + banks + bulge
    soil = np.broadcast_to(SOIL_DEPTH * (1.0 - 0.5 * easing), elevation.shape).copy()
    return elevation, soil, LATTICE


def _smooth_step(t: np.ndarray) -> np.ndarray:
    t = np.clip(t, 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)
