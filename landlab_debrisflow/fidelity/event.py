"""An event: grid, setup and releases, which a pilot run repeats on a copy."""

import dataclasses
from collections.abc import Callable, Sequence
from functools import cached_property
from typing import Any

import numpy as np

from ..core.values import NodeValues
from ..grid.fields import fields_in_use
from ..grid.release import RELEASE_DEPTH
from ..physics.registry import LAWS
from ..scene.digest import digest
from ..scene.releases import ScheduledRelease, advance
from ..scene.setup import Setup
from .grids import coarse_grid, copy_grid, depth_on, put_back, write_release
from .quantities import origin_of


@dataclasses.dataclass(frozen=True)
class Event:
    """An event before it begins.

    Attributes
    ----------
    grid : RasterModelGrid
        Copy of the grid, on which the releases at time 0 are set.
    setup : Setup
        Laws, material, numerics and inflow, its times from the beginning of the event.
    max_duration : float
        Longest time to simulate [s].
    make : callable
        Class of the component.
    releases : tuple of ScheduledRelease
        Releases; those at time 0 are set.
    """

    grid: Any
    setup: Setup
    max_duration: float
    make: Callable[..., Any]
    releases: tuple[ScheduledRelease, ...] = ()

    def flow(self, setup: Setup, observers: Sequence[Any] = ()) -> Any:
        """Return a flow of the event on a copy of its grid, which the next flow takes over.

        Parameters
        ----------
        setup : Setup
            Laws, material, numerics and inflow in place of the own ones.
        observers : sequence of observers
            As in `DebrisFlow`.

        Returns
        -------
        DebrisFlow
        """
        put_back(self._spare, self.grid)
        return self.make(self._spare, **vars(setup), observers=list(observers))

    @cached_property
    def _spare(self) -> Any:
        return copy_grid(self.grid)  # all pilot runs share one grid: building a grid takes as long as a short run

    def run(self, flow: Any) -> None:
        """Run a flow of the event to rest, or for the longest time.

        Parameters
        ----------
        flow : DebrisFlow
            As `flow` returned it.
        """
        advance(flow, self.releases, self.max_duration)

    def coarse(self) -> "Event":
        """Return the event on every second row and column of the grid.

        Raises
        ------
        InputError
            If too few nodes stay.
        """
        grid = coarse_grid(self.grid)
        releases = tuple(_coarse_release(grid, one) for one in self.releases)
        setup = _coarse_setup(self.setup, self.grid.shape)
        return dataclasses.replace(self, grid=grid, setup=setup, releases=releases)

    @property
    def volume(self) -> float:
        """Volume that is released and flows in [m3]."""
        later = sum(float(one.depth.sum()) for one in self.releases if one.time > 0.0)
        cell = float(self.grid.dx * self.grid.dy)
        released = (float(self.grid.at_node[RELEASE_DEPTH].sum()) + later) * cell
        return released + sum(hydrograph.volume for hydrograph in self.setup.inflow)

    @property
    def release_depth(self) -> np.ndarray:
        """Depth of all releases at each node, shape (nodes,) [m]."""
        later = [one.depth.ravel() for one in self.releases if one.time > 0.0]
        return np.sum([self.grid.at_node[RELEASE_DEPTH], *later], axis=0)

    def ground_digest(self) -> str:
        """Return 32 hexadecimal digits that differ where fields, statuses or place of the grid differ."""
        grid = self.grid
        laws = {kind: getattr(self.setup, kind) for kind in ("friction", "erosion")}
        fields = fields_in_use(grid, laws)
        frame = [tuple(grid.shape), float(grid.dx), float(grid.dy), [float(axis) for axis in grid.xy_of_lower_left]]
        later = [[one.time, one.depth, one.source, one.velocity] for one in self.releases if one.time > 0.0]
        values = {name: np.asarray(field, float) for name, field in fields.items() if np.any(field)}
        return digest([frame, np.array(grid.status_at_node), values, later])


def event_of_grid(
    grid: Any, setup: Setup, max_duration: float, make: Callable[..., Any], releases: Sequence[ScheduledRelease] = ()
) -> Event:
    """Return the event that begins on a grid, of which a copy is taken.

    Parameters
    ----------
    grid : RasterModelGrid
        Not changed.
    setup : Setup
    max_duration : float
        Longest time to simulate [s].
    make : callable
        Class of the component.
    releases : sequence of ScheduledRelease
        Releases; those at time 0 are set on the grid.

    Returns
    -------
    Event

    Raises
    ------
    InputError
        If a field is not usable.
    """
    copied = copy_grid(grid)
    write_release(copied)
    return Event(copied, setup, max_duration, make, tuple(releases))


def origin(event: Event) -> tuple[float, float]:
    """Return the place from where run-out is counted, x and y on the map [m]: the centre of the first release."""
    later = sorted((one for one in event.releases if one.time > 0.0), key=lambda one: one.time)
    if event.grid.at_node[RELEASE_DEPTH].any() or event.setup.inflow or not later:
        return origin_of(event.grid, event.setup)
    grid, weights = event.grid, later[0].depth.ravel()
    return float(np.average(grid.x_of_node, weights=weights)), float(np.average(grid.y_of_node, weights=weights))


def with_count(setup: Setup, count: int, **others: Any) -> Setup:
    """Return a setup with a number of particles, and other values of its numerics.

    Parameters
    ----------
    setup : Setup
    count : int
        Number of particles, in place of a spacing or of one to be found.
    **others
        Other values of `Numerics`.

    Returns
    -------
    Setup
    """
    found = {"particle_count": count, "particle_spacing": None, "tolerance": None, "hold": None}
    return dataclasses.replace(setup, numerics=dataclasses.replace(setup.numerics, **found | others))


def _coarse_release(grid, release: ScheduledRelease) -> ScheduledRelease:
    if release.time == 0.0:
        return release
    velocity = None if release.velocity is None else np.array([axis[::2, ::2] for axis in release.velocity])
    return release._replace(depth=depth_on(grid, release.depth), velocity=velocity)


def _coarse_setup(setup: Setup, shape: tuple[int, int]) -> Setup:
    """Return a setup with parameters at nodes for every second row and column."""
    laws = {}
    for kind in LAWS:
        law = getattr(setup, kind)
        fields = dataclasses.fields(law) if dataclasses.is_dataclass(law) else ()
        varying = {one.name: value for one in fields if isinstance(value := getattr(law, one.name), NodeValues)}
        coarse = {name: NodeValues(value.values.reshape(shape)[::2, ::2].ravel()) for name, value in varying.items()}
        if coarse:
            laws[kind] = dataclasses.replace(law, **coarse)
    return dataclasses.replace(setup, **laws) if laws else setup
