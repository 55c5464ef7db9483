"""Parameters of a run for its report: each with unit, value, whether it was given, and the source of its law."""

import json
from collections.abc import Iterator, Mapping
from typing import Any

import xarray as xr

from ..core.values import flat_keys_of, from_mapping, keys_of
from ..physics.registry import LAWS
from ..plots.style import unit_text
from ..run.record import RunRecord
from ..scene.keys import OutputKeys, ReleaseKeys, TerrainKeys
from ..scene.law_entries import Entry, law_entries, other_entries
from ..scene.terrain_keys import Edit, Zone
from .blocks import Block, Sentences, Table
from .numbers import SPACE, plain

HEAD = ("parameter", "value", "from", "meaning")
UNKNOWN = "not known"
DEFAULTS = (
    "A default was chosen for no particular place: the defaults are the values of one event, Tsing "
    "Shan in Hong Kong (Pastor et al., 2022), and no recommendation."
)
HIDDEN = {"directory", "checkpoint_interval", "series_interval", "variables", "format"}
"""Keys of the output that change no number of a report."""


def law_blocks(record: RunRecord, maps: xr.Dataset | None) -> list[Block]:
    """Return tables of the parameters of laws, material, numerics and inflow.

    Parameters
    ----------
    record : RunRecord
    maps : xarray.Dataset or None
        Maps of the end, which hold the setup that ran, with the choices of a plan.

    Returns
    -------
    list of Block
    """
    scene = record.scene
    ran = _setup_of(maps) or scene
    entries = {entry.title: entry for kind in LAWS for entry in law_entries(kind)}
    entries |= {entry.title: entry for entry in other_entries()}
    found: list[Block] = [Sentences([DEFAULTS])]
    for kind in LAWS:
        values = _mapping(ran.get(kind))
        name = str(values.pop("law", UNKNOWN))
        entry = entries.get(f"{kind}: {name}")
        found += _block(f"{kind}: {name}", entry, values, _mapping(scene.get(kind)), kind, record)
    for kind in ("material", "numerics"):
        found += _block(kind, entries[kind], _mapping(ran.get(kind)), _mapping(scene.get(kind)), kind, record)
    inflow = ran.get("inflow") or []
    for number, values in enumerate(inflow if isinstance(inflow, list) else [], 1):
        found += _block(f"inflow {number}", entries["inflow"], _mapping(values), {}, f"inflow {number}", record)
    return found


def scene_blocks(record: RunRecord) -> list[Block]:
    """Return tables of the keys of terrain, releases and output that are set."""
    terrain, output = _mapping(record.scene.get("terrain")), _mapping(record.scene.get("output"))
    parts: list[tuple[str, type, Mapping[str, Any]]] = [("terrain", TerrainKeys, terrain)]
    for key, cls in (("edits", Edit), ("zones", Zone)):
        parts += [(f"terrain.{key} {n}", cls, _mapping(one)) for n, one in enumerate(terrain.get(key) or [], 1)]
    releases = record.scene.get("release") or []
    parts += [(f"release {n}", ReleaseKeys, _mapping(one)) for n, one in enumerate(releases, 1)]
    parts.append(("output", OutputKeys, {key: value for key, value in output.items() if key not in HIDDEN}))
    return [table for path, cls, values in parts if (table := _scene_table(path, cls, values, record))]


def _scene_table(path: str, cls: type, values: Mapping[str, Any], record: RunRecord) -> Table | None:
    declared = keys_of(cls)
    rows = []
    for key, value in values.items():
        if value in ([], {}, None) or key in ("edits", "zones"):
            continue
        meta = declared[key].metadata if key in declared else {}
        given = _origin(record, f"{path}.{key}", value, value, declared.get(key))
        rows.append((key, _value_words(value, meta), given, str(meta.get("meaning", ""))))
    caption = path.replace("terrain.", "terrain: ")
    return Table(caption=caption, head=HEAD, rows=rows) if rows else None


def _block(
    title: str, entry: Entry | None, ran: Mapping[str, Any], asked: Mapping[str, Any], path: str, record: RunRecord
) -> Iterator[Block]:
    """Yield the formula and source of a law, and the table of its parameters.

    `ran` are the values of the run, `asked` the values of the scene; `path` are the keys above.
    """
    declared = flat_keys_of(entry.cls) if entry else {}
    note = ""
    if entry is not None:
        source = f" Source: {entry.source}" if entry.source else ""
        note = f"{': '.join(filter(None, (entry.formula, entry.summary)))}{source}".replace("``", "")
    rows = []
    asked = dict(_flat(asked, declared))
    for name, value in _flat(ran, declared):
        field = declared.get(name)
        meta = field.metadata if field is not None else {}
        origin = _origin(record, f"{path}.{name}", value, asked.get(name, value), field)
        rows.append((name, _value_words(value, meta), origin, str(meta.get("meaning", ""))))
    if rows:
        yield Table(caption=title, head=HEAD, rows=rows, note=note)
    else:
        yield Sentences([f"{title}: {note or 'no parameters'}"])


def _origin(record: RunRecord, key: str, value: Any, asked: Any, field: Any) -> str:
    """Return whether a value was given, is the default, or was chosen by the plan of a run."""
    if plain(value) != plain(asked):
        return "the plan"
    if record.given is None:
        same = field is not None and plain(value) == plain(field.default)
        return "default" if same else UNKNOWN
    prefixes = (key, f"{key} ", f"{key}.")
    given = any(one == key or one.startswith(prefixes[1:]) for one in record.given)
    return "given" if given else "default"


def _value_words(value: Any, meta: Mapping[str, Any]) -> str:
    """Return a value with its unit, if the value is a number or a list of numbers."""
    if meta.get("derivation") and isinstance(value, Mapping):
        return _derivation_words(value, meta)
    unit = str(meta.get("unit", "-"))
    words = isinstance(value, str | bool | dict) or (isinstance(value, list) and not isinstance(value[0], float | int))
    return plain(value) if words or unit == "-" else f"{plain(value)}{SPACE}{unit_text(unit)}".replace(f"{SPACE}°", "°")


def _derivation_words(values: Mapping[str, Any], meta: Mapping[str, Any]) -> str:
    """Return a number with the parameters that it was derived from, all with their units."""
    declared = keys_of(meta["derivation"])
    source = ", ".join(f"{key} {_value_words(value, declared[key].metadata)}" for key, value in values.items())
    return f"{_value_words(from_mapping(meta['derivation'], values).value, meta)}, from {source}"


def _flat(values: Mapping[str, Any], declared: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """Yield names and values, with a dot in the names of values inside a mapping that stands for no number."""
    for name, value in values.items():
        derived = name in declared and declared[name].metadata["derivation"]
        if isinstance(value, Mapping) and not derived:
            yield from ((f"{name}.{inner}", one) for inner, one in value.items())
        else:
            yield name, value


def _mapping(value: Any) -> dict[str, Any]:
    return dict(value) if isinstance(value, Mapping) else {}


def _setup_of(maps: xr.Dataset | None) -> dict[str, Any] | None:
    """Return the setup in the attributes of maps, with parameters at nodes as the names of their maps."""
    if maps is None:
        return None
    try:
        return _mapping(json.loads(maps.attrs["setup"]))
    except (KeyError, ValueError, TypeError):
        return None
