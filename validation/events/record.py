"""Records of an event: every score of every set in scores.json, and the result that is shown in result.nc."""

import json
import math
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import xarray as xr

from landlab_debrisflow.core.errors import InputError
from landlab_debrisflow.record import write_atomically
from validation.provenance import commit, provenance

from .event import Event
from .scores import spread
from .sets import ParameterSet

DIGITS = 5
"""Of the scores."""
NEARBY = (0.9, 0.95, 1.05, 1.1)
"""Numbers of particles over that of the event, whose scores differ by the noise of the discretisation."""


def read_scores(folder: Path) -> list[dict[str, Any]]:
    """Return the rows of scores.json, oldest first; none if there is no file."""
    return _read(folder)["rows"]


def read_references(folder: Path) -> dict[str, dict[str, float]]:
    """Return the scores of the references of an event by their words; none before its first run."""
    return _read(folder)["references"]


def add_scores(
    event: Event,
    parameters: ParameterSet,
    particle_count: int,
    scores: Mapping[str, float],
    references: Mapping[str, Mapping[str, float]],
) -> None:
    """Append scores to scores.json of an event, and write the scores of its references anew.

    A row that is there already with the same set, commit, change, particles and scores is not repeated; no row is
    ever removed.

    Raises
    ------
    InputError
        If the set is not committed.
    """
    found = parameters.commit()
    row = {
        "set": parameters.name, "commit": found.name, "committed": found.date, "change": parameters.change,
        "particles": particle_count, "date": datetime.now(UTC).date().isoformat(), "code": commit(),
        "scores": {key: _rounded(value) for key, value in scores.items()},
    }  # fmt: skip
    rows = read_scores(event.folder)
    same = ("set", "commit", "change", "particles", "scores")
    if not any(_text({key: old[key] for key in same}) == _text({key: row[key] for key in same}) for old in rows):
        rows.append(row)
    named = [{"reference": words, "scores": dict(found)} for words, found in references.items()]
    members = ((name, ",\n  ".join(map(_text, each))) for name, each in (("references", named), ("rows", rows)))
    lists = ",\n ".join(f'"{name}": [\n  {lines}\n ]' for name, lines in members)
    text = f'{{\n "event": {json.dumps(event.name)},\n {lists}\n}}\n'
    write_atomically(event.folder / "scores.json", lambda path: path.write_text(text, encoding="utf-8"))


def latest(rows: list[dict], set_name: str, particle_count: int, change: str = "") -> dict | None:
    """Return the last row of a set with a number of particles, or None."""
    found = [
        row for row in rows
        if row["set"] == set_name and row["particles"] == particle_count and row["change"] == change
    ]  # fmt: skip
    return found[-1] if found else None


def noise(rows: list[dict], set_name: str, particle_count: int) -> dict[str, float]:
    """Return the spread of every score over numbers of particles near that of the event; empty if not run."""
    counts = nearby_counts(particle_count)
    found = [row for count in (particle_count, *counts) if (row := latest(rows, set_name, count))]
    return spread(row["scores"] for row in found) if len(found) > 2 else {}


def nearby_counts(particle_count: int) -> tuple[int, ...]:
    """Return numbers of particles near that of an event, for the noise of its scores."""
    return tuple(round(factor * particle_count) for factor in NEARBY)


def keep_result(event: Event, parameters: ParameterSet, result: xr.Dataset) -> Path:
    """Write the variables that are shown as result.nc of an event, with the set and its commit."""
    found, result = parameters.commit(), event.shown(result)
    told = {f"measured_{key}": value for key, value in provenance(f"python -m validation.events {event.name}").items()}
    attributes = {**result.attrs, "set": parameters.name, "set_commit": found.name, "set_date": found.date, **told}
    encoding: dict[str, dict[str, Any]] = {
        str(name): {"zlib": True, "complevel": 9, "shuffle": True} for name in result.data_vars
    }
    for name, step in event.steps.items():
        encoding[name] |= {"dtype": "i2", "scale_factor": step, "_FillValue": -(2**15)}
    stored = result.assign_attrs(attributes)
    return write_atomically(event.folder / "result.nc", lambda path: stored.to_netcdf(path, encoding=encoding))


def read_result(event: Event) -> xr.Dataset:
    """Return the result that is shown, from result.nc; InputError if the event has not been run."""
    path = event.folder / "result.nc"
    if not path.is_file():
        raise InputError(f"there is no {path}; python -m validation.events {event.name} makes it")
    return xr.load_dataset(path)


def _read(folder: Path) -> dict[str, Any]:
    path = folder / "scores.json"
    if not path.is_file():
        return {"rows": [], "references": {}}
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        rows = [row | {"scores": _numbers(row["scores"])} for row in content["rows"]]
        references = {row["reference"]: _numbers(row["scores"]) for row in content["references"]}
    except (ValueError, KeyError, TypeError) as error:
        raise InputError(
            f"{path} is no record of scores: {error!r}; take it back from Git, never write it anew"
        ) from error
    return {"rows": rows, "references": references}


def _numbers(scores: Mapping[str, float | None]) -> dict[str, float]:
    return {key: math.nan if value is None else value for key, value in scores.items()}


def _rounded(value: float) -> float | None:
    value = float(value)
    return float(f"{value:.{DIGITS}g}") if math.isfinite(value) else None


def _text(row: Any) -> str:
    """Return JSON, with null for NaN."""
    if isinstance(row, dict) and "scores" in row:
        row = row | {
            "scores": {key: None if value is None else _rounded(value) for key, value in row["scores"].items()}
        }
    return json.dumps(row, ensure_ascii=False, allow_nan=False)
