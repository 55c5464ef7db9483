"""Figure of a landslide: observed beside modelled change of elevation in classes, and where both changed."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from landlab_debrisflow.plots import Layer, draw_maps

from .measures import CHANGED
from .setup import NODATA, read_elevation

BOUNDS = np.array([-2.5, -1.0, -CHANGED, CHANGED, 1.0, 2.5])
"""Bounds between the classes of a change of elevation [m]."""
STEPS = {"elevation": 0.05, "modelled_change": 1e-3}
RELIEF = "s1000"
"""Folder of the terrain below the maps: that of S-1000, which has a licence (MIT)."""


def shown(result: xr.Dataset) -> xr.Dataset:
    """Return the variables of the figure; of the observation its classes only, because 2009 states no licence."""
    elevation = read_elevation(RELIEF).reshape(result.elevation.shape)
    kept = result[["modelled_change", "source"]]
    kept["elevation"] = result.elevation.copy(data=np.where(elevation == NODATA, np.nan, elevation))
    kept["observed_class"] = result.source.copy(data=classes(result.observed_change))
    return kept


def classes(change: xr.DataArray) -> np.ndarray:
    """Return classes of a change of elevation: -3 is lowered most, 0 not changed, 3 raised most."""
    return (np.digitize(change.values, BOUNDS) - 3).astype("i1")


def draw(result: xr.Dataset) -> Figure:
    """Return the figure of a landslide from its stored result."""
    observed, modelled = result.observed_class, result.modelled_change.copy(data=classes(result.modelled_change))
    panels = {
        "observed by lidar": observed.astype(float),
        f"modelled, set {result.attrs['set']}": modelled.astype(float),
    }
    change = Layer(panels, "change of elevation [m]", "RdBu", (-3.5, 3.5), threshold=0.5)
    figure = draw_maps([change], result.elevation, outline=result.source == 1, note="outlined: source")
    bar = figure.axes[-1].child_axes[-1]  # beside the last panel
    bar.set_yticks(np.arange(-2.5, 3.0), [f"{bound:+g}" for bound in BOUNDS])
    return figure
