"""A cell that raises fails the build, one that is meant to does not, and a command is one of this checkout."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
HEAD = "---\nfile_format: mystnb\nkernelspec:\n  name: python3\n---\n\n# Page\n\n"
MEANT = ":tags: [raises-exception]\n\n"


def cell(code):
    return f"```{{code-cell}} ipython3\n{code}\n```\n\n"


@pytest.fixture
def build(tmp_path):
    """Return a function that builds a site of one page, and returns the run and the text of the page or of the log."""

    def run(*cells):
        source, site = tmp_path / "source", tmp_path / "site"
        source.mkdir()
        (source / "index.md").write_text(HEAD + "".join(map(cell, cells)), encoding="utf-8")
        command = [sys.executable, "-m", "sphinx", "-q", "-c", str(ROOT / "docs"), "-D", "extensions=myst_nb,cells"]
        run = subprocess.run(
            [*command, str(source), str(site)],
            capture_output=True,
            text=True,
            cwd=tmp_path,
            env=os.environ | {"TMPDIR": str(tmp_path)},
        )
        pages = [site / "index.html", *tmp_path.glob("sphinx-err*.log")]
        return run, "".join(page.read_text(encoding="utf-8") for page in pages if page.exists())

    return run


@pytest.mark.slow
def test_what_is_meant_to_go_wrong_is_shown(build):
    run, page = build(
        MEANT + "1 / 0",
        MEANT + "!landlab-debrisflow run nothing.yaml",
        "import warnings\n\nwarnings.warn('dubious')\nsorted(p.name for p in __import__('pathlib').Path().iterdir())",
    )
    assert run.returncode == 0, run.stderr
    assert "ZeroDivisionError" in page and "nothing.yaml" in page and "UserWarning: dubious" in page
    assert "Traceback" not in page and "CommandFailedError" not in page
    for name in ("benchmarks", "docs", "examples"):
        assert name in page


@pytest.mark.slow
def test_a_command_that_fails_fails_the_build(build):
    run, log = build("!exit 3")
    assert run.returncode != 0 and "!exit 3" in log
