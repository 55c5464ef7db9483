"""Store of an ensemble: header, design and a group for each batch, written by one process alone."""

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from ..core.errors import InputError, OutputError
from ..core.version import __version__
from ..geo.lattice import Lattice
from .batch import BatchResult
from .design import member_values
from .result import MemberResult

FORMAT, KIND = 1, "landlab_debrisflow ensemble"
BATCHES, DESIGN = "batches", "design"
CHUNK = 2**20
"""Most values of a map in one chunk."""


class Header(NamedTuple):
    """Identity of an ensemble: digest, scene, sampling and lattice.

    Attributes
    ----------
    digest : str
        Digest of scene, values of all members, kept maps and length of batches.
    scene : dict
        Scene as plain values.
    sampling : str
    seed : int
    batch : int
        Members in a batch.
    maps : tuple of str
        Names of the kept maps.
    lattice : Lattice
    plan : dict or None
        Plan of the ensemble as plain values; None: particles, column and steps are those of the scene.
    version : str
        Version of the package.
    """

    digest: str
    scene: dict[str, Any]
    sampling: str
    seed: int
    batch: int
    maps: tuple[str, ...]
    lattice: Lattice
    plan: dict[str, Any] | None = None
    version: str = __version__


class Store:
    """Store of an ensemble, in a directory or in memory.

    Parameters
    ----------
    group : zarr.Group
        Root of the store.
    place : str
        Name of the store for messages.

    Attributes
    ----------
    header : Header
    design : xarray.Dataset
    """

    def __init__(self, group: Any, place: str):
        self._group, self._place = group, place
        attributes = dict(group.attrs)
        if attributes.get("kind") != KIND or "header" not in attributes:
            raise InputError(f"{place} holds no ensemble; give another store, or remove it")
        self.header = _header(attributes, place)
        self.design = _read_design(group[DESIGN])

    @classmethod
    def create(cls, path: Path | None, header: Header, design: xr.Dataset) -> "Store":
        """Make a store for an ensemble.

        Parameters
        ----------
        path : Path or None
            Directory that does not exist; None: in memory.
        header : Header
        design : xarray.Dataset

        Returns
        -------
        Store

        Raises
        ------
        OutputError
            If the directory cannot be written.
        """
        if path is None:
            return cls(_new_group(_zarr().storage.MemoryStore(), header, design), "the ensemble in memory")
        # a process that is killed meanwhile leaves no half of a store
        unfinished = path.with_name(f".{path.name}.unfinished")
        try:
            _new_group(unfinished, header, design)
            os.replace(unfinished, path)
        except OSError as error:
            raise OutputError(f"cannot write the store {path}: {error.strerror or error}; choose another") from error
        return cls.open(path, write=True)

    @classmethod
    def open(cls, path: str | Path, *, write: bool = False) -> "Store":
        """Open the store of an ensemble.

        Parameters
        ----------
        path : str or Path
        write : bool
            Whether batches are to be written.

        Returns
        -------
        Store

        Raises
        ------
        InputError
            If there is none, or it is of another version of this package.
        """
        zarr = _zarr()
        if not Path(path).exists():
            raise InputError(f"{path} does not exist; give the store of an ensemble, as scene_ensemble/members.zarr")
        try:
            group = zarr.open_group(path, mode="r+" if write else "r")
        except (OSError, KeyError, ValueError) as error:
            raise InputError(f"{path} holds no ensemble ({type(error).__name__}: {error})") from error
        return cls(group, str(path))

    @property
    def batch_count(self) -> int:
        """Number of batches of the whole ensemble."""
        return -(-self.design.sizes["member"] // self.header.batch)

    def members_of(self, batch: int) -> range:
        """Return the numbers of the members of a batch."""
        first = batch * self.header.batch
        return range(first, min(first + self.header.batch, self.design.sizes["member"]))

    def write(self, found: BatchResult) -> None:
        """Write a batch; its last attribute makes it complete.

        Parameters
        ----------
        found : BatchResult

        Raises
        ------
        OutputError
            If it cannot be written.
        """
        names = list(found.attributes)
        measures = np.array([[one.measures.get(name, np.nan) for name in names] for one in found.results])
        windows = [[one.rows.start, one.rows.stop, one.columns.start, one.columns.stop] for one in found.results]
        flat = [_flat(one, self.header.maps) for one in found.results]
        maps = np.concatenate(flat, axis=1)
        try:
            group = self._group.create_group(f"{BATCHES}/{found.batch:06d}", overwrite=True)
            _put(group, "windows", np.array(windows, np.int32))
            if measures.size:
                _put(group, "measures", measures)
            if maps.size:
                _put(group, "maps", maps, chunks=(len(maps), min(CHUNK, maps.shape[1])))
            group.attrs.update({
                "measures": found.attributes, "errors": [one.error for one in found.results],
                "seconds": found.seconds, "complete": True,
            })  # fmt: skip
        except OSError as error:
            raise OutputError(f"cannot write {self._place}: {error.strerror or error}; make room for it") from error

    def complete_batches(self) -> list[int]:
        """Return the numbers of the batches that are there, in their order."""
        return [batch for batch in range(self.batch_count) if self.attributes(batch)]

    def attributes(self, batch: int) -> dict[str, Any]:
        """Return the attributes of a batch: measures, errors, seconds; empty if it is not complete."""
        try:
            found = dict(self._group[f"{BATCHES}/{batch:06d}"].attrs)
        except (KeyError, ValueError, OSError):  # not there, or half written
            return {}
        return found if found.get("complete") else {}

    def measures(self, batch: int) -> np.ndarray:
        """Return the measures of a batch, shape (members, measures), in the order of its attribute."""
        group, attributes = self._group[f"{BATCHES}/{batch:06d}"], self.attributes(batch)
        shape = len(self.members_of(batch)), len(attributes["measures"])
        return group["measures"][:] if "measures" in group else np.full(shape, np.nan)

    def read(self, batch: int, maps: bool = True) -> Iterator[MemberResult]:
        """Yield the results of the members of a batch.

        Parameters
        ----------
        batch : int
        maps : bool
            Whether maps are read.

        Yields
        ------
        MemberResult
        """
        group, attributes = self._group[f"{BATCHES}/{batch:06d}"], self.attributes(batch)
        windows, names = group["windows"][:], list(attributes["measures"])
        numbers, end = self.measures(batch), 0
        flat = group["maps"][:] if maps and "maps" in group else None
        for k, member in enumerate(self.members_of(batch)):
            top, bottom, left, right = (int(value) for value in windows[k])
            shape, error = (bottom - top, right - left), attributes["errors"][k]
            begin, end = end, end + (0 if error else shape[0] * shape[1])
            kept = {}
            if maps and not error:
                values = np.zeros((len(self.header.maps), 0), np.float32) if flat is None else flat[:, begin:end]
                kept = {name: values[j].reshape(shape) for j, name in enumerate(self.header.maps)}
            measured = {} if error else dict(zip(names, numbers[k].tolist(), strict=True))
            rows, columns = slice(top, bottom), slice(left, right)
            yield MemberResult(member, member_values(self.design, member), measured, rows, columns, kept, error)


def _new_group(place: Any, header: Header, design: xr.Dataset) -> Any:
    """Return a new group for an ensemble, at a path or in a store of zarr."""
    group = _zarr().create_group(place, overwrite=True)
    columns = group.create_group(DESIGN, attributes={"columns": list(design.data_vars)})
    for name, values in design.data_vars.items():
        _put(columns, str(name), values.values, attributes=dict(values.attrs))
    group.create_group(BATCHES)
    plain = header._asdict() | {"lattice": header.lattice._asdict()}
    group.attrs.update({"kind": KIND, "format": FORMAT, "version": header.version, "header": plain})
    return group


def _put(group: Any, name: str, values: np.ndarray, **others: Any) -> None:
    """Write values as a new array of a group."""
    group.create_array(name, shape=values.shape, dtype=values.dtype, **others)[...] = values


def _flat(one: MemberResult, names: tuple[str, ...]) -> np.ndarray:
    if one.error:
        return np.zeros((len(names), 0), np.float32)
    return np.stack([one.maps[name].ravel() for name in names])


def _header(attributes: Mapping[str, Any], place: str) -> Header:
    if attributes.get("format") != FORMAT or attributes.get("version") != __version__:
        raise InputError(
            f"{place} is of landlab_debrisflow {attributes.get('version')} and format {attributes.get('format')}, this "
            f"is {__version__} and format {FORMAT}; read it with that version, or run the ensemble in another store"
        )
    plain = dict(attributes["header"])
    lattice = plain.pop("lattice")
    place_of = Lattice(tuple(lattice["shape"]), tuple(lattice["spacing"]), tuple(lattice["lower_left"]), lattice["crs"])
    return Header(**plain | {"maps": tuple(plain["maps"]), "lattice": place_of})


def _read_design(group: Any) -> xr.Dataset:
    variables = {name: ("member", group[name][:], dict(group[name].attrs)) for name in group.attrs["columns"]}
    return xr.Dataset(variables, {"member": np.arange(variables["replicate"][1].size)})


def _zarr() -> Any:
    try:
        import zarr
    except ImportError as error:
        raise InputError('ensembles need zarr; pip install "landlab_debrisflow[ensemble]"') from error
    return zarr
