"""Calibration of a scene, or of several, to observations of events."""

import json
import logging
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from ..core.checks import in_range
from ..core.errors import InputError, OutputError
from ..core.version import __version__
from ..ensemble import EnsembleResults
from ..ensemble.cluster import connected, processors
from ..record.files import write_atomically
from ..run.directory import locked
from ..scene.digest import digest
from ..scene.ensemble_keys import KEPT_MAPS
from .bound import Observation
from .criteria import Criterion, Likelihood, Tolerance
from .event import Event, EventRuns, Prior
from .model_error import ErrorModel
from .posterior import Posterior
from .sampler import draw_posterior

log = logging.getLogger("landlab_debrisflow.progress")

HEADER = "calibration.json"

PROBES = 16
"""Points at which the values of a prior enter the digest of a calibration."""


def calibrate(
    scene: Any, vary: Mapping[str, Any], observations: Sequence[Observation], *, members: int = 128,
    generations: int = 4, seed: int = 0, correlation: Any = None, maps: Sequence[str] = KEPT_MAPS, batch: int = 8,
    client: Any = None, store: str | Path | None = None, workers: int | None = None,
    notify: Callable[[str], None] = log.info,
) -> Posterior:  # fmt: skip
    """Calibrate varied values of a scene to observations of an event.

    With a stated error of every observation the result is a sample of the posterior, by sequential Monte Carlo; without
    errors it is approximate Bayesian computation (ABC), whose intervals depend on the tolerance.

    Parameters
    ----------
    scene : Scene, str, Path or mapping
        As for `Ensemble`; the number of particles is that of the scene.
    vary : mapping
        Prior distributions by dotted name, as for `Ensemble`; lists of choices are varied values, too.
    observations : sequence of Observation
        Such as `Measure`, `Volume`, `RunOut`, `AtPoint`, `ArrivalTime`, `ElevationChange`, `ChangeVolume`,
        `DepositOutline`.
    members : int
        Runs of each generation.
    generations : int
        Number of generations, the first one from the prior.
    seed : int
        Equal seeds give equal members.
    correlation : mapping or array_like, optional
        Rank correlations of the prior, as for `Ensemble`.
    maps : sequence of str
        Maps to keep, besides those that observations need.
    batch : int
        Members that are computed and written together.
    client, workers
        As of `Ensemble.run`.
    store : str or Path, optional
        Directory for the generations; that of the same calibration is continued. By default results stay in memory.
    notify : callable
        Called with a text as members are done.

    Returns
    -------
    Posterior

    Raises
    ------
    InputError, ParameterError
        If an argument cannot be used, the store holds another calibration, or no member reaches the observations.
    """
    return calibrate_events(
        {"": Event(scene, observations)}, vary, members=members, generations=generations, seed=seed,
        correlation=correlation, maps=maps, batch=batch, client=client, store=store, workers=workers, notify=notify,
    )  # fmt: skip


def calibrate_events(
    events: Mapping[str, Event], vary: Mapping[str, Any], *, members: int = 128, generations: int = 4, seed: int = 0,
    correlation: Any = None, maps: Sequence[str] = KEPT_MAPS, batch: int = 8, client: Any = None,
    store: str | Path | None = None, workers: int | None = None, notify: Callable[[str], None] = log.info,
) -> Posterior:  # fmt: skip
    """Calibrate values that several events have in common; a member is run in the scene of each event.

    Parameters
    ----------
    events : mapping of str to Event
        Scenes with their observations by name.
    vary, members, generations, seed, correlation, maps, batch, client, store, workers, notify
        As of `calibrate`; the dotted names exist in all scenes.

    Returns
    -------
    Posterior
        Its `leave_one_out` says how well each event is predicted by the others.

    Raises
    ------
    InputError, ParameterError
        As of `calibrate`.
    """
    for name, value, least in (("members", members, 8), ("generations", generations, 1)):
        in_range(f"calibration: {name}", value, least, 1_000_000, error=InputError)
    runs = [EventRuns(event, vary, maps, seed, batch, name) for name, event in events.items()]
    if not runs:
        raise InputError("calibration: there are no events; give a mapping of names to Event(scene, observations)")
    prior, criterion = Prior(runs[0].varied, correlation), criterion_of(runs, members)
    probes = prior.design(np.random.default_rng(0).random((PROBES, len(prior.keys))))
    values = [[str(name), column.values, dict(column.attrs)] for name, column in probes.data_vars.items()]
    errors = [each.stated and each.stated.model_error for one in runs for each in one.bound]
    identity = [[one.identity for one in runs], [errors.index(one) for one in errors], values, members, seed]
    folder = None if store is None else Path(store)
    results: dict[str, list[EnsembleResults]] = {one.name: [] for one in runs}
    with _opened(folder, digest([identity, __version__])), _workers(client, workers) as (found, count):

        def simulate(generation: int, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            points = _stored_points(folder, generation, points)
            notify(f"calibration: generation {generation + 1} of {generations}")
            columns = []
            for one in runs:
                path = None if folder is None else folder / _store_name(generation, one.name)
                results[one.name].append(one.run(prior.design(points), found, path, count, notify))
                columns.append(one.misfits(results[one.name][-1]))
            return points, np.concatenate(columns, axis=1)

        sample = draw_posterior(len(prior.keys), simulate, criterion, members, generations, seed)
    return Posterior(sample, prior, tuple(runs), results, criterion)


def criterion_of(runs: Sequence[EventRuns], members: int) -> Criterion:
    """Return the likelihood of observations with stated errors, or the tolerance of observations without.

    Parameters
    ----------
    runs : sequence of EventRuns
    members : int
        Members of the first generation.

    Raises
    ------
    InputError
        If some observations have stated errors and others do not.
    """
    bound = [each for one in runs for each in one.bound]
    stated = [each.stated for each in bound if each.stated is not None]
    if not stated:
        return Tolerance(members, [each.label for each in bound])
    if len(stated) < len(bound):
        without = next(each.label for each in bound if each.stated is None)
        raise InputError(
            f"calibration: {without} has no stated error and other observations have one; state sd of all (then the "
            "result is a posterior) or of none (then it is ABC)"
        )
    return Likelihood(ErrorModel(stated))


@contextmanager
def _opened(folder: Path | None, known: str) -> Iterator[None]:
    """Hold the directory of a calibration in a block, or make it."""
    if folder is None:
        yield
        return
    try:
        folder.mkdir(exist_ok=True, parents=True)
    except OSError as error:
        raise OutputError(f"cannot write the store {folder}: {error.strerror}; choose another") from error
    with locked(folder, "; wait for it, or choose another store"):
        header = folder / HEADER
        if header.exists():
            other = json.loads(header.read_text(encoding="utf-8")).get("digest")
            if other != known:
                raise InputError(
                    f"{folder} holds another calibration, of digest {other}; this one has {known}: scene, "
                    "distributions, observations, members, seed or version differ; choose another store, or remove it"
                )
        elif list(folder.glob("generation_*")):
            raise InputError(f"{folder} holds generations without {HEADER}; choose another store, or remove it")
        else:
            text = json.dumps({"digest": known, "version": __version__})
            write_atomically(header, lambda path: path.write_text(text, encoding="utf-8"))
        yield


@contextmanager
def _workers(client: Any, workers: int | None) -> Iterator[tuple[Any, int | None]]:
    """Yield a client for all generations, and the number of workers where none is needed."""
    count = processors() if workers is None and client is None else workers
    if client is None and count == 1:
        yield None, 1
        return
    with ExitStack() as ends:
        local = client is None and isinstance(count, int) and count > 1
        yield (ends.enter_context(connected(None, count)), None) if local else (client, workers)


def _store_name(generation: int, event: str) -> str:
    return f"generation_{generation:03d}{event and f'_{event}'}.zarr"


def _stored_points(folder: Path | None, generation: int, points: np.ndarray) -> np.ndarray:
    """Return the points of an earlier start, or store new ones: another machine may round proposals differently."""
    if folder is None:
        return points
    path = folder / f"generation_{generation:03d}.npy"
    if path.exists():
        found: np.ndarray = np.load(path)
        return found
    write_atomically(path, lambda temporary: np.save(temporary, points))
    return points
