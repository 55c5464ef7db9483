"""Event of a calibration: a scene with its observations, and the runs of tables of members in it."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from ..core.errors import InputError, ParameterError
from ..ensemble import Ensemble, EnsembleResults
from ..ensemble.correlation import correlated
from ..ensemble.design import Varied, make_dataset, varied_values
from ..ensemble.distributions import Choices
from ..ensemble.sampling import Points
from ..run.scene import Scene
from .bound import Bound, Observation
from .place import Place

PLACES = ("polygons", "points", "raster")
"""Keys of a release that say where it lies."""


class Event(NamedTuple):
    """Event to which a model is calibrated.

    Attributes
    ----------
    scene : Scene, str, Path or mapping
        Scene, a scene file, or its plain values.
    observations : sequence of Observation
    """

    scene: Any
    observations: Sequence[Observation]


class Prior:
    """Distributions of the varied values, as a function of points of the unit cube.

    Parameters
    ----------
    varied : sequence of Varied
    correlation : mapping or array_like, optional
        Rank correlations, as for `Ensemble`.

    Attributes
    ----------
    keys : list of str
        Dotted names of the values.
    """

    def __init__(self, varied: Sequence[Varied], correlation: Any = None):
        self.varied, self._correlation = tuple(varied), correlation
        self.keys = [one.name.key for one in varied]

    def design(self, uniform: np.ndarray) -> xr.Dataset:
        """Return the values of members, as the design of an ensemble.

        Parameters
        ----------
        uniform : ndarray, shape (members, dimensions)
            Independent points of the unit cube.
        """
        members = np.zeros(len(uniform), int)
        if self._correlation is not None:
            uniform = correlated(Points(uniform, members), self.keys, self._correlation, stratified=False)
        columns = [one.distribution.values_at(uniform[:, k]) for k, one in enumerate(self.varied)]
        return make_dataset(self.varied, columns, members)


class EventRuns:
    """Runs of one event.

    Parameters
    ----------
    event : Event
    vary : mapping
        Distributions by dotted name, as for `Ensemble`.
    maps : sequence of str
        Maps to keep besides those that observations need.
    seed : int
        Seed of noise on the elevation.
    batch : int
        Members that are computed and written together.
    name : str
        Name of the event.

    Attributes
    ----------
    scene : Scene
    varied : tuple of Varied
    place : Place
    observations : tuple of Observation
    bound : tuple of Bound
        Observations at the nodes of the event.
    """

    def __init__(
        self, event: Event, vary: Mapping[str, Any], maps: Sequence[str], seed: int, batch: int, name: str
    ) -> None:  # fmt: skip
        self.name, self.observations, self._vary, self._seed = name, tuple(event.observations), vary, seed
        if not self.observations:
            raise InputError(
                f"calibration: {name or 'the event'} has no observations; give at least one, such as Measure"
            )
        needed = [map_name for one in self.observations for map_name in one.maps]
        self.maps, self._batch = tuple(dict.fromkeys([*maps, *needed])), batch
        prior = Ensemble(event.scene, vary, members=2, sampling="random", maps=self.maps, batch=batch, seed=seed)
        self.scene = prior.scene
        if prior.automatic:
            raise ParameterError(
                "calibration: all generations need one number of particles; set numerics: particle_count, such as that "
                "of Ensemble(...).plan()"
            )
        self.varied = varied_values(vary, self.scene.content)
        self._check_places()
        self.place = Place.of_basis(prior.basis())
        self.bound: tuple[Bound, ...] = tuple(one.at(self.place) for one in self.observations)

    @property
    def identity(self) -> list[Any]:
        """Scene, distributions and observations, for a digest."""
        scene = [self.scene.digest(), self.scene.output_keys.max_duration]
        observed = [[one.label, *one.content] for one in self.bound]
        return [self.name, scene, observed, self.maps, self._batch]

    def run(
        self, design: xr.Dataset, client: Any, store: Path | None, workers: int | None, notify: Callable[[str], None]
    ) -> EnsembleResults:  # fmt: skip
        """Run a table of members.

        Parameters
        ----------
        design : xarray.Dataset
            As `Prior.design` returns it.
        client, store, workers, notify
            As of `Ensemble.run`.

        Returns
        -------
        EnsembleResults
        """
        ensemble = Ensemble(self.scene, sampling=design, maps=self.maps, batch=self._batch, seed=self._seed)
        return ensemble.run(client, store, workers=workers, notify=notify)

    def misfits(self, results: EnsembleResults) -> np.ndarray:
        """Return the misfits of all members, shape (members, observations); NaN after a failure.

        Parameters
        ----------
        results : EnsembleResults
        """
        found = np.full((results.design.sizes["member"], len(self.bound)), np.nan)
        for one in results.members():
            if not one.error:
                found[one.member] = [each.misfit(one) for each in self.bound]
        return found

    def with_particles(self, count: int) -> "EventRuns":
        """Return the event with another number of particles.

        Parameters
        ----------
        count : int
        """
        mapping = self.scene.to_mapping()
        numerics = {k: value for k, value in mapping.get("numerics", {}).items() if k != "particle_spacing"}
        mapping["numerics"] = numerics | {"particle_count": count}
        scene = Scene.from_mapping(mapping, self.scene.folder, self.scene.name)
        return self.like(Event(scene, self.observations))

    def like(self, event: Event) -> "EventRuns":
        """Return the runs of another event, with the same values that vary and maps that are kept.

        Parameters
        ----------
        event : Event
        """
        return EventRuns(event, self._vary, self.maps, self._seed, self._batch, self.name)

    def _check_places(self) -> None:
        window = self.scene.content.terrain.window
        for one in self.varied:
            place = one.name.path[0] == "release" and one.name.path[-1] in PLACES
            if place and isinstance(one.distribution, Choices) and window is None:
                raise ParameterError(
                    f"calibration: {one.name.key} moves the release, and all generations need the same nodes; give "
                    "terrain: window: [west, south, east, north]"
                )
