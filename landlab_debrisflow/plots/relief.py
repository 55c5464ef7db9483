"""Relief: light from several directions, steeper than life where the ground is flat."""

import numpy as np
import xarray as xr
from scipy.ndimage import distance_transform_edt, uniform_filter

LIGHTS = ((315.0, 0.55), (270.0, 0.15), (0.0, 0.15), (225.0, 0.15))
"""Directions of light, clockwise from north [deg], and their weights: what one leaves in the dark another one shows."""

ALTITUDE = 40.0
"""Of all lights above the horizon [deg]."""

STEEP = 0.8
"""Gradient up to which the steepest tenth of the ground is drawn [-]: a fan of three degrees shows its form, too."""

LARGEST_EXAGGERATION = 12.0
"""A plain with centimetres of noise stays a plain."""

DARK, LEVEL, BRIGHT = 0.66, 0.89, 1.0
"""Grey of the darkest, of level and of the brightest ground [-]: light, so that colours stand out from it."""

BROAD = 0.7
"""Fraction of the broad light and shade of whole hillsides that is taken away [-]."""

LEAST_CONTRAST = 0.12
"""Difference of brightness below which greys are not drawn apart any further [-]."""


def hillshade(elevation: xr.DataArray) -> np.ndarray:
    """Return the brightness of a relief, 0 black to 1 white, NaN where the elevation is missing.

    Parameters
    ----------
    elevation : xarray.DataArray
        Over ``y`` and ``x``, which increase [m].

    Returns
    -------
    ndarray, shape (rows, columns)

    Examples
    --------
    >>> import numpy as np
    >>> import xarray as xr
    >>> x = y = np.arange(0.0, 50.0, 10.0)
    >>> ridge = xr.DataArray(-abs(x - 20.0) + 0.0 * y[:, None], {"y": y, "x": x}, ("y", "x"))
    >>> bool(hillshade(ridge)[2, 0] > hillshade(ridge)[2, 4])  # light comes from the west
    True
    """
    values = elevation.values.astype(float)
    missing = ~np.isfinite(values)
    if missing.all():
        return np.full(values.shape, np.nan)
    slope_y, slope_x = np.gradient(_filled(values, missing), elevation.y.values, elevation.x.values)
    steepest = float(np.quantile(np.hypot(slope_x, slope_y)[~missing], 0.9))
    factor = float(np.clip(STEEP / max(steepest, 1e-12), 0.6, LARGEST_EXAGGERATION))
    bright = sum(weight * _lit(factor * slope_x, factor * slope_y, azimuth) for azimuth, weight in LIGHTS)
    # a hillside of one slope is one grey: what stands out from the ground around it is drawn, and some of the rest
    around = min(values.shape) // 4 + 1
    broad = uniform_filter(uniform_filter(bright, around, mode="nearest"), around, mode="nearest")
    flat = float(np.sin(np.radians(ALTITUDE)))
    bright = bright - BROAD * (broad - flat)
    low, high = (float(np.quantile(bright[~missing], q)) for q in (0.01, 0.99))
    shade = np.where(
        bright < flat,
        LEVEL - (LEVEL - DARK) * (flat - bright) / max(flat - low, LEAST_CONTRAST),
        LEVEL + (BRIGHT - LEVEL) * (bright - flat) / max(high - flat, LEAST_CONTRAST),
    )
    return np.where(missing, np.nan, np.clip(shade, DARK, BRIGHT))


def _lit(slope_x: np.ndarray, slope_y: np.ndarray, azimuth: float) -> np.ndarray:
    """Return the cosine between the normals of a surface and the light from an azimuth [deg], at least 0."""
    towards, up = np.radians(azimuth), np.radians(ALTITUDE)
    east, north = np.sin(towards) * np.cos(up), np.cos(towards) * np.cos(up)
    return np.maximum(0.0, (np.sin(up) - east * slope_x - north * slope_y) / np.sqrt(1.0 + slope_x**2 + slope_y**2))


def _filled(values: np.ndarray, missing: np.ndarray) -> np.ndarray:
    """Return values with gaps filled from the nearest neighbour, so that the ground has slopes up to its edge."""
    if not missing.any():
        return values
    nearest = distance_transform_edt(missing, return_distances=False, return_indices=True)
    return values[tuple(nearest)]


def contour_interval(lowest: float, highest: float, lines: int = 12) -> float:
    """Return a round interval [m] by which about as many contour lines lie between two elevations.

    Parameters
    ----------
    lowest, highest : float
        Elevations [m].
    lines : int
        Number wanted.

    Returns
    -------
    float

    Examples
    --------
    >>> contour_interval(95.0, 310.0), contour_interval(0.0, 3.0)
    (20.0, 0.2)
    """
    wanted = max(highest - lowest, 1e-6) / lines
    power = 10.0 ** np.floor(np.log10(wanted))
    return float(min((m * power for m in (1.0, 2.0, 5.0, 10.0)), key=lambda m: abs(np.log(m / wanted))))
