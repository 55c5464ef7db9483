"""Leave out what is not written yet: links to pages that are planned but absent, and their lines in the index."""

import re
from pathlib import Path

PAGES = (
    "first_flow",
    "geotiff_to_report",
    "release",
    "parameters",
    "other_codes",
    "landlab_loops",
    "observers_restart_files",
    "columns",
    "theory_and_laws",
    "accuracy",
    "limits",
    "gallery",
)


def leave_out(app, docname, source):
    """Drop the lines of the index that lead to absent pages, and the links to them elsewhere."""
    absent = "|".join(name for name in PAGES if not (Path(app.srcdir) / f"{name}.md").exists())
    if not absent:
        return  # this file has done its work, and can go
    if docname == "index":
        source[0] = re.sub(rf"^(- \[[^\]]*\]\()?({absent})(\.md\))?\n", "", source[0], flags=re.MULTILINE)
    source[0] = re.sub(rf"\[([^\[\]]*)\]\((?:docs/)?(?:{absent})\.md(?:#[\w-]+)?\)", r"\1", source[0])


def setup(app):
    """Register with Sphinx."""
    app.connect("source-read", leave_out, priority=400)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
