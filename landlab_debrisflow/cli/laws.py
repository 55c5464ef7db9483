"""Reference of laws and parameters, made of their declarations for the command line and ``docs/laws.md``.

The docstring of a law has a form (CONTRIBUTING.md): its first line is the formula and, after a colon, its meaning;
a section ``References`` is its source.
"""

import dataclasses
import inspect
import re
import sys
import typing

import landlab_debrisflow

from .. import laws
from ..core.docstrings import allowed, default
from ..model.inflow.hydrograph import Hydrograph
from ..model.numerics import Numerics
from ..physics.material import Material
from ..physics.registry import LAWS, METHOD
from ..scene.setup import Setup

COMMAND = "landlab-debrisflow info --markdown > docs/laws.md"

INTRODUCTION = f"""# Laws and parameters

<!-- Written by `{COMMAND}` from the declarations; a test compares. -->

A law is chosen by the keyword of its kind: by name, with parameters, as in
`DebrisFlow(grid, friction={{"law": "voellmy", "turbulent_coefficient": 500.0}})`, or as an object of its class. The
first of a kind is the default. Where *in space* says yes, an array over nodes or the name of a field at nodes will do
for the number. Bounds belong to what is allowed. A law of your own: [CONTRIBUTING.md](../CONTRIBUTING.md).
"""

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
    """Return the entries of keywords besides laws whose parameters are declared: material, numerics, inflow."""
    classes = {"material": Material, "numerics": Numerics, "inflow": Hydrograph}
    return [_entry(keyword, cls, has_formula=False) for keyword, cls in classes.items()]


def markdown() -> str:
    """Return the page of all laws and parameters."""
    sections = [INTRODUCTION]
    contracts = typing.get_type_hints(Setup)
    for kind in LAWS:
        summary = inspect.cleandoc(contracts[kind].__doc__).splitlines()[0]
        sections.append(f"## {kind}\n\n{summary} A law of this kind has the method `{METHOD[kind]}`.\n")
        sections += map(_section, law_entries(kind))
    sections.append("## Other keywords\n")
    sections += map(_section, other_entries())
    return "\n".join(sections)


def _entry(title, cls, has_formula: bool) -> Entry:
    first, *details = _paragraphs(cls.__doc__)
    formula, _, summary = first.partition(": ") if has_formula else ("", "", first)
    formula = formula if summary else formula.removesuffix(".")
    details, source = _split_off_references(details)
    rows = [_row(parameter) for parameter in dataclasses.fields(cls)]
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


def _section(entry: Entry) -> str:
    paragraphs = [
        f"### {entry.title}",
        ": ".join(filter(None, (f"`{entry.formula}`" if entry.formula else "", entry.summary))),
        entry.details,
        f"Source: {entry.source}" if entry.source else "",
        f"Class `{_path(entry.cls)}`" + (":" if entry.rows else "; no parameters."),
        _table(entry.rows),
    ]
    return "\n\n".join(filter(None, paragraphs)) + "\n"


def _path(cls: type) -> str:
    """Return the dotted name from which a class is imported, of a public module if there is one."""
    public = (module for module in (landlab_debrisflow, laws) if getattr(module, cls.__name__, None) is cls)
    return f"{next(public, sys.modules[cls.__module__]).__name__}.{cls.__qualname__}"


def _table(rows) -> str:
    if not rows:
        return ""
    lines = [HEADINGS, ["---"] * len(HEADINGS), *([f"`{name}`", *rest] for name, *rest in rows)]
    return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |" for cells in lines)


def _row(parameter) -> tuple[str, ...]:
    meta = parameter.metadata
    in_space = "yes" if meta["varies"] else ""
    return (parameter.name, meta["unit"], default(parameter.default), allowed(meta), in_space, meta["meaning"])
