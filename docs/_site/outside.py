"""Bring pages that stand elsewhere in the repository into the site, and turn links that leave docs/.

In the repository a link leads to a file, relative to the page, as a Git host wants it. In the site it leads to the page
made of that file, or to a copy of the file; a link to a folder becomes plain text.
"""

import os
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
COPIED = {"contributing.md": ROOT / "CONTRIBUTING.md", "changes.md": ROOT / "CHANGES.md"} | {
    f"notebooks/{path.name}": path for path in sorted((ROOT / "notebooks").glob("*.ipynb"))
}
"""Files of the site, relative to docs/, by what they are copies of."""

PLACES = {original: DOCS / name for name, original in COPIED.items()} | {ROOT / "README.md": DOCS / "index.md"}
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^()\s#]+)(#[\w-]+)?\)")


def copy_pages(app):
    """Copy notebooks and the pages at the root of the repository into docs/, where git ignores them."""
    for name, original in COPIED.items():
        path, text = DOCS / name, original.read_text(encoding="utf-8")
        path.parent.mkdir(exist_ok=True)
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")


def turn_links(app, docname, source):
    """Turn the links of a page."""
    page = Path(app.env.doc2path(docname))
    written = COPIED.get(page.relative_to(DOCS).as_posix(), page)

    def turn(match):
        mark, text, target, fragment = match.groups()
        path = Path(os.path.normpath(written.parent / target))
        if not path.exists() or (path.is_relative_to(DOCS) and written == page):
            return match.group()
        if path.is_dir():
            return text
        place = PLACES.get(path, path)
        link = Path(os.path.relpath(place, page.parent)).as_posix()
        leaves = not mark and not place.is_relative_to(DOCS)
        return f"{mark}[{text}]({'path:' * leaves}{link}{'' if leaves else fragment or ''})"

    source[0] = LINK.sub(turn, source[0])


def setup(app):
    """Register with Sphinx."""
    app.connect("builder-inited", copy_pages)
    app.connect("source-read", turn_links)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
