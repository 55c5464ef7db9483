"""A debris flow comes out of a channel and meets a row of buildings, or a dam before them.

    python examples/obstacle.py --output obstacle.png

Buildings are closed nodes: no debris gets in, and their faces show the impact of the flow. The dam is raised terrain,
which a flow runs up, and overtops if it is too low. Results are the peak impact pressure, density x speed^2, and the
run-up, the height of the surface above the lowest bed that the debris came over
(landlab_debrisflow/model/peak_maps.py).
"""

import argparse
import sys

import numpy as np
from landlab import RasterModelGrid
from matplotlib.figure import Figure
from rich.console import Console
from rich.table import Table

from landlab_debrisflow import DebrisFlow, InputError, ParameterError, measures
from landlab_debrisflow.plots import draw_map, save_figure
from landlab_debrisflow.record import check_writable

SPACING, LENGTH, WIDTH = 4.0, 480.0, 160.0  # of the grid [m]
FOOT = 240.0  # where the channel of 25 degrees opens onto a fan of 4 [m]
CHANNEL_DEPTH, CHANNEL_WIDTH = 8.0, 30.0  # [m]
VOLUME = 4000.0  # released [m3]

BUILDINGS_AT, SIDE, GAP, ROW = 320.0, 12.0, 12.0, 3  # where, how large, how far apart [m] and how many
DAM_AT, DAM_HEIGHT, DAM_WIDTH = 290.0, 6.0, 8.0  # crest, height, half-width at 1/e of the height [m]

SHOWN = (200.0, 380.0)  # x in the figure [m]

IMPACT, RUN_UP = "debris_flow__max_impact_pressure", "debris_flow__max_run_up"


def terrain(dam: bool) -> RasterModelGrid:
    """Return channel and fan with the release at its head and the buildings, with or without the dam."""
    shape = round(WIDTH / SPACING) + 1, round(LENGTH / SPACING) + 1
    grid = RasterModelGrid(shape, xy_spacing=SPACING)
    x, y = grid.x_of_node, grid.y_of_node - 0.5 * WIDTH
    along = np.linspace(0.0, LENGTH, 1001)
    blend = 1.0 / (1.0 + np.exp((along - FOOT) / 15.0))
    fall = np.tan(np.radians(4.0 + 21.0 * blend))
    profile = np.cumsum(fall[::-1])[::-1] * (along[1] - along[0])
    banks = CHANNEL_DEPTH * (1.0 - np.exp(-((2.0 * y / CHANNEL_WIDTH) ** 2))) * np.interp(x, along, blend)
    elevation = np.interp(x, along, profile) + banks
    if dam:
        elevation += DAM_HEIGHT * np.exp(-(((x - DAM_AT) / DAM_WIDTH) ** 2))
    cap = np.maximum(0.0, 1.0 - ((x - 60.0) / 30.0) ** 2 - (y / 14.0) ** 2)
    grid.add_field("topographic__elevation", elevation, at="node")
    grid.add_field("debris_flow__release_depth", cap * VOLUME / (cap.sum() * SPACING**2), at="node")
    grid.status_at_node[buildings(grid)] = grid.BC_NODE_IS_CLOSED
    return grid


def buildings(grid):
    """Return which nodes are inside of buildings, shape (nodes,) bool."""
    middles = 0.5 * WIDTH + (SIDE + GAP) * (np.arange(ROW) - 0.5 * (ROW - 1))
    beside = np.any(abs(grid.y_of_node - middles[:, None]) < 0.5 * SIDE, axis=0)
    return beside & (abs(grid.x_of_node - BUILDINGS_AT) < 0.5 * SIDE)


def main(output=None, particles: int = 2000) -> dict[str, dict[str, float]]:
    """Run both cases, print their measures, and draw the figure if `output` is given.

    Parameters
    ----------
    output : path, optional
        File for the figure.
    particles : int
        Number of particles of the release.

    Returns
    -------
    dict
        The measures of `measure` without and with the dam.

    Raises
    ------
    InputError, ParameterError
        If the figure cannot be written or `particles` is out of bounds; nothing was computed.
    """
    path = None if output is None else check_writable(output)
    found, maps = {}, {}
    for name, dam in (("buildings", False), ("dam and buildings", True)):
        grid = terrain(dam)
        flow = DebrisFlow(grid, friction="voellmy", erosion="none", numerics={"particle_count": particles})
        flow.run_until_rest()
        maps[name] = flow.maps
        found[name] = measure(flow)
    console = Console()
    console.print(table(found, particles))
    if path is not None:
        save_figure(draw(maps, buildings(grid).reshape(grid.shape)), path)
        console.print(f"Wrote {path}", highlight=False, soft_wrap=True)
    return found


def measure(flow) -> dict[str, float]:
    """Return the measures of one run for the design of obstacles: name with unit, and value."""
    x = flow.grid.x_of_node
    at_buildings, on_dam, before_dam, beyond = (
        measures(flow, inside=part)
        for part in (buildings(flow.grid), abs(x - DAM_AT) <= DAM_WIDTH, abs(x - 265.0) < 5.0, x > DAM_AT + DAM_WIDTH)
    )
    found = {
        "peak impact on buildings [kPa]": 1e-3 * at_buildings.max_impact_pressure,
        "peak run-up at buildings [m]": at_buildings.max_run_up,
        "peak impact where the dam is [kPa]": 1e-3 * on_dam.max_impact_pressure,
        "peak run-up where the dam is [m]": on_dam.max_run_up,
        "energy head before the dam [m]": before_dam.max_speed**2 / 19.62,
        "deposit beyond the dam [m3]": beyond.deposit_volume,
        "volume released [m3]": flow.budget["released"],
        "residual of the mass balance [m3]": flow.budget["residual"],
    }
    return {name: float(value) for name, value in found.items()}


def table(found, particles: int) -> Table:
    """Return the measures of both runs side by side."""
    shown = Table(title=f"Obstacles below a channel, {particles} particles", title_justify="left")
    for heading in ("", *found):
        shown.add_column(heading, justify="left" if heading == "" else "right")
    for name in next(iter(found.values())):
        values = [run[name] for run in found.values()]
        shown.add_row(name.replace("[", r"\["), *(f"{v:.1e}" if 0.0 < abs(v) < 1e-3 else f"{v:.1f}" for v in values))
    return shown


def draw(maps, inside) -> Figure:
    """Return the figure: impact pressure and run-up of both runs around the obstacles, which are outlined."""
    figure = Figure(figsize=(11.0, 9.0), layout="constrained")
    run = next(iter(maps.values()))
    obstacles = run[IMPACT].copy(data=inside)
    extent = (*SHOWN, 0.0, float(run.y[-1]))
    shown = (IMPACT, 1e-3, "Peak impact pressure"), (RUN_UP, 1.0, "Peak run-up")
    for row, (field, factor, words) in zip(figure.subplots(2, 2), shown, strict=True):
        most = max(float(factor * run[field].sel(x=slice(*SHOWN)).max()) for run in maps.values())
        for axes, (name, run) in zip(row, maps.items(), strict=True):
            title = f"{words}, {name}"
            draw_map(run, field, axes=axes, title=title, extent=extent, limits=(0.0, most), outline=obstacles)
    return figure


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", help="file for the figure")
    parser.add_argument("--particles", type=int, default=2000)
    words = parser.parse_args()
    try:
        main(words.output, words.particles)
    except (InputError, ParameterError) as error:
        sys.exit(f"obstacle: {error}")
