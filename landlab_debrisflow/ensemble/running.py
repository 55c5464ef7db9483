"""Run of an ensemble: the batches that its store lacks, on the workers that there are."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import xarray as xr

from ..core.errors import InputError, OutputError
from ..run.directory import locked
from .basis import Basis
from .batch import BatchResult
from .cluster import connected, processors
from .design import member_values
from .schedule import Task, run_here, run_on
from .store import Header, Store


@contextmanager
def opened(path: Path | None, header: Header, design: xr.Dataset) -> Iterator[Store]:
    """Open the store of an ensemble for writing in a block, or make it.

    Parameters
    ----------
    path : Path or None
        Directory of the store; None: in memory.
    header : Header
    design : xarray.Dataset

    Yields
    ------
    Store

    Raises
    ------
    InputError
        If the store holds another ensemble.
    OutputError
        If it cannot be written, or another process writes it.
    """
    if path is None:
        yield Store.create(None, header, design)
        return
    try:
        path.parent.mkdir(exist_ok=True)
    except OSError as error:
        raise OutputError(f"cannot write the store {path}: {error.strerror}; choose another") from error
    with locked(path.parent, "; wait for it, or choose another store", f".{path.name}.lock"):
        found = Store.open(path, write=True) if path.exists() else Store.create(path, header, design)
        if found.header.digest != header.digest:
            raise InputError(
                f"{path} holds another ensemble, of digest {found.header.digest}; this one has {header.digest}: scene, "
                "values of members, maps or batches differ; choose another store, or remove it"
            )
        yield found


def stored_plan(path: Path) -> dict[str, Any] | None:
    """Return the plan of the ensemble in a store as plain values, None if no store is there."""
    return Store.open(path).header.plan if path.exists() else None


def run_missing(
    basis: Basis, store: Store, client: Any, workers: int | None, notify: Callable[[str], None]
) -> None:  # fmt: skip
    """Run the batches that a store lacks.

    Parameters
    ----------
    basis : Basis
    store : Store
        Gets the results.
    client : distributed.Client, str or None
        As for `connected`.
    workers : int or None
        Processes on this machine; 1: the batches run in this process.
    notify : callable
        Called with a text as batches are done.

    Raises
    ------
    InputError
        If workers are given beside a client, or no scheduler answers.
    """
    if client is not None and workers is not None:
        raise InputError("ensemble: workers are those of the client; leave one of them out")
    if workers is not None and (isinstance(workers, bool) or not isinstance(workers, int) or workers < 1):
        raise InputError(f"ensemble: workers must be an integer of 1 or more, got {workers!r}")
    done = store.complete_batches()
    missing = sorted(set(range(store.batch_count)) - set(done))
    tasks = (
        Task(batch, [(member, member_values(store.design, member)) for member in store.members_of(batch)])
        for batch in missing
    )
    write, count = _Writer(store, done, notify), min(len(missing), workers or processors())
    if not missing:
        return
    if client is None and count == 1:
        run_here(basis, tasks, write)
        return
    with connected(client, count) as found:
        run_on(found, basis, tasks, write)


class _Writer:
    """Writes batches into a store and tells how many members are done."""

    def __init__(self, store: Store, done: list[int], notify: Callable[[str], None]):
        self._store, self._notify = store, notify
        self._done = sum(len(store.members_of(batch)) for batch in done)
        self._failed = 0

    def __call__(self, found: BatchResult) -> None:
        self._store.write(found)
        self._done += len(found.results)
        self._failed += sum(bool(one.error) for one in found.results)
        failed = f", {self._failed} failed" if self._failed else ""
        self._notify(f"ensemble: {self._done} of {self._store.design.sizes['member']} members done{failed}")
