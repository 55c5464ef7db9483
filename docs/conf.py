"""Settings of the documentation site: ``nox -s docs``, or ``python -m sphinx -W --keep-going -n docs docs/_build``.

Pages are MyST Markdown that also reads well on a plain Git host; their code cells are executed at every build.
docs/adding_a_page.md says how pages, pictures and rows come in.
"""

import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT), str(ROOT / "docs" / "_site")]

from docstrings import VALUES  # noqa: E402  of docs/_site

import landlab_debrisflow  # noqa: E402
from tests.numba_cache import NUMBA_CACHE  # noqa: E402

# kernels of cells run this checkout with this Python, and read the compiled kernels that the tests have left
os.environ["PYTHONPATH"] = os.pathsep.join([str(ROOT), *filter(None, [os.environ.get("PYTHONPATH")])])
os.environ.setdefault("NUMBA_CACHE_DIR", NUMBA_CACHE)

project = "landlab_debrisflow"
author = copyright = "The landlab_debrisflow developers"
version = release = landlab_debrisflow.__version__
language = "en"

extensions = [
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "numpydoc",
    "myst_nb",
    # of docs/_site
    "outside",
    "anchors",
    "children",
    "cells",
    "docstrings",
    "mathml",
]
exclude_patterns = ["_build", "_site"]
templates_path = ["_site/templates"]
smartquotes = False  # a prime is not an apostrophe, and dashes are written as such
default_role = "code"  # names in docstrings; those with a page of their own are listed in tables that link
nitpicky = True

# ---- cells ----
nb_execution_mode = "force"  # a page depends on the whole package, and no cache of outputs watches that
nb_execution_in_temp = True
nb_execution_timeout = 120
nb_execution_raise_on_error = True
nb_merge_streams = True

# ---- Markdown ----
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4

# ---- docstrings ----
autodoc_typehints = "none"  # numpydoc's sections name types and units
autodoc_member_order = "bysource"
autosummary_ignore_module_all = False
autosummary_context = {"top_level": landlab_debrisflow.__all__, "values": VALUES}
numpydoc_show_class_members = False  # the template lists members
numpydoc_validation_checks: set[str] = set()

# ---- HTML: nothing is loaded from elsewhere ----
html_theme = "furo"
html_title = f"landlab_debrisflow {release}"
html_static_path = ["_site/static"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sourcelink = False
html_last_updated_fmt = None
