"""What the README says is what the package does."""

import contextlib
import io
import re
from pathlib import Path

import pytest

from .suspicions import suspicions

README = (Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8")


BLOCKS = re.findall(r"```python\n(.*?)```", README, re.DOTALL)


@pytest.fixture(scope="module")
def read_through(tmp_path_factory):
    """Run all code as it is printed, from top to bottom as a reader would; return names, output and files of each."""
    folder, names, seen = tmp_path_factory.mktemp("readme"), {}, []
    with contextlib.chdir(folder), suspicions() as doubts:
        for block in BLOCKS:
            with contextlib.redirect_stdout(io.StringIO()) as out:
                exec(compile(block, "README.md", "exec"), names)
            seen.append((dict(names), out.getvalue()))
    assert doubts == []
    return seen, folder


def test_there_are_four_blocks_of_code():
    assert len(BLOCKS) == 4
    assert len([line for line in BLOCKS[0].splitlines() if line.strip()]) <= 22


@pytest.mark.slow
def test_first_flow_as_printed(read_through):
    seen, folder = read_through
    budget = eval(seen[0][1])
    assert budget["eroded"] > 0.0 and budget["moving"] == budget["residual"] == 0.0
    assert budget["outflow"] < 0.01 * budget["deposited"]  # the first thing a reader sees ends on its DEM
    assert (folder / "first_flow.nc").stat().st_size > 0


def test_inflow_as_printed(read_through):
    names, out = read_through[0][1]
    assert float(out) == pytest.approx(0.5 * 80.0 * 60.0, rel=1e-14)
    assert f"# {out.strip()}, the integral" in BLOCKS[1]
    assert names["flow"].budget["eroded"] > 0.0


def test_column_as_printed(read_through):
    *_, (_, out), _ = read_through[0]
    assert f"# {out.strip()}: most of the pressure" in BLOCKS[2]


def test_laws_as_printed(read_through):
    names, out = read_through[0][-1]
    assert names["grid"].at_node["bed__excess_pore_pressure"].max() > 0.0
    assert names["flow"].budget_by_phase["water"]["eroded"] > 0.0
    assert out.startswith("DebrisFlow: moving at 10 s") and "flow two_phase, friction coulomb" in out


@pytest.mark.parametrize("page", ["README.md", "CONTRIBUTING.md", "docs/laws.md"])
def test_links_to_files_lead_somewhere(page):
    path = Path(__file__).parents[1] / page
    targets = re.findall(r"\]\((?!https?:)([^)#]+)\)", path.read_text(encoding="utf-8"))
    assert targets and [target for target in targets if not (path.parent / target).exists()] == []
