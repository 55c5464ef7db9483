"""Ground of the scenes: a profile along x, a channel across it, roughness; and bodies of exact volume on it."""

import numpy as np
from landlab import RasterModelGrid
from scipy.ndimage import gaussian_filter

ELEVATION, SOIL, RELEASE = "topographic__elevation", "soil__depth", "debris_flow__release_depth"


def slope_grid(length, width, spacing, stations, angles, base=0.0):
    """Return a grid that falls along x, with y = 0 on its middle row.

    The slope angle is linear between stations, so the profile has a continuous slope and a bounded curvature.

    Parameters
    ----------
    length, width, spacing : float
        Of the grid [m].
    stations, angles : sequence of float
        Plan distance from the western edge [m] and slope there [deg].
    base : float
        Elevation of the eastern edge [m].
    """
    rows = 2 * round(0.5 * width / spacing) + 1
    columns = round(length / spacing) + 1
    middle = 0.5 * (rows - 1) * spacing
    grid = RasterModelGrid((rows, columns), xy_spacing=spacing, xy_of_lower_left=(0.0, -middle))
    fine = np.linspace(0.0, columns * spacing, 20 * columns + 1)
    tangent = np.tan(np.radians(np.interp(fine, stations, angles)))
    fall = np.concatenate([[0.0], np.cumsum(0.5 * (tangent[1:] + tangent[:-1]) * np.diff(fine))])
    grid.add_field(ELEVATION, base + fall[-1] - np.interp(grid.x_of_node, fine, fall), at="node", units="m")
    return grid


def middle_line(x, swing=0.0, wavelength=1.0, phase=0.0):
    """Return y of a meandering line at x [m], 0 without a swing."""
    return swing * np.sin(2.0 * np.pi * x / wavelength + phase)


def cut_channel(grid, width, depth, begin=None, end=None, fade=100.0, line=None):
    """Cut a channel whose banks are Gaussian, as deep as `depth` between `begin` and `end` [m].

    Parameters
    ----------
    grid : RasterModelGrid
        Its elevation is raised beside the channel, so the ground along the middle stays.
    width, depth : float
        Of the channel [m]: banks are at depth (1 - exp(-(2 y/width)^2)).
    begin, end, fade : float
        x where the channel begins and ends, none: at the edges; length over which it fades beyond [m].
    line : ndarray, shape (nodes,), optional
        y of the middle of the channel [m].
    """
    x, y = grid.x_of_node, grid.y_of_node - (0.0 if line is None else line)
    part = np.ones_like(x)
    if begin is not None:
        part *= np.clip((x - begin) / fade + 1.0, 0.0, 1.0)
    if end is not None:
        part *= np.clip((end - x) / fade + 1.0, 0.0, 1.0)
    part = part**2 * (3.0 - 2.0 * part)
    grid.at_node[ELEVATION] += part * depth * (1.0 - np.exp(-((2.0 * y / width) ** 2)))


def roughen(grid, height, correlation, seed):
    """Add correlated noise of some standard deviation to the elevation [m]; `correlation` is in m."""
    noise = np.random.default_rng(seed).standard_normal(grid.shape)
    noise = gaussian_filter(noise, correlation / grid.dx, mode="nearest")
    grid.at_node[ELEVATION] += height * ((noise - noise.mean()) / noise.std()).ravel()


def lay_soil(grid, depth, where=None):
    """Add soil of some depth [m] at the nodes `where` (all), nothing elsewhere."""
    soil = np.full(grid.number_of_nodes, float(depth))
    grid.add_field(SOIL, soil if where is None else np.where(where, soil, 0.0), at="node", units="m")


def release_cap(grid, x, y, half_axes, volume):
    """Add a parabolic cap of exactly this volume [m3] to the release, and as much to the soil if there is any.

    `x`, `y` are its middle and `half_axes` its half axes along x and y [m]; a cap narrower than two nodes is widened.
    """
    along, across = (max(axis, 1.5 * grid.dx) for axis in half_axes)
    shape = np.maximum(0.0, 1.0 - ((grid.x_of_node - x) / along) ** 2 - ((grid.y_of_node - y) / across) ** 2)
    shape[grid.boundary_nodes] = 0.0
    if RELEASE not in grid.at_node:
        grid.add_zeros(RELEASE, at="node", units="m")
    grid.at_node[RELEASE] += shape * (volume / (shape.sum() * grid.dx * grid.dy))
    if SOIL in grid.at_node:
        np.maximum(grid.at_node[SOIL], grid.at_node[RELEASE], out=grid.at_node[SOIL])
