"""Start of the flow of a scene."""

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
        As in `DebrisFlow`.

    Returns
    -------
    DebrisFlow
    """
    for release in releases:
        if release.time == 0.0:
            set_release(grid, release)
    return DebrisFlow(grid, observers=observers, **vars(setup))
