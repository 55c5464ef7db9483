"""Summary of a run in a paragraph for people who decide, and how sure it is."""

import csv
import math
from pathlib import Path
from typing import NamedTuple

from ..run.record import FAILED, INTERRUPTED, RunRecord
from ..run.results import Results
from .numbers import area, duration, rounded, volume
from .outcome import AFFECTED, Outcome

UNPLANNED = (
    "How large the errors of these numbers are has not been stated: the number of particles was given and not planned "
    "(numerics: particle_count: auto states them)."
)
BEYOND = (
    "Errors of the parameters and of the terrain come on top, and are larger as a rule: see the five things to "
    "distrust. A computation is no observation."
)


class Exposed(NamedTuple):
    """Polygons of a scene that may be exposed, as `exposure.csv` holds them.

    Attributes
    ----------
    head : list of str
        Names of the columns.
    rows : list of list of str
        A row for each polygon.
    """

    head: list[str]
    rows: list[list[str]]

    def column(self, name: str) -> list[str]:
        """Return the cells of a column; empty if there is no such column."""
        return [row[self.head.index(name)] for row in self.rows] if name in self.head else []


def exposed(results: Results) -> Exposed | None:
    """Return the table of exposed polygons; None if the scene has none."""
    path = results.directory / "exposure.csv"
    if not path.is_file():
        return None
    with Path(path).open(encoding="utf-8", newline="") as file:
        head, *rows = csv.reader(file)
    return Exposed(head, [row for row in rows if len(row) == len(head)])


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
    found = [*_volumes(record.budget), *_way(outcome)]
    found.append(
        f"It was at most {rounded(outcome.max_depth, 'm')} deep and {rounded(outcome.max_speed, 'm/s')} "
        f"({rounded(3.6 * outcome.max_speed, 'km/h')}) fast, and covered {area(outcome.affected_area)} with "
        f"{rounded(AFFECTED, 'm')} or more."
    )
    if record.at_rest:
        found.append(f"All was at rest, or had left the map, after {duration(record.elapsed_time)}.")
    else:
        found.append(
            f"It was still moving when the computation ended after {duration(record.elapsed_time)}: run-out, area and "
            "volumes are not final."
        )
    return [*found, *_exposure(exposure)]


def state_of(record: RunRecord) -> tuple[str, str]:
    """Return the state of a run as a heading, and the sentence for one that has not come to its end, or nothing."""
    if record.state == "finished":
        return ("At rest" if record.at_rest else "Still moving at its end"), ""
    how = {INTERRUPTED: "was interrupted", FAILED: "failed"}.get(
        record.state, "is still running, or was ended from outside"
    )
    time = f" at {record.elapsed_time:.6g} s" if record.elapsed_time else ""
    reason = f" The reason: {record.reason}." if record.reason and record.state == FAILED else ""
    return "Not finished", (
        f"This run {how}{time}. There are no results yet: below is what it was given.{reason} landlab-debrisflow "
        "resume goes on with it."
    )


def _volumes(budget: dict[str, float]) -> list[str]:
    came = [
        f"{volume(budget[name])} {words}"
        for name, words in (("released", "of ground failed or was released"), ("inflow", "flowed in"))
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
    return [*found, f"In the end {_joined(went)}."] if went else found


def _way(outcome: Outcome) -> list[str]:
    if not math.isfinite(outcome.run_out):
        return []
    start = "the release" if math.isfinite(outcome.travel_angle) else "where it flowed in"
    words = f"Its front came {rounded(outcome.run_out, 'm')} from the centre of {start}, measured on the map"
    if math.isfinite(outcome.travel_angle):
        words += (
            f", and {rounded(outcome.fall_height, 'm')} below the highest point of the release (a travel angle of "
            f"{rounded(outcome.travel_angle, '°', 2)})"
        )
    return [f"{words}; 99 % of what lies there is nearer."]


def _exposure(exposure: Exposed | None) -> list[str]:
    if exposure is None:
        return []
    names, reached = exposure.column("id"), exposure.column("reached")
    hit = [name for name, one in zip(names, reached, strict=False) if one == "True"]
    count = len(exposure.rows)
    if not hit:
        return [f"Of the {count} polygons given as exposed it reached none."]
    shown = ", ".join(hit[:10]) + (f" and {len(hit) - 10} more" if len(hit) > 10 else "")
    return [f"Of the {count} polygons given as exposed it reached {len(hit)}: {shown}."]


def _joined(words: list[str]) -> str:
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)
