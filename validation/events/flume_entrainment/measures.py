"""Measures of the flume with an erodible bed: speeds, momenta and scour of wet and dry beds beside the control."""

import numpy as np
import xarray as xr

from ..event import Measure, Target
from ..flume.measures import half_peak, pressure_ratio
from .setup import KINDS

REACH = 34.0
"""Distance between the stations at 32 and 66 m, over which the speed of the front is taken [m]."""

FOOT = 0.01
"""Thickness with which the foot of a front arrives [m]."""

LEAST_SCOUR = 0.01
"""Eroded depth from which a scour rate is read, normal to the bed [m]."""

SCOURING = (0.1, 0.9)
"""Fractions of the eroded depth between which the rate is taken [-]."""

MEASURED_RATE = (0.05, 0.1)
"""Scour rate of wetter beds, Reid et al. (2011) [m/s]."""

THRESHOLD = (0.22, 0.23)
"""Water content between which beds begin to feed the flow: Reid et al. (2011), and Iverson et al. (2010) [-]."""

MEASURES = {
    "wet speed": Measure("speed, wet over control", "{:.3f}"),
    "dry speed": Measure("speed, dry over control", "{:.3f}"),
    "wet foot": Measure("speed of the first cm, wet over control", "{:.3f}"),
    "dry foot": Measure("speed of the first cm, dry over control", "{:.3f}"),
    "shape speed": Measure("speed, rigid bed of this shape over control", "{:.3f}"),
    "wet momentum": Measure("momentum, wet over control"),
    "dry momentum": Measure("momentum, dry over control"),
    "scour ratio": Measure("scour, dry over wet", "{:.0%}"),
    "scour rate": Measure("scour rate, wet [cm/s]", "{:.1f}"),
    "wet scour": Measure("scour, wet [m³]"),
    "wet pressure": Measure("p over weight at 32 m, wet"),
    "control speed": Measure("speed, control [m/s]", "{:.1f}"),
    "threshold": Measure("water content at the switch", "{:.3f}"),
    "dry scour": Measure("scour, dry [m³]", tabulated=False),
    "control pressure": Measure("p over weight at 32 m, control", tabulated=False),
    "outflow": Measure("off the map [m³]", tabulated=False),
}

TARGETS = (
    Target("wet speed", "a wet bed makes the front faster between 32 and 66 m: more than 1.01 times the control",
           low=1.01),
    Target("wet momentum", "and its momentum grow: more than 1.01 times", low=1.01),
    Target("dry speed", "a dry bed slows the front: less than 1 times the control", high=1.0),
    Target("scour ratio", "the dry bed loses at most 20 % of what the wet one loses", high=0.2),
    Target("scour rate", "the wet bed is scoured at 5 to 10 cm/s", low=100.0 * MEASURED_RATE[0],
           high=100.0 * MEASURED_RATE[1]),
)  # fmt: skip


def score(result: xr.Dataset) -> dict[str, float]:
    """Return the measures of the three beds, and the water content at the switch if it was run."""
    control, wet, dry, rigid = (result.sel(run=name) for name in KINDS)
    speeds = [front_speed(result.time.values, each.thickness) for each in (control, wet, dry, rigid)]
    feet = [front_speed(result.time.values, each.thickness, FOOT) for each in (control, wet, dry)]
    momenta = [float(each.momentum.max()) for each in (control, wet, dry)]
    scours = [float(each.eroded_volume[-1]) for each in (control, wet, dry)]
    pressures = [
        pressure_ratio(each.thickness.sel(station="32 m").values, each.pressure.sel(station="32 m").values,
                       result.time.values)
        for each in (control, wet)
    ]  # fmt: skip
    return {
        "control speed": speeds[0], "wet speed": speeds[1] / speeds[0], "dry speed": speeds[2] / speeds[0],
        "shape speed": speeds[3] / speeds[0],
        "wet foot": feet[1] / feet[0], "dry foot": feet[2] / feet[0],
        "wet momentum": momenta[1] / momenta[0], "dry momentum": momenta[2] / momenta[0],
        "wet scour": scours[1], "dry scour": scours[2], "scour ratio": scours[2] / scours[1],
        "scour rate": 100.0 * float(np.median(scour_rates(result.time.values, wet.eroded.values))),
        "control pressure": pressures[0], "wet pressure": pressures[1],
        "threshold": switch(result) if "water_content" in result.coords else np.nan,
        "outflow": float(result.outflow.max()),
    }  # fmt: skip


def front_speed(time: np.ndarray, thickness: xr.DataArray, foot: float | None = None) -> float:
    """Return the speed of the front between 32 and 66 m, from its arrival at both [m/s].

    It arrives with half of its peak, or with the thickness `foot` [m]; NaN if it comes to 66 m before 32 m, because a
    plug that follows has the peak.
    """
    arrivals = []
    for station in ("32 m", "66 m"):
        series = thickness.sel(station=station).values
        arrivals.append(half_peak(time, series if foot is None else np.minimum(series, 2.0 * foot)))
    taken = arrivals[1] - arrivals[0]
    return REACH / taken if taken > 0.0 else float("nan")


def scour_rates(time: np.ndarray, eroded: np.ndarray) -> np.ndarray:
    """Return the rate at which each place is scoured, between a tenth and nine tenths of its depth [m/s].

    Parameters
    ----------
    time : ndarray, shape (times,)
        [s]
    eroded : ndarray, shape (times, places)
        Eroded depth, normal to the bed [m].

    Returns
    -------
    ndarray, shape (places with at least `LEAST_SCOUR`,)
        NaN alone where nothing was scoured.

    Examples
    --------
    >>> scour_rates(np.array([0.0, 1.0, 3.0, 4.0]), np.array([[0.0], [0.0], [0.1], [0.1]])).round(6)
    array([0.05])
    """
    rates = []
    for depth in eroded.T[eroded[-1] >= LEAST_SCOUR]:
        first, last = (float(np.interp(fraction * depth[-1], depth, time)) for fraction in SCOURING)
        rates.append((SCOURING[1] - SCOURING[0]) * depth[-1] / max(last - first, 1e-9))
    return np.array(rates or [np.nan])


def switch(result: xr.Dataset) -> float:
    """Return the water content at which the scour is half of that of the wettest bed, linear between two [-]."""
    contents, scour = result.water_content.values, result.scour_by_content.values
    if scour[-1] <= 0.0 or scour[0] >= 0.5 * scour[-1]:
        return float("nan")
    return float(np.interp(0.5 * scour[-1], np.maximum.accumulate(scour), contents))


def references(result: xr.Dataset) -> dict[str, dict[str, float]]:
    """Return what was measured: only ranges and signs were published."""
    return {
        "measured, low end": {"scour rate": 100.0 * MEASURED_RATE[0], "threshold": THRESHOLD[0]},
        "measured, high end": {"scour rate": 100.0 * MEASURED_RATE[1], "threshold": THRESHOLD[1]},
    }
