"""Rows, stated errors and notes of a plan or a statement, as text and as a table for notebooks."""

import dataclasses
import math
import re
import textwrap
from collections.abc import Mapping, Sequence
from html import escape

WORDS = {
    "run_out": "run-out", "speed": "peak speed", "depth": "peak depth", "area": "affected area",
    "eroded": "eroded volume", "pressure": "peak pressure ratio", "deposit": "deposit thickness",
}  # fmt: skip
"""Quantities in words."""

WIDTH = 110
"""Width of the lines [characters]."""

LEAST_CREEP = 0.005
"""Relative change below which creep is not mentioned [-]."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class Table:
    """Content of a plan or a statement.

    Attributes
    ----------
    title : str
        First line.
    rows : sequence of tuple of str
        Names and words.
    errors : sequence of tuple
        Quantity, error of particles [-], of the raster [-] (None: not examined), and whether it is held; empty: the
        errors are not known.
    raster : str
        From where the errors of the raster are.
    creep : str
        Change of run-out in the last creep; empty: small.
    not_held : mapping of str to str
        Quantities that are not held, and why.
    notes : sequence of str
        Warnings.
    """

    title: str
    rows: Sequence[tuple[str, str]]
    errors: Sequence[tuple[str, float, float | None, str]] = ()
    raster: str = ""
    creep: str = ""
    not_held: Mapping[str, str] = dataclasses.field(default_factory=dict)
    notes: Sequence[str] = ()

    def text(self) -> str:
        """Return the content as lines."""
        lines, width = [self.title], max(len(name) for name, _ in self._all_rows())
        for name, words in self.rows:
            lines += _wrapped(name, words, width)
        if self.errors:
            lines += _wrapped("errors", "of particles / of the raster; meant for 95 % of scenes", width)
            longest = max(len(WORDS[name]) for name, *_ in self.errors)
            for name, particles, raster, verdict in self.errors:
                numbers = f"{percent(particles):>9} / {percent(raster):<12}"
                lines.append(f"  {'':{width}}  {WORDS[name]:{longest}} {numbers} {verdict}")
        for name, words in self._endings():
            lines += _wrapped(name, words, width)
        return "\n".join(lines)

    def html(self) -> str:
        """Return the content as a table."""
        left = 'style="text-align:left"'
        cells = [f"<tr><th {left}>{escape(name)}</th><td {left}>{escape(words)}</td></tr>" for name, words in self.rows]
        if self.errors:
            head = "".join(f"<th {left}>{words}</th>" for words in ("quantity", "of particles", "of the raster", ""))
            lines = [
                f"<tr><td {left}>{WORDS[name]}</td><td>{percent(particles)}</td><td>{percent(raster)}</td>"
                f"<td {left}>{verdict}</td></tr>"
                for name, particles, raster, verdict in self.errors
            ]
            cells.append(
                f"<tr><th {left}>errors</th><td {left}><table><tr>{head}</tr>{''.join(lines)}</table></td></tr>"
            )
        cells += [
            f"<tr><th {left}>{escape(name)}</th><td {left}>{escape(words)}</td></tr>" for name, words in self._endings()
        ]
        return f"<table><caption>{escape(self.title)}</caption>{''.join(cells)}</table>"

    def _all_rows(self) -> list[tuple[str, str]]:
        return [*self.rows, *self._endings()]

    def _endings(self) -> list[tuple[str, str]]:
        """Return names and words of the rows after the errors."""
        found = [("raster", self.raster)] if self.raster else []
        found += [("not held", f"{WORDS[name]}: {reason}") for name, reason in self.not_held.items()]
        found += [("creeping", self.creep)] if self.creep else []
        return found + [("note", note) for note in self.notes]


def percent(value: float | None) -> str:
    """Return a part of 1 as a percentage in words; None was not examined.

    Examples
    --------
    >>> [percent(value) for value in (0.0512, 0.0034, 1.5, float("nan"), float("inf"), None)]
    ['5.1 %', '0.3 %', '> 100 %', 'not known', '> 100 %', 'not examined']
    """
    if value is None:
        return "not examined"
    if math.isnan(value):
        return "not known"
    return f"{100.0 * value:.1f} %" if value <= 1.0 else "> 100 %"


def _wrapped(name: str, words: str, width: int) -> list[str]:
    """Return words after a name in lines that do not end between a number and its unit."""
    joined = re.sub(r"(?<=\d) (?=[%\d]|m?s\b)", "\xa0", words)
    indent = " " * (width + 4)
    lines = textwrap.wrap(f"  {name:{width}}  {joined}", WIDTH, subsequent_indent=indent, break_long_words=False)
    return [line.replace("\xa0", " ") for line in lines]


class Printed:
    """Base of classes that print as the `Table` that their ``_table`` returns; a dataclass needs ``repr=False``."""

    def _table(self) -> Table:
        raise AttributeError(f"{type(self).__name__} has no table")

    def __str__(self) -> str:
        return self._table().text()

    def __repr__(self) -> str:
        return str(self)

    def _repr_html_(self) -> str:
        return self._table().html()
