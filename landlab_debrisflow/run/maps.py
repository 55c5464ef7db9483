"""Maps of the end of a run as files: NetCDF with all parameters, GeoTIFF with styles."""

from pathlib import Path

import xarray as xr

from ..geo.geotiff import write_geotiffs
from ..record.written_maps import write_maps
from .files import MAPS
from .scene import Scene

GEOTIFFS = ("max_depth", "max_speed", "arrival_time", "eroded_depth", "deposit_depth")
"""Maps that are written as GeoTIFF without being asked for."""


def write_results(folder: Path, maps: xr.Dataset, scene: Scene) -> None:
    """Write the maps of the end into a directory.

    Parameters
    ----------
    folder : Path
    maps : xarray.Dataset
        As `DebrisFlow.maps` returns them.
    scene : Scene
    """
    terrain, keys = scene.terrain.attrs, scene.output_keys
    crs = terrain.get("crs_wkt") or None
    origin = {name: terrain[name] for name in ("dem", "dem_sha256") if terrain.get(name)}
    write_maps(folder / MAPS, maps, crs=crs, least_depth=keys.least_depth, attributes=origin)
    names = tuple(dict.fromkeys((*GEOTIFFS, *keys.maps)))
    write_geotiffs(folder, maps, names, crs=crs, least_depth=keys.least_depth, tags=origin)
