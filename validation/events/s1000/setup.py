"""Set-up of the two landslides on one slope, S-1000 and Cascade Mountains 2009: grid, release, observed change."""

from pathlib import Path

import numpy as np
import xarray as xr
from landlab import RasterModelGrid
from landlab.io import esri_ascii

from landlab_debrisflow import DebrisFlow

from ..data import find_file
from ..sets import ParameterSet

NODATA = -9999.0
LONGEST = 3600.0
"""Time after which a run ends although it still moves [s]."""


def run_landslide(folder: str, parameters: ParameterSet, particle_count: int, fan_rows: int = 0) -> xr.Dataset:
    """Run a landslide; return observed and modelled change of elevation, the source and the terrain before.

    Parameters
    ----------
    folder : str
        Folder of its rasters below the measured data: elevation before the event, lowering of the release, and
        difference of the elevations, of one shape.
    parameters : ParameterSet
        With ``site: soil_depth`` [m], the erodible depth outside the source, and, if a law needs it, ``site:
        bed_degree_of_saturation`` [-].
    particle_count : int
    fan_rows : int
        Number of the southernmost rows in which the deposit was carried off before the second survey; 0: none.

    Returns
    -------
    xarray.Dataset
        Over ``y`` and ``x``, relative to the lower left node [m]; the attributes hold volumes [m3] and durations [s].
    """
    grid = build_grid(folder, parameters.plain("site"))
    elevation = grid.at_node["topographic__elevation"]
    before = elevation.copy()
    given = parameters.keywords()
    numerics = given.pop("numerics", {}) | {"particle_count": particle_count}
    flow = DebrisFlow(grid, **given, numerics=numerics)
    at_rest = flow.run_until_rest(LONGEST)
    change = elevation - before
    if not at_rest:
        change = change + grid.at_node["debris_flow__depth"]
    known = before != NODATA
    observed, _ = _read(find_file(folder, "DEM_of_Difference.asc"))
    release = read_release(folder)
    x, y = grid.dx * np.arange(grid.shape[1]), grid.dy * np.arange(grid.shape[0])
    fan = np.repeat(np.arange(grid.shape[0]) < fan_rows, grid.shape[1])

    def over_map(values, unit):
        return ("y", "x"), np.asarray(values).reshape(grid.shape), {"units": unit}

    return xr.Dataset(
        {
            "elevation": over_map(np.where(known, before, np.nan), "m"),
            "observed_change": over_map(np.where(observed == NODATA, 0.0, observed), "m"),
            "modelled_change": over_map(np.where(known, change, 0.0), "m"),
            "released_depth": over_map(release, "m"),
            "mapped": over_map((observed != NODATA).astype("i1"), "1"),
            "source": over_map((release > 0.0).astype("i1"), "1"),
            "fan": over_map(fan.astype("i1"), "1"),
        },
        {"y": ("y", y, {"units": "m"}), "x": ("x", x, {"units": "m"})},
        {
            "eroded": flow.budget["eroded"], "outflow": flow.budget["outflow"], "duration": flow.elapsed_time,
            "at_rest": int(at_rest), "particles": particle_count,
        },
    )  # fmt: skip


def build_grid(folder: str, site: dict) -> RasterModelGrid:
    """Return the terrain with the release and the soil; NODATA closed."""
    before, corner = _read(find_file(folder, "pre_runout_DEM.asc"))
    release = read_release(folder)
    grid = RasterModelGrid(corner.shape, xy_spacing=corner.dx, xy_of_lower_left=corner.xy_of_lower_left)
    elevation = grid.add_field("topographic__elevation", before, at="node", units="m")
    grid.set_nodata_nodes_to_closed(elevation, NODATA)
    grid.add_field("debris_flow__release_depth", release, at="node", units="m")
    grid.add_field("soil__depth", np.maximum(site["soil_depth"], release), at="node", units="m")
    if "bed_degree_of_saturation" in site:
        grid.add_full("bed__degree_of_saturation", site["bed_degree_of_saturation"], at="node")
    return grid


def read_elevation(folder: str) -> np.ndarray:
    """Return the elevation before the event at nodes [m]."""
    return _read(find_file(folder, "pre_runout_DEM.asc"))[0]


def read_release(folder: str) -> np.ndarray:
    """Return the depth of the release at nodes [m]; the file holds the lowering, which is negative."""
    lowering, _ = _read(find_file(folder, "landslide_depth.asc"))
    return np.where(lowering == NODATA, 0.0, np.maximum(-lowering, 0.0))


def _read(path: Path) -> tuple[np.ndarray, RasterModelGrid]:
    with open(path, encoding="utf-8") as stream:
        grid = esri_ascii.load(stream, at="node", name="values")
    return grid.at_node["values"].astype(float), grid
