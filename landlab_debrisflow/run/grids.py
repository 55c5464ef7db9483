"""Landlab grids from terrains as Datasets."""

import numpy as np
import xarray as xr
from landlab import RasterModelGrid

from ..core.errors import InputError
from ..scene.terrain import lattice_of

ELEVATION, CLOSED = "topographic__elevation", "closed"


def build_grid(terrain: xr.Dataset) -> RasterModelGrid:
    """Return a new grid with the variables of a terrain over ``y`` and ``x`` as fields at nodes.

    Nodes without an elevation, and those of the variable ``closed``, are closed.

    Parameters
    ----------
    terrain : xarray.Dataset
        With ``topographic__elevation`` [m]; other variables are named as the fields. Nothing of it is changed.

    Returns
    -------
    RasterModelGrid

    Raises
    ------
    InputError
        If there is no elevation over ``y`` and ``x``, or these are not equally spaced.
    """
    if ELEVATION not in terrain or set(terrain[ELEVATION].dims) != {"y", "x"}:
        raise InputError(f"terrain must have {ELEVATION} over y and x, got {dict(terrain.sizes)}")
    for axis in "yx":
        steps = np.diff(terrain[axis].values)
        if steps.size < 2 or (not np.all(steps > 0.0) and not np.all(steps < 0.0)):
            raise InputError(f"terrain: {axis} must be at least 3 coordinates in order, got {steps.size + 1}")
        if np.ptp(steps) > 1e-3 * abs(steps[0]):
            raise InputError(f"terrain: {axis} must be equally spaced, got steps from {steps.min()} to {steps.max()} m")
    terrain = terrain.sortby(["y", "x"]).transpose("y", "x", ...)
    lattice = lattice_of(terrain)
    grid = RasterModelGrid(lattice.shape, xy_spacing=lattice.spacing, xy_of_lower_left=lattice.lower_left)
    missing = ~np.isfinite(terrain[ELEVATION].values)
    if CLOSED in terrain:
        missing |= terrain[CLOSED].values.astype(bool)
    for name, values in terrain.data_vars.items():
        if name != CLOSED and values.dims == ("y", "x") and values.dtype.kind in "biuf":
            kind = float if values.dtype.kind == "f" else values.dtype
            grid.add_field(str(name), np.nan_to_num(values.values.reshape(-1).astype(kind)), at="node")
    grid.status_at_node[missing.reshape(-1)] = grid.BC_NODE_IS_CLOSED
    return grid
