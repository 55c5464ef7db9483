"""Boundary layer over a base whose pressure has just changed, with or without inflow of soil.

In the frame of the moving base, soil passes at the rate of erosion: advection and diffusion from a
boundary held at 1, the solution of Ogata & Banks (1961, USGS Professional Paper 411-A). Depths are over
the thickness.
"""

import math

from .....core.jit import inner

ROOT_PI = math.sqrt(math.pi)
BEYOND = 6.0
"""Distance over the diffusive thickness of a layer from which on the layer is below the rounding of 1: erfc(6) is
2e-17."""
RESOLVED = 1.5  # least thickness of a layer that levels resolve [cells]


@inner
def boundary_layer(distance, growth, diffusion):
    """Return the layer over a boundary held at 1, at a distance from the base [-].

    Parameters
    ----------
    distance : float
        From the base over the thickness, > 0 [-].
    growth : float
        Thickness of the soil that came in, over the thickness [-].
    diffusion : float
        ``c_v t / h^2``, >= 0 [-].
    """
    if diffusion <= 0.0:
        return 1.0 if distance < growth else 0.0
    root = 2.0 * math.sqrt(diffusion)
    before, after = (distance - growth) / root, (distance + growth) / root
    if before > BEYOND:
        return 0.0
    if after < 5.0:  # exp(e x / D) erfc(after): the exponent is the difference of the squares of `after` and `before`
        beyond = math.exp(min(after * after - before * before, 700.0)) * math.erfc(after)
    else:  # five terms of the asymptotic series of exp(x^2) erfc(x), 1e-6 here
        square = 0.5 / (after * after)
        series = 1.0 - square * (1.0 - 3.0 * square * (1.0 - 5.0 * square * (1.0 - 7.0 * square)))
        beyond = math.exp(-before * before) * series / (after * ROOT_PI)
    return min(0.5 * (math.erfc(before) + beyond), 1.0)


@inner
def layer_content(growth, diffusion):
    """Return the integral of the layer over distance [-]: the part carried in by soil and the part diffused in.

    `growth` and `diffusion` are as in `boundary_layer` [-].
    """
    if growth <= 0.0:
        return 2.0 * math.sqrt(diffusion) / ROOT_PI
    if diffusion <= 0.0:
        return growth
    u = growth / (2.0 * math.sqrt(diffusion))
    if u > 5.0:
        return growth + diffusion / growth
    inflow = math.erf(u) - 2.0 * u * u * math.erfc(u) + 2.0 * u * math.exp(-u * u) / ROOT_PI
    return growth + inflow * diffusion / growth


@inner
def is_resolved(cells, growth, diffusion):
    """Return whether levels, `cells` intervals, resolve the layer; `growth`, `diffusion` as in `boundary_layer`."""
    return cells * (growth + 2.0 * math.sqrt(diffusion)) > RESOLVED


@inner
def basal_filling(cells, growth, diffusion):
    """Return the fraction of the half cell of the base level that the layer fills [-].

    `cells` is the number of intervals between levels; `growth` and `diffusion` are as in `boundary_layer` [-].

    The fraction is the integral of the layer less the part that the levels above already hold.
    """
    if diffusion <= 0.0:
        return min(2.0 * cells * growth, 1.0)
    content = layer_content(growth, diffusion) * cells
    for k in range(1, cells):
        content -= boundary_layer(k / cells, growth, diffusion)
    return min(max(2.0 * content, 0.0), 1.0)


@inner
def mode_of_layer(number, diffusion):
    """Return the amplitude of the mode with a wave number in the layer over a base without erosion [-].

    Over an impermeable base: ``2 integral erfc(y / 2 root(diffusion)) cos(number y) dy``, Dawson's integral over the
    wave number, here by a rational fit with an error below 8e-4 that is exact in both limits.
    """
    x = number * math.sqrt(diffusion)
    s = x * x
    above = 1.0 + s * (0.13418406 + s * (0.03645163 + s * 0.01360765))
    below = 1.0 + s * (0.80085073 + s * (0.31649956 + s * (0.05669176 + s * 0.0272153)))
    return 4.0 * x * above / (below * number * ROOT_PI)
