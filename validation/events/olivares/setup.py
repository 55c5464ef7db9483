"""Terrain, releases and runs of six debris flows at the Rio Olivares, Chile, with one set of parameters."""

from collections.abc import Mapping
from functools import cache
from typing import NamedTuple

import numpy as np
import xarray as xr
from landlab import RasterModelGrid
from landlab.io import esri_ascii

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.scene import failing_depth

from ..data import find_file
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


@cache
def read_observed() -> Observed:
    """Read the DEM [m], the mapped flows and their sources.

    Raises
    ------
    InputError
        If the data is absent.
    """
    rasters = []
    for name, kind in (("dem", float), ("runout_id", int), ("source_id", int)):
        with open(find_file("olivares", f"{name}.asc"), encoding="utf-8") as stream:
            grid = esri_ascii.load(stream, at="node", name=name)
        rasters.append(grid.at_node[name].reshape(grid.shape).astype(kind))
    rows = np.loadtxt(find_file("olivares", "source_points.csv"), delimiter=",", skiprows=1)
    points = {int(flow): (float(x), float(y)) for flow, x, y in rows}
    corner = float(grid.x_of_node[0]), float(grid.y_of_node[0])
    return Observed(*rasters, corner, float(grid.dx), points)


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


def run_flows(parameters: ParameterSet, particle_count: int, shift: tuple[float, float] = (0.0, 0.0)) -> xr.Dataset:
    """Run the six flows, each alone on the terrain before; return the peak depth of each.

    Parameters
    ----------
    parameters : ParameterSet
    particle_count : int
    shift : tuple of float
        As in `build_grid`.

    Returns
    -------
    xarray.Dataset
        ``max_depth`` over ``flow``, ``y`` and ``x`` [m], released and eroded volume [m3] and duration [s] of each flow.
    """
    observed = read_observed()
    models = [run_flow(observed, flow, parameters, particle_count, shift) for flow in FLOWS]
    depth = np.stack([np.nan_to_num(model.maps["debris_flow__max_depth"].values) for model in models])
    y, x = (at + observed.spacing * np.arange(n) for at, n in zip(observed.corner[::-1], depth.shape[1:], strict=True))
    by_flow = {
        "released": ([model.budget["released"] for model in models], "m3"),
        "eroded": ([model.budget["eroded"] for model in models], "m3"),
        "duration": ([model.elapsed_time for model in models], "s"),
    }
    return xr.Dataset(
        {"max_depth": (("flow", "y", "x"), depth, {"units": "m"})}
        | {name: ("flow", values, {"units": unit}) for name, (values, unit) in by_flow.items()},
        {"flow": list(FLOWS), "y": ("y", y, {"units": "m"}), "x": ("x", x, {"units": "m"})},
        {"particles": particle_count},
    )
