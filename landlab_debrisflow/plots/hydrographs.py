"""Hydrographs at sections, and series at gauges, against time."""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..core.errors import InputError
from ..core.hints import did_you_mean
from .style import (
    LABEL,
    TITLE,
    dress,
    figure_of,
    label_text,
    legend_above,
    line_style,
    new_figure,
    number_text,
    plain_text,
)  # fmt: skip

PANEL = (7.5, 1.9)
"""Width and height of a panel [inch]."""

SHOWN = {
    "discharge": ("discharge", "m3 s-1", 1.0),
    "solid_discharge": ("discharge\nof grains", "m3 s-1", 1.0),
    "depth": ("depth", "m", 1.0),
    "speed": ("speed", "m s-1", 1.0),
    "basal_excess_pore_pressure": ("basal excess\npore pressure", "kPa", 1e-3),
    "solid_fraction": ("volume of grains\nover the whole", "-", 1.0),
    "bed_elevation": ("elevation\nof the bed", "m", 1.0),
    "discharge_per_width": ("discharge\nper width", "m2 s-1", 1.0),
}
"""Words, unit in figures and factor of the variables of series; others are shown by their attributes."""


def draw_hydrographs(
    sections: xr.Dataset,
    *,
    variables: Sequence[str] = ("discharge", "depth", "speed"),
    axes: Axes | Sequence[Axes] | None = None,
    title: str | None = None,
) -> Figure:
    """Draw discharge, depth and speed at sections against time; the legend has the volumes that crossed.

    Parameters
    ----------
    sections : xarray.Dataset
        As `record.Sections.dataset` returns it, or read from the ``sections.nc`` of a run.
    variables : sequence of str
        Variables of a panel each, over ``section`` and ``time``.
    axes : matplotlib.axes.Axes or sequence of them, optional
        Axes to draw into, one for each variable; into a single one the first is drawn.
    title : str, optional
        Title of the figure.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    InputError
        If a variable is missing.
    """
    names = [plain_text(name) for name in sections["section"].values] if "section" in sections.coords else []
    labels = names
    if "crossed_volume" in sections:
        labels = [
            f"{n}: {number_text(round(float(v)))} m³" for n, v in zip(names, sections.crossed_volume, strict=True)
        ]
    return _draw_series("draw_hydrographs", sections, "section", labels, variables, axes, title)


def draw_gauges(
    gauges: xr.Dataset,
    *,
    variables: Sequence[str] = ("depth", "speed", "basal_excess_pore_pressure"),
    axes: Axes | Sequence[Axes] | None = None,
    title: str | None = None,
) -> Figure:
    """Draw depth, speed and basal excess pore pressure at gauges against time.

    Parameters
    ----------
    gauges : xarray.Dataset
        As `record.Gauges.dataset` returns it, or read from the ``gauges.nc`` of a run.
    variables : sequence of str
        Variables of a panel each, over ``time`` and ``gauge``.
    axes, title
        As in `draw_hydrographs`.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    InputError
        If a variable is missing.
    """
    labels = [plain_text(name) for name in gauges["gauge"].values] if "gauge" in gauges.coords else []
    return _draw_series("draw_gauges", gauges, "gauge", labels, variables, axes, title)


def _draw_series(
    owner: str,
    series: xr.Dataset,
    place: str,
    labels: Sequence[str],
    variables: Sequence[str],
    axes: Axes | Sequence[Axes] | None,
    title: str | None,
) -> Figure:
    """Draw a panel for each variable, with a line for each place."""
    variables = [variables] if isinstance(variables, str) else list(variables)
    known = [str(name) for name, data in series.items() if set(data.dims) == {"time", place}]
    if unknown := [name for name in variables if name not in known]:
        raise InputError(
            f"{owner}: no variable {unknown[0]!r} over time and {place}{did_you_mean(unknown[0], known)}; there are "
            f"{', '.join(known) or 'none'}"
        )
    panels = _panels_of(axes, len(variables), owner)
    for number, (panel, name) in enumerate(zip(panels, variables, strict=False)):
        words, unit, factor = SHOWN.get(name) or (name.replace("_", " "), series[name].attrs.get("units", ""), 1.0)
        data = series[name].transpose(place, "time")
        for k, label in enumerate(labels):
            panel.plot(series["time"], factor * data[k].values, linewidth=1.3, label=label, **line_style(k))
        if not np.isfinite(data.values).any():
            panel.text(0.5, 0.5, "nothing passed", transform=panel.transAxes, ha="center", va="center", fontsize=LABEL)
        elif name not in ("bed_elevation", "basal_excess_pore_pressure"):
            panel.set_ylim(bottom=min(0.0, float(np.nanmin(factor * data.values))))
        panel.set_ylabel(label_text(words, unit), fontsize=LABEL)
        dress(panel, grid=True)
        panel.margins(x=0.01)
        panel.tick_params(labelbottom=number == len(panels) - 1 or axes is not None)
    panels[-1].set_xlabel("time [s]", fontsize=LABEL)
    if labels:
        legend_above(panels[0], 3)
    figure = figure_of(panels[0])
    if axes is None:
        figure.align_ylabels(panels)
    if title is not None:
        figure.suptitle(plain_text(title), fontsize=TITLE)
    return figure


def _panels_of(axes: Axes | Sequence[Axes] | None, count: int, owner: str) -> list[Axes]:
    if axes is None:
        width, height = PANEL
        panels = new_figure(width, height * count + 0.7).subplots(count, 1, sharex=True, squeeze=False)
        return list(panels[:, 0])
    given = [axes] if isinstance(axes, Axes) else list(np.ravel(np.asarray(axes, object)))
    if len(given) not in (1, count):
        raise InputError(f"{owner}: axes must be one, or one for each of {count} variables, got {len(given)}")
    return given
