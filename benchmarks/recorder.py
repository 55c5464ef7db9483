"""Compare results with those of another version: ``python -m benchmarks.recorder PYTHON [--whole]``.

PYTHON is the interpreter of an environment in which that version is installed. It and this checkout run the scenes of
recorder_scenes.py side by side, in processes of their own, through the public interface. Every array that a flow shows
(particles, columns, maps, budget, fields of the grid) is compared after half of the scene and at its end. A difference
is the largest one of an array, over the largest absolute value in it; above 1e-10, or with an array that only one
side has, the scene has failed and so does the command.

With --whole the scenes run until they rest, and scalars of them are compared with the scatter that a few particles more
or less make of them in the other version: the noise of N.

What has not been compiled yet is, into a folder of the system's for temporary files, one for each state of the sources.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.markup import escape
from rich.table import Table

LIMIT = 1e-10
OFFSETS = [-9, -6, -3, 3, 6, 9]
"""Particles more than in the scene, for the noise of N."""
NOISE = 2.0
"""Standard deviations of it within which a scalar of a whole scene is the same."""


def run(python: str, folder: Path, *arguments: str) -> dict[str, Path]:
    """Run the scenes with this checkout and with another interpreter at once; return the folders of what they found."""
    root = Path(__file__).parent
    paths, running = {"here": str(root.parent), "there": ""}, {}
    for side, interpreter in (("here", sys.executable), ("there", python)):
        (folder / side).mkdir()
        # -P: the folder of the program holds no package, but modules that might be taken for others
        command = [interpreter, "-P", str(root / "recorder_scenes.py"), str(folder / side), *arguments]
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
    lacking = [f"only there: {name}" for name in there if name not in here]
    lacking += [f"only here: {name}" for name in here if name not in there]
    found = {name: difference(here[name], there[name]) for name in both}
    worst = max(found, key=found.get)
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


def show_whole(folders, console) -> bool:
    """Print the table of whole scenes; return whether all scalars lie within the noise of N."""
    here, there = (json.loads((folders[side] / "whole.json").read_text()) for side in ("here", "there"))
    words = f"Whole scenes; noise of N: standard deviation there with {OFFSETS} particles more"
    table = Table(title=escape(words), title_justify="left")
    for head in ("scene", "scalar", "here", "there", "difference", "noise of N", ""):
        table.add_column(head, justify="right" if head not in ("scene", "scalar", "") else "left")
    good = True
    for scene, runs in there.items():
        for name, mine in here[scene][0].items():
            its = runs[0][name]
            noise = float(np.std([run[name] for run in runs], ddof=1))
            inside = mine == its or abs(mine - its) <= NOISE * noise
            verdict = "to the bit" if mine == its else "within" if inside else f"beyond {NOISE:g} of it"
            numbers = (f"{value:.6g}" for value in (mine, its, mine - its, noise))
            table.add_row(scene, escape(name), *numbers, verdict)
            good = good and inside
    console.print(table)
    return good


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("python", help="interpreter of an environment with another version of the package")
    parser.add_argument("--whole", action="store_true", help="whole scenes, within the noise of N")
    options = parser.parse_args()
    console, began = Console(width=160), time.perf_counter()
    with tempfile.TemporaryDirectory() as name:
        arguments = ("--whole", "0", *map(str, OFFSETS)) if options.whole else ()
        folders = run(options.python, Path(name), *arguments)
        good = (show_whole if options.whole else show_short)(folders, console)
    console.print(f"{'Same' if good else 'NOT the same'}; {time.perf_counter() - began:.0f} s, both sides at once.")
    sys.exit(not good)


if __name__ == "__main__":
    main()
