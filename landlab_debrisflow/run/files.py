"""Names of the files in a directory of results."""

from typing import Any

RECORD, SCENE, MAPS, REPORT = "run.json", "scene.yaml", "maps.nc", "report.txt"
PAGE = "report.html"
CHECKPOINT = "checkpoint.nc"
SERIES = "series"
SERIES_SUFFIX = {"netcdf": ".nc", "zarr": ".zarr"}
LOCK = ".lock"

UNFINISHED = ".unfinished"
"""Directory in that of the results where these are written before they appear."""

PICTURES = "pictures"
"""Directory in that of the results for pictures of them."""

PICTURE_SUFFIXES = (".png", ".pdf", ".svg", ".gif", ".mp4")
"""Endings of pictures."""

SUFFIXES = (".nc", ".zarr", ".tif", ".qml", ".yaml", ".csv", ".gpkg")
"""Endings of the files that runs write."""


def is_result(name: Any) -> bool:
    """Return whether runs and pictures of them are written under a name; ``*`` may stand in that of a series of maps.

    Examples
    --------
    >>> is_result("maps.nc"), is_result("series/maps_*.nc"), is_result("*.nc"), is_result("../maps.nc")
    (True, True, False, False)
    """
    if not isinstance(name, str) or "**" in name or any(character in name for character in "?[\\\0"):
        return False
    folder, _, last = name.rpartition("/")
    in_series = folder == SERIES
    if folder == PICTURES:
        return "*" not in last and last.endswith(PICTURE_SUFFIXES)
    return name == REPORT or ((in_series or (not folder and "*" not in last)) and last.endswith(SUFFIXES))


STORE = "members.zarr"
"""Store of the members of an ensemble, in the directory of its results."""
