"""Hydrographs from tables: time and discharge in a text file."""

import math
import re
from pathlib import Path

from ..core.errors import InputError
from ..core.hints import number_in
from .text_table import table_rows

COLUMNS = {"time": ("time", "t"), "discharge": ("discharge", "q", "flow")}
"""Words by which a column is known, the first of them the one that is asked for."""
WANTED = "a table with time [s] and discharge [m3 s-1]"


def read_hydrograph(path: Path) -> tuple[tuple[float, float], ...]:
    r"""Read time [s] and discharge [m3 s-1] from a table with comma, semicolon, tab or blanks between columns.

    Columns are found by the words time (or t) and discharge (or q) in a first line, in which units may follow; without
    such a line they are the first two.

    Parameters
    ----------
    path : Path

    Returns
    -------
    tuple of pairs of float

    Raises
    ------
    InputError
        If the file cannot be read, a column is missing, or a cell is no number.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "surge.csv"
    ...     _ = path.write_text("time [s];Q [m3/s]\n0;0\n60;20,5\n")
    ...     read_hydrograph(path)
    ((0.0, 0.0), (60.0, 20.5))
    """
    rows = table_rows(path, WANTED)
    header = None if all(number_in(cell) is not None for cell in rows[0][1][:2]) else rows.pop(0)[1]
    places = {name: _place(path, name, header) for name in COLUMNS}
    if not rows:
        raise InputError(f"{path} has no line with numbers; give time [s] and discharge [m3 s-1] in two columns")
    return tuple((_cell(path, line, row, places["time"]), _cell(path, line, row, places["discharge"]))
                 for line, row in rows)  # fmt: skip


def _place(path: Path, name: str, header: list[str] | None) -> int:
    """Return the number of the column of a quantity."""
    if header is None:
        return list(COLUMNS).index(name)
    words = [re.split(r"[\s(\[_]", cell.strip().lower())[0] for cell in header]
    found = [k for k, word in enumerate(words) if word in COLUMNS[name]]
    if len(found) != 1:
        number = "no column" if not found else "more than one column"
        raise InputError(
            f"{path} has {number} {name}; its columns are {', '.join(header)}; name those of time [s] "
            "and discharge [m3 s-1] so"
        )
    return found[0]


def _cell(path: Path, line: int, row: list[str], place: int) -> float:
    text = row[place] if place < len(row) else ""
    number = number_in(text)
    if number is None or not math.isfinite(number):
        raise InputError(f"{path} line {line}: column {place + 1} must be a number, got {text!r:.60}")
    return number
