"""An ensemble: a scene, the values that vary in it, and its members."""

import dataclasses
import logging
from collections.abc import Callable, Mapping
from functools import cached_property
from pathlib import Path
from typing import Any

from ..core.errors import InputError, ParameterError
from ..core.version import __version__
from ..run.scene import Scene
from ..scene.content import SceneContent
from ..scene.digest import digest
from ..scene.keys import EnsembleKeys
from ..scene.location import located
from ..scene.terrain import lattice_of
from .basis import Basis, check_amounts, scheduled, shared_terrain
from .design import make_design, member_values, varied_values
from .pilots import plan_ensemble
from .plan import EnsemblePlan
from .results import EnsembleResults
from .running import opened, run_missing, stored_plan
from .store import Header
from .table import design_of_table

log = logging.getLogger("landlab_debrisflow.progress")

DEFAULTS = EnsembleKeys()


class Ensemble:
    """Runs of a scene whose values are drawn from distributions.

    Parameters
    ----------
    scene : Scene, str, Path or mapping
        Scene, a scene file, or its plain values.
    vary : mapping of str to object, optional
        By the dotted name of a value, such as ``friction.basal_friction_angle`` or ``release 2.volume``: a frozen
        distribution of `scipy.stats`, a list of choices, or a mapping such as ``{"normal": {"mean": 28, "sd": 2}}``.
        ``release.factor`` and ``inflow.factor`` are factors on mass and discharge; ``terrain.elevation_noise`` is
        ``{"rms": 0.3, "length": 20.0}`` [m]. A table of members needs none.
    members : int, optional
        Number of members; by default 256, of factorial and of a table all.
    sampling : str, Dataset, DataFrame, mapping or Path
        "latin_hypercube", "random", "sobol", "saltelli" or "factorial"; or a table of members, with a column for each
        dotted name, also as the name of a file (CSV).
    seed : int
        The same seed gives the same members, to the bit.
    correlation : mapping or array_like, optional
        Rank correlations, such as ``{("friction.cohesion", "erosion.growth_rate"): -0.5}``, or their matrix.
    replicates : int, optional
        Independent samples of which Latin hypercube and Sobol consist, by whose scatter the sampling error is told; by
        default 8.
    fidelity : {"scene", "auto"}
        Whether particles, column and steps are those of the scene, or chosen for all members by pilot runs of at most
        eight, so that the numerical error of the maps stays below a fifth of the spread between members.
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
        Values of all members over ``member``: a variable with the attribute ``key`` for each dotted name, and
        ``replicate``.

    Examples
    --------
    >>> ensemble = Ensemble(
    ...     {"terrain": {"example": "gully"}, "friction": "voellmy",
    ...      "release": {"polygons": [[400020, 5200140], [400045, 5200140], [400045, 5200160]], "depth": 1.5}},
    ...     vary={"friction.basal_friction_angle": {"normal": {"mean": 28.0, "sd": 0.5}}}, members=8, seed=1,
    ... )
    >>> ensemble.design["friction__basal_friction_angle"].values.round(1).max() < 30.0
    np.True_
    """

    def __init__(
        self, scene: Scene | str | Path | Mapping[str, Any], vary: Mapping[str, Any] | None = None,
        members: int | None = None, sampling: Any = DEFAULTS.sampling, seed: int = 0, *, correlation: Any = None,
        replicates: int | None = None, fidelity: str = DEFAULTS.fidelity, maps: Any = DEFAULTS.maps,
        batch: int = DEFAULTS.batch,
    ) -> None:  # fmt: skip
        self.scene = _scene(scene)
        self._content = content = _content_of(self.scene)
        is_word = isinstance(sampling, str) and not sampling.lower().endswith(".csv")
        words = {"sampling": sampling} if is_word else {}
        self._keys = EnsembleKeys(
            members=members, seed=seed, replicates=replicates, fidelity=fidelity, maps=maps, batch=batch, **words
        )  # fmt: skip
        self.sampling = self._keys.sampling if is_word else "table"
        if is_word:
            self._varied = varied_values({} if vary is None else vary, content)
            self.design = make_design(self._varied, self.sampling, members, seed, replicates, correlation)
        else:
            for name, value in (("members", members), ("correlation", correlation), ("replicates", replicates)):
                if value is not None:
                    raise ParameterError(f"ensemble: a table has its own members; leave {name} out")
            self._varied, self.design = design_of_table(sampling, vary or {}, content, self.scene.folder)

    @classmethod
    def from_file(cls, path: str | Path, **others: Any) -> "Ensemble":
        """Return the ensemble that a scene file describes under its key ``ensemble``.

        Parameters
        ----------
        path : str or Path
            Scene file.
        **others
            Arguments of the class in place of values of the file, such as ``members``.

        Returns
        -------
        Ensemble

        Raises
        ------
        InputError, ParameterError
            If the file has no key ``ensemble``, or a value below it cannot be used.
        """
        return cls.of_scene(Scene.from_file(path), **others)

    @classmethod
    def of_scene(cls, scene: Scene, **others: Any) -> "Ensemble":
        """Return the ensemble that a scene describes under its key ``ensemble``.

        Parameters
        ----------
        scene : Scene
        **others
            Arguments of the class in place of values of the scene.

        Returns
        -------
        Ensemble

        Raises
        ------
        InputError, ParameterError
            If the scene has no key ``ensemble``, or a value below it cannot be used.
        """
        keys = scene.content.ensemble
        if keys is None:
            raise InputError(
                f"{scene.name}: the scene has no key ensemble; give one, with vary: {{friction.basal_friction_angle: "
                "{normal: {mean: 28, sd: 2}}}"
            )
        names = ("vary", "members", "seed", "correlation", "replicates", "fidelity", "maps", "batch")
        given = {name: getattr(keys, name) for name in names}
        given["sampling"] = keys.sampling if keys.table is None else Path(keys.table)
        with located(scene.file, "ensemble"):
            return cls(scene, **given | others)

    def __repr__(self):
        return f"<Ensemble of {self.scene.name!r}: {self.members} members, {self.sampling}, of {self.keys}>"

    @property
    def members(self) -> int:
        """Number of members."""
        return self.design.sizes["member"]

    @property
    def keys(self) -> list[str]:
        """Dotted names of the values that vary."""
        return [one.name.key for one in self._varied]

    def values(self, member: int) -> dict[str, Any]:
        """Return the values of a member by dotted name.

        Parameters
        ----------
        member : int

        Returns
        -------
        dict of str to object
        """
        return member_values(self.design, member)

    def digest(self) -> str:
        """Return 32 hexadecimal digits that differ where results may: scene, values of members, maps, batches."""
        return self._digest

    @cached_property
    def _digest(self) -> str:
        design = [[str(name), values.values, dict(values.attrs)] for name, values in self.design.data_vars.items()]
        keys, duration = self._keys, self.scene.output_keys.max_duration
        setup = self._content.setup  # a plan has replaced its numerics and column
        own = [keys.seed, keys.maps, keys.batch, self.automatic, setup.numerics, setup.column]
        return digest([self.scene.digest(), duration, design, own, __version__])

    @property
    def results_directory(self) -> Path:
        """Directory of the results of the command."""
        keys = self.scene.content.ensemble
        return self.scene.folder / ((keys and keys.directory) or f"{self.scene.name}_ensemble")

    def run(
        self, client: Any = None, store: str | Path | None = None, *, workers: int | None = None,
        notify: Callable[[str], None] = log.info,
    ) -> EnsembleResults:  # fmt: skip
        """Run the members that are not in the store yet.

        Parameters
        ----------
        client : distributed.Client or str, optional
            Client of a cluster, or the address of its scheduler; by default a cluster on this machine that listens on
            loopback only.
        store : str or Path, optional
            Directory for the results; one of the same ensemble is continued. By default results stay in memory.
        workers : int, optional
            Worker processes on this machine; by default one for each processor; 1: the members run in this process.
        notify : callable
            Called with a text as batches are done.

        Returns
        -------
        EnsembleResults

        Raises
        ------
        InputError
            If the store holds another ensemble, or no scheduler answers.
        OutputError
            If the store cannot be written.
        """
        keys, path, basis = self._keys, None if store is None else Path(store), self.basis()
        plan = None
        if self.automatic:
            known = None if path is None else stored_plan(path)
            plan = self.plan(notify) if known is None else EnsemblePlan.from_mapping(known)
            basis = basis.with_setup(plan.applied(basis.content.setup))
        header = Header(
            self.digest(), self.scene.to_mapping(), self.sampling, keys.seed, keys.batch, keys.maps, basis.lattice,
            None if plan is None else plan.to_mapping(),
        )  # fmt: skip
        with opened(path, header, self.design) as target:
            run_missing(basis, target, client, workers, notify)
        return EnsembleResults(target)

    @property
    def automatic(self) -> bool:
        """Whether particles, column and steps are found by pilot runs."""
        return self._keys.fidelity == "auto" or self._content.setup.numerics.automatic

    def plan(self, notify: Callable[[str], None] = log.info) -> EnsemblePlan:
        """Choose particles, column and steps for all members by pilot runs of some, in this process.

        Parameters
        ----------
        notify : callable
            Called with a text when a pilot run begins.

        Returns
        -------
        EnsemblePlan

        Raises
        ------
        InputError, ParameterError, SimulationError
            If pilots cannot be run.
        """
        return plan_ensemble(self.basis(), self.design, notify)

    def basis(self) -> Basis:
        """Return all that the members share, read from the files of the scene."""
        content, folder, keys = self._content, self.scene.folder, self._keys
        terrain = shared_terrain(content, folder, self._varied, lambda: self.scene.terrain)
        check_amounts(content, folder, self._varied, lattice_of(terrain))
        releases = scheduled(content.release, terrain, folder)
        return Basis(
            content, folder.resolve(), terrain, releases, self._varied, keys.maps, keys.seed, self.digest()
        )  # fmt: skip


def _content_of(scene: Scene) -> SceneContent:
    """Return the keys of a scene, with numerics and column of its plan if it has one."""
    content, plan = scene.content, scene.adopted_plan
    if plan is None:
        return content
    return content._replace(setup=dataclasses.replace(content.setup, numerics=plan.numerics, column=plan.column))


def _scene(scene: Any) -> Scene:
    if isinstance(scene, Scene):
        return scene
    if isinstance(scene, str | Path):
        return Scene.from_file(scene)
    if isinstance(scene, Mapping):
        return Scene.from_mapping(scene)
    raise ParameterError(f"ensemble: a Scene, a scene file or a mapping is needed, got {scene!r:.60}")
