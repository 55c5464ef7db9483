"""How scars of four kinds empty, beside the same bodies laid on top of the ground: python -m benchmarks.releases

A square of 40 m on planes of 20 and 30 degrees that end in a level 190 m below its lower rim; 2 m at its deepest;
Voellmy friction, no erosion, 1000 particles. "Source" is the square and 20 m below it. Then the scars of three kinds in
the polygon of S-1000 (folder of its rasters in $DEBRISFLOW_DATA), of the observed volume, against the observed one.

Prints the tables and writes them into benchmarks/releases.txt. Their figure: benchmarks/failure_surfaces.py.
"""

import argparse
import itertools
import logging
import os
from pathlib import Path
from typing import NamedTuple

import numpy as np
from landlab import RasterModelGrid
from landlab.io import esri_ascii
from rich.console import Console
from rich.table import Table

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.scene import failing_depth, lay_on_top

HERE = Path(__file__).parent
KINDS = ("uniform", "tapered", "sloping_local_base_level", "ellipsoid")
WORDS = {"sloping_local_base_level": "base level"}
CENTRE, HALF, DEEPEST = (40.0, 80.0), 20.0, 2.0  # of the square [m]
FOOT, SOURCE = 250.0, 80.0  # where the plane and where the source ends [m]
EARLY = 20.0  # [s]
S1000_CELL, NODATA = 10.0, -9999.0


class Emptying(NamedTuple):
    """How a body leaves its source: volume [m3], peak depth there over the deepest of the release, parts that stay.

    `early` is after 20 s, `left` at the end [-]; `duration` is in s.
    """

    volume: float
    peak: float
    early: float
    left: float
    duration: float


def square_on_plane(degrees: float, spacing: float):
    """Return a grid with a plane, and the nodes of the square."""
    grid = RasterModelGrid((int(160 / spacing) + 1, int(500 / spacing) + 1), xy_spacing=spacing)
    x, y = grid.x_of_node, grid.y_of_node
    grid.add_field("topographic__elevation", np.tan(np.radians(degrees)) * np.maximum(0.0, FOOT - x), at="node")
    return grid, (abs(x - CENTRE[0]) < HALF) & (abs(y - CENTRE[1]) < HALF)


def empty(kind, degrees, spacing, on_top, particles=1000, rest_energy=1e-4, floor_fall=0.8, longest=3600.0) -> Emptying:
    """Return how a body of 2 m at its deepest leaves the square, out of the ground or laid on it."""
    grid, inside = square_on_plane(degrees, spacing)
    depth = failing_depth(grid, inside, kind=kind, largest_depth=DEEPEST, floor_fall=floor_fall)
    if on_top:
        lay_on_top(grid, depth)
    else:
        grid.add_field("debris_flow__release_depth", depth, at="node")
    flow = DebrisFlow(
        grid, friction="voellmy", erosion="none",
        numerics={"particle_count": particles, "rest_energy": rest_energy},
    )  # fmt: skip
    flow.run_until_rest(EARLY)
    early = in_source(flow)
    if not flow.at_rest:
        flow.run_until_rest(longest - EARLY)
    peak = grid.at_node["debris_flow__max_depth"][grid.x_of_node < SOURCE].max() / DEEPEST
    return Emptying(flow.budget["released"], peak, early, in_source(flow), flow.elapsed_time)


def in_source(flow) -> float:
    """Return the part of the release that is in the source now [-], moving or laid down."""
    grid, p = flow.grid, flow.particles
    laid = grid.at_node["debris_flow__deposit_depth"] * grid.dx * grid.dy
    volume = float(p.volume[p.x < SOURCE].sum()) if p.x.size else laid[grid.x_of_node < SOURCE].sum()
    return volume / flow.budget["released"]


def table_of_planes() -> Table:
    """Return the table of kinds, slopes and cells."""
    table = Table(title="Out of the ground / laid on top", title_justify="left")
    for heading in (
        "kind", "slope\n[deg]", "cell\n[m]", "volume\n[m3]", "peak depth in the\nsource / deepest [-]",
        "in the source\nafter 20 s [%]", "left at rest\n[%]", "rest after\n[s]",
    ):  # fmt: skip
        table.add_column(heading, justify="left" if heading == "kind" else "right")
    for kind in KINDS:
        for degrees, spacing in itertools.product((20.0, 30.0), (1.0, 2.0, 5.0)):
            dug, laid = (empty(kind, degrees, spacing, on_top) for on_top in (False, True))
            table.add_row(
                WORDS.get(kind, kind), f"{degrees:g}", f"{spacing:g}", f"{dug.volume:.0f}",
                f"{dug.peak:.2f} / {laid.peak:.2f}", f"{100 * dug.early:.0f} / {100 * laid.early:.0f}",
                f"{100 * dug.left:.0f} / {100 * laid.left:.0f}", f"{dug.duration:.0f} / {laid.duration:.0f}",
            )  # fmt: skip
        table.add_section()
    return table


def table_of_rims() -> Table:
    """Return the table of what stays on floors of other falls on 20 degrees if no body is arrested while it creeps."""
    table = Table(
        title="Tapered, 20 deg, cells of 2 m, nothing arrested (rest_energy = 0), after 2400 s", title_justify="left"
    )
    for heading in (
        "fall of the floor /\nfall of the ground [-]", "slope of the\nfloor [deg]", "peak / deepest\n[-]",
        "left / laid on top\n[%]",
    ):  # fmt: skip
        table.add_column(heading, justify="right")
    for fall in (0.0, 0.5, 0.8, 0.9):
        runs = [empty("tapered", 20.0, 2.0, top, rest_energy=0.0, floor_fall=fall, longest=2400.0) for top in (0, 1)]
        floor = np.degrees(np.arctan(fall * np.tan(np.radians(20.0))))
        table.add_row(
            f"{fall:g}", f"{floor:.1f}", f"{runs[0].peak:.2f}", f"{100 * runs[0].left:.0f} / {100 * runs[1].left:.0f}"
        )
    return table


def read_s1000():
    """Return a grid with the terrain of S-1000, and the observed depth of its scar, shape (nodes,) [m], or None."""
    folder = Path(os.environ.get("DEBRISFLOW_DATA", HERE.parents[1] / "shared" / "data")) / "s1000"
    if not (folder / "landslide_depth.asc").is_file():
        return None
    grids = []
    for name in ("pre_runout_DEM", "landslide_depth"):
        with (folder / f"{name}.asc").open() as stream:
            grids.append(esri_ascii.load(stream, at="node", name=name))
    grid, depth = grids[0], grids[1].at_node["landslide_depth"]
    elevation = grid.add_field("topographic__elevation", grid.at_node["pre_runout_DEM"].astype(float), at="node")
    grid.set_nodata_nodes_to_closed(elevation, NODATA)
    return grid, np.where(depth == NODATA, 0.0, -depth)


def table_of_s1000() -> Table | str:
    """Return the table of the kinds against the observed scar."""
    found = read_s1000()
    if found is None:
        return "S-1000: no rasters in $DEBRISFLOW_DATA"
    grid, observed = found
    inside, volume = observed > 0.0, observed.sum() * S1000_CELL**2
    table = Table(
        title=f"S-1000: {volume:.0f} m3 in {inside.sum()} cells of 10 m, {observed.max():.1f} m at the deepest",
        title_justify="left",
    )  # fmt: skip
    for heading in ("kind", "deepest [m]", "rms of depth [m]", "correlation [-]"):
        table.add_column(heading, justify="left" if heading == "kind" else "right")
    for kind in KINDS:
        depth = failing_depth(grid, inside, kind=kind, volume=volume)[inside]
        rms = np.sqrt(np.mean((depth - observed[inside]) ** 2))
        alike = "" if kind == "uniform" else f"{np.corrcoef(depth, observed[inside])[0, 1]:.2f}"
        table.add_row(WORDS.get(kind, kind), f"{depth.max():.1f}", f"{rms:.2f}", alike)
    return table


def main() -> None:
    argparse.ArgumentParser(description=__doc__.splitlines()[0]).parse_args()
    logging.getLogger("landlab_debrisflow").setLevel(logging.ERROR)  # pits are expected here
    with (HERE / "releases.txt").open("w", encoding="utf-8") as file:
        consoles = Console(width=120), Console(file=file, width=120)
        for build in (table_of_s1000, table_of_planes, table_of_rims):
            table = build()
            for console in consoles:
                console.print(table)


if __name__ == "__main__":
    main()
