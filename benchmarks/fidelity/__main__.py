"""Error against cost: ``python -m benchmarks.fidelity COMMAND`` from the root of a checkout.

    python -m benchmarks.fidelity run --label now --scenes nine --particles 500,1000 --results /tmp/now.jsonl

appends one line of JSON a run to the file; what stands there already is not run again. S-1000 needs the rasters of
examples/s1000.py in $DEBRISFLOW_DATA. Another version of the package, installed elsewhere, is measured over the same
scenes by its own interpreter: run as a file with -P, the harness puts the checkout last.

    PYTHON -P benchmarks/fidelity/__main__.py run --label before ...
"""

import argparse
import json
import sys
from pathlib import Path

if not __package__:  # run as a file: the package that is installed goes before that of the checkout
    sys.path.append(str(Path(__file__).parents[2]))

from benchmarks.fidelity.runs import RESULTS, Run, run_all
from benchmarks.fidelity.scenes import NINE
from benchmarks.fidelity.seeds import FIT, HELD_OUT, TABLE, take_draws

SETS = {"nine": list(NINE), "fit": [f"r{seed}" for seed in FIT], "held-out": [f"r{seed}" for seed in HELD_OUT]}
"""Sets of scenes by name."""


def main(arguments=None) -> int:
    """Carry out a command."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.fidelity", description=__doc__.splitlines()[0])
    commands = parser.add_subparsers(dest="command", required=True)
    run = commands.add_parser("run", help="run scenes and append their results to a file")
    run.add_argument("--label", required=True, help="name of the engine's version, a part of the key")
    run.add_argument("--scenes", default="nine", help="nine, fit, held-out, or names with commas between them")
    run.add_argument("--particles", default="500,1000", help="numbers with commas between them")
    run.add_argument("--variations", default="", help="words of benchmarks/fidelity/variations.py, commas between")
    run.add_argument("--results", type=Path, help="file of results, by default results/LABEL.jsonl")
    run.add_argument("--processes", type=int, default=1, help="runs at a time")
    commands.add_parser("seeds", help="write the table of draws anew")
    options = parser.parse_args(arguments)
    if options.command == "seeds":
        draws = take_draws([*FIT, *HELD_OUT], lambda line: print(line, flush=True))
        TABLE.write_text(json.dumps(draws, indent=0) + "\n")
        return 0
    scenes = [name for word in options.scenes.split(",") for name in SETS.get(word, [word])]
    runs = [
        Run(options.label, scene, int(count), variation)
        for variation in options.variations.split(",")
        for count in options.particles.split(",")
        for scene in scenes
    ]
    path = options.results or RESULTS / f"{options.label}.jsonl"
    run_all(runs, path, options.processes, lambda line: print(line, flush=True))
    return 0


if __name__ == "__main__":
    sys.exit(main())
