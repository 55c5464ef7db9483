"""Volumes of a flow against time: released, eroded and flowed in, moving, settled and left."""

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..core.errors import InputError
from .style import AFTER, DEPOSIT, EROSION, LABEL, PEAK, dress, figure_of, legend_above, new_figure, title_above

SOURCES = {"released": ("released", "#b8a88a"), "inflow": ("flowed in", DEPOSIT), "eroded": ("eroded", EROSION)}
PLACES = {"deposited": ("settled", AFTER, "-"), "outflow": ("left the grid", PEAK, "--")}
"""Words and colours of the terms of a budget: where debris came from, and where it is now."""


def draw_volumes(budget: xr.Dataset, *, axes: Axes | None = None, title: str | None = None) -> Figure:
    """Draw volumes against time [m3, s]: released, inflow and eroded above each other, settled and outflow as lines.

    Parameters
    ----------
    budget : xarray.Dataset
        As `record.BudgetSeries.dataset` returns it, or read from the ``budget.nc`` of a run.
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
        If a term of the budget is missing.
    """
    if lacking := [name for name in (*SOURCES, *PLACES) if name not in budget]:
        raise InputError(f"draw_volumes: the Dataset lacks {lacking[0]}; give that of record.BudgetSeries (budget.nc)")
    if axes is None:
        axes = new_figure(7.5, 3.6).add_subplot()
    time = budget["time"].values
    known = [name for name in (*SOURCES, *PLACES) if time.size and float(abs(budget[name]).max()) > 0.0]
    if sources := [name for name in SOURCES if name in known]:
        axes.stackplot(
            time, *(budget[name].values for name in sources), colors=[SOURCES[name][1] for name in sources],
            labels=[SOURCES[name][0] for name in sources], alpha=0.75, linewidth=0.0,
        )  # fmt: skip
    for name in (name for name in PLACES if name in known):
        words, colour, dashes = PLACES[name]
        axes.plot(time, budget[name], color=colour, linestyle=dashes, linewidth=1.4, label=words)
    axes.set_ylim(bottom=0.0)
    axes.margins(x=0.01)
    axes.set_xlabel("time [s]", fontsize=LABEL)
    axes.set_ylabel("volume [m³]", fontsize=LABEL)
    dress(axes, grid=True)
    if known:
        legend_above(axes, 4)
    title_above(axes, title)
    return figure_of(axes)
