"""The new law that CONTRIBUTING shows works as it says, from outside the package."""

import importlib
import re
import sys
from pathlib import Path

import numpy as np
import pytest
from landlab.bmi import wrap_as_bmi

from landlab_debrisflow import DebrisFlow, ParameterError
from landlab_debrisflow.cli import laws
from landlab_debrisflow.physics.registry import LAWS
from validation.grids import COARSE

CONTRIBUTING = (Path(__file__).parents[1] / "CONTRIBUTING.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```python\n(.*?)```", CONTRIBUTING, re.DOTALL)
LAW, TEST, ARMOURED, ARMOURED_TEST, REGISTER = BLOCKS
TESTS = re.findall(r"^def (test_\w+)", TEST, re.MULTILINE)
(ARMOURED_NAME,) = re.findall(r"^def (test_\w+)", ARMOURED_TEST, re.MULTILINE)


@pytest.fixture
def outside(tmp_path, monkeypatch):
    """Write the blocks into files named as CONTRIBUTING names them, and import them from there."""
    monkeypatch.syspath_prepend(tmp_path)
    files = {
        "excess_shear": LAW, "test_excess_shear": TEST, "armoured": ARMOURED, "test_armoured": ARMOURED_TEST
    }  # fmt: skip
    for name, text in files.items():
        assert f"`{name}.py`" in CONTRIBUTING
        (tmp_path / f"{name}.py").write_text(text, encoding="utf-8")
        monkeypatch.delitem(sys.modules, name, raising=False)
    yield [importlib.import_module(name) for name in files]
    for name in files:
        del sys.modules[name]


@pytest.mark.parametrize("name", TESTS)
def test_its_test_passes(outside, name):
    getattr(outside[1], name)()


@pytest.mark.slow
def test_its_test_can_fail(outside, monkeypatch):
    """Each of the shown tests sees a law that is another one."""
    law, test = outside[:2]
    monkeypatch.setattr(law.ExcessShear, "entrainment_rate", lambda self, state, out: out.fill(1.0))
    for name in ("test_by_hand", "test_soil_that_resists_stays"):
        with pytest.raises(AssertionError):
            getattr(test, name)()


def test_a_law_that_remembers_passes_its_test(outside, monkeypatch):
    shown = getattr(outside[3], ARMOURED_NAME)
    shown()
    monkeypatch.setattr(outside[2].Armoured, "entrainment_rate", lambda self, state, out: out.fill(0.01))
    with pytest.raises(AssertionError):
        shown()


def test_a_variable_that_there_is_already_is_refused(outside, slope, monkeypatch):
    law = outside[2].Armoured
    monkeypatch.setattr(law, "variables", (law.variables[0]._replace(name="volume"),))
    with pytest.raises(ParameterError, match="Armoured: particles already have a variable 'volume'"):
        DebrisFlow(slope, erosion=law())


@pytest.mark.slow
def test_it_is_written_down_in_the_maps(outside, slope):
    law = outside[0].ExcessShear(erodibility="soil__depth", threshold=50.0)
    attributes = DebrisFlow(slope, erosion=law, numerics=COARSE).maps.attrs
    assert (attributes["erosion"], attributes["erosion_law"]) == ("ExcessShear", "excess_shear.ExcessShear")
    assert attributes["erosion_erodibility"] == "soil__depth"
    assert (attributes["erosion_threshold"], attributes["erosion_threshold_units"]) == (50.0, "Pa")


@pytest.mark.slow
def test_a_field_that_is_missing_is_refused(outside, slope):
    with pytest.raises(ValueError, match="erosion: erodibility is to be read from the field 'soil__colour'"):
        DebrisFlow(slope, erosion=outside[0].ExcessShear(erodibility="soil__colour"))


YAML = """
debris_flow:
    erosion: {law: excess_shear, threshold: 20.0}
clock: {start: 0.0, stop: 10.0, step: 2.0}
grid:
    RasterModelGrid:
    - [5, 5]
    - xy_spacing: [5.0, 5.0]
    - fields: {node: {topographic__elevation: {constant: [{value: 0.0}]}}}
"""


@pytest.mark.slow
def test_it_gets_a_name(outside, slope, monkeypatch):
    monkeypatch.setitem(LAWS, "erosion", dict(LAWS["erosion"]))  # back to what it was, afterwards
    with pytest.raises(ParameterError, match="unknown law 'excess_shear'"):
        DebrisFlow(slope, erosion="excess_shear")
    exec(compile(REGISTER, "CONTRIBUTING.md", "exec"), {})
    model = wrap_as_bmi(DebrisFlow)()
    model.initialize(YAML)
    assert model._base.setup.erosion == outside[0].ExcessShear(threshold=20.0)
    page = laws.markdown()
    assert "### erosion: excess_shear" in page and "Source: Partheniades (1965)." in page
    assert "`e_R = k max(0, tau - tau_c), tau = (f/8) rho v^2`" in page


class Undeclared:
    """The least that is a law."""

    def entrainment_rate(self, state, out):
        out[:] = 0.001 * state.speed


@pytest.mark.slow
def test_an_object_with_the_method_will_do(slope):
    flow = DebrisFlow(slope, erosion=Undeclared(), numerics=COARSE)
    flow.run_one_step(5.0)
    assert flow.budget["eroded"] > 0.0 and np.isfinite(flow.budget["eroded"])


def test_the_command_for_the_page_is_the_one_there_is():
    assert f"`{laws.COMMAND}`" in CONTRIBUTING


def test_the_shown_files_are_in_the_style_of_the_project():
    assert max(len(line) for block in BLOCKS for line in block.splitlines()) <= 120
