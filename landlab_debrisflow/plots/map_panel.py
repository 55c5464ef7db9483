"""One panel of a map: values over the ground, with their colour bar."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Colormap, LogNorm, Normalize
from matplotlib.image import AxesImage
from matplotlib.ticker import LogFormatterSciNotation, LogLocator, MaxNLocator
from matplotlib.transforms import Bbox
from numpy.typing import ArrayLike

from .colours import extend_of
from .extent import Extent, cell_edges, within
from .map_frame import draw_ground
from .style import LABEL, NOTE, TICK, halo, unit_text

MISSING = "nothing to show"
"""Text of a map without values."""

BETWEEN = 0.05
"""Least fraction of the nodes between two isochrones [-]: lines and labels of a front that hardly moves would meet."""


def draw_values(
    axes: Axes,
    values: xr.DataArray,
    relief: xr.DataArray | None,
    extent: Extent,
    norm: Normalize,
    colours: Colormap,
    *,
    contours: bool = True,
    missing: str = MISSING,
) -> AxesImage:
    """Draw values over the ground; where they are missing, the ground shows.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    values : xarray.DataArray
        Over ``y`` and ``x``, which increase; NaN is missing.
    relief : xarray.DataArray or None
        Elevation over ``y`` and ``x`` [m]; None: no ground.
    extent : Extent
    norm : matplotlib.colors.Normalize
    colours : matplotlib.colors.Colormap
    contours : bool
        Whether contour lines of the ground are drawn.
    missing : str
        Text of a map without values.

    Returns
    -------
    matplotlib.image.AxesImage
    """
    if relief is not None:
        draw_ground(axes, relief, extent, contours=contours)
    part = within(values, extent)
    image = axes.imshow(
        np.ma.masked_invalid(part.values), cmap=colours, norm=norm, extent=cell_edges(part), origin="lower",
        interpolation="nearest", zorder=0.5, label="values",
    )  # fmt: skip
    axes.set(xlim=extent[:2], ylim=extent[2:], aspect="equal")
    if not np.isfinite(part.values).any():
        axes.text(
            0.5, 0.5, missing, transform=axes.transAxes, ha="center", va="center", fontsize=LABEL, path_effects=halo()
        )
    return image


def draw_colour_bar(
    axes: Axes, image: AxesImage, norm: Normalize, values: list[np.ndarray], unit: str, extent: Extent
) -> None:
    """Draw the colour bar of a panel beside it, as high as the panel, with the unit above.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Panel of the image.
    image : matplotlib.image.AxesImage
    norm : matplotlib.colors.Normalize
        Scale of the image.
    values : list of ndarray
        All values that the scale is for: those beyond it make an arrow at its end.
    unit : str
        Unit of the values.
    extent : Extent
        Extent of the panel.
    """
    bar_beside(axes, image, norm, extend_of(norm, values), unit, extent)


def bar_beside(axes: Axes, drawn: ScalarMappable, norm: Normalize, extend: str, unit: str, extent: Extent) -> None:
    """Draw a colour bar beside a panel, with the unit above.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        The panel.
    drawn : matplotlib.cm.ScalarMappable
        Image or lines that have the colours.
    norm : matplotlib.colors.Normalize
        Their scale.
    extend : str
        Ends with an arrow: "neither", "min", "max" or "both".
    unit : str
        Unit of the values.
    extent : Extent
        Of the panel.
    """
    beside = axes_beside(axes)
    bar = axes.figure.colorbar(drawn, cax=beside, extend=extend, extendfrac=0.04)
    if isinstance(norm, LogNorm):
        beside.yaxis.set_major_locator(LogLocator(10.0, numticks=6))
        beside.yaxis.set_major_formatter(LogFormatterSciNotation())
    else:
        bar.locator = MaxNLocator(6 if extent.height > 0.5 * extent.width else 4)
        bar.update_ticks()
    bar.outline.set_linewidth(0.6)
    beside.tick_params(labelsize=TICK, width=0.6, length=2.5)
    above = 10.0 if extend in ("max", "both") else 7.0
    beside.set_title(f"[{unit_text(unit)}]", fontsize=TICK, loc="left", pad=above)


def axes_beside(axes: Axes, gap: float = 0.07, width: float = 0.13) -> Axes:
    """Return axes for a colour bar on the right of a panel, as high as the panel.

    The panel keeps its place on the page: bars that matplotlib takes from it are higher than a map of a wide valley.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        The panel.
    gap, width : float
        Between panel and bar, and of the bar [inch].
    """
    beside = axes.inset_axes((1.0, 0.0, 0.1, 1.0))

    def place(bar: Any, renderer: Any) -> Bbox:
        panel, inch = axes.get_position(), axes.figure.dpi / axes.figure.bbox.width
        return Bbox.from_bounds(panel.x1 + gap * inch, panel.y0, width * inch, panel.height)

    beside.set_axes_locator(place)
    return beside


def draw_isochrones(axes: Axes, values: xr.DataArray, extent: Extent, lines: int = 6) -> None:
    """Draw lines of equal arrival at round times, with the times on them.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    values : xarray.DataArray
        Arrival over ``y`` and ``x``, NaN where nothing came.
    extent : Extent
    lines : int
        Number wanted.
    """
    part = within(values, extent)
    shown = part.values[np.isfinite(part.values)]
    if shown.size == 0 or shown.max() <= shown.min() or int(np.isfinite(part.values).sum()) < 9:
        return
    ticks = MaxNLocator(lines, steps=[1, 2, 3, 5, 6, 10]).tick_values(float(shown.min()), float(shown.max()))
    levels = spread_levels(shown, ticks)
    if not levels:
        return
    drawn = axes.contour(
        part.x, part.y, np.ma.masked_invalid(part.values), levels, colors="black", linewidths=0.7, zorder=3
    )
    for text in axes.clabel(drawn, fontsize=NOTE, fmt="%g", inline_spacing=1):
        text.set_path_effects(halo(2.0))


def spread_levels(values: np.ndarray, levels: ArrayLike) -> list[float]:
    """Return the levels that have a fraction `BETWEEN` of the values between each other, and at both ends.

    Parameters
    ----------
    values : ndarray, shape (n,)
    levels : array_like
        In increasing order.

    Returns
    -------
    list of float

    Examples
    --------
    >>> spread_levels(np.arange(100.0), [10.0, 12.0, 50.0, 99.0])
    [10.0, 50.0]
    """
    ordered, least = np.sort(values), BETWEEN * values.size
    kept, below = [], 0
    for level in np.asarray(levels, float):
        lower = int(np.searchsorted(ordered, level))
        if lower - below >= least and values.size - lower >= least:
            kept.append(float(level))
            below = lower
    return kept
