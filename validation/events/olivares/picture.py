"""Figure of the six flows: modelled peak depth and mapped outline."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from landlab_debrisflow.plots import draw_map
from landlab_debrisflow.plots.overlays import draw_outline

from .measures import WET, compare
from .setup import FLOWS, read_observed

STEPS = {"max_depth": 0.01}
DEEPEST = 6.0
"""End of the colour scale [m]."""
MARGIN = 200.0
"""Ground shown around outline and flow [m]."""


def shown(result: xr.Dataset) -> xr.Dataset:
    """Return the modelled depths alone: terrain and outlines belong to data of another licence (GPL)."""
    return result[["max_depth"]]


def draw(result: xr.Dataset) -> Figure:
    """Return the figure from the stored depths, and terrain and outlines from the data; InputError without the data."""
    observed = read_observed()
    figure = Figure(figsize=(11.0, 8.4), layout="constrained")
    for axes, flow in zip(figure.subplots(3, 2).T.ravel(), FLOWS, strict=True):
        depth = result.max_depth.sel(flow=flow, drop=True)
        maps = xr.Dataset(
            {
                "topographic__elevation": depth.copy(data=observed.elevation),
                "debris_flow__max_depth": depth.assign_attrs(units="m"),
            }
        )
        mapped = depth.copy(data=observed.flow == flow)
        found = compare(depth.values > WET, observed, flow)
        title = f"flow {flow}: IoU {found['iou']:.2f}, farthest wet cell {found['toe']:.0f} m from the toe"
        draw_map(
            maps, "max_depth", axes=axes, title=title, limits=(0.0, DEEPEST), least_depth=WET,
            extent=_extent(depth, mapped), outline=depth.copy(data=observed.source == flow),
        )  # fmt: skip
        draw_outline(axes, mapped, color="#d62728")
    figure.suptitle(
        "Rio Olivares: mapped outline (red), source (black) and modelled peak depth (colours), "
        f"set {result.attrs['set']}"
    )
    return figure


def _extent(depth: xr.DataArray, mapped: xr.DataArray) -> tuple[float, float, float, float]:
    """Return west, east, south and north of the ground around flow and outline [m]."""
    rows, columns = np.nonzero((depth.values > WET) | mapped.values)
    x, y = depth.x.values, depth.y.values
    return (
        max(x[0], x[columns.min()] - MARGIN), min(x[-1], x[columns.max()] + MARGIN),
        max(y[0], y[rows.min()] - MARGIN), min(y[-1], y[rows.max()] + MARGIN),
    )  # fmt: skip
