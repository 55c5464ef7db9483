"""The page about landslide components is true: its code runs, its numbers are those of the benchmark."""

import contextlib
import io
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAGE = (ROOT / "docs" / "which_component.md").read_text(encoding="utf-8")
TABLE = (ROOT / "benchmarks" / "which_component.txt").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
NAMES = "BedrockLandslider", "LandslideProbability", "MassWastingRunout", "DebrisFlow"


@pytest.mark.slow
def test_the_code_runs_as_printed():
    names, outputs = {}, []
    for block in BLOCKS:
        with contextlib.redirect_stdout(io.StringIO()) as out:
            exec(compile(block, "which_component.md", "exec"), names)
        outputs.append(out.getvalue())
        if "release_probable_sites(" in block:
            assert (
                names["flow"].budget["released"] == pytest.approx(names["volume"], rel=1e-12)
                and names["volume"] > 500.0
            )
    _, landslides, likely, _, event, _, _ = outputs
    assert int(landslides.split()[0]) > 0 and int(likely.split()[0]) > 0 and int(event.split()[0]) > 1000
    assert abs(names["run_out"].at_node["soil__thickness"] - 1.0).max() > 0.1
    assert names["flow"].budget["released"] > 0.0  # of rock


def test_times_are_those_that_the_command_printed():
    (row,) = re.findall(r"^\| example, CPU time \[s\] \|(.*)\|$", PAGE, re.MULTILINE)
    printed = {name: re.search(rf"{name} +│ .*? │ +([\d.]+) │", TABLE)[1] for name in NAMES}
    assert [cell.strip() for cell in row.split("|")] == [printed[name] for name in NAMES]
    rows, columns = re.search(r"^(\d+) x (\d+) nodes", TABLE).groups()
    assert f"{rows} × {columns} nodes" in PAGE


def test_components_of_the_head_have_their_section():
    assert re.findall(r"^### (\w+)$", PAGE, re.MULTILINE) == list(NAMES)
    assert all(f"[{name}](#{name.lower()})" in PAGE for name in NAMES)


def test_links_to_files_lead_somewhere():
    targets = re.findall(r"\]\((?!https?:)([^)#]+)(?:#[\w-]+)?\)", PAGE)
    assert targets and [target for target in targets if not (ROOT / "docs" / target).exists()] == []
