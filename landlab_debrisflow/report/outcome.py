"""Numbers of an event for its report: how far, how deep, how fast, how large an area."""

import dataclasses
import json
import math
from collections.abc import Callable

import numpy as np
import xarray as xr

from ..record.measures import RELEASE, measures
from ..run.results import before_in

AFFECTED = 0.1
"""Peak depth from which on a node counts as affected [m]."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class Outcome:
    """Numbers of an event; NaN where there is nothing to measure.

    Attributes
    ----------
    max_depth, max_speed : float
        Peaks over the map [m, m s-1].
    affected_area : float
        Map area with a peak depth of `AFFECTED` or more [m2].
    max_eroded_depth, max_deposit_depth : float
        [m].
    run_out : float
        Distance in plan from the centre of release or inflow, behind which 99 % of the volume lies [m].
    fall_height, travel_angle : float
        From the crown of the release down to there [m, deg]; NaN without a release.
    """

    max_depth: float
    max_speed: float
    affected_area: float
    max_eroded_depth: float
    max_deposit_depth: float
    run_out: float
    fall_height: float
    travel_angle: float


def outcome_of(maps: xr.Dataset) -> Outcome:
    """Return the numbers of an event.

    Parameters
    ----------
    maps : xarray.Dataset
        As `Results.maps` returns them, of a run that came to its end.

    Returns
    -------
    Outcome
    """
    before = before_in(maps)
    lies = maps.debris_flow__deposit_depth.fillna(0.0) + maps.debris_flow__depth.fillna(0.0)
    whole = maps.assign(debris_flow__deposit_depth=lies)  # moving mass has come as far
    released = before is not None and bool((before[RELEASE] > 0.0).any())
    distance = None if released else _distance_from_inflow(maps)
    found = measures(whole, before, distance=distance, flow_threshold=AFFECTED)
    deposit = float(maps.debris_flow__deposit_depth.max())

    def number(name: str) -> float:
        return float(found[name]) if name in found else math.nan

    return Outcome(
        max_depth=number("max_depth"), max_speed=number("max_speed"), affected_area=number("inundated_area"),
        max_eroded_depth=number("max_eroded_depth"), max_deposit_depth=deposit, run_out=number("run_out"),
        fall_height=number("fall_height"), travel_angle=number("travel_angle"),
    )  # fmt: skip


def _distance_from_inflow(maps: xr.Dataset) -> Callable | None:
    """Return the function of the plan distance [m] from the middle of the inflow; None without inflow."""
    try:
        lines = json.loads(maps.attrs["setup"])["inflow"]
        ends = [line[end] for line in lines for end in ("line_start", "line_end")]
    except (KeyError, ValueError, TypeError):
        return None
    if not ends:
        return None
    x0, y0 = np.mean(ends, axis=0)
    return lambda x, y: np.hypot(x - x0, y - y0)
