"""The check of a built site sees links that lead nowhere, and what is loaded from another host."""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parents[2] / "docs" / "_site"))

import links

PAGE = """<h1 id="top">A page</h1><a href="{}">link</a>"""


def test_broken_links_are_seen(tmp_path):
    (tmp_path / "sub").mkdir()
    (tmp_path / "b.html").write_text('<p id="péclet"></p>', encoding="utf-8")
    good = ["#top", "b.html", "b.html#p%C3%A9clet", "b.html?v=1", "https://landlab.csdms.io", "mailto:a@b.c"]
    for number, address in enumerate(good):
        (tmp_path / f"good{number}.html").write_text(PAGE.format(address), encoding="utf-8")
    assert links.broken(tmp_path) == []
    for address, problem in (("c.html", "no such file"), ("sub", "no such file"), ("b.html#top", "no such anchor")):
        (tmp_path / "sub" / "bad.html").write_text(PAGE.format(f"../{address}"), encoding="utf-8")
        assert links.broken(tmp_path) == [f"sub/bad.html: ../{address}: {problem}"]


def test_what_is_loaded_from_elsewhere_is_seen(tmp_path):
    for code in ('<script src="https://a.org/b.js">', '<link rel="stylesheet" href="//a.org/b.css">'):
        (tmp_path / "a.html").write_text(code, encoding="utf-8")
        (found,) = links.broken(tmp_path)
        assert found.endswith("is loaded from elsewhere")
