"""The layer that forms over a base whose pressure is suddenly another one, while soil comes in or not.

In the frame of the moving base, soil passes at the rate of erosion: advection and diffusion from a
boundary held at 1, the solution of Ogata & Banks (1961, USGS Professional Paper 411-A). Depths are over
the thickness.
"""

import math

from .....core.jit import inner

ROOT_PI = math.sqrt(math.pi)
SEEN = 1.5  # cells from which levels can follow the layer


@inner
def layer(distance, grown, passed):
    """Return what has come of a boundary held at 1, ``distance`` from the base.

    Parameters
    ----------
    distance : float
        From the base, > 0.
    grown : float
        Thickness of the soil that came in.
    passed : float
        ``c_v t / h^2``, >= 0.
    """
    if passed <= 0.0:
        return 1.0 if distance < grown else 0.0
    root = 2.0 * math.sqrt(passed)
    before, after = (distance - grown) / root, (distance + grown) / root
    if after < 5.0:  # exp(e x / D) erfc: the exponent is the difference of the squares
        beyond = math.exp(min(after * after - before * before, 700.0)) * math.erfc(after)
    else:  # five terms of the asymptotic series of exp(x^2) erfc(x), 1e-6 here
        square = 0.5 / (after * after)
        series = 1.0 - square * (1.0 - 3.0 * square * (1.0 - 5.0 * square * (1.0 - 7.0 * square)))
        beyond = math.exp(-before * before) * series / (after * ROOT_PI)
    return min(0.5 * (math.erfc(before) + beyond), 1.0)


@inner
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


@inner
def is_seen(cells, grown, passed):
    """Return whether levels can follow the layer."""
    return cells * (grown + 2.0 * math.sqrt(passed)) > SEEN


@inner
def base_share(cells, grown, passed):
    """Return how much of the half cell of the base level the layer fills: its content but for that at other levels."""
    if passed <= 0.0:
        return min(2.0 * cells * grown, 1.0)
    reached = layer_content(grown, passed) * cells
    for k in range(1, cells):
        reached -= layer(k / cells, grown, passed)
    return min(max(2.0 * reached, 0.0), 1.0)


@inner
def wave_of_layer(number, passed):
    """Return what the layer over a base that stood still has of the wave ``number``, over an impermeable base.

    ``2 integral erfc(y / 2 root(passed)) cos(number y) dy``: Dawson's integral over the wave number, here by a
    rational fit that is right to 8e-4 and in both limits.
    """
    x = number * math.sqrt(passed)
    s = x * x
    above = 1.0 + s * (0.13418406 + s * (0.03645163 + s * 0.01360765))
    below = 1.0 + s * (0.80085073 + s * (0.31649956 + s * (0.05669176 + s * 0.0272153)))
    return 4.0 * x * above / (below * number * ROOT_PI)
