"""Directories of results whose record, or budget, is not as a run left it."""

import functools
import json
import tempfile
from pathlib import Path

import numpy as np

from landlab_debrisflow.run.directory import OutputDirectory
from landlab_debrisflow.run.record import RunRecord
from landlab_debrisflow.run.results import Results
from landlab_debrisflow.run.scene import Scene

from . import ground
from .odd import damaged, one
from .scenes import change_value, write_mapping

OWN = ("photo.jpg", "series/photo.jpg", "sub/maps.nc", "../keep.txt")
"""Files of the user in and beside the directory of results, which no reader may remove."""
NAMES = (
    "*",
    "**",
    "**/*",
    "../keep.txt",
    "../*",
    "series/../../keep.txt",
    "*/*",
    "?hoto.jpg",
    ".",
    "",
    "series",
    "sub/*",
    "series/*",
)


def write(rng: np.random.Generator, folder: Path, form: str) -> str:
    """Write a scene and its results with a record of some form; return the change as text."""
    _write_scene(folder)
    results = folder / "results"
    for name, data in good().items():
        (results / name).parent.mkdir(parents=True, exist_ok=True)
        (results / name).write_bytes(data)
    for name in OWN:
        (results / name).parent.mkdir(exist_ok=True)
        (results / name).write_text("mine")
    record, done = results / "run.json", "nothing"
    if form == "bytes":
        data, done = damaged(rng, record.read_bytes())
        record.write_bytes(data)
    elif form == "one change":
        content = json.loads(record.read_text())
        if rng.random() < 0.3:
            name = one(rng, (*NAMES, str(folder / "keep.txt")))
            content["files"].append(name)
            done = f"files has {name!r}"
        else:
            done = change_value(rng, content)
        record.write_text(json.dumps(content), errors="surrogatepass")
    return done


def read(folder: Path) -> list[str]:
    """Read the results, then begin the run anew; raise if files of the user are gone."""
    try:
        results = Results(folder / "results")
        repr(results), results._repr_html_(), results.files, results.finished, results.elapsed_time, results.budget
        scene = Scene.from_file(folder / "scene.yaml")
        with OutputDirectory.claimed(scene.output_directory) as directory:
            directory.begin(RunRecord.of(scene), overwrite=True)
    finally:
        if gone := [name for name in OWN if not (folder / "results" / name).exists()]:
            raise RuntimeError(f"removed: {', '.join(gone)}")
    return []


def _write_scene(folder: Path) -> None:
    ground.write_files(folder)
    scene = {
        "terrain": {"elevation": "dem.asc", "crs": f"EPSG:{ground.CODE}", "soil_depth": 1.0},
        "release": {"polygons": "scars.geojson"}, "numerics": {"particle_count": 40},
        "output": {"directory": "results", "max_duration": 2.0, "interval": 1.0},
    }  # fmt: skip
    write_mapping(folder / "scene.yaml", scene)


@functools.cache
def good() -> dict[str, bytes]:
    """Return the content of the files of a run, by name."""
    with tempfile.TemporaryDirectory() as folder:
        _write_scene(Path(folder))
        results = Scene.from_file(Path(folder) / "scene.yaml").run()
        paths = [path for path in results.directory.rglob("*") if path.is_file()]
        return {str(path.relative_to(results.directory)): path.read_bytes() for path in paths}
