"""Schedule of batches: Ctrl-C while workers run, workers that are lost."""

import signal
import sys

import pytest
from distributed import KilledWorker
from distributed.client import CancelledError

from landlab_debrisflow import InputError
from landlab_debrisflow.ensemble.batch import BatchResult
from landlab_debrisflow.ensemble.result import MemberResult
from landlab_debrisflow.ensemble.schedule import ATTEMPTS, Task, run_on


class Future:
    """Future of dask that is done as soon as it is asked for."""

    def __init__(self, outcome):
        self._outcome = outcome

    def add_done_callback(self, callback):
        callback(self)

    def result(self):
        if isinstance(self._outcome, BaseException):
            raise self._outcome
        return self._outcome


class Client:
    """Client of one worker that runs nothing: outcomes are told in advance, else the number of the batch."""

    def __init__(self, outcomes=()):
        self.outcomes, self.scattered, self.cancelled = list(outcomes), 0, None

    def wait_for_workers(self, count):
        pass

    def scatter(self, data, **options):
        self.scattered += 1
        return data

    def nthreads(self):
        return {"worker": 1}

    def submit(self, function, basis, batch, members, **options):
        return Future(self.outcomes.pop(0) if self.outcomes else batch)

    def cancel(self, futures):
        self.cancelled = futures


class Finalised:
    """Object in whose finaliser Ctrl-C comes, as in that of a future of dask."""

    def __del__(self):
        signal.raise_signal(signal.SIGINT)


@pytest.mark.parametrize("press", [lambda: signal.raise_signal(signal.SIGINT), Finalised])
def test_ctrl_c_ends_a_schedule_between_two_batches_wherever_it_comes(press, monkeypatch):
    written, dropped, client = [], [], Client()
    monkeypatch.setattr(sys, "unraisablehook", dropped.append)

    def write(batch):
        written.append(batch)
        if batch == 1:
            press()
            written.append("whole")

    with pytest.raises(KeyboardInterrupt):
        run_on(client, "basis", [Task(batch, []) for batch in range(6)], write)
    assert written == [0, 1, "whole"] and dropped == [] and client.cancelled == ["basis"]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def killed():
    return KilledWorker("batch", None, 0)


def done(member):
    return BatchResult(0, [MemberResult(member, {}, {}, slice(0, 0), slice(0, 0), {})], {}, [1.0])


def test_members_are_run_alone_after_their_batch_ended_its_worker_also_when_the_basis_is_lost():
    client, written = Client([killed(), done(0), CancelledError("lost dependencies"), done(1), killed()]), []
    run_on(client, "basis", [Task(0, [(member, {}) for member in range(3)])], written.append)
    (batch,) = written
    assert [one.member for one in batch.results] == [0, 1, 2] and client.scattered == 2
    assert [one.error[:12] for one in batch.results] == ["", "", "KilledWorker"]


@pytest.mark.parametrize("before", [[], [killed()]])
def test_a_batch_that_is_lost_again_and_again_is_given_up(before):
    client = Client([*before, *(CancelledError("lost dependencies") for _ in range(ATTEMPTS))])
    with pytest.raises(InputError, match=f"batch 0 was lost {ATTEMPTS} times with its workers"):
        run_on(client, "basis", [Task(0, [(0, {})])], lambda batch: None)
    assert client.scattered == ATTEMPTS
