"""Figures, texts and tables of the documentation are made of committed result files."""

import importlib
import itertools
import json
import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from PIL import Image

from benchmarks import charts, page_tables, result_files
from benchmarks.fidelity import runs
from validation.events import EVENTS

ROOT = Path(__file__).parents[2]
FAST = ("flow_stability", "lazy_scheme", "speed", "two_phase")
"""Figures that are drawn in the fast subset."""

SMALL = 130_000
"""Most bytes of a result file."""


def test_every_figure_of_the_pages_has_a_chart():
    drawn = sorted([*charts.CHARTS, *charts.RUNS])
    assert drawn == sorted(path.stem for path in (ROOT / "docs" / "figures").glob("*.png"))
    assert list((ROOT / "docs").glob("*.png")) == []


@pytest.mark.parametrize("name", charts.CHARTS)
def test_a_chart_has_its_files_and_its_function(name):
    chart = charts.CHARTS[name]
    assert [path for path in chart.files() if not path.is_file()] == []
    if isinstance(chart, charts.EventChart):
        assert chart.command == f"python -m validation.events {chart.module}" and chart.module in EVENTS
        return
    module = importlib.import_module(f"benchmarks.{chart.module}")
    assert callable(getattr(module, chart.function))
    command = re.fullmatch(r"python -m (benchmarks\.\w+)( .*)?", chart.command)
    assert importlib.util.find_spec(command[1]) is not None
    for path in chart.files():
        if path.parent == result_files.FOLDER:
            assert result_files.measured(path.stem)["command"].startswith(f"python -m {command[1]}")


def test_a_large_figure_is_written_with_256_colours(tmp_path):
    grey = np.random.default_rng(1).integers(0, 255, (400, 400, 3), dtype=np.uint8)
    for name, pixels, mode in (("large", grey, "P"), ("small", grey[:20, :20], "RGB")):
        Image.fromarray(pixels).save(tmp_path / f"{name}.png")
        charts.reduce_colours(tmp_path / f"{name}.png")
        with Image.open(tmp_path / f"{name}.png") as image:
            assert image.mode == mode and image.size == pixels.shape[1::-1]
    assert (tmp_path / "large.png").stat().st_size < 200_000 < charts.LARGE


def test_every_result_is_used_small_and_says_where_it_comes_from():
    used = {path for chart in charts.CHARTS.values() for path in chart.files()}
    used |= {result_files.path_of(name) for name in (*page_tables.SOURCES, *charts.REPORTS, "two_phase_errors")}
    kept = set(result_files.FOLDER.iterdir())
    assert kept - used == set()
    for path in kept:
        assert path.stat().st_size < SMALL, path
        told = result_files.measured(path.stem)
        assert {"command", "date", "version", "commit", "cores", "processor"} <= set(told), path
        assert re.fullmatch(r"\d{4}-\d{2}-\d{2}", told["date"])
        assert "dirty" not in told["commit"]


@pytest.mark.parametrize(
    "name", [name if name in FAST else pytest.param(name, marks=pytest.mark.slow) for name in charts.CHARTS]
)
def test_a_chart_is_drawn_from_its_files(name):
    if reason := charts.CHARTS[name].absence():
        pytest.skip(reason)
    figure = charts.CHARTS[name].draw()
    assert [axes for axes in figure.axes if axes.has_data()]
    for axes in figure.axes:
        assert not any(re.search(r"\bnan\b|None", text.get_text()) for text in axes.texts)


def words(text):
    """Return words and numbers, without lines of boxes, which differ between versions of rich."""
    return re.findall(r"[^\s─-╿]+", text)


@pytest.mark.parametrize("name", charts.REPORTS)
def test_a_text_is_that_of_its_result(name):
    text = (ROOT / "benchmarks" / f"{name}.txt").read_text(encoding="utf-8")
    assert words(importlib.import_module(f"benchmarks.{charts.REPORTS[name]}").report()) == words(text)


@pytest.mark.parametrize("page", page_tables.PAGES, ids=lambda page: page.name)
def test_tables_of_a_page_are_those_of_the_results(page):
    text = page.read_text(encoding="utf-8")
    assert page_tables.filled(text) == text
    assert "<!-- table" not in page_tables.MARKED.sub("", text)


def test_every_table_is_on_a_page():
    marked = [re.findall("<!-- table (\\w+) -->", page.read_text(encoding="utf-8")) for page in page_tables.PAGES]
    assert sorted(itertools.chain(*marked)) == sorted(page_tables.TABLES)


def test_a_changed_number_is_written_again():
    page = page_tables.PAGES[0].read_text(encoding="utf-8")
    number = re.search(r"\| (\d+\.\d+) ", page)[1]
    assert page_tables.filled(page.replace(f"| {number} ", "| 123.4 ")) == page


def test_numbers_are_kept_and_read(tmp_path, monkeypatch):
    monkeypatch.setattr(result_files, "FOLDER", tmp_path)
    rows = [{"name": "ü < 1", "values": np.array([1.0 / 3.0, np.nan])}, {"name": "", "values": np.arange(2)}]
    result_files.keep("some", {"rows": rows, "one": np.float32(2.0)}, "python -m benchmarks.some")
    found = result_files.read("some")
    assert found["measured"]["command"] == "python -m benchmarks.some" and found["measured"]["cores"] >= 1
    assert found["rows"][0]["name"] == "ü < 1" and found["rows"][1]["values"] == [0, 1] and found["one"] == 2.0
    np.testing.assert_allclose(found["rows"][0]["values"], [0.333333, np.nan], rtol=1e-12)
    json.loads((tmp_path / "some.json").read_text(encoding="utf-8"), parse_constant=pytest.fail)  # no bare NaN


def test_arrays_are_kept_within_their_steps_and_read(tmp_path, monkeypatch):
    monkeypatch.setattr(result_files, "FOLDER", tmp_path)
    values = np.array([0.12345, -3.0, np.nan])
    dataset = xr.Dataset({"rough": ("x", values), "exact": ("x", values)})
    result_files.keep_dataset("some", dataset, "python -m benchmarks.some", {"rough": 0.01})
    found = result_files.read_dataset("some")
    np.testing.assert_allclose(found.rough, values, atol=0.00501)
    np.testing.assert_array_equal(found.exact, values)
    assert result_files.measured("some")["command"] == "python -m benchmarks.some"


def test_an_unknown_figure_is_asked_back(capsys):
    with pytest.raises(SystemExit):
        charts.main(["flw"])
    assert "there is no figure 'flw' (did you mean 'flow'?)" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        charts.main(["--measure"])
    assert "name what is to be measured" in capsys.readouterr().err


def test_stored_runs_of_plans_are_of_their_labels():
    for label in ("after", "before"):
        first = (runs.RESULTS / f"{label}.jsonl").read_text(encoding="utf-8").splitlines()[0]
        assert json.loads(first)["label"] == label
