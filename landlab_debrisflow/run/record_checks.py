"""Check of the record of a run: a file as others are, which may hold anything."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from ..core.errors import InputError

NUMBER, TEXT, TEXTS = float | int, str, list | None

KINDS: dict[str, Any] = {
    "scene": dict, "inputs": dict, "digest": TEXT, "files": list, "state": TEXT, "budget": dict, "elapsed_time": NUMBER,
    "at_rest": bool, "scene_file": TEXT | None, "version": TEXT, "started": TEXT, "plan": dict | None,
    "environment": dict | None, "statement": dict | None, "given": TEXTS, "notes": TEXTS, "doubts": TEXTS,
    "warnings": TEXTS,
}  # fmt: skip
"""Kinds of the values that a record must have, if only as None."""

KINDS_INSIDE: dict[str, Any] = {
    "reason": TEXT, "steps": NUMBER, "scene.terrain": dict, "scene.terrain.edits": list,
    "scene.terrain.zones": list, "scene.release": list, "scene.output": dict, "environment.libraries": dict,
    "statement.errors": dict, "statement.raster_errors": dict,
}  # fmt: skip
"""Kinds of further values, where they are there."""

KINDS_OF_ITEMS: dict[str, Any] = {
    "budget": NUMBER, "given": TEXT, "notes": TEXT, "doubts": TEXT, "warnings": TEXT, "scene.release": dict,
    "scene.terrain.edits": dict, "scene.terrain.zones": dict, "statement.errors": NUMBER | None,
    "statement.raster_errors": NUMBER | None,
}  # fmt: skip
"""Kinds of the values in lists and mappings."""


def check_record(values: Mapping[str, Any], path: Path) -> None:
    """Refuse a record whose values are of other kinds than a run writes.

    Parameters
    ----------
    values : mapping
        Of the file.
    path : Path
        Its place, for the message.

    Raises
    ------
    InputError
    """
    for name, value in _unfit(values):
        raise InputError(f"{path} is no whole record of a run: {name} is {value!r:.60}")


def _unfit(values: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """Yield names and values that are of another kind."""
    for name, kind in KINDS.items():
        if not isinstance(values.get(name), kind):
            yield name, values.get(name)
    for name, kind in KINDS_INSIDE.items():
        value = _at(values, name)
        if value is not None and not isinstance(value, kind):
            yield name, value
    for name, kind in KINDS_OF_ITEMS.items():
        found = _at(values, name)
        items = found.values() if isinstance(found, Mapping) else found or ()
        yield from ((name, item) for item in items if not isinstance(item, kind))


def _at(values: Any, name: str) -> Any:
    """Return the value below some keys, joined by points; None if there is none."""
    for key in name.split("."):
        values = values.get(key) if isinstance(values, Mapping) else None
    return values
