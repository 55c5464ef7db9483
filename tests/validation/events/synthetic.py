"""A landslide on a made-up slope in files like those of the two of Washington, and a set for it."""

import numpy as np

SET = """
title: made up
known_when_chosen: nothing
friction:
  law: voellmy
  basal_friction_angle: {value: 20.0, unit: deg, range: [15.0, 25.0], choice: centre, source: a book}
  turbulent_coefficient: {value: 500.0, unit: m s-2, choice: published simulation, source: a paper}
column:
  law: ale
  levels: {value: 11, unit: "-", choice: numerics, source: enough}
site:
  soil_depth: {value: 0.5, unit: m, choice: measured, source: a pit}
"""


def write_raster(path, values):
    """Write a raster of shape (rows, columns), northernmost row last, as an ESRI ASCII file."""
    rows, columns = values.shape
    head = f"ncols {columns}\nnrows {rows}\nxllcenter 581000\nyllcenter 5300000\ncellsize 10\nNODATA_value -9999\n"
    lines = (" ".join(f"{value:.3f}" for value in row) for row in values[::-1])
    path.write_text(head + "\n".join(lines) + "\n", encoding="utf-8")


def write_landslide(folder):
    """Write elevation, lowering of the release and observed change; return the observed change."""
    folder.mkdir(parents=True)
    y, x = np.meshgrid(10.0 * np.arange(30), 10.0 * np.arange(12), indexing="ij")
    elevation = 0.5 * np.maximum(y - 80.0, 0.0) + 0.002 * (x - 55.0) ** 2
    elevation[:, -1] = -9999.0
    source = (abs(x - 55.0) < 16.0) & (abs(y - 240.0) < 16.0)
    observed = np.where(source, -2.0, np.where((abs(x - 55.0) < 16.0) & (abs(y - 90.0) < 21.0), 1.0, -9999.0))
    write_raster(folder / "pre_runout_DEM.asc", elevation)
    write_raster(folder / "landslide_depth.asc", np.where(source, -2.0, -9999.0))
    write_raster(folder / "DEM_of_Difference.asc", observed)
    return np.where(observed == -9999.0, 0.0, observed)
