"""Basis of an ensemble: keys, terrain and releases that its members share, read from files once."""

import dataclasses
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import xarray as xr

from ..core.errors import InputError
from ..core.version import __version__
from ..geo.lattice import Lattice
from ..scene.content import SceneContent
from ..scene.release_keys import ReleaseKeys
from ..scene.releases import ScheduledRelease, schedule_releases
from ..scene.setup import Setup
from ..scene.shapes import shapes_of
from ..scene.terrain import BED_FIELDS, build_terrain, lattice_of
from ..scene.zones import KINDS as ZONED
from .design import Varied
from .distributions import Choices
from .edits import AMOUNTS
from .names import FACTOR, NOISE


class Basis(NamedTuple):
    """Scene and ground of an ensemble.

    Attributes
    ----------
    content : SceneContent
        Keys of the scene.
    folder : Path
        Directory to which names of files are relative.
    terrain : xarray.Dataset
        Ground as `Scene.terrain`, wide enough for every member.
    releases : tuple of ScheduledRelease or None
        Releases by their place in the scene; None for a release at points.
    varied : tuple of Varied
        Varied values with their distributions.
    maps : tuple of str
        Names of the maps that are kept.
    seed : int
        Seed of the noise.
    digest : str
        Digest of the ensemble.
    version : str
        Version of the package that made the basis.
    """

    content: SceneContent
    folder: Path
    terrain: xr.Dataset
    releases: tuple[ScheduledRelease | None, ...]
    varied: tuple[Varied, ...]
    maps: tuple[str, ...]
    seed: int
    digest: str
    version: str = __version__

    @property
    def lattice(self) -> Lattice:
        """Nodes of all members."""
        return lattice_of(self.terrain)

    def with_setup(self, setup: Setup) -> "Basis":
        """Return the basis with another setup of the scene."""
        return self._replace(content=self.content._replace(setup=setup))

    @property
    def ground_varies(self) -> bool:
        """Whether members differ in elevation or in another field of the terrain."""
        return any(_changes_fields(one, self.content) or one.name.path[-1] == NOISE for one in self.varied)

    @property
    def releases_vary(self) -> bool:
        """Whether members differ in their releases, beyond factors on these."""
        paths = [one.name.path for one in self.varied]
        return self.ground_varies or any(path[0] == "release" and path[-1] != FACTOR for path in paths)


def shared_terrain(content: SceneContent, folder: Path, varied: Sequence[Varied], known: Any) -> xr.Dataset:
    """Return the ground that all members share.

    Parameters
    ----------
    content : SceneContent
    folder : Path
    varied : sequence of Varied
    known : callable
        Returns the ground of the scene itself.

    Returns
    -------
    xarray.Dataset
        That of the scene; where releases lie in different places, with a window that all of them can reach.
    """
    places = [one for one in varied if one.name.path[0] == "release" and isinstance(one.distribution, Choices)]
    places = [one for one in places if one.name.path[-1] in ("polygons", "points", "raster")]
    if not places:
        terrain: xr.Dataset = known()
        return terrain
    releases = list(content.release)
    for one in places:
        keys, choices = content.release[int(one.name.path[1])], one.distribution
        assert isinstance(choices, Choices)
        releases += [dataclasses.replace(keys, **{str(one.name.path[-1]): value}) for value in choices.values]
    return build_terrain(content._replace(release=tuple(releases)), folder)


def rebuilt_terrain(content: SceneContent, folder: Path, lattice: Lattice) -> xr.Dataset:
    """Return the ground of a member on the nodes of the ensemble.

    Parameters
    ----------
    content : SceneContent
        Keys of the member.
    folder : Path
    lattice : Lattice

    Returns
    -------
    xarray.Dataset

    Raises
    ------
    InputError
        If the DEM of the member has other nodes.
    """
    keys = dataclasses.replace(content.terrain, window=lattice.bounds)
    terrain = build_terrain(content._replace(terrain=keys), folder)
    found, shift = lattice_of(terrain), []
    for axis in (0, 1):
        step = (lattice.lower_left[axis] - found.lower_left[axis]) / lattice.spacing[axis]
        shift.append(round(step))
        differs = abs(step - round(step)) > 1e-3 or abs(found.spacing[axis] / lattice.spacing[axis] - 1.0) > 1e-6
        if differs or step < -0.5 or round(step) + lattice.shape[1 - axis] > found.shape[1 - axis]:
            raise InputError("the DEM of a member has other nodes than that of the scene; bring them to the same ones")
    columns, rows = (slice(first, first + lattice.shape[1 - axis]) for axis, first in enumerate(shift))
    return terrain.isel(y=rows, x=columns).assign_coords(y=lattice.y, x=lattice.x)


def scheduled(keys: Sequence[ReleaseKeys], terrain: xr.Dataset, folder: Path) -> tuple[ScheduledRelease | None, ...]:
    """Return the releases by their place in the scene, None for a release at points.

    Parameters
    ----------
    keys : sequence of ReleaseKeys
    terrain : xarray.Dataset
    folder : Path

    Returns
    -------
    tuple of ScheduledRelease or None
    """
    found = [schedule_releases([one], terrain, folder) for one in keys]
    return tuple(one[0] if one else None for one in found)


def check_amounts(content: SceneContent, folder: Path, varied: Sequence[Varied], lattice: Lattice) -> None:
    """Refuse the size of a release that varies in vain, because attributes of its polygons count.

    Parameters
    ----------
    content : SceneContent
    folder : Path
    varied : sequence of Varied
    lattice : Lattice

    Raises
    ------
    InputError
    """
    for one in varied:
        if one.name.path[0] != "release" or one.name.path[-1] not in AMOUNTS:
            continue
        k = int(one.name.path[1])
        for shape in shapes_of(content.release[k].polygons, "polygon", lattice, folder):
            given = {
                str(name).lower() for name, value in shape.attributes.items() if value == value and value is not None
            }
            if own := sorted(given & set(AMOUNTS)):
                raise InputError(
                    f"ensemble: {one.name.key} would vary in vain: {shape.label} has an attribute {own[0]}, which "
                    f"counts; vary release {k + 1}.{FACTOR} instead"
                )


def _changes_fields(one: Varied, content: SceneContent) -> bool:
    """Return whether a varied value changes fields of the terrain, noise aside."""
    kind, last = str(one.name.path[0]), str(one.name.path[-1])
    if kind == "terrain":
        return last != NOISE
    if kind in ZONED:
        fields = [found.name for found in content.varying if found.kind == kind]
        return last in fields or (len(one.name.path) == 1 and bool(fields))
    if kind == "material" and last in BED_FIELDS:
        return any(getattr(zone, last) is not None for zone in content.terrain.zones)
    return False
