"""Runs of the campaigns in the order in which they are made: scene by scene, so that finished scenes can be scored."""

from .runs import Run
from .scenes import NINE
from .seeds import DILATANT, FIT, HELD_OUT

TRUTH, FULL = 16000, 8000
"""Particles of the run that counts as truth, and of the one over which costs are; both with the default steps."""

SETS = {
    "nine": list(NINE), "fit": [f"r{seed}" for seed in FIT], "held-out": [f"r{seed}" for seed in HELD_OUT],
    "dilatant": ["loose debris", *(f"r{seed}" for seed in DILATANT)],
}  # fmt: skip
"""Sets of scenes by name."""

FAST = (250, 500, 1000, 2000, 4000, 8000)
DEFAULT = (500, 1000, 2000, 4000, FULL, TRUTH)  # convergence; of scenes that fit nothing the last two only
BEFORE = (500, 1000, 2000, FULL)
COARSE = (500, 1000)
"""Particles of the runs with fast steps, with the default ones, of an engine before a change, and on every second
node."""

PHYSICS = ("column=none", "column=classical", "column=ale", "flow=two_phase", "flow=one_phase")
PHYSICS_PARTICLES = 1000
"""Choices of physics and the number of particles with which they are run in the nine scenes."""


def runs_of(scene: str, label: str, short: bool = False) -> list[Run]:
    """Return the runs of a scene; `short`: of an engine before a change, which has no fast steps."""
    if short:
        return [Run(label, scene, count) for count in BEFORE]
    runs = [Run(label, scene, count, "fast") for count in FAST]
    runs += [Run(label, scene, count, "fast+coarse") for count in COARSE]
    unseen = scene in SETS["held-out"] or scene in SETS["dilatant"]
    runs += [Run(label, scene, count) for count in ((FULL, TRUTH) if unseen else DEFAULT)]
    if not unseen:
        runs.append(Run(label, scene, PHYSICS_PARTICLES, "fastest"))
    if scene in NINE:
        runs += [Run(label, scene, PHYSICS_PARTICLES, word) for word in PHYSICS]
    return runs


def campaign(label: str, scenes, short: bool = False) -> list[Run]:
    """Return the runs of all scenes."""
    return [run for scene in scenes for run in runs_of(scene, label, short)]
