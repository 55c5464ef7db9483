"""Nothing is doubted in examples and notebooks; README is run as it is in test_readme.py, benchmarks in a folder."""

import itertools
import json
from pathlib import Path

import pytest
from rich.console import Console

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.cli import demo
from landlab_debrisflow.scene.tsing_shan import tsing_shan_valley

from .suspicions import BuiltError, built
from .test_examples import load, write_rasters

pytestmark = pytest.mark.usefixtures("only_built", "no_doubts")
ROOT = Path(__file__).parents[1]


def test_a_doubt_would_be_noticed(slope, no_doubts):
    built(DebrisFlow(slope, material={"solid_density": 2.65, "water_density": 0.0}).run_one_step, 1.0)
    assert len(no_doubts) == 1
    no_doubts.clear()


# ---- examples and notebooks ----


@pytest.mark.slow
def test_demo(tmp_path):
    built(demo.run_demo, 100, tmp_path, Console(quiet=True))


@pytest.mark.slow
def test_obstacles():
    example = load("obstacle")
    built(example.main)
    for dam in (False, True):
        built(DebrisFlow(example.terrain(dam), friction="voellmy", erosion="none").run_until_rest)


@pytest.mark.slow
def test_landscape(monkeypatch):
    example = load("landscape")
    monkeypatch.setitem(example.SLOPE_STRENGTH, "soil__internal_friction_angle", 34.0)
    built(example.main, years=5, rows=60, columns=60)


@pytest.mark.slow
def test_tsing_shan():
    example = load("tsing_shan")
    for c_v, model in itertools.product(example.CONSOLIDATION, example.COLUMNS):
        built(example.run, tsing_shan_valley(**example.VALLEY), model, c_v, 100)


@pytest.mark.slow
def test_s1000(tmp_path):
    write_rasters(tmp_path)
    example = load("s1000")
    built(example.main, tmp_path, output_dir=tmp_path)
    for friction in example.FRICTION.values():
        built(example.warm_up, tmp_path, friction)


NOTEBOOKS = [path for path in sorted((ROOT / "notebooks").glob("*.ipynb")) if "DebrisFlow(" in path.read_text("utf-8")]


@pytest.mark.slow
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks(path):
    """Every cell, except cells that read the results of a flow."""
    names, flows = {}, 0
    for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
        code = "".join(line for line in cell["source"] if not line.startswith("%"))
        if cell["cell_type"] != "code" or "solve_column(" in code:
            continue
        try:
            exec(compile(code, path.name, "exec"), names)
        except BuiltError:
            flows += 1
        except Exception:
            assert flows > 0, code
    names["plt"].close("all")
    assert flows > 0
