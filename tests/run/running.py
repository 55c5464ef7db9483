"""A scene that runs within a second, and ways to interrupt it and to compare what it wrote."""

import copy
import json

import numpy as np
import rasterio
import xarray as xr

from landlab_debrisflow.record.monitor import Monitor
from landlab_debrisflow.run.scene import Scene

FIRST = [[400020, 5200145], [400050, 5200145], [400050, 5200170], [400020, 5200170]]
SECOND = [[400060, 5200145], [400080, 5200145], [400080, 5200165], [400060, 5200165]]
MAPPING = {
    "terrain": {"example": "gully", "soil_depth": 2.0},
    "release": [{"polygons": FIRST, "depth": 1.5}, {"polygons": SECOND, "depth": 1.0, "time": 4.0}],
    "output": {"max_duration": 9.0, "interval": 2.0},
    "numerics": {"particle_count": 60},
}
DATES = ("date_created", "started", "written")


def scene(folder, **changes):
    """Return the scene in a folder, with keys of `output` changed."""
    mapping = copy.deepcopy(MAPPING)
    mapping["output"] |= changes
    return Scene.from_mapping(mapping, folder)


class Stopping(Monitor):
    """A monitor that ends the run at a step, as Ctrl-C or `failure` would."""

    def __init__(self, steps, failure=KeyboardInterrupt):
        super().__init__(live=False)
        self._left, self._failure = steps, failure

    def follow(self, particles, began, time):
        super().follow(particles, began, time)
        self._left -= 1
        if self._left == 0:
            raise self._failure


Stopping.__qualname__ = Monitor.__qualname__  # by which a checkpoint knows its observers


def contents(directory):
    """Return all that is in a directory of results but dates, by name of the file."""
    found = {}
    for path in sorted(path for path in directory.rglob("*") if path.is_file()):
        name = path.relative_to(directory).as_posix()
        if path.suffix == ".nc":
            with xr.open_dataset(path, decode_coords=False) as data:
                data = data.load()
            data.attrs = {key: value for key, value in data.attrs.items() if key not in DATES}
            found[name] = data
        elif path.suffix == ".tif":
            with rasterio.open(path) as file:
                tags = {key: value for key, value in file.tags().items() if key not in DATES}
                found[name] = (file.read(1).tobytes(), tags)
        elif path.suffix == ".json":
            values = json.loads(path.read_text(encoding="utf-8"))
            found[name] = {key: value for key, value in values.items() if key not in (*DATES, "scene_file", "files")}
            found[name]["files"] = sorted(values["files"])
        else:
            found[name] = path.read_bytes()
    return found


def assert_same(directory, other):
    """Assert that two directories of results hold equal files, to the bit, except dates."""
    one, two = contents(directory), contents(other)
    assert list(one) == list(two)
    for name, value in one.items():
        same = value.identical(two[name]) if isinstance(value, xr.Dataset) else value == two[name]
        assert same, name
    assert any(np.isfinite(one["maps.nc"].debris_flow__max_depth.values).ravel())
