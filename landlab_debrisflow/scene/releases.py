"""Releases of a scene, from their keys and files to depths over nodes."""

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from ..core.errors import InputError
from .keys import ReleaseKeys
from .location import located
from .read_yaml import YamlFile
from .release import lay_on_top
from .release_depths import Ground, polygon_depths, raster_depth

FEWEST_NODES = 12
"""Least number of nodes with which a release is resolved."""


class ScheduledRelease(NamedTuple):
    """Release at some time.

    Attributes
    ----------
    time : float
        Elapsed time at which the mass starts to move [s].
    depth : ndarray, shape (rows, columns)
        Vertical depth that starts to move [m].
    source : {"ground", "above"}
        Whether it fails out of the ground or is laid on top of it.
    velocity : ndarray, shape (2, rows, columns), or None
        Towards east and north, over the map [m/s]; None: from rest.
    label : str
        Key of the scene, for messages.
    notes : tuple of str
        Remarks and doubts for the user.
    """

    time: float
    depth: np.ndarray
    source: str = "ground"
    velocity: np.ndarray | None = None
    label: str = "release"
    notes: tuple[str, ...] = ()


def schedule_releases(
    releases: Iterable[ReleaseKeys], terrain: xr.Dataset, folder: Path, file: YamlFile | None = None
) -> list[ScheduledRelease]:
    """Return the releases of a scene, without the inflow at points, in the order of their times.

    Parameters
    ----------
    releases : iterable of ReleaseKeys
    terrain : xarray.Dataset
        As `build_terrain` returns it.
    folder : Path
        Directory to which names of files are relative.
    file : YamlFile, optional
        Scene file, to name lines.

    Returns
    -------
    list of ScheduledRelease

    Raises
    ------
    InputError
        If a file cannot be used, a polygon has no depth, or no mass lies on nodes that may hold mass.
    """
    scheduled, ground = [], Ground.of(terrain)
    releases = list(releases)
    for k, keys in enumerate(releases):
        if keys.kind == "points":
            continue
        path = ("release", k) if file is None or ("release", k) in file.lines else ("release",)
        with located(file, *path):
            scheduled.append(_scheduled(keys, ground, folder, f"release[{k}]" if len(path) > 1 else "release"))
    return sorted(scheduled, key=lambda release: release.time)


def _scheduled(keys: ReleaseKeys, ground: Ground, folder: Path, label: str) -> ScheduledRelease:
    found = polygon_depths(keys, ground, folder) if keys.kind == "polygons" else raster_depth(keys, ground, folder)
    shape, moves = ground.lattice.shape, keys.velocity is not None or keys.speed is not None
    depth, weighted, notes = np.zeros(shape), np.zeros((2, *shape)) if moves else None, []
    for body in found:
        depth += body.depth
        notes += body.notes
        if weighted is not None:
            weighted += body.depth * _start_velocity(keys, body.depth, ground)[:, None, None]
    velocity = None
    if weighted is not None:
        velocity = np.divide(weighted, depth, out=np.zeros_like(weighted), where=depth > 0.0)
    notes += _doubts(keys, depth, ground)
    return ScheduledRelease(keys.time, depth, keys.from_, velocity, label, tuple(f"{label}: {note}" for note in notes))


def _start_velocity(keys: ReleaseKeys, depth: np.ndarray, ground: Ground) -> np.ndarray:
    """Return the velocity of a body at the start over the map, shape (2,) [m/s]."""
    if keys.velocity is not None:
        return np.array(keys.velocity)
    if not keys.speed:
        return np.zeros(2)
    slope = ground.plane_slope(depth > 0.0)
    steepness = float(np.hypot(*slope))
    if steepness < 1e-3:
        raise InputError("speed goes down the slope, but the ground of the release is level; give velocity: [vx, vy]")
    return -keys.speed * slope / (steepness * np.hypot(1.0, steepness))


NEGLIGIBLE = 0.01
"""Depth below the soil up to which no note is given [m]: a mean depth equal to that of the soil has larger rounding."""


def _doubts(keys: ReleaseKeys, depth: np.ndarray, ground: Ground) -> list[str]:
    """Return doubts about a release as sentences."""
    lattice, count, notes = ground.lattice, int(np.count_nonzero(depth)), []
    if count < FEWEST_NODES:
        notes.append(
            f"the release covers {count} node{'s' * (count > 1)} of {lattice.spacing[0]:g} m; its volume is kept, its "
            "shape is not: a finer spacing of the terrain would resolve it"
        )
    if depth.max() > 100.0:
        notes.append(f"the release is up to {depth.max():.4g} m deep; depths are in m, volumes in m3")
    if keys.from_ == "ground" and ground.soil is not None:
        deeper = depth > ground.soil + NEGLIGIBLE
        if deeper.any():
            notes.append(
                f"the release is deeper than the soil at {np.count_nonzero(deeper)} nodes, by up to "
                f"{(depth - ground.soil)[deeper].max():.3g} m; the soil is taken to reach down to the failure surface"
            )
    return notes


def set_release(grid: Any, release: ScheduledRelease) -> None:
    """Set the fields of a grid by which `DebrisFlow` releases a mass at its next call.

    Parameters
    ----------
    grid : RasterModelGrid
        With the fields of the terrain; missing fields of the release are added.
    release : ScheduledRelease
    """
    depth, at = release.depth.reshape(-1), grid.at_node
    asked = _field(grid, "debris_flow__release_depth")
    names = [f"debris_flow__release_velocity_{axis}" for axis in "xy"]
    if release.velocity is not None or names[0] in at:  # a release from rest slows another release on the same nodes
        at_rest = np.zeros((2, depth.size))
        for name, values in zip(names, at_rest if release.velocity is None else release.velocity, strict=True):
            velocity = _field(grid, name)
            momentum = asked * velocity + depth * values.reshape(-1)
            np.divide(momentum, asked + depth, out=velocity, where=asked + depth > 0.0)
    if release.source == "above":
        lay_on_top(grid, depth)
    else:
        asked += depth
    if "soil__depth" in at:
        np.maximum(at["soil__depth"], asked, out=at["soil__depth"])


def advance(flow: Any, releases: Sequence[ScheduledRelease], end: float) -> None:
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


def _field(grid: Any, name: str) -> np.ndarray:
    return grid.at_node[name] if name in grid.at_node else grid.add_zeros(name, at="node")
