"""Turn ``<a id="name"></a>`` before a heading, which a Git host understands, into a target of MyST."""

import re

ANCHOR = re.compile(r'^<a id="([\w-]+)"></a>$', re.MULTILINE)


def name_targets(app, docname, source):
    """Replace the anchors of a page."""
    source[0] = ANCHOR.sub(r"(\1)=", source[0])


def setup(app):
    """Register with Sphinx."""
    app.connect("source-read", name_targets)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
