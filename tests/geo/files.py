"""Rasters and shapes as users have them, written by rasterio and geopandas."""

import numpy as np
import rasterio
from rasterio.transform import Affine

WEST, NORTH = 400_000.0, 5_150_000.0
UTM = "EPSG:32633"


def placed(west, north, dx, dy):
    """Return the transform of a raster whose north-western corner lies there."""
    return Affine(dx, 0.0, west, 0.0, -dy, north)


def elevations(rows=12, columns=16):
    """Return a slope with a bowl, from north to south."""
    y, x = np.mgrid[:rows, :columns]
    return 1000.0 + 4.0 * (columns - x) + 0.5 * (rows - y) + 0.25 * (y - 5.0) ** 2


def write_tiff(path, values, *, crs=UTM, spacing=(5.0, 5.0), transform=None, nodata=None, bands=1, **options):
    """Write values, whose first row is the northern one."""
    transform = placed(WEST, NORTH, *spacing) if transform is None else transform
    rows, columns = values.shape
    profile = {
        "driver": "GTiff", "height": rows, "width": columns, "count": bands, "dtype": values.dtype, "crs": crs,
        "transform": transform, "nodata": nodata,
    }  # fmt: skip
    with rasterio.open(path, "w", **(profile | options)) as target:
        for band in range(1, bands + 1):
            target.write(values, band)
    return path


def ascii_text(values, head=None, spacing=5.0, missing=-9999):
    """Return an ESRI ASCII grid of values, whose first row is the northern one."""
    rows, columns = values.shape
    head = head or (
        f"ncols {columns}\nnrows {rows}\nxllcorner {WEST}\nyllcorner {NORTH - rows * spacing}\ncellsize {spacing}\n"
        f"NODATA_value {missing}\n"
    )
    return head + "\n".join(" ".join(f"{value:.10g}" for value in row) for row in values) + "\n"
