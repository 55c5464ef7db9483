"""The debris flow of Tsing Shan, 1990, with both models: Pastor et al. (2022), section 4.2, figures 14 to 22.

    python examples/tsing_shan.py --output-dir results
    python examples/tsing_shan.py --dem dem.asc --release release.asc --erodible soil.asc

The terrain of the event is not public. Without rasters the runs are on a stand-in (`tsing_shan_valley`): a synthetic
valley with the volumes and the fall of Tsing Shan, and a channel of the length that the growth of the flow requires.
The actual terrain may be given as ESRI ASCII files: elevation, thickness released and erodible depth [m].

Parameters are those of section 4.2.2 and were written down, with the terrain, before ALE was first compared with the
classical model here. Nothing is calibrated; the travel angle is a result.
"""

import argparse
import itertools
import sys
from pathlib import Path

import numpy as np
from landlab.io import esri_ascii
from rich.console import Console
from tsing_shan_figures import draw_columns, draw_flow, draw_maps_of, print_table
from tsing_shan_record import Record

from landlab_debrisflow import DebrisFlow, InputError, ParameterError
from landlab_debrisflow.plots import save_figure
from landlab_debrisflow.record import check_writable, stack, write_dataset
from landlab_debrisflow.scene import tsing_shan_valley

# ---- the parameters of section 4.2.2 ----

FRICTION = {"law": "coulomb", "basal_friction_angle": float(np.degrees(np.arctan(0.6))), "viscosity": 0.5}
"""tan(phi) = 0.6; viscosity [Pa s] of a velocity that grows linearly with height."""

EROSION = {"law": "growth", "growth_rate": 3e-3}
"""McDougall & Hungr's law [m-1]."""

MATERIAL = {
    "initial_pressure_profile": "basal_layer", "basal_layer_fraction": 0.1, "initial_pressure_ratio": 0.65,
    "bed_pressure_ratio": 0.65, "basal_slip_ratio": 1.0 / 3.0,
}  # fmt: skip
"""A basal layer of h/10 and the bed have 0.65 of the liquefaction pressure. The velocity at the base is 0.2 of that at
the surface; with a linear profile that is 1/3 of the mean."""

CONSOLIDATION = (4e-4, 0.4)
"""c_v of the case, and the thousandfold one for comparison [m2 s-1]."""

DURATION = 400.0  # [s]

VALLEY = {"runout_length": 3000.0}
"""Values of the stand-in that differ from the defaults of its generator. A run-out length of 1400 m was enough except
for `loading` "none", as a run showed: the extent of the grid, not the ground, was then changed."""

# ---- numerics ----

COLUMNS = {"ALE": "ale", "classical": "classical"}

LEVELS = 41
"""Levels of both columns: the classical one keeps its pressure in a layer that 11 levels do not resolve
(docs/decisions.md)."""

NODATA = -9999.0


def main(particles=2000, output_dir=".", rasters=None, loading="overburden", duration=DURATION):
    """Run both models with both coefficients of consolidation, and print and draw the results.

    Parameters
    ----------
    particles : int
        Number of particles of the release.
    output_dir : path
        Existing directory for the results.
    rasters : tuple of path, optional
        ESRI ASCII files of elevation, thickness released and erodible depth [m]; by default the stand-in.
    loading : str
        What a change of thickness does to the pressure, the columns' ``loading_source``.
    duration : float
        Length of the runs [s].

    Returns
    -------
    dict
        A `Record` for each (model, c_v).
    """
    console, output_dir = Console(width=120), Path(output_dir)
    names = ("tsing_shan.nc", "tsing_shan_flow.png", "tsing_shan_maps.png", "tsing_shan_columns.png")
    paths = [check_writable(output_dir / name) for name in names]
    build = (lambda: tsing_shan_valley(**VALLEY)) if rasters is None else lambda: read_terrain(*rasters)
    records = {
        (model, c_v): run(build(), model, c_v, particles, loading, duration)
        for c_v, model in itertools.product(CONSOLIDATION, COLUMNS)
    }
    where = "a stand-in for Tsing Shan" if rasters is None else str(rasters[0])
    print_table(console, records, f"{where}: {particles} particles, loading source {loading}")
    write_dataset(paths[0], collect(records))
    figures = (draw_flow(records, CONSOLIDATION[0]), draw_maps_of(records), draw_columns(records))
    for figure, path, dpi in zip(figures, paths[1:], (70, 90, 100), strict=True):
        save_figure(figure, path, dpi)
    console.print("Wrote " + ", ".join(str(path) for path in paths), highlight=False, soft_wrap=True)
    return records


def run(grid, model, c_v, particles, loading="overburden", duration=DURATION, levels=LEVELS):
    """Run one event and return its `Record`.

    Parameters
    ----------
    grid : RasterModelGrid
        With elevation, soil and release; it is changed.
    model : str
        One of `COLUMNS`.
    c_v : float
        Coefficient of consolidation [m2 s-1].
    particles, loading, duration
        As in `main`.
    levels : int
        Of the columns.
    """
    record = Record(grid)
    flow = DebrisFlow(
        grid, friction=FRICTION, erosion=EROSION, material=MATERIAL | {"coefficient_of_consolidation": c_v},
        column={"law": COLUMNS[model], "levels": levels, "loading_source": loading},
        numerics={"particle_count": particles, "settle": False},
    )  # fmt: skip
    record.follow(flow, duration)
    return record


def read_terrain(dem, release, erodible):
    """Return the grid of a user's rasters; where the elevation has no data, nodes are closed."""
    with open(dem) as stream:
        grid = esri_ascii.load(stream, at="node", name="topographic__elevation")
    elevation = grid.at_node["topographic__elevation"] = grid.at_node["topographic__elevation"].astype(float)
    grid.set_nodata_nodes_to_closed(elevation, NODATA)
    for path, name in ((release, "debris_flow__release_depth"), (erodible, "soil__depth")):
        with open(path) as stream:
            other = esri_ascii.load(stream, at="node", name=name)
        if other.shape != grid.shape or other.dx != grid.dx:
            raise InputError(
                f"{path} has {other.shape} nodes every {other.dx:g} m, {dem} has {grid.shape} every {grid.dx:g} m; "
                "give rasters of the same extent and spacing"
            )
        values = other.at_node[name].astype(float)
        grid.add_field(name, np.where(values == NODATA, 0.0, values), at="node", units="m")
    # the release is soil, too
    np.maximum(grid.at_node["soil__depth"], grid.at_node["debris_flow__release_depth"], out=grid.at_node["soil__depth"])
    return grid


def collect(records):
    """Return the maps of all runs along ``run``."""
    names = [f"{model}, c_v = {c_v:g} m2 s-1" for model, c_v in records]
    return stack([record.maps for record in records.values()], "run", names)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--dem", help="elevation, ESRI ASCII [m]")
    parser.add_argument("--release", help="thickness released [m]")
    parser.add_argument("--erodible", help="erodible depth [m]")
    parser.add_argument("--particles", type=int, default=2000)
    parser.add_argument("--loading", default="overburden", choices=("overburden", "proportional", "none"))
    parser.add_argument("--output-dir", default=".")
    words = parser.parse_args()
    given = (words.dem, words.release, words.erodible)
    if any(given) and not all(given):
        parser.error("--dem, --release and --erodible go together")
    try:
        main(words.particles, words.output_dir, given if all(given) else None, words.loading)
    except (InputError, ParameterError, OSError) as error:
        sys.exit(f"tsing_shan: {error}")
