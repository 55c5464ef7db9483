"""Prepare the kernels that execute code cells: a folder as in a checkout, short errors, commands that must succeed."""

import os
from pathlib import Path

STARTUP = Path(__file__).with_name("startup.py")


def prepare(app):
    """Give IPython a folder of settings in which every kernel runs `startup.py` first."""
    folder = Path(app.doctreedir).resolve() / "ipython"
    startup = folder / "profile_default" / "startup" / "first.py"
    startup.parent.mkdir(parents=True, exist_ok=True)
    startup.write_text(STARTUP.read_text(encoding="utf-8"), encoding="utf-8")
    os.environ.update(IPYTHONDIR=str(folder), SITE_ROOT=str(STARTUP.parents[2]), COLUMNS="100")


def setup(app):
    """Register with Sphinx."""
    app.connect("builder-inited", prepare)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
