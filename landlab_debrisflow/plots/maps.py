"""Maps of an event, drawn from `flow.maps` Datasets (or files of them) over a hillshade.

Figures are plain matplotlib objects: no pyplot, no global state, no display needed.
"""

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
import xarray as xr
from matplotlib.collections import LineCollection
from matplotlib.colors import LightSource
from matplotlib.figure import Figure

from ..record.files import write_atomically

KILOMETRES_FROM = 5000.0
"""Extent above which axes are labelled in km instead of m [m]."""

LIGHT = LightSource(azdeg=315, altdeg=45)


class Layer(NamedTuple):
    """One quantity, drawn for several runs with one colour scale.

    Parameters
    ----------
    panels : mapping of str to xarray.DataArray
        Title of each panel and its values over ``y`` and ``x``, all in the unit that the label names.
    label : str
        Text beside the colour bar, with the unit.
    colours : str
        Name of a matplotlib colour map.
    limits : tuple of float, optional
        Ends of the colour scale, in the unit of the values; by default 0 and the largest value shown.
    threshold : float
        Values of smaller magnitude are left transparent, in the unit of the values.
    """

    panels: Mapping[str, xr.DataArray]
    label: str
    colours: str = "viridis"
    limits: tuple[float, float] | None = None
    threshold: float = 0.01


def draw_maps(
    layers: Sequence[Layer],
    relief: xr.DataArray,
    *,
    outline: xr.DataArray | None = None,
    contours: Sequence[float] = (),
    margin: float = 50.0,
    extent: tuple[float, float, float, float] | None = None,
) -> Figure:
    """Draw layers as rows and runs as columns, over one hillshade.

    Parameters
    ----------
    layers : sequence of Layer
        One row of panels each.
    relief : xarray.DataArray
        Elevation over ``y`` and ``x`` [m] for the hillshade; NaN is left white.
    outline : xarray.DataArray of bool, optional
        A region to be outlined, such as the source.
    contours : sequence of float
        Elevations to be drawn as lines [m].
    margin : float
        Width of ground shown around the drawn values [m].
    extent : tuple of float, optional
        West, east, south, north of the part shown, in the coordinates of `relief` [m]; by default all
        nodes any layer shows, with `margin`.

    Returns
    -------
    matplotlib.figure.Figure
    """
    west, east, south, north = extent or _extent_of(layers, relief, outline, margin)
    origin = (float(relief.x[0]), float(relief.y[0]))
    unit, scale = ("km", 1e-3) if max(east - west, north - south) > KILOMETRES_FROM else ("m", 1.0)
    count = max(len(layer.panels) for layer in layers)
    figure = Figure(figsize=_figure_size((east - west) / (north - south), len(layers), count), layout="constrained")
    grid = figure.subplots(len(layers), count, sharex=True, sharey=True, squeeze=False)
    for row, layer in zip(grid, layers, strict=True):
        low, high = layer.limits or (0.0, max(layer.threshold, *(float(v.max()) for v in layer.panels.values())))
        for axes in row[len(layer.panels) :]:
            axes.set_visible(False)
        for axes, (title, values) in zip(row, layer.panels.items(), strict=False):
            place = {"extent": _edges(relief, origin, scale), "origin": "lower", "interpolation": "nearest"}
            axes.imshow(_hillshade(relief), cmap="gray", vmin=-0.7, vmax=1.25, **place)
            shown = values.where(abs(values) >= layer.threshold).values
            image = axes.imshow(shown, cmap=layer.colours, vmin=low, vmax=high, **place)
            _draw_lines(axes, relief, outline, contours, origin, scale)
            axes.set_title(title, fontsize="medium")
            axes.set_aspect("equal")
        beyond = max(float(abs(v).max()) for v in layer.panels.values()) > max(abs(low), abs(high)) * (1 + 1e-12)
        ends = ("both" if low < 0.0 else "max") if beyond else "neither"
        figure.colorbar(image, ax=list(row), label=layer.label, extend=ends, shrink=0.9, aspect=25, pad=0.01)
    first = grid[0, 0]
    first.set_xlim((west - origin[0]) * scale, (east - origin[0]) * scale)
    first.set_ylim((south - origin[1]) * scale, (north - origin[1]) * scale)
    _draw_scale_bar(first, unit)
    corner = "" if origin == (0.0, 0.0) else f"x, y from the lower left node at ({origin[0]:.0f}, {origin[1]:.0f}) m. "
    lines = "".join(f"{z:g} m contour dashed. " for z in contours)
    source = "" if outline is None else "Source outlined."
    figure.supxlabel(f"x [{unit}]", fontsize="medium")
    figure.supylabel(f"y [{unit}]", fontsize="medium")
    if note := (corner + lines + source).strip():
        figure.text(0.995, 0.005, note, ha="right", va="bottom", fontsize="small", color="0.35")
    return figure


def save_figure(figure: Figure, path: str | os.PathLike[str], dpi: int = 150) -> Path:
    """Write a figure, atomically; return where.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        As `draw_maps` returns it.
    path : str or os.PathLike
        The file; its suffix chooses the format, such as ``.png`` or ``.pdf``.
    dpi : int
        Dots per inch of rasters in the figure.

    Returns
    -------
    pathlib.Path
        Where the file is.

    Raises
    ------
    InputError
        If it cannot be written.
    """
    return write_atomically(path, lambda temporary: figure.savefig(temporary, dpi=dpi))


def _hillshade(relief):
    spacing = float(relief.x[1] - relief.x[0]), float(relief.y[1] - relief.y[0])
    # rows run northwards here, matplotlib's light expects them southwards
    return LIGHT.hillshade(relief.values[::-1], dx=spacing[0], dy=spacing[1])[::-1]


def _edges(relief, origin, scale):
    """Return the outer edges of the cells around the nodes: west, east, south, north.

    `relief` is over ``y`` and ``x`` [m]; coordinates [m] are counted from `origin` and multiplied by `scale`.
    """
    x, y = (relief.x.values - origin[0]) * scale, (relief.y.values - origin[1]) * scale
    half_x, half_y = 0.5 * (x[1] - x[0]), 0.5 * (y[1] - y[0])
    return x[0] - half_x, x[-1] + half_x, y[0] - half_y, y[-1] + half_y


def _extent_of(layers, relief, outline, margin):
    shown = np.zeros(relief.shape, bool) if outline is None else outline.values.astype(bool)
    for layer in layers:
        for values in layer.panels.values():
            shown = shown | (abs(values.values) >= layer.threshold)
    if not shown.any():
        shown[:] = True
    x, y = relief.x.values[shown.any(axis=0)], relief.y.values[shown.any(axis=1)]
    return (
        max(x[0] - margin, float(relief.x[0])), min(x[-1] + margin, float(relief.x[-1])),
        max(y[0] - margin, float(relief.y[0])), min(y[-1] + margin, float(relief.y[-1])),
    )  # fmt: skip


def _figure_size(aspect, rows, columns):
    """Return width and height [inch] for panels as wide as they can be on a page.

    `aspect` is width over height of a panel; `rows` and `columns` are numbers of panels.
    """
    width = min(7.0, 14.0 / columns)
    height = width / aspect
    if height > 7.0:
        width, height = 7.0 * aspect, 7.0
    return max(columns * width + 1.6, 6.0), rows * (height + 0.45) + 0.6


def _draw_lines(axes, relief, outline, contours, origin, scale):
    x, y = (relief.x.values - origin[0]) * scale, (relief.y.values - origin[1]) * scale
    if len(contours):
        axes.contour(x, y, relief.values, levels=sorted(contours), colors="black", linewidths=0.8, linestyles="dashed")
    if outline is not None:
        axes.add_collection(LineCollection(_rim(outline.values, x, y), colors="black", linewidths=1.0))


def _rim(mask, x, y):
    """Return the cell edges between True and False, shape (edges, 2 ends, 2 coordinates).

    `mask` is of bool, shape (rows, columns); `x` and `y` are the coordinates of its columns and rows.
    """
    mask = np.pad(mask.astype(bool), 1)
    edge_x, edge_y = (np.append(a - 0.5 * (a[1] - a[0]), a[-1] + 0.5 * (a[1] - a[0])) for a in (x, y))
    row, column = np.nonzero(mask[1:-1, 1:] != mask[1:-1, :-1])
    upright = np.stack([edge_x[[column, column]], edge_y[[row, row + 1]]], axis=-1)
    row, column = np.nonzero(mask[1:, 1:-1] != mask[:-1, 1:-1])
    level = np.stack([edge_x[[column, column + 1]], edge_y[[row, row]]], axis=-1)
    return np.concatenate([upright, level], axis=1).swapaxes(0, 1)


def _draw_scale_bar(axes, unit):
    """Draw a bar of a round length, about a fifth of the panel, into its lower left corner.

    `axes` are of matplotlib, `unit` is "m" or "km".
    """
    (west, east), (south, north) = axes.get_xlim(), axes.get_ylim()
    target = 0.25 * (east - west)
    power = 10.0 ** np.floor(np.log10(target))
    length = max(m * power for m in (1, 2, 5) if m * power <= target)
    x, y = west + 0.04 * (east - west), south + 0.06 * (north - south)
    axes.plot([x, x + length], [y, y], color="black", linewidth=3, solid_capstyle="butt")
    axes.text(
        x + 0.5 * length, y + 0.015 * (north - south), f"{length:g} {unit}", ha="center", va="bottom", fontsize="small"
    )
