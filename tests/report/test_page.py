"""A page is whole in itself, obeys no name, and is put together as browsers and readers of screens expect."""

import re
import tomllib
from pathlib import Path

import pytest

import landlab_debrisflow
from landlab_debrisflow.report.blocks import Sentences, Table
from landlab_debrisflow.report.content import Content, Section
from landlab_debrisflow.report.page import render_page

from .conftest import HOUSE, NAME
from .reading import Page, read_page

PACKAGE = Path(landlab_debrisflow.__file__).parent


def rendered(text):
    """Return a small page with a text in all places."""
    blocks = [
        Sentences([text]), Sentences([text], listed=True), Table(caption=text, head=(text, text), rows=[(text, text)]),
    ]  # fmt: skip
    return render_page(
        Content(
            title=text,
            kind=text,
            state=text,
            alert=text,
            summary=Sentences([text]),
            sections=[Section("a", "Of constants", blocks)],
            made=text,
        )
    )


@pytest.mark.parametrize("text", ["<script>alert(1)</script>", '"><img src=x>', "{{ 7 * 7 }}", "a\x1b[31m\u202eb & c"])
def test_texts_are_shown_and_not_obeyed(text):
    page = Page(rendered(text))
    plain = Page(rendered("text"))
    assert [tag for tag, *_ in page.elements] == [tag for tag, *_ in plain.elements]
    assert page.loaded() == plain.loaded()
    assert "49" not in rendered("{{ 7 * 7 }}")
    assert not {"\x1b", "\u202e"} & set(rendered(text))


def test_templates_are_package_data():
    project = tomllib.loads((PACKAGE.parent / "pyproject.toml").read_text(encoding="utf-8"))
    patterns = project["tool"]["setuptools"]["package-data"]["landlab_debrisflow"]
    found = {path for pattern in patterns for path in PACKAGE.glob(pattern)}
    assert {path for path in PACKAGE.rglob("*") if path.suffix in (".html", ".css")} <= found


@pytest.mark.slow
def test_nothing_is_loaded_and_nothing_runs(page):
    read, text = read_page(page), page.read_text(encoding="utf-8")
    assert all(one.startswith(("data:image/", "#")) for one in read.loaded())
    assert not {"script", "link", "iframe", "object", "embed", "form", "base"} & {tag for tag, *_ in read.elements}
    assert not [key for _, given, _ in read.elements for key in given if key.startswith("on") or key == "style"]
    assert "@import" not in text and not re.search(r"url\(", text)
    policy = next(given["content"] for _, given, _ in read.elements if "http-equiv" in given)
    assert policy.startswith("default-src 'none'")


@pytest.mark.slow
def test_names_of_files_and_features_are_shown(page):
    read = read_page(page)
    assert read.texts("title")[0].startswith(NAME)
    assert HOUSE in {row[0] for row in read.table("Peaks, first arrival and deposit in each polygon")}
    assert not [given for tag, given, _ in read.elements if tag == "img" and given.get("src") == "x"]


@pytest.mark.slow
def test_it_can_be_read_aloud_and_walked_through(page):
    read = read_page(page)
    assert read.elements[0][:2] == ["html", {"lang": "en"}]
    assert len(read.texts("h1")) == len(read.texts("main")) == 1
    names = [given["id"] for _, given, _ in read.elements if "id" in given]
    assert len(names) == len(set(names))
    assert {one.removeprefix("#") for one in read.loaded() if one.startswith("#")} <= set(names)
    assert all(given.get("scope") in ("row", "col") for tag, given, _ in read.elements if tag == "th")
    assert len(read.texts("caption")) == len(read.texts("table"))


COLOURS = dict(re.findall(r"--(\w+): (#\w+)", (PACKAGE / "report" / "templates" / "report.css").read_text()))


def luminance(colour):
    """Return the relative luminance of a colour as #rrggbb, after WCAG 2.2."""
    parts = [int(colour[k : k + 2], 16) / 255.0 for k in (1, 3, 5)]
    parts = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2]


@pytest.mark.parametrize("name", ["ink", "soft", "accent"])
def test_letters_stand_out(name):
    """WCAG 2.2 asks for a contrast of 4.5 on white and on the ground of boxes."""
    for ground in ("#ffffff", COLOURS["ground"]):
        assert (luminance(ground) + 0.05) / (luminance(COLOURS[name]) + 0.05) >= 4.5
