"""Comparison of runs: quantities as rows and runs as columns, with one colour scale in a row."""

import textwrap
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.image import AxesImage

from ..core.errors import InputError
from .colours import extend_of, over_relief
from .extent import panel_size, within
from .ground import on_increasing_axes
from .map_frame import draw_coordinates, draw_scale_bar, unit_of_coordinates
from .map_panel import axes_beside, draw_values
from .maps import checked_limits, chosen_extent
from .overlays import draw_outline
from .style import LABEL, TICK, TITLE, new_figure

WIDTH = 13.0
"""Largest width of all panels beside each other [inch]."""

LARGEST_PANEL = (6.0, 6.0)
"""Width and height of a panel at most [inch]."""


class Layer(NamedTuple):
    """One quantity, drawn for several runs with one colour scale.

    Parameters
    ----------
    panels : mapping of str to xarray.DataArray
        Title of each panel and its values over ``y`` and ``x``, all in the unit that the label names.
    label : str
        Text beside the colour bar, with the unit.
    colours : str
        Name of a matplotlib colour map; its pale end is faint, so that the relief shows through thin films.
    limits : tuple of float, optional
        Ends of the colour scale, in the unit of the values; by default 0 and the largest value shown. If they are
        equal and opposite, 0 is transparent.
    threshold : float
        Values of smaller magnitude are left transparent, in the unit of the values.
    """

    panels: Mapping[str, xr.DataArray]
    label: str
    colours: str = "YlGnBu"
    limits: tuple[float, float] | None = None
    threshold: float = 0.01


def draw_maps(
    layers: Sequence[Layer],
    relief: xr.DataArray,
    *,
    outline: xr.DataArray | None = None,
    contours: Sequence[float] = (),
    margin: float | None = None,
    extent: Sequence[float] | None = None,
    note: str = "",
) -> Figure:
    """Draw layers as rows and runs as columns, over one hillshade, in map coordinates.

    Parameters
    ----------
    layers : sequence of Layer
        One row of panels each.
    relief : xarray.DataArray
        Elevation over ``y`` and ``x`` [m] for the hillshade; where it is missing, the page stays white.
    outline : xarray.DataArray of bool, optional
        Region to be outlined, such as the source.
    contours : sequence of float
        Elevations to be drawn as dashed lines [m].
    margin : float, optional
        Width of ground shown around the drawn values [m].
    extent : sequence of float, optional
        West, east, south, north of the part shown [m]; by default all nodes that a layer shows, with a margin.
    note : str
        Text below the panels; by default what the dashed lines and the outline are.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    InputError
        If there is no layer, or a map is over other nodes than the relief.
    """
    if not layers or not all(layer.panels for layer in layers):
        raise InputError("draw_maps: layers must be at least one Layer with at least one panel each")
    relief = on_increasing_axes(relief)
    region = None if outline is None else on_increasing_axes(outline)
    rows = [{title: _shown(layer, values, relief) for title, values in layer.panels.items()} for layer in layers]
    drawn = np.logical_or.reduce([np.isfinite(values.values) for row in rows for values in row.values()])
    place = chosen_extent(drawn, relief, region, extent, margin)
    count = max(len(row) for row in rows)
    width, height = panel_size(place, (min(LARGEST_PANEL[0], WIDTH / count), LARGEST_PANEL[1]))
    below = note or _legend(contours, outline)
    titles = sum(0.22 * max(title.strip().count("\n") + bool(title.strip()) for title in row) for row in rows)
    figure = new_figure(count * (max(width, 2.0) + 0.25) + 1.8, len(rows) * (height + 0.25) + titles + 0.7)
    grid = figure.subplots(len(rows), count, sharex=True, sharey=True, squeeze=False)
    for number, (layer, row) in enumerate(zip(layers, rows, strict=True)):
        norm, diverging = _norm(layer, row)
        colours = over_relief(layer.colours, diverging=diverging)
        for axes in grid[number, len(row) :]:
            axes.set_visible(False)
        for axes, (title, values) in zip(grid[number], row.items(), strict=False):
            image = draw_values(axes, values, relief, place, norm, colours, contours=False)
            _draw_lines(axes, relief, region, contours)
            draw_coordinates(axes, place, labels=False)
            axes.set_title(title, fontsize=TITLE)
            axes.label_outer()
        extend = extend_of(norm, [values.values for values in row.values()])
        _draw_bar(axes, image, layer.label, extend, height)
    part = within(relief.copy(data=drawn), place)
    draw_scale_bar(grid[0, 0], place, part.values)
    unit = unit_of_coordinates(place)[0]
    figure.supxlabel(f"x [{unit}]{f'      ({below})' if below else ''}", fontsize=LABEL)
    figure.supylabel(f"y [{unit}]", fontsize=LABEL)
    return figure


def _shown(layer: Layer, values: xr.DataArray, relief: xr.DataArray) -> xr.DataArray:
    """Return values over the nodes of the relief, NaN where they are below the threshold."""
    values = on_increasing_axes(values)
    if values.shape != relief.shape:
        raise InputError(
            f"draw_maps: {layer.label!r} has values of shape {values.shape}, the relief has {relief.shape}; give both "
            "over the same nodes"
        )
    return values.where(abs(values) >= layer.threshold)


def _norm(layer: Layer, row: Mapping[str, xr.DataArray]) -> tuple[Normalize, bool]:
    """Return the scale of a layer, and whether 0 is in its middle."""
    if layer.limits is not None:
        low, high = checked_limits(layer.limits, False)
        return Normalize(low, high), bool(np.isclose(-low, high))
    largest = [float(values.max()) for values in row.values() if bool(values.notnull().any())]
    return Normalize(0.0, max([layer.threshold, *largest]) or 1.0), False


def _draw_lines(axes: Axes, relief: xr.DataArray, region: xr.DataArray | None, contours: Sequence[float]) -> None:
    low, high = float(relief.min()), float(relief.max())
    if levels := [level for level in sorted(contours) if low < level < high]:
        axes.contour(
            relief.x, relief.y, relief, levels=levels, colors="black", linewidths=0.9, linestyles="dashed", zorder=5
        )
    if region is not None:
        draw_outline(axes, region)


def _legend(contours: Sequence[float], outline: xr.DataArray | None) -> str:
    lines = [f"dashed: {' and '.join(f'{level:g}' for level in sorted(contours))} m contour"] if len(contours) else []
    return "; ".join(lines + ([] if outline is None else ["outlined: source"]))


def _draw_bar(axes: Axes, image: AxesImage, label: str, extend: str, height: float) -> None:
    """Draw the colour bar beside the last panel of a row, its label in as many lines as the height [inch] needs."""
    beside = axes_beside(axes)
    bar = axes.figure.colorbar(image, cax=beside, extend=extend, extendfrac=0.04)
    bar.outline.set_linewidth(0.6)
    beside.tick_params(labelsize=TICK, width=0.6, length=2.5)
    letters = max(int(height * 72.0 / (0.55 * LABEL)), 10)
    bar.set_label("\n".join(textwrap.wrap(label, letters)), fontsize=LABEL)
