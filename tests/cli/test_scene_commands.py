"""Commands about scenes: what they print, where, and with which exit code."""

import json
import os
import signal
import subprocess
import sys
import time

import pytest

from landlab_debrisflow import Scene
from landlab_debrisflow.cli import exit_codes, main
from landlab_debrisflow.core.errors import SimulationError
from landlab_debrisflow.record.monitor import Monitor
from landlab_debrisflow.run import runner

RELEASE = "[[400020, 5200145], [400050, 5200145], [400050, 5200170], [400020, 5200170]]"
SCENE = f"""\
terrain: {{example: gully, soil_depth: 2.0}}
release: {{polygons: {RELEASE}, depth: 1.5}}
output: {{max_duration: 3.0}}
numerics: {{particle_count: 60}}
"""


@pytest.fixture
def scene(tmp_path, monkeypatch):
    """A scene file in the present directory."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "slope.yaml").write_text(SCENE, encoding="utf-8")
    return "slope.yaml"


def refused(words, code, capsys):
    """Assert that a command ends with a code and one line; return that line."""
    assert main.main(words) == code
    out, err = capsys.readouterr()
    assert out == ""
    (line,) = err.splitlines()
    assert line.startswith("landlab-debrisflow: ")
    return line


@pytest.mark.slow
def test_run_tells_volumes_and_that_it_still_moves(scene, capsys):
    assert main.main(["run", scene]) == exit_codes.STILL_MOVING
    out, err = capsys.readouterr()
    first, second, third = out.splitlines()
    assert first.startswith("still moving at 3 s: ") and " m3 released, " in first
    assert second == "results in slope_out" and "landlab-debrisflow resume" in third
    assert ", moving " in err  # no terminal: a log
    line = refused(["run", scene], exit_codes.USER_ERROR, capsys)
    assert "--overwrite" in line
    assert main.main(["run", scene, "--overwrite", "--quiet"]) == exit_codes.STILL_MOVING
    assert capsys.readouterr() == ("", "")


@pytest.mark.slow
def test_a_log_gets_what_standard_error_does_not(scene, tmp_path, capsys):
    assert main.main(["run", scene, "--quiet", "--log", "run.log"]) == exit_codes.STILL_MOVING
    assert capsys.readouterr() == ("", "")
    log = (tmp_path / "run.log").read_text(encoding="utf-8")
    assert ", moving " in log and "warning: not at rest after 3 s" in log
    assert "cannot write" in refused(["run", scene, "--log", "no/run.log"], exit_codes.USER_ERROR, capsys)


@pytest.mark.slow
def test_check_forecasts_and_writes_nothing(scene, tmp_path, capsys):
    assert main.main(["check", scene]) == exit_codes.DONE
    out, _ = capsys.readouterr()
    for words in ("61 x 141 nodes of 5 m", "T_c", "T_e", "Pe_b", "steps", "memory", "wall time", "particles"):
        assert words in out
    assert os.listdir(tmp_path) == [scene]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("terain: {example: gully}\n", ("slope.yaml line 1", "did you mean 'terrain'")),
        ("terrain: {elevation: dem.tif}\nrelease: {polygons: x.gpkg}\n", ("dem.tif", "no such file")),
        ("terrain: {example: gully}\n", ("nothing is released",)),
        ('terrain: {"a\\u001b[31m\\nb": 1}\n', ("a\\x1b[31m",)),
        ("", ("slope.yaml",)),
    ],
)
@pytest.mark.parametrize("command", ["run", "check"])
def test_bad_scenes_are_refused_in_one_line_before_anything_is_written(command, text, words, scene, tmp_path, capsys):
    (tmp_path / scene).write_text(text, encoding="utf-8")
    line = refused([command, scene], exit_codes.USER_ERROR, capsys)
    assert all(word in line for word in words) and "\x1b" not in line
    assert os.listdir(tmp_path) == [scene]


def test_files_that_are_not_there(scene, capsys):
    assert "no.yaml" in refused(["run", "no.yaml"], exit_codes.USER_ERROR, capsys)
    assert "holds no run to go on with" in refused(["resume", scene], exit_codes.USER_ERROR, capsys)
    assert "holds no results of a run" in refused(["resume", "."], exit_codes.USER_ERROR, capsys)
    assert "holds no results of a run" in refused(["export", "."], exit_codes.USER_ERROR, capsys)


def test_results_that_cannot_be_written(scene, tmp_path, capsys):
    (tmp_path / "slope_out").write_text("")
    assert "it is a file" in refused(["run", scene], exit_codes.CANNOT_WRITE, capsys)


@pytest.mark.parametrize(
    ("failure", "code", "words"),
    [
        (OSError(28, "No space left on device", "maps.nc"), exit_codes.CANNOT_WRITE, "maps.nc: No space left"),
        (SimulationError("velocity", None, 1.0, float("nan")), exit_codes.DIVERGED, "velocity became nan at 1 s"),
        (KeyboardInterrupt(), 130, "interrupted"),
        (MemoryError(), exit_codes.USER_ERROR, "not enough memory"),
        (ZeroDivisionError("a\nb"), exit_codes.INTERNAL_ERROR, "internal error, ZeroDivisionError: a b"),
    ],
)
def test_failures_have_codes(failure, code, words, capsys, monkeypatch):
    def fail():
        raise failure

    monkeypatch.delenv("LANDLAB_DEBRISFLOW_TRACEBACK", raising=False)
    assert main.exit_code(fail) == code
    assert words in capsys.readouterr().err


def test_a_new_scene_and_its_schema(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main.main(["new", "mine.yaml"]) == exit_codes.DONE
    assert "landlab-debrisflow check mine.yaml" in capsys.readouterr().out
    assert main.main(["schema", "scene.schema.json"]) == exit_codes.DONE
    assert main.main(["schema"]) == exit_codes.DONE
    assert json.loads(capsys.readouterr().out) == json.loads((tmp_path / "scene.schema.json").read_text("utf-8"))
    assert "mine.yaml" in refused(["new", "mine.yaml"], exit_codes.USER_ERROR, capsys)


def test_info_of_one_law(capsys):
    assert main.main(["info", "voellmy"]) == exit_codes.DONE
    out = capsys.readouterr().out
    assert "friction: voellmy" in out and "erosion" not in out.split("\n")[0]
    assert main.main(["info", "material"]) == exit_codes.DONE
    assert "porosity" in capsys.readouterr().out
    assert "did you mean 'voellmy'" in refused(["info", "voelmy"], exit_codes.USER_ERROR, capsys)


def test_help_tells_the_exit_codes(capsys):
    with pytest.raises(SystemExit, match="0"):
        main.main(["run", "--help"])
    assert exit_codes.epilog() in capsys.readouterr().out


def start(*words, interrupt=signal.SIG_DFL):
    command = [sys.executable, "-m", "landlab_debrisflow.cli.main", *words]
    before = signal.signal(signal.SIGINT, interrupt)  # inherited by the process
    try:
        return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    finally:
        signal.signal(signal.SIGINT, before)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_a_run_that_a_signal_ends_is_resumed(number, scene, tmp_path):
    text = SCENE.replace("max_duration: 3.0", "max_duration: 60.0, checkpoint_interval: 0.1").replace("60}", "600}")
    (tmp_path / scene).write_text(text, encoding="utf-8")
    folder = tmp_path / "slope_out"
    # a script lets its background jobs ignore SIGINT: the other signals end them all the same
    interrupt = signal.SIG_DFL if number == signal.SIGINT else signal.SIG_IGN
    with start("run", scene, interrupt=interrupt) as process:
        while process.poll() is None and not (folder / "checkpoint.nc").exists():
            time.sleep(0.01)
        process.send_signal(number)
        _, err = process.communicate()
    if number == signal.SIGKILL:
        assert process.returncode == -number
    else:
        assert process.returncode == 128 + number
        assert err.splitlines()[-1].startswith("landlab-debrisflow: interrupted, at ")
        assert err.splitlines()[-1].endswith("landlab-debrisflow resume slope_out goes on from there")
    assert main.main(["resume", "slope_out", "-q"]) in (exit_codes.DONE, exit_codes.STILL_MOVING)
    resumed = json.loads((folder / "run.json").read_text("utf-8"))
    whole = runner.run_scene(Scene.from_file(tmp_path / scene), overwrite=True, monitor=Monitor(live=False))
    assert resumed["budget"] == whole.budget and resumed["elapsed_time"] == whole.elapsed_time
