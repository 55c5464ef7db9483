"""Simulate an event as a function: setup and terrain in, maps out."""

from collections.abc import Mapping, Sequence
from typing import Any

import xarray as xr
from landlab import RasterModelGrid

from ..core.checks import in_range
from ..core.errors import InputError
from ..fidelity.grids import copy_grid
from ..fidelity.planner import make_plan
from ..fidelity.wishes import wishes_of
from ..scene.releases import ScheduledRelease, advance
from ..scene.setup import Setup
from .advance import start
from .grids import build_grid
from .planning import event_of
from .scene import Scene


def simulate(
    setup: Setup | Mapping[str, Any] | None,
    terrain: xr.Dataset | RasterModelGrid | Scene,
    max_duration: float | None = None,
) -> xr.Dataset:
    """Simulate an event from its release to rest and return its maps, without a change to the arguments.

    Parameters
    ----------
    setup : Setup, mapping or None
        Laws, material, numerics and inflow; None: those of the scene, or the defaults.
    terrain : xarray.Dataset, RasterModelGrid or Scene
        Variables over ``y`` and ``x``, or fields at nodes, by the names of the fields of `DebrisFlow`:
        ``topographic__elevation``, ``soil__depth``, ``debris_flow__release_depth`` [m] and others that it reads. A
        scene brings its releases with their times.
    max_duration : float, optional
        Longest time to simulate [s]; by default that of the scene, or 3600 s.

    Returns
    -------
    xarray.Dataset
        As `DebrisFlow.maps`; the attribute ``at_rest`` tells whether the whole flow had come to rest (1) or not (0).

    Raises
    ------
    InputError, ParameterError
        If terrain or setup are not usable.
    SimulationError
        If the state stopped being finite.

    Examples
    --------
    >>> import numpy as np
    >>> import xarray as xr
    >>> from landlab_debrisflow import simulate
    >>> x, y = np.arange(0.0, 300.0, 5.0), np.arange(0.0, 100.0, 5.0)
    >>> z = np.maximum(0.0, 75.0 - 0.5 * x) + 0.0 * y[:, None]
    >>> release = 1.0 * ((abs(x - 30.0) < 8.0) & (abs(y[:, None] - 48.0) < 8.0))
    >>> terrain = xr.Dataset(
    ...     {"topographic__elevation": (("y", "x"), z), "debris_flow__release_depth": (("y", "x"), release)},
    ...     {"y": y, "x": x},
    ... )
    >>> maps = simulate({"friction": "voellmy", "numerics": {"particle_count": 100}}, terrain)
    >>> maps.attrs["budget_released"], bool(terrain.debris_flow__release_depth.max() == 1.0)
    (225.0, True)
    """
    releases: Sequence[ScheduledRelease] = ()
    if isinstance(terrain, Scene):
        setup = terrain.setup if setup is None else setup
        max_duration = terrain.output_keys.max_duration if max_duration is None else max_duration
        grid, releases = terrain.grid(), terrain.releases
    elif isinstance(terrain, xr.Dataset):
        grid = build_grid(terrain)
    elif isinstance(terrain, RasterModelGrid):
        grid = copy_grid(terrain)
    else:
        raise InputError(f"simulate: terrain must be a Dataset, a RasterModelGrid or a Scene, got {terrain!r:.60}")
    max_duration = 3600.0 if max_duration is None else max_duration
    in_range("simulate: max_duration", max_duration, 0.0, unit="s", error=InputError)
    setup = setup if isinstance(setup, Setup) else Setup.from_mapping({} if setup is None else setup)
    if setup.numerics.automatic:
        setup = _planned(grid, setup, releases, max_duration)
    flow = start(grid, setup, releases)
    advance(flow, releases, max_duration)
    return flow.maps.assign_attrs(at_rest=int(flow.at_rest))


def _planned(grid: RasterModelGrid, setup: Setup, releases: Sequence[ScheduledRelease], max_duration: float) -> Setup:
    """Return a setup with numerics and column of a plan for the event on a grid, of which a copy is taken."""
    return make_plan(event_of(copy_grid(grid), setup, releases, max_duration), wishes_of(setup)).setup
