"""The layer that forms over a base whose pressure is suddenly another one, while soil comes in or not.

In the frame of the moving base, soil passes at the rate of erosion: advection and diffusion from a
boundary held at 1, the solution of Ogata & Banks (1961, USGS Professional Paper 411-A). Depths are over
the thickness.
"""

import math

from ...core.jit import kernel

ROOT_PI = math.sqrt(math.pi)


@kernel
def layer(distance, grown, passed):
    """Return what has come of a boundary held at 1, ``distance`` from the base.

    Parameters
    ----------
    distance : float
        From the base, > 0.
    grown : float
        Thickness of the soil that came in.
    passed : float
        ``c_v t / h^2``, > 0.
    """
    root = 2.0 * math.sqrt(passed)
    before, after = (distance - grown) / root, (distance + grown) / root
    if after < 5.0:  # exp(e x / D) erfc: the exponent is the difference of the squares
        beyond = math.exp(min(after * after - before * before, 700.0)) * math.erfc(after)
    else:  # five terms of the asymptotic series of exp(x^2) erfc(x), 1e-6 here
        square = 0.5 / (after * after)
        series = 1.0 - square * (1.0 - 3.0 * square * (1.0 - 5.0 * square * (1.0 - 7.0 * square)))
        beyond = math.exp(-before * before) * series / (after * ROOT_PI)
    return min(0.5 * (math.erfc(before) + beyond), 1.0)


@kernel
def layer_content(grown, passed):
    """Return the content of the layer: what came in with the soil and what diffused in."""
    if grown <= 0.0:
        return 2.0 * math.sqrt(passed) / ROOT_PI
    if passed <= 0.0:
        return grown
    u = grown / (2.0 * math.sqrt(passed))
    if u > 5.0:
        return grown + passed / grown
    inflow = math.erf(u) - 2.0 * u * u * math.erfc(u) + 2.0 * u * math.exp(-u * u) / ROOT_PI
    return grown + inflow * passed / grown
