"""Terrain, releases and runs of six debris flows at the Rio Olivares, Chile, with one set of parameters."""

from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
from landlab import RasterModelGrid
from landlab.io import esri_ascii

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.scene import failing_depth

from ..sets import ParameterSet

FLOWS = (1, 2, 3, 4, 5, 6)
LONGEST = 3600.0
"""Time after which a flow that still moves is stopped [s]."""


class Observed(NamedTuple):
    """Rasters of the inventory, shape (rows, columns), rows from south to north, and their place."""

    elevation: np.ndarray
    """[m]"""
    flow: np.ndarray
    """Number of the mapped flow, 0 outside of all."""
    source: np.ndarray
    """Number of the flow whose source a cell is: mapped, and within 50 m of the source point; 0 elsewhere."""
    corner: tuple[float, float]
    """Map coordinates of the first node [m]."""
    spacing: float
    """[m]"""
    points: dict[int, tuple[float, float]]
    """Map coordinates of the source points by flow [m]."""


def read_observed(folder: Path) -> Observed:
    """Read the DEM [m], the mapped flows and their sources."""
    with open(folder / "dem.asc") as stream:
        grid = esri_ascii.load(stream, at="node", name="elevation")
    rasters = [grid.at_node["elevation"].astype(float)]
    for name in ("runout_id", "source_id"):
        with open(folder / f"{name}.asc") as stream:
            rasters.append(esri_ascii.load(stream, at="node", name=name).at_node[name].astype(int))
    rows = np.loadtxt(folder / "source_points.csv", delimiter=",", skiprows=1)
    points = {int(flow): (float(x), float(y)) for flow, x, y in rows}
    corner = float(grid.x_of_node[0]), float(grid.y_of_node[0])
    return Observed(*(each.reshape(grid.shape) for each in rasters), corner, float(grid.dx), points)


def release_volume(area: float, values: Mapping[str, float]) -> float:
    """Return the volume of a release from the area of its source [m3]: V = 10^a A^b, A in m2."""
    return 10.0 ** values["volume_logarithm"] * area ** values["volume_exponent"]


def build_grid(observed: Observed, flow: int, values: Mapping[str, float], shift=(0.0, 0.0)) -> RasterModelGrid:
    """Return the terrain with soil and the release of one flow.

    Parameters
    ----------
    observed : Observed
    flow : int
    values : mapping of str to float
        Section ``site`` of a set.
    shift : tuple of float
        Shift of the release towards east and north [cells], by linear interpolation: noise below the resolution.
    """
    grid = RasterModelGrid(observed.elevation.shape, observed.spacing, xy_of_lower_left=observed.corner)
    grid.add_field("topographic__elevation", observed.elevation.ravel().copy(), at="node", units="m")
    inside = observed.source == flow
    volume = release_volume(float(inside.sum()) * observed.spacing**2, values)
    outline = shifted(inside.astype(float), *shift)
    release = failing_depth(grid, outline, volume=volume)
    grid.add_field("debris_flow__release_depth", release, at="node", units="m")
    grid.add_field("soil__depth", np.maximum(values["soil_depth"], release), at="node", units="m")
    return grid


def shifted(values: np.ndarray, east: float, north: float) -> np.ndarray:
    """Return values at nodes shifted by fractions of a cell, shape (rows, columns), by linear interpolation."""
    for axis, step in ((1, east), (0, north)):
        values = (1.0 - abs(step)) * values + abs(step) * np.roll(values, int(np.sign(step)), axis)
    return values


def run_flow(observed: Observed, flow: int, values: ParameterSet, particles=2000, shift=(0.0, 0.0)) -> DebrisFlow:
    """Run one flow to rest with a set of parameters; return the component."""
    grid = build_grid(observed, flow, values.plain("site"), shift)
    model = DebrisFlow(grid, **values.keywords(), numerics={"particle_count": particles})
    model.run_until_rest(LONGEST)
    return model
