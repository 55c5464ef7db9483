"""Maps of the end of a run as files: NetCDF with all parameters, GeoTIFF with styles, a table of exposed polygons."""

from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ..geo.exposure import exposure, write_exposure
from ..geo.geotiff import write_geotiffs
from ..record.attributes import variable_attributes
from ..record.written_maps import ELEVATION_BEFORE, RELEASED_DEPTH, write_maps
from ..scene.output_keys import ALWAYS
from .files import MAPS

EXPOSURE = "exposure"


def write_results(folder: Path, maps: xr.Dataset, scene: Any) -> None:
    """Write the maps of the end into a directory, and the exposure of polygons, if there are any.

    Parameters
    ----------
    folder : Path
    maps : xarray.Dataset
        As `DebrisFlow.maps` returns them.
    scene : Scene
    """
    terrain, keys, crs = scene.terrain.attrs, scene.output_keys, scene.lattice.crs
    origin = {name: terrain[name] for name in ("dem", "dem_sha256") if terrain.get(name)}
    origin["scene_digest"] = scene.digest()
    whole = maps.assign(_before(scene))
    write_maps(folder / MAPS, whole, crs=crs, least_depth=keys.least_depth, attributes=origin)
    names = tuple(dict.fromkeys((*ALWAYS, *keys.maps)))
    write_geotiffs(folder, maps, names, crs=crs, least_depth=keys.least_depth, tags=origin)
    if scene.places.exposure:
        table = exposure(maps, exposed_frame(scene), identifier="id", crs=crs, least_depth=keys.least_depth)
        for suffix in (".gpkg", ".csv"):
            write_exposure(folder / f"{EXPOSURE}{suffix}", table)


def _before(scene: Any) -> dict[str, Any]:
    """Return the ground before the event, and the depth that was released, over ``y`` and ``x`` [m]."""
    elevation = scene.terrain.topographic__elevation.values
    released = sum((release.depth for release in scene.releases), np.zeros(elevation.shape))
    values = {
        ELEVATION_BEFORE: (elevation, "Land surface topographic elevation before the event"),
        RELEASED_DEPTH: (released, "Depth that was released, out of the ground or from above"),
    }
    return {name: (("y", "x"), data, variable_attributes("m", words)) for name, (data, words) in values.items()}


def exposed_frame(scene: Any) -> Any:
    """Return the polygons of a scene that may be exposed as a GeoDataFrame, named by its column ``id``."""
    import geopandas

    shapes = scene.places.exposure
    rows = [
        {name: value for name, value in shape.attributes.items() if name.lower() not in ("id", "geometry")}
        for shape in shapes.values()
    ]
    frame = geopandas.GeoDataFrame(rows, geometry=[one.geometry for one in shapes.values()], crs=scene.lattice.crs)
    frame.insert(0, "id", list(shapes))
    return frame
