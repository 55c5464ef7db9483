"""Exposed polygons of a run for its report: which were reached, when, how deep and how fast."""

import csv
from pathlib import Path
from typing import NamedTuple

from ..core.errors import InputError
from ..run.results import Results
from .blocks import Table
from .numbers import rounded

SHOWN = {
    "max_depth_m": ("peak depth", "m"), "max_speed_m_s": ("peak speed", "m/s"),
    "max_impact_pressure_kPa": ("peak impact pressure", "kPa"), "max_run_up_m": ("peak run-up", "m"),
    "max_deposit_depth_m": ("deposit", "m"), "first_arrival_s": ("first arrival", "s"),
}  # fmt: skip
"""Columns of a report, by their names in the file."""

MOST_NAMED = 10
"""Polygons that the summary names at most."""


class Exposed(NamedTuple):
    """Polygons of a scene that may be exposed, as ``exposure.csv`` holds them.

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
        """Return the cells of a column; empty cells if the table lacks the column."""
        return [row[self.head.index(name)] for row in self.rows] if name in self.head else [""] * len(self.rows)


def exposed(results: Results) -> Exposed | None:
    """Return the table of exposed polygons; None if the scene has none.

    Parameters
    ----------
    results : Results

    Returns
    -------
    Exposed or None

    Raises
    ------
    InputError
        If the table is damaged.
    """
    path = results.directory / "exposure.csv"
    return read_exposed(path, {"id", "reached"}, "run the scene anew with --overwrite")


def read_exposed(path: Path, needed: set[str], remedy: str) -> Exposed | None:
    """Return a table of exposed polygons; None if there is no such file.

    Parameters
    ----------
    path : Path
    needed : set of str
        Columns without which the table is damaged.
    remedy : str
        What to do then.

    Returns
    -------
    Exposed or None

    Raises
    ------
    InputError
        If the table is damaged.
    """
    if not path.is_file():
        return None
    with path.open(encoding="utf-8", newline="") as file:
        head, *rows = list(csv.reader(file)) or [[]]
    if not needed <= set(head) or any(len(row) != len(head) for row in rows):
        raise InputError(f"{path} is no table of exposed polygons; the file is damaged, {remedy}")
    return Exposed(head, rows)


def exposure_table(exposure: Exposed) -> Table:
    """Return the table of a report: peaks, first arrival and deposit in each polygon."""
    names = [name for name in SHOWN if name in exposure.head]
    columns = [
        exposure.column("id"), ["yes" if one == "True" else "no" for one in exposure.column("reached")],
        *([_number(one) for one in exposure.column(name)] for name in names),
    ]  # fmt: skip
    head = ("polygon", "reached", *(f"{words} [{unit}]" for words, unit in (SHOWN[name] for name in names)))
    return Table(
        caption="Peaks, first arrival and deposit in each polygon", head=head, rows=list(zip(*columns, strict=True)),
        numbers=range(2, len(head)),
    )  # fmt: skip


def exposure_sentences(exposure: Exposed | None) -> list[str]:
    """Return the sentence of a summary on the polygons that were reached, if there are any."""
    if exposure is None:
        return []
    hit = [name for name, one in zip(exposure.column("id"), exposure.column("reached"), strict=True) if one == "True"]
    count = len(exposure.rows)
    if not hit:
        return [f"Of the {count} polygons given as exposed it reached none."]
    more = f" and {len(hit) - MOST_NAMED} more" if len(hit) > MOST_NAMED else ""
    return [f"Of the {count} polygons given as exposed it reached {len(hit)}: {', '.join(hit[:MOST_NAMED])}{more}."]


def _number(text: str) -> str:
    try:
        return rounded(float(text))
    except ValueError:
        return ""
