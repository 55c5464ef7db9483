"""The demonstration: a stand-in for Tsing Shan with two models of pore pressure, side by side."""

import time

import numpy as np
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from ..component import DebrisFlow
from ..plots import Layer, draw_maps, save_figure
from ..record.datasets import stack
from ..record.files import check_writable, write_dataset
from ..record.measures import measures
from ..record.observers import Progress
from ..scene.tsing_shan import NON_ERODIBLE_BELOW, tsing_shan_valley

COLUMNS = {"ale": "ALE", "classical": "classical"}
"""The models compared: name of the column law, and its label in figures and tables."""

MATERIAL = {"initial_pressure_profile": "basal_layer"}
"""The start of Pastor et al. (2022), section 4.2.2: a basal layer of h/10 at 0.65 of liquefaction."""

LEVELS = 41
"""Levels of both columns: the classical one keeps its pressure in a layer that 11 levels do not resolve
(docs/decisions.md)."""

DEPOSIT = 0.1
"""Least depth that counts as deposit, for medians and in the figure [m]."""

FRONT_FRACTION = 0.99
"""Fraction of the deposited volume that lies behind the front: single particles far ahead do not count [-]."""


def run_demo(particles: int, output_dir, console: Console) -> dict[str, dict[str, float]]:
    """Run the valley with both models, print the comparison, and write demo.nc and demo.png.

    Parameters
    ----------
    particles : int
        Number of particles of the release.
    output_dir : pathlib.Path
        An existing directory.
    console : rich.console.Console
        Where the table goes.

    Returns
    -------
    dict
        The measures of `measure` for each model.

    Raises
    ------
    InputError, ParameterError
        If the files cannot be written or `particles` is out of bounds; nothing was computed.
    """
    data_path, figure_path = check_writable(output_dir / "demo.nc"), check_writable(output_dir / "demo.png")
    maps, found = {}, {}
    for column, title in COLUMNS.items():
        grid = tsing_shan_valley()
        progress = Progress(label=f"{title:>9}")
        numerics = {"particle_count": particles}
        columns = {"law": column, "levels": LEVELS}
        flow = DebrisFlow(grid, column=columns, material=MATERIAL, numerics=numerics, observers=[progress])
        before, cpu = flow.maps, time.process_time()
        flow.run_until_rest()
        cpu = time.process_time() - cpu
        maps[column] = flow.maps
        found[title] = measure(flow, before) | {"CPU time [s]": cpu}
    console.print(_table(found, particles))
    console.print(EXPLANATION, highlight=False)
    both = _side_by_side(maps)
    write_dataset(data_path, both)
    save_figure(_figure(both, before.topographic__elevation, found), figure_path)
    console.print(f"Wrote {data_path} and {figure_path}", highlight=False, soft_wrap=True)
    return found


def measure(flow, before) -> dict[str, float]:
    """Return the measures of one run by name with unit; distances are along the valley.

    Parameters
    ----------
    flow : DebrisFlow
        At rest, on the terrain of `tsing_shan_valley`.
    before : xarray.Dataset
        Its maps before the event.

    Returns
    -------
    dict of str to float
    """
    elevation, x = before.topographic__elevation.values, before.x.values
    axis = elevation[elevation.shape[0] // 2]
    contour = np.interp(-NON_ERODIBLE_BELOW, -axis, x)
    run = measures(flow, distance=lambda x, y: x, front_fraction=FRONT_FRACTION)
    plain = measures(flow, inside=elevation < NON_ERODIBLE_BELOW, deposit_threshold=DEPOSIT)
    crown = np.flatnonzero((before.debris_flow__release_depth.values > 0.0).any(axis=0))[0]
    front = np.flatnonzero(x == float(run.run_out))[0]
    return {
        "released [m3]": float(run.budget_released),
        "eroded [m3]": float(run.budget_eroded),
        "final volume [m3]": float(run.budget_deposited),
        "deepest erosion [m]": float(run.max_eroded_depth),
        "run-out of the front beyond the 100 m contour [m]": x[front] - contour,
        "run-out of the farthest particle [m]": float(run.farthest_run_out) - contour,
        "travel angle [deg]": np.degrees(np.arctan2(axis[crown] - axis[front], x[front] - x[crown])),
        "largest speed [m/s]": float(run.max_speed),
        "largest depth [m]": float(run.max_depth),
        "median deposit below 100 m [m]": float(plain.median_deposit_depth),
        "basal Péclet number, largest [-]": float(run.max_basal_peclet_number),
        "basal Péclet number, typical [-]": float(run.median_basal_peclet_number),
        "duration of the event [s]": flow.elapsed_time,
        "outflow over the edges [m3]": float(run.budget_outflow),
        "residual of the mass balance [m3]": float(run.budget_residual),
    }


EXPLANATION = f"""\
All parameters are those of Pastor et al. (2022) for Tsing Shan, or defaults; they are no recommendation for another \
site. Front: where {FRONT_FRACTION:.0%} of the deposit lies behind. Distances are plan distances; the travel angle is \
from the crown of the trigger to the front (26 deg in the real event; this terrain is a stand-in, and the small \
viscosity and the basal slip of the paper are left out). The median deposit counts nodes with at least {DEPOSIT:g} m. \
Péclet numbers: largest and median of the peaks at the eroded nodes. CPU time includes loading (the first time: \
compiling) the kernels, which falls on the first model. tan(phi) = 0.6 acts on the buoyant weight: the apparent \
friction is 0.30 without excess pore pressure and 0.10 at the bed's ratio of 0.65."""


def _table(found, particles):
    table = Table(title=f"A valley with the numbers of Tsing Shan, {particles} particles", title_justify="left")
    table.add_column("")
    for title in found:
        table.add_column(title, justify="right")
    for name in next(iter(found.values())):
        table.add_row(escape(name), *(_number(values[name]) for values in found.values()))
    return table


def _number(value):
    if value == 0.0:
        return "0"
    if abs(value) < 1e-3:
        return f"{value:.1e}"
    return f"{value:,.0f}".replace(",", " ") if abs(value) >= 100.0 else f"{value:.2f}"


def _side_by_side(maps):
    """Join the maps of both models along a dimension ``column``, with their budgets as variables."""
    names = list(maps)
    both = stack(list(maps.values()), "column", names, long_name="law of the pore pressure column")
    for units, unit in maps[names[0]].attrs.items():
        if units.startswith(("budget", "elapsed_time")) and units.endswith("_units"):
            name = units.removesuffix("_units")
            values = [maps[column].attrs[name] for column in names]
            both[name] = ("column", values, {"units": unit, "long_name": name.replace("_", " ")})
    return both


TITLES = {
    "ale": "ALE: soil enters the column of pore pressure from below",
    "classical": "Classical: soil that enters is felt at the base only",
}
"""Headings of the two columns of the figure."""

NUMBERS = {
    "run-out {:.0f} m beyond the dashed line": "run-out of the front beyond the 100 m contour [m]",
    "eroded {:,.0f} m³": "eroded [m3]",
    "final volume {:,.0f} m³": "final volume [m3]",
    "travel angle {:.0f}°": "travel angle [deg]",
}
"""Numbers in the figure, and their names in the table."""

SOURCE_OF_VALUES = "parameters of Pastor et al. (2022) for Tsing Shan, which are no recommendation for another site"


def _figure(both, relief, found):
    def panels(field, titles=("", " ")):
        return {title: both[field].sel(column=name) for title, name in zip(titles, COLUMNS, strict=True)}

    deep = both.debris_flow__max_depth >= DEPOSIT
    ratio = both.assign(ratio=both.debris_flow__max_basal_pressure_ratio.where(deep))
    layers = [
        Layer(panels("debris_flow__max_depth", TITLES.values()), "peak depth [m]", "YlGnBu", threshold=DEPOSIT),
        Layer(
            {title: ratio.ratio.sel(column=name) for title, name in zip(("", " "), COLUMNS, strict=True)},
            "peak basal pressure ratio [–]", "BuGn", (0.0, 0.8),
        ),
        Layer(panels("debris_flow__deposit_depth"), "deposit [m]", "PuBu", threshold=DEPOSIT),
    ]  # fmt: skip
    figure = draw_maps(
        layers, relief, contours=(NON_ERODIBLE_BELOW,), margin=25.0,
        note=f"dashed: {NON_ERODIBLE_BELOW:g} m contour, below which nothing erodes; {SOURCE_OF_VALUES}",
    )  # fmt: skip
    arrow = {"arrowstyle": "-|>", "color": "black", "linewidth": 1.0}
    for axes in figure.axes[:2]:
        axes.annotate(
            "downhill", (0.17, 0.88), (0.015, 0.88), xycoords="axes fraction", textcoords="axes fraction",
            fontsize="small", va="center", arrowprops=arrow,
        )  # fmt: skip
    for axes, measured in zip(
        figure.axes[4:6], found.values(), strict=True
    ):  # of the deposit, where the valley is empty
        axes.text(
            0.015, 0.93, _numbers(measured), transform=axes.transAxes, fontsize="small", va="top", linespacing=1.4
        )
    released = f"{found[next(iter(found))]['released [m3]']:,.0f}".replace(",", "\u2009")
    title = f"One landslide of {released} m³ in one valley, with two models of pore pressure"
    figure.suptitle(title, fontsize="large")
    return figure


def _numbers(measured) -> str:
    """Return the numbers of a run, a line each."""
    return "\n".join(text.format(measured[name]).replace(",", "\u2009") for text, name in NUMBERS.items())
