"""Signatures of classes as Python tells them, sections of modules' docstrings, and sentences about public values."""

import inspect
import re

from sphinx.util.inspect import stringify_signature

VALUES = {
    "landlab_debrisflow.__version__": "Version of the package, from its metadata.",
    "landlab_debrisflow.laws.LAWS": "Classes of laws by kind and by the name that chooses them.",
    "landlab_debrisflow.laws.inner": "Decorator of compiled functions that only kernels call.",
    "landlab_debrisflow.laws.kernel": "Decorator of compiled functions that Python calls.",
    "landlab_debrisflow.scene.NON_ERODIBLE_BELOW": "Contour of `tsing_shan_valley` below which nothing is eroded [m].",
    "landlab_debrisflow.exact.flows.GRAVITY": "Acceleration of gravity in all solutions [m s-2].",
}
"""What is neither class nor function has no docstring that the API could show."""


def show_signature(app, what, name, object_, options, signature, returned):
    """Return the signature of a class: Landlab's components and protocols hide it behind ``*args``."""
    if what != "class" or signature is None:
        return None
    try:
        text = stringify_signature(inspect.signature(object_), show_annotation=False)
    except (TypeError, ValueError):
        return "", None
    return ("" if "*args" in text else text), None


def keep_sections_small(app, what, name, object_, options, lines):
    """Make the sections of a module's docstring paragraphs with a title: a heading would end the page's own section."""
    if what == "module":
        text = "\n".join(lines)
        lines[:] = re.sub(r"^(\w[\w ]*)\n-{3,}$", r".. rubric:: \1\n", text, flags=re.MULTILINE).split("\n")


def setup(app):
    """Register with Sphinx."""
    app.connect("autodoc-process-signature", show_signature)
    app.connect("autodoc-process-docstring", keep_sections_small, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
