"""Cost of the ground of a scene: a DEM of 20 000 x 20 000 nodes, and thousands of polygons on a large lattice.

    python -m benchmarks.terrain

The DEM (0.8 GB) is written to a temporary directory first. Each row is measured in a process of its own: wall time and
how much its memory grows.
"""

import multiprocessing
import resource
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

SIDE, SPACING, WEST, NORTH = 20_000, 5.0, 400_000.0, 5_200_000.0
LARGE = 4000
POLYGONS = 5000


def write_dem(path):
    """Write valleys between ridges that fall to the east, in decimetres, tiled and not compressed."""
    import rasterio
    from rasterio.transform import Affine
    from rasterio.windows import Window

    profile = {
        "driver": "GTiff", "height": SIDE, "width": SIDE, "count": 1, "dtype": "int16", "crs": "EPSG:32633",
        "tiled": True, "transform": Affine(SPACING, 0.0, WEST, 0.0, -SPACING, NORTH), "nodata": -32768,
    }  # fmt: skip
    with rasterio.open(path, "w", **profile) as target:
        target.scales = (0.1,)
        x = SPACING * np.arange(SIDE)
        for row in range(0, SIDE, 256):
            y = SPACING * np.arange(row, min(row + 256, SIDE))[:, None]
            z = 1500.0 - 0.01 * x + 400.0 * np.cos(y / 1000.0) + 100.0 * np.sin(x / 700.0)
            target.write((10.0 * z).astype(np.int16), 1, window=Window(0, row, SIDE, y.size))
    return path


def build(folder, **terrain):
    """Build the ground of a scene; return a sentence on it."""
    from landlab_debrisflow import Scene

    x, y = WEST + 0.5 * SIDE * SPACING, NORTH - 0.4 * SIDE * SPACING
    polygon = [[x, y], [x + 50.0, y], [x + 50.0, y + 50.0], [x, y + 50.0]]
    scene = Scene.from_mapping(
        {"terrain": {"elevation": "dem.tif"} | terrain, "release": {"polygons": polygon, "depth": 2.0}}, folder
    )
    rows, columns = scene.terrain["topographic__elevation"].shape
    return f"{rows} x {columns} nodes"


def cover(side=LARGE, count=POLYGONS):
    """Cover many polygons and a very large one; return a sentence on it."""
    import shapely

    from landlab_debrisflow.geo.cover import cover_cells
    from landlab_debrisflow.geo.lattice import Lattice

    lattice = Lattice((side, side), (SPACING, SPACING), (WEST, NORTH))
    generator = np.random.default_rng(1)
    places = generator.uniform(0.05, 0.95, (count, 2)) * side * SPACING + (WEST, NORTH)
    shapes = [
        shapely.Point(*place).buffer(radius)
        for place, radius in zip(places, generator.uniform(5, 60, count), strict=True)
    ]
    shapes.append(shapely.Point(WEST + 0.5 * side * SPACING, NORTH + 0.5 * side * SPACING).buffer(0.4 * side * SPACING))
    area = sum(cover_cells(shape, lattice).fraction.sum() * lattice.area for shape in shapes)
    exact = sum(shape.area for shape in shapes)
    return f"{len(shapes)} polygons, area off by {abs(area / exact - 1.0):.0e}"


def _measured(function, arguments, options):
    import landlab_debrisflow.run.scene  # noqa: F401  so that imports do not count

    before, began = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, time.perf_counter()
    words = function(*arguments, **options)
    elapsed = time.perf_counter() - began
    return words, elapsed, (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024.0


def measure(function, *arguments, **options):
    """Return sentence, wall time [s] and growth of memory [MB] of a call in a process of its own."""
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        return pool.submit(_measured, function, arguments, options).result()


def main():
    """Print the table."""
    print(f"{'':42}{'result':>48}{'wall time':>12}{'memory':>10}")
    with tempfile.TemporaryDirectory() as folder:
        began = time.perf_counter()
        write_dem(Path(folder) / "dem.tif")
        print(f"{f'DEM of {SIDE} x {SIDE} nodes written':90}{time.perf_counter() - began:10.1f} s")
        for title, terrain in {
            "window: reach (default)": {},
            "window: reach, travel_angle: 11": {"travel_angle": 11.0},
            "window of 5 x 5 km": {"window": [WEST + 48e3, NORTH - 43e3, WEST + 53e3, NORTH - 38e3]},
            "spacing: 10, window: reach": {"spacing": 10.0, "travel_angle": 11.0},
        }.items():
            words, elapsed, memory = measure(build, Path(folder), **terrain)
            print(f"{title:42}{words:>48}{elapsed:10.1f} s{memory:7.0f} MB")
    words, elapsed, memory = measure(cover)
    print(f"{f'cells covered, of {LARGE} x {LARGE}':42}{words:>48}{elapsed:10.1f} s{memory:7.0f} MB")


if __name__ == "__main__":
    main()
