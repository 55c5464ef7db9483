"""Runs of scenes: what they write, how they end, and how they go on."""

import errno
import logging

import numpy as np
import pytest
import xarray as xr

from landlab_debrisflow import InputError
from landlab_debrisflow.record.monitor import Monitor
from landlab_debrisflow.run import runner
from landlab_debrisflow.run.doubts import scene_doubts
from landlab_debrisflow.run.runner import resume_scene, run_scene
from landlab_debrisflow.scene.releases import set_release

from .running import Stopping, assert_same, scene

GEOTIFFS = ("max_depth", "max_speed", "arrival_time", "eroded_depth", "deposit_depth")
QUIET = {"monitor": Monitor(live=False)}


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """Results of a run that nothing interrupted."""
    return run_scene(scene(tmp_path_factory.mktemp("whole")), **QUIET)


@pytest.mark.slow
def test_a_run_writes_maps_budget_and_record(whole):
    names = {path.relative_to(whole.directory).as_posix() for path in whole.directory.rglob("*") if path.is_file()}
    expected = {"run.json", "maps.nc", "budget.nc", *(f"{name}.{end}" for name in GEOTIFFS for end in ("tif", "qml"))}
    assert expected <= names and not [name for name in names if name.startswith(".")]
    assert len([name for name in names if name.startswith("series/")]) == 4  # after 2, 4, 6, 8 s
    assert whole.record.given[:2] == ["terrain.example", "terrain.soil_depth"] and whole.record.environment["python"]
    assert [words for words in whole.record.warnings if words.startswith("not at rest after 9 s")]
    same = scene(whole.directory.parent)
    assert whole.record.doubts == list(scene_doubts(same)) and whole.record.notes == same.notes
    assert whole.finished and whole.record.version and whole.record.scene["output"]["interval"] == 2.0
    with xr.open_dataset(whole.directory / "budget.nc") as budget:
        assert budget.released.values[-1] == pytest.approx(whole.budget["released"], rel=1e-14)
        assert np.all(np.diff(budget.time) > 0.0) and np.all(np.diff(budget.released) >= 0.0)


@pytest.mark.slow
def test_it_is_the_run_of_the_component_with_its_releases_at_their_times(whole, tmp_path):
    same = scene(tmp_path)
    flow = same.flow()
    first, second = same.releases
    assert first.time == 0.0
    flow.run_one_step(second.time)
    set_release(flow.grid, second)
    flow.run_until_rest(same.output_keys.max_duration - flow.elapsed_time)
    assert whole.elapsed_time == flow.elapsed_time and whole.budget == flow.budget
    wet = whole.maps.debris_flow__max_depth.values >= 0.05
    assert wet.any()
    assert np.array_equal(whole.maps.debris_flow__max_speed.values[wet], flow.maps.debris_flow__max_speed.values[wet])


@pytest.mark.slow
@pytest.mark.parametrize("step", [1, 2, 15, 24, 26, 30, 45])
def test_an_interrupted_run_goes_on_to_the_same_files(whole, step, tmp_path):
    """Before the first step, between, around the second release, and shortly before the end."""
    with pytest.raises(KeyboardInterrupt) as failure:
        run_scene(scene(tmp_path), monitor=Stopping(step))
    assert "landlab-debrisflow resume" in failure.value.__notes__[-1]
    with pytest.raises(InputError, match="not finished; landlab-debrisflow resume"):
        run_scene(scene(tmp_path), **QUIET)
    with pytest.raises(KeyboardInterrupt):
        resume_scene(scene(tmp_path), monitor=Stopping(4))
    results = resume_scene(scene(tmp_path), monitor=Monitor(live=False))
    assert results.finished
    if not results.at_rest:
        assert (results.directory / "checkpoint.nc").is_file()
    for path in (*results.directory.glob("checkpoint*"), *whole.directory.glob("checkpoint*")):
        path.unlink()
    assert_same(results.directory, whole.directory)


@pytest.mark.slow
def test_a_finished_run_stays_and_is_replaced_on_request(tmp_path, caplog):
    results = scene(tmp_path, max_duration=3.0).run()
    (results.directory / "notes.txt").write_text("mine")
    before = (results.directory / "maps.nc").stat().st_mtime_ns
    with caplog.at_level(logging.WARNING, "landlab_debrisflow"):
        assert scene(tmp_path, max_duration=3.0).resume().elapsed_time == 3.0
    assert "come to its end" in caplog.text and (results.directory / "maps.nc").stat().st_mtime_ns == before
    with pytest.raises(InputError, match="holds the results of this scene already, until 3 s; run with --overwrite"):
        run_scene(scene(tmp_path, max_duration=3.0), **QUIET)
    with pytest.raises(InputError, match=r"of another scene: output.max_duration was 3.0, is 2.0; output.interv"):
        run_scene(scene(tmp_path, interval=1.0, max_duration=2.0), **QUIET)
    run_scene(scene(tmp_path, interval=None, max_duration=2.0), overwrite=True, monitor=Monitor(live=False))
    assert not (results.directory / "series").exists()
    assert (results.directory / "notes.txt").read_text() == "mine"


@pytest.mark.slow
def test_a_run_that_still_moved_goes_on_to_a_longer_duration(tmp_path):
    short = run_scene(scene(tmp_path, max_duration=3.0), **QUIET)
    assert not short.at_rest and short.elapsed_time == 3.0
    longer = resume_scene(scene(tmp_path, max_duration=5.0), monitor=Monitor(live=False))
    assert longer.elapsed_time == 5.0 and longer.budget["released"] > short.budget["released"]  # the second release


@pytest.mark.slow
def test_a_changed_scene_or_file_is_refused(tmp_path):
    with pytest.raises(KeyboardInterrupt):
        run_scene(scene(tmp_path), monitor=Stopping(3))
    changed = scene(tmp_path, interval=3.0)
    with pytest.raises(InputError, match=r"the scene has changed since: output.interval was 2.0, is 3.0; undo that"):
        resume_scene(changed, **QUIET)
    with pytest.raises(InputError, match="holds no run to go on with"):
        resume_scene(scene(tmp_path, directory="other"), **QUIET)


@pytest.mark.slow
def test_without_a_checkpoint_a_run_begins_anew(whole, tmp_path, caplog):
    with pytest.raises(KeyboardInterrupt):
        run_scene(scene(tmp_path), monitor=Stopping(3))
    for path in (tmp_path / "scene_out").glob("checkpoint*"):
        path.unlink()
    with caplog.at_level(logging.WARNING, "landlab_debrisflow"):
        results = resume_scene(scene(tmp_path), monitor=Monitor(live=False))
    assert "no checkpoint yet; it begins anew" in caplog.text
    assert results.budget == whole.budget


@pytest.mark.slow
def test_a_damaged_checkpoint_is_replaced_by_the_one_before(whole, tmp_path, caplog):
    for steps in (3, 6):
        with pytest.raises(KeyboardInterrupt):
            (run_scene if steps == 3 else resume_scene)(scene(tmp_path), monitor=Stopping(steps))
    checkpoint = tmp_path / "scene_out" / "checkpoint.nc"
    checkpoint.write_bytes(checkpoint.read_bytes()[:-100])
    with caplog.at_level(logging.WARNING, "landlab_debrisflow"):
        results = resume_scene(scene(tmp_path), monitor=Monitor(live=False))
    assert "the checkpoint before it is taken" in caplog.text
    assert results.budget == whole.budget


@pytest.mark.slow
def test_a_full_disk_at_the_end_leaves_no_half_results(whole, tmp_path, monkeypatch):
    def fill(folder, *_):
        (folder / "maps.nc").write_bytes(b"half")
        raise OSError(errno.ENOSPC, "No space left on device", str(folder / "max_depth.tif"))

    with pytest.raises(KeyboardInterrupt):
        run_scene(scene(tmp_path), monitor=Stopping(3))
    with monkeypatch.context() as context:
        context.setattr(runner, "write_results", fill)
        with pytest.raises(OSError, match="No space left") as failure:
            resume_scene(scene(tmp_path), monitor=Monitor(live=False))
    assert "a checkpoint is kept" in failure.value.__notes__[-1]
    folder = tmp_path / "scene_out"
    assert not (folder / "maps.nc").exists() and not (folder / ".unfinished").exists()
    results = resume_scene(scene(tmp_path), monitor=Monitor(live=False))
    assert results.budget == whole.budget


@pytest.mark.slow
def test_a_failure_before_the_first_step_leaves_nothing(tmp_path):
    class Refusing(Monitor):
        def expect(self, *_):
            raise RuntimeError("no")

    with pytest.raises(RuntimeError, match="no") as failure:
        run_scene(scene(tmp_path), monitor=Refusing(live=False))
    assert failure.value.__notes__ == ["nothing was kept"]
    assert not list(tmp_path.iterdir())


def test_nothing_to_run_is_said_before_anything_is_written(tmp_path):
    empty = scene(tmp_path)
    empty.__dict__["releases"] = []
    with pytest.raises(InputError, match="nothing is released and nothing flows in"):
        run_scene(empty, **QUIET)
    assert not list(tmp_path.iterdir())
