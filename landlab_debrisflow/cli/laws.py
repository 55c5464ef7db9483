"""Reference of laws and parameters, made of their declarations for the command line and ``docs/laws.md``."""

import inspect
import sys
import typing

import landlab_debrisflow

from .. import laws
from ..physics.registry import LAWS, METHOD
from ..scene.law_entries import HEADINGS, Entry, law_entries, other_entries
from ..scene.setup import Setup

COMMAND = "landlab-debrisflow info --markdown > docs/laws.md"

INTRODUCTION = f"""# Laws and parameters

<!-- Written by `{COMMAND}` from the declarations; a test compares. -->

A law is chosen by the keyword of its kind: by name, with parameters, as in
`DebrisFlow(grid, friction={{"law": "voellmy", "turbulent_coefficient": 500.0}})`, or as an object of its class. The
first of a kind is the default. Where *in space* says yes, an array over nodes or the name of a field at nodes will do
for the number. Bounds belong to what is allowed. A law of your own: [CONTRIBUTING.md](../CONTRIBUTING.md).
"""


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
