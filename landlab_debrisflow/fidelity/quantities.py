"""Quantities of a run: the numbers whose errors are stated, and their change while a flow creeps to rest."""

from typing import Any

import numpy as np

from ..model.schedule import EVERY_STEP
from ..record.measures import quantile

DEPTH = 0.1
"""Peak depth from which on a node belongs to the affected area [m]."""

UNITS = {
    "run_out": "m", "run_out_95": "m", "centre": "m", "area": "m2", "deposit": "m", "speed": "m s-1",
    "speed_90": "m s-1", "max_speed": "m s-1", "depth": "m", "mean_depth": "m", "pressure": "-", "eroded": "m3",
    "duration": "s",
}  # fmt: skip
"""Quantities of a run and their units."""

CREEP_LEVELS = (1e-2, 1e-3)
"""Kinetic energy over its peak, below which a flow is said to creep [-]."""


def origin_of(grid: Any, setup: Any) -> tuple[float, float]:
    """Return the centre of release or inflow, from where run-out is counted [m].

    Parameters
    ----------
    grid : RasterModelGrid
        Before the first call.
    setup : Setup
        Setup of the flow.

    Returns
    -------
    tuple of float
        x and y on the map: the centre by volume of the release and, without one, of the lines of inflow.
    """
    centres, volumes = [], []
    if "debris_flow__release_depth" in grid.at_node:
        depth = np.maximum(0.0, grid.at_node["debris_flow__release_depth"])
        if depth.any():
            centres.append([np.average(axis, weights=depth) for axis in (grid.x_of_node, grid.y_of_node)])
            volumes.append(depth.sum() * grid.dx * grid.dy)
    if not centres:
        for line in setup.inflow or ():
            centres.append(0.5 * (np.array(line.line_start) + np.array(line.line_end)))
            volumes.append(line.volume)
    if not centres:
        return float("nan"), float("nan")
    x, y = np.average(centres, axis=0, weights=volumes)
    return float(x), float(y)


def quantities(flow: Any, origin: tuple[float, float]) -> dict[str, float]:
    """Measure run-out, area, peaks, erosion and deposit over the whole event.

    Parameters
    ----------
    flow : DebrisFlow
        Moving or at rest, settled or not.
    origin : tuple of float
        From where run-out is counted: x and y on the map [m], as `origin_of` returns them.

    Returns
    -------
    dict of str to float
        In the units of `UNITS`; NaN where there is nothing to measure.

        run_out, run_out_95, centre : plan distance behind which 99 and 95 % of the volume lie, and mean by volume
        area : map area with a peak depth > 0.1 m
        deposit : mean depth of the deposit, weighted by volume: sum d^2 / sum d
        speed, speed_90, max_speed : 99 and 90 % quantiles, and largest, of the peak speeds of the nodes of the affected
        area depth, mean_depth : 99 % quantile and mean of the peak depths there
        pressure : 99 % quantile of the peak basal pressure ratios there
        eroded : volume eroded
        duration : elapsed time
    """
    maps = flow.maps
    cell = float(maps.x[1] - maps.x[0]) * float(maps.y[1] - maps.y[0])

    def at_nodes(name):
        return np.nan_to_num(maps[f"debris_flow__{name}"].values)

    peak_depth, lies = at_nodes("max_depth"), at_nodes("deposit_depth") + at_nodes("depth")
    reached = peak_depth > DEPTH
    speeds, depths, ratios = at_nodes("max_speed")[reached], peak_depth[reached], np.zeros(0)
    if "debris_flow__max_basal_pressure_ratio" in maps:
        ratios = at_nodes("max_basal_pressure_ratio")[reached]
    distance, volume = _mass(flow, lies, cell, origin)
    return {
        "run_out": quantile(distance, volume, 0.99) if volume.size else np.nan,
        "run_out_95": quantile(distance, volume, 0.95) if volume.size else np.nan,
        "centre": float(np.average(distance, weights=volume)) if volume.size else np.nan,
        "area": float(reached.sum() * cell),
        "deposit": float((lies**2).sum() / lies.sum()) if lies.any() else np.nan,
        "speed": _quantile(speeds, 0.99),
        "speed_90": _quantile(speeds, 0.9),
        "max_speed": _quantile(speeds, 1.0),
        "depth": _quantile(depths, 0.99),
        "mean_depth": float(depths.mean()) if depths.size else np.nan,
        "pressure": _quantile(ratios, 0.99),
        "eroded": float(flow.budget["eroded"]),
        "duration": float(flow.elapsed_time),
    }


class Decay:
    """Observer: measures a flow when its kinetic energy falls below parts of its peak, before it creeps to rest.

    Parameters
    ----------
    levels : tuple of float
        Kinetic energy over its peak [-].

    Attributes
    ----------
    origin : tuple of float
        As in `quantities`, taken when the component is built [m].
    found : dict of float to dict
        `quantities` by level, at the last time that the energy fell below it.
    """

    HYSTERESIS = 3.0
    """A level is measured anew once the energy was above this times the level: noise at a level is no new decay."""

    def __init__(self, levels: tuple[float, ...] = CREEP_LEVELS):
        self.interval, self.origin = float("inf"), (float("nan"), float("nan"))
        self.found: dict[float, dict[str, float]] = {}
        self._peak, self._below = 0.0, dict.fromkeys(levels, True)
        self._due: list[float] = []

    def prepare(self, grid: Any, setup: Any) -> None:
        """Take the origin of run-out [m] from a component that is being built.

        Parameters
        ----------
        grid : RasterModelGrid
        setup : Setup
        """
        self.origin = origin_of(grid, setup)

    def follow(self, particles: Any, began: float, time: float) -> None:
        """Compare the kinetic energy after a step from `began` to `time` [s] with its peak.

        Parameters
        ----------
        particles : object
            Those of the flow.
        began, time : float
            Ends of the step [s].
        """
        energy = float(np.einsum("n,kn,kn->", particles.volume, particles.velocity, particles.velocity))
        self._peak = max(self._peak, energy)
        for level, below in self._below.items():
            if below and energy > min(self.HYSTERESIS * level, 1.0) * self._peak > 0.0:
                self._below[level] = False
            elif not below and energy < level * self._peak:
                self._below[level] = True
                self._due.append(level)
        self.interval = EVERY_STEP if self._due else float("inf")

    def observe(self, flow: Any) -> None:
        """Measure the flow at the levels that it has just fallen below.

        Parameters
        ----------
        flow : DebrisFlow
            The component after a step.
        """
        if self._due:
            self.found |= dict.fromkeys(self._due, quantities(flow, self.origin))
        self._due, self.interval = [], float("inf")


def _mass(flow, lies, cell, origin):
    """Return plan distance from the origin [m] and volume [m3] of the mass, (n,): particles, or nodes if settled.

    `lies` is the depth at nodes [m], (rows, columns), `cell` their map area [m2].
    """
    p = flow.particles
    if p.sizes["particle"]:
        x, y, volume = p.x.values, p.y.values, p.volume.values
    else:
        covered = lies.ravel() > 0.0
        grid = flow.grid
        x, y, volume = grid.x_of_node[covered], grid.y_of_node[covered], lies.ravel()[covered] * cell
    return np.hypot(x - origin[0], y - origin[1]), volume


def _quantile(values, fraction):
    return float(np.quantile(values, fraction)) if values.size else np.nan
