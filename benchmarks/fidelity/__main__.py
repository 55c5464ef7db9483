"""Error against cost: ``python -m benchmarks.fidelity COMMAND`` from the root of a checkout.

    python -m benchmarks.fidelity campaign --label after --processes 2
    python -m benchmarks.fidelity fit
    python -m benchmarks.fidelity score
    python -m benchmarks.fidelity presets
    python -m benchmarks.fidelity repeat --count 40
    python -m benchmarks.fidelity chart
    python -m benchmarks.fidelity run --label now --scenes nine --particles 500,1000 --results /tmp/now.jsonl

The first takes hours of CPU time and may be broken off and begun again: a run is a line of JSON in
results/LABEL.jsonl, and what stands there is not run again. `repeat` makes some of these runs again and compares every
digit, which tells whether the engine is still that of the results. The others need seconds; `chart` draws fidelity.png
and convergence.png of docs/figures, the latter with results/before.jsonl. S-1000 needs the rasters of
examples/s1000.py in $DEBRISFLOW_DATA. Another version of the package, installed elsewhere, is measured over the same scenes by its own
interpreter: run as a file with -P, the harness puts the checkout last.

    PYTHON -P benchmarks/fidelity/__main__.py campaign --label before --short --scenes nine,fit
"""

import argparse
import json
import sys
from pathlib import Path

if not __package__:  # run as a file: the package that is installed goes before that of the checkout
    sys.path.append(str(Path(__file__).parents[2]))

from benchmarks.fidelity.campaign import SETS, campaign
from benchmarks.fidelity.runs import RESULTS, Run, read, run_all
from benchmarks.fidelity.seeds import DILATANT, FIT, HELD_OUT, TABLE, take_draws


def parse(arguments) -> argparse.Namespace:
    """Return the options of a command."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.fidelity", description=__doc__.splitlines()[0])
    commands = parser.add_subparsers(dest="command", required=True)

    def command(name, words):
        found, runs = commands.add_parser(name, help=words), name in ("run", "campaign")
        label = {"required": True} if runs else {"default": "after"}
        found.add_argument("--label", help="name of the engine's version, a part of the key", **label)
        found.add_argument("--results", type=Path, help="file of results, by default results/LABEL.jsonl")
        return found

    for name, words in (
        ("run", "run scenes"), ("campaign", "make all runs that score, fit and chart need"),
    ):  # fmt: skip
        found = command(name, words)
        most = "nine" if name == "run" else "nine,fit,held-out,dilatant"
        found.add_argument(
            "--scenes", default=most, help="nine, fit, held-out, dilatant, or names with commas between them"
        )
        found.add_argument("--processes", type=int, default=1, help="runs at a time")
        if name == "campaign":
            found.add_argument("--short", action="store_true", help="default steps only, of an engine before a change")
        else:
            found.add_argument("--particles", default="500,1000", help="numbers with commas between them")
            found.add_argument("--variations", default="", help="words of variations.py with commas between them")
    repeated = command("repeat", "make some kept runs of at most 1000 particles again, and compare every digit")
    repeated.add_argument("--scenes", default="nine,fit,held-out", help="as for a campaign")
    repeated.add_argument("--count", type=int, default=40, help="number of runs, drawn at random")
    repeated.add_argument("--seed", type=int, default=1, help="of the draw")
    command("score", "print the tables of fitted and of unseen scenes")
    command("fit", "print constants fitted to the scenes to fit")
    command("presets", "print what faster steps and an earlier rest cost and change")
    command("compare", "print errors against particles before and after a change")
    command("chart", "the same, and draw fidelity.png and convergence.png of docs/figures")
    commands.add_parser("seeds", help="write the table of draws anew")
    return parser.parse_args(arguments)


def main(arguments=None) -> int:
    """Carry out a command; 1: unseen scenes miss what must be reached."""
    options = parse(arguments)
    if options.command == "seeds":
        draws = take_draws([*FIT, *HELD_OUT, *DILATANT], lambda line: print(line, flush=True))
        TABLE.write_text(json.dumps(draws, indent=0) + "\n")
        return 0
    path = options.results or RESULTS / f"{options.label}.jsonl"
    if options.command in ("run", "campaign"):
        run_all(wanted_runs(options), path, options.processes, lambda line: print(line, flush=True))
        return 0

    kept_runs = {run: result for run, result in read(path).items() if run.label == options.label}
    if options.command == "repeat":
        from benchmarks.fidelity.repeat import draw_runs, print_repeated

        drawn = draw_runs(kept_runs, scenes_of(options.scenes), options.count, options.seed)
        return 0 if print_repeated(kept_runs, drawn) else 1

    # not for an older version of the package
    from benchmarks.fidelity.replay import by_scene

    scenes = by_scene(kept_runs)
    if options.command == "fit":
        from benchmarks.fidelity.fit import print_fit

        print_fit(scenes, SETS["fit"])
    elif options.command == "score":
        from benchmarks.fidelity.score import print_scores

        print_scores(scenes, SETS["nine"], "the nine")
        print_scores(scenes, SETS["fit"], "to fit")
        good = print_scores(scenes, SETS["held-out"], "unseen")
        print_scores(scenes, SETS["dilatant"], "with dilatancy, unseen")
        return 0 if good else 1
    elif options.command == "presets":
        from benchmarks.fidelity.presets import print_presets

        print_presets(scenes, [*SETS["nine"], *SETS["fit"]])
    else:
        from benchmarks.fidelity.convergence import print_convergence

        before = by_scene(read(RESULTS / "before.jsonl"))
        print_convergence(scenes, before)
        if options.command == "chart":
            from benchmarks import charts

            charts.make("fidelity", "convergence")
    return 0


def kept(label: str):
    """Return the stored results of a label, by scene."""
    from benchmarks.fidelity.replay import by_scene

    return by_scene({run: result for run, result in read(RESULTS / f"{label}.jsonl").items() if run.label == label})


def chart_of_cost():
    """Return the figure of error against cost, and of stated against true errors."""
    from benchmarks.fidelity.chart import draw_error_and_cost

    return draw_error_and_cost(kept("after"))


def chart_of_convergence():
    """Return the figure of errors against the number of particles, before and after a change."""
    from benchmarks.fidelity.convergence import draw_convergence

    return draw_convergence(kept("after"), kept("before"))


def scenes_of(words: str) -> list[str]:
    """Return the names of scenes from sets and names with commas between them."""
    return [name for word in words.split(",") for name in SETS.get(word, [word])]


def wanted_runs(options) -> list[Run]:
    """Return the runs that a command asks for."""
    scenes = scenes_of(options.scenes)
    if options.command == "campaign":
        return campaign(options.label, scenes, options.short)
    return [
        Run(options.label, scene, int(count), variation)
        for variation in options.variations.split(",")
        for count in options.particles.split(",")
        for scene in scenes
    ]


if __name__ == "__main__":
    sys.exit(main())
