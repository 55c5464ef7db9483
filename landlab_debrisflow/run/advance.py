"""Advance a flow through the releases of a scene."""

from typing import Any

from ..component import DebrisFlow
from ..core.errors import InputError
from ..scene.releases import set_release


def check_mass(scene: Any) -> None:
    """Refuse a `Scene` in which nothing is released and nothing flows in.

    Raises
    ------
    InputError
    """
    if not scene.releases and not scene.setup.inflow:
        raise InputError(f"{scene.name}: nothing is released and nothing flows in; give release or inflow")


def advance(flow: DebrisFlow, scene: Any) -> None:
    """Advance a new flow, or one from a checkpoint, to rest or the longest time, with the releases still to come.

    A release at the time at which an unfinished call was to end is still to come; one at its beginning is in the flow.

    Parameters
    ----------
    flow : DebrisFlow
        Of `Scene.flow`, or loaded.
    scene : Scene
    """
    reached = flow.elapsed_time if flow.unfinished_until is None else flow.unfinished_until
    end = scene.output_keys.max_duration
    for release in scene.releases:
        if release.time == 0.0 or not reached * (1.0 - 1e-12) <= release.time < end:
            continue
        if (left := release.time - flow.elapsed_time) > 1e-12 * release.time:
            flow.run_one_step(left)
        set_release(flow.grid, release)
    if (left := end - flow.elapsed_time) > 0.0:
        flow.run_until_rest(left)
