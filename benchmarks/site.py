"""The documentation as a reader meets it: ``python -m benchmarks.site [--output FOLDER]``.

Prints the time from an empty environment to the first map by the text of docs/first_flow.md alone (its commands and its
first block of code, without caches of downloads or kernels), the words of the README, the build of the site with all
cells executed, its warnings and links, and the wall time of the cells of every page with compiled kernels.
"""

import argparse
import os
import pickle
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from rich.console import Console
from rich.table import Table

ROOT = Path(__file__).parents[1]
LEFT_OUT = shutil.ignore_patterns(".git", ".nox", "__pycache__", "_build", "*.egg-info", "build", "dist")


def first_map(console: Console) -> None:
    """Follow the first page in an empty environment, and print the times."""
    page = (ROOT / "docs" / "first_flow.md").read_text(encoding="utf-8")
    commands = re.search(r"(?:^    .*\n)+", page, re.M)[0]
    install = "\n".join(line.split("#")[0].strip() for line in commands.splitlines())
    code = re.search(r"```\{code-cell\} ipython3\n(.*?)```", page, re.S)[1]
    with tempfile.TemporaryDirectory() as folder:
        checkout = shutil.copytree(ROOT, Path(folder, "checkout"), ignore=LEFT_OUT)
        Path(checkout, "first_flow.py").write_text(code, encoding="utf-8")
        clean = {name: os.environ[name] for name in ("PATH", "LANG") if name in os.environ}
        environment = clean | {"HOME": folder, "PIP_NO_CACHE_DIR": "1", "PIP_QUIET": "1"}

        def seconds(script):
            start = time.perf_counter()
            subprocess.run(["bash", "-ec", script], cwd=checkout, env=environment, check=True, capture_output=True)
            return time.perf_counter() - start

        run = "source flow/bin/activate\npython first_flow.py"
        installed, first, second = seconds(install), seconds(run), seconds(run)
        assert Path(checkout, "first_flow.png").stat().st_size > 0
    console.print(
        f"empty environment to the first map: {installed + first:.0f} s, {installed:.0f} s for the installation; a "
        f"second run {second:.1f} s",
        highlight=False,
        soft_wrap=True,
    )


def build(folder: Path, console: Console) -> None:
    """Build the site into a folder, and print its warnings, links and times."""
    command = [sys.executable, "-m", "sphinx", "--keep-going", "-n", "-q", "-E", "docs", str(folder)]
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    said = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stderr
    after, wall = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter() - start
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    warnings = len(re.findall(r"WARNING: |ERROR: ", said))
    console.print(f"build, one process: {warnings} warnings, {wall:.0f} s of wall time, {cpu:.0f} s of CPU time")
    subprocess.run([sys.executable, "docs/_site/links.py", str(folder)], cwd=ROOT, check=True)
    sys.path.insert(0, str(ROOT / "docs" / "_site"))  # the environment names classes of its modules
    with (folder / ".doctrees" / "environment.pickle").open("rb") as file:
        metadata = pickle.load(file).nb_metadata
    runs = {page: found["exec_data"]["runtime"] for page, found in metadata.items() if "exec_data" in found}
    table = Table(title="Time of the cells of a page, Python and Landlab included", title_justify="left")
    table.add_column("page")
    table.add_column("wall time [s]", justify="right")
    for page, seconds in sorted(runs.items(), key=lambda row: -row[1]):
        table.add_row(page, f"{seconds:.1f}")
    console.print(table)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=Path, help="folder of the site; by default one that is removed")
    output, console = parser.parse_args().output, Console()
    first_map(console)
    words = len((ROOT / "README.md").read_text(encoding="utf-8").split())
    console.print(f"README: {words} words", highlight=False)
    with tempfile.TemporaryDirectory() as folder:
        build(output or Path(folder, "html"), console)


if __name__ == "__main__":
    main()
