"""Prepare the kernels that execute code cells: a folder as in a checkout, short errors, commands that must succeed."""

import os
import sys
from itertools import zip_longest
from pathlib import Path

STARTUP = Path(__file__).with_name("startup.py")
COMMAND = """#!{}
import sys

from landlab_debrisflow.cli.main import main

sys.exit(main())
"""


def prepare(app):
    """Give IPython a folder of settings in which every kernel runs `startup.py` first, and the command of the package.

    The command is that of this checkout, whichever is installed in the environment.
    """
    folder = Path(app.doctreedir).resolve() / "kernels"
    startup = folder / "profile_default" / "startup" / "first.py"
    startup.parent.mkdir(parents=True, exist_ok=True)
    startup.write_text(STARTUP.read_text(encoding="utf-8"), encoding="utf-8")
    command = folder / "bin" / "landlab-debrisflow"
    command.parent.mkdir(exist_ok=True)
    command.write_text(COMMAND.format(sys.executable), encoding="utf-8")
    command.chmod(0o755)
    path = os.pathsep.join([str(command.parent), os.environ["PATH"]])
    os.environ.update(IPYTHONDIR=str(folder), SITE_ROOT=str(STARTUP.parents[2]), COLUMNS="100", PATH=path)


def spread(app, env, docnames):
    """Order pages so that executed ones and others take turns: processes read the list in pieces."""
    executed = [name for name in docnames if is_executed(Path(env.doc2path(name)))]
    others = [name for name in docnames if name not in executed]
    docnames[:] = [name for pair in zip_longest(executed, others) for name in pair if name]


def is_executed(path):
    """Return whether a page has cells that are executed."""
    return path.suffix == ".ipynb" or "{code-cell}" in path.read_text(encoding="utf-8")


def setup(app):
    """Register with Sphinx."""
    app.connect("builder-inited", prepare)
    app.connect("env-before-read-docs", spread)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
