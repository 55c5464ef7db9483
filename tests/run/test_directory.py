"""Directories of results: claimed by one run, never mixed, and only files of a run are removed."""

import json

import pytest

from landlab_debrisflow.core.errors import InputError, OutputError
from landlab_debrisflow.run.directory import OutputDirectory
from landlab_debrisflow.run.record import RunRecord

RECORD = {"scene": {"a": {"b": 1.0}, "release": [{"time": 0.0}, {"time": 2.0}]}, "inputs": {"dem.tif": "1"}}


def record(**changes):
    return RunRecord(**(RECORD | {"digest": "0"} | changes))


def test_an_empty_directory_does_not_stay(tmp_path):
    with pytest.raises(RuntimeError), OutputDirectory.claimed(tmp_path / "out"):
        raise RuntimeError
    assert not list(tmp_path.iterdir())


def test_two_runs_do_not_share_a_directory(tmp_path):
    refused = pytest.raises(OutputError, match="another process writes there")
    with OutputDirectory.claimed(tmp_path / "out"), refused, OutputDirectory.claimed(tmp_path / "out"):
        pass


def test_a_file_or_a_missing_parent_is_refused(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match="it is a file; set output: directory"):
        OutputDirectory.claimed(tmp_path / "file").__enter__()
    with pytest.raises(OutputError, match="cannot make the directory"):
        OutputDirectory.claimed(tmp_path / "missing" / "out").__enter__()


def test_files_of_something_else_are_refused_also_on_overwriting(tmp_path):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "thesis.tex").write_text("")
    refused = pytest.raises(InputError, match=r"no results of a run, such as 'thesis.tex'")
    with OutputDirectory.claimed(tmp_path / "out") as directory, refused:
        directory.begin(record(), overwrite=True)
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["thesis.tex"]


def test_only_recorded_files_inside_are_removed(tmp_path):
    folder = tmp_path / "out"
    for name in ("kept.txt", "out/mine.tif", "out/max_depth.tif", "out/series/maps_000001.nc", "out/series/mine.nc"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("")
    (folder / "outside").symlink_to(tmp_path)
    names = ["max_depth.tif", "series/maps_*.nc", "../kept.txt", str(tmp_path / "kept.txt"), "outside/kept.txt", "", 3]
    record(files=names).write(folder / "run.json")
    with OutputDirectory.claimed(folder) as directory:
        directory.remove_results()
    left = {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}
    assert left == {"mine.tif", "series/mine.nc"} and (tmp_path / "kept.txt").exists()


def test_files_that_a_killed_process_was_writing_are_removed(tmp_path):
    for name in (
        ".checkpoint.123.nc",
        ".checkpoint.previous.5.nc",
        ".run.9.json",
        "series/.maps_000002.77.nc",
        ".hidden.nc",
        "checkpoint.nc",
    ):
        (tmp_path / "out" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "out" / name).write_text("")
    with OutputDirectory.claimed(tmp_path / "out"):
        left = {path.name for path in (tmp_path / "out").rglob("*") if path.is_file()}
    assert left == {".lock", ".hidden.nc", "checkpoint.nc"}


def test_results_appear_together_or_not_at_all(tmp_path):
    def fail(folder):
        (folder / "a.nc").write_text("")
        raise OSError("full")

    with OutputDirectory.claimed(tmp_path / "out") as directory:
        directory.begin(record())
        with pytest.raises(OSError, match="full"):
            directory.publish(fail)
        assert [path.name for path in directory.path.iterdir() if path.name != ".lock"] == ["run.json"]
        assert directory.publish(lambda folder: (folder / "a.nc").write_text("")) == ["a.nc"]
        assert directory.record.files == ["a.nc"]


def test_differences_name_keys_and_files():
    other = record(
        scene={"a": {"b": 2.0, "c": "x"}, "release": [{"time": 0.0}, {"time": 3.0}]}, inputs={"dem.tif": "2"}
    )
    assert record().differences(other) == [
        "a.b was 1.0, is 2.0", "release 2.time was 2.0, is 3.0", "a.c was 'not set', is 'x'",
        "the file dem.tif changed",
    ]  # fmt: skip
    assert record().differences(other, ("a.b", "a.c", "release 2.time")) == ["the file dem.tif changed"]


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "cannot read"), ("[]", "no record of a run"), ('{"format": 99}', "format 99, needed 1"),
        ('{"format": 1, "scene": 3}', "no whole record of a run: scene is 3"), ("[" * 100000, "cannot read"),
        ("\x00", "cannot read"),
    ],
)  # fmt: skip
def test_a_record_that_cannot_be_read_is_an_error_of_input(tmp_path, text, reason):
    (tmp_path / "run.json").write_text(text)
    with pytest.raises(InputError, match=reason):
        OutputDirectory(tmp_path)


def test_a_record_comes_back(tmp_path):
    one = record(files=["a"], budget={"released": 0.1}, scene_file="../x.yaml")
    one.write(tmp_path / "run.json")
    assert RunRecord.read(tmp_path / "run.json") == one
    assert "written" in json.loads((tmp_path / "run.json").read_text())
