"""The site, built once for all tests of it."""

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="session")
def site(tmp_path_factory):
    """Return the folder of the built site; the variable SITE names one that is built already.

    Of several processes of tests the first one that needs the site builds it, and others wait.
    """
    if "SITE" in os.environ:
        return ROOT / os.environ["SITE"]
    base = tmp_path_factory.getbasetemp()
    base = base.parent if "PYTEST_XDIST_WORKER" in os.environ else base
    folder, told = base / "site" / "html", base / "site.txt"
    try:
        folder.parent.mkdir()
    except FileExistsError:
        while not told.exists():
            time.sleep(0.5)
    else:
        command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-n", "-j", "4", "-q", "docs", str(folder)]
        words, part = "the build was interrupted", told.with_suffix(".part")
        try:
            found = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
            words = "" if found.returncode == 0 else f"the build failed: {found.stderr}"
        finally:
            part.write_text(words)
            part.rename(told)
    assert told.read_text()[-10_000:] == ""
    return folder


@pytest.fixture(scope="session")
def cells(site):
    """Return a function that returns the executed cells of a page: source, text of the output, outputs."""
    import nbformat

    def read(page):
        notebook = nbformat.read(site.parent / "jupyter_execute" / f"{page}.ipynb", as_version=4)
        code = [cell for cell in notebook.cells if cell.cell_type == "code"]
        return [(cell.source, _text(cell.outputs), cell.outputs) for cell in code]

    return read


def _text(outputs):
    """Return what a cell prints; myst-nb has collected each stream in its first part, and left the others."""
    streams, errors = {}, []
    for output in outputs:
        if output.output_type == "stream":
            streams.setdefault(output.name, output.text.replace("\r", ""))
        elif output.output_type == "error":
            errors.append(f"{output.ename}: {output.evalue}\n")
    return "".join([*streams.values(), *errors])
