"""Ground of a scene, from its keys and files to arrays over nodes."""

from pathlib import Path

import numpy as np
import xarray as xr

from ..geo.lattice import Lattice
from ..geo.rasters import read_raster
from .gully import gully
from .keys import TerrainKeys


def build_terrain(keys: TerrainKeys, folder: Path) -> xr.Dataset:
    """Return elevation and soil depth over ``y`` and ``x`` [m], NaN where there are no data.

    Parameters
    ----------
    keys : TerrainKeys
    folder : Path
        Directory to which names of files are relative.

    Returns
    -------
    xarray.Dataset
        With ``topographic__elevation`` and, if there is erodible soil, ``soil__depth``, named as fields of the grid;
        the attribute ``crs_wkt`` is the coordinate reference system, "" if it is not known.
    """
    if keys.example is not None:
        return _example(keys)
    dem = read_raster(folder / str(keys.elevation), keys.crs)
    fields = {"topographic__elevation": dem.values}
    if isinstance(keys.soil_depth, str):
        fields["soil__depth"] = read_raster(folder / keys.soil_depth, keys.crs).values
    elif keys.soil_depth is not None:
        fields["soil__depth"] = np.full(dem.values.shape, keys.soil_depth)
    lattice = dem.lattice
    return xr.Dataset(
        {name: (("y", "x"), values) for name, values in fields.items()},
        {"y": lattice.y, "x": lattice.x},
        {"crs_wkt": lattice.crs or "", "dem": dem.path.name, "dem_sha256": dem.checksum},
    )


def _example(keys: TerrainKeys) -> xr.Dataset:
    """Return the ground that is built in; a number for the soil depth [m] replaces its own soil."""
    elevation, soil, lattice = gully()
    soil = soil if keys.soil_depth is None else np.full(soil.shape, float(keys.soil_depth))
    return xr.Dataset(
        {"topographic__elevation": (("y", "x"), elevation), "soil__depth": (("y", "x"), soil)},
        {"y": lattice.y, "x": lattice.x},
        {"crs_wkt": lattice.crs or "", "dem": f"example: {keys.example}", "dem_sha256": ""},
    )


def lattice_of(terrain: xr.Dataset) -> Lattice:
    """Return the place of the nodes of a terrain on the map."""
    x, y = terrain.x.values, terrain.y.values
    spacing = (float(x[-1] - x[0]) / (x.size - 1), float(y[-1] - y[0]) / (y.size - 1))
    return Lattice((y.size, x.size), spacing, (float(x[0]), float(y[0])), terrain.attrs.get("crs_wkt") or None)
