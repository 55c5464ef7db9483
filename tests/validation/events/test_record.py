"""Scores are kept and never lost, tables of the page are those of the records, figures need no data."""

import json
import subprocess
from types import SimpleNamespace

import numpy as np
import pytest

from landlab_debrisflow import InputError
from landlab_debrisflow.calibration.agreement import correlation, csi
from validation import events
from validation.events import EVENTS, data, find_event, page, record, scores
from validation.events.sets import Commit


def kept(folder, values, change="", particles=100):
    parameters = SimpleNamespace(name="a set", change=change, commit=lambda: Commit("abc1234", "2026-01-01"))
    event = SimpleNamespace(name="e", folder=folder)
    record.add_scores(event, parameters, particles, values, {"observed <ü>": {"csi": np.nan}})


def test_no_score_is_lost_or_repeated(tmp_path):
    for value in (0.5, np.float64(0.25), 0.5, np.nan):
        kept(tmp_path, {"csi": value})
    kept(tmp_path, {"csi": 0.5}, change="angle = 2 deg")
    kept(tmp_path, {"csi": 0.75}, particles=95)
    rows = record.read_scores(tmp_path)
    np.testing.assert_array_equal([row["scores"]["csi"] for row in rows], [0.5, 0.25, np.nan, 0.5, 0.75])
    assert rows[0]["commit"] == "abc1234" and rows[0]["committed"] == "2026-01-01"
    assert record.latest(rows, "a set", 95)["scores"]["csi"] == 0.75
    assert record.latest(rows, "a set", 100, "angle = 2 deg")["scores"]["csi"] == 0.5
    assert record.latest(rows, "other", 100) is None
    assert list(record.read_references(tmp_path)) == ["observed <ü>"]
    json.loads((tmp_path / "scores.json").read_text(encoding="utf-8"), parse_constant=pytest.fail)


def test_a_damaged_record_is_not_written_over(tmp_path):
    (tmp_path / "scores.json").write_text("{", encoding="utf-8")
    with pytest.raises(InputError, match="take it back from Git"):
        kept(tmp_path, {"csi": 0.5})
    assert (tmp_path / "scores.json").read_text(encoding="utf-8") == "{"


def test_noise_is_the_spread_of_runs_with_nearby_numbers_of_particles(tmp_path):
    for particles, value in ((100, 0.4), (90, 0.5), (95, 0.6), (200, 9.0)):
        kept(tmp_path, {"csi": value}, particles=particles)
    assert record.noise(record.read_scores(tmp_path), "a set", 100)["csi"] == pytest.approx(0.1)
    assert record.noise(record.read_scores(tmp_path), "other", 100) == {}


def test_agreement_by_hand():
    modelled, observed = np.array([1, 1, 1, 0, 0], bool), np.array([1, 0, 0, 1, 0], bool)
    found = [function(modelled, observed) for function in (csi, scores.precision, scores.recall)]
    assert found == [0.25, pytest.approx(1.0 / 3.0), 0.5]
    nothing = np.zeros(5, bool)
    assert np.isnan([csi(nothing, nothing), scores.precision(nothing, observed)]).all()
    assert np.isnan(correlation(np.ones(4), np.arange(4.0)))


def test_absent_data_tell_where_they_were_expected(tmp_path, monkeypatch):
    monkeypatch.setenv("DEBRISFLOW_DATA", str(tmp_path))
    with pytest.raises(InputError, match=f"{tmp_path} has no file s1000/dem.asc; set DEBRISFLOW_DATA"):
        data.find_file("s1000", "dem.asc")
    (tmp_path / "s1000").mkdir()
    (tmp_path / "s1000" / "dem.asc").touch()
    assert data.find_file("s1000", "dem.asc").is_file() and data.absence("s1000", "dem.asc") == ""


def test_tables_of_the_page_are_those_of_the_records():
    text = page.PAGE.read_text(encoding="utf-8")
    assert page.filled(text) == text, "python -m benchmarks.charts writes the page"
    assert "<!-- event" not in page.MARKED.sub("", text)
    assert {kind for _, kind, _, _ in page.MARKED.findall(text)} <= set(page.KINDS)
    for name in EVENTS:
        assert f"figures/event_{name}.png" in text and f"<!-- event scores {name} -->" in text


@pytest.mark.parametrize("name", EVENTS)
def test_an_event_is_complete(name):
    event = find_event(name)
    assert event.name == name and {target.measure for target in event.targets} <= set(event.measures)
    rows = record.read_scores(event.folder)
    shown = record.latest(rows, event.default_set, event.particle_count)
    assert "dirty" not in shown["code"]
    result = record.read_result(event)
    assert result.attrs["set"] == event.default_set and "dirty" not in result.attrs["measured_commit"]
    assert (event.folder / "result.nc").stat().st_size < 130_000


@pytest.mark.slow
@pytest.mark.parametrize("name", EVENTS)
def test_a_figure_needs_no_data(name, monkeypatch):
    monkeypatch.setenv("DEBRISFLOW_DATA", "/nonexistent")
    if find_event(name).drawn_with:  # a licence keeps the observation out of result.nc
        assert "no measured data" in find_event(name).absence()
        return
    assert [axes for axes in events.chart(name).axes if axes.has_data()]


@pytest.mark.slow
def test_every_set_was_committed_before_its_first_score():
    for event in map(find_event, EVENTS):
        scored = {row["set"] for row in record.read_scores(event.folder)}
        for path in sorted(event.read_set().paths[0].parent.glob("*.yaml")):
            if path.stem not in scored:
                continue
            if not (first := git("log", "--diff-filter=A", "--format=%h", "--", str(path)).split()):
                pytest.skip(f"Git knows no commit of {path}: a checkout without history")
            record_then = git("show", f"{first[-1]}:./validation/events/{event.name}/scores.json")
            assert f'"set": "{path.stem}"' not in record_then, path


def git(*arguments):
    """Return the output of Git, empty if it fails: a file that a commit does not have."""
    command = ["git", "-C", str(page.ROOT), *arguments]
    return subprocess.run(command, capture_output=True, text=True).stdout
