"""What the README says is what the package does."""

import re
from pathlib import Path

import pytest

from landlab_debrisflow.core.variables import NODE_FIELDS

README = (Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8")


def test_example_runs(tmp_path, monkeypatch, capsys):
    code = re.search(r"```python\n(.*?)```", README, re.DOTALL).group(1)
    assert len([line for line in code.splitlines() if line.strip()]) <= 22
    monkeypatch.chdir(tmp_path)
    exec(compile(code, "README.md", "exec"), {})
    budget = eval(capsys.readouterr().out)
    assert budget["eroded"] > 0.0
    assert budget["moving"] == 0.0
    assert (tmp_path / "first_flow.nc").stat().st_size > 0


def test_inflow_as_printed():
    first, inflow = re.findall(r"```python\n(.*?)```", README, re.DOTALL)[:2]
    names = {}
    exec(compile(first.split("flow = DebrisFlow(")[0] + inflow, "README.md", "exec"), names)
    names["flow"].run_one_step(60.0)
    assert names["flow"].budget["inflow"] == pytest.approx(0.5 * 80.0 * 60.0, rel=1e-14)


def test_laws_as_printed():
    blocks = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
    (laws,) = [block for block in blocks if "two_phase" in block]
    names = {}
    exec(compile(blocks[0].split("flow = DebrisFlow(")[0], "README.md", "exec"), names)
    names["grid"].add_full("friction__angle", 31.0, at="node")
    exec(compile("from landlab_debrisflow import DebrisFlow\n" + laws, "README.md", "exec"), names)
    names["flow"].run_one_step(2.0)
    assert names["grid"].at_node["bed__excess_pore_pressure"].max() > 0.0
    assert names["flow"].budget_by_phase["water"]["eroded"] > 0.0


def test_table_of_fields_is_complete_and_true():
    rows = re.findall(r"^\| `(\w+)` \| ([\w, ]+) \| (\S+) \|", README, re.MULTILINE)
    declared = [(f.name, f.intent + (", optional" if f.optional else ""), f.unit) for f in NODE_FIELDS]
    assert sorted(rows) == sorted(declared)


@pytest.mark.parametrize("page", ["README.md", "CONTRIBUTING.md", "docs/laws.md"])
def test_links_to_files_lead_somewhere(page):
    path = Path(__file__).parents[1] / page
    targets = re.findall(r"\]\((?!https?:)([^)#]+)\)", path.read_text(encoding="utf-8"))
    assert targets and [target for target in targets if not (path.parent / target).exists()] == []
