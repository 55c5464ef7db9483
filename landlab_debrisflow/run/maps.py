"""Maps of the end of a run as files: NetCDF with all parameters, GeoTIFF with styles, a table of exposed polygons."""

from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ..geo.exposure import exposure, write_exposure
from ..geo.geotiff import write_geotiffs
from ..record.attributes import axis_attributes, file_attributes, variable_attributes
from ..record.datasets import FIELDS
from ..record.files import write_dataset
from ..record.georeference import georeferenced
from ..record.measures import RELEASE
from ..record.written_maps import write_maps
from ..scene.output_keys import ALWAYS
from .files import BEFORE, MAPS

EXPOSURE = "exposure"


def write_before(folder: Path, scene: Any) -> None:
    """Write the ground before the event and the depth [m] of all releases into a directory.

    With them `measures` and sections of the maps have a beginning: the names of the variables are those of the maps.

    Parameters
    ----------
    folder : Path
    scene : Scene
    """
    released = sum((one.depth for one in scene.releases), np.zeros(scene.lattice.shape))
    ground = scene.terrain.drop_vars("closed", errors="ignore").assign({RELEASE: (("y", "x"), released)})
    known = {name: data.assign_attrs(_words(name)) for name, data in ground.items() if name in FIELDS}
    before = xr.Dataset(known, {axis: (axis, ground[axis].values, axis_attributes(axis)) for axis in ("y", "x")})
    before.attrs = file_attributes() | {"scene_digest": scene.digest()}
    write_dataset(folder / BEFORE, georeferenced(before, scene.lattice.crs))


def _words(name: str) -> dict[str, str]:
    return variable_attributes(FIELDS[name].unit, FIELDS[name].doc)


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
    write_maps(folder / MAPS, maps, crs=crs, least_depth=keys.least_depth, attributes=origin)
    names = tuple(dict.fromkeys((*ALWAYS, *keys.maps)))
    write_geotiffs(folder, maps, names, crs=crs, least_depth=keys.least_depth, tags=origin)
    if scene.places.exposure:
        table = exposure(maps, _frame(scene), identifier="id", crs=crs, least_depth=keys.least_depth)
        for suffix in (".gpkg", ".csv"):
            write_exposure(folder / f"{EXPOSURE}{suffix}", table)


def _frame(scene: Any):
    """Return the polygons of a scene that may be exposed as a GeoDataFrame."""
    import geopandas

    shapes = scene.places.exposure
    rows = [
        {name: value for name, value in shape.attributes.items() if name.lower() not in ("id", "geometry")}
        for shape in shapes.values()
    ]
    frame = geopandas.GeoDataFrame(rows, geometry=[one.geometry for one in shapes.values()], crs=scene.lattice.crs)
    frame.insert(0, "id", list(shapes))
    return frame
