"""Kind of machine and versions of libraries, for the record of a run."""

import os
import platform
import sys
from importlib import metadata
from typing import Any

LIBRARIES = ("numpy", "numba", "scipy", "xarray", "netCDF4", "landlab", "rasterio", "geopandas", "shapely")
"""Libraries on which numbers depend, by the names of their distributions."""


def environment() -> dict[str, Any]:
    """Return Python, kind of machine and versions of libraries as plain values; the machine is not named.

    Returns
    -------
    dict
        ``python``, ``system``, ``machine`` (kind of processor), ``processors`` (their number) and ``libraries``.

    Examples
    --------
    >>> sorted(environment())
    ['libraries', 'machine', 'processors', 'python', 'system']
    """
    return {
        "python": platform.python_version(), "system": sys.platform, "machine": platform.machine(),
        "processors": os.cpu_count() or 1, "libraries": dict(_versions()),
    }  # fmt: skip


def _versions():
    for name in LIBRARIES:
        try:
            yield name, metadata.version(name)
        except metadata.PackageNotFoundError:  # of the extra geo
            continue
