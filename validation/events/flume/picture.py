"""Figure of the flume: measured and computed series, and the deposit beside the outlines of those that were mapped."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from landlab_debrisflow.plots.style import LABEL, LINES, MUTED, NOTE, TICK, TITLE

from .measured import LAST_TIME, SERIES

BLUE, RED, GREEN, _, SKY, ORANGE, BLACK = LINES
BAND = "0.82"
STYLES = {"measured_permeability": (RED, "-.", 0.9), "no_dilatancy": (ORANGE, ":", 1.8),
          "hydrostatic": (GREEN, "--", 1.2)}  # fmt: skip
WORDS = {
    "george_iverson_2014": "modelled, permeability 5·10⁻⁹ m²,\nhydrostatic start",
    "measured_permeability": "the same with the measured permeability,\n10⁻¹¹ m²",
    "no_dilatancy": "no pressure by shear, suction where it thins",
    "hydrostatic": "no excess pressure at any time",
}
"""Runs in the legend; others have their own name."""

QUANTITIES = {"thickness": ("thickness [m]", 1.0), "pressure": ("pore pressure at the base [kPa]", 1e-3)}
LIMITS = {"2 m": (0.0, 8.0), "32 m": (2.0, 17.0), "66 m": (4.0, LAST_TIME)}
THICKEST = 40.0
"""At the end of the colours of the deposit [cm]."""

STEPS = {"thickness": 1e-4, "pressure": 1.0, "deposit": 1e-4, "measured_thickness": 1e-4, "measured_pressure": 1.0}


def shown(result: xr.Dataset) -> xr.Dataset:
    """Return the variables of the figure: all of them; the measured ones are of US government works."""
    return result


def draw(result: xr.Dataset) -> Figure:
    """Return the figure from the stored result."""
    figure = Figure(figsize=(10.0, 8.8), layout="constrained")
    axes = figure.subplot_mosaic(
        [
            ["thickness 2 m", "thickness 32 m", "thickness 66 m"],
            ["legend", "pressure 32 m", "pressure 66 m"],
            ["map"] * 3,
        ],
        height_ratios=(1.0, 1.0, 1.15),
    )  # fmt: skip
    for name, stations in SERIES.items():
        for station in stations:
            _draw_series(axes[f"{name} {station}"], result, name, station)
    for name in SERIES:
        peers = [axes[f"{name} {station}"] for station in SERIES[name] if station != "2 m"]
        top = max(each.get_ylim()[1] for each in peers)
        for each in peers:
            each.set_ylim(0.0, top)
    axes["legend"].axis("off")
    handles, labels = axes["thickness 32 m"].get_legend_handles_labels()
    axes["legend"].legend(handles, labels, loc="center", frameon=False, fontsize=TICK + 0.5, labelspacing=1.0)
    _draw_deposit(figure, axes["map"], result)
    return figure


def _draw_series(axes: Axes, result: xr.Dataset, name: str, station: str) -> None:
    """Draw the measured band, and the series of every run."""
    label, scale = QUANTITIES[name]
    time, at = result.time.values, {"station": station}
    mean, lower, upper = scale * result[f"measured_{name}"].sel(at).values
    axes.fill_between(time, lower, upper, color=BAND, linewidth=0.0, label="measured, mean ± 1 sd of eight releases")
    axes.plot(time, mean, color=BLACK, linewidth=1.4, label="measured, mean", zorder=3.0)
    for index, run in enumerate(map(str, result.run.values)):
        colour, dashes, width = STYLES.get(run, (SKY, "--", 1.2)) if index else (BLUE, "-", 2.0)
        series = scale * result[name].isel(run=index).sel(at).values
        words = WORDS.get(run, f"the same, {run}")
        axes.plot(time, series, color=colour, linestyle=dashes, linewidth=width, label=words, zorder=3.0 - 0.1 * index)
    low, high = LIMITS[station]
    axes.set(xlim=(low, high), xlabel="time since the gate began to open [s]")
    seen = (time >= low) & (time <= high)
    first = scale * result[name].isel(run=0).sel(at).values
    axes.set_ylim(0.0, 1.12 * max(np.nanmax(upper[seen]), first[seen].max()))
    axes.set_ylabel(label)
    axes.set_title(f"{name} at {station}", fontsize=TITLE)
    axes.grid(color="0.92", linewidth=0.7)
    axes.set_axisbelow(True)
    axes.tick_params(labelsize=TICK)
    axes.xaxis.label.set_fontsize(LABEL)
    axes.yaxis.label.set_fontsize(LABEL)


def _draw_deposit(figure: Figure, axes: Axes, result: xr.Dataset) -> None:
    """Draw the deposit of the first run, and the outlines of those that were mapped."""
    deposit = 100.0 * result.deposit.isel(run=0)
    s, y = result.s.values, result.y.values
    colours = {"cmap": "Blues", "vmin": 0.0, "vmax": THICKEST}
    image = axes.pcolormesh(s, y, deposit.where(deposit > 1.0), shading="nearest", **colours)
    bar = figure.colorbar(image, ax=axes, extend="max", pad=0.01)
    bar.set_label("deposit, vertical [cm]", fontsize=LABEL)
    bar.ax.tick_params(labelsize=TICK)
    for colour, date in zip((BLACK, RED, ORANGE, MUTED), result.experiment.values, strict=True):
        axes.contour(s, y, result.mapped_deposit.sel(experiment=date), [0.5], colors=[colour], linewidths=1.1)
        axes.plot([], [], color=colour, linewidth=1.1, label=str(date))
    axes.plot([76.0, 82.4], [1.0, 1.0], [76.0, 82.4], [-1.0, -1.0], color="0.4", linewidth=2.0)
    axes.set(xlim=(76.0, s[-1]), ylim=(-5.8, 5.8), xlabel="distance along the bed from the gate [m]", ylabel="y [m]")
    axes.set_title("modelled deposit, and outlines of the four that were mapped", fontsize=TITLE)
    axes.set_aspect("equal")
    axes.legend(loc="lower left", fontsize=NOTE, ncols=4, frameon=False)
    axes.tick_params(labelsize=TICK)
