"""The event of Tsing Shan on its stand-in terrain, for figures: ``python -m benchmarks.tsing_shan_event``.

Runs examples/tsing_shan.py with 1500 particles and keeps tsing_shan_flow.nc, tsing_shan_maps.nc and
tsing_shan_columns.nc in benchmarks/results, from which three figures of docs/paper.md are drawn.
"""

import argparse
import itertools
from types import SimpleNamespace

import numpy as np
import xarray as xr

from benchmarks import charts, result_files
from benchmarks.example_scripts import load
from landlab_debrisflow.scene import tsing_shan_valley

PARTICLES = 1500
COMMAND = "python -m benchmarks.tsing_shan_event"
MAPS = ("debris_flow__eroded_depth", "debris_flow__deposit_depth", "debris_flow__basal_excess_pore_pressure",
        "debris_flow__max_depth")  # fmt: skip
MARGIN = 8
"""Nodes that are kept beyond the farthest that the flow reaches."""


def measure():
    """Return records of all runs by model and coefficient of consolidation."""
    script = load("tsing_shan")
    return {
        (model, c_v): script.run(tsing_shan_valley(**script.VALLEY), model, c_v, PARTICLES)
        for c_v, model in itertools.product(script.CONSOLIDATION, script.COLUMNS)
    }


def run_names(records) -> dict:
    """Return the coordinates that tell runs apart."""
    models, values = zip(*records, strict=True)
    return {"model": ("run", list(models)), "c_v": ("run", list(values))}


def keys_of(record) -> list:
    """Return the snapshots that figures show: times, and times since the front left erodible ground."""
    figures, since = load("tsing_shan_figures"), load("tsing_shan_record").SINCE
    keys = [key for key in figures.SHOWN if key in record.snapshots]
    return keys + [("since", time) for time in since if ("since", time) in record.snapshots]


def particles_of(records) -> xr.Dataset:
    """Return place and depth of the particles of both models with the first coefficient, by time."""
    first = next(c_v for _, c_v in records)
    pair = {key: record for key, record in records.items() if key[1] == first}
    keys = [key for key in keys_of(next(iter(pair.values()))) if not isinstance(key, tuple) or key[1] <= 32.0]
    most = max(record.snapshots[key]["particles"].sizes["particle"] for record in pair.values() for key in keys)
    found = {name: np.full((len(pair), len(keys), most), np.nan) for name in ("x", "y", "depth")}
    times = np.array([[record.snapshots[key]["time"] for key in keys] for record in pair.values()])
    for row, record in enumerate(pair.values()):
        for column, key in enumerate(keys):
            now = record.snapshots[key]["particles"]
            for name, values in found.items():
                values[row, column, : now.sizes["particle"]] = now[name]
    dims = ("run", "shown", "particle")
    since = [key[1] if isinstance(key, tuple) else np.nan for key in keys]
    return xr.Dataset(
        {name: (dims, values) for name, values in found.items()} | {"time": (dims[:2], times)},
        run_names(pair) | {"since": ("shown", since)},
    )  # fmt: skip


def maps_of(records) -> xr.Dataset:
    """Return the final maps of all runs with the terrain, from its corner to beyond the farthest node reached."""
    one = next(iter(records.values()))
    found = xr.concat([record.maps[list(MAPS)] for record in records.values()], "run").fillna(0.0)
    peclet = [record.snapshots["since", 0.0]["peclet"] for record in records.values()]
    found["peclet"] = (("run", "y", "x"), np.array(peclet))
    for name, values in (("elevation", one.elevation), ("soil", one.soil)):
        found[name] = (("y", "x"), values)
    found = found.assign_coords(run_names(records) | {"passing": ("run", [r.passing for r in records.values()])})
    rows, columns = np.nonzero((found.debris_flow__max_depth > 0.0).any("run").values)
    near = {name: slice(max(0, at.min() - MARGIN), at.max() + MARGIN + 1) for name, at in (("y", rows), ("x", columns))}
    kept = found.isel(near)
    return kept.drop_vars([name for name in kept.coords if name not in ("x", "y", "model", "c_v", "passing")])


def columns_of(records) -> xr.Dataset:
    """Return the column of the marked particle of all runs, by time since the front left erodible ground."""
    since = load("tsing_shan_figures").PROFILES
    kept = [[record.marked_column(("since", time)) for time in since] for record in records.values()]
    thickness = [
        [float(record.snapshots["since", time]["particles"].thickness.sel(particle=record.marked)) for time in since]
        for record in records.values()
    ]
    ratio = np.array([[pressure / load for pressure, load in row] for row in kept])
    coordinates = run_names(records) | {"since": list(since), "passing": ("run", [r.passing for r in records.values()])}
    return xr.Dataset(
        {"pressure_ratio": (("run", "since", "level"), ratio), "thickness": (("run", "since"), thickness)}, coordinates
    )


# ---- drawing ----


def runs(found) -> dict:
    """Return the runs of a Dataset by model and coefficient."""
    return {(str(found.model[k].item()), float(found.c_v[k])): found.isel(run=k) for k in range(found.sizes["run"])}


def ground(found) -> dict:
    """Return terrain and nodes as a `Record` has them."""
    node_x, node_y = np.meshgrid(found.x.values, found.y.values)
    return {"elevation": found.elevation.values, "soil": found.soil.values, "node_x": node_x, "node_y": node_y}


def chart_of_flow():
    """Return the figure of particles through time."""
    terrain, records = ground(result_files.read_dataset("tsing_shan_maps")), {}
    for name, run in runs(result_files.read_dataset("tsing_shan_flow")).items():
        snapshots = {}
        for shown in range(run.sizes["shown"]):
            now = run.isel(shown=shown).dropna("particle")
            since = float(now.since)
            key = float(now.time) if np.isnan(since) else ("since", since)
            snapshots[key] = {"time": float(now.time), "particles": now}
        records[name] = SimpleNamespace(snapshots=snapshots, **terrain)
    return load("tsing_shan_figures").draw_flow(records, next(c_v for _, c_v in records))


def chart_of_maps():
    """Return the figure of erosion, deposit, Péclet number and basal pressure."""
    found = result_files.read_dataset("tsing_shan_maps")
    records = {
        name: SimpleNamespace(
            maps=run, passing=float(run.passing), snapshots={("since", 0.0): {"peclet": run.peclet.values}},
            **ground(found),
        )
        for name, run in runs(found).items()
    }  # fmt: skip
    return load("tsing_shan_figures").draw_maps_of(records)


def chart_of_columns():
    """Return the figure of the marked columns."""
    records = {}
    for name, run in runs(result_files.read_dataset("tsing_shan_columns")).items():
        snapshots = {
            ("since", float(time)): {"particles": xr.Dataset({"thickness": ("particle", [h])}, {"particle": [0]})}
            for time, h in zip(run.since.values, run.thickness.values, strict=True)
        }

        def marked_column(key, run=run):
            return run.pressure_ratio.sel(since=key[1]).values, 1.0

        records[name] = SimpleNamespace(
            snapshots=snapshots, marked=0, passing=float(run.passing), marked_column=marked_column
        )
    return load("tsing_shan_figures").draw_columns(records)


def main() -> None:
    argparse.ArgumentParser(description=__doc__.splitlines()[0]).parse_args()
    records = measure()
    steps = {"x": 0.1, "y": 0.1, "depth": 1e-3}
    result_files.keep_dataset("tsing_shan_flow", particles_of(records), COMMAND, steps)
    steps = dict.fromkeys((*MAPS[:2], MAPS[3], "soil"), 1e-3) | {MAPS[2]: 3.0, "elevation": 0.02}
    maps = maps_of(records)
    result_files.keep_dataset("tsing_shan_maps", maps.assign(peclet=maps.peclet.astype("f4")), COMMAND, steps)
    result_files.keep_dataset("tsing_shan_columns", columns_of(records).astype("f4"), COMMAND)
    charts.make("tsing_shan_flow", "tsing_shan_maps", "tsing_shan_columns")


if __name__ == "__main__":
    main()
