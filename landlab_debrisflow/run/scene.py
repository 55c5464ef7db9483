"""A scene: everything that a scene file says, as a grid, a flow and a run."""

import dataclasses
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from landlab import RasterModelGrid

from ..component import DebrisFlow
from ..core.errors import ParameterError
from ..core.hints import did_you_mean
from ..core.values import from_mapping
from ..scene.keys import OutputKeys, ReleaseKeys, TerrainKeys
from ..scene.read_yaml import read_yaml
from ..scene.releases import ScheduledRelease, schedule_releases
from ..scene.setup import Setup
from ..scene.terrain import build_terrain, lattice_of

SETUP_KEYS = tuple(field.name for field in dataclasses.fields(Setup))


class Scene:
    """Terrain, releases, setup and outputs of a run.

    Parameters
    ----------
    mapping : mapping
        Plain values as a scene file holds them: ``terrain``, ``release``, ``output`` and the keywords of `DebrisFlow`.
    folder : str or Path
        Directory to which names of files are relative.
    name : str
        Name of the scene, after which its output is named.
    """

    def __init__(
        self, mapping: Mapping[str, Any], folder: str | Path = ".", name: str = "scene", file: Path | None = None
    ) -> None:
        legal = ("terrain", "release", "output", *SETUP_KEYS)
        for key in mapping:
            if key not in legal:
                raise ParameterError(
                    f"scene: unknown key {key!r}{did_you_mean(key, legal)}; allowed: {', '.join(legal)}"
                )
        self.folder, self.name, self.file = Path(folder), name, file
        self.terrain_keys = from_mapping(TerrainKeys, mapping.get("terrain") or {})
        releases = mapping.get("release") or ()
        releases = [releases] if isinstance(releases, Mapping) else releases
        self.release_keys = [from_mapping(ReleaseKeys, one) for one in releases]
        self.output_keys = from_mapping(OutputKeys, mapping.get("output") or {})
        self.setup = Setup.from_mapping({key: mapping[key] for key in SETUP_KEYS if key in mapping})

    @classmethod
    def from_file(cls, path: str | Path) -> "Scene":
        """Read a scene file."""
        path = Path(path)
        return cls(read_yaml(path), path.parent, path.stem, path)

    @property
    def output_directory(self) -> Path:
        """Directory of the results."""
        return self.folder / (self.output_keys.directory or f"{self.name}_out")

    @cached_property
    def terrain(self) -> xr.Dataset:
        """Ground as arrays over ``y`` and ``x`` [m]."""
        return build_terrain(self.terrain_keys, self.folder)

    @cached_property
    def releases(self) -> list[ScheduledRelease]:
        """Releases in the order of their times."""
        return schedule_releases(self.release_keys, self.terrain, self.folder)

    def grid(self) -> RasterModelGrid:
        """Return a new grid with the fields of the terrain, and closed nodes where there are no data."""
        lattice = lattice_of(self.terrain)
        grid = RasterModelGrid(lattice.shape, xy_spacing=lattice.spacing, xy_of_lower_left=lattice.lower_left)
        missing = np.isnan(self.terrain["topographic__elevation"].values).reshape(-1)
        for name, values in self.terrain.items():
            grid.add_field(str(name), np.nan_to_num(values.values.reshape(-1)), at="node")
        grid.status_at_node[missing] = grid.BC_NODE_IS_CLOSED
        return grid

    def to_mapping(self) -> dict[str, Any]:
        """Return the scene as plain values."""
        keys = {"terrain": self.terrain_keys, "output": self.output_keys}
        values = {name: {k: v for k, v in vars(one).items() if v is not None} for name, one in keys.items()}
        releases = [{k: v for k, v in vars(one).items() if v is not None} for one in self.release_keys]
        return values | {"release": releases} | self.setup.to_mapping()

    def set_releases(self, grid: RasterModelGrid, time: float) -> None:
        """Set the releases of a time [s] on the fields of a grid."""
        if "debris_flow__release_depth" not in grid.at_node:
            grid.add_zeros("debris_flow__release_depth", at="node")
        for one in self.releases:
            if one.time == time:
                grid.at_node["debris_flow__release_depth"] += one.depth.reshape(-1)

    def flow(self, grid: RasterModelGrid | None = None, observers: Any = ()) -> DebrisFlow:
        """Return a flow on a grid, by default a new one; releases at time 0 are set on it."""
        grid = self.grid() if grid is None else grid
        release = grid.add_zeros("debris_flow__release_depth", at="node")
        for one in self.releases:
            if one.time == 0.0:
                release += one.depth.reshape(-1)
        return DebrisFlow(grid, observers=observers, **vars(self.setup))
