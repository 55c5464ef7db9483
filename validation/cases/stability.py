"""Grids on which methods fail (docs/theory.md#failures)."""

import numpy as np
from landlab import RasterModelGrid

from landlab_debrisflow.exact import flows
from validation.grids import inclined, release, release_cap, release_slab


def raster(z, spacing):
    """Return a grid with these elevations, shape (rows, columns) [m]."""
    grid = RasterModelGrid(z.shape, xy_spacing=spacing)
    grid.add_field("topographic__elevation", np.array(z, float).ravel(), at="node")
    return grid


def gully(depth=5.0, slope=0.5, rows=21, columns=81):
    """A slope with a channel one node wide, `depth` below it, onto a flat; 1250 m3 above it."""
    row, column = np.mgrid[:rows, :columns]
    grid = raster(slope * 5.0 * np.maximum(0, 60 - column) - depth * (row == rows // 2), 5.0)
    release_slab(grid, (50.0, 5.0 * (rows // 2)), 13.0, 2.0, on_top=True)
    return grid


def cliff(height=50.0):
    """A slope of 17 degrees that ends in a wall between two columns of nodes, then a flat."""
    column = np.mgrid[:41, :81][1]
    grid = raster((height + 0.3 * 5.0 * (20 - column)) * (column < 20), 5.0)
    release_slab(grid, (60.0, 100.0), 16.0, 2.0, on_top=True)
    return grid


def pit(depth=20.0, spacing=5.0, thickness=1.0):
    """A flat with one node `depth` lower, under the middle of a slab."""
    z = np.full((21, 21), 100.0)
    z[10, 10] -= depth
    grid = raster(z, spacing)
    release_slab(grid, (10.0 * spacing, 10.0 * spacing), 2.6 * spacing, thickness, on_top=True)
    return grid


def noisy_slope(amplitude=2.0, slope=0.5, seed=3):
    """A slope onto a flat, white noise of `amplitude` [m] standard deviation on every node of 5 m."""
    column = np.mgrid[:41, :101][1]
    noise = np.random.default_rng(seed).normal(0.0, amplitude, column.shape)
    grid = raster(slope * 5.0 * np.maximum(0, 60 - column) + noise, 5.0)
    release_slab(grid, (50.0, 100.0), 13.0, 2.0, on_top=True)
    return grid


def walls(gap=False):
    """A slope barred by two rows of closed nodes, with or without a gap three nodes wide."""
    grid = inclined((21, 61), 5.0, 0.5)
    x, y = grid.x_of_node, grid.y_of_node
    grid.status_at_node[(abs(x - 200.0) < 6.0) & ((abs(y - 50.0) > 6.0) | (not gap))] = grid.BC_NODE_IS_CLOSED
    release_slab(grid, (50.0, 50.0), 13.0, 2.0, on_top=True)
    return grid


def steep_corner():
    """A valley side of 72 degrees (3 : 1 both ways), closed all round, so that a flow along it meets a wall."""
    grid = RasterModelGrid((21, 21), xy_spacing=2.0)
    x, y = grid.x_of_node, grid.y_of_node
    grid.add_field("topographic__elevation", 200.0 + 3.0 * (x - y), at="node")
    grid.status_at_node[grid.status_at_node != grid.BC_NODE_IS_CORE] = grid.BC_NODE_IS_CLOSED
    release_slab(grid, (20.0, 20.0), 5.0, 0.5, on_top=True)
    return grid


def plane(slope, thickness, spacing=5.0, half_width=13.0, columns=121):
    """A slab of some slope-normal thickness [m] on a plane."""
    grid = inclined((41, columns), spacing, slope)
    vertical = thickness * np.hypot(1.0, slope)
    release_slab(grid, (12.0 * spacing, 20.0 * spacing), half_width, vertical, on_top=True)
    return grid


def basin(amplitude=0.0, depth=2.0, spacing=5.0, seed=0):
    """Still water, `depth` deep in the middle, in a round basin with shores of up to 25 degrees."""
    y, x = (np.mgrid[:31, :31] - 15.0) * spacing
    r = np.hypot(x, y)
    z = 0.01 * np.maximum(0.0, r - 20.0) ** 2
    z += np.random.default_rng(seed).normal(0.0, 1.0, r.shape) * amplitude
    water = np.maximum(0.0, depth - z) * (r < 60.0)
    grid = raster(z + water, spacing)
    release(grid, water.ravel())
    return grid


RADIUS, DEPTH, AMPLITUDE = 100.0, 1.0, 0.3  # Thacker's bowl: a, h0 [m], A


def bowl(spacing=10.0, shift=0.0):
    """Thacker's bowl (docs/theory.md#flow-solutions) at the instant it is at rest; exact for the terrain, a quadratic.

    With `shift` [m] the cap of the bowl at rest stands aside and swings to and fro as it is; without, its surface is
    curved and it spreads and gathers.
    """
    nodes = 2 * int(1.7 * RADIUS / spacing) + 1
    y, x = (np.mgrid[:nodes, :nodes] - nodes // 2) * spacing
    if shift:
        h, *_ = flows.thacker_planar(x, y, 0.0, RADIUS, DEPTH, orbit=(shift, 0.0))
    else:
        first_radius = RADIUS * ((1.0 - AMPLITUDE) / (1.0 + AMPLITUDE)) ** 0.25
        h, *_ = flows.thacker_curved(x, y, 0.0, RADIUS, DEPTH, first_radius)
    grid = raster(flows.basin(x, y, RADIUS, DEPTH) + h, spacing)
    release(grid, h.ravel())
    return grid


def period(shift=0.0):
    """Return the period of the bowl [s]."""
    return (flows.thacker_planar_period if shift else flows.thacker_curved_period)(RADIUS, DEPTH)


def wide_release(volume=1e6):
    """A cap of `volume` [m3] on a slope of 17 degrees onto a flat, nodes of 20 m."""
    grid = inclined((81, 161), 20.0, 0.3, foot=1500.0)
    release_cap(grid, (400.0, 800.0), (200.0, 200.0), 2.0 * volume / (np.pi * 200.0**2), on_top=True)
    return grid
