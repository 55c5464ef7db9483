"""Stores: continued to the same results, refused where they belong to another ensemble, whole after a kill."""

import json
import shutil

import numpy as np
import pytest

from landlab_debrisflow import InputError, Scene
from landlab_debrisflow.core.errors import OutputError
from landlab_debrisflow.ensemble import Ensemble, EnsembleResults
from landlab_debrisflow.run.directory import locked
from landlab_debrisflow.scene.gully import LATTICE

from .scenes import SCENE, VARY, same


@pytest.fixture(scope="module")
def ensemble():
    return Ensemble(SCENE, VARY, 5, "random", batch=2)


@pytest.fixture(scope="module")
def finished(ensemble, tmp_path_factory):
    path = tmp_path_factory.mktemp("ensemble") / "members.zarr"
    ensemble.run(store=path, workers=1)
    return path


def test_a_store_is_read_back_as_it_was_written(ensemble, finished):
    memory, results = ensemble.run(workers=1), EnsembleResults.open(finished)
    pairs = list(zip(memory.members(), results.members(), strict=True))
    assert [one.member for one, _ in pairs] == list(range(5)) and all(same(*pair) for pair in pairs)
    assert results.design.identical(ensemble.design) and results.measures.identical(memory.measures)
    assert results.measures.run_out.attrs["units"] == "m" and results.measures.at_rest.values.tolist() == [0.0] * 5
    assert results.lattice == LATTICE and results.scene == ensemble.scene.to_mapping()
    assert Scene.from_mapping(results.scene).digest() == ensemble.scene.digest()
    assert results.replicates.tolist() == [0] * 5 and (results.seconds > 0.0).all() and results.done.all()
    assert repr(results) == "<EnsembleResults with 5 of 5 members>"


def test_a_finished_ensemble_runs_nothing(ensemble, finished):
    told = []
    ensemble.run(store=finished, workers=1, notify=told.append)
    assert told == []


def test_an_interrupted_ensemble_goes_on(ensemble, finished, tmp_path):
    """Half a batch is as good as none."""
    path = tmp_path / "members.zarr"
    told = []

    def stop(text):
        told.append(text)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        ensemble.run(store=path, workers=1, notify=stop)
    assert told == ["ensemble: 2 of 5 members done"]
    assert EnsembleResults.open(path).done.tolist() == [True, True, False, False, False]
    shutil.copytree(finished / "batches" / "000001", path / "batches" / "000001")
    group = path / "batches" / "000001" / "zarr.json"
    text = json.loads(group.read_text())
    del text["attributes"]["complete"]
    group.write_text(json.dumps(text))
    shutil.copytree(finished / "batches" / "000002", path / "batches" / "000002")
    (path / "batches" / "000002" / "zarr.json").write_text('{"zarr_form')
    results = ensemble.run(store=path, workers=1, notify=(again := []).append)
    assert again == ["ensemble: 4 of 5 members done", "ensemble: 5 of 5 members done"]
    whole = EnsembleResults.open(finished)
    assert all(same(*pair) for pair in zip(results.members(), whole.members(), strict=True))


def test_a_store_of_another_ensemble_is_refused(finished):
    for other in (Ensemble(SCENE, VARY, 5, "random", seed=1, batch=2), Ensemble(SCENE, VARY, 5, "random", batch=3)):
        with pytest.raises(
            InputError, match=f"holds another ensemble, of digest {'.' * 32}; this one has {other.digest()}"
        ):
            other.run(store=finished, workers=1)


def test_a_store_of_another_version_is_named(finished, tmp_path):
    path = tmp_path / "members.zarr"
    shutil.copytree(finished, path)
    text = json.loads((path / "zarr.json").read_text())
    text["attributes"]["version"] = "0.0.9"
    (path / "zarr.json").write_text(json.dumps(text))
    with pytest.raises(InputError, match=r"members.zarr is of landlab_debrisflow 0.0.9 and format 1, this is"):
        EnsembleResults.open(path)


def test_a_store_whose_making_was_killed_is_made_anew(ensemble, tmp_path):
    (tmp_path / ".members.zarr.unfinished").mkdir()
    (tmp_path / ".members.zarr.unfinished" / "zarr.json").write_text("{")
    assert ensemble.run(store=tmp_path / "members.zarr", workers=1).done.all()
    assert [path.name for path in tmp_path.iterdir()] == ["members.zarr"]


def test_one_process_at_a_time_writes(ensemble, finished):
    lock = locked(finished.parent, "; wait", f".{finished.name}.lock")
    with lock, pytest.raises(OutputError, match="another process writes there; wait for it, or"):
        ensemble.run(store=finished, workers=1)


def test_stores_in_one_folder_have_locks_of_their_own(ensemble, finished):
    with locked(finished.parent, "; wait", ".other.zarr.lock"):
        assert ensemble.run(store=finished, workers=1).done.all()


def test_a_store_that_cannot_be_written_is_named(ensemble, tmp_path):
    with pytest.raises(OutputError, match=r"cannot write the store .*none/there/members.zarr"):
        ensemble.run(store=tmp_path / "none" / "there" / "members.zarr", workers=1)


def test_what_is_no_store_is_refused(ensemble, tmp_path):
    with pytest.raises(InputError, match="does not exist; give the store of an ensemble"):
        EnsembleResults.open(tmp_path / "none.zarr")
    (tmp_path / "notes.txt").write_text("notes")
    with pytest.raises(InputError, match="holds no ensemble"):
        EnsembleResults.open(tmp_path)
    with pytest.raises(InputError, match="holds no ensemble"):
        ensemble.run(store=tmp_path, workers=1)
    assert (tmp_path / "notes.txt").read_text() == "notes"


def test_a_member_without_flow_has_an_empty_window():
    """Nothing moves that is steeper than its friction allows, so no peak is recorded beyond the release."""
    results = Ensemble(SCENE | {"output": {"max_duration": 1e-6}}, VARY, 2, "random").run(workers=1)
    for one in results.members():
        assert one.error == "" and one.on_lattice("max_speed", LATTICE.shape).shape == LATTICE.shape


@pytest.mark.slow
def test_maps_that_are_asked_for_are_kept():
    results = Ensemble(SCENE, VARY, 1, "random", maps=["max_run_up", "arrival_time"]).run(workers=1)
    (one,) = results.members()
    assert list(one.maps) == ["max_run_up", "arrival_time"] == list(results.maps)
    assert (
        np.isnan(one.on_lattice("arrival_time", LATTICE.shape)[-1, -1]) and np.nanmin(one.maps["arrival_time"]) == 0.0
    )


@pytest.mark.parametrize(("workers", "client"), [(0, None), (True, None), (1.5, None), (2, "tcp://127.0.0.1:1")])
def test_workers_that_cannot_be_are_refused(ensemble, workers, client):
    with pytest.raises(InputError, match="workers"):
        ensemble.run(client, workers=workers)
