"""Tables of all keys of a scene, from their declarations, for the documentation."""

from collections.abc import Mapping
from typing import Any

from ..core.docstrings import allowed, default
from ..core.values import keys_of
from .keys import EnsembleKeys, OutputKeys, ReleaseKeys, TerrainKeys
from .terrain_keys import Edit, Zone

TABLES = {
    "terrain": TerrainKeys, "terrain: zones": Zone, "terrain: edits": Edit, "release": ReleaseKeys,
    "output": OutputKeys, "ensemble": EnsembleKeys,
}  # fmt: skip
BEGIN, END = "<!-- keys, written from the declarations: begin -->", "<!-- keys: end -->"
FORMS = {"points": "points", "lines": "lines", "polygons": "polygons", "table": "pairs"}


def with_tables(page: str) -> str:
    """Return a page whose part between the two marks holds the tables of keys as they are declared now.

    Parameters
    ----------
    page : str
        Markdown with `BEGIN` and `END` on lines of their own.

    Returns
    -------
    str
    """
    before, _, rest = page.partition(BEGIN)
    _, _, after = rest.partition(END)
    return f"{before}{BEGIN}\n\n{key_tables()}\n{END}{after}"


def key_tables() -> str:
    """Return a table in Markdown for each part of a scene that is no setup."""
    return "\n".join(f"### {title}\n\n{_table(cls)}\n" for title, cls in TABLES.items())


def _table(cls: type) -> str:
    rows = [("key", "unit", "default", "allowed", "meaning"), ("---",) * 5]
    for key, field in keys_of(cls).items():
        meta = field.metadata
        rows.append((f"`{key}`", meta["unit"], _default(field.default), _allowed(meta), meta["meaning"]))
    return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in rows)


def _default(value: Any) -> str:
    return ", ".join(value) if isinstance(value, tuple) and value else default(value)


def _allowed(meta: Mapping[str, Any]) -> str:
    if meta["items"] is not None:
        return "mapping, or list of them"
    if meta["kind"] is dict:
        return "mapping"
    forms = ["file"] if meta["file"] else []
    if meta["coordinates"]:
        forms.append(
            f"mapping of names to {FORMS[meta['coordinates']]}" if meta["named"] else FORMS[meta["coordinates"]]
        )
    elif meta["choices"] and meta["length"] is not None:
        forms += [*meta["choices"], f"list of {meta['length']} numbers"]
    elif meta["length"] is not None:
        forms.append(f"list of {meta['length']} numbers")
    elif meta["choices"] or meta["kind"] is not str:
        forms.append(allowed(meta))
    elif not forms:
        forms.append("text")
    return " or ".join(forms)
