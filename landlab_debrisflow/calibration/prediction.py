"""Predictions of a posterior: its members run again with more particles, or in another event."""

import logging
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from ..core.checks import in_range
from ..core.errors import InputError
from ..fidelity.table import Printed, Table
from .event import Event, EventRuns
from .proposal import systematic
from .scores import Members, Score, score_members
from .weighted_members import WeightedMembers

log = logging.getLogger("landlab_debrisflow.progress")


class Prediction(Printed):
    """Scores of members that were run again; it prints itself.

    Attributes
    ----------
    title : str
    runs : EventRuns
        Event in which members were run.
    sets : dict of str to Members
        Members with weights by name.
    scores : list of Score
    notes : tuple of str
    """

    def __init__(self, title: str, runs: EventRuns, sets: dict[str, Members], notes: tuple[str, ...] = ()) -> None:
        self.title, self.runs, self.sets, self.notes = title, runs, sets, notes
        self.scores: list[Score] = score_members(runs, sets)

    def _table(self) -> Table:
        return Table(
            title=self.title, rows=[(one.name, one.words()) for one in self.scores], notes=self.notes
        )  # fmt: skip


def rescore(
    posterior: WeightedMembers, particle_count: int | None = None, *, members: int = 32, event: str | None = None,
    client: Any = None, store: str | Path | None = None, workers: int | None = None,
    notify: Callable[[str], None] = log.info,
) -> Prediction:  # fmt: skip
    """Run members of a posterior again with more particles, and score both runs.

    Parameters
    ----------
    posterior : WeightedMembers
    particle_count : int, optional
        By default twice that of the scene.
    members : int
        Members that are drawn by their weights.
    event : str, optional
        Name of the event, where there are several.
    client, store, workers, notify
        As of `Ensemble.run`.

    Returns
    -------
    Prediction

    Raises
    ------
    InputError
        If the scene counts no particles by number and none is given.
    """
    runs = posterior.event(event)
    own = runs.scene.content.setup.numerics.particle_count
    if particle_count is None:
        if not isinstance(own, int):
            raise InputError("calibration: the scene has no particle_count; give rescore one, twice that of the scene")
        particle_count = 2 * own
    in_range("calibration: particle_count", particle_count, 1, error=InputError)
    finer, (index, weights) = runs.with_particles(particle_count), _drawn(posterior.weights, members)
    misfits = posterior.sample.misfits[index][:, posterior.columns_of(runs.name)]
    full = np.zeros(posterior.weights.size)
    full[index] = weights
    before = posterior.members_of(runs.name, full)
    design = posterior.prior.design(posterior.sample.uniform[index])
    results = finer.run(design, client, None if store is None else Path(store), workers, notify)
    again = Members([results], weights, finer.misfits(results))
    change = np.sqrt(np.nanmean(np.where(np.isfinite(again.misfits), again.misfits - misfits, np.nan) ** 2, axis=0))
    words = ", ".join(f"{one.label} {value:.3g}" for one, value in zip(runs.bound, change, strict=True))
    notes = (f"misfits of single members change by (root mean square, units as above): {words}",)
    return Prediction(
        f"Posterior with more particles, {len(index)} members", runs,
        {f"{own or 'scene'} particles": before, f"{particle_count} particles": again}, notes,
    )  # fmt: skip


def predict(
    posterior: WeightedMembers, event: Event, *, members: int = 32, client: Any = None, store: str | Path | None = None,
    workers: int | None = None, notify: Callable[[str], None] = log.info,
) -> Prediction:  # fmt: skip
    """Run members of a posterior and of its prior in another event, and score both.

    Parameters
    ----------
    posterior : WeightedMembers
    event : Event
    members : int
        Members that are drawn by their weights, and as many of the prior.
    client, workers, notify
        As of `Ensemble.run`.
    store : str or Path, optional
        Directory for the results of both.

    Returns
    -------
    Prediction
    """
    runs = posterior.runs[0].like(event)
    sets, folder = {}, None if store is None else Path(store)
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
    for name, weights in (("posterior", posterior.weights), ("prior", posterior.prior_weights)):
        index, drawn = _drawn(weights, members)
        design, path = posterior.prior.design(posterior.sample.uniform[index]), folder and folder / f"{name}.zarr"
        results = runs.run(design, client, path, workers, notify)
        sets[name] = Members([results], drawn, runs.misfits(results))
    note = "the event took no part in the calibration: these scores are out of sample"
    return Prediction(f"Prediction of {runs.scene.name}", runs, sets, (note,))


def _drawn(weights: np.ndarray, members: int) -> tuple[np.ndarray, np.ndarray]:
    """Return different members drawn by their weights, and the part of the draw that each of them has."""
    index, counts = np.unique(systematic(weights, members, np.random.default_rng(0)), return_counts=True)
    return index, counts / counts.sum()
