"""Ctrl-C and observers that fail: the call ends after the step, keeps what it computed, and says so."""

import errno
import os
import signal
import subprocess
import sys
import textwrap
import threading
from pathlib import Path
from types import SimpleNamespace

import pytest

from landlab_debrisflow.grid.write import FieldWriter
from landlab_debrisflow.model import step
from landlab_debrisflow.record.files import write_atomically
from landlab_debrisflow.record.observers import Snapshots
from validation.grids import changed_fields, copy_fields

from ..twins import Failed, Fails, build, different, outcome, run_through, state


def press(times=1):
    """Press Ctrl-C."""
    for _ in range(times):
        signal.raise_signal(signal.SIGINT)


class Presses:
    """An observer during whose looks Ctrl-C is pressed."""

    def __init__(self, interval, times=1):
        self.interval, self.times = interval, times

    def observe(self, flow):
        press(self.times)


@pytest.fixture(scope="module")
def expected():
    flow = build("eroding")
    flow.run_until_rest()
    return outcome(flow), state(flow)


@pytest.fixture(autouse=True)
def the_handler_is_pythons_again():
    yield
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def during_a_step(monkeypatch, number, action, stage="consolidate"):
    """Do something in the middle of a step."""
    original, count = getattr(step, stage), [0]

    def disturbed(*arguments):
        count[0] += 1
        if count[0] == number:
            action()
        return original(*arguments)

    monkeypatch.setattr(step, stage, disturbed)


@pytest.mark.slow
@pytest.mark.parametrize("number", [1, 2, 30])  # the first is in the release, before any step
def test_ctrl_c_ends_the_call_after_the_step(number, expected, monkeypatch, caplog):
    flow = build("eroding")
    during_a_step(monkeypatch, number, press)
    with pytest.raises(KeyboardInterrupt) as failure:
        flow.run_until_rest()
    assert flow.diagnostics.steps == number - 1
    words = f"KeyboardInterrupt at {flow.elapsed_time:.6g} s: everything computed until then is kept"
    assert words in failure.value.__notes__[0] and "run_until_rest() or run_one_step(dt) goes on" in caplog.text
    assert words in caplog.text
    assert float(flow.grid.at_node["debris_flow__depth"].sum()) * 25.0 == pytest.approx(
        flow.budget["moving"], rel=1e-12
    )
    assert flow.run_until_rest() is True
    assert not different(outcome(flow), expected[0]) and not different(state(flow), expected[1])


def test_ctrl_c_in_the_last_step_lets_the_call_come_to_its_end(expected, monkeypatch):
    flow = build("eroding")
    during_a_step(monkeypatch, eval(expected[1]["flow._simulation.state.counters.steps"]) + 1, press)
    with pytest.raises(KeyboardInterrupt) as failure:
        flow.run_until_rest()
    assert "the call had come to its end" in failure.value.__notes__[0]
    assert not different(outcome(flow), expected[0]) and not different(state(flow), expected[1])


def test_ctrl_c_in_a_call_without_steps(monkeypatch):
    flow = build("eroding")
    flow.run_until_rest()
    reader, read = flow._call._reader, flow._call._reader.read
    monkeypatch.setattr(reader, "read", lambda *a: (press(), read(*a))[1])
    with pytest.raises(KeyboardInterrupt):
        flow.run_one_step(5.0)
    monkeypatch.undo()
    assert flow.at_rest and flow._call.rollback.interrupted is None


@pytest.mark.slow
@pytest.mark.parametrize("stage", ["friction_and_kick", "move", "interact", "consolidate"])
def test_ctrl_c_for_the_second_time_undoes_the_call_at_once(stage, expected, monkeypatch):
    flow = build("eroding")
    flow.run_one_step(0.0)
    before, fields = state(flow), copy_fields(flow.grid)
    during_a_step(monkeypatch, 20, lambda: press(2), stage)
    with pytest.raises(KeyboardInterrupt, match="grid and model are as they were before the call"):
        flow.run_until_rest()
    monkeypatch.undo()
    assert not changed_fields(flow.grid, fields) and flow.elapsed_time == 0.0
    assert not different(state(flow), before)
    flow.run_until_rest()
    assert not different(outcome(flow), expected[0])


@pytest.mark.slow
def test_ctrl_c_again_and_again_does_not_disturb_the_way_back(expected, monkeypatch):
    flow = build("eroding", [Fails(25)])
    with pytest.raises(Failed):
        flow.run_until_rest()
    flow._observers, before = (), state(flow)
    during_a_step(monkeypatch, 10, lambda: press(2))
    close, closed = FieldWriter.close, []
    monkeypatch.setattr(FieldWriter, "close", lambda *a: (press(3), close(*a), press(3), closed.append(1)))
    with pytest.raises(KeyboardInterrupt):
        flow.run_until_rest()
    monkeypatch.undo()
    assert closed and not different(state(flow), before)
    flow.run_until_rest()
    assert not different(outcome(flow), expected[0]) and not different(state(flow), expected[1])


@pytest.mark.slow
@pytest.mark.parametrize("times", [1, 2, 3])
def test_ctrl_c_while_an_observer_looks_keeps_everything(times, expected):
    flow = build("eroding", [Presses(4.0, times)])
    assert run_through(flow) == 6
    assert not different(outcome(flow), expected[0]) and not different(state(flow), expected[1])


def test_ctrl_c_from_another_thread(expected):
    flow = build("eroding")
    threading.Timer(0.02, press).start()
    try:
        flow.run_until_rest()
    except KeyboardInterrupt:
        flow.run_until_rest()
    assert not different(outcome(flow), expected[0])


def test_a_handler_of_somebody_else_is_left_alone(expected):
    heard = []
    before = signal.signal(signal.SIGINT, lambda *_: heard.append(1))
    try:
        flow = build("eroding", [Presses(10.0)])
        assert flow.run_until_rest() is True
    finally:
        signal.signal(signal.SIGINT, before)
    assert len(heard) == 3
    assert not different(outcome(flow), expected[0])


@pytest.mark.slow
def test_in_a_thread_nothing_is_done_about_signals(expected):
    handlers = []
    asks = SimpleNamespace(interval=5.0, observe=lambda _: handlers.append(signal.getsignal(signal.SIGINT)))
    flow = build("eroding", [asks])
    thread = threading.Thread(target=flow.run_until_rest)
    thread.start()
    thread.join()
    assert set(handlers) == {signal.default_int_handler}
    assert not different(outcome(flow), expected[0])


@pytest.mark.slow
@pytest.mark.parametrize(
    "error",
    [KeyboardInterrupt, SystemExit(3), MemoryError, OSError(errno.ENOSPC, "No space left on device"), ValueError],
)
def test_whatever_an_observer_raises_comes_out(error, expected, caplog):
    flow = build("eroding", [Fails(40, error=error)])
    with pytest.raises(error if isinstance(error, type) else type(error)):
        flow.run_until_rest()
    assert flow.elapsed_time > 2.0 and "everything computed until then is kept" in caplog.text
    flow.run_until_rest()
    assert not different(outcome(flow), expected[0])


@pytest.mark.slow
def test_an_observer_that_fails_does_not_keep_the_others_from_looking():
    first, second, third = Fails(10), Fails(), Fails(10, 11, error=ValueError("me, too"))
    flow = build("eroding", [first, second, third])
    with pytest.raises(Failed) as failure:
        flow.run_until_rest()
    assert any("another observer failed, too: ValueError('me, too')" in note for note in failure.value.__notes__)
    with pytest.raises(ValueError, match="me, too"):
        flow.run_until_rest()
    flow.run_until_rest()
    assert first.looks == second.looks == third.looks  # nobody missed a look or looked twice
    assert len(set(second.looks)) == len(second.looks) == flow.diagnostics.steps + 1


def test_a_full_disk_loses_no_snapshots(tmp_path, monkeypatch):
    snapshots = Snapshots(2.0, tmp_path / "event.nc", ["debris_flow__depth"])
    flow, full = build("eroding", [snapshots]), True

    def write(path, *rest):
        if full:
            raise OSError(errno.ENOSPC, "No space left on device")
        return write_atomically(path, *rest)

    monkeypatch.setattr("landlab_debrisflow.record.files.write_atomically", write)
    with pytest.raises(OSError, match="No space left on device") as failure:
        flow.run_until_rest()
    notes = " ".join(failure.value.__notes__)
    assert "all snapshots are kept; make room and call write()" in notes and "the call had come to its end" in notes
    assert flow.at_rest and flow.budget["deposited"] > 0.0 and os.listdir(tmp_path) == []
    full = False
    assert snapshots.write() == tmp_path / "event.nc"
    assert snapshots.dataset.sizes["time"] > 8


SCRIPT = """
    import sys
    from tests.twins import build, different, outcome

    class Tells:
        interval = 1.0

        def observe(self, flow):
            print("running", flush=True)

    flow = build("eroding")
    flow.run_one_step(1.0)
    flow._observers = [Tells()]  # from here on there may be signals
    interruptions = 0
    while True:
        try:
            while not flow.at_rest:
                flow.run_until_rest()
            break
        except KeyboardInterrupt:
            interruptions += 1
    same = build("eroding")
    same.run_one_step(1.0)
    same.run_until_rest()
    print("interrupted", interruptions, "different", different(outcome(flow), outcome(same)))
"""


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="no SIGINT for a single process there")
def test_a_signal_from_outside():
    root = str(Path(__file__).parents[2])
    with subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(SCRIPT)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        cwd=root, env=os.environ | {"PYTHONPATH": root},
    ) as process:  # fmt: skip
        said = []
        for line in process.stdout:
            said.append(line)
            if line == "running\n" and len(said) < 6:
                process.send_signal(signal.SIGINT)
        assert process.wait() == 0, process.stderr.read()
    assert (
        said[-1].startswith("interrupted ") and said[-1].endswith("different []\n") and "interrupted 0" not in said[-1]
    )
