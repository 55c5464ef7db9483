"""Result files: numbers that took long to measure, kept in the repository so that a chart is drawn in seconds.

benchmarks/results/NAME.json holds numbers and words, NAME.nc arrays. Both say by which command, when, from which commit
and on what machine they were measured. Charts are drawn from them by ``python -m benchmarks.charts``.
"""

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from landlab_debrisflow.record import write_atomically
from validation.provenance import provenance

ROOT = Path(__file__).parents[1]
FOLDER = Path(__file__).parent / "results"
DIGITS = 6
"""Of the numbers in a JSON file."""


def path_of(name: str) -> Path:
    """Return where the result of this name is, JSON or NetCDF; of JSON if there is none."""
    dataset = FOLDER / f"{name}.nc"
    return dataset if dataset.is_file() else FOLDER / f"{name}.json"


def keep(name: str, data: Mapping[str, Any], command: str, measured: Mapping[str, Any] | None = None) -> Path:
    """Write numbers and words as benchmarks/results/NAME.json; NaN and infinities become null.

    `measured` is the provenance where it is not that of now.
    """
    told = {"measured": dict(measured or provenance(command)), **data}
    text = _text(_plain(told))
    return write_atomically(FOLDER / f"{name}.json", lambda path: path.write_text(text, encoding="utf-8"))


def keep_dataset(name: str, dataset: xr.Dataset, command: str, steps: Mapping[str, float] | None = None) -> Path:
    """Write arrays as benchmarks/results/NAME.nc, compressed.

    `steps` are the steps to which variables are rounded: they are stored as integers of 16 bits.
    """
    encoding: dict[str, dict[str, Any]] = {}
    for variable in dataset.data_vars:
        encoding[str(variable)] = {"zlib": True, "complevel": 9, "shuffle": True}
    for variable, step in (steps or {}).items():
        encoding[variable] |= {"dtype": "i2", "scale_factor": step, "_FillValue": -(2**15)}
    told = dataset.assign_attrs({f"measured_{key}": value for key, value in provenance(command).items()})
    return write_atomically(FOLDER / f"{name}.nc", lambda path: told.to_netcdf(path, encoding=encoding))


def read(name: str) -> dict[str, Any]:
    """Return the numbers and words of benchmarks/results/NAME.json; null is NaN."""
    return _numbers(json.loads((FOLDER / f"{name}.json").read_text(encoding="utf-8")))


def read_dataset(name: str) -> xr.Dataset:
    """Return the arrays of benchmarks/results/NAME.nc."""
    return xr.load_dataset(FOLDER / f"{name}.nc")


def measured(name: str) -> dict[str, Any]:
    """Return how a result came about."""
    if path_of(name).suffix == ".json":
        return read(name)["measured"]
    with xr.open_dataset(path_of(name)) as dataset:
        words = {key.removeprefix("measured_"): value for key, value in dataset.attrs.items() if "measured_" in key}
    return {key: value.item() if isinstance(value, np.generic) else value for key, value in words.items()}


def _plain(value):
    """Return a value of JSON: numbers with `DIGITS`, NaN and infinities as None."""
    if isinstance(value, Mapping):
        return {str(key): _plain(each) for key, each in value.items()}
    if isinstance(value, np.ndarray):
        return _plain(value.tolist())
    if isinstance(value, (list, tuple)):
        return [_plain(each) for each in value]
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    if isinstance(value, (int, np.integer)):
        return int(value)
    if isinstance(value, (float, np.floating)):
        return float(f"{value:.{DIGITS}g}") if math.isfinite(value) else None
    return value


def _numbers(value):
    """Return what `_plain` made, with NaN for None."""
    if isinstance(value, dict):
        return {key: _numbers(each) for key, each in value.items()}
    if isinstance(value, list):
        return [_numbers(each) for each in value]
    return math.nan if value is None else value


def _text(told: Mapping[str, Any]) -> str:
    """Return JSON with a line for every member and for every row of a table, so that changes can be read."""
    members = []
    for key, value in told.items():
        if isinstance(value, list) and value and isinstance(value[0], (dict, list)):
            rows = ",\n  ".join(json.dumps(row, ensure_ascii=False) for row in value)
            members.append(f"{json.dumps(key)}: [\n  {rows}\n ]")
        else:
            members.append(f"{json.dumps(key)}: {json.dumps(value, ensure_ascii=False)}")
    return "{\n " + ",\n ".join(members) + "\n}\n"
