"""Releases of a scene, from their keys and files to depths over nodes."""

from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

import numpy as np
import xarray as xr

from ..geo.cover import covered_fraction
from ..geo.shapes import read_shapes
from .keys import ReleaseKeys
from .terrain import lattice_of


class ScheduledRelease(NamedTuple):
    """Release at some time.

    Attributes
    ----------
    time : float
        Elapsed time at which the ground fails [s].
    depth : ndarray, shape (rows, columns)
        Vertical thickness that fails [m].
    """

    time: float
    depth: np.ndarray


def schedule_releases(releases: Iterable[ReleaseKeys], terrain: xr.Dataset, folder: Path) -> list[ScheduledRelease]:
    """Return the releases of a scene in the order of their times.

    Parameters
    ----------
    releases : iterable of ReleaseKeys
    terrain : xarray.Dataset
        As `build_terrain` returns it.
    folder : Path
        Directory to which names of files are relative.

    Returns
    -------
    list of ScheduledRelease
    """
    lattice, scheduled = lattice_of(terrain), []
    for keys in releases:
        depth = np.zeros(lattice.shape)
        for shape in read_shapes(folder / str(keys.polygons), lattice.crs):
            depth += float(shape.attributes.get("depth", keys.depth)) * covered_fraction(shape.geometry, lattice)
        scheduled.append(ScheduledRelease(keys.time, depth))
    return sorted(scheduled, key=lambda release: release.time)
