"""A flow that was saved and loaded goes on as if nothing had been, to the bit."""

import json
import os
import re
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from landlab_debrisflow import DebrisFlow, InputError
from landlab_debrisflow.record import Checkpoints, Series, Snapshots
from landlab_debrisflow.record.observers import EVERY_STEP
from validation.grids import copy_fields

from .twins import SCENES, Failed, Fails, build, different, outcome, run_through, state


class Saves:
    """An observer that saves the flow after some of its steps, before the first one at 0."""

    interval = EVERY_STEP

    def __init__(self, folder, *steps):
        self.folder, self.steps, self.paths = folder, steps, []

    def observe(self, flow):
        if (step := flow.diagnostics.steps) in self.steps:
            self.paths.append(flow.save(self.folder / f"{step}.nc"))


def differences(flow, expected):
    """Return the places at which the state of a flow differs; 1 and np.int64(1) are equal, laws cache their choices."""
    one, other = (
        {k: re.sub(r"np\.\w+\(([^()]*)\)", r"\1", v) if isinstance(v, str) else v for k, v in found.items()}
        for found in (state(flow), expected)
    )
    passing = "flow._simulation.surroundings[4][0]", "particles.departed"  # who left in a step, no other one reads
    places = [place for place in different(one, other) if not any(word in place for word in passing)]
    return [(place, str(one.get(place))[:90], str(other.get(place))[:90]) for place in places]


def assert_goes_on(path, expected, observers=(), **others):
    flow = DebrisFlow.load(path, observers=observers, **others)
    assert flow.run_until_rest()
    assert not different(outcome(flow), expected[0])
    assert differences(flow, expected[1]) == []
    return flow


def test_saved_in_a_call_and_loaded_it_goes_on(twin, tmp_path):
    flow = build("eroding", [Saves(tmp_path, 30)])
    flow.run_until_rest()
    assert_goes_on(tmp_path / "30.nc", twin("eroding"), [Saves(tmp_path)])


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_saved_by_an_observer_and_loaded_it_goes_on(name, twin, tmp_path):
    expected = twin(name)
    steps, rng = expected[2], np.random.default_rng(4)
    saves = Saves(tmp_path, 0, 1, *rng.choice(np.arange(2, steps), 3, replace=False), steps)
    flow = build(name, [saves])
    flow.run_until_rest()
    assert not different(outcome(flow), expected[0]) and not different(state(flow), expected[1])
    for path in saves.paths:
        assert_goes_on(path, expected, [Saves(tmp_path)])


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_saved_between_calls_it_shows_the_same_and_goes_on(name, tmp_path):
    flow, rng = build(name), np.random.default_rng(5)
    flow.save(tmp_path / "0.nc")
    for k, duration in enumerate(rng.uniform(0.5, 6.0, 3)):
        again = DebrisFlow.load(tmp_path / f"{k}.nc")
        for each in (flow, again):
            assert each.unfinished_until is None
            each.run_one_step(duration)
        assert not different(outcome(again), outcome(flow)) and differences(again, state(flow)) == []
        flow.save(tmp_path / f"{k + 1}.nc")
        again = DebrisFlow.load(tmp_path / f"{k + 1}.nc")
        assert not different(outcome(again), outcome(flow))
        assert again.maps.drop_attrs().identical(flow.maps.drop_attrs())
        assert again.diagnostics == flow.diagnostics and again.budget_by_phase == flow.budget_by_phase
    for each in (flow, again):
        each.run_until_rest()
    flow.save(tmp_path / "end.nc")
    end = DebrisFlow.load(tmp_path / "end.nc")
    for each in (again, end):
        assert not different(outcome(each), outcome(flow)) and each.at_rest


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_saved_after_an_interruption_it_goes_on(name, twin, tmp_path):
    expected, rng = twin(name), np.random.default_rng(6)
    flow = build(name, [Fails(int(rng.integers(1, expected[2] - 1)))])
    with pytest.raises(Failed):
        flow.run_until_rest()
    then, shown = state(flow), outcome(flow)
    flow.save(tmp_path / "flow.nc")
    assert not different(state(flow), then) and flow.unfinished_until == 3600.0
    again = DebrisFlow.load(tmp_path / "flow.nc", observers=[Fails()])
    assert not different(outcome(again), shown) and again.unfinished_until == 3600.0
    again.save(tmp_path / "again.nc")
    assert_goes_on(tmp_path / "again.nc", expected, [Fails()])
    for each in (flow, again):
        each.run_until_rest()
        assert not different(outcome(each), expected[0]) and differences(each, expected[1]) == []
        assert each.unfinished_until is None


def test_what_was_changed_while_interrupted_is_saved_as_it_is(tmp_path):
    flow = build("eroding", [Fails(20)])
    with pytest.raises(Failed):
        flow.run_until_rest()
    flow.grid.at_node["soil__depth"][:] = 0.25
    flow.save(tmp_path / "flow.nc")
    again = DebrisFlow.load(tmp_path / "flow.nc", observers=[Fails()])
    assert again.unfinished_until is None
    for each in (flow, again):
        each.run_until_rest()
    assert not different(outcome(again), outcome(flow))


def test_a_call_that_failed_after_loading_is_undone(twin, tmp_path):
    flow = build("eroding", [Saves(tmp_path, 25)])
    flow.run_until_rest()
    again = DebrisFlow.load(tmp_path / "25.nc", observers=[Saves(tmp_path)])
    before, fields = outcome(again), copy_fields(again.grid)
    release = again.grid.at_node["debris_flow__release_depth"]
    release[500] = -1.0
    with pytest.raises(InputError, match="must be >= 0 m"):
        again.run_until_rest()
    release[500] = 0.0
    assert not different(outcome(again), before) and copy_fields(again.grid).keys() == fields.keys()
    again.run_until_rest()
    assert not different(outcome(again), twin("eroding")[0])


SCRIPT = """
    import sys
    from landlab_debrisflow import DebrisFlow
    from tests.twins import outcome
    flow = DebrisFlow.load(sys.argv[1])
    flow.run_until_rest()
    flow.save(sys.argv[2])
"""


@pytest.mark.slow
@pytest.mark.parametrize("name", ["two phases", "sleeping"])
def test_another_process_goes_on(name, twin, tmp_path):
    flow, root = build(name), str(Path(__file__).parents[1])
    flow.run_one_step(3.0)
    flow.save(tmp_path / "flow.nc")
    lines = "\n".join(line.strip() for line in SCRIPT.splitlines())
    subprocess.run(
        [sys.executable, "-c", lines, str(tmp_path / "flow.nc"), str(tmp_path / "end.nc")], check=True, cwd=root,
        env=os.environ | {"PYTHONPATH": root},
    )  # fmt: skip
    flow.run_until_rest()
    again = DebrisFlow.load(tmp_path / "end.nc")
    assert not different(outcome(again), outcome(flow))


def test_the_page_about_checkpoints_runs(twin, tmp_path, monkeypatch):
    page = (Path(__file__).parents[1] / "docs" / "checkpoints.md").read_text(encoding="utf-8")
    first, second = re.findall(r"```python\n(.*?)```", page, re.S)
    monkeypatch.chdir(tmp_path)
    names = {"grid": build("eroding").grid}
    exec(first, names)
    names["flow"].save("event.checkpoint.nc")
    ended = outcome(names["flow"])
    exec(second, names)
    assert not different(outcome(names["flow"]), ended) and names["flow"].at_rest


# ---- grids ----


def test_it_goes_on_on_a_grid_of_the_user(tmp_path):
    flow = build("friction from a field")
    flow.run_one_step(3.0)
    flow.save(tmp_path / "flow.nc")
    other = build("friction from a field").grid
    other.add_ones("somebody__elses", at="node")
    other.at_node["friction__angle"][:] = 1.0
    again = DebrisFlow.load(tmp_path / "flow.nc", other)
    assert again.grid is other and other.at_node["friction__angle"][5] == 30.0
    other.at_node.pop("somebody__elses")
    for each in (flow, again):
        each.run_until_rest()
    assert not different(outcome(again), outcome(flow))


def test_loaded_into_its_own_grid_it_goes_back(tmp_path):
    flow = build("eroding")
    flow.run_one_step(3.0)
    flow.save(tmp_path / "flow.nc")
    flow.run_until_rest()
    expected, maps = outcome(flow), flow.maps
    again = DebrisFlow.load(tmp_path / "flow.nc", flow.grid)
    assert again.elapsed_time == 3.0
    for name in ("debris_flow__max_depth", "debris_flow__deposit_depth"):  # its outputs were put aside
        assert flow.maps[name].identical(maps[name])
    again.run_until_rest()
    assert not different(outcome(again), expected)


# ---- observers ----


def watching(folder=None, *steps):
    """Return observers with a memory, and one that saves."""
    snapshots = Snapshots(1.5, variables=["debris_flow__depth", "soil__depth"])
    series = Series(np.arange(0.5, 12.0, 0.7), lambda flow: {"eroded": flow.budget["eroded"], "xy": [1.0, 2.0]})
    return [snapshots, series, Saves(folder, *steps)]


def test_observers_end_with_the_same(tmp_path):
    whole = watching(tmp_path, 20)
    build("eroding", whole).run_until_rest()
    again = watching(tmp_path)
    DebrisFlow.load(tmp_path / "20.nc", observers=again).run_until_rest()
    for one, other in zip(whole[:2], again[:2], strict=True):
        found, expected = (each.dataset for each in (other, one))
        for attributes in (found.attrs, expected.attrs):
            attributes.pop("date_created", None)
        assert found.identical(expected) and found.sizes["time"] > 5


def test_observers_that_saw_nothing_yet(tmp_path):
    flow = build("eroding", watching())
    flow.save(tmp_path / "flow.nc")
    again = watching()
    DebrisFlow.load(tmp_path / "flow.nc", observers=again)
    with pytest.raises(InputError, match="nothing was observed yet"):
        _ = again[0].dataset
    assert again[1].dataset.sizes["time"] == 0


def test_other_observers_are_refused(tmp_path):
    flow = build("eroding", watching())
    flow.save(tmp_path / "flow.nc")
    words = r"saved with the observers \[Snapshots, Series, Saves\], got \[Snapshots\]; give observers of the same"
    with pytest.raises(InputError, match=words):
        DebrisFlow.load(tmp_path / "flow.nc", observers=watching()[0])


def test_a_memory_that_cannot_be_written_is_refused(tmp_path):
    class Forgets(Saves):
        def state(self):
            return {"flow": object()}

    with pytest.raises(InputError, match=r"Forgets.state\(\): 'flow' must be an array of numbers, a number or a text"):
        build("eroding", [Forgets(tmp_path)]).save(tmp_path / "flow.nc")
    assert os.listdir(tmp_path) == []


class Remembers:
    """An observer with memory of every kind."""

    interval = 1.0

    def __init__(self):
        self.memory = {
            "a number": 0.1, "count": 3, "on": True, "text": "é\n" * 100000, "empty": "",
            "ints": np.arange(3, dtype=np.int16), "table": np.zeros((2, 0, 3)), "nan": np.array([np.nan, -0.0]),
        }  # fmt: skip

    def observe(self, flow):
        pass

    def state(self):
        return self.memory

    def restore(self, mapping):
        self.memory = mapping


def test_memory_of_every_kind_comes_back(tmp_path):
    build("eroding", [Remembers()]).save(tmp_path / "flow.nc")
    again, given = Remembers(), Remembers().memory
    again.memory = None
    DebrisFlow.load(tmp_path / "flow.nc", observers=[again])
    assert list(again.memory) == list(given)
    for key, value in given.items():
        found = again.memory[key]
        assert type(found) is type(value)
        if isinstance(value, np.ndarray):
            assert found.dtype == value.dtype and found.shape == value.shape and found.tobytes() == value.tobytes()
        else:
            assert found == value


# ---- when it is written ----


def test_in_an_observer_it_is_written_when_all_have_seen_the_step(tmp_path):
    seen = []

    class Last(Saves):
        def observe(self, flow):
            seen.append(os.path.exists(tmp_path / "10.nc"))

        def state(self):
            return {"seen": len(seen)}

        def restore(self, mapping):
            seen.append(mapping["seen"])

    flow = build("eroding", [Saves(tmp_path, 10), Last(tmp_path)])
    flow.run_until_rest()
    assert seen.index(True) == 11
    DebrisFlow.load(tmp_path / "10.nc", observers=[Saves(tmp_path), Last(tmp_path)])
    assert seen[-1] == 11


def test_another_thread_saves_between_two_steps(twin, tmp_path):
    started = threading.Event()

    class Starts:
        interval = EVERY_STEP

        def observe(self, flow):
            started.set()

    flow = build("eroding", [Starts()])
    threads = [threading.Thread(target=lambda: (started.wait(), flow.save(tmp_path / "flow.nc")))]
    threads[0].start()
    flow.run_until_rest()
    threads[0].join()
    again = DebrisFlow.load(tmp_path / "flow.nc", observers=[Starts()])
    again.run_until_rest()
    assert not different(outcome(again), twin("eroding")[0])


def test_checkpoints_are_made_by_the_clock_on_the_wall(twin, tmp_path, monkeypatch):
    path, now, saved = tmp_path / "flow.nc", [0.0], []

    def clock():
        now[0] += 1.0
        return now[0]

    monkeypatch.setattr("landlab_debrisflow.record.checkpoints.monotonic", clock)
    flow = build("eroding", [Checkpoints(path, interval=9.0)])
    monkeypatch.setattr(flow, "save", lambda path: saved.append(flow.diagnostics.steps))
    flow.run_until_rest()
    assert np.all(np.diff(saved) == 9) and len(saved) >= 5  # the clock is read once more after saving
    assert not different(outcome(flow), twin("eroding")[0])


def test_an_interrupted_call_leaves_its_last_step(twin, tmp_path):
    path = tmp_path / "flow.nc"
    flow = build("eroding", [Checkpoints(path), Fails(12)])
    with pytest.raises(Failed):
        flow.run_until_rest()
    with xr.open_dataset(path, decode_times=False) as plain:
        assert plain["time"] == flow.elapsed_time and json.loads(plain.attrs["setup"])["flow"] == {"law": "one_phase"}
    assert_goes_on(path, twin("eroding"), [Checkpoints(path), Fails()])


def test_the_one_before_is_kept(tmp_path):
    path, flow = tmp_path / "flow.nc", build("eroding")
    for duration in (1.0, 1.0, 1.0):
        flow.run_one_step(duration)
        assert flow.save(path) == path
    assert sorted(os.listdir(tmp_path)) == ["flow.nc", "flow.previous.nc"]
    times = [DebrisFlow.load(each).elapsed_time for each in (path, tmp_path / "flow.previous.nc")]
    assert times == [3.0, 2.0]


def test_a_process_killed_between_keeping_and_writing_leaves_nothing_beside(tmp_path):
    flow = build("eroding")
    path, previous = tmp_path / "flow.nc", tmp_path / "flow.previous.nc"
    flow.save(path)
    os.link(path, previous)  # the one that is there has been kept, the new one is not there yet
    flow.run_one_step(0.5)
    flow.save(path)
    assert sorted(os.listdir(tmp_path)) == ["flow.nc", "flow.previous.nc"]
    assert [DebrisFlow.load(each).elapsed_time for each in (previous, path)] == [0.0, 0.5]


@pytest.mark.skipif(os.name != "posix", reason="asks the system for processes")
def test_what_a_killed_process_left_is_removed(tmp_path):
    process = subprocess.Popen([sys.executable, "-c", ""])
    process.wait()
    kept = [f".flow.{os.getppid()}.nc", ".flow.x.nc", ".flow.99999999999999999999999.nc", ".other.1.nc"]
    for name in (f".flow.{process.pid}.nc", *kept):
        (tmp_path / name).write_text("half")
    build("eroding").save(tmp_path / "flow.nc")
    assert sorted(os.listdir(tmp_path)) == sorted([*kept, "flow.nc"])


def test_a_full_disk_ends_the_call_and_loses_nothing(twin, tmp_path, monkeypatch):
    path, real = tmp_path / "flow.nc", os.fsync
    flow = build("eroding", [Checkpoints(path, 1e-9)])

    def fsync(number):
        if flow.diagnostics.steps == 15:
            raise OSError(28, "No space left on device")
        return real(number)

    monkeypatch.setattr(os, "fsync", fsync)
    words = rf"cannot write checkpoint {re.escape(str(path))}: No space left on device; the checkpoint before is"
    with pytest.raises(InputError, match=words) as failure:
        flow.run_until_rest()
    assert flow.diagnostics.steps == 15 and "everything computed until then is kept" in failure.value.__notes__[0]
    assert sorted(os.listdir(tmp_path)) == ["flow.nc", "flow.previous.nc"]
    monkeypatch.undo()
    assert DebrisFlow.load(path, observers=[Checkpoints(path)]).diagnostics.steps == 14
    assert run_through(flow) == 0
    assert not different(outcome(flow), twin("eroding")[0])
