"""Schedule of an ensemble: batches as tasks on workers, or one after the other in this process."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from itertools import count
from queue import Empty, SimpleQueue
from typing import Any, NamedTuple
from uuid import uuid4

from ..core.errors import InputError
from ..grid.interruption import Interruption
from .basis import Basis
from .batch import BatchResult, OtherVersionError, run_batch
from .result import MemberResult

AHEAD = 2
"""Batches given to the scheduler for every thread of the workers: while one runs, the next one waits beside it, and
the memory of scheduler and workers does not grow with the number of members."""

ATTEMPTS = 3
"""Times that a batch is given away again after workers with the basis were lost."""

ASK = 0.1
"""Longest time between two looks for Ctrl-C while workers run [s]."""

ENDED = "KilledWorker: {} workers ended while they ran this member; there may be too little memory for it"
"""Error of a member that ends the processes of workers."""


class Task(NamedTuple):
    """Batch of members to be run.

    Attributes
    ----------
    batch : int
        Number of the batch.
    members : sequence of tuple of int and mapping
        Number and values of each member.
    """

    batch: int
    members: Sequence[tuple[int, Mapping[str, Any]]]


def run_here(basis: Basis, tasks: Iterable[Task], write: Callable[[BatchResult], None]) -> None:
    """Run batches one after the other in this process.

    Parameters
    ----------
    basis : Basis
    tasks : iterable of Task
    write : callable
        Called with each result.
    """
    for task in tasks:
        write(run_batch(basis, *task))


def run_on(client: Any, basis: Basis, tasks: Iterable[Task], write: Callable[[BatchResult], None]) -> None:
    """Run batches as tasks on the workers of a client.

    The basis goes to every worker once. A batch whose worker is lost runs again on another one. A batch that has ended
    several workers is run member by member, so that the member that ends a worker is found and further members count.

    Parameters
    ----------
    client : distributed.Client
    basis : Basis
    tasks : iterable of Task
    write : callable
        Called with each result in this process, in the order in which batches are done.

    Raises
    ------
    InputError
        If a worker has another version of the package, or the connection is lost for good.
    """
    _Schedule(client, basis, write).run(iter(tasks))


class _Schedule:
    def __init__(self, client: Any, basis: Basis, write: Callable[[BatchResult], None]):
        self._client, self._basis, self._write = client, basis, write
        self._done: SimpleQueue[Any] = SimpleQueue()
        self._running: dict[Any, tuple[Task, int]] = {}
        # a KeyboardInterrupt would be lost in a finaliser of dask, such as Future.__del__: Python drops it there
        self._interruption = Interruption()
        self._scatter()

    def _scatter(self) -> None:
        self._client.wait_for_workers(1)
        self._shared = self._client.scatter(self._basis, broadcast=True, hash=False)

    def run(self, tasks) -> None:
        try:
            with self._interruption:
                for task in tasks:
                    self._give(task, 1)
                    while len(self._running) >= AHEAD * max(1, sum(self._client.nthreads().values())):
                        self._finish_next()
                while self._running:
                    self._finish_next()
        finally:
            self._client.cancel(list(self._running))
            self._client.cancel([self._shared])

    def _submit(self, task: Task) -> Any:
        key = f"batch-{task.batch}-{uuid4().hex}"  # new each time: a scheduler keeps a failed task under its key
        return self._client.submit(run_batch, self._shared, *task, key=key, pure=False)

    def _give(self, task: Task, attempt: int) -> None:
        future = self._submit(task)
        self._running[future] = task, attempt
        future.add_done_callback(self._done.put)

    def _finish_next(self) -> None:
        future = None
        while future is None:
            if self._interruption.requested:
                raise KeyboardInterrupt
            with suppress(Empty):
                future = self._done.get(timeout=ASK)
        self._finish(future)

    def _finish(self, future: Any) -> None:
        from distributed import KilledWorker
        from distributed.client import CancelledError

        task, attempt = self._running.pop(future)
        try:
            self._write(_result_of(future))
        except KilledWorker:
            self._write(self._one_by_one(task))
        except CancelledError as error:
            self._replace_lost(task, attempt, error)
            self._give(task, attempt + 1)

    def _one_by_one(self, task: Task) -> BatchResult:
        """Return the result of a batch that ended its workers, the members that do it as failures."""
        from distributed import KilledWorker

        results: list[MemberResult] = []
        attributes: dict[str, dict[str, str]] = {}
        seconds: list[float] = []
        for member, values in task.members:
            try:
                found = self._alone(Task(task.batch, [(member, values)]))
                results += found.results
                attributes, seconds = attributes or found.attributes, seconds + found.seconds
            except KilledWorker as error:
                results.append(_failed(member, values, ENDED.format(error.allowed_failures + 1)))
                seconds.append(float("nan"))
        return BatchResult(task.batch, results, attributes, seconds)

    def _alone(self, task: Task) -> BatchResult:
        """Return the result of a task as soon as it is there, although workers with the basis may be lost."""
        from distributed.client import CancelledError

        for attempt in count(1):
            try:
                return _result_of(self._submit(task))
            except CancelledError as error:
                self._replace_lost(task, attempt, error)
        raise AssertionError  # `_replace_lost` gives up

    def _replace_lost(self, task: Task, attempt: int, error: BaseException) -> None:
        """Send the basis to the workers that there are, after a task was lost with its workers; or give up."""
        if attempt >= ATTEMPTS:
            raise InputError(
                f"ensemble: batch {task.batch} was lost {attempt} times with its workers ({error}); batches "
                "that are in the store stay there: run again when workers are back"
            ) from error
        self._scatter()


def _result_of(future: Any) -> BatchResult:
    try:
        found: BatchResult = future.result()
    except OtherVersionError as error:
        raise InputError(f"ensemble: {error}; install the version of this process there") from error
    return found


def _failed(member: int, values: Mapping[str, Any], error: str) -> MemberResult:
    return MemberResult(member, dict(values), {}, slice(0, 0), slice(0, 0), {}, error)
