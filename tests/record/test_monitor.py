"""Monitor of a run: what it shows and where, and when it expects the end."""

import io
import itertools
import logging
import math
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from rich.console import Console

from landlab_debrisflow.record.end_estimate import EndEstimate
from landlab_debrisflow.record.monitor import Monitor, NotebookLine


def particles(speed=3.0, count=4):
    velocity = np.zeros((3, count))
    velocity[0, : count - 1] = speed * np.arange(1, count) / (count - 1)  # the last one lies still
    return SimpleNamespace(
        awake=count, velocity=velocity, volume=np.full(count, 500.0), z=np.arange(800.0, 800.0 + count)
    )


@pytest.fixture
def clock():
    """A clock on the wall that goes on by a second whenever it is read."""
    seconds = itertools.count(100.0)
    return lambda: next(seconds)


def terminal(width=100):
    return Console(file=io.StringIO(), force_terminal=True, width=width)


def test_a_terminal_shows_time_volume_front_and_speed(clock):
    console = terminal()
    shown = Monitor(console, clock=clock)
    shown.follow(particles(), 11.5, 12.0)
    assert console.file.getvalue() == "\r\x1b[2K12.0 s, moving 1 500 m3 at up to 3.0 m/s, front at 800 m"
    shown.close()
    shown.close()
    assert console.file.getvalue().endswith("800 m\n")


def test_a_narrow_terminal_gets_one_line(clock):
    console = terminal(width=20)
    Monitor(console, clock=clock).follow(particles(), 11.5, 12.0)
    assert console.file.getvalue().removeprefix("\r\x1b[2K") == "12.0 s, moving 1 50"


def test_nothing_is_read_between_two_updates():
    shown = Monitor(terminal(), clock=lambda: 100.0)
    shown.follow(particles(), 0.0, 1.0)
    shown.follow(None, 1.0, 2.0)
    assert shown.line.startswith("1.0 s")


def test_a_file_gets_nothing_and_a_log_a_line_every_half_minute(clock, caplog):
    stream = io.StringIO()
    shown = Monitor(Console(file=stream), clock=clock)
    with caplog.at_level(logging.INFO, "landlab_debrisflow.progress"):
        for time in range(100):  # two readings of the clock would be 2 s; one is 1 s
            shown.follow(particles(), time, time + 1.0)
    assert stream.getvalue() == ""
    assert [record.getMessage()[:5] for record in caplog.records] == ["1.0 s", "31.0 ", "61.0 ", "91.0 "]


def test_the_last_line_is_logged_once(clock, caplog):
    shown = Monitor(live=False, clock=clock)
    with caplog.at_level(logging.INFO, "landlab_debrisflow.progress"):
        for time in (1.0, 2.0, 3.0):
            shown.follow(particles(), time - 1.0, time)
        shown.finish()
        shown.finish()
    assert [record.getMessage()[:5] for record in caplog.records] == ["1.0 s", "3.0 s"]


def test_a_remark_is_logged_once(clock, caplog):
    console = terminal()
    shown = Monitor(console, clock=clock)
    with caplog.at_level(logging.INFO, "landlab_debrisflow.progress"):
        shown.say("compiling")
        shown.say("compiling")
    assert len(caplog.records) == 1 and console.file.getvalue().count("compiling") == 2


def test_a_notebook_line_is_replaced(monkeypatch):
    calls = []
    handle = SimpleNamespace(update=lambda data, raw: calls.append(("update", data["text/plain"])))

    def display(data, raw, display_id):
        calls.append(("display", data["text/plain"]))
        return handle

    monkeypatch.setitem(sys.modules, "IPython.display", SimpleNamespace(display=display))
    line = NotebookLine()
    for text in ("a", "b"):
        line.show(text)
    assert calls == [("display", "a"), ("update", "b")]


def test_rest_is_told_with_the_deposit(clock):
    shown = Monitor(live=False, clock=clock)
    budget = {"moving": 0.0, "deposited": 12345.6}
    shown.observe(SimpleNamespace(elapsed_time=61.5, at_rest=True, budget=budget))
    assert shown.line.strip() == "61.5 s, at rest, 12 346 m3 deposited"


def test_the_end_is_a_bound_until_the_energy_falls(clock):
    shown = Monitor(live=False, clock=clock)
    shown.expect(until=101.0, rest_energy=1e-4)
    for time in (0.0, 1.0):
        shown.follow(particles(), time - 0.5, time)
    assert shown.line.endswith(", at most 1 min 40 s left")  # 100 s at the pace of a second for a second
    for time in (2.0, 3.0, 4.0):
        shown.follow(particles(3.0 * math.exp(-0.5 * time)), time - 0.5, time)
    assert shown.line.endswith(", about 5.2 s left")  # ln(1e4) s after 0, where E = exp(-t), less 4 s


def test_nothing_is_expected_of_what_is_not_known():
    estimate = EndEstimate()
    assert estimate.remaining() is None
    estimate.add(0.0, 0.0, 1.0)
    assert estimate.remaining() is None
    estimate.add(1.0, 1.0, 2.0)
    assert estimate.remaining() is None  # no decay, no bound
    estimate.add(2.0, 2.0, 0.0)
    assert estimate.remaining() is None


def test_an_end_beyond_the_longest_duration_is_the_bound():
    estimate = EndEstimate(until=5.0)
    for time in range(4):
        estimate.add(time, time, math.exp(-time))
    left = estimate.remaining()
    assert left.bound and left.seconds == pytest.approx(2.0)
