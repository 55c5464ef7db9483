"""Time and distance of the front of a flow along a thalweg."""

import re

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..core.errors import InputError
from .style import LABEL, MUTED, dress, figure_of, legend_above, line_style, new_figure, title_above


def draw_time_distance(thalweg: xr.Dataset, *, axes: Axes | None = None, title: str | None = None) -> Figure:
    """Draw the way of the front along a thalweg [m] against time [s]: the steeper the line, the faster the front.

    Parameters
    ----------
    thalweg : xarray.Dataset
        As `record.Front.dataset` returns it, or read from the ``thalweg.nc`` of a run.
    axes : matplotlib.axes.Axes, optional
        Axes to draw into; by default those of a new figure.
    title : str, optional
        Title of the figure.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    InputError
        If the Dataset is not that of a front.
    """
    if lacking := [name for name in ("time", "front_distance", "farthest_distance") if name not in thalweg.variables]:
        raise InputError(f"draw_time_distance: the Dataset lacks {lacking[0]}; give that of record.Front (thalweg.nc)")
    if axes is None:
        axes = new_figure(7.5, 4.0).add_subplot()
    time, front = thalweg["time"].values, thalweg.front_distance.values
    axes.plot(time, thalweg.farthest_distance, color=MUTED, linewidth=1.0, linestyle="--", label="farthest particle")
    percent = re.search(r"[\d.]+ %", str(thalweg.front_distance.attrs.get("long_name", "")))
    words = f"front: {percent[0]} of the volume lies behind" if percent else "front"
    axes.plot(time, front, linewidth=1.6, label=words, **line_style(0))
    if time.size == 0 or not np.isfinite(front).any():
        axes.text(0.5, 0.5, "nothing moved", transform=axes.transAxes, ha="center", va="center", fontsize=LABEL)
    axes.set_xlabel("time [s]", fontsize=LABEL)
    axes.set_ylabel("distance along the thalweg [m]", fontsize=LABEL)
    dress(axes, grid=True)
    axes.margins(x=0.01)
    legend_above(axes, 2)
    title_above(axes, title)
    return figure_of(axes)
