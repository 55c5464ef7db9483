"""Schedule of batches: Ctrl-C while workers run."""

import signal
import sys

import pytest

from landlab_debrisflow.ensemble.schedule import Task, run_on


class Future:
    """Future of dask that is done as soon as it is asked for."""

    def __init__(self, batch):
        self._batch = batch

    def add_done_callback(self, callback):
        callback(self)

    def result(self):
        return self._batch


class Client:
    """Client of one worker that runs nothing."""

    cancelled = None

    def wait_for_workers(self, count):
        pass

    def scatter(self, data, **options):
        return data

    def nthreads(self):
        return {"worker": 1}

    def submit(self, function, basis, batch, members, **options):
        return Future(batch)

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
