"""Frame of a map: ground, coordinates on the axes, scale bar."""

import re
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter, MaxNLocator

from .extent import Extent, cell_edges, emptiest_corner, panel_size, within
from .relief import contour_interval, hillshade
from .style import LABEL, NOTE, TITLE, dress, halo

KILOMETRES_FROM = 5000.0
"""Extent above which coordinates are told in km instead of m [m]."""

LETTER, ROOM_FOR_UNIT = 0.085, 0.1
"""Width of a letter of a title, and of what must be free behind it [inch]."""

NO_TICKS = 0.08
"""Part of an axis at either end that has no ticks [-]."""

FINEST_CONTOURS = 5e-4
"""Least interval of contour lines over the extent of a map [-]: below it the ground is a plain with noise."""

CONTOUR = "#6b5a45"
"""Colour of contour lines."""


def draw_ground(axes: Axes, relief: xr.DataArray, extent: Extent, *, contours: bool = True) -> None:
    """Draw the hillshade of an extent, and contour lines with their elevations.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    relief : xarray.DataArray
        Elevation over ``y`` and ``x`` [m]; where it is missing, the page stays white.
    extent : Extent
    contours : bool
        Whether contour lines are drawn.
    """
    part = within(relief, extent)
    edges = cell_edges(part)
    axes.imshow(hillshade(part), cmap="gray", vmin=0.0, vmax=1.0, extent=edges, origin="lower", zorder=0)
    low, high = _elevations_of(part)
    step = contour_interval(low, high)
    if contours and step > FINEST_CONTOURS * max(extent.width, extent.height):
        levels = np.arange(np.ceil(low / step), np.floor(high / step) + 1.0) * step
        if levels.size:
            lines = axes.contour(
                part.x, part.y, part, levels=levels, colors=CONTOUR, linewidths=0.4, alpha=0.6, zorder=1
            )
            index = [level for k, level in enumerate(levels) if round(level / step) % 5 == 0] or [levels[-1]]
            axes.clabel(lines, levels=index, fontsize=6.5, fmt="%g", inline=True, inline_spacing=2)
    axes.set(xlim=extent[:2], ylim=extent[2:], aspect="equal")


def draw_coordinates(axes: Axes, extent: Extent, reference: str = "", *, labels: bool = True) -> None:
    """Draw ticks at round map coordinates, whole numbers without an offset, and say their unit.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    extent : Extent
    reference : str
        Name of the coordinate reference system, if it is known.
    labels : bool
        Whether the axes get labels.
    """
    unit, factor = unit_of_coordinates(extent)
    wide = extent.width >= extent.height
    for axis, count in ((axes.xaxis, 5 if wide else 3), (axes.yaxis, 3 if wide else 5)):
        axis.set_major_locator(InnerTicks(count, steps=[1, 2, 2.5, 5, 10]))
        axis.set_major_formatter(FuncFormatter(lambda value, _: coordinate_text(value / factor)))
    dress(axes)
    for tick in axes.get_yticklabels():
        tick.set(rotation=90.0, verticalalignment="center")
    axes.tick_params(axis="y", labelrotation=90.0)
    if labels:
        axes.set_xlabel(f"x [{unit}]{f', {reference}' if reference else ''}", fontsize=LABEL)
        axes.set_ylabel(f"y [{unit}]", fontsize=LABEL)


class InnerTicks(MaxNLocator):
    """Round places of ticks that are not so near to an end of an axis that labels of two axes would meet."""

    def tick_values(self, vmin: float, vmax: float) -> Any:
        """Return the places of ticks between two ends."""
        ticks, margin = np.asarray(super().tick_values(vmin, vmax)), NO_TICKS * abs(vmax - vmin)
        inner = ticks[(ticks >= min(vmin, vmax) + margin) & (ticks <= max(vmin, vmax) - margin)]
        return inner if inner.size else ticks


def draw_title(axes: Axes, text: str, extent: Extent) -> None:
    """Draw the title of a panel, above the unit of the colour bar if there is no room for both in a line.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    text : str
    extent : Extent
        Of the panel.
    """
    box, figure = axes.get_position(), axes.figure
    inches = figure.bbox.width / figure.dpi * box.width, figure.bbox.height / figure.dpi * box.height
    is_narrow = panel_size(extent, inches)[0] < LETTER * len(text) + ROOM_FOR_UNIT
    axes.set_title(text, loc="left", fontsize=TITLE, pad=20.0 if is_narrow else 6.0)


def unit_of_coordinates(extent: Extent) -> tuple[str, float]:
    """Return the unit of the coordinates of an extent, and its length [m]."""
    return ("km", 1000.0) if max(extent.width, extent.height) > KILOMETRES_FROM else ("m", 1.0)


def coordinate_text(value: float) -> str:
    r"""Return a map coordinate as text: all digits, with thin spaces between thousands of more than four.

    Examples
    --------
    >>> coordinate_text(5200140.0), coordinate_text(950.0), coordinate_text(5200.5)
    ('5\u2009200\u2009140', '950', '5200.5')
    """
    text = f"{value:,.6f}".rstrip("0").rstrip(".")
    return text.replace(",", "" if abs(value) < 10_000.0 else "\u2009").replace("-", "\u2212")


def reference_name(maps: xr.Dataset) -> str:
    """Return the name of the coordinate reference system of maps from a file, "" if it is not known.

    Examples
    --------
    >>> words = {"crs_wkt": 'PROJCRS["WGS 84 / UTM zone 32N",BASEGEOGCRS["WGS 84"]]'}
    >>> reference_name(xr.Dataset(coords={"crs": ((), 0, words)}))
    'WGS 84 / UTM zone 32N'
    """
    for data in maps.variables.values():
        text = str(data.attrs.get("crs_wkt", ""))
        if found := re.match(r'\s*\w+\[\s*"([^"]+)"', text):
            return found[1] if found[1].lower() not in ("unknown", "unnamed") else ""
    return ""


def draw_scale_bar(axes: Axes, extent: Extent, shown: np.ndarray | None = None, corner: str | None = None) -> None:
    """Draw a bar of a round length, about a fifth of the panel, into the corner where least is shown.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    extent : Extent
    shown : ndarray of bool, shape (rows, columns), optional
        Nodes of the panel where something is drawn, the first row in the south.
    corner : str, optional
        Such as "lower left", instead of `shown`.
    """
    target = 0.25 * extent.width
    power = 10.0 ** np.floor(np.log10(target))
    length = float(max(m * power for m in (1.0, 2.0, 5.0) if m * power <= target))
    vertical, horizontal = (corner or ("lower left" if shown is None else emptiest_corner(shown))).split()
    start = 0.04 if horizontal == "left" else 0.96 - length / extent.width
    height = 0.04 if vertical == "lower" else 0.86
    ends = np.array([start, start + length / extent.width])
    axes.plot(
        ends, [height, height], transform=axes.transAxes, color="black", linewidth=2.5, solid_capstyle="butt",
        path_effects=halo(5.0), zorder=10, label="_scale bar",
    )  # fmt: skip
    text = f"{length / 1000.0:g} km" if length >= 1000.0 else f"{length:g} m"
    axes.annotate(
        text, (ends.mean(), height), xycoords=axes.transAxes, xytext=(0, 2.5), textcoords="offset points",
        ha="center", va="bottom", fontsize=NOTE, path_effects=halo(), zorder=10,
    )  # fmt: skip


def _elevations_of(part: xr.DataArray) -> tuple[float, float]:
    finite = part.values[np.isfinite(part.values)]
    return (float(finite.min()), float(finite.max())) if finite.size else (0.0, 0.0)
