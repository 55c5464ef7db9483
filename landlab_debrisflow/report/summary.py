"""Summary of a run in a paragraph for laymen, with its stated errors."""

import math

from ..fidelity.table import WORDS, percent
from ..run.record import FAILED, INTERRUPTED, RunRecord
from ..run.results import Results
from .exposure import Exposed, exposure_sentences
from .numbers import area, duration, rounded, volume
from .outcome import AFFECTED, Outcome

BEYOND = (
    "Errors of the parameters and of the terrain come on top, and are larger as a rule: see the five numbers to "
    "distrust. A computation is no observation."
)


def summary_of(record: RunRecord, outcome: Outcome, exposure: Exposed | None) -> list[str]:
    """Return the sentences that sum up a run that came to its end.

    Parameters
    ----------
    record : RunRecord
    outcome : Outcome
    exposure : Exposed or None

    Returns
    -------
    list of str
    """
    found = [*_volumes(record), *_way(outcome)]
    found.append(
        f"It was at most {rounded(outcome.max_depth, 'm')} deep and {rounded(outcome.max_speed, 'm/s')} "
        f"({rounded(3.6 * outcome.max_speed, 'km/h')}) fast, and covered {area(outcome.affected_area)} with "
        f"{rounded(AFFECTED, 'm')} or more."
    )
    if record.at_rest:
        left = ", or had left the map," if record.budget.get("outflow", 0.0) > 0.0 else ""
        found.append(f"All was at rest{left} after {duration(record.elapsed_time)}.")
    else:
        found.append(
            f"It was still moving when the computation ended after {duration(record.elapsed_time)}: run-out, area and "
            "volumes are not final."
        )
    return [*found, *exposure_sentences(exposure), *_certainty(record)]


def state_of(results: Results) -> tuple[str, str]:
    """Return the state of a run as a heading, and sentences on an unfinished run."""
    record = results.record
    if results.finished:
        return ("At rest" if record.at_rest else "Still moving at its end"), ""
    how = {INTERRUPTED: "was interrupted", FAILED: "failed"}.get(
        record.state, "is still running, or was ended from outside"
    )
    time = f" at {record.elapsed_time:.6g} s" if record.elapsed_time else ""
    reason = f" The reason: {record.reason}." if record.reason and record.state == FAILED else ""
    command = "resume goes on with it" if results.checkpoints else "run --overwrite begins it anew"
    return "Not finished", (
        f"The run {how}{time}.{reason} There are no results yet: below is the input. landlab-debrisflow {command}."
    )


def _volumes(record: RunRecord) -> list[str]:
    budget, releases = record.budget, record.scene.get("release") or []
    failed = all(isinstance(one, dict) and one.get("from", "ground") == "ground" for one in releases)
    came = [
        f"{volume(budget[name])} {words}"
        for name, words in (("released", "of ground failed" if failed else "was released"), ("inflow", "flowed in"))
        if budget.get(name, 0.0) > 0.0
    ]
    eroded = budget.get("eroded", 0.0)
    words = f"took up {volume(eroded)} of soil on its way" if eroded > 0.0 else "took up no soil"
    found = [f"{_joined(came) or 'Nothing was released'}; the flow {words}."]
    went = [
        f"{volume(budget[name])} {words}"
        for name, words in (
            ("deposited", "came to lie on the ground"), ("moving", "still moved"),
            ("outflow", "left the map over its edge, where the computation ends"),
        ) if budget.get(name, 0.0) > 0.0
    ]  # fmt: skip
    when = "In the end" if record.at_rest else "When the computation ended"
    return [*found, f"{when} {_joined(went)}."] if went else found


def _way(outcome: Outcome) -> list[str]:
    if not math.isfinite(outcome.run_out):
        return []
    start = "the centre of the release" if math.isfinite(outcome.travel_angle) else "the place where it flowed in"
    words = (
        f"Its front, behind which 99 % of the volume lies, came {rounded(outcome.run_out, 'm')} from "
        f"{start}, measured on the map"
    )
    if math.isfinite(outcome.travel_angle):
        words += (
            f", and {rounded(outcome.fall_height, 'm')} below the highest point of the release (a travel angle of "
            f"{rounded(outcome.travel_angle, '°', 2)})"
        )
    return [f"{words}."]


IN_SUMMARY = ("run_out", "speed", "depth", "area", "eroded")
"""Quantities whose stated errors are in the summary."""


def _certainty(record: RunRecord) -> list[str]:
    if record.statement is None:
        return ["No errors were stated for these numbers."]
    errors, raster = record.statement.get("errors") or {}, record.statement.get("raster_errors") or {}
    words = [
        f"{WORDS[name]} {percent(errors[name])} and {percent(raster.get(name))}"
        for name in IN_SUMMARY if errors.get(name) is not None
    ]  # fmt: skip
    unknown = [WORDS[name] for name in IN_SUMMARY if name in errors and errors[name] is None]
    found = []
    if words:
        found.append(
            "The number of particles and the raster of the terrain are meant to change these numbers, in 95 % of "
            f"scenes, by no more than: {'; '.join(words)}."
        )
    if unknown:
        found.append(f"The error of {_joined(unknown)} is not known.")
    return found


def _joined(words: list[str]) -> str:
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)
