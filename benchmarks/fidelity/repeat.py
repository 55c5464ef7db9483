"""Repeat kept runs with the engine as it is: whether what was measured with an earlier version still stands."""

import random
from collections.abc import Callable, Mapping, Sequence

from .runs import Run, result_of

ABOUT_TIME = ("seconds",)
"""Values of a result that differ from run to run."""


def draw_runs(kept: Mapping[Run, dict], scenes: Sequence[str], count: int, seed: int) -> list[Run]:
    """Return some kept runs of some scenes with at most 1000 particles, drawn at random."""
    found = [run for run in kept if run.scene in scenes and run.particles <= 1000]
    return random.Random(seed).sample(found, min(count, len(found)))


def differences(kept: Mapping, now: Mapping) -> dict[str, tuple]:
    """Return the values of a result that are not those that were kept, by name: both of them."""
    names = {*kept, *now} - {*ABOUT_TIME}
    return {name: (kept.get(name), now.get(name)) for name in sorted(names) if kept.get(name) != now.get(name)}


def print_repeated(kept: Mapping[Run, dict], runs: Sequence[Run], repeat: Callable[[Run], dict] = result_of) -> bool:
    """Repeat runs, print what differs from the kept results, and return whether all are equal.

    Results are kept with five digits, of which all count, and with the number of steps; the time does not count.
    """
    equal = 0
    for run in runs:
        now = repeat(run)
        found = {"failure": (None, now["failure"])} if "failure" in now else differences(kept[run], now)
        words = " ".join(filter(None, (run.scene, str(run.particles), run.variation)))
        changes = "; ".join(f"{name} {before} now {after}" for name, (before, after) in found.items())
        print(f"{words}: {changes or 'equal'}", flush=True)
        equal += not found
    print(f"{equal} of {len(runs)} runs are equal in every digit that is kept")
    return equal == len(runs)
