"""Time the commands from a GeoTIFF and polygons to maps: new --from, check, run; with kernels to compile, and warm.

    python -m benchmarks.scene_commands

Each command is a process of its own. The ground is a gully of 300 m by 700 m with nodes every 5 m, as a GeoTIFF of 32
bits, the release a polygon in a GeoPackage; the scene runs as `new` wrote it.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path
from time import perf_counter

import geopandas
import numpy as np
import shapely
from rich.console import Console
from rich.table import Table

from landlab_debrisflow.geo.geotiff import write_geotiff
from landlab_debrisflow.scene.gully import gully

OUTLINE = [(400020, 5200145), (400050, 5200145), (400050, 5200170), (400020, 5200170)]
COMMANDS = {
    "new": ["new", "scene.yaml", "--from", "dem.tif", "release.gpkg"], "check": ["check", "scene.yaml"],
    "run": ["run", "scene.yaml"],
}  # fmt: skip
SENTENCES = {0: "at rest", 3: "still moving"}


def write_files(folder: Path) -> None:
    """Write the DEM and the release of a user."""
    elevation, _, lattice = gully()
    write_geotiff(folder / "dem.tif", elevation.astype(np.float32), lattice, description="elevation", unit="m")
    release = geopandas.GeoDataFrame({"depth": [1.5]}, geometry=[shapely.Polygon(OUTLINE)], crs=lattice.crs)
    release.to_file(folder / "release.gpkg")


def timed(words: list[str], folder: Path, cache: Path) -> float:
    """Return the wall time of a command [s]."""
    command = [sys.executable, "-m", "landlab_debrisflow.cli.main", *words]
    paths = os.pathsep.join(filter(None, [str(Path(__file__).parents[1]), os.environ.get("PYTHONPATH")]))
    environment = os.environ | {"NUMBA_CACHE_DIR": str(cache), "PYTHONPATH": paths}
    began = perf_counter()
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
    if done.returncode not in SENTENCES:
        raise SystemExit(f"{' '.join(words)} ended with {done.returncode}: {done.stderr}")
    return perf_counter() - began


def main() -> int:
    console, times = Console(), {}
    console.print(f"load of the machine before: {os.getloadavg()[0]:.1f}, cores: {os.cpu_count()}")
    with tempfile.TemporaryDirectory() as name:
        for state in ("cold", "warm"):
            folder = Path(name, state)
            folder.mkdir()
            write_files(folder)
            times[state] = [timed(words, folder, Path(name, "cache")) for words in COMMANDS.values()]
            found = sorted(path.name for path in (folder / "scene_out").iterdir())
    table = Table(title="wall time [s]", title_justify="left")
    table.add_column("")
    for head in (*COMMANDS, "all three"):
        table.add_column(head, justify="right")
    for state, values in times.items():
        table.add_row(state, *(f"{value:.1f}" for value in (*values, sum(values))))
    console.print(table)
    console.print(f"in scene_out: {', '.join(found)}")
    console.print(f"load of the machine after: {os.getloadavg()[0]:.1f}")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
