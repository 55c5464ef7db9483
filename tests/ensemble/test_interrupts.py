"""Ctrl-C while workers run batches."""

import signal

import pytest

from landlab_debrisflow.core.ending import request_end
from landlab_debrisflow.ensemble.interrupts import Interrupts


@pytest.mark.parametrize("ask", [lambda: signal.raise_signal(signal.SIGINT), request_end])
def test_the_first_request_waits_until_it_is_asked_for_and_the_second_does_not(ask):
    """An exception of a signal in a finaliser would be dropped, as that of a future of dask."""
    with Interrupts() as interrupts:
        interrupts.check()
        ask()
        with pytest.raises(KeyboardInterrupt):
            interrupts.check()
        with pytest.raises(KeyboardInterrupt):
            ask()
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_a_handler_of_the_program_stays():
    heard = []
    before = signal.signal(signal.SIGINT, lambda *_: heard.append(1))
    try:
        with Interrupts() as interrupts:
            signal.raise_signal(signal.SIGINT)
            interrupts.check()
        assert heard == [1]
    finally:
        signal.signal(signal.SIGINT, before)
