"""Nothing is doubted in the scenes of the benchmarks."""

import importlib
import sys
from pathlib import Path

import pytest

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.scene.tsing_shan import tsing_shan_valley

from ..suspicions import built
from ..test_examples import write_rasters

pytestmark = pytest.mark.usefixtures("only_built", "no_doubts")
ROOT = Path(__file__).parents[2]


def benchmark(name):
    """Return a module of benchmarks/, which may import examples."""
    sys.path.insert(0, str(ROOT / "examples"))
    try:
        return importlib.import_module(f"benchmarks.{name}")
    finally:
        sys.path.remove(str(ROOT / "examples"))


@pytest.mark.slow
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


@pytest.mark.slow
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
    strips = benchmark("two_phase").strips
    for name in strips.PLACES:
        built(strips.strip, name, 40)


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


def test_which_component():
    which = benchmark("which_component")
    built(which.debris_flow(which.valley()))
