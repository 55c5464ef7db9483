"""A case in a process of its own: a copy of this one, with limits of time, memory and size of files."""

import faulthandler
import functools
import json
import multiprocessing
import os
import resource
import select
import shutil
import signal
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from .cases import Case
from .readers import PACKAGE, Outcome, read

CPU_SECONDS, WALL_SECONDS = 20, 60
"""A case that takes longer hangs; most take a twentieth of a second."""
MEMORY = 3 * 2**30
"""Address space that a case may take beyond what this process has [bytes]."""
FILE_SIZE = 2**28
"""Size of the largest file that a case may write [bytes]."""
LIBRARIES = ("rasterio", "pyogrio", "netCDF4", "shapely", "pyproj", "yaml", "xarray", "numpy", "geopandas", "pandas")


def try_case(case: Case, keep: Path | None = None, tracer=None) -> tuple[Outcome, float, object]:
    """Return outcome, CPU time [s] and what a tracer found of a case.

    Parameters
    ----------
    case : Case
    keep : Path, optional
        Directory in which files of cases with a bad outcome are kept.
    tracer : callable, optional
        Called in the copy with the function to call; returns its result and something else for JSON.
    """
    folder = Path(tempfile.mkdtemp(prefix="fuzz_", dir="/dev/shm" if os.path.isdir("/dev/shm") else None))
    began = _time_of_copies()
    try:
        inner = folder / "case"
        inner.mkdir()
        outcome, found = _in_a_copy(case, folder, inner, tracer)
        if keep is not None and outcome.name not in GOOD:
            target = keep / f"{case.seed}_{case.number}"
            shutil.rmtree(target, ignore_errors=True)
            shutil.copytree(inner, target, symlinks=True, ignore=shutil.ignore_patterns("pipe"))
            (target / "outcome.txt").write_text("\n".join(outcome), errors="surrogateescape")
        return outcome, _time_of_copies() - began, found
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def try_cases(cases, workers: int = 1, keep: Path | None = None, tracer=None):
    """Yield what `try_case` returns of every case, in their order, some at a time."""
    trial = functools.partial(try_case, keep=keep, tracer=tracer)
    if workers == 1:
        yield from map(trial, cases)
        return
    with ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("fork")) as pool:
        yield from pool.map(trial, cases, chunksize=20)


GOOD = ("accepted", "warned", "refused", "diverged", "library")
"""Outcomes that are not faults of the package."""


def _time_of_copies() -> float:
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def _in_a_copy(case: Case, folder: Path, inner: Path, tracer) -> tuple[Outcome, object]:
    reader, writer = os.pipe()
    sys.stdout.flush()
    process = os.fork()
    if process == 0:
        os.close(reader)
        _be_the_copy(case, folder, inner, writer, tracer)
    os.close(writer)
    data, late = b"", time.monotonic() + WALL_SECONDS
    try:
        while True:
            ready, _, _ = select.select([reader], [], [], max(0.0, late - time.monotonic()))
            if not ready:
                os.kill(process, signal.SIGUSR1)
                time.sleep(0.2)
                os.kill(process, signal.SIGKILL)
                break
            if not (piece := os.read(reader, 1 << 16)):
                break
            data += piece
    finally:
        os.close(reader)
        _, status = os.waitpid(process, 0)
    try:
        name, words, done, found = json.loads(data)
        return Outcome(name, words, done), found
    except ValueError:
        return _died(status, folder), None


def _be_the_copy(case: Case, folder: Path, inner: Path, writer: int, tracer) -> None:
    """Run the case and write its outcome; never return."""
    code = 1
    try:
        with open(folder / "stack", "w") as stack, open(os.devnull, "r+") as nothing:
            for stream in (0, 1, 2):
                os.dup2(nothing.fileno(), stream)
            faulthandler.enable(stack)
            faulthandler.register(signal.SIGXCPU, stack, chain=True)
            faulthandler.register(signal.SIGUSR1, stack)
            now = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
            resource.setrlimit(resource.RLIMIT_AS, (now + MEMORY, now + MEMORY))
            resource.setrlimit(resource.RLIMIT_CPU, (CPU_SECONDS, CPU_SECONDS + 5))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            resource.setrlimit(resource.RLIMIT_FSIZE, (FILE_SIZE, FILE_SIZE))
            os.chdir(inner)
            outcome, found = (read(case, inner), None) if tracer is None else tracer(lambda: read(case, inner))
            data = json.dumps([*outcome, found]).encode()
            while data:
                data = data[os.write(writer, data) :]
            code = 0
    finally:
        os._exit(code)


def _died(status: int, folder: Path) -> Outcome:
    """Return the outcome of a process that ended by a signal, or without a word."""
    stack = (folder / "stack").read_text(errors="replace") if (folder / "stack").exists() else ""
    number = os.WTERMSIG(status) if os.WIFSIGNALED(status) else 0
    frames = [line for line in stack.splitlines() if line.strip().startswith("File ")]
    innermost = frames[0] if frames else ""
    name = {signal.SIGKILL: "hang", signal.SIGXCPU: "hang"}.get(number, "crash")
    if (
        any(f"/{library}/" in innermost or f'"{library}' in innermost for library in LIBRARIES)
        and f"/{PACKAGE}/" not in innermost
    ):
        return Outcome("library", f"{name}, signal {number}\n{stack}")
    return Outcome(name, f"signal {number}\n{stack}")
