"""Results of an ensemble, read from its store one batch at a time."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ..geo.lattice import Lattice
from .plan import EnsemblePlan
from .result import MemberResult
from .store import Store


class EnsembleResults:
    """Results of the members of an ensemble, finished or not.

    Parameters
    ----------
    store : Store
        Store that holds the results.
    """

    def __init__(self, store: Store):
        self._store = store

    @classmethod
    def open(cls, path: str | Path) -> "EnsembleResults":
        """Open the results in a store.

        Parameters
        ----------
        path : str or Path
            Such as ``scene_ensemble/members.zarr``.

        Returns
        -------
        EnsembleResults

        Raises
        ------
        InputError
            If there is no store of an ensemble, or one of another version of the package.
        """
        return cls(Store.open(path))

    def __repr__(self):
        return f"<EnsembleResults with {self.done.sum()} of {self.done.size} members>"

    @property
    def design(self) -> xr.Dataset:
        """Values of all members over ``member``: a variable with the attribute ``key`` for each dotted name."""
        return self._store.design

    @property
    def lattice(self) -> Lattice:
        """Nodes of the maps."""
        return self._store.header.lattice

    @property
    def scene(self) -> dict[str, Any]:
        """Scene as plain values."""
        return self._store.header.scene

    @property
    def maps(self) -> tuple[str, ...]:
        """Names of the maps that are kept."""
        return self._store.header.maps

    @property
    def sampling(self) -> str:
        """Method by which the members were drawn."""
        return self._store.header.sampling

    @property
    def digest(self) -> str:
        """Digest of the ensemble."""
        return self._store.header.digest

    @property
    def batch(self) -> int:
        """Members in a batch; sums over members are sums of batches, added in the order of the batches."""
        return self._store.header.batch

    @property
    def plan(self) -> EnsemblePlan | None:
        """Particles, column and steps that pilot runs chose; None without pilot runs."""
        plain = self._store.header.plan
        return None if plain is None else EnsemblePlan.from_mapping(plain)

    @property
    def replicates(self) -> np.ndarray:
        """Number of the independent sample that each member belongs to, shape (members,)."""
        return self.design["replicate"].values

    @property
    def done(self) -> np.ndarray:
        """Whether the result of a member is there, as a map or as an error, shape (members,)."""
        done = np.zeros(self.design.sizes["member"], bool)
        for batch in self._store.complete_batches():
            members = self._store.members_of(batch)
            done[members.start : members.stop] = True
        return done

    @property
    def measures(self) -> xr.Dataset:
        """Measures over ``member`` with units; NaN for a member that failed or is not there."""
        columns: dict[str, np.ndarray] = {}
        attributes: dict[str, dict[str, str]] = {}
        for batch in self._store.complete_batches():
            members, found = self._store.members_of(batch), self._store.attributes(batch)["measures"]
            values, attributes = self._store.measures(batch), attributes | found
            for k, name in enumerate(found):
                column = columns.setdefault(name, np.full(self.design.sizes["member"], np.nan))
                column[members.start : members.stop] = values[:, k]
        data = {name: ("member", column, attributes[name]) for name, column in columns.items()}
        return xr.Dataset(data, {"member": self.design["member"]})

    @property
    def seconds(self) -> np.ndarray:
        """CPU time of each member, NaN if it is not there, shape (members,) [s]."""
        found = np.full(self.design.sizes["member"], np.nan)
        for batch in self._store.complete_batches():
            members = self._store.members_of(batch)
            found[members.start : members.stop] = self._store.attributes(batch)["seconds"]
        return found

    @property
    def failures(self) -> list[MemberResult]:
        """Members that failed, with their values and errors."""
        failed = (batch for batch in self._store.complete_batches() if any(self._store.attributes(batch)["errors"]))
        return [one for batch in failed for one in self._store.read(batch, maps=False) if one.error]

    def members(self) -> Iterator[MemberResult]:
        """Yield the results that are there in the order of the members, failures included.

        Yields
        ------
        MemberResult
            One batch of maps is in memory at a time.
        """
        for batch in self._store.complete_batches():
            yield from self._store.read(batch)
