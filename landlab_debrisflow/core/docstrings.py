"""Docstrings of declared classes: the section ``Parameters``, from the declarations."""

import dataclasses
import inspect
import math
import re
import textwrap

WIDTH = 100
"""Width of the lines of the section [characters]."""


def with_parameters(docstring: str | None, fields) -> str | None:
    """Return a docstring with a numpydoc section ``Parameters`` before its first section.

    Parameters
    ----------
    docstring : str or None
    fields : sequence of dataclasses.Field
        With the metadata of `core.parameters.parameter`.

    Returns
    -------
    str or None
        The docstring, its indentation taken off; as it was if there is none, if it has such a section, or if no
        parameter is declared.
    """
    declared = [field for field in fields if "meaning" in field.metadata]
    text = inspect.cleandoc(docstring or "")
    if not text or not declared or re.search(r"^Parameters\n-{3,}$", text, re.MULTILINE):
        return docstring
    first = re.search(r"^\w[\w ]*\n-{3,}$", text, re.MULTILINE)
    before, after = (text[: first.start()], text[first.start() :]) if first else (text, "")
    section = "\n".join(["Parameters", "----------", *map(_entry, declared)])
    return "\n\n".join(filter(None, (before.rstrip(), section, after)))


def allowed(meta) -> str:
    """Return in words which values a declaration allows."""
    if meta["choices"]:
        return ", ".join(meta["choices"])
    if meta["kind"] is bool:
        return "true, false"
    if dataclasses.is_dataclass(meta["kind"]):
        return "mapping"
    kind = {int: "integer, ", tuple: "list, "}.get(meta["kind"], "")
    others = [*meta["words"], *([f"mapping of {', '.join(_names(meta))}"] if meta["derivation"] else [])]
    return "; ".join((kind + _interval(*meta["bounds"], meta["open_below"]), *others))


def _names(meta) -> list[str]:
    """Return the names of the parameters from which a number may be derived."""
    return [field.name for field in dataclasses.fields(meta["derivation"])]


def _interval(low, high, open_below) -> str:
    if high < math.inf:
        return f"{'more than ' if open_below else ''}{low:g} to {high:g}"
    if low == -math.inf:
        return "any"
    return f"more than {low:g}" if open_below else f"{low:g} or more"


def default(value) -> str:
    """Return a default in words."""
    if value is None or value == ():
        return "not set"
    if isinstance(value, bool):
        return str(value).lower()
    return value if isinstance(value, str) else f"{value:.6g}"


def _entry(field) -> str:
    meta, value = field.metadata, field.default
    number = not meta["choices"] and meta["kind"] is not bool and not dataclasses.is_dataclass(meta["kind"])
    kind = {tuple: "float or list of float"}.get(meta["kind"], meta["kind"].__name__)
    if meta["choices"]:
        kind = "{" + ", ".join(f'"{word}"' for word in meta["choices"]) + "}"
    kind += "".join(f' or "{word}"' for word in meta["words"])
    if meta["derivation"]:
        kind += f" or mapping of {', '.join(_names(meta))}"
    if meta["varies"]:
        kind += ", array over nodes or name of a field"
    words = default(value) if number else f'"{value}"' if meta["choices"] else str(value)
    given = "optional" if value is None else f"default {words}"
    meaning = meta["meaning"]
    if number:
        meaning += f" [{meta['unit']}]; {_interval(*meta['bounds'], meta['open_below'])}".removesuffix("; any")
    return f"{field.name} : {kind}, {given}\n" + textwrap.indent(textwrap.fill(f"{meaning}.", WIDTH - 4), "    ")
