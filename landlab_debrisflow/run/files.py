"""Names of the files in a directory of results, and digests of the files that a scene reads."""

import hashlib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

RECORD, SCENE, MAPS = "run.json", "scene.yaml", "maps.nc"
CHECKPOINT = "checkpoint.nc"
SERIES = "series"
SERIES_SUFFIX = {"netcdf": ".nc", "zarr": ".zarr"}
LOCK = ".lock"

UNFINISHED = ".unfinished"
"""Directory in that of the results where these are written before they appear."""

SUFFIXES = (".nc", ".zarr", ".tif", ".qml", ".yaml", ".csv", ".gpkg")
"""Endings of the files that runs write."""

BESIDE = (".shx", ".dbf", ".prj", ".cpg", ".aux.xml")
"""Endings of files that belong to one of another name."""


def is_result(name: Any) -> bool:
    """Return whether runs write files of a name into their directory; ``*`` may stand in the directory of the series.

    Examples
    --------
    >>> is_result("maps.nc"), is_result("series/maps_*.nc"), is_result("*.nc"), is_result("../maps.nc")
    (True, True, False, False)
    """
    if not isinstance(name, str) or "**" in name or any(character in name for character in "?[\\\0"):
        return False
    folder, _, last = name.rpartition("/")
    return folder in ("", SERIES) and last.endswith(SUFFIXES) and (folder == SERIES or "*" not in last)


def input_digests(mapping: Mapping[str, Any], folder: Path) -> dict[str, str]:
    """Return SHA-256 of every file that a scene names, by its name as it stands there, and of files that belong to it.

    Parameters
    ----------
    mapping : mapping
        Scene as plain values.
    folder : Path
        Directory to which names are relative.

    Returns
    -------
    dict of str to str
    """
    digests = {}
    for word in _words(mapping):
        name = next((n for n in (word, word.rpartition(":")[0]) if n and _is_file(folder / n)), None)
        if name is None:
            continue
        stem = (folder / name).with_suffix("")
        for path in (folder / name, *(stem.with_name(stem.name + end) for end in BESIDE)):
            if path.is_file() and (path == folder / name or name.endswith((".shp", ".asc"))):
                digests[f"{Path(name).parent / path.name}"] = _digest(path)
    return digests


def _words(values: Any) -> Iterator[str]:
    if isinstance(values, str):
        yield values
    elif isinstance(values, Mapping):
        for value in values.values():
            yield from _words(value)
    elif isinstance(values, list | tuple) and not (values and isinstance(values[0], int | float)):
        for value in values:
            yield from _words(value)


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):  # a word too long for a name, or with a null byte
        return False


def _digest(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
