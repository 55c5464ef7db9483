"""Declarations of laws and other keywords in words, for the command line, the page of laws and the report.

The docstring of a law has a form (CONTRIBUTING.md): its first line is the formula and, after a colon, its meaning;
a section ``References`` is its source.
"""

import inspect
import re
import typing

from ..core.docstrings import allowed, default
from ..core.values import flat_keys_of
from ..model.inflow.hydrograph import Hydrograph
from ..model.numerics import Numerics
from ..physics.column.dilatancy import Dilatancy
from ..physics.consolidation import Consolidation
from ..physics.material import Material
from ..physics.registry import LAWS

HEADINGS = ("parameter", "unit", "default", "allowed", "in space", "meaning")


class Entry(typing.NamedTuple):
    """Declaration of one class in words.

    Attributes
    ----------
    title : str
        "friction: voellmy", or a keyword that is no law.
    cls : type
        The declared class.
    formula : str
        Formula of a law; else "".
    summary : str
        Meaning in a line; may be empty for a law.
    details : str
        Further paragraphs.
    source : str
        Publications; "" if there is none.
    rows : list of tuple of str
        One row for each parameter, with a cell for each of `HEADINGS`.
    """

    title: str
    cls: type
    formula: str
    summary: str
    details: str
    source: str
    rows: list


def law_entries(kind: str) -> list[Entry]:
    """Return the entries of the laws of a kind, the default first."""
    return [_entry(f"{kind}: {name}", law, has_formula=True) for name, law in LAWS[kind].items()]


def other_entries() -> list[Entry]:
    """Return the entries of keywords besides laws whose parameters are declared: material, numerics, inflow.

    Among them, with a formula, are dilatancy and the parameter of the material that may follow from others.
    """
    classes = {"material": Material, "numerics": Numerics, "inflow": Hydrograph}
    entries = [_entry(keyword, cls, has_formula=False) for keyword, cls in classes.items()]
    with_formula = {"dilatancy": Dilatancy, "coefficient_of_consolidation": Consolidation}
    return [*entries, *(_entry(keyword, cls, has_formula=True) for keyword, cls in with_formula.items())]


def _entry(title: str, cls: type, has_formula: bool) -> Entry:
    first, *details = _paragraphs(cls.__doc__)
    formula, _, summary = first.partition(": ") if has_formula else ("", "", first)
    formula = formula if summary else formula.removesuffix(".")
    details, source = _split_off_references(details)
    rows = [_row(name, parameter) for name, parameter in flat_keys_of(cls).items()]
    return Entry(title, cls, formula, summary, "\n\n".join(details), source, rows)


def _paragraphs(docstring) -> list[str]:
    """Return the paragraphs, lines joined; a section of numpydoc begins one with its heading, still underlined."""
    return [" ".join(part.split()) for part in re.split(r"\n\s*\n", inspect.cleandoc(docstring))]


def _split_off_references(paragraphs):
    """Return the paragraphs before the first section, and the text of the section References."""
    sections = [k for k, words in enumerate(paragraphs) if re.match(r"\w+ ---+", words)]
    sources = [words for words in paragraphs if words.startswith("References ---")]
    source = re.sub(r"^References -+ ?", "", sources[0]) if sources else ""
    return paragraphs[: sections[0]] if sections else paragraphs, source


def _row(name: str, parameter) -> tuple[str, ...]:
    meta = parameter.metadata
    in_space = "yes" if meta["varies"] else ""
    return (name, meta["unit"], default(parameter.default), allowed(meta), in_space, meta["meaning"])
