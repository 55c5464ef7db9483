"""Run scenes and keep their measures as lines of JSON: runs that the file holds are not repeated."""

import json
import multiprocessing
import os
import traceback
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from typing import NamedTuple

RESULTS = Path(__file__).parent / "results"
ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")


class Run(NamedTuple):
    """Key of a result: label of the engine's version, name of the scene, number of particles, words of variation."""

    label: str
    scene: str
    particles: int
    variation: str = ""


def read(path: Path) -> dict[Run, dict]:
    """Return the results in a file of lines of JSON; a last line that was cut off is left out."""
    found = {}
    if path.exists():
        for line in path.read_text().splitlines():
            try:
                entry = json.loads(line)
            except json.JSONDecodeError:
                continue
            run = Run(*(entry.pop(name) for name in Run._fields))
            found[run] = entry
    return found


def append(path: Path, run: Run, result: dict) -> None:
    """Add a line of one result."""
    path.parent.mkdir(parents=True, exist_ok=True)
    text = json.dumps(run._asdict() | result, separators=(",", ":"))
    with open(path, "ab+") as file:
        if file.tell() and not _ends_a_line(file):
            file.write(b"\n")
        file.write(text.encode() + b"\n")


def _ends_a_line(file):
    file.seek(-1, os.SEEK_END)
    return file.read() == b"\n"


def run_all(runs, path: Path, processes: int = 1, report=print) -> None:
    """Make the runs that the file does not hold yet, some at a time, each with one thread.

    Parameters
    ----------
    runs : sequence of Run
        In the order in which they are begun.
    path : Path
        File of results.
    processes : int
    report : callable
        Told of every result, in a line.
    """
    done = read(path)
    left = [run for run in dict.fromkeys(runs) if run not in done]
    report(f"{len(left)} of {len(runs)} runs are left")
    for name in ONE_THREAD:
        os.environ[name] = "1"
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(processes, mp_context=context) as pool:
        waiting = {pool.submit(result_of, run): run for run in left}
        try:
            for count, future in enumerate(as_completed(waiting), 1):
                words = keep(path, waiting[future], future.result())
                report(f"{count}/{len(left)} {words}")
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)  # after Ctrl-C only what has begun is waited for
            raise


def keep(path: Path, run: Run, result: dict) -> str:
    """Append a result, unless it is a failure, and return it in a line of words."""
    words = " ".join(filter(None, (run.scene, str(run.particles), run.variation)))
    if "failure" in result:
        return f"{words}: {result['failure']}"
    append(path, run, result)
    return (
        f"{words}: {result['seconds']:.2f} s, run-out {result['run_out']}, area {result['area']}, "
        f"at rest {result['at_rest']}"
    )


def result_of(run: Run) -> dict:
    """Return the result of a run, or its failure in words."""
    from .measure import measure  # not before the threads are set
    from .scenes import MissingDataError, maker

    try:
        return measure(maker(run.scene), run.particles, run.variation)
    except MissingDataError as error:
        return {"failure": f"left out: {error}"}
    except Exception:
        return {"failure": traceback.format_exc()}
