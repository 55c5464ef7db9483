"""Maps of one run over its relief: a quantity in map coordinates."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from ..core.checks import in_range
from ..core.errors import InputError
from ..record.written_maps import LEAST_DEPTH
from .colours import over_relief
from .extent import Extent, extent_around, panel_size, within
from .ground import ELEVATION, elevation_of, on_increasing_axes, release_outline
from .map_frame import draw_coordinates, draw_scale_bar, draw_title, reference_name
from .map_panel import draw_colour_bar, draw_isochrones, draw_values
from .overlays import draw_outline, draw_places, draw_shapes
from .quantities import DIVERGING, PLAIN, TIME, ShownMap, reached_nodes, shown_map
from .style import figure_of, new_figure, plain_text

LARGEST_PANEL = (7.0, 6.5)
"""Width and height that a single map may have [inch]."""


def draw_map(
    maps: xr.Dataset,
    name: str = "max_depth",
    *,
    before: xr.Dataset | xr.DataArray | None = None,
    axes: Axes | None = None,
    title: str | None = None,
    limits: tuple[float, float] | None = None,
    least_depth: float = LEAST_DEPTH,
    extent: Sequence[float] | None = None,
    margin: float | None = None,
    contours: bool = True,
    outline: xr.DataArray | None = None,
    shapes: Any = None,
    places: Mapping[str, ArrayLike] | None = None,
) -> Figure:
    """Draw the map of a quantity over a hillshade, in map coordinates.

    Peaks and arrival are missing where the flow stayed thinner than a least depth, and everything is missing where
    nothing came. The colour of small values lets the relief through.

    Parameters
    ----------
    maps : xarray.Dataset
        As `DebrisFlow.maps` returns them, or read from the ``maps.nc`` of a run.
    name : str
        Name of a map, with or without ``debris_flow__``, such as ``max_depth``, ``max_speed``, ``arrival_time`` (with
        isochrones), ``max_basal_pressure_ratio``, ``max_basal_peclet_number`` (on a logarithmic scale); or
        ``elevation_change``: deposit and erosion.
    before : xarray.Dataset or xarray.DataArray, optional
        Maps or elevation before the event [m]; maps from a file of a run know it. Without, ``elevation_change`` is
        deposit less erosion, in which the scar of the release is not.
    axes : matplotlib.axes.Axes, optional
        Axes to draw into; by default those of a new figure.
    title : str, optional
        Title of the map; by default the name of the quantity.
    limits : tuple of float, optional
        Ends of the colour scale, in the unit of the figure.
    least_depth : float
        Peaks and arrival are missing where the peak depth stayed below [m].
    extent : sequence of float, optional
        West, east, south and north of the part shown [m]; by default all that the flow reached, with a margin.
    margin : float, optional
        Width of the ground around it [m].
    contours : bool
        Whether contour lines of the ground are drawn.
    outline : xarray.DataArray of bool, optional
        Region whose rim is drawn; by default the release, if `before` or the file tells it.
    shapes : object, optional
        Buildings, roads or dams: a GeoDataFrame, geometries of shapely, or arrays of vertices, shape (n, 2) [m].
    places : mapping of str to array_like, shape (2,) or (n, 2), optional
        Points and lines with their names, such as gauges and sections: map coordinates [m].

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    InputError
        If there is no such map, or the maps are not over ``y`` and ``x`` alone.

    Examples
    --------
    >>> import numpy as np
    >>> import xarray as xr
    >>> x, y = np.arange(0.0, 300.0, 10.0), np.arange(0.0, 200.0, 10.0)
    >>> depth = np.where(abs(y[:, None] - 100.0) + 0.0 * x < 30.0, 1.5, 0.0)
    >>> maps = xr.Dataset(
    ...     {"topographic__elevation": (("y", "x"), 0.3 * (300.0 - x) + 0.0 * y[:, None]),
    ...      "debris_flow__max_depth": (("y", "x"), depth)},
    ...     {"y": y, "x": x},
    ... )
    >>> figure = draw_map(maps, "max_depth")
    >>> figure.axes[0].get_title(loc="left"), figure.axes[0].get_xlabel()
    ('Peak depth', 'x [m]')
    """
    shown = shown_map(maps, name, before=before, least_depth=least_depth)
    region = release_outline(maps, before) if outline is None else on_increasing_axes(outline)
    reached = reached_nodes(maps, least_depth)  # maps of a run have one extent, and can be laid upon each other
    drawn = np.isfinite(shown.values.values) if reached is None else reached
    place = chosen_extent(drawn, shown.values, region, extent, margin)
    if axes is None:
        width, height = panel_size(place, LARGEST_PANEL)
        axes = new_figure(max(width, 2.6) + 1.5, height + 1.0).add_subplot()
    draw_shown(axes, shown, relief_of(maps), place, region, limits=limits, contours=contours, shapes=shapes)
    if places is not None:
        draw_places(axes, places)
    draw_coordinates(axes, place, plain_text(reference_name(maps)))
    draw_scale_bar(axes, place, np.isfinite(within(shown.values, place).values))
    draw_title(axes, plain_text(shown.quantity.words if title is None else title), place)
    return figure_of(axes)


def draw_shown(
    axes: Axes,
    shown: ShownMap,
    relief: xr.DataArray | None,
    place: Extent,
    region: xr.DataArray | None = None,
    *,
    limits: tuple[float, float] | None = None,
    contours: bool = True,
    shapes: Any = None,
) -> None:
    """Draw a map over its ground with its colour bar, isochrones, the rim of a region, and shapes.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    shown : ShownMap
    relief : xarray.DataArray or None
        Elevation [m]; None: no ground.
    place : Extent
    region : xarray.DataArray of bool, optional
        Region whose rim is drawn.
    limits, contours, shapes
        As in `draw_map`.
    """
    norm, scale = shown.norm(region), shown.quantity.scale
    if limits is not None:
        norm.vmin, norm.vmax = checked_limits(limits, isinstance(norm, LogNorm))
    colours = over_relief(shown.quantity.colours, diverging=scale == DIVERGING, fading=scale not in (TIME, PLAIN))
    image = draw_values(axes, shown.values, relief, place, norm, colours, contours=contours)
    draw_colour_bar(axes, image, norm, [within(shown.values, place).values], shown.quantity.unit, place)
    if scale == TIME:
        draw_isochrones(axes, shown.values, place)
    if region is not None:
        draw_outline(axes, region)
    if shapes is not None:
        draw_shapes(axes, shapes)


def relief_of(maps: xr.Dataset) -> xr.DataArray | None:
    """Return the elevation of maps over ``y`` and ``x`` [m], None if they have none."""
    return elevation_of(maps) if ELEVATION in maps else None


def chosen_extent(
    drawn: np.ndarray,
    raster: xr.DataArray,
    region: xr.DataArray | None,
    extent: Sequence[float] | None,
    margin: float | None,
) -> Extent:
    """Return the extent given, or the one around the drawn nodes.

    Parameters
    ----------
    drawn : ndarray of bool, shape (rows, columns)
        Nodes that must be in it.
    raster : xarray.DataArray
        Over ``y`` and ``x``.
    region : xarray.DataArray of bool or None
        Further nodes that must be in it.
    extent : sequence of float or None
        West, east, south and north [m].
    margin : float or None
        Width of the ground around [m].

    Raises
    ------
    InputError
        If it is no rectangle.
    """
    if extent is not None:
        values = tuple(float(value) for value in extent)
        if len(values) != 4 or not (values[0] < values[1] and values[2] < values[3] and np.isfinite(values).all()):
            raise InputError(f"plots: extent must be west < east and south < north [m], got {extent!r}")
        return Extent(*values)
    if margin is not None:
        in_range("plots: margin", margin, 0.0, unit="m", error=InputError)
    return extent_around(drawn if region is None else drawn | region.values.astype(bool), raster, margin)


def checked_limits(limits: tuple[float, float], logarithmic: bool) -> tuple[float, float]:
    """Return the ends of a colour scale, lower and upper, or raise InputError if they are none."""
    low, high = limits
    if not (np.isfinite(low) and np.isfinite(high) and low < high and (low > 0.0 or not logarithmic)):
        words = "two increasing numbers above 0" if logarithmic else "two increasing numbers"
        raise InputError(f"plots: limits must be {words}, got {limits!r}")
    return float(low), float(high)
