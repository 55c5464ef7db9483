"""Measures of the flume: arrival, peaks, share of times within the measured band, toe and deposits."""

import numpy as np
import xarray as xr

from landlab_debrisflow.calibration.agreement import csi

from ..event import Measure, Target
from .measured import LAST_TIME, SERIES
from .setup import GRAVITY, SLOPE

FILM = 0.01
"""Deposit that counts [m]: the certainty of the digitised thickness."""

COMPARED_FROM = 82.5
"""Distance from which deposits are compared: the walls end there, and all four were mapped [m]."""

BODY = 0.03
"""Thickness above which the ratio of pressure to weight is read [m]: it is known to 0.01 m."""

DENSITY = 2090.0
"""Of the flow in that ratio, George & Iverson (2014) [kg m-3]."""

D_CLAW_PEAK = 0.353
"""Peak thickness at 2 m that D-Claw computes with the values of George & Iverson (2014) [m]."""

WORDS = {"thickness": "h", "pressure": "p"}


def score(result: xr.Dataset) -> dict[str, float]:
    """Return the measures of the first run, which is that of the set, and the effect of the start ratio on it."""
    first = result.isel(run=0)
    found = of_series(first, result) | of_deposit(first.deposit.values > FILM, result)
    found |= {name: float(first[name]) for name in ("largest_thickness", "outflow", "duration")}
    found["largest deposit"] = float(first.deposit.max())
    found["peak h 2 m over D-Claw"] = found["peak h 2 m"] / D_CLAW_PEAK
    starts = [str(name) for name in result.run.values if str(name).startswith("start ratio")]
    shifts = []
    for station in SERIES["pressure"]:
        arrivals = [half_peak(result.time.values, result.thickness.sel(run=name, station=station).values)
                    for name in starts]  # fmt: skip
        shift = arrivals[0] - found[f"arrival h {station}"] if arrivals else np.nan
        found[f"start ratio h {station}"] = shift
        shifts.append(abs(shift))
    return found | {"start ratio": float(np.max(shifts))}


def of_series(run: xr.Dataset, result: xr.Dataset) -> dict[str, float]:
    """Compare series of ``thickness`` and ``pressure`` over ``station`` and ``time`` with the measured ones.

    Returns
    -------
    dict
        For each series: half-peak arrival [s] and its error, peak [m, Pa] and its relative error, time of the peak [s],
        root mean square over the measured peak, share of times within one standard deviation of the mean; pore
        pressure over weight.
    """
    found, time = {}, result.time.values
    for name, stations in SERIES.items():
        for station in stations:
            label, series = f"{WORDS[name]} {station}", run[name].sel(station=station).values
            mean, lower, upper = result[f"measured_{name}"].sel(station=station).values
            known = np.isfinite(mean)
            arrival, peak = half_peak(time[known], mean[known]), mean[known].max()
            counted = known & (time >= arrival)
            inside = (lower <= series) & (series <= upper)
            found |= {
                f"arrival {label}": half_peak(time, series),
                f"arrival error {label}": half_peak(time, series) - arrival,
                f"peak {label}": series.max(),
                f"peak error {label}": series.max() / peak - 1.0,
                f"time of peak {label}": time[series.argmax()],
                f"rms {label}": np.sqrt(np.mean((series - mean)[known] ** 2)) / peak,
                f"within {label}": np.mean(inside[counted]),
            }
    for station in SERIES["pressure"]:
        pair = [run[name].sel(station=station).values for name in ("thickness", "pressure")]
        found[f"pressure ratio p {station}"] = pressure_ratio(*pair, time)
    return {key: float(value) for key, value in found.items()}


def half_peak(time: np.ndarray, series: np.ndarray) -> float:
    """Return the first time at which a series is at half its peak [s], linear between two values; NaN if it is 0.

    Examples
    --------
    >>> half_peak(np.array([0.0, 1.0, 2.0, 3.0]), np.array([0.0, 0.0, 2.0, 1.0]))
    1.5
    """
    half = 0.5 * series.max()
    if half <= 0.0:
        return float("nan")
    reached = int(np.argmax(series >= half))
    pair = slice(max(0, reached - 1), reached + 1)
    return float(np.interp(half, series[pair], time[pair]))


def pressure_ratio(thickness: np.ndarray, pressure: np.ndarray, time: np.ndarray) -> float:
    """Return pore pressure over the weight of the flow [-], mean of the times with more than `BODY`, or NaN."""
    body = np.isfinite(pressure) & (thickness > BODY) & (time <= LAST_TIME)
    if not body.any():
        return float("nan")
    return float(np.mean(pressure[body] / (DENSITY * GRAVITY * np.cos(SLOPE) * thickness[body])))


def of_deposit(deposit: np.ndarray, result: xr.Dataset, leave_out: int | None = None) -> dict[str, float]:
    """Compare a deposit, yes or no over ``y`` and ``s``, with those that were mapped; `leave_out` is the index of one.

    Returns
    -------
    dict
        Toe [m], and mean intersection over union with the mapped deposits beyond the walls.
    """
    s, pad = result.s.values, result.s.values > COMPARED_FROM
    mapped = [each for index, each in enumerate(result.mapped_deposit.values == 1) if index != leave_out]
    columns = s[deposit.any(axis=0)]
    overlaps = [csi(deposit[:, pad], each[:, pad]) for each in mapped]
    return {"toe": float(columns.max()) if columns.size else np.nan, "overlap": float(np.mean(overlaps))}


def references(result: xr.Dataset) -> dict[str, dict[str, float]]:
    """Return the measures of a series of zeros, of the edges of the band, and of each mapped deposit."""
    zeros = of_series(xr.zeros_like(result.isel(run=0)), result)
    found = {"series of zeros": {key: value for key, value in zeros.items() if key.startswith("within")}}
    for bound, words in (("lower", "measured, mean − 1 sd"), ("upper", "measured, mean + 1 sd")):
        edge = xr.Dataset({name: result[f"measured_{name}"].sel(bound=bound).fillna(0.0) for name in SERIES})
        found[words] = {key: value for key, value in of_series(edge, result).items() if not key.startswith("within")}
    for index, date in enumerate(result.experiment.values):
        deposit = result.mapped_deposit.values[index] == 1
        found[f"deposit of {date} beside the other three"] = of_deposit(deposit, result, index)
    return found


def _of_series(key: str, words: str, form: str, series: dict[str, tuple[str, ...]], tabulated: bool = True):
    """Return measures by name, one for each series, whose symbol and station fill the words."""
    return {f"{key} {WORDS[name]} {station}": Measure(words.format(f"{WORDS[name]} {station}"), form, tabulated)
            for name, stations in series.items() for station in stations}  # fmt: skip


PASSING = dict.fromkeys(SERIES, ("32 m", "66 m"))
THICKNESS = {"thickness": PASSING["thickness"]}
TABULATED = (
    _of_series("arrival error", "Δt {} [s]", "{:+.2f}", THICKNESS)
    | _of_series("peak error", "Δ{}", "{:+.0%}", PASSING)
    | {
        "peak h 2 m": Measure("h 2 m [m]", "{:.3f}"),
        "largest_thickness": Measure("largest h [m]"),
        "start ratio": Measure("start ratio [s]"),
        "toe": Measure("toe [m]", "{:.1f}"),
        "overlap": Measure("IoU"),
    }
    | _of_series("within", "in band {}", "{:.0%}", PASSING)
)
RECORDED = (
    _of_series("arrival", "arrival {} [s]", "{:.2f}", SERIES, tabulated=False)
    | _of_series("arrival error", "Δt {} [s]", "{:+.2f}", SERIES, tabulated=False)
    | _of_series("peak", "peak {} [m, Pa]", "{:.4g}", SERIES, tabulated=False)
    | _of_series("peak error", "Δ{}", "{:+.0%}", SERIES, tabulated=False)
    | _of_series("time of peak", "time of peak {} [s]", "{:.2f}", SERIES, tabulated=False)
    | _of_series("rms", "rms {} / measured peak", "{:.2f}", SERIES, tabulated=False)
    | _of_series("within", "in band {}", "{:.0%}", SERIES, tabulated=False)
    | _of_series("start ratio", "start ratio {} [s]", "{:+.2f}", THICKNESS, tabulated=False)
    | _of_series("pressure ratio", "p / weight {}", "{:.2f}", {"pressure": PASSING["pressure"]}, tabulated=False)
    | {
        "peak h 2 m over D-Claw": Measure("h 2 m / D-Claw", tabulated=False),
        "largest deposit": Measure("largest deposit [m]", tabulated=False),
        "outflow": Measure("left the map [m³]", tabulated=False),
        "duration": Measure("at rest after [s]", "{:.1f}", tabulated=False),
    }
)
MEASURES = TABULATED | RECORDED | TABULATED
"""Thickness h, and total pore pressure p at the base: Δt, half-peak arrival less the measured one; Δh, Δp, peak over
the measured one, less 1; h 2 m, peak there; largest h between 8 and 77 m; start ratio, the larger shift of the arrivals
at 32 and 66 m by a start ratio of 0.9; IoU of the deposit with four mapped ones, their mean; in band, share of times
within one standard deviation of the mean."""

TARGETS = (
    Target("arrival error h 32 m", "arrival at 32 m within 0.6 s", -0.6, 0.6),
    Target("arrival error h 66 m", "arrival at 66 m within 0.6 s", -0.6, 0.6),
    Target("toe", "toe at 105 to 115 m, measured 108 to 111 m", 105.0, 115.0),
    Target("largest_thickness", "nothing thicker than 0.4 m between 8 and 77 m", high=0.4),
    Target("start ratio", "a start ratio of 0.9 moves the arrivals by less than 0.8 s", high=0.8),
    Target("peak error h 32 m", "peak thickness at 32 m within 30 %", -0.3, 0.3),
    Target("peak error h 66 m", "peak thickness at 66 m within 40 %", -0.4, 0.4),
    Target("peak error p 32 m", "peak pressure at 32 m within 35 %", -0.35, 0.35),
    Target("peak error p 66 m", "peak pressure at 66 m within 55 %", -0.55, 0.55),
    Target("peak h 2 m over D-Claw", "peak thickness at 2 m within 10 % of D-Claw's 0.353 m", 0.9, 1.1),
)
