"""Overview of a run: several maps of one extent side by side."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from ..record.written_maps import LEAST_DEPTH
from .extent import Extent, panel_size, within
from .ground import release_outline
from .map_frame import draw_coordinates, draw_scale_bar, draw_title, reference_name, unit_of_coordinates
from .maps import chosen_extent, draw_shown, relief_of
from .quantities import OVERVIEW, map_names, reached_nodes, shown_map
from .style import LABEL, TITLE, new_figure, number_text, plain_text

WIDTH = 12.5
"""Width of an overview [inch]."""

FLAT, TALL = 1.9, 0.7
"""Width over height of a panel above which two stand side by side, and below which all are in one row [-]."""


def draw_overview(
    maps: xr.Dataset,
    names: Sequence[str] | None = None,
    *,
    before: xr.Dataset | xr.DataArray | None = None,
    title: str | None = None,
    least_depth: float = LEAST_DEPTH,
    extent: Sequence[float] | None = None,
    margin: float | None = None,
    contours: bool = True,
    shapes: Any = None,
) -> Figure:
    """Draw several maps of a run side by side, of one extent.

    Parameters
    ----------
    maps : xarray.Dataset
        As `DebrisFlow.maps` returns them, or read from the ``maps.nc`` of a run.
    names : sequence of str, optional
        Names of the maps, as of `draw_map`; by default peak depth and speed, arrival, change of elevation, peak basal
        pressure ratio and Péclet number, as far as they are there.
    before : xarray.Dataset or xarray.DataArray, optional
        Maps or elevation before the event [m], as of `draw_map`.
    title : str, optional
        Title of the figure; by default volumes [m3] and elapsed time [s], if the maps have them.
    least_depth, extent, margin, contours, shapes
        As in `draw_map`.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    InputError
        As in `draw_map`.
    """
    if names is None:
        names = [name for name in OVERVIEW if name in map_names(maps)] or map_names(maps)[:1] or OVERVIEW[:1]
    shown = [shown_map(maps, name, before=before, least_depth=least_depth) for name in names]
    region, raster = release_outline(maps, before), shown[0].values
    reached = reached_nodes(maps, least_depth)
    drawn = np.logical_or.reduce([np.isfinite(one.values.values) for one in shown]) if reached is None else reached
    place = chosen_extent(drawn, raster, region, extent, margin)
    rows, columns = _arranged(len(shown), place)
    width, height = panel_size(place, (WIDTH / columns - 1.0, 6.0))
    figure = new_figure(columns * (max(width, 2.0) + 1.0) + 0.4, rows * (height + 0.55) + 0.9)
    panels = figure.subplots(rows, columns, squeeze=False)
    relief = relief_of(maps)
    for number, (axes, one) in enumerate(zip(panels.flat, shown, strict=False)):
        draw_shown(axes, one, relief, place, region, contours=contours, shapes=shapes)
        draw_coordinates(axes, place, labels=False)
        draw_title(axes, plain_text(one.quantity.words), place)
        axes.tick_params(labelleft=number % columns == 0, labelbottom=number + columns >= len(shown))
    for axes in panels.flat[len(shown) :]:
        axes.set_visible(False)
    draw_scale_bar(panels[0, 0], place, within(raster.copy(data=drawn), place).values)
    unit, reference = unit_of_coordinates(place)[0], plain_text(reference_name(maps))
    figure.supxlabel(f"x [{unit}]{f', {reference}' if reference else ''}", fontsize=LABEL)
    figure.supylabel(f"y [{unit}]", fontsize=LABEL)
    if words := (summary_of(maps) if title is None else title):
        figure.suptitle(plain_text(words), fontsize=TITLE + 1.0)
    return figure


def summary_of(maps: xr.Dataset) -> str:
    """Return volumes and elapsed time of maps in a line, "" if they do not have them.

    Examples
    --------
    >>> summary_of(xr.Dataset(attrs={"budget_released": 900.0, "budget_eroded": 1120.4, "elapsed_time": 143.9}))
    '900 m³ released, 1\u2009120 m³ eroded; after 144 s'
    """
    volumes = {
        name: float(maps.attrs.get(f"budget_{name}", 0.0))
        for name in ("released", "inflow", "eroded", "moving", "deposited", "outflow")
    }
    words = {"released": "released", "inflow": "flowed in", "eroded": "eroded", "moving": "still moving",
             "deposited": "deposited", "outflow": "left the grid"}  # fmt: skip
    told = [f"{number_text(round(volumes[name]))} m³ {words[name]}" for name in words if volumes[name] >= 0.5]
    time = maps.attrs.get("elapsed_time")
    return ", ".join(told) + (f"; after {float(time):.0f} s" if told and time is not None else "")


def _arranged(count: int, place: Extent) -> tuple[int, int]:
    """Return the numbers of rows and columns of panels."""
    aspect = place.width / place.height
    columns = min(count, 2 if aspect > FLAT else 3 if aspect > TALL else 6)
    return -(-count // columns), columns
