"""Command ensemble: what it prints, and with which exit code."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from landlab_debrisflow.cli import exit_codes, main
from landlab_debrisflow.ensemble import EnsembleResults

from .test_scene_commands import SCENE, refused

ENSEMBLE = """\
ensemble:
  vary:
    friction.basal_friction_angle: {truncated_normal: {mean: 28, sd: 2, low: 20, high: 36}}
    release.factor: {choices: [0.5, 1.0, 1.5], probabilities: [0.25, 0.5, 0.25]}
  members: 3
  batch: 2
  thresholds: {max_depth: [0.5]}
"""


@pytest.fixture
def scene(tmp_path, monkeypatch):
    """A scene file with an ensemble in the present directory."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "slope.yaml").write_text(SCENE + ENSEMBLE, encoding="utf-8")
    return "slope.yaml"


def test_members_of_a_scene_are_run(scene, capsys):
    assert main.main(["ensemble", scene, "--workers", "1"]) == exit_codes.DONE
    out, err = capsys.readouterr()
    first, second, third = out.splitlines()
    assert first == "3 of 3 members came to their end" and third == "results in slope_ensemble/members.zarr"
    assert second.startswith("hazard maps in slope_ensemble: hazard.nc and ")
    assert Path("slope_ensemble/probability_of_max_depth_above_0.5_m.tif").exists()
    assert "ensemble: 2 of 3 members done" in err and "ensemble: 3 of 3 members done" in err
    results = EnsembleResults.open("slope_ensemble/members.zarr")
    assert results.done.all() and results.sampling == "latin_hypercube"
    Path(scene).write_text(Path(scene).read_text().replace("max_depth: [0.5]", "max_depth: [1.0]"))
    assert main.main(["ensemble", scene, "--workers", "1", "--quiet"]) == exit_codes.DONE
    assert [path.stem for path in Path("slope_ensemble").glob("probability_of_max_depth_above*.tif")] == [
        "probability_of_max_depth_above_1_m"
    ]
    assert capsys.readouterr() == ("", "")
    line = refused(["ensemble", scene, "--members", "4"], exit_codes.USER_ERROR, capsys)
    assert "slope_ensemble/members.zarr holds another ensemble" in line


@pytest.mark.slow
def test_members_that_fail_are_told(scene, tmp_path, capsys):
    text = (
        (tmp_path / scene).read_text().replace("release.factor", "release.depth").replace("0.5, 1.0, 1.5", "1, 2, 900")
    )
    (tmp_path / scene).write_text(text.replace("members: 3", "sampling: factorial").replace(
        "{truncated_normal: {mean: 28, sd: 2, low: 20, high: 36}}", "[27.5]"
    ))  # fmt: skip
    assert main.main(["ensemble", scene, "--workers", "1"]) == exit_codes.SOME_FAILED
    first, second, *_ = capsys.readouterr().out.splitlines()
    assert first == "2 of 3 members came to their end"
    assert second.startswith("member 2 failed (friction.basal_friction_angle 27.5, release.depth 900")
    assert "InputError: " in second


def test_a_scene_without_an_ensemble_is_told_how(scene, tmp_path, capsys):
    (tmp_path / scene).write_text(SCENE)
    line = refused(["ensemble", scene], exit_codes.USER_ERROR, capsys)
    assert "slope: the scene has no key ensemble; give one, with vary: " in line


def test_errors_name_file_and_line(scene, tmp_path, capsys):
    text = (tmp_path / scene).read_text()
    (tmp_path / scene).write_text(text.replace("basal_friction_angle", "basal_frictn_angle"))
    line = refused(["check", scene], exit_codes.USER_ERROR, capsys)
    assert "slope.yaml line 5: " in line and "did you mean 'friction.basal_friction_angle'" in line
    (tmp_path / scene).write_text(text.replace("members:", "member:"))
    line = refused(["ensemble", scene], exit_codes.USER_ERROR, capsys)
    assert "unknown key 'member' (did you mean 'members'?)" in line


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="Windows has no groups of processes that get Ctrl-C")
def test_ctrl_c_in_a_terminal_ends_workers_in_order(scene, tmp_path):
    """A terminal sends it to all processes of the group."""
    text = (tmp_path / scene).read_text().replace("members: 3", "members: 400")
    (tmp_path / scene).write_text(text.replace("max_duration: 3.0", "max_duration: 30.0"))
    words = [sys.executable, "-m", "landlab_debrisflow.cli.main", "ensemble", scene, "--workers", "2"]
    environment = os.environ | {"PYTHONPATH": str(Path(main.__file__).parents[2])}
    with subprocess.Popen(words, stderr=subprocess.PIPE, text=True, start_new_session=True, env=environment) as run:
        lines = [run.stderr.readline()]
        os.killpg(run.pid, signal.SIGINT)
        lines += run.stderr.readlines()
    assert run.returncode == 130 and "members done" in lines[0]
    assert lines[-1] == "landlab-debrisflow: interrupted\n" and not [line for line in lines if "Traceback" in line]
    assert 2 <= EnsembleResults.open("slope_ensemble/members.zarr").done.sum() < 400


@pytest.mark.slow
def test_check_tells_of_the_ensemble(scene, capsys):
    assert main.main(["check", scene]) == exit_codes.DONE
    assert capsys.readouterr().out.splitlines()[-1] == (
        "ensemble: 3 members, latin_hypercube, of friction.basal_friction_angle, release.factor"
    )


def test_thresholds_that_have_no_map_are_refused_before_the_run(scene, tmp_path, capsys):
    (tmp_path / scene).write_text(SCENE + ENSEMBLE.replace("{max_depth:", "{max_depht:"), encoding="utf-8")
    line = refused(["ensemble", scene], exit_codes.USER_ERROR, capsys)
    assert "slope.yaml" in line and "did you mean 'max_depth'" in line and not Path("slope_ensemble").exists()


def test_places_of_output_are_read_before_the_run(scene, tmp_path, capsys):
    house = SCENE.replace("max_duration: 3.0", "max_duration: 3.0, exposure: {mill: [[-9, -9], [-8, -9], [-8, -8]]}")
    (tmp_path / scene).write_text(house + ENSEMBLE, encoding="utf-8")
    line = refused(["ensemble", scene], exit_codes.USER_ERROR, capsys)
    assert "mill" in line and "wholly outside the DEM" in line and not Path("slope_ensemble").exists()
