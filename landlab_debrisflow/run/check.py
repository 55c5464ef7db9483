"""Check of a scene before its run: the forecast, or the plan if its number of particles is left to one."""

import dataclasses
from collections.abc import Callable
from typing import Any

from ..fidelity.plan import Plan
from .advance import check_mass
from .doubts import scene_doubts
from .forecast import Forecast, forecast, sentences


@dataclasses.dataclass(frozen=True, kw_only=True)
class PlannedRun:
    """Plan of the run of a scene, with remarks; it prints itself.

    Attributes
    ----------
    plan : Plan
    notes, doubts : tuple of str
        Remarks on files, and doubts.
    """

    plan: Plan
    notes: tuple[str, ...]
    doubts: tuple[str, ...]

    def __str__(self) -> str:
        return "\n".join([str(self.plan), *sentences(self.notes, self.doubts)])


def check(scene: Any, notify: Callable[[str], None] | None = None) -> Forecast | PlannedRun:
    """Check a scene and forecast or plan its run; no file is written.

    Parameters
    ----------
    scene : Scene
    notify : callable, optional
        Called with a text when a pilot run begins.

    Returns
    -------
    Forecast or PlannedRun
        A `PlannedRun` if numerics leave the number of particles to a plan.

    Raises
    ------
    InputError, ParameterError
        If a value or a file of the scene cannot be used.
    """
    if not scene.setup.numerics.automatic:
        return forecast(scene)
    check_mass(scene)
    _ = scene.places
    plan = scene.plan(notify=notify)
    return PlannedRun(plan=plan, notes=tuple(scene.notes), doubts=tuple(scene_doubts(scene.with_plan(plan))))
