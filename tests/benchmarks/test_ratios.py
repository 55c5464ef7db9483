"""The comparison with other versions: scenes that any version runs, turns, and ratios."""

import argparse
import dataclasses
import importlib
import io
import json
import sys

import numpy as np
import pytest

from benchmarks import ratio_rows, ratio_scenes, ratio_turns, ratios
from benchmarks.speed_against import Side
from landlab_debrisflow.laws import LAWS
from landlab_debrisflow.model import step

FOUND = {name: [1.0, 2.0, 3.0] for name in ("run_out", "eroded", "end", "steps")}


@pytest.fixture
def grounds(tmp_path, monkeypatch):
    """Folder of grounds, as the program of scenes is given it."""
    ratio_turns.write_grounds(tmp_path)
    monkeypatch.setattr(sys, "argv", ["ratio_scenes.py", str(tmp_path)])
    return tmp_path


def test_a_scene_counts_its_steps_and_times_its_sums():
    advance = step.advance
    found = ratio_scenes.cap(count=100, duration=0.1)
    assert found["steps"] > 0 and found["particle_steps"] == 100 * found["steps"]
    assert 0.0 < found["sums"] < found["cpu"]
    assert step.advance is advance  # nothing stays patched


def test_the_names_of_sums_exist_in_this_version():
    present = [hasattr(importlib.import_module(place), name) for place, name in ratio_scenes.SUMS]
    assert any(present)


def test_laws_and_material_of_scenes_are_written_out(grounds):
    flow = ratio_scenes.valley_of(50)
    setup = flow.setup
    written = {"friction": ratio_scenes.COULOMB, "column": ratio_scenes.ALE, "material": ratio_scenes.MATERIAL}
    left = {"column": {"dilatancy"}, "material": {"bed_degree_of_saturation", "bed_drainage_time"}}
    for kind, numbers in written.items():
        declared = {field.name for field in dataclasses.fields(getattr(setup, kind))}
        assert declared - set(numbers) == left.get(kind, set())  # what older versions do not know, or is switched off
    assert {law["law"] for law in (ratio_scenes.COULOMB, ratio_scenes.VOELLMY)} <= set(LAWS["friction"])


def test_a_ground_is_read_as_it_was_written(grounds):
    from landlab_debrisflow.scene import tsing_shan_valley

    written, read = tsing_shan_valley(), ratio_scenes.grid_of("valley")
    for field in ratio_turns.FIELDS:
        np.testing.assert_array_equal(read.at_node[field], written.at_node[field])
    assert read.shape == written.shape and (read.status_at_node == written.status_at_node).all()


def test_every_request_is_of_a_scene_and_its_keywords():
    for work in [*ratio_rows.works(), ratio_rows.THREADS, ratio_rows.peer_work(100, (1, 1))]:
        name, keywords = json.loads(work.request())
        code = ratio_scenes.SCENES[name].__code__
        assert set(keywords) <= set(code.co_varnames[: code.co_argcount])


def test_rows_are_taken_from_what_scenes_answer():
    found = ratio_scenes.measured(lambda: None) | {"start": 1e-4, "ratio": 3.0, "called": 9.0, "made": 8.0, "own": 1.0}
    for work in ratio_rows.works():
        many = {"cpu": [1.0, 2.0], "steps": [3, 4]} if work.function == "s1000" else {"sums": 1.0}
        assert all(np.isfinite(row.value(found | many)) for row in work.rows)


def test_ratios_of_com1dfa_are_taken_within_a_turn():
    task = ratio_turns.Task(ratio_rows.peer_work(100, (1, 1)), None, "PYTHON")
    assert task.values(task.work.rows[0], [8.0, 4.0, 2.0]) == [4.0, 2.0]


def test_a_spread_is_that_of_a_sample():
    found = ratio_turns.outcome("voellmy", "old", FOUND)
    assert found["run_out"] == 2.0 and found["eroded, deviation"] == 1.0


def test_a_process_is_asked_and_answers(tmp_path):
    program = tmp_path / "echo.py"
    program.write_text("import sys\nfor line in sys.stdin:\n    print(sys.argv[1], line.strip(), flush=True)\n")
    side = Side(sys.executable, "", str(tmp_path))
    side.begin(str(program), "heard")
    answer = side.ask("question")
    side.end()
    assert answer == "heard question\n"


def test_requests_are_answered_by_name(monkeypatch, capsys):
    monkeypatch.setattr(sys, "stdin", io.StringIO('["twice", {"x": 2}]\n'))
    ratio_scenes.answer({"twice": lambda x: {"found": 2 * x}})
    assert json.loads(capsys.readouterr().out) == {"found": 4}


def test_a_revision_is_named():
    assert ratio_turns.named_version("1.0=/some/python") == ("1.0", "/some/python")
    with pytest.raises(argparse.ArgumentTypeError, match="write NAME=PATH, got '/some/python'"):
        ratio_turns.named_version("/some/python")


def test_rows_are_shown(capsys):
    from rich.console import Console

    row = ratio_turns.compared(ratio_rows.Row("a rate", "M/s", rate=True), ["old"], [[2.0, 1.0]])
    outcome = ratio_turns.outcome("voellmy", "old", FOUND)
    ratios.show({"revisions": ["old"], "rows": [row], "S-1000": [outcome]}, Console(width=140))
    text = capsys.readouterr().out
    assert "a rate (rate)" in text and "2.000 (2.000 to 2.000)" in text and "2 ± 1" in text
    assert ratios.speed_up(row, "old") == [2.0, 2.0, 2.0]
