"""One column of excess pore pressure through time."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import Colormap, ListedColormap, Normalize
from matplotlib.figure import Figure

from ..core.errors import InputError
from .colours import extend_of, linear_norm
from .style import LABEL, TICK, TITLE, dress, figure_of, legend_above, new_figure, plain_text

PROFILES = 5
"""Number of profiles that are drawn beside the image."""

KILOPASCAL = 1e-3

WORDS = "Excess pore pressure"


def draw_column(
    columns: xr.Dataset, number: int | None = None, *, axes: Axes | None = None, title: str | None = None
) -> Figure:
    """Draw the excess pore pressure of a column over height and time, and its profile at some times beside it.

    The column grows when it erodes and thins when it spreads: its surface is the upper edge of the image.

    Parameters
    ----------
    columns : xarray.Dataset
        As `record.MarkedColumns.dataset` and `solve_column` return it, or read from the ``columns.nc`` of a run:
        ``excess_pore_pressure`` [Pa] and ``thickness`` [m] over ``time``, ``level``, and ``particle`` or ``column``.
    number : int, optional
        Number of the particle or of the column; by default the one that is there for the longest time, of several the
        first.
    axes : matplotlib.axes.Axes, optional
        Axes of the image; by default those of a new figure, with the profiles beside it.
    title : str, optional
        Title of the figure; by default the number.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    InputError
        If there is no such column, or none of which anything is known.
    """
    one, words = _chosen(columns, number)
    beside = None
    if axes is None:
        axes, beside = new_figure(9.0, 4.0).subplots(1, 2, sharey=True, width_ratios=(1.7, 1.0))
    time = one["time"].values
    pressure = KILOPASCAL * one.excess_pore_pressure.transpose("time", "level").values
    height = one["level"].values * one.thickness.values[:, None]
    norm, colours = _scale(pressure)
    if time.size > 1:
        when, levels = _between(time), np.clip(_between(one["level"].values), 0.0, 1.0)
        edges = np.interp(when, time, one.thickness.values)[:, None] * levels
        when = np.broadcast_to(np.clip(when, time[0], time[-1])[:, None], edges.shape)
        image = axes.pcolormesh(when, edges, pressure, norm=norm, cmap=colours, shading="flat", rasterized=True)
        extend = extend_of(norm, [pressure])
        bar = axes.figure.colorbar(image, ax=axes, pad=0.02, aspect=25, extend=extend, extendfrac=0.04)
        bar.ax.set_title("[kPa]", loc="left", fontsize=TICK, pad=8.0 if extend == "neither" else 14.0)
        bar.ax.tick_params(labelsize=TICK, width=0.6, length=2.5)
        bar.outline.set_linewidth(0.6)
    axes.plot(time, one.thickness.values, color="black", linewidth=1.0, label="surface")
    axes.set_xlabel("time [s]", fontsize=LABEL)
    axes.set_ylabel("height above the base [m]", fontsize=LABEL)
    axes.set_title(plain_text(words if title is None else title), loc="left", fontsize=TITLE)
    axes.set_ylim(0.0, 1.05 * float(one.thickness.max()))
    dress(axes)
    if beside is not None:
        _draw_profiles(beside, time, height, pressure)
    return figure_of(axes)


def _chosen(columns: xr.Dataset, number: int | None) -> tuple[xr.Dataset, str]:
    """Return one column without times at which it was not there, and its name."""
    if lacking := [name for name in ("excess_pore_pressure", "thickness") if name not in columns]:
        raise InputError(
            f"draw_column: the Dataset lacks {lacking[0]}; give that of solve_column or record.MarkedColumns "
            "(columns.nc)"
        )
    along = next((str(dim) for dim in columns.excess_pore_pressure.dims if dim not in ("time", "level")), None)
    if along is not None:
        there = columns.thickness.notnull().sum("time")
        if number is None and there.size:
            number = int(columns[along][int(there.argmax(along))])
        numbers = columns[along].values
        if number not in numbers:
            raise InputError(
                f"draw_column: no {along} {number!r}; there are {', '.join(str(n) for n in numbers[:20]) or 'none'}"
            )
        columns = columns.sel({along: number})
    one = columns[["excess_pore_pressure", "thickness"]].dropna("time", subset=["thickness"])
    if one.sizes["time"] == 0:
        raise InputError("draw_column: nothing is known of the column: it was never there; choose another number")
    return one, f"{WORDS}, {along or 'column'}{'' if along is None else f' {number}'}"


def _between(places: np.ndarray) -> np.ndarray:
    """Return the middles between neighbouring places, and a place beyond each end, shape (n + 1,)."""
    middle = 0.5 * (places[1:] + places[:-1])
    return np.concatenate([[2.0 * places[0] - middle[0]], middle, [2.0 * places[-1] - middle[-1]]])


def _scale(pressure: np.ndarray) -> tuple[Normalize, Colormap]:
    """Return the scale of the pressure [kPa] and its colours: about 0 if there is suction."""
    shown = pressure[np.isfinite(pressure)]
    if shown.size and shown.min() < -0.01 * abs(shown).max():
        high = linear_norm([pressure], diverging=True).vmax or 1.0
        low = max(float(shown.min()), -high)
        middle = 0.5 + 0.5 * np.linspace(low, high, 256) / high  # the part of the colours that is in use, 0 is white
        return Normalize(low, high), ListedColormap(colormaps["RdBu_r"](middle))
    return linear_norm([pressure]), colormaps["BuGn"]


def _draw_profiles(axes: Axes, time: np.ndarray, height: np.ndarray, pressure: np.ndarray) -> None:
    chosen = np.unique(np.linspace(0, time.size - 1, PROFILES).round().astype(int))
    form = ".0f" if time[-1] - time[0] > 20.0 else ".3g"
    shades: Any = colormaps["viridis_r"](np.linspace(0.15, 1.0, chosen.size))
    for shade, k in zip(shades, chosen, strict=True):
        axes.plot(pressure[k], height[k], color=shade, linewidth=1.4, label=f"{time[k]:{form}} s")
    axes.axvline(0.0, color="0.7", linewidth=0.6)
    axes.set_xlabel("excess pore pressure [kPa]", fontsize=LABEL)
    dress(axes, grid=True)
    legend_above(axes, 3)
