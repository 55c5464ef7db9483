"""Runs that are not finished, of another version, or damaged: reported as such, or refused with what to do."""

import json
import shutil

import pytest

from landlab_debrisflow.cli import exit_codes, main
from landlab_debrisflow.core.errors import InputError
from landlab_debrisflow.report import write_report
from landlab_debrisflow.run.directory import OutputDirectory
from landlab_debrisflow.run.record import RunRecord
from landlab_debrisflow.run.remarks import remarks
from landlab_debrisflow.run.results import Results
from landlab_debrisflow.run.scene import Scene

from .conftest import SCENE
from .reading import read_page


@pytest.fixture
def begun(tmp_path):
    """Directory of a run that has begun."""
    scene = Scene.from_mapping(SCENE, tmp_path, name="begun")
    with OutputDirectory.claimed(scene.output_directory) as directory:
        directory.begin(RunRecord.of(scene))
        directory.note(**remarks(scene))
    return scene.output_directory


def change(directory, **changes):
    """Change the record in a directory; None takes a key out."""
    path = directory / "run.json"
    record = json.loads(path.read_text()) | changes
    path.write_text(json.dumps({name: value for name, value in record.items() if value is not None}))


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({}, "This run is still running, or was ended from outside. There are no results yet"),
        ({"state": "interrupted", "elapsed_time": 4.5}, "This run was interrupted at 4.5 s. There are no results yet"),
        (
            {"state": "failed", "reason": "OSError: <full>"},
            "This run failed. The reason: OSError: <full>. There are no",
        ),
    ],
)
def test_an_unfinished_run_is_reported_as_such(begun, changes, words):
    change(begun, **changes)
    read = read_page(write_report(begun))
    (alert,) = [text for _, given, text in read.elements if given.get("class") == "alert"]
    assert alert.startswith(words) and "run --overwrite begins it anew" in alert
    assert "Summary" not in read.texts("h2") and next(
        row[:3] for row in read.table("friction: voellmy") if row[0].startswith("turb")
    ) == ["turbulent_coefficient", "300 m/s²", "given"]
    (begun / "checkpoint.nc").write_text("a checkpoint")
    assert "resume goes on with it" in write_report(begun).read_text()


def test_a_record_of_the_version_before_is_read(begun):
    kept_now = ("given", "notes", "doubts", "warnings", "environment", "statement")
    change(begun, format=1, version="0.0.9", **dict.fromkeys(kept_now))
    read = read_page(write_report(begun))
    words = " ".join(read.texts("p"))
    assert words.count("The version that made the run did not keep these.") >= 3
    assert {row[0]: row[2] for row in read.table("friction: voellmy")}["cohesion"] == "default"  # by its value
    assert {row[0]: row[2] for row in read.table("friction: voellmy")}["turbulent_coefficient"] == "not known"
    assert dict(read.table("The run"))["package"] == "landlab_debrisflow 0.0.9"


def test_doubts_of_check_are_told(begun):
    change(begun, doubts=["friction: basal_friction_angle is 0.5 deg"], warnings=[])
    assert "friction: basal_friction_angle is 0.5 deg" in read_page(write_report(begun)).texts("li")


@pytest.mark.parametrize(
    ("changes", "words"), [({"format": 9}, "format 9, needed 1 to 2"), ({"warnings": "x"}, "warnings is 'x'")]
)
def test_another_version_and_no_whole_record_are_refused(begun, changes, words):
    change(begun, **changes)
    with pytest.raises(InputError, match=words):
        write_report(begun)


@pytest.mark.parametrize("content", [b"", b"no map", b"\x89HDF\r\n\x1a\n" + bytes(500)])
def test_damaged_maps_are_named(begun, content):
    change(begun, state="finished")
    (begun / "maps.nc").write_bytes(content)
    with pytest.raises(InputError, match=r"cannot read .*maps.nc: .*; the file is damaged, run the scene anew"):
        write_report(begun)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["gauges.nc", "exposure.csv"])
def test_other_damaged_files_are_named(results, name, tmp_path):
    folder = tmp_path / "damaged"
    shutil.copytree(results.directory, folder)
    (folder / name).write_bytes(b"\x89HDF" if name.endswith("nc") else b"\n")
    with pytest.raises(InputError, match=rf"{name}.*the file is damaged, run the scene anew"):
        write_report(folder)


def test_lost_maps_are_named(begun):
    change(begun, state="finished")
    with pytest.raises(InputError, match=r"holds no maps.nc: .* run the scene anew with --overwrite"):
        write_report(begun)


def test_a_page_that_cannot_be_written(begun, tmp_path):
    with pytest.raises(InputError, match="does not exist; create it first"):
        write_report(begun, tmp_path / "no" / "report.html")
    with pytest.raises(InputError, match="it is a directory"):
        write_report(begun, tmp_path)
    with pytest.raises(InputError, match=r"run.json is missing; give the directory of a scene"):
        write_report(tmp_path)


def test_the_page_goes_with_the_results(begun):
    write_report(begun)
    with OutputDirectory.claimed(begun) as directory:
        directory.remove_results()
        assert not list(begun.glob("[!.]*"))


def test_the_command_says_where_the_page_is(begun, tmp_path, capsys):
    assert main.main(["report", str(begun)]) == exit_codes.DONE
    assert capsys.readouterr().out == f"wrote {begun / 'report.html'}\n"
    assert main.main(["report", str(begun), "--output", str(tmp_path / "x.html")]) == exit_codes.DONE
    assert (tmp_path / "x.html").stat().st_size > 5000
    assert main.main(["report", str(tmp_path)]) == exit_codes.USER_ERROR
    assert repr(Results(begun)).startswith("Results in")
