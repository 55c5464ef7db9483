"""Replay the choice of a plan from stored runs: the same functions that `DebrisFlow.plan` calls, without a run."""

import math
from collections.abc import Mapping
from typing import NamedTuple

from landlab_debrisflow.fidelity.constants import FAST_TOLERANCE, MOST_PARTICLES, PILOTS, RASTER_COST, RASTER_PILOTS
from landlab_debrisflow.fidelity.errors import count_asked, errors_after, errors_with, next_count, stated_errors
from landlab_debrisflow.fidelity.raster import raster_errors
from landlab_debrisflow.model.numerics import QUANTITIES

from .campaign import FULL, TRUTH
from .measure import quantities as measured
from .runs import Run


class Choice(NamedTuple):
    """What a plan would have chosen and stated, and what is true.

    Attributes
    ----------
    particles : int
    planned, stated : dict of str to float
        Errors of particles stated before and after the run [-].
    true : dict of str to float
        Errors of the run against the truth [-].
    raster : dict of str to float
        Errors of the raster [-]; empty if it is not examined.
    cost, pilots, again, raster_cost : float
        CPU time over that of the full run [-]: of pilots and run; of the pilots in it; of the run in it if it repeats
        the last pilot, else 0; of the pilot with every second node, which is not in the first.
    """

    particles: int
    planned: dict[str, float]
    stated: dict[str, float]
    true: dict[str, float]
    raster: dict[str, float]
    cost: float
    pilots: float
    again: float
    raster_cost: float


def by_scene(results: Mapping[Run, dict]) -> dict[str, dict[tuple[str, int], dict]]:
    """Return results by scene, and there by variation and number of particles; what is not known is NaN."""
    found: dict[str, dict[tuple[str, int], dict]] = {}
    for run, result in results.items():
        values = {name: math.nan if value is None else value for name, value in result.items()}
        found.setdefault(run.scene, {})[run.variation, run.particles] = values
    return found


def relative(value: float, truth: float) -> float:
    """Return the error of a value [-]; 0 if both are 0, NaN if the truth is unknown or only it is 0."""
    if value == truth == 0.0:
        return 0.0
    return abs(value / truth - 1.0) if truth else math.nan


def true_errors(result: Mapping, truth: Mapping) -> dict[str, float]:
    """Return the error of each quantity of a run [-], from another run that counts as truth."""
    return {name: relative(result[name], truth[name]) for name in QUANTITIES}


def pilots_of(runs: Mapping, steps: str) -> dict[int, dict[str, float]]:
    """Return the quantities of the pilot runs by number of particles; `steps` is the variation."""
    return {count: {name: runs[steps, count][name] for name in measured.UNITS} for count in PILOTS}


def replay(runs: Mapping, tolerance: float, hold, most: int = MOST_PARTICLES) -> Choice:
    """Return what a plan chooses in a scene.

    Parameters
    ----------
    runs : mapping
        Of one scene, from `by_scene`.
    tolerance : float
        [-].
    hold : sequence of str
        Quantities.
    most : int
        Most particles.

    Raises
    ------
    KeyError
        If a run is missing that the plan would have made.
    """
    steps = "fast" if tolerance >= FAST_TOLERANCE else ""
    pilots, finest = pilots_of(runs, steps), PILOTS[-1]
    errors = stated_errors(pilots)
    count = next_count(count_asked(errors, finest, tolerance, hold), finest, most)
    run, full, truth = runs[steps, count], runs["", FULL]["seconds"], runs["", TRUTH]
    after = errors_after(pilots | {count: {name: run[name] for name in measured.UNITS}}, count, finest)
    before = sum(runs[steps, pilot]["seconds"] for pilot in PILOTS)
    raster, raster_cost = replay_raster(runs, steps, before + run["seconds"])
    return Choice(
        particles=count, planned=errors_with(errors, count, finest) if count > finest else errors, stated=after,
        true=true_errors(run, truth), raster=raster, cost=(before + run["seconds"]) / full, pilots=before / full,
        again=run["seconds"] / full if count == finest else 0.0,
        raster_cost=raster_cost / full,
    )  # fmt: skip


def replay_raster(runs: Mapping, steps: str, seconds: float) -> tuple[dict[str, float], float]:
    """Return the errors of the raster [-] and the CPU time of finding them [s], by the rule of a plan.

    `seconds` is the CPU time of pilots and run.
    """
    coarse = "+".join(filter(None, (steps, "coarse")))
    for count in RASTER_PILOTS:
        if (coarse, count) in runs and runs[coarse, count]["seconds"] <= RASTER_COST * seconds:
            return raster_errors(runs[steps, count], runs[coarse, count]), runs[coarse, count]["seconds"]
    return {}, 0.0


def complete(scenes: Mapping, names) -> list[str]:
    """Return the scenes of which the truth, the full run and all runs with fast steps are there."""
    needed = [("", FULL), ("", TRUTH), *(("fast", count) for count in (*PILOTS, 2000, 4000, 8000))]
    return [name for name in names if all(key in scenes.get(name, {}) for key in needed)]
