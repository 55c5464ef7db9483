"""Compare results with those of another version: ``python -m benchmarks.recorder PYTHON [--whole]``.

PYTHON is the interpreter of an environment in which that version is installed. It and this checkout run the scenes of
recorder_scenes.py side by side, in processes of their own, through the public interface. Every array that a flow shows
(particles, columns, maps, budget, fields of the grid) is compared after half of the scene and at its end. A difference
is the largest one of an array, over the largest absolute value in it; above 1e-10, or with an array that only one
side has, the scene has failed and so does the command.

With --whole the scenes run until they rest, and scalars of them are compared with the scatter that a few particles more
or less make of them in the other version: the noise of N. Where no bit of the grid and the maps differs, that is said.

What has not been compiled yet is, into a folder of the system's for temporary files, one for each state of the sources.
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

import numpy as np
from rich.console import Console
from rich.markup import escape
from rich.table import Table

LIMIT = 1e-10
OFFSETS = [-15, -12, -9, -6, -3, 3, 6, 9, 12, 15]
"""Particles more than in the scene, for the noise of N."""
NOISE = 4.0
"""Standard deviations of it within which a scalar of a whole scene is the same: of the hundred scalars, less than one
lies beyond by chance if another order of sums draws anew."""
NODE = {"run-out [m]": 5.0}
"""What is known to a node only has at least its spacing for noise."""


def run(python: str, folder: Path, whole: bool) -> dict[str, Path]:
    """Run the scenes with this checkout and with another interpreter at once; return the folders of what they found."""
    more = {"here": ["--whole", "0"], "there": ["--whole", "0", *map(str, OFFSETS)]} if whole else {}
    root = Path(__file__).parent
    paths, running = {"here": str(root.parent), "there": ""}, {}
    for side, interpreter in (("here", sys.executable), ("there", python)):
        (folder / side).mkdir()
        # -P: the folder of the program holds no package, but modules that might be taken for others
        command = [interpreter, "-P", str(root / "recorder_scenes.py"), str(folder / side), *more.get(side, ())]
        environment = os.environ | {"PYTHONPATH": paths[side], "MPLBACKEND": "Agg"}
        running[side] = subprocess.Popen(
            command, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
    for side, process in running.items():
        words, _ = process.communicate()
        if process.returncode:
            for other in running.values():
                other.kill()
            raise SystemExit(f"{side}, the scenes could not be run:\n{words}")
    return {side: folder / side for side in running}


def difference(one: np.ndarray, other: np.ndarray) -> float:
    """Return the largest difference over the largest absolute value, 0 if all is the same to the bit.

    Examples
    --------
    >>> difference(np.array([1.0, np.nan]), np.array([1.0, np.nan]))
    0.0
    >>> difference(np.array([1.0, 4.0]), np.array([1.5, 4.0]))
    0.125
    >>> difference(np.array([1.0]), np.array([np.nan]))
    inf
    """
    if one.shape != other.shape:
        return np.inf
    if one.dtype.kind not in "fiub":
        return 0.0 if np.array_equal(one, other) else np.inf
    one, other = one.astype(float), other.astype(float)
    apart = ~((one == other) | (np.isnan(one) & np.isnan(other)))
    if not apart.any():
        return 0.0
    far = np.abs(one[apart] - other[apart]).max()
    largest = np.nanmax(np.abs(other), where=np.isfinite(other), initial=0.0)
    return float(far / largest) if np.isfinite(far) and largest > 0.0 else np.inf


def compare(here: dict, there: dict) -> tuple[float, str, list[str]]:
    """Return the largest difference of all arrays, the name of the worst, and the names that one side lacks."""
    both = [name for name in there if name in here]
    lacking = []
    for side, mine, other in (("there", there, here), ("here", here, there)):
        names = [name.partition(": ")[2] for name in mine if name not in other]
        lacking += [f"only {side}: {name} ({count} times)" for name, count in Counter(names).items()]
    found = {name: difference(here[name], there[name]) for name in both}
    worst = max(found, key=found.get, default="")
    if not worst:
        return np.inf, "no array is in both", lacking
    return found[worst], worst if found[worst] > 0.0 else "", lacking


def show_short(folders, console) -> bool:
    """Print the table of the short scenes; return whether all of them are the same."""
    steps = {side: json.loads((folder / "steps.json").read_text()) for side, folder in folders.items()}
    table = Table(title=f"Results of this version and of the other one, limit {LIMIT:g}", title_justify="left")
    for head in ("scene", "steps", "arrays", "numbers", "largest difference", "worst array"):
        table.add_column(head, justify="left" if head in ("scene", "worst array") else "right", overflow="fold")
    good, exact, missing = True, [], {}
    for scene, count in steps["there"].items():
        here, there = (dict(np.load(folders[side] / f"{scene}.npz")) for side in ("here", "there"))
        worst, name, lacking = compare(here, there)
        numbers = sum(values.size for values in there.values())
        counted = f"{count}" if count == steps["here"][scene] else f"{steps['here'][scene]}, there {count}"
        words = "0, to the bit" if worst == 0.0 else f"{worst:.1e}"
        table.add_row(scene, counted, f"{len(there)}", f"{numbers}", words, escape(name))
        good = good and worst <= LIMIT and not lacking
        exact += [scene] if worst == 0.0 and not lacking else []
        missing |= {scene: lacking} if lacking else {}
    console.print(table)
    console.print(f"To the bit: {len(exact)} of {len(steps['there'])} scenes ({', '.join(exact) or 'none'}).")
    for scene, lacking in missing.items():
        console.print(f"{scene}, arrays that one version lacks:\n  " + "\n  ".join(map(escape, lacking)), style="red")
    return good


def noise(name: str, values) -> float:
    """Return the noise of N of a scalar, from its values in the scene and with some particles more or less."""
    scatter = float(np.nanstd(values[1:], ddof=1)) if np.isfinite(values[1:]).sum() > 1 else 0.0
    return max(scatter, NODE.get(name, 0.0), LIMIT * abs(values[0]))


def show_whole(folders, console) -> bool:
    """Print the table of whole scenes; return whether all scalars lie within the noise of N."""
    here, there = (json.loads((folders[side] / "whole.json").read_text()) for side in ("here", "there"))
    names = [name for name in next(iter(there.values()))[0] if name != "digest"]
    words = f"Whole scenes: there, here less there, noise of N (deviation there of {len(OFFSETS)} runs with up to "
    table = Table(title=escape(f"{words}{OFFSETS[-1]} particles more or less)"), title_justify="left")
    for head in ("scene", *names, "differs"):
        table.add_column(escape(head), justify="left" if head == "scene" else "right")
    good = True
    for scene, runs in there.items():
        cells, beyond, exact = [], [], here[scene][0]["digest"] == runs[0]["digest"]
        for name in names:
            mine, its, known = here[scene][0][name], runs[0][name], noise(name, np.array([run[name] for run in runs]))
            same = mine == its or (np.isnan(mine) and np.isnan(its))
            apart = 0.0 if same else mine - its
            cells.append(f"{its:.5g}\n{apart:+.2g}\n\u00b1 {known:.2g}")
            beyond += [] if abs(apart) <= NOISE * known else [name]
        table.add_row(scene, *cells, escape(", ".join(beyond)) or ("no bit of all" if exact else f"< {NOISE:g} noise"))
        good = good and not beyond
    console.print(table)
    return good


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("python", help="interpreter of an environment with another version of the package")
    parser.add_argument("--whole", action="store_true", help="whole scenes, within the noise of N")
    options = parser.parse_args()
    console, began = Console(width=160), time.perf_counter()
    with tempfile.TemporaryDirectory() as name:
        folders = run(options.python, Path(name), options.whole)
        good = (show_whole if options.whole else show_short)(folders, console)
    console.print(f"{'Same' if good else 'NOT the same'}; {time.perf_counter() - began:.0f} s, both sides at once.")
    sys.exit(not good)


if __name__ == "__main__":
    main()
