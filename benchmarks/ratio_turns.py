"""Measure the rows of ratio_rows.py with several versions of the package, in turns."""

import argparse
import json
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from benchmarks import ratio_rows as rows
from benchmarks import result_files, speed_peer
from benchmarks.example_scripts import load
from benchmarks.speed_against import Side
from benchmarks.start import LANDLAB
from landlab_debrisflow import InputError
from landlab_debrisflow.scene import tsing_shan_valley

PROGRAM = Path(__file__).parent / "ratio_scenes.py"
FIELDS = ("topographic__elevation", "soil__depth", "debris_flow__release_depth")
HERE = "here"


def write_grounds(folder, data=None) -> list[str]:
    """Write the grounds of the scenes into a folder, that of S-1000 if its data are there; return their names."""
    grids, script = {"valley": tsing_shan_valley()}, load("s1000")
    try:
        grids["s1000"] = script.build_grid(script.find_data(data))
    except InputError:
        if data:
            raise
    for name, grid in grids.items():
        np.savez(
            Path(folder) / f"{name}.npz", shape=grid.shape, spacing=(grid.dx, grid.dy), corner=grid.xy_of_lower_left,
            status=grid.status_at_node, **{field: grid.at_node[field] for field in FIELDS},
        )  # fmt: skip
    return list(grids)


def named_version(word: str) -> tuple[str, str]:
    """Return name and path of another version, of a word of the command line.

    Raises
    ------
    argparse.ArgumentTypeError
        If either is absent.
    """
    name, _, path = word.partition("=")
    if not (name and path):
        raise argparse.ArgumentTypeError(f"write NAME=PATH, got {word!r}")
    return name, path


VERSION = {"type": named_version, "metavar": "REVISION=PYTHON", "help": "another version and its interpreter"}
"""Keywords of an option for another version."""


@contextmanager
def versions(others: Mapping[str, str], data=None) -> Iterator[tuple[list[Side], str, list[str]]]:
    """Open this version and others; yields them, the folder with the grounds, and the names of the grounds.

    `others` are interpreters by name; `data` is the folder of the data of S-1000.
    """
    places = [(sys.executable, str(result_files.ROOT)), *((python, "") for python in others.values())]
    with ExitStack() as stack:
        grounds, *folders = (stack.enter_context(tempfile.TemporaryDirectory()) for _ in range(len(places) + 1))
        names = write_grounds(grounds, data)
        yield [Side(*place, folder) for place, folder in zip(places, folders, strict=True)], grounds, names


def turns(sides: Sequence, count: int, measure: Callable, first: int = 0) -> list[list]:
    """Return what `measure` finds for each side, per turn; the side that begins changes from turn to turn.

    Examples
    --------
    >>> order = []
    >>> turns(["a", "b", "c"], 2, lambda side: order.append(side) or side.upper())
    [['A', 'B', 'C'], ['A', 'B', 'C']]
    >>> order
    ['a', 'b', 'c', 'b', 'c', 'a']
    """
    found = []
    for k in range(first, first + count):
        places = [(k + at) % len(sides) for at in range(len(sides))]
        here = {place: measure(sides[place]) for place in places}
        found.append([here[place] for place in range(len(sides))])
    return found


class Task(NamedTuple):
    """A scene, how a side is asked for it, and the values of its rows in the answers of a turn."""

    work: rows.Work
    ask: Callable[[Any], Any]
    peer: str | None = None  # interpreter of com1DFA, which takes part in the turns

    def values(self, row: rows.Row, turn: list) -> list[float]:
        """Return the values of a row in a turn; those of com1DFA's turn are over its own."""
        values = [row.value(answer) for answer in turn]
        return [value / values[-1] for value in values[:-1]] if self.peer else values


def of_a_scene(work: rows.Work) -> Task:
    """Return the task of a scene that is run once in a turn."""
    return Task(work, lambda side: json.loads(side.ask(work.request())))


def of_threads() -> Task:
    """Return the task of two threads: wall time of one over that of two."""

    def ask(side):
        one, two = (json.loads(side.ask(rows.THREADS.request(threads=count)))["wall"] for count in (1, 2))
        return one / two

    return Task(rows.THREADS, ask)


def of_a_peer(python: str, radius: float, size: tuple[int, int]) -> Task:
    """Return the task of com1DFA at a kernel radius [m]: particle steps per second."""
    work = rows.peer_work(speed_peer.peer(python, radius).particles, size)
    rate = rows.rate_of("cpu")
    ask = lambda side: rate(json.loads(side.ask(work.request()))) if side else speed_peer.peer(python, radius).rate  # noqa: E731
    return Task(work, ask, python)


def in_processes(tasks: Sequence[Task], sides, grounds: str, quick: bool, say) -> list[list[list]]:
    """Return the answers of all turns of each task. Processes are started anew some times, for all tasks at once."""
    found: list[list[list]] = [[] for _ in tasks]
    for k in range(1 if quick else max((task.work.processes for task in tasks), default=0)):
        for side in sides:
            side.begin(str(PROGRAM), grounds)
        for task, answers in zip(tasks, found, strict=True):
            if k >= task.work.processes:
                continue
            for side in sides:
                for request in small(task.work):
                    side.ask(request)  # loads kernels, or compiles them
            taking = [*sides, None] if task.peer else sides
            answers += turns(taking, 1 if quick else task.work.turns, task.ask, first=k)
            say(f"{task.work.rows[0].name}: {len(answers)} turns")
        for side in sides:
            side.end()
    return found


def small(work: rows.Work) -> Iterator[str]:
    """Yield requests that need the kernels of a scene."""
    yield json.dumps(["to_rest", {"count": 50}])
    if work.function == "phases":
        yield work.request(count=100)
    if work.function == "cap":
        yield work.request(count=500)
    if work.function == "s1000":
        yield work.request(counts=[20])


def of_starts(sides, quick) -> list[list[float]]:
    """Return CPU times of starts with an empty folder of kernels, less those of the import of landlab, per turn [s]."""

    def cold(side):
        with tempfile.TemporaryDirectory(dir=side.folder) as cache:
            return side.start(cache) - side.start(program=LANDLAB)

    for side in sides:
        side.start()  # writes the bytecode
    return turns(sides, 1 if quick else 5, cold)


def compared(row: rows.Row, revisions: Sequence[str], turned) -> dict[str, Any]:
    """Return a row of the result: the median here, and median and quartiles of the ratio to each other version.

    Parameters
    ----------
    row : Row
        Quantity.
    revisions : sequence of str
        Names of the other versions.
    turned : list of list of float
        Values per turn, here first.

    Examples
    --------
    >>> found = compared(rows.Row("time", "s"), ["old"], [[1.0, 2.0], [1.0, 2.0], [1.5, 2.0]])
    >>> found["here"], found["ratios"]["old"]
    (1.0, [0.5, 0.5, 0.625])
    """
    values = np.array(turned)
    ratios = {
        name: np.quantile(values[:, 0] / values[:, k], [0.25, 0.5, 0.75]).tolist()
        for k, name in enumerate(revisions, 1)
    }
    return {
        "row": row.name, "unit": row.unit, "rate": row.rate, "turns": len(values),
        "here": float(np.median(values[:, 0])), "there": np.median(values[:, 1:], axis=0).tolist(), "ratios": ratios,
    }  # fmt: skip


def outcome(friction: str, revision: str, found: Mapping[str, Sequence[float]]) -> dict[str, Any]:
    """Return what the runs of S-1000 find in one version: mean and standard deviation over numbers of particles."""
    row: dict[str, Any] = {"friction": friction, "revision": revision}
    for key in ("run_out", "eroded", "end", "steps"):
        values = np.array(found[key], float)
        row |= {key: values.mean(), f"{key}, deviation": values.std(ddof=1)}
    return row


def measure(others: Mapping[str, str], *, data, peer, words, quick, say) -> dict[str, Any]:
    """Return the rows and what S-1000 found.

    Parameters
    ----------
    others : mapping of str to str
        Interpreters of other versions by name.
    data : str or None
        Folder of the data of S-1000.
    peer : str or None
        Interpreter of com1DFA.
    words : list of str
        Of the rows that are wanted; empty: all.
    quick : bool
        One turn of the short scenes only.
    say : callable
        Told what is done.
    """
    found, outcomes = [], []

    def wanted(work):
        named = not words or any(word in row.name for word in words for row in work.rows)
        return named and (work.quick or not quick) and (work.function != "s1000" or "s1000" in there)

    with versions(others, data) as (sides, grounds, there):
        tasks = [of_a_scene(work) for work in rows.works() if wanted(work)]
        tasks += [of_threads()] if wanted(rows.THREADS) else []
        for radius, size in rows.PEERS.items() if peer else ():
            tasks += [of_a_peer(peer, radius, size)] if radius > 4.0 or not quick else []
        for task, answers in zip(tasks, in_processes(tasks, sides, grounds, quick, say), strict=True):
            for row in task.work.rows:
                found.append(compared(row, list(others), [task.values(row, turn) for turn in answers]))
            if task.work.function == "s1000":
                pairs = zip([HERE, *others], answers[0], strict=True)
                outcomes += [outcome(task.work.keywords["friction"], *pair) for pair in pairs]
        if not words or any(word in rows.START.name for word in words):
            found.append(compared(rows.START, list(others), of_starts(sides, quick)))
    return {"revisions": list(others), "rows": found, "S-1000": outcomes}
