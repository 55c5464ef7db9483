"""The landslide S-1000, modelled beside observed: ``python -m benchmarks.s1000 [DATA_DIR]``.

Runs examples/s1000.py on the rasters of DATA_DIR or $DEBRISFLOW_DATA, and keeps benchmarks/results/s1000.nc and
s1000_scores.json, from which s1000.png and s1000_valley.png of docs/figures and a table of docs/accuracy.md are made.
"""

import argparse
import tempfile
from pathlib import Path

import xarray as xr

from benchmarks import charts, result_files
from benchmarks.example_scripts import load
from landlab_debrisflow.plots import Layer, draw_maps

COMMAND = "python -m benchmarks.s1000"
CHANGES = "elevation_change"


def measure(data_dir=None, particles=2000):
    """Return the maps of the figure, and the scores by column of the table."""
    script = load("s1000")
    with tempfile.TemporaryDirectory() as folder:
        scores = script.main(data_dir, particles, folder)
        with xr.open_dataset(Path(folder, "s1000.nc")) as stored:
            maps = stored[[CHANGES, f"observed_{CHANGES}", "source"]].load()
    relief = script.elevation_map(script.build_grid(script.find_data(data_dir)))
    maps["relief"] = relief.assign_coords(x=maps.x, y=maps.y)
    return maps.assign_attrs({}).drop_vars([name for name in maps.coords if name not in ("x", "y", "run")]), scores


def chart():
    """Return the figure: observed and modelled change of elevation."""
    found = result_files.read_dataset("s1000")
    change = {str(run): found[CHANGES].sel(run=run) for run in found.run.values}
    return load("s1000").draw(change, found[f"observed_{CHANGES}"], found.source, found.relief)


def chart_of_valley():
    """Return the first picture of the README: the observed change of elevation beside that of the better set."""
    found = result_files.read_dataset("s1000")
    panels = {"observed by lidar": found[f"observed_{CHANGES}"], "modelled": found[CHANGES].sel(run="Voellmy")}
    layer = Layer(panels, "change of elevation [m]", "RdBu", (-3.0, 3.0), threshold=0.2)
    return draw_maps([layer], found.relief, outline=found.source, note="outlined: source of the landslide")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("data_dir", nargs="?", help="folder of the rasters; by default $DEBRISFLOW_DATA")
    maps, scores = measure(parser.parse_args().data_dir)
    steps = {CHANGES: 1e-3, f"observed_{CHANGES}": 1e-3, "relief": 0.05}
    result_files.keep_dataset("s1000", maps, COMMAND, steps)
    rows = [{"column": name, **values} for name, values in scores.items()]
    result_files.keep("s1000_scores", {"particles": 2000, "columns": rows}, COMMAND)
    charts.make("s1000")


if __name__ == "__main__":
    main()
