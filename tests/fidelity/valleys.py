"""A small valley with a release, and a flow on it that is planned within a second."""

import numpy as np
from landlab import RasterModelGrid

from landlab_debrisflow import DebrisFlow

SHORT = 1.0
"""Longest time of an event that is to be planned fast [s]."""


def valley(shape=(15, 30), soil=1.0, release=1.0):
    """Return a grid of 5 m with a release of 8 m radius at the upper end of a valley."""
    grid = RasterModelGrid(shape, xy_spacing=5.0, xy_of_lower_left=(1000.0, 2000.0))
    x, y = grid.x_of_node - 1000.0, grid.y_of_node - 2000.0
    grid.add_field("topographic__elevation", 100.0 - 0.5 * x + 0.02 * abs(y - 35.0), at="node")
    grid.add_full("soil__depth", soil, at="node")
    depth = release * (np.hypot(x - 30.0, y - 35.0) < 8.0)
    grid.add_field("debris_flow__release_depth", depth, at="node")
    return grid


def flow_on(grid, **keywords):
    """Return a flow on a grid, with the law of Voellmy unless keywords say otherwise."""
    return DebrisFlow(grid, **{"friction": "voellmy"} | keywords)


def fields(grid):
    """Return copies of all fields at nodes by name."""
    return {name: np.array(grid.at_node[name]) for name in grid.at_node}
