"""Tracks of particles over the relief."""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure

from ..core.errors import InputError
from .colours import PALE, extend_of, linear_norm
from .extent import panel_size, within
from .ground import release_outline
from .map_frame import draw_coordinates, draw_ground, draw_scale_bar, draw_title, reference_name
from .map_panel import bar_beside
from .maps import LARGEST_PANEL, chosen_extent, relief_of
from .overlays import draw_outline
from .style import figure_of, new_figure, plain_text


def draw_tracks(
    tracks: xr.Dataset,
    maps: xr.Dataset,
    *,
    axes: Axes | None = None,
    title: str | None = None,
    extent: Sequence[float] | None = None,
    margin: float | None = None,
    contours: bool = True,
) -> Figure:
    """Draw the tracks of particles over the relief, in the colours of their speed [m/s].

    Parameters
    ----------
    tracks : xarray.Dataset
        As `record.Tracks.dataset` returns it, or read from the ``tracks.nc`` of a run.
    maps : xarray.Dataset
        Maps of the run, for the relief.
    axes, title, extent, margin, contours
        As of `draw_map`.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    InputError
        If the Dataset has no tracks, or the maps have no elevation.
    """
    if lacking := [name for name in ("x", "y", "speed") if name not in tracks]:
        raise InputError(f"draw_tracks: the Dataset lacks {lacking[0]}; give that of record.Tracks (tracks.nc)")
    relief = relief_of(maps)
    if relief is None:
        raise InputError("draw_tracks: the maps lack topographic__elevation; give flow.maps whole, or maps.nc")
    x, y, speed = (tracks[name].transpose("particle", "time").values for name in ("x", "y", "speed"))
    passed = _nodes_near(relief, x, y)
    place = chosen_extent(passed, relief, None, extent, margin)
    if axes is None:
        width, height = panel_size(place, LARGEST_PANEL)
        axes = new_figure(max(width, 2.6) + 1.5, height + 1.0).add_subplot()
    draw_ground(axes, relief, place, contours=contours)
    pieces = np.stack([np.stack([x, y], axis=2)[:, :-1], np.stack([x, y], axis=2)[:, 1:]], axis=2).reshape(-1, 2, 2)
    means = 0.5 * (speed[:, 1:] + speed[:, :-1]).ravel()
    known = np.isfinite(pieces).all(axis=(1, 2)) & np.isfinite(means)
    norm = linear_norm([means[known]])
    colours = ListedColormap(colormaps["YlOrRd"](np.linspace(PALE, 1.0, 256)))
    lines = LineCollection(list(pieces[known]), cmap=colours, norm=norm, linewidths=1.2, zorder=4)
    lines.set_array(means[known])
    axes.add_collection(lines, autolim=False)
    bar_beside(axes, lines, norm, extend_of(norm, [means[known]]), "m/s", place)
    if (region := release_outline(maps)) is not None:
        draw_outline(axes, region)
    draw_coordinates(axes, place, plain_text(reference_name(maps)))
    draw_scale_bar(axes, place, within(relief.copy(data=passed), place).values)
    draw_title(axes, plain_text("Speed along tracks" if title is None else title), place)
    return figure_of(axes)


def _nodes_near(relief: xr.DataArray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the nodes nearest to places, of bool, shape (rows, columns)."""
    passed, known = np.zeros(relief.shape, bool), np.isfinite(x) & np.isfinite(y)
    places = []
    for values, axis in ((y, "y"), (x, "x")):
        nodes = relief[axis].values
        index = np.rint((values[known] - nodes[0]) / (nodes[1] - nodes[0])).astype(int)
        places.append(np.clip(index, 0, nodes.size - 1))
    passed[tuple(places)] = True
    return passed
