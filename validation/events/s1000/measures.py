"""Measures of a landslide by the change of elevation: extent, volumes, correlation, toe; references to judge them."""

import numpy as np
import xarray as xr
from scipy import ndimage

from landlab_debrisflow.calibration.agreement import correlation, csi

from ..event import Measure
from ..scores import precision, recall

CHANGED = 0.2
"""Least change of elevation that counts [m]."""
SURVEY_NOISE = (0.2, 0.59)
"""Standard deviations of the difference of two surveys [m]: of the least change that counts, and of the surveys of 2009
and 2021 where nothing slid (10 to 90 %: -0.6 to +0.9 m)."""
SEEDS = 20
"""Of the noise that is added to the observation."""

MEASURES = {
    "csi outside": Measure("CSI", "{:.3f}"),
    "correlation outside": Measure("correlation", "{:+.2f}"),
    "csi": Measure("CSI with the source", tabulated=False),
    "csi 0.5 outside": Measure("CSI, 0.5 m", "{:.3f}"),
    "precision outside": Measure("precision", tabulated=False),
    "recall outside": Measure("recall", tabulated=False),
    "csi erosion": Measure("CSI of lowering", tabulated=False),
    "csi deposition": Measure("CSI of raising", tabulated=False),
    "correlation above fan": Measure("correlation, fan left out", "{:+.2f}", tabulated=False),
    "lowered outside": Measure("lowered [m³]", "{:.0f}"),
    "raised outside": Measure("raised [m³]", "{:.0f}"),
    "in scar": Measure("in the scar [m³]", "{:.0f}"),
    "toe": Measure("toe [m]", "{:+.0f}"),
    "eroded": Measure("eroded, all passes [m³]", "{:.0f}", tabulated=False),
    "outflow": Measure("left the map [m³]", "{:.0f}", tabulated=False),
    "duration": Measure("at rest after [s]", "{:.0f}", tabulated=False),
}
"""All outside of the source, unless the words say otherwise. Toe: distance of the farthest changed cell from the
highest cell of the source in plan, less the observed one."""


def score(result: xr.Dataset) -> dict[str, float]:
    """Return the measures of a run."""
    budget = {key: float(result.attrs[key]) for key in ("eroded", "outflow", "duration")}
    return of_change(result.modelled_change.values, result) | budget


def of_change(change: np.ndarray, result: xr.Dataset) -> dict[str, float]:
    """Return the measures of a change of elevation against the observed one.

    Parameters
    ----------
    change : ndarray, shape (rows, columns)
        Change of elevation [m].
    result : xarray.Dataset
        As of `run_landslide`.
    """
    seen, outside = result.observed_change.values, result.source.values == 0
    cell = float(result.x[1] - result.x[0]) * float(result.y[1] - result.y[0])
    here, there = (abs(change) > CHANGED) & outside, (abs(seen) > CHANGED) & outside
    either = here | there
    above = either & (result.fan.values == 0)
    return {
        "csi outside": csi(here, there),
        "correlation outside": correlation(change[either], seen[either]),
        "csi": csi(abs(change) > CHANGED, abs(seen) > CHANGED),
        "csi 0.5 outside": csi((abs(change) > 0.5) & outside, (abs(seen) > 0.5) & outside),
        "precision outside": precision(here, there),
        "recall outside": recall(here, there),
        "csi erosion": csi(change < -CHANGED, seen < -CHANGED),
        "csi deposition": csi(change > CHANGED, seen > CHANGED),
        "correlation above fan": correlation(change[above], seen[above]),
        "lowered outside": float(np.maximum(-change, 0.0)[outside].sum()) * cell,
        "raised outside": float(np.maximum(change, 0.0)[outside].sum()) * cell,
        "in scar": float((change + result.released_depth.values)[~outside].sum()) * cell,
        "toe": reach(here, result) - reach(there, result),
    }


def references(result: xr.Dataset) -> dict[str, dict[str, float]]:
    """Return the measures of the observation, of a release spread along the path, and of a perfect model."""
    seen = result.observed_change.values
    blank = dict.fromkeys(("csi outside", "correlation outside", "csi 0.5 outside", "toe"), np.nan)
    found = {"observed": of_change(seen, result) | blank, "release spread along the path": spread_evenly(result)}
    for noise in SURVEY_NOISE:
        scores = [of_change(seen, _with_noise(result, noise, seed)) for seed in range(SEEDS)]
        means = {name: float(np.nanmean([each[name] for each in scores])) for name in scores[0]}
        volumes = dict.fromkeys(("lowered outside", "raised outside", "in scar", "toe"), np.nan)
        found[f"perfect model, survey noise {noise:g} m"] = means | volumes
    return found


def spread_evenly(result: xr.Dataset) -> dict[str, float]:
    """Return the measures without any physics: the release lies evenly on a strip of three cells along the path.

    The path is the mean column of the observed change in every row, because both landslides run southwards.
    """
    seen, release = result.observed_change.values, result.released_depth.values
    changed = abs(seen) > CHANGED
    rows = np.flatnonzero(changed.any(axis=1))
    every = np.arange(rows[0], rows[-1] + 1)
    centre = np.interp(every, rows, [np.flatnonzero(changed[row]).mean() for row in rows])
    centre = np.convolve(np.pad(centre, 2, mode="edge"), np.full(5, 0.2), mode="valid")
    strip = np.zeros(seen.shape, bool)
    for side in (-1, 0, 1):
        strip[every, np.clip(np.rint(centre).astype(int) + side, 0, seen.shape[1] - 1)] = True
    return of_change(np.where(strip, release.sum() / strip.sum(), 0.0) - release, result)


def observed_moved(result: xr.Dataset) -> dict[str, float]:
    """Return the mean measures of the observed change outside of the source, moved by a cell in four directions.

    A model without error, whose terrain or survey is out of place by a cell, would have these.
    """
    seen, source = result.observed_change.values, result.source.values == 1
    moved = [np.roll(seen, step, axis) for axis in (0, 1) for step in (-1, 1)]
    found = [of_change(np.where(source, seen, one), result) for one in moved]
    return {key: float(np.mean([one[key] for one in found])) for key in found[0]}


def observed_smoothed(result: xr.Dataset) -> dict[str, float]:
    """Return the measures of the observed change, smoothed outside of the source by a Gaussian of one cell."""
    seen, source = result.observed_change.values, result.source.values == 1
    smooth = ndimage.gaussian_filter(np.where(source, 0.0, seen), 1.0)
    return of_change(np.where(source, seen, smooth), result)


def reach(changed: np.ndarray, result: xr.Dataset) -> float:
    """Return the distance in plan of the farthest changed cell from the highest cell of the source [m]; 0 if none."""
    height = np.where(result.source.values == 1, result.elevation.values, -np.inf)
    row, column = np.unravel_index(np.argmax(height), height.shape)
    x, y = np.meshgrid(result.x.values, result.y.values)
    away = np.hypot(x - x[row, column], y - y[row, column])[changed]
    return float(away.max()) if away.size else 0.0


def _with_noise(result: xr.Dataset, noise: float, seed: int) -> xr.Dataset:
    """Return the result with noise added to the observed change where there was a survey [m]."""
    errors = np.random.default_rng(seed).normal(0.0, noise, result.mapped.shape)
    return result.assign(observed_change=result.observed_change + errors * (result.mapped == 1))
