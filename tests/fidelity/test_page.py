"""The page about choosing is true: its code runs, its constants are those of the code."""

import contextlib
import io
import re
from pathlib import Path

import pytest
from landlab.bmi import wrap_as_bmi

from landlab_debrisflow import DebrisFlow, InputError
from landlab_debrisflow.fidelity import constants
from landlab_debrisflow.model.numerics import QUANTITIES

PAGE = (Path(__file__).parents[2] / "docs" / "choosing.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)

AUTO = """
debris_flow:
    erosion: none
    numerics: {particle_count: auto, tolerance: 0.5}
clock: {start: 0.0, stop: 10.0, step: 5.0}
grid:
    RasterModelGrid:
    - [20, 40]
    - xy_spacing: [5.0, 5.0]
    - fields:
        node:
            topographic__elevation:
                plane:
                - {point: [0.0, 0.0, 0.0], normal: [0.4, 0.0, 1.0]}
"""


@pytest.mark.slow
def test_the_code_runs_as_printed():
    names = {}
    with contextlib.redirect_stdout(io.StringIO()) as out:
        for block in BLOCKS:
            exec(compile(block, "choosing.md", "exec"), names)
    assert "Plan: " in out.getvalue() and "Statement on a run by a plan" in out.getvalue()
    assert names["flow"].at_rest
    DebrisFlow(names["grid"], numerics=names["numerics"])


def test_rules_and_quantities_are_those_of_the_code():
    for number in (
        f"{constants.NO_PRESSURE_RATIO:g}", f"{constants.LEVELS} levels", f"{constants.FINE_LEVELS} where T_c/T",
        f"above {constants.FINE_COLUMN_RATIO:g}", f"{100 * constants.FAST_TOLERANCE:g} % or more",
        ", ".join(map(str, constants.PILOTS[:-1])), f"N^max(s, {constants.LEAST_STEP_ORDER:g})",
    ):  # fmt: skip
        assert number in PAGE
    rows = re.findall(r"^\| `(\w+)` \| .*?(; stated, never promised)? \|$", PAGE, re.MULTILINE)
    assert tuple(name for name, _ in rows) == QUANTITIES
    assert [bool(words) for _, words in rows] == [bool(law.reason) for law in constants.ERROR_LAWS.values()]


@pytest.mark.slow
def test_the_basic_model_interface_asks_for_a_plan():
    model = wrap_as_bmi(DebrisFlow)()
    model.initialize(AUTO)
    with pytest.raises(InputError, match=r"particle_count is 'auto'.*flow.adopt\(flow.plan\(\)\) before"):
        model.update()
