"""Maps of probabilities over members of an ensemble, with their sampling error, and of danger levels."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, Colormap, ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from ..core.errors import InputError
from ..core.hints import did_you_mean
from .colours import over_relief
from .extent import Extent, panel_size, within
from .ground import on_increasing_axes
from .map_frame import draw_coordinates, draw_scale_bar, draw_title, reference_name
from .map_panel import axes_beside, draw_values
from .maps import LARGEST_PANEL, chosen_extent, relief_of
from .overlays import draw_shapes
from .quantities import QUANTITIES
from .style import TICK, new_figure, number_text, plain_text, unit_text

PROBABILITY, ERROR = "probability_of_", "_standard_error"

BOUNDS = {"": (0.0, 0.01, 0.05, 0.1, 0.25, 0.5, 0.75, 0.95, 1.0), ERROR: (0.0, 0.01, 0.02, 0.05, 0.1, 0.2)}
"""Ends of classes of probabilities and of their standard errors, those of the styles of GeoTIFFs."""

SHADES = {"": "YlOrRd", ERROR: "Purples"}

STRENGTH = 0.85
"""Opacity of danger levels."""


def draw_probability(
    maps: xr.Dataset,
    name: str = "reached",
    threshold: float | str | None = None,
    *,
    error: bool = True,
    title: str | None = None,
    extent: Sequence[float] | None = None,
    margin: float | None = None,
    contours: bool = True,
    shapes: Any = None,
) -> Figure:
    """Draw the probability that a map exceeds a threshold, and its standard error beside it, over a hillshade.

    Nodes that no member reached are left out.

    Parameters
    ----------
    maps : xarray.Dataset
        As `hazard.hazard_maps` or `calibration.Posterior.predictive` return them, with the elevation of the ground if
        a hillshade is wanted.
    name : str
        Name of a map, such as ``max_depth``, or ``reached`` or ``class``.
    threshold : float or str, optional
        One of the thresholds of the map, or the name of a hazard class; by default the first one.
    error : bool
        Whether the standard error is drawn, if it is known.
    title : str, optional
        Title of the probability.
    extent : sequence of float, optional
        West, east, south and north of the part shown [m].
    margin : float, optional
        Width of the ground around it [m].
    contours : bool
        Whether contour lines of the ground are drawn.
    shapes : object, optional
        Buildings, roads or dams, as in `draw_map`.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    InputError
        If there is no such probability or threshold.
    """
    maps = maps.sortby(["y", "x"])
    shown, words = _chosen(maps, name, threshold, "")
    place = chosen_extent(shown.values > 0.0, shown, None, extent, margin)
    scatter = _chosen(maps, name, threshold, ERROR)[0] if f"{PROBABILITY}{name}{ERROR}" in maps else None
    panels = [(shown, "", words if title is None else title)]
    if error and scatter is not None and bool(scatter.notnull().any()):
        panels.append((scatter.where(shown > 0.0), ERROR, "Standard error"))
    width, height = panel_size(place, LARGEST_PANEL)
    rows, columns = (len(panels), 1) if width > height else (1, len(panels))
    figure = new_figure(columns * (max(width, 2.6) + 1.5), rows * (height + 1.0))
    for axes, (values, kind, text) in zip(figure.subplots(rows, columns, squeeze=False).flat, panels, strict=True):
        norm = BoundaryNorm(BOUNDS[kind], 256, extend="neither" if kind == "" else "max")
        image = draw_values(
            axes, values.where(values > 0.0), relief_of(maps), place, norm, over_relief(SHADES[kind]), contours=contours
        )
        beside = axes_beside(axes)
        bar = figure.colorbar(image, cax=beside, ticks=BOUNDS[kind], spacing="uniform")
        bar.ax.set_yticklabels([f"{100.0 * bound:g}" for bound in BOUNDS[kind]])
        bar.outline.set_linewidth(0.6)
        beside.tick_params(labelsize=TICK, width=0.6, length=2.5)
        beside.set_title("[%]", fontsize=TICK, loc="left", pad=10.0 if kind else 7.0)
        _finish(axes, maps, values, place, text, shapes)
    return figure


def draw_danger_levels(
    levels: xr.DataArray, names: Sequence[str], colours: Sequence[str], *, relief: xr.DataArray | None = None,
    reference: str = "", title: str = "Danger level", shapes: Any = None,
) -> Figure:  # fmt: skip
    """Draw danger levels over a hillshade, with a legend.

    Parameters
    ----------
    levels : xarray.DataArray
        Over ``y`` and ``x``: 0 for none, 1 for the first level and so on.
    names, colours : sequence of str
        Of the levels.
    relief : xarray.DataArray, optional
        Elevation over ``y`` and ``x`` [m].
    reference : str
        Name of the coordinate reference system.
    title : str
    shapes : object, optional
        As in `draw_map`.

    Returns
    -------
    matplotlib.figure.Figure
    """
    values = on_increasing_axes(levels).astype(float)
    values = values.where(values > 0.0)
    place = chosen_extent(values.notnull().values, values, None, None, None)
    width, height = panel_size(place, LARGEST_PANEL)
    axes = new_figure(max(width, 2.6) + 1.7, height + 1.0).add_subplot()
    shades: Colormap = ListedColormap(list(colours)).with_extremes(bad=(0.0, 0.0, 0.0, 0.0))
    norm = BoundaryNorm(np.arange(len(names) + 1) + 0.5, len(names))
    image = draw_values(axes, values, None if relief is None else on_increasing_axes(relief), place, norm, shades)
    image.set_alpha(STRENGTH)
    patches = [Patch(facecolor=shade, edgecolor="0.4", linewidth=0.5) for shade in colours]
    axes.legend(
        patches[::-1], list(names)[::-1], loc="upper left", bbox_to_anchor=(1.01, 1.0), frameon=False, fontsize=TICK
    )
    draw_coordinates(axes, place, plain_text(reference))
    draw_scale_bar(axes, place, np.isfinite(within(values, place).values))
    draw_title(axes, plain_text(title), place)
    if shapes is not None:
        draw_shapes(axes, shapes)
    figure = axes.figure
    assert isinstance(figure, Figure)
    return figure


def _finish(axes: Axes, maps: xr.Dataset, values: xr.DataArray, place: Extent, text: str, shapes: Any) -> None:
    if shapes is not None:
        draw_shapes(axes, shapes)
    draw_coordinates(axes, place, plain_text(reference_name(maps)))
    draw_scale_bar(axes, place, (within(values, place) > 0.0).values)
    draw_title(axes, plain_text(text), place)


def _chosen(maps: xr.Dataset, name: str, threshold: Any, ending: str) -> tuple[xr.DataArray, str]:
    """Return a probability or its error over ``y`` and ``x``, and words for its title."""
    variable = f"{PROBABILITY}{name}"
    if variable not in maps:
        known = [str(one).removeprefix(PROBABILITY) for one in maps if str(one).startswith(PROBABILITY)]
        known = [one for one in known if not one.endswith((ERROR, "_low", "_high"))]
        raise InputError(f"plots: no probability of {name!r}{did_you_mean(name, known)}; there are {', '.join(known)}")
    values = maps[variable + ending]
    (axis,) = [dim for dim in values.dims if dim not in ("y", "x")] or [None]
    if axis is None:
        return values, "Probability that the flow comes"
    bounds = maps[axis].values.tolist()
    bound = bounds[0] if threshold is None else threshold
    if bound not in bounds:
        raise InputError(f"plots: {name} has no threshold {bound!r}; there are {', '.join(map(str, bounds))}")
    chosen = values.isel({axis: bounds.index(bound)})
    if axis == "hazard_class":
        return chosen, f"Probability of the class {bound} or a more severe one"
    quantity = QUANTITIES[name]
    bound_text = f"{number_text(quantity.factor * bound)} {unit_text(quantity.unit)}"
    return chosen, f"Probability of {quantity.words.lower()} > {bound_text}"
