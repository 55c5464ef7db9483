"""Long sections: ground before and after an event along a line, with the surface of the flow at its peak."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from ..core.errors import InputError
from ..record.places import line as checked_line
from .ground import GroundProfile, ground_of
from .style import AFTER, BEFORE, DEPOSIT, EROSION, LABEL, PEAK, dress, figure_of, legend_above, new_figure, title_above
from .thalweg import trace_thalweg

KILOMETRES_FROM = 10_000.0
"""Length from which distances are told in km [m]."""


def draw_section(
    maps: xr.Dataset,
    line: ArrayLike | None = None,
    *,
    before: xr.Dataset | xr.DataArray | None = None,
    axes: Axes | Sequence[Axes] | None = None,
    title: str | None = None,
) -> Figure:
    """Draw the long section along a line: elevation, and below it the heights over the ground before, enlarged.

    The surface of the flow at its peak is the ground after the event without its deposit, plus the peak depth or the
    deposit, whichever is larger.

    Parameters
    ----------
    maps : xarray.Dataset
        As `DebrisFlow.maps` returns them, or read from the ``maps.nc`` of a run.
    line : array_like, shape (n, 2), optional
        Map coordinates of its vertices [m], downstream; by default the line of `trace_thalweg`.
    before : xarray.Dataset or xarray.DataArray, optional
        Maps or elevation before the event [m]; maps from a file of a run know it. Without, the ground before is that
        after without erosion and deposit: the scar of the release is in it.
    axes : matplotlib.axes.Axes or two of them, optional
        Axes of the elevation, and of the heights; by default those of a new figure.
    title : str, optional
        Title of the section.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    InputError
        If the line has no two vertices or does not come over the maps, or the maps lack the elevation.
    """
    ground = ground_of(maps, before)
    vertices = trace_thalweg(maps, before if isinstance(before, xr.Dataset) else None) if line is None else line
    profile = along_line(ground, checked_line("draw_section", vertices))
    if axes is None:
        figure = new_figure(8.0, 5.0)
        upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(1.6, 1.0))
    else:
        upper, lower = (axes, None) if isinstance(axes, Axes) else _two(axes)
        figure = figure_of(upper)
    unit, factor = ("km", 1e-3) if profile.distance[-1] >= KILOMETRES_FROM else ("m", 1.0)
    distance = profile.distance.values * factor
    _draw_elevation(upper, distance, profile, ground.is_exact)
    below = lower if lower is not None else upper
    if lower is not None:
        _draw_heights(lower, distance, profile)
        upper.tick_params(labelbottom=False)
        figure.align_ylabels([upper, lower])
    below.set_xlabel(f"distance along the line [{unit}]", fontsize=LABEL)
    below.set_xlim(distance[0], distance[-1])
    title_above(upper, title)
    return figure


def along_line(ground: GroundProfile, line: np.ndarray) -> xr.Dataset:
    """Return the surfaces of an event along a line, over ``distance`` [m], NaN where there are no data.

    Parameters
    ----------
    ground : GroundProfile
    line : ndarray, shape (n, 2)
        Map coordinates of its vertices [m].

    Returns
    -------
    xarray.Dataset
        ``before``, ``bed``, ``after`` and ``peak`` [m], every half node.

    Raises
    ------
    InputError
        If no point of the line lies on the ground.
    """
    lengths = np.hypot(*np.diff(line, axis=0).T)
    passed = np.concatenate([[0.0], np.cumsum(lengths)])
    spacing = min(abs(float(ground.bed[axis][1] - ground.bed[axis][0])) for axis in "xy")
    distance = np.linspace(0.0, passed[-1], max(int(np.ceil(2.0 * passed[-1] / spacing)), 2) + 1)
    x, y = (xr.DataArray(np.interp(distance, passed, line[:, k]), {"distance": distance}, "distance") for k in (0, 1))
    surfaces = {name: getattr(ground, name) for name in ("before", "bed", "after", "peak")}
    profile = xr.Dataset({name: one.interp(x=x, y=y).drop_vars(("x", "y")) for name, one in surfaces.items()})
    if not bool(profile.bed.notnull().any()):
        raise InputError(
            f"plots: the line from ({line[0, 0]:.10g}, {line[0, 1]:.10g}) m does not come over the ground of the maps; "
            "are its coordinates in their system?"
        )
    return profile


def _two(axes: Any) -> tuple[Axes, Axes]:
    panels = list(np.ravel(np.asarray(axes, object)))
    if len(panels) != 2:
        raise InputError(f"draw_section: axes must be one, or two for elevation and heights, got {len(panels)}")
    return panels[0], panels[1]


def _draw_elevation(axes: Axes, distance: np.ndarray, profile: xr.Dataset, is_exact: bool) -> None:
    before, after, peak = (profile[name].values for name in ("before", "after", "peak"))
    floor = np.nanmin(profile.bed.values) - 0.06 * max(np.nanmax(peak) - np.nanmin(profile.bed.values), 1.0)
    axes.fill_between(distance, floor, after, color="#e8e2d8", linewidth=0.0, zorder=0.5)
    flowed = np.where(peak > profile.bed.values + 0.01, peak, np.nan)
    axes.plot(distance, flowed, color=PEAK, linewidth=1.1, label="peak surface")
    words = "ground before" if is_exact else "ground before, with the scar"
    axes.plot(distance, before, color=BEFORE, linewidth=1.0, linestyle="--", label=words)
    axes.plot(distance, after, color=AFTER, linewidth=1.1, label="ground after")
    axes.set_ylim(floor, None)
    axes.set_ylabel("elevation [m]", fontsize=LABEL)
    dress(axes, grid=True)
    legend_above(axes, 4)


def _draw_heights(axes: Axes, distance: np.ndarray, profile: xr.Dataset) -> None:
    bed, after, peak = ((profile[name] - profile.before).values for name in ("bed", "after", "peak"))
    plain: dict[str, Any] = {"linewidth": 0.0}
    axes.fill_between(distance, 0.0, bed, where=bed < 0.0, color=EROSION, alpha=0.55, label="failed or eroded", **plain)
    axes.fill_between(distance, bed, after, where=after > bed, color=DEPOSIT, alpha=0.7, label="deposit", **plain)
    axes.plot(distance, np.where(peak > bed + 0.01, peak, np.nan), color=PEAK, linewidth=1.1)
    axes.axhline(0.0, color=BEFORE, linewidth=1.0, linestyle="--")
    axes.set_ylabel("height over the\nground before [m]", fontsize=LABEL)
    dress(axes, grid=True)
    legend_above(axes, 4)
