"""Figure of the flume with an erodible bed: surge, momentum, scour, and the water content at which a bed yields."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from landlab_debrisflow.plots.style import LABEL, LINES, MUTED, NOTE, TICK, TITLE

from .measures import MEASURED_RATE, THRESHOLD, front_speed, scour_rates

BLUE, RED, _, _, _, ORANGE, BLACK = LINES
STYLES = {"control": (BLACK, "-", "control, no bed"), "wet bed": (BLUE, "-", "wet bed"),
          "dry bed": (ORANGE, "--", "dry bed"),
          "rigid bed of the same shape": (MUTED, ":", "rigid bed of the same shape")}  # fmt: skip
BAND = "0.85"
STEPS = {"thickness": 1e-4, "pressure": 1.0, "eroded": 1e-5, "thickness_by_content": 1e-4}


def shown(result: xr.Dataset) -> xr.Dataset:
    """Return the variables of the figure."""
    return result.sel(s=slice(4.0, 56.0))


def draw(result: xr.Dataset) -> Figure:
    """Return the figure from the stored result."""
    figure = Figure(figsize=(10.0, 6.6), layout="constrained")
    axes = figure.subplot_mosaic([["surge", "momentum"], ["scour", "switch"]])
    time = result.time.values
    for name, (colour, dashes, words) in STYLES.items():
        run, line = result.sel(run=name), {"color": colour, "linestyle": dashes, "linewidth": 1.8, "label": words}
        axes["surge"].plot(time, run.thickness.sel(station="66 m"), **line)
        axes["momentum"].plot(time, 1e-3 * run.momentum, **line)
        if name in ("wet bed", "dry bed"):
            axes["scour"].plot(result.s, 100.0 * run.eroded.isel(time=-1), **line)
    axes["surge"].set(xlim=(3.0, 16.0), ylim=(0.0, None), xlabel="time since the gate began to open [s]")
    axes["surge"].set_ylabel("thickness [m]")
    axes["surge"].set_title("surge at 66 m, beyond the bed", fontsize=TITLE)
    axes["momentum"].set(xlim=(0.0, 16.0), ylim=(0.0, None), xlabel="time since the gate began to open [s]")
    axes["momentum"].set_ylabel("momentum of all that moves [t m/s]")
    axes["momentum"].set_title("momentum", fontsize=TITLE)
    _finish_scour(axes["scour"], result)
    _draw_switch(axes["switch"], result)
    for each in axes.values():
        each.grid(color="0.92", linewidth=0.7)
        each.set_axisbelow(True)
        each.tick_params(labelsize=TICK)
        each.xaxis.label.set_fontsize(LABEL)
        each.yaxis.label.set_fontsize(LABEL)
    axes["surge"].legend(fontsize=NOTE, frameon=False)
    return figure


def _finish_scour(axes: Axes, result: xr.Dataset) -> None:
    """Tell the rate of the scour beside its depth."""
    rates = 100.0 * scour_rates(result.time.values, result.eroded.sel(run="wet bed").values)
    axes.set(xlim=(4.0, 56.0), ylim=(0.0, 15.0), xlabel="distance along the bed from the gate [m]")
    axes.set_ylabel("eroded, normal to the bed [cm]")
    axes.set_title("scour on the axis of a bed of 12 cm", fontsize=TITLE)
    low, high = (100.0 * rate for rate in MEASURED_RATE)
    quartiles = np.percentile(rates, [25, 50, 75])
    words = (
        f"rate where wet: median {quartiles[1]:.1f} cm/s, half of the places\n"
        f"{quartiles[0]:.1f} to {quartiles[2]:.1f}; measured {low:.0f} to {high:.0f}"
    )
    axes.text(0.03, 0.96, words, transform=axes.transAxes, va="top", fontsize=NOTE)


def _draw_switch(axes: Axes, result: xr.Dataset) -> None:
    """Draw scour and speed of the front over the water content of a bed that liquefies as far as it has water."""
    contents = result.water_content.values
    control = front_speed(result.time.values, result.thickness.sel(run="control"))
    speeds = [
        front_speed(result.time.values, result.thickness_by_content.sel(water_content=each)) / control
        for each in contents
    ]
    axes.axvspan(*THRESHOLD, color=BAND, label="switch in the experiments")
    axes.plot(contents, result.scour_by_content, color=BLUE, marker="o", markersize=4, label="eroded volume")
    axes.set(xlabel="water content of the bed by volume [-]", ylim=(0.0, None))
    axes.set_ylabel("eroded volume [m³]")
    axes.set_title("pore pressure of the bed by its water content alone", fontsize=TITLE)
    right = axes.twinx()
    right.plot(contents, speeds, color=RED, marker="s", markersize=4, linestyle="--", label="speed over control")
    right.set_ylabel("speed of the front over that of the control [-]", fontsize=LABEL)
    right.tick_params(labelsize=TICK)
    handles = [each.get_legend_handles_labels() for each in (axes, right)]
    axes.legend(handles[0][0] + handles[1][0], handles[0][1] + handles[1][1], fontsize=NOTE, frameon=False,
                loc="upper left")  # fmt: skip
