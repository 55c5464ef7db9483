"""Run of one member of an ensemble."""

import dataclasses
import threading
from collections.abc import Mapping, Sequence
from pathlib import Path
from time import thread_time
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from ..component import DebrisFlow
from ..fidelity.grids import copy_grid, put_back
from ..fidelity.pilots import collected_warnings
from ..fidelity.quantities import origin_of
from ..grid.fields import OUTPUT_PREFIX
from ..record.attributes import variable_attributes
from ..record.measures import ELEVATION, RELEASE, measures
from ..run.advance import start
from ..run.grids import build_grid
from ..scene.content import SceneContent
from ..scene.point_inflow import point_hydrographs
from ..scene.releases import ScheduledRelease, advance
from ..scene.setup import Setup
from .basis import Basis, rebuilt_terrain, scheduled
from .distributions import NoiseRealisations
from .edits import with_values
from .names import FACTOR, NOISE
from .noise import correlated_noise
from .result import ARRIVAL, MemberResult, touched_window


class MemberOutcome(NamedTuple):
    """Result of a member, with units of its measures and the time of its run.

    Attributes
    ----------
    result : MemberResult
    attributes : dict of str to dict
        Unit and meaning of the measures by name; empty after a failure.
    seconds : float
        CPU time of the thread [s].
    """

    result: MemberResult
    attributes: dict[str, dict[str, str]]
    seconds: float


class MemberRun(NamedTuple):
    """Ground, releases and setup of a member.

    Attributes
    ----------
    terrain : xarray.Dataset or None
        Ground of the member; None: the ground of the basis.
    releases : tuple of ScheduledRelease
        Releases in the order of their times.
    setup : Setup
        Setup with one thread.
    max_duration : float
        Longest time to simulate [s].
    """

    terrain: xr.Dataset | None
    releases: tuple[ScheduledRelease, ...]
    setup: Setup
    max_duration: float


def prepare_member(basis: Basis, values: Mapping[str, Any]) -> MemberRun:
    """Return ground, releases and setup of a member.

    Parameters
    ----------
    basis : Basis
    values : mapping of str to object
        Values by dotted name.

    Returns
    -------
    MemberRun

    Raises
    ------
    InputError, ParameterError
        If the values cannot be used together.
    """
    paths = {one.name.path: values[one.name.key] for one in basis.varied}
    content = with_values(basis.content, paths)
    ground_varies, releases, terrain = basis.ground_varies, basis.releases, basis.terrain
    if any(path[0] != "release" and path[-1] not in (FACTOR, NOISE) for path in paths) and ground_varies:
        terrain = rebuilt_terrain(content, basis.folder, basis.lattice)
    for one in basis.varied:
        if isinstance(one.distribution, NoiseRealisations):
            terrain = _with_noise(terrain, one.distribution, (basis.seed, values[one.name.key]), basis)
    if basis.releases_vary:
        releases = scheduled(content.release, terrain, basis.folder)
    ordered = _with_factors(releases, paths)
    setup = _setup(content, terrain, basis.folder, paths)
    return MemberRun(terrain if ground_varies else None, ordered, setup, content.output.max_duration)


def run_member(basis: Basis, member: int, values: Mapping[str, Any]) -> MemberOutcome:
    """Run a member of an ensemble to rest; an error is part of its result.

    Parameters
    ----------
    basis : Basis
    member : int
        Number of the member.
    values : mapping of str to object
        Values by dotted name.

    Returns
    -------
    MemberOutcome
    """
    began, given = thread_time(), dict(values)
    try:
        with collected_warnings():
            result, attributes = _run(basis, member, given, prepare_member(basis, given))
    except Exception as error:  # a member that fails is kept with its error, and further members count
        text = f"{type(error).__name__}: {error}"
        result, attributes = MemberResult(member, given, {}, slice(0, 0), slice(0, 0), {}, text), {}
    return MemberOutcome(result, attributes, thread_time() - began)


def _run(
    basis: Basis, member: int, values: dict[str, Any], prepared: MemberRun
) -> tuple[MemberResult, dict[str, dict[str, str]]]:
    grid = _grid(basis) if prepared.terrain is None else build_grid(prepared.terrain)
    flow = start(grid, prepared.setup, prepared.releases)
    before, origin = _before(flow), origin_of(grid, prepared.setup)
    advance(flow, prepared.releases, prepared.max_duration)
    found = measures(flow, before, distance=lambda x, y: np.hypot(x - origin[0], y - origin[1]))
    found["at_rest"] = (), float(flow.at_rest), variable_attributes("-", "whether the whole flow came to rest: 1 or 0")
    numbers = {str(name): float(value) for name, value in found.data_vars.items()}
    attributes = {str(name): dict(value.attrs) for name, value in found.data_vars.items()}
    maps = {name: _map(flow, name) for name in basis.maps}
    rows, columns = touched_window(maps)
    kept = {name: np.ascontiguousarray(whole[rows, columns]) for name, whole in maps.items()}
    return MemberResult(member, values, numbers, rows, columns, kept), attributes


def _map(flow: DebrisFlow, name: str) -> np.ndarray:
    """Return a map of a flow in float32, shape (rows, columns): 0 where nothing came, the arrival time NaN."""
    values = flow.grid.at_node[OUTPUT_PREFIX + name].reshape(flow.grid.shape).astype(np.float32)
    if name == ARRIVAL:
        values[values < 0.0] = np.nan
    return values


def _before(flow: DebrisFlow) -> xr.Dataset:
    """Return elevation and release before the event over ``y`` and ``x`` [m]."""
    grid = flow.grid
    x, y = (axis.reshape(grid.shape) for axis in (grid.x_of_node, grid.y_of_node))
    fields = {name: (("y", "x"), grid.at_node[name].reshape(grid.shape).copy()) for name in (ELEVATION, RELEASE)}
    return xr.Dataset(fields, {"y": y[:, 0], "x": x[0]})


_known = threading.local()
"""Grid of the basis that a thread has used last, with a copy to run on."""


def _grid(basis: Basis) -> Any:
    """Return a grid with the ground of the basis, which the next run of the thread takes over."""
    if getattr(_known, "digest", None) != basis.digest:
        grid = build_grid(basis.terrain)
        _known.digest, _known.grid, _known.spare = basis.digest, grid, copy_grid(grid)
    put_back(_known.spare, _known.grid)
    return _known.spare


def _with_noise(terrain: xr.Dataset, noise: NoiseRealisations, seed: tuple[int, int], basis: Basis) -> xr.Dataset:
    added = correlated_noise(basis.lattice, noise.rms, noise.length, seed)
    return terrain.assign({ELEVATION: terrain[ELEVATION] + added})


def _with_factors(
    releases: Sequence[ScheduledRelease | None], paths: Mapping[tuple[str | int, ...], Any]
) -> tuple[ScheduledRelease, ...]:
    """Return the releases in the order of their times, with the factors on them."""
    found = []
    for k, release in enumerate(releases):
        if release is not None:
            factor = _factor("release", k, paths)
            found.append(release if factor == 1.0 else release._replace(depth=release.depth * factor))
    return tuple(sorted(found, key=lambda release: release.time))


def _factor(kind: str, k: int, paths: Mapping[tuple[str | int, ...], Any]) -> float:
    return float(paths.get((kind, FACTOR), 1.0)) * float(paths.get((kind, k, FACTOR), 1.0))


def _setup(
    content: SceneContent, terrain: xr.Dataset, folder: Path, paths: Mapping[tuple[str | int, ...], Any]
) -> Setup:
    """Return the setup of a member: one thread, the inflow with that at points and with the factors."""
    setup = content.setup_on_grid
    inflow = [_times(line, _factor("inflow", k, paths)) for k, line in enumerate(setup.inflow)]
    for k, keys in enumerate(content.release):
        if keys.kind == "points":
            factor = _factor("release", k, paths)
            inflow += [_times(line, factor) for line in point_hydrographs([keys], terrain, folder)]
    numerics = dataclasses.replace(setup.numerics, threads=1)
    return dataclasses.replace(setup, inflow=tuple(inflow), numerics=numerics)


def _times(line: Any, factor: float) -> Any:
    if factor == 1.0:
        return line
    return dataclasses.replace(line, discharge=tuple(factor * value for value in line.discharge))
