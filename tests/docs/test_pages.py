"""Pages that answer a question have one form, and links of all pages lead somewhere."""

import json
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
QUESTIONS = (
    "first_flow",
    "geotiff_to_report",
    "release",
    "parameters",
    "hazard_maps",
    "other_codes",
    "landlab_loops",
    "observers_restart_files",
    "columns",
    "calibration",
    "theory_and_laws",
    "accuracy",
    "limits",
    "gallery",
    "cluster",
    "sensitivity",
)
"""Pages that answer a question; one more is that of the API, which is as short as it can be."""

GENERATED = {"contributing.md", "changes.md", "api", "notebooks", "_build", "_site"}
WRITTEN = [path for path in sorted(DOCS.rglob("*.md")) if path.relative_to(DOCS).parts[0] not in GENERATED]
PAGES = [*sorted(ROOT.glob("*.md")), *WRITTEN, *sorted((ROOT / "notebooks").glob("*.ipynb"))]
FENCE = re.compile(r"^(`{3,}|~{3,}).*?^\1`*\s*?$", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\((?!\w+:)([^()\s#]*)(?:#([^()\s]*))?\)")


def read(path):
    """Return the Markdown of a page or of a notebook, without code."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".ipynb":
        cells = json.loads(text)["cells"]
        text = "\n\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")
    text = FENCE.sub("", text)
    return re.sub(r"(?<!`)`[^`\n]+`(?!`)", lambda code: code.group().replace("](", "] ("), text)


def anchors(path):
    """Return the anchors of a page: those given, and those that a Git host makes of headings."""
    text = read(path)
    headings = re.findall(r"^#+ (.*?)#*$", text, re.MULTILINE)
    plain = (re.sub(r"\[([^\]]*)\]\([^)]*\)|[`*]", r"\1", heading) for heading in headings)
    slugs = {re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-") for heading in plain}
    return slugs | set(re.findall(r'<a id="([^"]+)"></a>', text))


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_links_of_pages_lead_somewhere(path):
    broken = []
    for target, anchor in LINK.findall(read(path)):
        place = (path.parent / target).resolve() if target else path
        if not place.exists() or (anchor and place.suffix == ".md" and anchor not in anchors(place)):
            broken.append(f"{target}#{anchor}")
    assert broken == []


def test_a_broken_link_is_seen():
    assert LINK.findall("[a](b.md#c), [d](e.md) and [f](#g); [h](https://i.org)") == [
        ("b.md", "c"),
        ("e.md", ""),
        ("", "g"),
    ]
    assert "frame" in anchors(DOCS / "theory.md") and "a-page" in anchors(DOCS / "adding_a_page.md")


def test_every_page_stands_in_the_index():
    index = (DOCS / "index.md").read_text(encoding="utf-8")
    lists = "".join(re.findall(r"^```{toctree}\n.*?^```", index, re.MULTILINE | re.DOTALL))
    named = set(re.findall(r"^([\w/]+)$", lists, re.MULTILINE))
    here = {path.stem for path in DOCS.glob("*.md")} - {"index"} | {"contributing", "changes"}
    here |= {f"notebooks/{path.stem}" for path in (ROOT / "notebooks").glob("*.ipynb")}
    assert here - named == set() and named - here == set()


@pytest.mark.parametrize("name", [*QUESTIONS, "api"])
def test_a_page_answers_a_question(name):
    text = (DOCS / f"{name}.md").read_text(encoding="utf-8")
    front, rest = re.match(r"(?s)---\n(.*?)\n---\n(.*)", text).groups()
    assert "file_format: mystnb" in front and "name: python3" in front
    _, title, question, *_ = re.split(r"\n+(?=# )|\n\n", "\n\n" + rest.lstrip("\n"))[0:4]
    assert title.startswith("# ") and re.fullmatch(r"(?s)\*\*.+\?\*\*", question.strip())
    assert "```{code-cell}" in rest.split("\n## ")[0] + "\n## ".join(rest.split("\n## ")[1:2])
    assert "\n## What goes wrong\n" in rest
    assert re.search(r"\]\((\.\./|\w+/)?[\w/]+\.(md|ipynb)", rest.rstrip().split("\n\n")[-1])


def words(text):
    """Return the number of words of a page without its front matter, code and tables."""
    text = re.sub(r"(?s)\A---\n.*?\n---\n", "", text)
    return len(re.sub(r"^( {4}|\|).*$", "", FENCE.sub("", text), flags=re.MULTILINE).split())


@pytest.mark.parametrize("name", QUESTIONS)
def test_a_page_is_short(name):
    assert 300 <= words((DOCS / f"{name}.md").read_text(encoding="utf-8")) <= 900
