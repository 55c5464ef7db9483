"""Write the files of the example scenes: a DEM, a release, buildings, a hydrograph, all invented.

    python examples/scene_files.py examples/scenes

They look as files of a user do: elevations in centimetres of precision with a corner without data, polygons in degrees.
"""

import sys
from pathlib import Path

import geopandas
import numpy as np
import rasterio
import shapely

from landlab_debrisflow import Scene

CRS = "EPSG:32632"
RELEASE = [(22, 147), (34, 168), (52, 170), (56, 152), (42, 143)]
"""Outline, metres east and north of the first node of the DEM."""
BUILDINGS = {"mill": (520, 128, 20, 20), "farm": (580, 165, 22, 18), "barn": (640, 95, 20, 25)}
"""South-western corner, width and height [m]."""
SURGE = "time [s],discharge [m3/s]\n0,0\n20,25\n60,10\n180,0\n"


def main(folder="examples/scenes") -> None:
    """Write gully.tif, release.geojson, buildings.geojson and surge.csv into an existing folder."""
    folder = Path(folder)
    terrain = Scene.from_mapping({"terrain": {"example": "gully"}}).terrain
    x, y, z = terrain.x.values, terrain.y.values, terrain.topographic__elevation.values
    z = np.round(z + 0.15 * np.sin(x / 7.0) * np.sin(y[:, None] / 9.0), 2).astype(np.float32)
    z[(x - x[0] + (y[-1] - y[:, None])) < 40.0] = -9999.0  # the survey ends in the north-west
    place = rasterio.transform.from_origin(x[0] - 2.5, y[-1] + 2.5, 5.0, 5.0)
    profile = {"driver": "GTiff", "height": y.size, "width": x.size, "count": 1, "dtype": "float32", "nodata": -9999.0}
    profile |= {"compress": "deflate", "predictor": 3}
    with rasterio.open(folder / "gully.tif", "w", crs=CRS, transform=place, **profile) as file:
        file.write(z[::-1], 1)
    outline = shapely.Polygon([(x[0] + east, y[0] + north) for east, north in RELEASE])
    write_shapes(folder / "release.geojson", [outline], {"name": ["scarp above the gully"], "volume": [900.0]})
    boxes = [shapely.box(x[0] + e, y[0] + n, x[0] + e + w, y[0] + n + h) for e, n, w, h in BUILDINGS.values()]
    write_shapes(folder / "buildings.geojson", boxes, {"id": list(BUILDINGS), "height": [7.0, 9.0, 6.0]})
    (folder / "surge.csv").write_text(SURGE, encoding="utf-8")


def write_shapes(path, shapes, attributes) -> None:
    """Write polygons with attributes as GeoJSON, in longitude and latitude."""
    path.unlink(missing_ok=True)
    geopandas.GeoDataFrame(attributes, geometry=shapes, crs=CRS).to_crs("EPSG:4326").to_file(path, driver="GeoJSON")


if __name__ == "__main__":
    main(*sys.argv[1:])
