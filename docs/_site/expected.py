"""Leave out of the index what is not written yet: lines of docs/index.md whose page does not exist."""

import re
from pathlib import Path

LINE = re.compile(r"^(?:- \[[^\]]*\]\((\w+)\.md\)|(\w+))$")


def leave_out(app, docname, source):
    """Drop the lines of the index that lead to missing pages."""
    if docname != "index":
        return
    pages = {path.stem for path in Path(app.srcdir).glob("*.md")}
    found = [(line, LINE.match(line)) for line in source[0].splitlines()]
    source[0] = "\n".join(line for line, match in found if not match or (match[1] or match[2]) in pages)


def setup(app):
    """Register with Sphinx."""
    app.connect("source-read", leave_out)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
