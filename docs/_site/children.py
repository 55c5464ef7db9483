"""Put the pages of a folder below the page of the same name: those of docs/decisions/ below docs/decisions.md."""

from pathlib import Path

LIST = "\n\n```{{toctree}}\n:hidden:\n:glob:\n\n{}/*\n```\n"


def list_children(app, docname, source):
    """Add the list of its children to a page, which a Git host would show as code."""
    page = Path(app.env.doc2path(docname))
    if page.suffix == ".md" and list(page.with_suffix("").glob("*.md")):
        source[0] += LIST.format(page.stem)


def setup(app):
    """Register with Sphinx."""
    app.connect("source-read", list_children)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
