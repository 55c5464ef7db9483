"""Families of ground for random scenes: open slopes, channels, fans, counter-slopes and benches, smooth or rough.

A family draws from a random generator and returns `Ground`. Lengths are in m and follow the spacing of nodes, of which
a grid has 90 to 220 along the fall.
"""

from typing import NamedTuple

import numpy as np
from landlab import RasterModelGrid

from .ground import ELEVATION, cut_channel, middle_line, roughen, slope_grid


class Ground(NamedTuple):
    """Ground without soil and release: grid, length [m], slope at the head [deg], and y of the middle line at x [m]."""

    grid: RasterModelGrid
    length: float
    head: float
    middle: object


def log_uniform(rng, low, high) -> float:
    """Return a number between two bounds, each factor as likely as any other."""
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def extent(rng, aspect):
    """Return length, width and spacing of a grid [m]; `aspect` is the width over the length."""
    spacing = log_uniform(rng, 2.0, 10.0)
    length = spacing * rng.integers(90, 220)
    return length, max(40.0 * spacing, aspect * length), spacing


def straight(x):
    """Return 0 at every x [m]."""
    return np.zeros_like(x)


def open_slope(rng) -> Ground:
    """A slope that eases to a plain, flat across, hollow or convex."""
    length, width, spacing = extent(rng, rng.uniform(0.35, 0.6))
    head, foot = rng.uniform(24.0, 42.0), rng.uniform(0.0, 8.0)
    bend = rng.uniform(0.3, 0.5) * length
    grid = slope_grid(length, width, spacing, (0.0, bend, bend + rng.uniform(0.1, 0.3) * length), (head, head, foot))
    # across: a parabola that rises, or falls, by up to a twelfth of the width at its edges
    grid.at_node[ELEVATION] += rng.uniform(-1.0, 2.0) * width / 24.0 * (grid.y_of_node / (0.5 * width)) ** 2
    return Ground(grid, length, head, straight)


def channel(rng) -> Ground:
    """A channel 6 to 18 nodes wide, straight or meandering, which ends on a plain or goes on to the edge."""
    length, width, spacing = extent(rng, 0.3)
    head, middle, foot = rng.uniform(20.0, 36.0), rng.uniform(10.0, 26.0), rng.uniform(1.0, 7.0)
    stations = np.array([0.0, 0.2, 0.45, 0.65]) * length
    grid = slope_grid(length, width, spacing, stations, (head, head, min(head, middle), foot))
    across = spacing * rng.uniform(6.0, 18.0)
    swing = rng.choice([0.0, rng.uniform(0.3, 1.0)]) * across
    wavelength, phase = across * rng.uniform(8.0, 16.0), rng.uniform(0.0, 2.0 * np.pi)

    def line(x):
        return middle_line(x, swing, wavelength, phase)

    end = None if rng.random() < 0.3 else rng.uniform(0.5, 0.7) * length
    depth = across * rng.uniform(0.12, 0.3)
    cut_channel(grid, across, depth, end=end, fade=0.12 * length, line=line(grid.x_of_node))
    return Ground(grid, length, head, line)


def fan(rng) -> Ground:
    """A steep channel in the front of a mountain, and a cone of debris below its mouth."""
    length, width, spacing = extent(rng, 0.5)
    head, foot, cone = rng.uniform(24.0, 38.0), rng.uniform(16.0, 28.0), rng.uniform(3.0, 11.0)
    apex = rng.uniform(0.3, 0.45) * length
    stations = (0.0, 0.6 * apex, apex, apex + 0.02 * length)
    grid = slope_grid(length, width, spacing, stations, (head, head, min(head, foot), 35.0))
    across = spacing * rng.uniform(6.0, 12.0)
    cut_channel(grid, across, across * rng.uniform(0.2, 0.35), end=apex, fade=0.1 * length)
    z, x, y = grid.at_node[ELEVATION], grid.x_of_node, grid.y_of_node
    mouth = z[np.argmin(np.hypot(x - apex, y))]
    z[:] = np.maximum(z, mouth - np.tan(np.radians(cone)) * np.hypot(x - apex, y))
    return Ground(grid, length, head, straight)


def counter_slope(rng) -> Ground:
    """A valley side, the floor of the valley and the side opposite."""
    length, width, spacing = extent(rng, rng.uniform(0.35, 0.5))
    head, opposite = rng.uniform(26.0, 40.0), -rng.uniform(5.0, 22.0)
    stations = np.array([0.0, 0.35, 0.5, 0.65, 1.0]) * length
    grid = slope_grid(length, width, spacing, stations, (head, head, 1.0, opposite, opposite))
    # the floor falls to the side, too
    grid.at_node[ELEVATION] += np.tan(np.radians(rng.uniform(0.0, 4.0))) * (grid.y_of_node + 0.5 * width)
    return Ground(grid, length, head, straight)


def benches(rng) -> Ground:
    """Two steps with a bench between them, and a plain."""
    length, width, spacing = extent(rng, 0.4)
    head, bench, step, foot = (rng.uniform(*pair) for pair in ((26, 40), (4, 15), (24, 40), (0, 6)))
    ends = np.cumsum([0.2, 0.08, rng.uniform(0.05, 0.15), 0.06, 0.15, 0.1]) * length
    grid = slope_grid(length, width, spacing, (0.0, *ends), (head, head, bench, bench, step, step, foot))
    return Ground(grid, length, head, straight)


FAMILIES = {open_slope: 0.24, channel: 0.36, fan: 0.17, counter_slope: 0.11, benches: 0.12}
"""Families and their shares."""


def draw_ground(rng) -> Ground:
    """Draw a family, its ground, and in half of the cases its roughness."""
    family = list(FAMILIES)[rng.choice(len(FAMILIES), p=list(FAMILIES.values()))]
    ground = family(rng)
    spacing = ground.grid.dx
    if rng.random() < 0.5:
        height, correlation = spacing * log_uniform(rng, 0.02, 0.15), spacing * rng.uniform(2.0, 5.0)
        roughen(ground.grid, height, correlation, int(rng.integers(2**31)))
    return ground
