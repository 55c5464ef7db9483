"""A scene: the content of a scene file as a grid, a flow and a run."""

import dataclasses
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import Any

import xarray as xr
from landlab import RasterModelGrid

from ..component import DebrisFlow
from ..fidelity.plan import Plan
from ..geo.lattice import Lattice
from ..geo.rasters import checksum_of
from ..scene.content import SceneContent, given_keys, named_files, read_content, to_mapping
from ..scene.digest import digest
from ..scene.location import located
from ..scene.outputs import OutputPlaces, output_places
from ..scene.point_inflow import point_hydrographs
from ..scene.read_yaml import YamlFile, read_yaml
from ..scene.releases import ScheduledRelease, schedule_releases
from ..scene.setup import Setup
from ..scene.terrain import build_terrain, lattice_of
from .advance import start
from .grids import build_grid
from .results import Results


class Scene:
    """Terrain, releases, setup and output of a run.

    Files are read when they are needed, each once. A pickled scene holds its keys, and no content of files.

    Parameters
    ----------
    mapping : mapping
        Plain values as a scene file holds them: ``terrain``, ``release``, ``output`` and the keywords of `DebrisFlow`.
    folder : str or Path
        Directory to which names of files are relative.
    name : str
        Name of the scene, after which its output is named.

    Raises
    ------
    ParameterError
        If a key is unknown or a value is refused; of a scene from a file the message begins with file and line.

    Examples
    --------
    >>> scene = Scene.from_mapping({
    ...     "terrain": {"example": "gully"},
    ...     "release": {"polygons": [[400020, 5200140], [400045, 5200140], [400045, 5200160], [400020, 5200160]],
    ...                 "depth": 1.5},
    ...     "friction": {"law": "voellmy", "basal_friction_angle": 28.0},
    ... })
    >>> scene.setup.friction.turbulent_coefficient, scene.grid().shape
    (500.0, (61, 141))
    """

    def __init__(
        self, mapping: Mapping[str, Any], folder: str | Path = ".", name: str = "scene", *, file: YamlFile | None = None
    ) -> None:
        self.folder, self.name, self._file = Path(folder), name, file
        self._content, self._given = read_content(mapping, file), tuple(given_keys(mapping))
        self.adopted_plan: Plan | None = None

    @classmethod
    def from_file(cls, path: str | Path) -> "Scene":
        """Read a scene file.

        Parameters
        ----------
        path : str or Path
            YAML; names of files in it are relative to its directory.

        Returns
        -------
        Scene

        Raises
        ------
        InputError, ParameterError
            If the file cannot be read, or a key or value is refused.
        """
        file = read_yaml(path)
        return cls(file.mapping, file.path.parent, file.path.stem, file=file)

    @classmethod
    def from_mapping(cls, mapping: Mapping[str, Any], folder: str | Path = ".", name: str = "scene") -> "Scene":
        """Build a scene from plain values.

        Parameters
        ----------
        mapping, folder, name
            As for the class.

        Returns
        -------
        Scene
        """
        return cls(mapping, folder, name)

    def __repr__(self):
        return f"<Scene {self.name!r} with {len(self._content.release)} releases in {str(self.folder)!r}>"

    def __getstate__(self):
        return {key: vars(self)[key] for key in ("folder", "name", "_file", "_content", "_given", "adopted_plan")}

    # ---- keys ----

    @property
    def content(self) -> SceneContent:
        """Keys of the scene as checked values, the setup as it is written."""
        return self._content

    @property
    def output_keys(self) -> Any:
        """Keys of the output, checked: an `OutputKeys`."""
        return self._content.output

    @property
    def file(self) -> YamlFile | None:
        """Scene file as it was read; None if the scene is from a mapping."""
        return self._file

    @property
    def text(self) -> str | None:
        """Text of the scene file; None if the scene is from a mapping."""
        return None if self._file is None else self._file.text

    @property
    def path(self) -> Path | None:
        """Scene file; None if the scene is from a mapping."""
        return None if self._file is None else self._file.path

    @property
    def output_directory(self) -> Path:
        """Directory of the results."""
        return self.folder / (self.output_keys.directory or f"{self.name}_out")

    @property
    def given_keys(self) -> tuple[str, ...]:
        """Keys whose values were given, such as ``friction.cohesion``; other keys have their defaults."""
        return self._given

    def to_mapping(self) -> dict[str, Any]:
        """Return keys and defaults as plain values; `from_mapping` builds an equal scene from them."""
        return to_mapping(self._content)

    def digest(self) -> str:
        """Return 32 hexadecimal digits that differ where results may: keys of terrain, release and setup, files named.

        Keys of output and ensemble do not count.

        Returns
        -------
        str
        """
        content = {key: value for key, value in self.to_mapping().items() if key not in ("output", "ensemble")}
        files = {name: checksum_of(path) for name, path in named_files(content, self.folder).items()}
        return digest([content, files])

    # ---- terrain, releases and setup of the keys ----

    @cached_property
    def terrain(self) -> xr.Dataset:
        """Ground as arrays over ``y`` and ``x``, named as fields of the grid [m]."""
        with located(self._file, "terrain"):
            return build_terrain(self._content, self.folder)

    @property
    def lattice(self) -> Lattice:
        """Place of the nodes on the map."""
        return lattice_of(self.terrain)

    @cached_property
    def releases(self) -> list[ScheduledRelease]:
        """Releases in the order of their times, without the inflow at points."""
        return schedule_releases(self._content.release, self.terrain, self.folder, self._file)

    @cached_property
    def setup(self) -> Setup:
        """Laws, material, numerics and inflow, also the inflow at points."""
        if self.adopted_plan is not None:
            return self.adopted_plan.setup
        setup = self._content.setup_on_grid
        if not any(keys.kind == "points" for keys in self._content.release):
            return setup
        points = point_hydrographs(self._content.release, self.terrain, self.folder, self._file)
        return dataclasses.replace(setup, inflow=(*setup.inflow, *points))

    @cached_property
    def places(self) -> OutputPlaces:
        """Gauges, sections, thalweg and exposed polygons as coordinates."""
        return output_places(self.output_keys, self.lattice, self.folder, self._file)

    @property
    def notes(self) -> list[str]:
        """Remarks and doubts about terrain, releases and places of output, as sentences."""
        notes = [*self.terrain.attrs.get("notes", ()), *(note for one in self.releases for note in one.notes)]
        notes.extend(self.places.notes)
        if not self.releases and not self.setup.inflow:
            notes.append("nothing is released and nothing flows in; give release or inflow")
        return notes

    # ---- runs ----

    def grid(self) -> RasterModelGrid:
        """Return a new grid with the fields of the terrain, and closed nodes where there are no data."""
        return build_grid(self.terrain)

    def flow(self, grid: RasterModelGrid | None = None, observers: Any = ()) -> DebrisFlow:
        """Return a flow whose releases at time 0 are set; later ones are in `releases`.

        Parameters
        ----------
        grid : RasterModelGrid, optional
            Grid to run on, which is changed; by default a new one.
        observers : observer or sequence of them
            As in `DebrisFlow`.

        Returns
        -------
        DebrisFlow
        """
        flow = start(self.grid() if grid is None else grid, self.setup, self.releases, observers)
        if self.adopted_plan is not None:
            flow._keep_plan(self.adopted_plan)
        return flow

    def plan(self, **wishes: Any) -> Plan:
        """Find particles, column and steps by pilot runs with all releases; `with_plan` uses the plan.

        Parameters
        ----------
        **wishes
            As in `DebrisFlow.plan`, without max_duration; tolerance and hold are by default those of numerics.
            ``notify`` is a function that is called with a text when a pilot run begins.
        """
        from .planning import plan_scene

        return plan_scene(self, **wishes)

    def with_plan(self, plan: Plan) -> "Scene":
        """Return the scene with numerics and column of one of its plans; keys and files stay."""
        planned = object.__new__(type(self))
        vars(planned).update(vars(self) | {"setup": plan.setup, "adopted_plan": plan})
        return planned

    def run(self, *, overwrite: bool = False) -> Results:
        """Run the scene to rest and write its results; a line shows the progress.

        Parameters
        ----------
        overwrite : bool
            Whether results of an earlier run in the output directory may be removed.

        Returns
        -------
        Results
            Maps, budget and files in `output_directory`.

        Raises
        ------
        InputError, ParameterError, OutputError, OSError, KeyboardInterrupt
            As in `runner.run_scene`; after an interruption `resume` goes on.
        """
        from .runner import run_scene

        return run_scene(self, overwrite=overwrite)

    def resume(self) -> Results:
        """Go on with an interrupted run, to the results of a run without interruption.

        Returns
        -------
        Results

        Raises
        ------
        InputError
            If there is no run of this scene, or the scene or a file of it has changed.
        """
        from .runner import resume_scene

        return resume_scene(self)
