"""Observers that the output keys of a scene ask for, and their files."""

from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ..record.budget_series import BudgetSeries
from ..record.checkpoints import Checkpoints
from ..record.combine import combine_maps
from ..record.files import write_atomically, write_dataset
from ..record.front import Front
from ..record.gauges import Gauges
from ..record.map_series import MapSeries
from ..record.sections import Sections
from ..record.tracks import MarkedColumns, Tracks
from .directory import OutputDirectory
from .files import SERIES, SERIES_SUFFIX

NEVER = 1e12
"""Wall time between checkpoints if they are wanted at interruptions only [s]."""

BUDGET_INTERVAL = 5.0
"""Elapsed time between two values of the budget, if no maps are written during the run [s]."""

TABLES = ("budget", "gauges", "sections", "thalweg")
"""Series that are written as tables, too, for spreadsheets."""


class Observers:
    """Observers of a scene, and their files.

    Parameters
    ----------
    scene : Scene
    directory : OutputDirectory
        Where maps are written as the run goes.

    Attributes
    ----------
    all : list of observers
        For `DebrisFlow`.
    """

    def __init__(self, scene: Any, directory: OutputDirectory):
        keys = scene.output_keys
        self._format, self._maps = keys.format, None
        self._series = _series(scene)
        self.all: list[Any] = list(self._series.values())
        if keys.interval:
            folder = directory.path / SERIES
            directory.expect(f"{SERIES}/maps_*.nc")
            folder.mkdir(exist_ok=True)
            self._maps = MapSeries(keys.interval, folder, keys.variables, scene.lattice.crs, replace=True)
            self.all.append(self._maps)
        self.all.append(Checkpoints(directory.checkpoint, keys.checkpoint_interval or NEVER))

    def write(self, folder: Path) -> None:
        """Write into a directory a file for each observer, and one for all maps that were written as the run went."""
        for name, observer in self._series.items():
            dataset = observer.dataset
            write_dataset(folder / f"{name}.nc", dataset)
            if name in TABLES and dataset.sizes.get("time"):
                _write_table(folder / f"{name}.csv", dataset)
        if self._maps is not None and self._maps.files:
            combine_maps(self._maps.directory, folder / f"{SERIES}{SERIES_SUFFIX[self._format]}")


def _series(scene: Any) -> dict[str, Any]:
    """Return the observers that keep their series in memory, by the names of their files."""
    keys, places = scene.output_keys, scene.places
    series: dict[str, Any] = {"budget": BudgetSeries(keys.interval or BUDGET_INTERVAL)}
    if places.gauges:
        series["gauges"] = Gauges(places.gauges, keys.series_interval)
    if places.sections:
        series["sections"] = Sections(places.sections, keys.series_interval)
    if places.thalweg is not None:
        series["thalweg"] = Front(places.thalweg, keys.series_interval)
    if keys.tracks:
        series["tracks"] = Tracks(keys.series_interval, keys.tracks)
    if keys.columns:
        series["columns"] = MarkedColumns(keys.series_interval, _evenly(keys.columns, scene))
    return series


def _evenly(count: int, scene: Any) -> list[int]:
    """Return the numbers of `count` particles, evenly from the first release."""
    dx, dy = scene.lattice.spacing
    area = np.count_nonzero(scene.releases[0].depth) * dx * dy if scene.releases else 0.0
    particles = max(count, scene.setup.numerics.count_for(area))
    return [int((k + 0.5) * particles / count) for k in range(count)]


def _write_table(path: Path, dataset: xr.Dataset) -> None:
    """Write a series as comma-separated values, a row for each time and place, units in the heads of the columns."""
    units = {name: data.attrs.get("units", "1") for name, data in dataset.variables.items()}
    over_time = [name for name, data in dataset.items() if data.dims[:1] == ("time",) or data.dims[1:] == ("time",)]
    places = [str(name) for name in dataset.dims if name != "time"]
    table = dataset[over_time].reset_coords(drop=True)
    frame = table.to_dataframe(["time", *(name for name in places if name in table.dims)]).reset_index()
    frame = frame.rename(columns={name: f"{name} [{units[name]}]" for name in frame if units.get(name, "1") != "1"})
    write_atomically(path, lambda temporary: frame.to_csv(temporary, index=False))
