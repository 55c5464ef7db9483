"""Compare the cost of this checkout with that of another version, for ``python -m benchmarks.speed --against PYTHON``.

PYTHON is the interpreter of an environment in which that version is installed. One machine is not as fast from one
minute to the next, so either version waits in a process of its own and both do a scene of speed_against_scenes.py in
turns, who begins changing, one at a time. The processes are started anew some times: where memory lies costs a per cent
or two, and is drawn anew then. Starts are timed as whole processes, with a full folder of compiled kernels and with an
empty one.

Printed are medians of CPU time, and of the ratio of each pair with its quartiles; below 1 this checkout is faster. A
limit is broken when both the median and the lower quartile exceed it: then the command fails.
"""

import os
import resource
import subprocess
import sys
import tempfile
from contextlib import ExitStack
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table

from benchmarks.speed_against_scenes import SCENES
from benchmarks.start import EVENT

LIMIT = 1.03
"""Ratio that no stage may exceed."""
PROCESSES, PAIRS = 5, 3
"""How often processes are started, and cold ones, and pairs of each scene in one."""
PROGRAM = Path(__file__).parent / "speed_against_scenes.py"


class Side:
    """A version of the package: its interpreter, and a folder of its own for compiled kernels."""

    def __init__(self, python: str, path: str, folder: str):
        self.python, self.path, self.folder, self.worker = python, path, folder, None

    def environment(self, cache="cache"):
        # numba counts its own threads, numpy's are switched off: what they wait would count as CPU time
        alone = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MPLBACKEND": "Agg", "PYTHONPATH": self.path}
        # bytecode of either side is kept, as pip does for what it installs
        kept = {"NUMBA_CACHE_DIR": os.path.join(self.folder, cache), "PYTHONPYCACHEPREFIX": f"{self.folder}/bytecode"}
        return {n: v for n, v in os.environ.items() if n != "PYTHONDONTWRITEBYTECODE"} | alone | kept

    def begin(self, *program: str):
        """Start a process that waits for scenes: a program and its arguments, by default that of this comparison."""
        self.worker = subprocess.Popen(
            [self.python, "-P", *(program or (str(PROGRAM),))], cwd=self.folder, env=self.environment(), text=True,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE,
        )  # fmt: skip

    def ask(self, request: str) -> str:
        """Return the answer of the process to a line."""
        print(request, file=self.worker.stdin, flush=True)
        if not (answer := self.worker.stdout.readline()):
            raise SystemExit(f"{self.python} could not run {request!r}")
        return answer

    def scene(self, name: str) -> float:
        """Return the CPU time of a scene [s]."""
        return float(self.ask(name))

    def end(self):
        self.worker.stdin.close()
        self.worker.stdout.close()
        self.worker.wait()

    def start(self, cache="cache", program=EVENT) -> float:
        """Return the CPU time of a process [s], by default of one that imports all and runs a first step."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        command = [self.python, "-P", "-c", program]
        subprocess.run(command, cwd=self.folder, env=self.environment(cache), check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def in_turns(sides, count, measure, first=0) -> list[tuple[float, float]]:
    """Return pairs of what is measured here and there; those of an odd number, from `first` on, are begun there."""
    pairs = []
    for k in range(first, first + count):
        order = sides if k % 2 == 0 else sides[::-1]
        found = [measure(side) for side in order]
        pairs.append(tuple(found if k % 2 == 0 else found[::-1]))
    return pairs


def of_scenes(sides, processes, say) -> dict[str, list[tuple[float, float]]]:
    """Return the pairs of every scene; what has to be compiled is before."""
    pairs = {name: [] for name in SCENES}
    for k in range(processes + 1):
        for side in sides:
            side.begin()
        for name in SCENES:
            in_turns(sides, 1, lambda side, name=name: side.scene(name))  # compiles, or loads what is compiled
        for name in SCENES if k else ():
            pairs[name] += in_turns(sides, PAIRS, lambda side, name=name: side.scene(name), first=k)
        for side in sides:
            side.end()
        say(f"processes {k} of {processes} done" if k else "compiled")
    return pairs


def of_starts(sides, processes) -> dict[str, list[tuple[float, float]]]:
    """Return the pairs of starts, after `of_scenes` has compiled."""

    def cold(side):
        with tempfile.TemporaryDirectory(dir=side.folder) as cache:
            return side.start(cache)

    return {
        "warm: import and first step": in_turns(sides, processes * PAIRS, Side.start),
        "cold: the same, and compiling": in_turns(sides, processes, cold),
    }


def verdict(low: float, middle: float) -> str:
    """Judge a ratio by its lower quartile and its median.

    Examples
    --------
    >>> verdict(1.04, 1.05), verdict(0.99, 1.05), verdict(0.98, 1.0)
    ('BROKEN', 'kept: noise', 'kept')
    """
    if middle <= LIMIT:
        return "kept"
    return "BROKEN" if low > LIMIT else "kept: noise"


def show(title, found, console) -> list[str]:
    """Print a table of pairs, and return the names of what breaks the limit."""
    broken = []
    table = Table(title=f"{title}: CPU time in pairs, limit {LIMIT:g} of the ratio", title_justify="left")
    for head in ("", "pairs", "here [ms]", "there [ms]", "ratio", "quartiles", "limit"):
        table.add_column(head, justify="right" if head not in ("", "limit") else "left")
    for name, pairs in found.items():
        here, there = np.array(pairs).T
        low, middle, high = np.quantile(here / there, [0.25, 0.5, 0.75])
        judged = verdict(low, middle)
        broken += [name] if judged == "BROKEN" else []
        table.add_row(
            name, f"{len(pairs)}", f"{1e3 * np.median(here):.3g}", f"{1e3 * np.median(there):.3g}", f"{middle:.3f}",
            f"{low:.3f} to {high:.3f}", judged,
        )  # fmt: skip
    console.print(table)
    return broken


def compare(python: str, processes: int = PROCESSES) -> bool:
    """Measure, print the tables, and return whether no limit is broken."""
    console = Console(width=140)
    with ExitStack() as folders:
        one, other = (folders.enter_context(tempfile.TemporaryDirectory()) for _ in range(2))
        sides = Side(sys.executable, str(Path(__file__).parents[1]), one), Side(python, "", other)
        broken = show("Stages", of_scenes(sides, processes, console.log), console)
        broken += show("Starts", of_starts(sides, processes), console)
    console.print(f"Broken: {', '.join(broken) or 'none'}; load of the machine {os.getloadavg()[0]:.1f}")
    return not broken
