"""Words of the pages on parameters, other codes and laws against what their cells and the benchmarks print."""

import contextlib
import io
import re
from pathlib import Path

import numpy as np
import pytest

from landlab_debrisflow.laws import LAWS

ROOT = Path(__file__).parents[2]
CELL = re.compile(r"^```\{code-cell\} ipython3\n((?::tags: [^\n]*\n)?)(.*?)^```", re.MULTILINE | re.DOTALL)
TEXTS = {
    name: (ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8")
    for name in ("parameters", "other_codes", "theory_and_laws")
}


def printed(page, names, *numbers):
    """Run cells of a page, in a namespace, and return what they print."""
    cells = [code for _, code in CELL.findall(TEXTS[page])]
    with contextlib.redirect_stdout(io.StringIO()) as out:
        for number in numbers:
            exec(compile(cells[number], f"docs/{page}.md", "exec"), names)
    return out.getvalue()


@pytest.mark.slow
def test_recipe_gives_the_speeds_of_voellmy_and_its_misuse_is_doubted(caplog):
    names = {}
    out = printed("other_codes", names, 0)
    speeds = np.array(re.findall(r"([\d.]+) m/s here, ([\d.]+) m/s by Voellmy", out), dtype=float)
    # measured 2e-3: edges run into the slab and its thickness is a sum over particles
    assert len(speeds) == 4 and abs(speeds[:, 0] / speeds[:, 1] - 1.0).max() < 1e-2
    assert caplog.text == ""
    printed("other_codes", names, 2)
    assert "was it meant in radians? 0.15 rad" in caplog.text


def test_ratio_of_hydrostatic_pressure_is_nothing():
    ratios = re.findall(r"r = ([\d.]+)", printed("other_codes", {}, 1))
    assert ratios == ["0.00", "0.36", "0.79"]


def test_scene_has_the_angle_of_the_recipe():
    (angle,) = re.findall(r"basal_friction_angle: ([\d.]+),", TEXTS["other_codes"])
    assert float(angle) == pytest.approx(np.degrees(np.arctan(0.15)), abs=5e-3)


def test_friction_of_total_and_of_effective_stress():
    names = {"np": np}
    exec("from landlab_debrisflow import Material", names)
    rows = re.findall(
        r"r = ([\d.]+): mu = 0.15 needs (\d+) deg; 31 deg slide like mu = ([\d.]+)", printed("parameters", names, 2)
    )
    assert [float(ratio) for ratio, *_ in rows] == [0.0, 0.3, 0.5, 0.65]
    assert rows[2][1:] == ("31", "0.15")  # both ways meet at r = 0.5
    assert rows[0][2] == "0.30" and rows[3][2] == "0.10"  # the page on theory quotes the default's


def test_consolidation_of_tsing_shan():
    names = {"np": np}
    exec("from landlab_debrisflow import Material", names)
    assert "c_v = 4.0e-04 m2/s: 0.15 m 56.2 s" in printed("parameters", names, 3)
    assert f"for {0.15**2 / 4e-4:.0f} s" in TEXTS["parameters"]
    (row,) = re.findall(r"0.15 m: .* c_v = ([\d.]+) m2/s, h2/c_v = ([\d.]+) s", printed("parameters", names, 4))
    assert row == ("0.04", "0.6") and "with 0.04 m² s⁻¹" in TEXTS["parameters"] and ", 0.6 s." in TEXTS["parameters"]
    assert np.log(20_000.0 / 2350.0) / 714.0 == pytest.approx(3e-3, rel=1e-3)


@pytest.mark.slow
def test_laws_of_the_page_run():
    names = {}
    out = printed("theory_and_laws", names, 0)
    assert (
        out.startswith("DebrisFlow: moving at 10 s") and "flow two_phase, friction coulomb, erosion shear_excess" in out
    )
    assert names["grid"].at_node["bed__excess_pore_pressure"].max() > 0.0
    assert names["flow"].budget_by_phase["water"]["eroded"] > 0.0


def test_all_laws_are_listed():
    rows = re.findall(r"^\| `(\w+)` \| (.*) \|$", TEXTS["theory_and_laws"], re.MULTILINE)
    assert {kind: re.findall(r"`(\w+)`", laws) for kind, laws in rows} == {kind: [*laws] for kind, laws in LAWS.items()}


def test_loading_as_in_the_table():
    table = (ROOT / "benchmarks" / "when_ale_matters.txt").read_text(encoding="utf-8")
    rows = re.findall(r"^as in the example +(\w+) +0.001 +\S+ +(\d+)", table, re.MULTILINE)
    kept = dict(rows)
    assert f"{kept['overburden']} against {kept['proportional']} m" in " ".join(TEXTS["parameters"].split())
