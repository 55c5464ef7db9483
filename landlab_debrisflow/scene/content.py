"""Content of a scene file: its mapping as checked values, and back."""

import dataclasses
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from ..core.errors import ParameterError
from ..core.hints import did_you_mean
from ..core.values import from_mapping, keys_of
from .keys import EnsembleKeys, OutputKeys, ReleaseKeys, TerrainKeys
from .location import located
from .read_yaml import YamlFile
from .setup import Setup
from .zones import VaryingParameter, varying_parameters, with_fields

SETUP_KEYS = tuple(keys_of(Setup))
SCENE_KEYS = ("terrain", "release", "output", *SETUP_KEYS, "ensemble")

BESIDE = (".shx", ".dbf", ".prj", ".cpg", ".aux.xml")
"""Endings of files that belong to a Shapefile or an ESRI ASCII grid of the same name."""


class SceneContent(NamedTuple):
    """Checked values of a scene.

    Attributes
    ----------
    terrain : TerrainKeys
        Ground.
    release : tuple of ReleaseKeys
        Releases, in the order of the scene.
    output : OutputKeys
        Duration, files and places of output.
    setup : Setup
        Laws, material, numerics and inflow as they are written, without the inflow at points.
    ensemble : EnsembleKeys or None
        What varies in many runs of the scene; None: nothing is said about it.
    """

    terrain: TerrainKeys
    release: tuple[ReleaseKeys, ...]
    output: OutputKeys
    setup: Setup
    ensemble: EnsembleKeys | None = None

    @property
    def varying(self) -> tuple[VaryingParameter, ...]:
        """Parameters of laws that vary in space, by zones or rasters."""
        return varying_parameters(self.setup, self.terrain.zones)

    @property
    def setup_on_grid(self) -> Setup:
        """Setup whose laws read varying parameters from fields of the grid."""
        return with_fields(self.setup, self.varying)


def read_content(mapping: Mapping[str, Any], file: YamlFile | None = None) -> SceneContent:
    """Check the mapping of a scene.

    Parameters
    ----------
    mapping : mapping
        Plain values by the keys of a scene.
    file : YamlFile, optional
        File from which the values were read, to name lines.

    Returns
    -------
    SceneContent

    Raises
    ------
    ParameterError
        If a key is unknown or a value is refused.
    """
    if not isinstance(mapping, Mapping):
        raise ParameterError(f"scene: a mapping with the keys terrain and release is needed, got {mapping!r:.60}")
    for key in mapping:
        if key not in SCENE_KEYS:
            with located(file):
                hint = did_you_mean(key, SCENE_KEYS) or _owner(key)
                raise ParameterError(f"scene: unknown key {key!r}{hint}; allowed: {', '.join(SCENE_KEYS)}")
    terrain = _declared(TerrainKeys, mapping.get("terrain"), file, "terrain")
    release = tuple(
        _declared(ReleaseKeys, one, file, *path) for path, one in _entries("release", mapping.get("release"))
    )
    output = _declared(OutputKeys, mapping.get("output"), file, "output")
    given = {key: mapping[key] for key in SETUP_KEYS if mapping.get(key) is not None}
    for key, value in given.items():
        for path, one in _entries(key, value) if key == "inflow" else [((key,), value)]:
            with located(file, *path):
                Setup(**{key: one})
    setup = Setup(**given)
    with located(file, "terrain"):
        varying_parameters(setup, terrain.zones)
    given_ensemble = mapping.get("ensemble")
    ensemble = None if given_ensemble is None else _declared(EnsembleKeys, given_ensemble, file, "ensemble")
    return SceneContent(terrain, release, output, setup, ensemble)


def to_mapping(content: SceneContent) -> dict[str, Any]:
    """Return a scene and its defaults as plain values, without unset keys; `read_content` reads them back.

    Parameters
    ----------
    content : SceneContent

    Returns
    -------
    dict
    """
    release = [_plain_keys(one) for one in content.release]
    ensemble = {} if content.ensemble is None else {"ensemble": _plain_keys(content.ensemble)}
    return {
        "terrain": _plain_keys(content.terrain), "release": release, "output": _plain_keys(content.output),
        **content.setup.to_mapping(), **ensemble,
    }  # fmt: skip


def given_keys(mapping: Mapping[str, Any]) -> Iterator[str]:
    """Yield the keys of a scene whose values were given, with the keys above them in front and a number in lists.

    Parameters
    ----------
    mapping : mapping
        Plain values by the keys of a scene; a law may be an object, all of whose parameters were given.

    Examples
    --------
    >>> scene = {"friction": "voellmy", "release": [{"depth": 1.0}, {"volume": 9.0}], "inflow": {"times": [0.0]}}
    >>> list(given_keys(scene))
    ['friction', 'release 1.depth', 'release 2.volume', 'inflow 1.times']
    """
    for key, value in leaves(_with_lists(mapping)):
        if dataclasses.is_dataclass(value):
            yield from (f"{key}.{field.name}" for field in dataclasses.fields(value))
        elif value is not None:
            yield key


LISTS = ("release", "inflow", "edits", "zones")
"""Keys that take one mapping or a list of them."""


def _with_lists(mapping: Mapping[str, Any]) -> dict[str, Any]:
    """Return a mapping in which one mapping that stands for a list of them is a list of one."""
    inner = {key: _with_lists(value) if isinstance(value, Mapping) else value for key, value in mapping.items()}
    return {key: [value] if key in LISTS and isinstance(value, Mapping) else value for key, value in inner.items()}


def leaves(values: Any, key: str = "") -> Iterator[tuple[str, Any]]:
    """Yield every key of plain values, with the keys above it in front, and its value."""
    if isinstance(values, Mapping):
        for name, value in values.items():
            yield from leaves(value, f"{key}.{name}" if key else str(name))
    elif isinstance(values, list | tuple) and any(isinstance(value, Mapping) for value in values):
        for number, value in enumerate(values, 1):
            yield from leaves(value, f"{key} {number}")
    else:
        yield key, values


def named_files(mapping: Mapping[str, Any], folder: Path) -> dict[str, Path]:
    """Return the existing files that the values of a scene name, in their order, with files that belong to them.

    Parameters
    ----------
    mapping : mapping
        Scene, or a part of it, as plain values.
    folder : Path
        Directory to which names of files are relative.

    Returns
    -------
    dict of str to Path
        Files by their names as they stand in the scene.
    """
    files: dict[str, Path] = {}
    for text in _texts(mapping):
        name = next((n for n in (text, text.rpartition(":")[0]) if n and _is_file(folder / n)), None)
        if name is None:
            continue
        named = folder / name
        beside = BESIDE if named.suffix.lower() in (".shp", ".asc") else ()
        found = (named, *filter(_is_file, (named.with_suffix(end) for end in beside)))
        files |= {f"{Path(name).parent / path.name}": path for path in found}
    return files


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):  # not a name: too long, or with a null character
        return False


def _texts(value):
    if isinstance(value, str):
        yield value
    elif isinstance(value, Mapping):
        for inner in value.values():
            yield from _texts(inner)
    elif isinstance(value, list | tuple) and not (value and isinstance(value[0], int | float)):  # long rows of numbers
        for inner in value:
            yield from _texts(inner)


def _entries(key: str, value: Any) -> list[tuple[tuple, Any]]:
    """Return path and value of the entries of a key that takes one mapping or a list of them."""
    if isinstance(value, list | tuple):
        return [((key, k), one) for k, one in enumerate(value)]
    return [] if value is None else [((key,), value)]


def _declared(cls: type, value: Any, file: YamlFile | None, *path: str | int) -> Any:
    with located(file, *path):
        if not isinstance(value, Mapping) and value is not None:
            keys = ", ".join(list(keys_of(cls))[:3])
            raise ParameterError(f"a mapping is needed, with keys such as {keys}; got {value!r:.60}")
        for key in value or ():
            if not isinstance(key, str):
                raise ParameterError(f"keys must be words, got {key!r:.60}")
        return from_mapping(cls, value or {})


def _owner(key: Any) -> str:
    """Return a hint that a key belongs below another one, or an empty text."""
    owners = [cls.keyword for cls in (TerrainKeys, ReleaseKeys, OutputKeys, EnsembleKeys) if key in keys_of(cls)]
    return f" (it is one of {' and '.join(owners)}: indent it below)" if owners else ""


def _plain_keys(keys: Any) -> dict[str, Any]:
    found = {key: (getattr(keys, field.name), field.metadata) for key, field in keys_of(type(keys)).items()}
    return {key: _plain(value, meta) for key, (value, meta) in found.items() if value is not None}


def _plain(value: Any, meta: Mapping[str, Any]) -> Any:
    if not isinstance(value, tuple):
        return _plain_keys(value) if hasattr(value, "__dataclass_fields__") else value
    if meta["items"] is not None:
        return [_plain_keys(one) for one in value]
    return {name: _lists(one) for name, one in value} if meta["named"] else _lists(value)


def _lists(value: Any) -> Any:
    return [_lists(one) for one in value] if isinstance(value, tuple) else value
