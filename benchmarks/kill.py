"""Kill runs with SIGKILL at moments drawn over all of them, go on from their checkpoints, and compare the ends.

    python -m benchmarks.kill --count 100
    python -m benchmarks.kill --count 100 --commands

A moment is drawn as the number of a checkpoint and a time after it; every second one lies while a checkpoint is being
written, which its temporary file shows. Only files are watched, so that any program that leaves a checkpoint will do.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path
from typing import NamedTuple

import numpy as np

from benchmarks import kill_child, kill_scene
from landlab_debrisflow.record.checkpoint_file import read_checkpoint
from landlab_debrisflow.run.files import RECORD

POLL = 2e-4
"""Time between two looks at the folder [s]."""


class Program(NamedTuple):
    """A program that leaves checkpoints in a folder, and a result when it has come to its end."""

    start: list  # command with the folder as "{}", for a folder without checkpoint
    resume: list  # for one with a checkpoint
    checkpoint: str  # name of the file in the folder
    result: str  # name of a file of JSON in the folder, which is written last


def program(module) -> Program:
    """Return the program of a module that takes the folder as its argument, and finds out itself whether to go on."""
    return Program(*2 * [[sys.executable, "-m", module.__name__, "{}"]], module.CHECKPOINT, module.RESULT)


CHILD, COMMANDS = program(kill_child), program(kill_scene)


class Moment(NamedTuple):
    """When to kill."""

    checkpoint: int  # after so many new checkpoints
    delay: float  # and so much time [s]
    writing: bool  # of which the time is since the next one is being written


def temporary(folder: Path, program: Program) -> list[str]:
    """Return names of files of a checkpoint that is not whole yet."""
    stem, suffix = os.path.splitext(program.checkpoint)
    return [name for name in os.listdir(folder) if name.startswith(f".{stem}.") and name.endswith(suffix)]


def run(program: Program, folder: Path, moment: Moment | None):
    """Run a program in a folder, and kill it at a moment.

    Returns
    -------
    killed, writing : bool
        Whether it was still running; and had begun to write a checkpoint.
    written : list of float
        When checkpoints were there, since the first one [s].
    """
    path, seen, since = folder / program.checkpoint, [], None
    known = state_of(path)
    for name in temporary(folder, program):
        (folder / name).unlink()
    command = [word.format(folder) for word in (program.resume if path.exists() else program.start)]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
        while process.poll() is None:
            now = time.perf_counter()
            if (found := state_of(path)) not in (known, None):
                known, _ = found, seen.append(now)
            if moment is not None and len(seen) >= moment.checkpoint:
                due = since is not None or not moment.writing or temporary(folder, program)
                since = now if since is None and due else since
                if since is not None and now - since >= moment.delay:
                    process.kill()
                    break
            time.sleep(POLL)
        _, words = process.communicate()
        if process.returncode > 0:
            raise SystemExit(f"{' '.join(command)} failed:\n{words}")
    return process.returncode < 0, bool(temporary(folder, program)), [when - seen[0] for when in seen]


def state_of(path: Path):
    """Return what changes when a file is written anew, or None if it is not there: a run that ends removes it."""
    try:
        found = path.stat()
    except FileNotFoundError:
        return None
    return found.st_ino, found.st_mtime_ns


def draw(rng, count: int, gap: float, writing: bool) -> Moment:
    """Return a moment in a run that leaves `count` more checkpoints, `gap` seconds apart."""
    if writing:
        return Moment(int(rng.integers(0, max(count, 1))), float(rng.uniform(0.0, 0.006)), True)
    return Moment(int(rng.integers(0, count + 1)), float(rng.uniform(0.0, 1.5 * gap)), False)


def reached(program: Program, folder: Path) -> float:
    """Return the elapsed time of the last checkpoint [s]."""
    path = folder / program.checkpoint
    return float(read_checkpoint(path)["time"]) if path.exists() else 0.0


def result(program: Program, folder: Path) -> dict:
    return json.loads((folder / program.result).read_text())


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=100, help="of kills")
    parser.add_argument("--seed", type=int, default=15)
    parser.add_argument("--commands", action="store_true", help="kill landlab-debrisflow run and resume")
    options = parser.parse_args()
    program = COMMANDS if options.commands else CHILD
    rng, counts, places = np.random.default_rng(options.seed), Counter(), Counter()
    with tempfile.TemporaryDirectory() as whole:
        _, _, written = run(program, Path(whole), None)
        expected, end = result(program, Path(whole)), reached(program, Path(whole))
        if not end:  # a run of the commands that came to rest keeps no checkpoint, but a record
            end = json.loads((Path(whole) / RECORD).read_text())["elapsed_time"]
    number, gap = len(written), written[-1] / max(len(written) - 1, 1)
    print(f"a whole run leaves {number} checkpoints, one every {gap:.2f} s", flush=True)
    while counts["killed"] < options.count:
        with tempfile.TemporaryDirectory() as name:
            folder, passed = Path(name), 0
            while True:
                again = rng.uniform() < 0.7 or passed == 0  # most are killed more than once
                moment = draw(rng, max(number - passed, 0), gap, counts["killed"] % 2 == 0) if again else None
                killed, writing, written = run(program, folder, moment)
                passed += len(written)
                if not killed:
                    break
                counts["killed"] += 1
                counts["killed while writing"] += writing
                counts["resumed" if (folder / program.checkpoint).exists() else "started again"] += 1
                places[min(4, int(5.0 * reached(program, folder) / end))] += 1
            counts["ended"] += 1
            if (found := result(program, folder)) == expected:
                counts["equal"] += 1
            else:
                different = sorted(key for key in {**expected, **found} if found.get(key) != expected.get(key))
                print(f"different: {', '.join(different)}", flush=True)
            print(", ".join(f"{key} {value}" for key, value in counts.items()), flush=True)
    print("kills by fifth of the event, as the last checkpoint tells: " + ", ".join(str(places[k]) for k in range(5)))
    good = counts["equal"] == counts["ended"] and 5 * counts["killed while writing"] >= counts["killed"]
    print("all ended equal to the bit" if good else "NOT all as it should be")
    return int(not good)


if __name__ == "__main__":
    raise SystemExit(main())
