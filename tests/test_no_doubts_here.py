"""Nothing is doubted in examples, notebooks and benchmarks; README is run as it is in test_readme.py.

Scenes are built and read as in a run, up to the moment in which particles would be made.
"""

import importlib
import itertools
import json
import sys
from pathlib import Path

import pytest
from rich.console import Console

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.cli import demo
from landlab_debrisflow.model.simulation import Simulation
from landlab_debrisflow.scene.tsing_shan import tsing_shan_valley

from .suspicions import suspicions
from .test_examples import load, write_rasters

ROOT = Path(__file__).parents[1]


class BuiltError(Exception):
    """All that is read before a flow moves has been read."""


@pytest.fixture(autouse=True)
def only_built(monkeypatch):
    def stop(*_):
        raise BuiltError

    monkeypatch.setattr(Simulation, "release", stop)


@pytest.fixture(autouse=True)
def no_doubts():
    with suspicions() as said:
        yield said
    assert said == []


def built(run, *arguments, **keywords):
    """Check that a flow is built and read when something is run."""
    with pytest.raises(BuiltError):
        run(*arguments, **keywords)


def test_a_doubt_would_be_noticed(slope, no_doubts):
    built(DebrisFlow(slope, material={"solid_density": 2.65, "water_density": 0.0}).run_one_step, 1.0)
    assert len(no_doubts) == 1
    no_doubts.clear()


# ---- examples and notebooks ----


def test_demo(tmp_path):
    built(demo.run_demo, 100, tmp_path, Console(quiet=True))


def test_obstacles():
    example = load("obstacle")
    built(example.main)
    for dam in (False, True):
        built(DebrisFlow(example.terrain(dam), friction="voellmy", erosion="none").run_until_rest)


def test_tsing_shan():
    example = load("tsing_shan")
    for c_v, model in itertools.product(example.CONSOLIDATION, example.COLUMNS):
        built(example.run, tsing_shan_valley(**example.VALLEY), model, c_v, 100)


def test_s1000(tmp_path):
    write_rasters(tmp_path)
    example = load("s1000")
    built(example.main, tmp_path, output_dir=tmp_path)
    for friction in example.FRICTION.values():
        built(example.warm_up, tmp_path, friction)


NOTEBOOKS = [path for path in sorted((ROOT / "notebooks").glob("*.ipynb")) if "DebrisFlow(" in path.read_text("utf-8")]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks(path):
    """Every cell, but for those that ask for what a flow has found."""
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


# ---- benchmarks ----


def benchmark(name):
    sys.path.insert(0, str(ROOT / "examples"))
    try:
        return importlib.import_module(f"benchmarks.{name}")
    finally:
        sys.path.remove(str(ROOT / "examples"))


def test_flow():
    flow = benchmark("flow")
    for ours, numbers, *_ in flow.CASES.values():
        built(ours, numbers[0])
    planes, basins, blocks = flow.planes, flow.basins, flow.blocks
    cases = [(planes.cap, 500, degrees) for degrees in (0.0, 15.0, 45.0)] + [(planes.ridge, 24)]
    cases += [(blocks.block, 500, degrees) for degrees in (0.0, 10.0, 16.0, 20.0, 30.0, 45.0, 60.0)]
    cases += [(run, 300) for name, run in vars(blocks).items() if name.endswith(("_block", "_slab"))]
    cases += [(basins.lake_damped, 1000), (basins.lake_rough, 1000), (basins.curved_channel, 500)]
    for run, *arguments in cases:
        built(run, *arguments)


def test_flow_stability(no_doubts):
    """A layer of 100 m on 25 m, there to see what breaks, is doubted as it should be; nothing else is."""
    for name, build in benchmark("flow_stability").cases():
        built(build().run)
        deep = name.startswith("slope of") and name.endswith(", 100 m")
        assert [words.split(",")[0] for words in no_doubts] == ["a release is deeper than it is wide"] * deep, name
        no_doubts.clear()


def test_laws(slope):
    laws = benchmark("laws")
    for keywords in laws.cases().values():
        built(DebrisFlow(slope, **{"material": laws.MATERIAL} | keywords).run_one_step, laws.START)
        slope.at_node["debris_flow__release_depth"][slope.at_node["soil__depth"] < 1.0] = 0.01
        slope.at_node["soil__depth"][:] = 1.0


def test_two_phase():
    two_phase = benchmark("two_phase")
    for name in two_phase.PLACES:
        built(two_phase.strip, name, 40)


def test_when_ale_matters():
    matters = benchmark("when_ale_matters")
    for extent in (matters.WIDE, *matters.VALLEYS.values()):
        terrain = tsing_shan_valley(**{"runout_length": 200.0} | extent)
        built(matters.tsing_shan.run, terrain, "ALE", max(matters.CONSOLIDATION), 100, "none")


def test_speed():
    built(benchmark("speed_engine").valley(100).run_until_rest)
    built(benchmark("speed_grids").valley(nodes=200, offset=0).run_until_rest)


def test_start():
    built(exec, benchmark("start").EVENT, {})


def test_consolidation_of_the_tsing_shan_benchmark():
    tsing_shan = benchmark("tsing_shan")
    for c_v in tsing_shan.CONSOLIDATION:
        built(tsing_shan.compare, c_v, "overburden", 100, (0.5, 0.25))


def test_the_tail_of_s1000(tmp_path):
    write_rasters(tmp_path)
    built(benchmark("s1000_tail").flow_of(tmp_path, "Voellmy").run_until_rest)
