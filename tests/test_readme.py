"""What the README says is what the package does."""

import contextlib
import re
import shutil
from pathlib import Path

import pytest

from .suspicions import suspicions

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
MOST_WORDS = 900
"""More is not read; the rest has pages of its own in docs/."""
BLOCKS = re.findall(r"```python\n(.*?)```", README, re.DOTALL)


def test_it_is_short():
    assert len(README.split()) <= MOST_WORDS
    assert len(BLOCKS) == 1
    assert len([line for line in BLOCKS[0].splitlines() if line.strip()]) <= 12


@pytest.mark.slow
def test_from_a_geotiff_to_a_map_as_printed(tmp_path):
    """The code runs in a copy of the folder that the text names, and leaves the files it promises."""
    assert "in the folder `examples/scenes`" in README
    folder = shutil.copytree(ROOT / "examples" / "scenes", tmp_path / "scenes")
    names = {}
    with contextlib.chdir(folder), suspicions() as doubts:
        exec(compile(BLOCKS[0], "README.md", "exec"), names)
    assert doubts == []
    assert (folder / "max_depth.png").stat().st_size > 10_000
    assert {"max_depth.tif", "max_depth.qml", "maps.nc"} <= {path.name for path in (folder / "scene_out").iterdir()}
    results = names["results"]
    assert results.at_rest
    assert results.budget["outflow"] < 0.01 * results.budget["deposited"]  # the first map a reader sees is complete


def test_first_picture_is_a_real_valley():
    first = re.search(r"!\[([^\]]*)\]\(([^)]+)\)", README)
    assert "observed" in first[1] and "modelled" in first[1]


def test_every_column_of_the_comparison_has_its_source():
    header = next(line for line in README.splitlines() if "D-Claw" in line and line.startswith("|"))
    cited = re.findall(r"\[(\d)\] ", header)
    sources = README.split("Sources:")[1].split("\n\n")[0]
    assert len(cited) == 5
    for number in cited:
        source = sources.split(f"[{number}]")[1].split(f"[{int(number) + 1}]")[0]
        assert "](https://" in source, number
