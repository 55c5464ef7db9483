"""Calibration to data made by the model itself: how often intervals hold the truth.

python -m benchmarks.calibration coverage --cases N    100 cases take 15 minutes on one processor

Each case draws a truth from the prior, runs it, adds the stated Gaussian noise to what is observed of it, and is
calibrated. Written to benchmarks/results/calibration_coverage.json.
"""

import argparse

import numpy as np
import xarray as xr

from landlab_debrisflow.calibration import ArrivalTime, AtPoint, ElevationChange, Measure, calibrate
from landlab_debrisflow.calibration.event import Event, EventRuns, Prior
from landlab_debrisflow.calibration.observed_maps import change_of

from . import result_files

HEAD = [[400020, 5200140], [400045, 5200140], [400045, 5200165], [400020, 5200165]]
SCENE = {
    "terrain": {"example": "gully"}, "release": {"polygons": HEAD, "depth": 1.5},
    "friction": {"law": "voellmy", "basal_friction_angle": 28.0}, "numerics": {"particle_count": 40},
    "output": {"max_duration": 4.0},
}  # fmt: skip
VARY = {
    "friction.basal_friction_angle": {"truncated_normal": {"mean": 28.0, "sd": 2.0, "low": 20.0, "high": 36.0}},
    "release.volume": {"lognormal": {"median": 700.0, "sigma": 0.3}},
    "material.initial_pressure_ratio": {"uniform": {"low": 0.4, "high": 0.8}},
}
POINT = 400060.0, 5200160.0
"""Place of a gauge, which the front of nearly all members passes [m]."""
CHANGE_SD = 0.4
"""Noise of the observed change of elevation [m]."""
MEMBERS, GENERATIONS = 40, 4
PART = 0.9
"""Part of the posterior that an interval holds."""


def observed(value: dict[str, float], change: xr.DataArray) -> list:
    """Return observations with their stated errors."""
    return [
        Measure("run_out", value["run_out"], 0.7), Measure("max_speed", value["max_speed"], 0.4),
        AtPoint("max_depth", *POINT, value["max_depth"], 0.15),
        ArrivalTime(*POINT, value["arrival_time"], 0.05), ElevationChange(change, CHANGE_SD),
    ]  # fmt: skip


def simulated(observations: list, misfits: np.ndarray) -> dict[str, float]:
    """Return the simulated values of observations of one number, by name."""
    names = "run_out", "max_speed", "max_depth", "arrival_time"
    return {name: one.value + misfits[k] for k, (name, one) in enumerate(zip(names, observations, strict=False))}


def coverage(cases: int) -> None:
    """Calibrate cases of known parameters, and write how many intervals hold them."""
    lattice_of = EventRuns(Event(SCENE, [Measure("run_out", 0.0, 1.0)]), VARY, ("max_depth",), 0, 8, "")
    place = lattice_of.place
    nothing = xr.DataArray(np.zeros(place.lattice.shape), {"y": place.lattice.y, "x": place.lattice.x}, ("y", "x"))
    zero = dict.fromkeys(("run_out", "max_speed", "max_depth", "arrival_time"), 0.0)
    runs = EventRuns(Event(SCENE, observed(zero, nothing)), VARY, ("max_depth",), 0, 8, "")
    prior = Prior(runs.varied)
    spare = 2 * cases  # truths whose flow does not come to the gauge have no arrival to observe
    points = np.random.default_rng(2026).random((spare, len(prior.keys)))
    truths = runs.run(prior.design(points), None, None, 1, _quiet)
    misfits, rows = runs.misfits(truths), []
    for one in truths.members():
        if len(rows) == cases or not np.isfinite(misfits[one.member]).all():
            continue
        rows.append(_case(len(rows), one, simulated(runs.observations, misfits[one.member]), place, nothing))
        held = [sum(row["held"][key] for row in rows) for key in prior.keys]
        print(f"{len(rows)} cases: intervals that hold the truth {held}", flush=True)
    _write(rows, prior.keys)


def _case(number: int, truth, values: dict[str, float], place, nothing: xr.DataArray) -> dict:
    random = np.random.default_rng([7, number])
    sds = [one.sd for one in observed(values, nothing)]
    noisy = {
        name: value + sd * random.standard_normal() for (name, value), sd in zip(values.items(), sds, strict=False)
    }
    change = change_of(truth, place, source=False) + CHANGE_SD * random.standard_normal(place.lattice.shape)
    observations = observed(noisy, nothing.copy(data=change))
    posterior = calibrate(
        SCENE, VARY, observations, members=MEMBERS, generations=GENERATIONS, seed=1000 + number, maps=("max_depth",),
        workers=1, notify=_quiet,
    )  # fmt: skip
    intervals = posterior.interval(PART)
    own = {key: float(truth.values[key]) for key in intervals}
    return {
        "truth": own, "intervals": intervals, "effective_size": posterior.effective_size,
        "held": {key: bool(low <= own[key] <= high) for key, (low, high) in intervals.items()},
    }  # fmt: skip


def _write(rows: list[dict], keys: list[str]) -> None:
    count, tails = len(rows), [0.5 - 0.5 * PART, 0.5 + 0.5 * PART]
    design = Prior(EventRuns(Event(SCENE, [Measure("run_out", 0.0, 1.0)]), VARY, ("max_depth",), 0, 8, "").varied)
    ends = design.design(np.repeat(np.array(tails)[:, None], len(keys), axis=1))
    summary = {}
    for values in ends.data_vars.values():
        if "key" not in values.attrs:
            continue
        key, width = values.attrs["key"], float(np.ptp(values.values))
        summary[key] = {
            "held": sum(row["held"][key] for row in rows),
            "width over prior": float(np.mean([np.ptp(row["intervals"][key]) for row in rows])) / width,
        }
        held, relative = summary[key].values()
        print(f"{key}: {held} of {count} intervals hold the truth; their width is {relative:.2f} of the prior's")
    sizes = [row["effective_size"] for row in rows]
    print(
        f"effective sample size {np.mean(sizes):.0f} on average, {min(sizes):.0f} at least, of {MEMBERS * GENERATIONS}"
    )
    found = {"cases": count, "part": PART, "members": MEMBERS, "generations": GENERATIONS, "summary": summary,
             "rows": rows}  # fmt: skip
    result_files.keep("calibration_coverage", found, "python -m benchmarks.calibration coverage")


def _quiet(text: str) -> None:
    """Take no notice of progress."""


def main() -> None:
    """Print one of the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", choices=("coverage",))
    parser.add_argument("--cases", type=int, default=100)
    arguments = parser.parse_args()
    coverage(arguments.cases)


if __name__ == "__main__":
    main()
