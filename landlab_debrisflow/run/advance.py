"""Advance a flow through the releases of a scene."""

from collections.abc import Sequence
from typing import Any

from ..component import DebrisFlow
from ..core.errors import InputError
from ..scene.releases import ScheduledRelease, set_release
from ..scene.setup import Setup


def check_mass(scene: Any) -> None:
    """Refuse a `Scene` in which nothing is released and nothing flows in.

    Raises
    ------
    InputError
    """
    if not scene.releases and not scene.setup.inflow:
        raise InputError(f"{scene.name}: nothing is released and nothing flows in; give release or inflow")


def start(grid: Any, setup: Setup, releases: Sequence[ScheduledRelease], observers: Any = ()) -> DebrisFlow:
    """Return a flow on a grid, on which the releases at time 0 are set.

    Parameters
    ----------
    grid : RasterModelGrid
        With the fields of the terrain; it is changed.
    setup : Setup
    releases : sequence of ScheduledRelease
    observers : observer or sequence of them
        As of `DebrisFlow`.

    Returns
    -------
    DebrisFlow
    """
    for release in releases:
        if release.time == 0.0:
            set_release(grid, release)
    return DebrisFlow(grid, observers=observers, **vars(setup))


def advance(flow: DebrisFlow, releases: Sequence[ScheduledRelease], end: float) -> None:
    """Advance a flow that was started, or loaded, to rest or the longest time, with the releases still to come.

    A release at the time at which an unfinished call was to end is still to come; one at its beginning is in the flow.

    Parameters
    ----------
    flow : DebrisFlow
    releases : sequence of ScheduledRelease
        In the order of their times; those at time 0 are in the flow.
    end : float
        Longest elapsed time [s].
    """
    reached = flow.elapsed_time if flow.unfinished_until is None else flow.unfinished_until
    for release in releases:
        if release.time == 0.0 or not reached * (1.0 - 1e-12) <= release.time < end:
            continue
        if (left := release.time - flow.elapsed_time) > 1e-12 * release.time:
            flow.run_one_step(left)
        set_release(flow.grid, release)
    if (left := end - flow.elapsed_time) > 0.0:
        flow.run_until_rest(left)
