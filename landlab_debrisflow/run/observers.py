"""Observers that the output keys of a scene ask for."""

from pathlib import Path
from typing import Any

from ..record.budget_series import BudgetSeries
from ..record.checkpoints import Checkpoints
from ..record.files import write_dataset
from ..record.map_series import MapSeries
from .directory import OutputDirectory
from .files import BUDGET, SERIES
from .scene import Scene

NEVER = 1e12
"""Wall time between checkpoints of which there is to be none but at an interruption [s]."""

BUDGET_INTERVAL = 5.0
"""Time between two values of the budget unless maps are written as the run goes [s]."""


class Observers:
    """Observers of a scene, and the files of what they saw.

    Parameters
    ----------
    scene : Scene
    directory : OutputDirectory
        Where observers write as the run goes.

    Attributes
    ----------
    all : list of observers
        For `DebrisFlow`.
    """

    def __init__(self, scene: Scene, directory: OutputDirectory):
        keys = scene.output_keys
        self._series: dict[str, Any] = {BUDGET: BudgetSeries(keys.interval or BUDGET_INTERVAL)}
        self.all: list[Any] = list(self._series.values())
        if keys.interval:
            folder = directory.path / SERIES
            directory.expect(f"{SERIES}/maps_*.nc")
            folder.mkdir(exist_ok=True)
            crs = scene.terrain.attrs.get("crs_wkt") or None
            self.all.append(MapSeries(keys.interval, folder, keys.variables, crs, replace=True))
        self.all.append(Checkpoints(directory.checkpoint, keys.checkpoint_interval or NEVER))

    def write(self, folder: Path) -> None:
        """Write what was seen into a directory, a file for each observer."""
        for name, observer in self._series.items():
            write_dataset(folder / name, observer.dataset)
