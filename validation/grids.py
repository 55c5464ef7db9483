"""Small grids for tests, and helpers to fill and compare them."""

import numpy as np
from landlab import RasterModelGrid

COARSE = {"particle_count": 100}
"""Numerics of tests that do not look at accuracy."""


def inclined(shape, spacing, slope, soil=None, foot=None, **keywords):
    """Return a grid that falls by `slope` [-] towards larger x, flat beyond ``x = foot`` from its west edge [m]."""
    grid = RasterModelGrid(shape, xy_spacing=spacing, **keywords)
    x = grid.x_of_node - grid.x_of_node.min()
    end = x.max() if foot is None else foot
    grid.add_field("topographic__elevation", slope * np.maximum(0.0, end - x), at="node")
    if soil is not None:
        grid.add_full("soil__depth", float(soil), at="node")
    return grid


def release_slab(grid, centre, half_width, depth, on_top=False):
    """Let a square of `depth` [m] around `centre` fail (map coordinates of the grid)."""
    near = (abs(grid.x_of_node - centre[0]) < half_width) & (abs(grid.y_of_node - centre[1]) < half_width)
    return release(grid, np.where(near, depth, 0.0), on_top)


def release_cap(grid, centre, radii, depth, on_top=False):
    """Let a parabolic cap of `depth` [m] in the middle and elliptic outline fail."""
    r2 = ((grid.x_of_node - centre[0]) / radii[0]) ** 2 + ((grid.y_of_node - centre[1]) / radii[1]) ** 2
    return release(grid, depth * np.maximum(0.0, 1.0 - r2), on_top)


def release(grid, depth, on_top=False):
    """Let `depth`, shape (nodes,) [m], fail; with `on_top` it lies on the surface given before.

    Otherwise it leaves a scar, out of which it has to climb: worth 1e-3 of the travel of a cap 2 cm thick.
    """
    name = "debris_flow__release_depth"
    field = grid.at_node[name] if name in grid.at_node else grid.add_zeros(name, at="node")
    field[:] = depth
    if on_top:
        grid.at_node["topographic__elevation"] += depth
        if "soil__depth" in grid.at_node:
            grid.at_node["soil__depth"] += depth
    return field


def copy_fields(grid):
    """Return copies of all node fields."""
    return {name: grid.at_node[name].copy() for name in grid.at_node}


def changed_fields(grid, before):
    """Return the names of fields that differ from `before` in any bit, or came or went."""
    names = set(grid.at_node) ^ set(before)
    same = set(before) & set(grid.at_node)
    return names | {name for name in same if grid.at_node[name].tobytes() != before[name].tobytes()}


def dry_block(friction_coefficient, erosion="none", **numerics):
    """Return the keywords of a flow whose apparent friction is `friction_coefficient`: dry, no pore pressure."""
    return {
        "friction": {"law": "coulomb", "basal_friction_angle": float(np.degrees(np.arctan(friction_coefficient)))},
        "erosion": erosion,
        "column": "none",
        "material": {"water_density": 0.0},
        "numerics": {"settle": False, **numerics},
    }


def place(flow):
    """Release the failing ground, in a step too short to move it."""
    flow.run_one_step(1e-9)
    return flow


def set_free(flow):
    """Set arrested particles free."""
    flow._simulation.set_free()


def throw(flow, velocity):
    """Give the particles of a flow a velocity, in the order in which they were released, and let them move.

    Parameters
    ----------
    flow : DebrisFlow
        Just placed, none of its particles asleep.
    velocity : sequence of float, ndarray of shape (n,) or None
        Components along x, y and z [m s-1]; None, or a z left out: as it is.
    """
    set_free(flow)
    for component, value in zip(flow._simulation.particles.velocity, velocity, strict=False):
        if value is not None:
            component[:] = value


def centre_of_mass(flow):
    """Return map position x [m], map velocity along x [m/s] and volume [m3] of the whole body."""
    p = flow.particles
    volume = float(p.volume.sum())
    return float((p.x * p.volume).sum()) / volume, float((p.velocity_x * p.volume).sum()) / volume, volume
