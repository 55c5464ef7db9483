"""The documentation site builds without a warning, with all its pages and notebooks executed, and its links lead on."""

import importlib
import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
MODULES = (
    "",
    ".laws",
    ".record",
    ".plots",
    ".scene",
    ".triggers",
    ".exact",
    ".exact.columns",
    ".exact.dilatancy",
    ".exact.flows",
)
sys.path.append(str(ROOT / "docs" / "_site"))

import links  # noqa: E402  of docs/_site

pytestmark = pytest.mark.slow


def test_links_lead_somewhere(site):
    assert links.broken(site) == []
    assert links.count(site) > 1000


def test_notebooks_are_pages_with_pictures(site):
    for path in sorted((ROOT / "notebooks").glob("*.ipynb")):
        page = (site / "notebooks" / f"{path.stem}.html").read_text(encoding="utf-8")
        assert "cell_output" in page and "<img" in page


def test_no_page_names_a_folder_of_this_machine(site):
    home = re.compile(rf"{re.escape(str(ROOT))}|/tmp/")
    found = {path.name: home.search(path.read_text(encoding="utf-8")) for path in site.rglob("*.html")}
    assert {name: match.group() for name, match in found.items() if match} == {}


@pytest.mark.parametrize("module", MODULES)
def test_public_names_have_an_entry(site, module):
    name = f"landlab_debrisflow{module}"
    page = (site / "api" / f"{name}.html").read_text(encoding="utf-8")
    ids = set(re.findall(r'id="(landlab_debrisflow[\w.]*)"', page))
    top = importlib.import_module("landlab_debrisflow").__all__ if module else ()
    public = [f"{name}.{each}" for each in importlib.import_module(name).__all__ if each not in top]
    rest = [each for each in public if each not in ids]
    assert [each for each in rest if not (site / "api" / f"{each}.html").exists()] == []
