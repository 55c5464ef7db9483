"""What every kernel of the site runs before its first cell.

A page is executed in an empty folder of its own, which this fills with links to the folders of a checkout that pages
read. Errors are shown by their last line, and a command (`!landlab-debrisflow ...`) that fails is an error of its cell.
"""

import os
import sys
import warnings
from pathlib import Path

from IPython import get_ipython


class CommandFailedError(Exception):
    """A command of the shell ended with another exit code than 0; what it printed tells why."""


def run_command(command):
    """Run a command of the shell; raise if it fails."""
    piped(command)
    if code := shell.user_ns.get("_exit_code"):
        raise CommandFailedError(f"exit code {code}")


shell = get_ipython()
piped = shell.system
shell.system = run_command
shell.set_custom_exc((CommandFailedError,), lambda *_, **__: None)
shell.run_line_magic("matplotlib", "inline")  # a figure is shown as a picture
shell.InteractiveTB.set_mode("Minimal")
for stream in (sys.stdout, sys.stderr):
    stream.flush_interval = 600.0  # [s], at the end of a cell instead: myst-nb breaks the line where two pieces meet
warnings.formatwarning = lambda message, category, *_, **__: f"{category.__name__}: {message}\n"

for name in ("benchmarks", "docs", "examples"):
    if not Path(name).exists():
        Path(name).symlink_to(Path(os.environ["SITE_ROOT"]) / name)
