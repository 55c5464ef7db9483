"""Plans of scenes, with all their releases."""

from collections.abc import Callable, Sequence
from typing import Any

from ..component import DebrisFlow
from ..fidelity.event import Event, event_of_grid
from ..fidelity.plan import Plan
from ..fidelity.planner import make_plan
from ..fidelity.wishes import wishes_of
from ..scene.releases import ScheduledRelease, set_release
from ..scene.setup import Setup


def event_of(grid: Any, setup: Setup, releases: Sequence[ScheduledRelease], max_duration: float) -> Event:
    """Return the event that begins on a grid with some releases.

    Parameters
    ----------
    grid : RasterModelGrid
        With the fields of the terrain; the releases at time 0 are set on it.
    setup : Setup
    releases : sequence of ScheduledRelease
    max_duration : float
        Longest time to simulate [s].

    Returns
    -------
    Event
    """
    for release in releases:
        if release.time == 0.0:
            set_release(grid, release)
    return event_of_grid(grid, setup, max_duration, DebrisFlow, releases)


def event_of_scene(scene: Any) -> Event:
    """Return the event of a `Scene`."""
    return event_of(scene.grid(), scene.setup, scene.releases, scene.output_keys.max_duration)


def plan_scene(scene: Any, notify: Callable[[str], None] | None = None, **wishes: Any) -> Plan:
    """Make the plan of a scene.

    Parameters
    ----------
    scene : Scene
    notify : callable, optional
        Called with a text when a pilot run begins; by default the text is logged.
    **wishes
        Attributes of `Wishes`; tolerance and quantities to be held are by default those of the scene.

    Returns
    -------
    Plan

    Raises
    ------
    InputError, ParameterError, SimulationError, KeyboardInterrupt
        As in `DebrisFlow.plan`.
    """
    known = wishes_of(scene.setup, **wishes)
    return make_plan(event_of_scene(scene), known, *(() if notify is None else (notify,)))
