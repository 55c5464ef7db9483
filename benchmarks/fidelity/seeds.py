"""Seeds of the random scenes: those to which constants are fitted, those that are held out, those with dilatancy.

A draw of a seed is taken if a run of it with 150 particles

* moves its centre by three nodes or more,
* loses at most 2 % of its volume over the edge, because the run-out of what has left is not known, and
* takes at most 450 steps (250 of two phases), which bounds the cost of finer runs.

Nothing else is known of a draw that is not taken. ``python -m benchmarks.fidelity seeds`` writes draws.json anew; which
draw was taken was so found with the version before any change of the engine that the scenes are meant to judge.
"""

import json
from functools import partial
from pathlib import Path

FIT = range(1, 71)
HELD_OUT = range(1001, 1131)
DILATANT = range(2001, 2013)

PARTICLES = 150
MOST_DRAWS = 50

TABLE = Path(__file__).with_name("draws.json")
DRAWS = {int(seed): draw for seed, draw in json.loads(TABLE.read_text()).items()} if TABLE.exists() else {}
"""Draw that is taken, by seed."""


def reason_against(result: dict, spacing: float, two_phases: bool) -> str:
    """Return why a draw is not taken, or nothing.

    Parameters
    ----------
    result : dict
        Of a run with `PARTICLES`, by `measure`.
    spacing : float
        Of the nodes [m].
    two_phases : bool
    """
    if result["outflow"] is None or result["outflow"] > 0.02:
        return "leaves"
    if result["centre"] is None or result["centre"] < 3.0 * spacing:
        return "hardly moves"
    return "long" if result["steps"] > (250 if two_phases else 450) else ""


def function_of(seed: int):
    """Return the function of seed and draw that makes a scene."""
    if seed in DILATANT:
        from .dilatant import dilatant_scene

        return dilatant_scene
    from .generator import random_scene

    return random_scene


def take_draws(seeds, report=print) -> dict[int, int]:
    """Return the first draw that is taken of each seed; `report` is told of each draw that is not."""
    from .measure import measure

    taken = {}
    for seed in seeds:
        for draw in range(MOST_DRAWS):
            make = partial(function_of(seed), seed, draw)
            scene, result = make(), measure(make, PARTICLES)
            reason = reason_against(result, scene.grid.dx, scene.keywords["flow"] == "two_phase")
            if not reason:
                taken[seed] = draw
                break
            report(f"seed {seed}, draw {draw}: {reason}")
        else:
            raise RuntimeError(f"none of {MOST_DRAWS} draws of seed {seed} moves on its grid")
    return taken
