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

SUFFIXES = (".nc", ".zarr", ".tif", ".qml", ".yaml", ".csv", ".gpkg")
"""Endings of the files that runs write."""


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
    in_series = folder == SERIES
    return name == REPORT or ((in_series or (not folder and "*" not in last)) and last.endswith(SUFFIXES))
