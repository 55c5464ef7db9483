"""DEMs and shapes of small scenes, as files."""

import geopandas
import numpy as np

from tests.geo.files import UTM, placed, write_tiff

WEST, NORTH = 400_000.0, 5_150_000.0


def write_slope(path, rows=40, columns=60, spacing=5.0, gradient=0.4, **options):
    """Write a plane that falls to the east; elevation at the middle of a cell is that of the plane there."""
    x = spacing * (np.arange(columns) + 0.5)
    values = np.broadcast_to(1000.0 - gradient * x, (rows, columns)).astype(options.pop("dtype", np.float64))
    for row, column, value in options.pop("holes", ()):
        values = values.copy()
        values[row, column] = value
    return write_tiff(path, values, transform=placed(WEST, NORTH, spacing, spacing), **options)


def place(*pairs):
    """Return coordinates east and south of the north-western corner of the DEM."""
    return [[WEST + x, NORTH - y] for x, y in pairs]


def square(x, y, size):
    """Return the corners of a square, of which the north-western one lies there."""
    return place((x, y), (x + size, y), (x + size, y + size), (x, y + size))


def write_shapes(path, geometries, **columns):
    geopandas.GeoDataFrame(columns, geometry=list(geometries), crs=UTM).to_file(path, engine="pyogrio")
    return path
