"""Animations of series of maps, as GIF, or as MP4 where ffmpeg is."""

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.animation import FFMpegWriter, FuncAnimation, PillowWriter

from ..core.checks import in_range
from ..core.errors import InputError
from ..core.hints import did_you_mean
from ..grid.fields import OUTPUT_PREFIX
from ..record.files import check_writable, write_atomically
from .colours import over_relief
from .extent import panel_size, within
from .ground import elevation_before, on_increasing_axes, release_outline
from .map_frame import draw_coordinates, draw_scale_bar, reference_name
from .map_panel import draw_colour_bar, draw_values
from .maps import checked_limits, chosen_extent, relief_of
from .overlays import draw_outline, draw_shapes
from .quantities import DIVERGING, QUANTITIES, Quantity, ShownMap
from .style import TITLE, figure_of, new_figure, plain_text

LARGEST_PANEL = (6.4, 5.0)
"""Width and height of the map of an animation [inch]."""

MOST_FRAMES = 60
"""Of a longer series every second, third ... time is drawn: a file that nobody waits for."""

PAUSE = 0.12
"""Part of the frames for which the last one stands, before the animation begins anew [-]."""


def animate(
    series: xr.Dataset,
    maps: xr.Dataset | None = None,
    name: str = "depth",
    *,
    before: xr.Dataset | xr.DataArray | None = None,
    limits: tuple[float, float] | None = None,
    extent: Sequence[float] | None = None,
    margin: float | None = None,
    contours: bool = True,
    shapes: Any = None,
    frames: int = MOST_FRAMES,
) -> FuncAnimation:
    """Return an animation of the maps of a run against time, with one colour scale and the time in the title.

    Parameters
    ----------
    series : xarray.Dataset
        Maps over ``time``, ``y`` and ``x``, as `record.combine_maps` writes them: the ``series.nc`` of a run.
    maps : xarray.Dataset, optional
        Maps of the run at its end, for the relief, which a series does not have.
    name : str
        Name of the map, with or without ``debris_flow__``.
    before : xarray.Dataset or xarray.DataArray, optional
        Maps or elevation before the event [m], for the relief.
    limits, extent, margin, contours, shapes
        As of `draw_map`.
    frames : int
        Most times that are drawn.

    Returns
    -------
    matplotlib.animation.FuncAnimation
        Keep it until it is saved, by `save_animation`.

    Raises
    ------
    InputError
        If the series has no such map, or no time.
    """
    in_range("animate: frames", frames, 1, 10_000, error=InputError)
    short = _known(series, name)
    data = series[OUTPUT_PREFIX + short if OUTPUT_PREFIX + short in series else short]
    quantity = QUANTITIES.get(short) or Quantity(short.replace("_", " "), data.attrs.get("units", ""), "YlGnBu")
    data = data.isel(time=slice(None, None, -(-data.sizes["time"] // int(frames))))
    first = on_increasing_axes(data.isel(time=0, drop=True))
    data = data.reindex_like(first)
    largest = abs(data).max("time")
    raster = first if (relief := _relief(maps, before)) is None else relief
    whole = ShownMap(short, largest * quantity.factor, quantity)
    drawn = (largest > quantity.least).reindex_like(raster, method="nearest", tolerance=1e-6, fill_value=False)
    region = None if maps is None else release_outline(maps, before if isinstance(before, xr.Dataset) else None)
    place = chosen_extent(drawn.values.astype(bool), raster, region, extent, margin)
    width, height = panel_size(place, LARGEST_PANEL)
    axes = new_figure(max(width, 2.6) + 1.5, height + 1.0).add_subplot()
    norm = whole.norm()
    if limits is not None:
        norm.vmin, norm.vmax = checked_limits(limits, False)

    def shown(number: int) -> xr.DataArray:
        values = data.isel(time=number)
        return values.where(abs(values) > quantity.least) * quantity.factor

    colours = over_relief(quantity.colours, diverging=quantity.scale == DIVERGING)
    image = draw_values(axes, shown(-1), relief, place, norm, colours, contours=contours, missing="")
    draw_colour_bar(axes, image, norm, [whole.values.values], quantity.unit, place)
    if region is not None:
        draw_outline(axes, region)
    if shapes is not None:
        draw_shapes(axes, shapes)
    draw_coordinates(axes, place, "" if maps is None else plain_text(reference_name(maps)))
    draw_scale_bar(axes, place, within(raster.copy(data=drawn.values), place).values)
    title = axes.set_title(" ", loc="left", fontsize=TITLE)

    def draw(number: int) -> list[Any]:
        image.set_data(np.ma.masked_invalid(within(shown(number), place).values))
        title.set_text(f"{plain_text(quantity.words)} after {float(data.time[number]):.1f} s")
        return [image, title]

    last = data.sizes["time"] - 1
    draw(last)
    figure = figure_of(axes)
    figure.draw_without_rendering()  # of the layout, which stays as it is
    figure.set_layout_engine("none")
    return FuncAnimation(figure, draw, [*range(last + 1), *[last] * int(np.ceil(PAUSE * last))], cache_frame_data=False)


def save_animation(
    animation: FuncAnimation, path: str | os.PathLike[str], *, frames_per_second: int = 10, dpi: int = 100
) -> Path:
    """Write an animation as GIF or MP4, atomically; return the path.

    Parameters
    ----------
    animation : matplotlib.animation.FuncAnimation
        As `animate` returns it.
    path : str or os.PathLike
        The file; its suffix, ``.gif`` or ``.mp4``, chooses the format. MP4 needs the program ffmpeg.
    frames_per_second : int
        Times of the series in a second.
    dpi : int
        Dots per inch.

    Returns
    -------
    pathlib.Path
        Where the file is.

    Raises
    ------
    InputError
        If the file cannot be written, the format is another one, or ffmpeg is not installed.
    """
    in_range("save_animation: frames_per_second", frames_per_second, 1, 100, error=InputError)
    path = check_writable(path)
    suffix = path.suffix.lower()
    if suffix not in (".gif", ".mp4"):
        raise InputError(f"save_animation: the suffix of {path.name} must be .gif or .mp4, got {path.suffix!r}")
    check_format(suffix)
    kind = PillowWriter if suffix == ".gif" else FFMpegWriter
    writer = kind(fps=frames_per_second)
    return write_atomically(path, lambda temporary: animation.save(temporary, writer=writer, dpi=dpi))


def check_format(suffix: str) -> None:
    """Raise InputError if an animation of the format of a suffix cannot be written here."""
    if suffix == ".mp4" and not FFMpegWriter.isAvailable():
        raise InputError(
            "an animation as MP4 needs the program ffmpeg, which is not installed; install it (apt install ffmpeg, "
            "conda install ffmpeg), or write a GIF"
        )


def _known(series: xr.Dataset, name: str) -> str:
    """Return the name of a map of a series without prefix, or raise InputError if there is none."""
    names = [
        str(one).removeprefix(OUTPUT_PREFIX) for one, data in series.items() if set(data.dims) == {"time", "y", "x"}
    ]
    short = str(name).removeprefix(OUTPUT_PREFIX)
    if short not in names:
        raise InputError(
            f"animate: no map {short!r} over time{did_you_mean(short, names)}; there are {', '.join(names) or 'none'}"
        )
    if series.sizes["time"] == 0:
        raise InputError("animate: the series has no time")
    return short


def _relief(maps: xr.Dataset | None, before: xr.Dataset | xr.DataArray | None) -> xr.DataArray | None:
    """Return the elevation before the event if it is known, else after; None without maps."""
    if maps is None:
        return None
    known = elevation_before(maps, before)
    return relief_of(maps) if known is None else known
