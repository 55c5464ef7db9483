"""An ensemble: a scene, what varies in it, and its members."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..core.errors import InputError, ParameterError
from ..core.version import __version__
from ..run.scene import Scene
from ..scene.digest import digest
from .basis import Basis, scheduled, shared_terrain
from .batch import run_batch
from .design import make_design, member_values, varied_values
from .result import DEFAULT_MAPS
from .results import EnsembleResults
from .store import Header, Store

BATCH = 8
"""Members in a batch."""


class Ensemble:
    """Runs of a scene whose parameters are drawn from distributions.

    Parameters
    ----------
    scene : Scene, str, Path or mapping
        Scene, a scene file, or its plain values.
    vary : mapping of str to object
        Distributions by dotted name, such as ``{"friction.basal_friction_angle": scipy.stats.norm(28, 2)}``.
    members : int, optional
        Number of members; by default 256.
    sampling : str
        One of `sampling.METHODS`.
    seed : int
        Seed: the same one gives the same members.
    correlation : optional
        Rank correlations, such as ``{("friction.cohesion", "erosion.growth_rate"): -0.5}``.
    replicates : int, optional
        Independent samples of which Latin hypercube and Sobol consist; by default 8.
    maps : sequence of str
        Names of the maps that are kept.
    batch : int
        Members that are computed and written together.

    Raises
    ------
    InputError, ParameterError
        If a name, a distribution or the scene cannot be used.

    Attributes
    ----------
    scene : Scene
    design : xarray.Dataset
        Values of all members over ``member``.
    """

    def __init__(
        self, scene: Scene | str | Path | Mapping[str, Any], vary: Mapping[str, Any], members: int | None = None,
        sampling: str = "latin_hypercube", seed: int = 0, *, correlation: Any = None, replicates: int | None = None,
        maps: Any = DEFAULT_MAPS, batch: int = BATCH,
    ) -> None:  # fmt: skip
        self.scene = _scene(scene)
        content = self.scene.content
        self.sampling, self.seed, self.maps, self.batch = sampling, seed, tuple(maps), batch
        self._varied = varied_values(vary, content)
        self.design = make_design(self._varied, sampling, members, seed, replicates, correlation)

    def digest(self) -> str:
        """Return 32 hexadecimal digits that differ where results may: scene, values of members, maps, batches."""
        design = {str(name): values.values for name, values in self.design.data_vars.items()}
        attributes = {str(name): dict(values.attrs) for name, values in self.design.data_vars.items()}
        duration = self.scene.output_keys.max_duration
        return digest(
            [self.scene.digest(), duration, design, attributes, self.seed, self.maps, self.batch, __version__]
        )

    def run(self, *, store: str | Path | None = None) -> EnsembleResults:
        """Run the members that are not in the store yet.

        Parameters
        ----------
        store : str or Path, optional
            Directory for the results; one of the same ensemble is continued. By default results stay in memory.

        Returns
        -------
        EnsembleResults

        Raises
        ------
        InputError
            If the store holds another ensemble.
        """
        basis, target = self._basis(), self._open(store)
        done = set(target.complete_batches())
        for batch in range(target.batch_count):
            if batch not in done:
                members = [(member, member_values(self.design, member)) for member in target.members_of(batch)]
                target.write(run_batch(basis, batch, members))
        return EnsembleResults(target)

    def _basis(self) -> Basis:
        scene = self.scene
        terrain = shared_terrain(scene.content, scene.folder, self._varied, lambda: scene.terrain)
        releases = scheduled(scene.content.release, terrain, scene.folder)
        return Basis(
            scene.content, scene.folder, terrain, releases, self._varied, self.maps, self.seed, self.digest()
        )  # fmt: skip

    def _open(self, path: str | Path | None) -> Store:
        terrain = shared_terrain(self.scene.content, self.scene.folder, self._varied, lambda: self.scene.terrain)
        from ..scene.terrain import lattice_of

        header = Header(
            self.digest(), self.scene.to_mapping(), self.sampling, self.seed, self.batch, self.maps,
            lattice_of(terrain),
        )  # fmt: skip
        if path is None or not Path(path).exists():
            return Store.create(None if path is None else Path(path), header, self.design)
        found = Store.open(path, write=True)
        if found.header.digest != header.digest:
            raise InputError(
                f"{path} holds another ensemble, of digest {found.header.digest}; this one has {header.digest}: scene, "
                "values of members, maps or batches differ; choose another store, or remove it"
            )
        return found


def _scene(scene: Any) -> Scene:
    if isinstance(scene, Scene):
        return scene
    if isinstance(scene, str | Path):
        return Scene.from_file(scene)
    if isinstance(scene, Mapping):
        return Scene.from_mapping(scene)
    raise ParameterError(f"ensemble: a Scene, a scene file or a mapping is needed, got {scene!r:.60}")
