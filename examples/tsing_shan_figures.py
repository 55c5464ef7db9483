"""Figures and table of `tsing_shan.py`, after figures 14 to 22 of Pastor et al. (2022)."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from rich.table import Table
from rich.text import Text
from tsing_shan_record import LOOK, MEASURES, SINCE

from landlab_debrisflow.plots import Layer, draw_maps

SHOWN = (0.0, 32.0, 66.0, 100.0, 250.0, 400.0)
"""Times of figure 14 [s]."""

PROFILES = (0.0, 4.0, 8.0, 128.0)
"""Times of the columns, since the front left erodible ground [s]."""

COLOURS = {"ALE": "#0072B2", "classical": "#D55E00"}

NOTES = f"""\
Distances are in plan, from the centre of the release; the front is where 99 % of the volume lies behind. Deposit counts
nodes with at least 0.1 m. Times are known to {LOOK:g} s. tan(phi) = 0.6 acts on the buoyant weight: the apparent \
friction is 0.30 without excess pore pressure and 0.10 at the bed's ratio of 0.65."""


def print_table(console, records, title):
    """Print all measures of all runs."""
    table = Table()
    table.add_column("", no_wrap=True)
    for model, c_v in records:
        table.add_column(f"{model}\nc_v = {c_v:g}", justify="right")
    for key, (words, form) in MEASURES.items():
        table.add_row(Text(words), *(form.format(record.measures[key]) for record in records.values()))
    console.print(title, highlight=False, markup=False, soft_wrap=True)  # names of files stay whole
    console.print(table, NOTES, highlight=False, markup=False)


def draw_flow(records, c_v):
    """Return figures 14 and 16: particles, coloured by depth, with both models; then by time since leaving."""
    pair = {model: record for (model, value), record in records.items() if value == c_v}
    first = next(iter(pair.values()))
    keys = [key for key in SHOWN if key in first.snapshots]
    keys += [("since", since) for since in SINCE if ("since", since) in first.snapshots and since <= 32.0]
    everything = [record.snapshots[key]["particles"] for record in pair.values() for key in keys]
    x, y = (np.concatenate([p[name].values for p in everything]) for name in "xy")
    west, east, south, north = x.min() - 30.0, x.max() + 30.0, y.min() - 20.0, y.max() + 20.0
    height = 6.0 * (north - south) / (east - west)
    figure = Figure(figsize=(13.0, len(keys) * (height + 0.25) + 1.2), layout="constrained")
    axes = figure.subplots(len(keys), len(pair), sharex=True, sharey=True, squeeze=False)
    deepest = float(np.quantile(np.concatenate([p.depth.values for p in everything]), 0.995))
    for row, key in zip(axes, keys, strict=True):
        for panel, (model, record) in zip(row, pair.items(), strict=True):
            now = record.snapshots[key]
            draw_ground(panel, record)
            p = now["particles"]
            dots = panel.scatter(p.x, p.y, 1.5, p.depth, cmap="YlGnBu", vmin=0.0, vmax=deepest, linewidths=0.0)
            when = f"{now['time']:g} s"
            if isinstance(key, tuple):
                when = f"{key[1]:g} s after the front left erodible ground ({when})"
            panel.set_title(f"{model}, {when}", fontsize="small", loc="left", pad=2.0)
            panel.set(xlim=(west, east), ylim=(south, north), aspect="equal")
    bar = figure.colorbar(dots, ax=axes, location="top", shrink=0.5, aspect=50, extend="max")
    bar.set_label("depth [m] (red line: end of erodible ground; grey lines: elevation every 50 m)")
    figure.supxlabel("x, down the valley [m]", fontsize="medium")
    figure.supylabel("y, across [m]", fontsize="medium")
    figure.suptitle(f"Particles through time, $c_v$ = {c_v:g} m² s⁻¹ (Pastor et al., 2022, figures 14 and 16)")
    return figure


def draw_ground(panel, record):
    """Draw elevation every 50 m and the end of erodible ground."""
    x, y = record.node_x[0], record.node_y[:, 0]
    levels = np.arange(0.0, record.elevation.max(), 50.0)
    panel.contour(x, y, record.elevation, levels, colors="0.75", linewidths=0.4)
    if (record.soil == 0.0).any():
        panel.contour(x, y, record.soil > 0.0, [0.5], colors="tab:red", linewidths=0.8)


ISOLINES = (0.1, 0.5, 1.0, 1.5, 2.0, 3.0)
"""Contours of depth, on the deposit [m]."""


def draw_maps_of(records):
    """Return figures 15, 18 to 20 and 22: erosion, deposit, pressure at the base and Péclet number."""
    some = next(iter(records.values()))
    relief = xr.DataArray(some.elevation, {"y": some.node_y[:, 0], "x": some.node_x[0]}, ("y", "x"))
    layers, isolines = [], {}
    for c_v in dict.fromkeys(value for _, value in records):
        pair = {model: record for (model, value), record in records.items() if value == c_v}
        shown = {
            "eroded": ({m: r.maps.debris_flow__eroded_depth for m, r in pair.items()}, "eroded [m]"),
            "deposit": ({m: r.maps.debris_flow__deposit_depth for m, r in pair.items()}, "deposit [m]"),
        }
        for words, (values, label) in shown.items():
            layers.append(Layer(titled(values, words, c_v), label))
        isolines |= titled(shown["deposit"][0], "deposit", c_v)
        pressure = {m: 1e-3 * r.maps.debris_flow__basal_excess_pore_pressure for m, r in pair.items()}
        largest = max(float(abs(values).max()) for values in pressure.values())
        if largest > 0.01:  # otherwise no mass is left
            words = f"basal excess pore pressure at {some.maps.attrs['elapsed_time']:.0f} s"
            layers.append(Layer(titled(pressure, words, c_v), "pressure [kPa]", "RdBu_r", (-largest, largest)))
        if all(("since", 0.0) in r.snapshots for r in pair.values()):
            number = {m: relief.copy(data=r.snapshots["since", 0.0]["peclet"]) for m, r in pair.items()}
            words = f"Péclet number at {pair['ALE'].passing:g} s"
            layers.append(Layer(titled(number, words, c_v), "$Pe_b$ [-]", "PuRd"))
    under = some.maps.debris_flow__max_depth.values > 0.0
    for record in records.values():
        under = under | (record.maps.debris_flow__max_depth.values > 0.0)
    x, y = some.node_x[under], some.node_y[under]
    extent = (x.min() - 30.0, x.max() + 30.0, y.min() - 30.0, y.max() + 30.0)
    lowest = round(some.elevation[some.soil > 0.0].min())
    figure = draw_maps(layers, relief, contours=(lowest,), extent=extent)
    for panel in figure.axes:
        depth = isolines.get(panel.get_title())
        if depth is not None and depth.max() > ISOLINES[0]:
            panel.contour(depth.x, depth.y, depth, ISOLINES, colors="black", linewidths=0.4)
    figure.suptitle(
        "Erosion, deposit, basal pressure and Péclet number (Pastor et al., 2022, figures 15, 18 to 20 and 22)\n"
        f"dashed: where erodible ground ends; lines on the deposit: {', '.join(f'{z:g}' for z in ISOLINES)} m"
    )
    return figure


def titled(values, words, c_v):
    """Return panels with their titles."""
    return {f"{model}: {words}, $c_v$ = {c_v:g} m² s⁻¹": value for model, value in values.items()}


def draw_columns(records):
    """Return figures 17 and 21: the column of the marked particle."""
    values = list(dict.fromkeys(c_v for _, c_v in records))
    figure = Figure(figsize=(12.0, 3.4 * len(values) + 0.6), layout="constrained")
    axes = figure.subplots(len(values), len(PROFILES), sharey=True, squeeze=False)
    for row, c_v in zip(axes, values, strict=True):
        for panel, since in zip(row, PROFILES, strict=True):
            thick = []
            for (model, value), record in records.items():
                if value != c_v or record.marked is None or ("since", since) not in record.snapshots:
                    continue
                pressure, load = record.marked_column(("since", since))
                particles = record.snapshots["since", since]["particles"]
                thick.append(f"{float(particles.thickness.sel(particle=record.marked)):.2f}")
                style = {"color": COLOURS[model], "ls": "-" if model == "ALE" else "--"}
                panel.plot(pressure / load, np.linspace(0.0, 1.0, pressure.size), label=model, **style)
            if thick:
                when = record.passing + since
                panel.set_title(f"{when:g} s ({since:g} s after)\n$h$ = {' | '.join(thick)} m", fontsize="medium")
            panel.axvline(0.0, color="0.8", lw=0.6)
            panel.axvline(0.65, color="0.6", lw=0.8, ls=":")
            panel.plot([1.0, 0.0], [0.0, 1.0], color="0.6", lw=0.6)
            panel.set(xlim=(-1.05, 1.05), xlabel=r"pressure $\Delta p / p_{liq}$ [-]")
        row[0].set_ylabel(f"$c_v$ = {c_v:g} m² s⁻¹\nheight over thickness [-]")
    axes[0, 0].legend(fontsize="small", loc="upper left")
    figure.suptitle(
        "Column of one particle since the front left erodible ground (Pastor et al., 2022, figures 17 and 21)\n"
        "dotted line: pressure ratio of the bed; thin line: liquefied; $h$: thickness with ALE | classical"
    )
    return figure
