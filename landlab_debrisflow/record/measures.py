"""Measures of an event: run-out, areas, volumes, depths and speeds."""

from collections.abc import Callable
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from ..core.errors import InputError
from .attributes import variable_attributes

ELEVATION, RELEASE = "topographic__elevation", "debris_flow__release_depth"
DEPOSIT = "debris_flow__deposit_depth"


def measures(flow: Any, before: xr.Dataset | None = None, *, distance: Callable | None = None,
             inside: ArrayLike | None = None, front_fraction: float = 0.99, flow_threshold: float = 0.0,
             erosion_threshold: float = 0.01, deposit_threshold: float = 0.1) -> xr.Dataset:  # fmt: skip
    """Measure an event: run-out, travel angle, areas, volumes and peaks.

    Parameters
    ----------
    flow : DebrisFlow or xarray.Dataset
        The component, moving or at rest, or its `maps`.
    before : xarray.Dataset, optional
        The `maps` of the component before the event began, with elevation and release. Without these maps run-out from
        the release is not measured, unless `distance` is given.
    distance : callable, optional
        ``distance(x, y)``: distance of map positions from where run-out is counted [m], such as the way along a valley;
        by default in plan from the centre of the release, weighted with its thickness.
    inside : array_like of bool, shape (rows, columns) or (nodes,), optional
        Nodes to which areas, depths, peaks and the volumes of erosion and deposit are limited. Budget and run-out
        always belong to the whole event.
    front_fraction : float
        Fraction of the volume that lies behind the front [-], in (0, 1]; below 1 single particles far ahead do not
        count.
    flow_threshold, erosion_threshold, deposit_threshold : float
        Least depth that counts as inundated, eroded or deposit, >= 0; depths of 0 never count [m].

    Returns
    -------
    xarray.Dataset
        Scalars with their units and meaning as attributes; NaN where there is nothing to measure.

        elapsed_time : [s]
        budget_released, budget_inflow, ... : terms of `DebrisFlow.budget` [m3]
        inundated_area, eroded_area, deposit_area : map areas above the thresholds [m2]
        eroded_volume, deposit_volume : sums over the nodes, without threshold [m3]
        max_depth, max_speed, max_impact_pressure, max_run_up : peaks of the event [m, m s-1, Pa, m]
        max_eroded_depth, max_deposit_depth : [m]
        mean_deposit_depth, median_deposit_depth : over the area of the deposit [m]
        max_basal_peclet_number, median_basal_peclet_number : of the peaks over the eroded area [-]

        With `before` or `distance`, of the particles if the component has any, else of the deposit:

        run_out : distance of the front, behind which `front_fraction` of the volume lies [m]
        farthest_run_out, centre_run_out : distance of the farthest part, and mean by volume [m]

        With `before`:

        fall_height, travel_distance : H and L, from the crown, the highest node released, to the front, in plan [m]
        travel_angle : arctan(H/L), the Fahrböschung or angle of reach [deg]

    Raises
    ------
    InputError
        If a threshold or the fraction is out of bounds, if `inside` or `before` is of another grid, or if the Dataset
        does not hold maps of one moment.

    References
    ----------
    Heim (1932) and Corominas (1996) for the angle of reach.

    Examples
    --------
    >>> import numpy as np
    >>> import xarray as xr
    >>> axes = {"y": [0.0, 10.0], "x": [0.0, 10.0, 20.0]}
    >>> def maps(release, deposit):
    ...     names = "topographic__elevation", "debris_flow__release_depth", "debris_flow__deposit_depth"
    ...     depths = ([[10.0, 5.0, 0.0]] * 2, release, deposit)
    ...     return xr.Dataset({name: (("y", "x"), np.array(z)) for name, z in zip(names, depths)}, axes)
    >>> nothing, moved = np.zeros((2, 3)), [[0.0, 0.0, 0.5], [0.0, 0.0, 0.5]]
    >>> found = measures(maps(nothing, moved), maps([[0.5, 0.0, 0.0]] * 2, nothing))
    >>> float(found.deposit_volume), float(found.deposit_area)
    (100.0, 200.0)
    >>> round(float(found.travel_angle), 2)  # 10 m down in 20 m
    26.57
    """
    thresholds = flow_threshold, erosion_threshold, deposit_threshold
    _check(front_fraction, *thresholds)
    maps = flow if isinstance(flow, xr.Dataset) else getattr(flow, "maps", None)
    if not isinstance(maps, xr.Dataset):
        raise InputError(f"measures: needs a DebrisFlow or its maps, got {flow!r}; give flow or flow.maps")
    if not (before is None or isinstance(before, xr.Dataset)):
        raise InputError(f"measures: before must be flow.maps taken before the run, or None, got {before!r}")
    if DEPOSIT not in maps or set(maps[DEPOSIT].dims) != {"y", "x"}:
        raise InputError(
            f"measures: needs a DebrisFlow or its maps at one moment, got a Dataset over {dict(maps.sizes)}"
        )
    found = _moment_measures(maps) | _map_measures(_Region(maps, inside), *thresholds)
    if before is not None or distance is not None:
        found |= _travel_measures(_mass(flow, maps, before), before, distance, front_fraction)
    return xr.Dataset(
        {name: ((), value, variable_attributes(unit, words)) for name, (value, unit, words) in found.items()}
    )


def quantile(values: np.ndarray, weights: np.ndarray, fraction: float) -> float:
    """Return the value that a fraction of the weights does not exceed.

    Parameters
    ----------
    values, weights : ndarray, shape (n,)
        Values, in any unit, and their weights, >= 0.
    fraction : float
        [-].

    Returns
    -------
    float
        One of the values.

    Examples
    --------
    >>> quantile(np.array([3.0, 1.0, 2.0]), np.array([1.0, 1.0, 98.0]), 0.5)
    2.0
    """
    order = np.argsort(values)
    sums = np.cumsum(weights[order])
    return float(values[order][min(np.searchsorted(sums, fraction * sums[-1]), values.size - 1)])


def _check(front_fraction, *thresholds):
    if not 0.0 < front_fraction <= 1.0:
        raise InputError(f"measures: front_fraction must lie in (0, 1], got {front_fraction!r}")
    if not all(0.0 <= threshold < np.inf for threshold in thresholds):
        raise InputError(f"measures: thresholds must be finite depths >= 0 [m], got {thresholds!r}")


def _cell(maps) -> float:
    """Return the map area of a node [m2]."""
    return float(maps.x[1] - maps.x[0]) * float(maps.y[1] - maps.y[0])


class _Region:
    """Values of maps at the nodes to be measured; missing values count as 0.

    `maps` is a Dataset over ``y`` and ``x``; `inside`, bool, one value per node, tells which are measured; None: all.
    """

    def __init__(self, maps, inside):
        self._maps, self._shape = maps, (maps.sizes["y"], maps.sizes["x"])
        self._inside = np.ones(self._shape, bool) if inside is None else np.asarray(inside, bool)
        if self._inside.size != self._shape[0] * self._shape[1]:
            raise InputError(
                f"measures: inside must have one value for each of the {self._shape[0]} x {self._shape[1]} nodes, "
                f"got shape {self._inside.shape}"
            )
        self._inside = self._inside.reshape(self._shape)
        self.cell = _cell(maps)

    def at(self, name):
        """Return an output, by its name without prefix, at the nodes inside, (n,), in its unit; 0 where missing."""
        field = f"debris_flow__{name}"
        return np.nan_to_num(self._maps[field].values[self._inside]) if field in self._maps else np.zeros(0)


def _moment_measures(maps):
    """Return elapsed time [s] and terms of the budget [m3] in maps, as (value, unit, meaning) by name."""
    found = {}
    if "elapsed_time" in maps.attrs:
        found["elapsed_time"] = float(maps.attrs["elapsed_time"]), "s", "elapsed time"
    for name, value in maps.attrs.items():
        if name.startswith("budget_") and not name.endswith("_units"):
            found[name] = float(value), "m3", f"volume {name.removeprefix('budget_')}, whole grid"
    return found


def _map_measures(region, flow_threshold, erosion_threshold, deposit_threshold):
    """Return areas [m2], volumes [m3], depths [m] and peaks as (value, unit, meaning) by name.

    `region` is a `_Region`; the thresholds are depths [m] from which on flow, erosion and deposit count.
    """
    depth, eroded, deposit = (region.at(name) for name in ("max_depth", "eroded_depth", "deposit_depth"))
    eroding, thick = _at_least(eroded, erosion_threshold), deposit[_at_least(deposit, deposit_threshold)]
    peclet = region.at("max_basal_peclet_number")
    peclet = peclet[eroding] if peclet.size else peclet
    inundated = _at_least(depth, flow_threshold).sum()
    return {
        "inundated_area": (inundated * region.cell, "m2", "map area the flow came over"),
        "eroded_area": (eroding.sum() * region.cell, "m2", "map area of erosion"),
        "deposit_area": (thick.size * region.cell, "m2", "map area of the deposit"),
        "eroded_volume": (eroded.sum() * region.cell, "m3", "volume eroded, without the release"),
        "deposit_volume": (deposit.sum() * region.cell, "m3", "volume of the deposit"),
        "max_depth": (_reduce(np.max, depth), "m", "largest depth of moving mass"),
        "max_speed": (_reduce(np.max, region.at("max_speed")), "m s-1", "largest speed"),
        "max_impact_pressure": (
            _reduce(np.max, region.at("max_impact_pressure")), "Pa", "largest density times speed squared",
        ),
        "max_run_up": (_reduce(np.max, region.at("max_run_up")), "m", "largest height above the lowest bed come over"),
        "max_eroded_depth": (_reduce(np.max, eroded), "m", "deepest erosion"),
        "max_deposit_depth": (_reduce(np.max, deposit), "m", "largest depth of the deposit"),
        "mean_deposit_depth": (_reduce(np.mean, thick), "m", "mean depth over the area of the deposit"),
        "median_deposit_depth": (_reduce(np.median, thick), "m", "median depth over the area of the deposit"),
        "max_basal_peclet_number": (_reduce(np.max, peclet), "-", "largest basal Péclet number where eroded"),
        "median_basal_peclet_number": (
            _reduce(np.median, peclet), "-", "median of the largest basal Péclet numbers where eroded",
        ),
    }  # fmt: skip


def _reduce(reduction, values):
    """Return a reduction of values, in their unit; NaN for an empty array."""
    return reduction(values) if values.size else np.nan


def _at_least(depth, threshold):
    return (depth >= threshold) & (depth > 0.0)


def _mass(flow, maps, before):
    """Return x, y, bed elevation [m] and volume [m3] of the mass: particles, or nodes of the deposit.

    `flow` is a component or maps; `maps` and `before` are Datasets over ``y`` and ``x``, `before` may be None.
    """
    if flow is not maps and (p := flow.particles).sizes["particle"]:
        return p.x.values, p.y.values, p.z.values, p.volume.values
    deposit = np.nan_to_num(maps[DEPOSIT].values)
    y, x = np.meshgrid(maps.y.values, maps.x.values, indexing="ij")
    covered = deposit > 0.0
    ground = maps if before is None else before
    if ground.sizes != maps.sizes and (ground.sizes["y"], ground.sizes["x"]) != deposit.shape:
        raise InputError(f"measures: before has {dict(ground.sizes)} nodes, the maps have {dict(maps.sizes)}")
    return x[covered], y[covered], ground[ELEVATION].values[covered], deposit[covered] * _cell(maps)


def _travel_measures(mass, before, distance, front_fraction):
    """Return run-out [m] and, with the ground before, travel angle [deg], as (value, unit, meaning) by name.

    `mass` is x, y, z [m] and volume [m3], each (n,); `before` are maps before the event, or None; `distance` is a
    function of x, y that returns the distance along the path [m], or None; `front_fraction` is the part of the volume
    behind the front [-].
    """
    x, y, z, volume = mass
    released = None if before is None else np.nan_to_num(before[RELEASE].values)
    if released is not None and not released.any():
        released = None
    if distance is None and released is not None:
        node_y, node_x = np.meshgrid(before.y.values, before.x.values, indexing="ij")
        centre = [np.average(axis, weights=released) for axis in (node_x, node_y)]
        far = np.hypot(x - centre[0], y - centre[1])
    else:
        far = np.full(x.size, np.nan) if distance is None else np.asarray(distance(x, y), float)
    known = x.size > 0 and not np.isnan(far).any()
    front = quantile(far, volume, front_fraction) if known else np.nan
    found = {
        "run_out": (front, "m", f"distance of the front, behind which {front_fraction:.4g} of the volume lies"),
        "farthest_run_out": (far.max() if known else np.nan, "m", "distance of the farthest part"),
        "centre_run_out": (np.average(far, weights=volume) if known else np.nan, "m", "mean distance by volume"),
    }
    if before is None:
        return found
    fall = along = np.nan
    if known and released is not None:
        elevation = before[ELEVATION].values
        row, column = np.unravel_index(np.argmax(np.where(released > 0.0, elevation, -np.inf)), elevation.shape)
        at = np.argmin(abs(far - front))
        fall = elevation[row, column] - z[at]
        along = np.hypot(before.x.values[column] - x[at], before.y.values[row] - y[at])
    return found | {
        "fall_height": (fall, "m", "H, from the crown of the release down to the front"),
        "travel_distance": (along, "m", "L, from the crown of the release to the front, in plan"),
        "travel_angle": (np.degrees(np.arctan2(fall, along)), "deg", "angle of the line from the crown to the front"),
    }
