"""Which cell size: the same ground on cells of several sizes: ``python -m benchmarks.cell_size``

Three scenes. *Channel*: a bent trough, 40 m between its banks, that a flow erodes and leaves over a fan. *Slope*: a
body 40 m across on an even slope that flattens. Both are known everywhere, and a DEM has the mean over each of its
cells, as a resampled survey has. *S-1000* (rasters in $DEBRISFLOW_DATA, else ../shared/data): its cells of 10 m, means
of four of them, and 5 m, interpolated, which adds no ground that the survey did not see.

The first two lie on the raster in three ways, shifted by thirds of a cell: their mean counts, and the spread is shown.
All with 4000 particles, so that what differs is the raster. Prints the table and writes benchmarks/cell_size.txt;
docs/cell_size.md quotes it.
"""

import logging
import sys
import time
from pathlib import Path

import numpy as np
from landlab import RasterModelGrid
from rich.console import Console
from rich.table import Table
from scipy.interpolate import RegularGridInterpolator

from landlab_debrisflow import DebrisFlow, InputError
from landlab_debrisflow.fidelity.quantities import origin_of, quantities
from landlab_debrisflow.record import write_atomically

HERE = Path(__file__).parent
sys.path.append(str(HERE.parent / "examples"))
from s1000 import NODATA, build_grid, find_data  # noqa: E402  # an example is no package

ELEVATION, SOIL, RELEASE = "topographic__elevation", "soil__depth", "debris_flow__release_depth"
PARTICLES = 4000
ACROSS = 40.0
"""Width of the channel between its banks, and of the body on the slope [m]."""

CELLS = (2.5, 5.0, 10.0, 20.0, 40.0)
"""Sizes of cells [m]; the finest is what the others are compared with."""

SHIFTS = (0.0, 1.0 / 3.0, 2.0 / 3.0)
LENGTH, HALF_WIDTH = 1000.0, 120.0  # of the ground [m]
FINE = 1.25
"""Longest distance of the points over which a cell has its mean [m]."""

SHOWN = {"run_out": "run-out", "speed": "speed", "depth": "peak depth", "area": "area", "eroded": "eroded"}
VOELLMY = {"law": "voellmy", "basal_friction_angle": 25.0, "turbulent_coefficient": 400.0}
SCENES = {
    "channel": {
        "friction": VOELLMY, "erosion": {"law": "growth", "growth_rate": 2e-3},
        "material": {
            "initial_pressure_ratio": 0.5, "bed_pressure_ratio": 0.5, "coefficient_of_consolidation": 1e-3
        },
    },
    "slope": {
        "friction": VOELLMY, "erosion": {"law": "none"},
        "material": {"initial_pressure_ratio": 0.5, "coefficient_of_consolidation": 1e-3},
    },
    "S-1000": {
        "friction": {"law": "voellmy", "basal_friction_angle": 31.0, "turbulent_coefficient": 200.0},
        "erosion": {"law": "growth", "growth_rate": 1.6e-3},
        "material": {
            "initial_pressure_ratio": 0.2, "bed_pressure_ratio": 0.2, "coefficient_of_consolidation": 4e-4
        },
    },
}  # fmt: skip


def main():
    """Run all scenes, print the table and write it."""
    logging.getLogger("landlab_debrisflow").setLevel(logging.ERROR)
    table = Table("scene", "cell [m]", "across", *SHOWN.values(), "CPU [s]")
    table.title = f"Change against the finest cells [%], {PARTICLES} particles; in brackets the range over three shifts"
    table.caption = "across: cells over the width of the channel or of the body that fails"
    for name in ("channel", "slope"):
        rows = {cell: [run(name, synthetic(name, cell, shift)) for shift in SHIFTS] for cell in CELLS}
        add_rows(table, name, rows, {cell: ACROSS / cell for cell in CELLS}, CELLS[0])
    try:
        data = find_data()
    except InputError as reason:
        print(f"S-1000 is left out: {reason}")
    else:
        rows = {cell: [run("S-1000", s1000(data, cell))] for cell in (5.0, 10.0, 20.0)}
        width = np.sqrt(rows[10.0][0]["source"])
        add_rows(table, "S-1000", rows, {cell: width / cell for cell in rows}, 10.0)
    console = Console(width=140, record=True)
    console.print(table)
    write_atomically(HERE / "cell_size.txt", lambda to: Path(to).write_text(console.export_text(), encoding="utf-8"))


def add_rows(table, name, rows, across, reference):
    """Add a row per size of cells, as change against those of the reference."""
    truth = {key: np.mean([one[key] for one in rows[reference]]) for key in SHOWN}
    for cell, runs in rows.items():
        texts = []
        for key in SHOWN:
            if truth[key] == 0.0:
                texts.append("-")
                continue
            change = [100.0 * (one[key] / truth[key] - 1.0) for one in runs]
            spread = f" ({max(change) - min(change):.1f})" if len(change) > 1 else ""
            texts.append(f"{np.mean(change):+.1f}{spread}")
        seconds = np.median([one["seconds"] for one in runs])
        table.add_row(name, f"{cell:g}", f"{across[cell]:.1f}", *texts, f"{seconds:.1f}")
    table.add_section()


def run(name, grid):
    """Return the quantities of a scene on a grid, the area of its release [m2] and its CPU time [s]."""
    source = float((grid.at_node[RELEASE] > 0.0).sum() * grid.dx * grid.dy)
    flow = DebrisFlow(grid, **SCENES[name], numerics={"particle_count": PARTICLES, "preset": "fast", "settle": False})
    origin = origin_of(grid, flow.setup)
    began = time.process_time()
    flow.run_until_rest(900.0)
    return quantities(flow, origin) | {"source": source, "seconds": time.process_time() - began}


# ---- ground ----


def synthetic(name, cell, shift):
    """Return the grid of channel or slope on cells [m], shifted by a part of a cell along both axes."""
    rows, columns = round(2.0 * HALF_WIDTH / cell) + 1, round(LENGTH / cell) + 1
    corner = (shift * cell, -HALF_WIDTH + shift * cell)
    grid = RasterModelGrid((rows, columns), xy_spacing=cell, xy_of_lower_left=corner)
    parts = max(1, round(cell / FINE))
    offsets = (np.arange(parts) + 0.5) / parts * cell - 0.5 * cell
    sums = np.zeros((3, grid.number_of_nodes))
    for dx in offsets:
        for dy in offsets:
            sums += GROUND[name](grid.x_of_node + dx, grid.y_of_node + dy)
    for field, values in zip((ELEVATION, RELEASE, SOIL), sums / parts**2, strict=True):
        grid.add_field(field, values, at="node")
    grid.at_node[RELEASE][grid.boundary_nodes] = 0.0  # of the largest cells the rim of the body reaches one
    return grid


def profile(x, steep, flat, bend, over):
    """Return the elevation of a slope that turns from one gradient to another around a place, over a length [m]."""
    t = (x - bend) / over
    return -flat * x - (steep - flat) * (x - over * np.logaddexp(0.0, t))


def channel(x, y):
    """Return elevation, thickness that fails and soil of a bent channel that ends on a fan [m]."""
    off = (y - 15.0 * np.sin(2.0 * np.pi * x / 240.0)) / (0.5 * ACROSS)
    confined = 0.5 * (1.0 - np.tanh((x - 620.0) / 60.0))
    banks = 8.0 * confined * (1.0 - np.exp(-2.0 * off**2))
    fails = 3.0 * np.maximum(0.0, 1.0 - ((x - 80.0) / 40.0) ** 2 - off**2)
    soil = np.where((np.abs(off) < 1.0) & (x < 620.0), 1.0, 0.0)
    return profile(x, 0.45, 0.08, 620.0, 40.0) + banks, fails, np.maximum(soil, fails)


def slope(x, y):
    """Return elevation, thickness that fails and soil of an even slope that flattens [m]."""
    fails = 3.0 * np.maximum(0.0, 1.0 - ((x - 80.0) ** 2 + y**2) / (0.5 * ACROSS) ** 2)
    return profile(x, 0.55, 0.05, 400.0, 40.0), fails, fails


GROUND = {"channel": channel, "slope": slope}


def s1000(data, cell):
    """Return the grid of S-1000 on cells of 5, 10 or 20 m."""
    source = build_grid(data)
    if cell == source.dx:
        return source
    shape, factor = source.shape, cell / source.dx
    values = {name: source.at_node[name].reshape(shape) for name in (ELEVATION, RELEASE, SOIL)}
    known = values[ELEVATION] != NODATA
    y, x = (source.dx * np.arange(n) for n in shape)
    if factor > 1.0:
        n = round(factor)
        rows, columns = shape[0] // n, shape[1] // n
        cut = np.s_[: rows * n, : columns * n]
        mean = {k: v[cut].reshape(rows, n, columns, n).mean(axis=(1, 3)) for k, v in values.items()}
        whole = known[cut].reshape(rows, n, columns, n).all(axis=(1, 3))
    else:
        to_y, to_x = np.arange(0.0, y[-1] + 0.1, cell), np.arange(0.0, x[-1] + 0.1, cell)
        points = np.stack(np.meshgrid(to_y, to_x, indexing="ij"), axis=-1)
        mean = {k: RegularGridInterpolator((y, x), v)(points) for k, v in values.items()}
        whole = RegularGridInterpolator((y, x), known.astype(float))(points) > 1.0 - 1e-9
        # interpolated means lose volume at peaks, which the release must not
        mean[RELEASE] *= values[RELEASE].sum() * source.dx**2 / (mean[RELEASE].sum() * cell**2)
    grid = RasterModelGrid(mean[ELEVATION].shape, xy_spacing=cell)
    for name, of_cells in mean.items():
        grid.add_field(name, np.where(whole, of_cells, NODATA if name == ELEVATION else 0.0), at="node")
    grid.at_node[SOIL][:] = np.maximum(grid.at_node[SOIL], grid.at_node[RELEASE])
    grid.set_nodata_nodes_to_closed(grid.at_node[ELEVATION], NODATA)
    return grid


if __name__ == "__main__":
    main()
