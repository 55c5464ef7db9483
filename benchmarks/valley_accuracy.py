"""Accuracy of the demo's scene against its cost: ``python -m benchmarks.valley_accuracy --against REVISION=PYTHON``.

The stand-in for Tsing Shan to rest with 250 to 8000 particles, each number five times within 3 %, because an event
depends a little on where particles lie: CPU time is the median, errors are root mean squares over the five. They are
against the mean of three runs with some 16 000 particles in steps 4 times shorter. Another version (REVISION) runs the
same in turns. Keeps benchmarks/results/valley_accuracy.json, from which docs/figures/valley_accuracy.png is made.
"""

import argparse
import json

import numpy as np
from rich.console import Console
from rich.table import Table

from benchmarks import charts, ratio_turns, result_files, style
from benchmarks.step_stability import VERSIONS, chosen, named

COMMAND = "python -m benchmarks.valley_accuracy --against REVISION=PYTHON"
COUNTS = 250, 500, 1000, 2000, 4000, 8000
AROUND = 0.97, 0.985, 1.0, 1.015, 1.03
FINEST, SHORTER = (15_700, 16_000, 16_300), 4
TICKS = 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100
MEASURES = {
    "run_out": "run-out (99 % of the deposit) [m]", "centre": "centre of deposit [m]", "eroded": "eroded volume [m³]"
}  # fmt: skip


def measure(others, quick, say) -> dict:
    """Return the exact values and a row for each version and number of particles."""
    rows, names = [], [ratio_turns.HERE, *others]
    with ratio_turns.versions(others) as (sides, grounds, _):

        def ask(side, **keywords):
            return json.loads(side.ask(json.dumps(["to_rest", keywords])))

        for side in sides:
            side.begin(str(ratio_turns.PROGRAM), grounds)
            ask(side, count=50)
        finest = [ask(sides[0], count=count, shorter=SHORTER) for count in ((4000,) if quick else FINEST)]
        exact = {key: float(np.mean([run[key] for run in finest])) for key in MEASURES}
        for count in COUNTS[:3] if quick else COUNTS:
            found = []
            for k, factor in enumerate(AROUND):
                particles = round(count * factor)
                found += ratio_turns.turns(sides, 1, lambda side, n=particles: ask(side, count=n), first=k)
            for place, name in enumerate(names):
                runs = [turn[place] for turn in found]
                row = {"revision": name, "particles": count, "cpu": float(np.median([run["cpu"] for run in runs]))}
                row["steps"] = float(np.mean([run["steps"] for run in runs]))
                for key, value in exact.items():
                    row[key] = float(np.sqrt(np.mean([(run[key] - value) ** 2 for run in runs])))
                rows.append(row)
            say(f"{count} particles")
        for side in sides:
            side.end()
    return {"revisions": list(others), "exact": exact, "rows": rows}


def show(found, console) -> None:
    """Print the table."""
    table = Table(title=f"Errors of the valley at rest, against {found['exact']}", title_justify="left")
    for head in ("version", "particles", "steps", "CPU [s]", *MEASURES.values()):
        table.add_column(head, justify="left" if head == "version" else "right", no_wrap=True)
    for row in found["rows"]:
        errors = (f"{row[key]:.1f}" for key in MEASURES)
        table.add_row(row["revision"], f"{row['particles']}", f"{row['steps']:.0f}", f"{row['cpu']:.2f}", *errors)
    console.print(table)


def chart():
    """Return the figure: errors against CPU time."""
    found = result_files.read("valley_accuracy")
    figure, axes = style.panels(1, 3, (13.5, 4.6))
    for axis, (key, words) in zip(axes[0], MEASURES.items(), strict=True):
        for version, (colour, mark) in zip([ratio_turns.HERE, *found["revisions"]], VERSIONS, strict=False):
            rows = chosen(found["rows"], revision=version)
            axis.plot(
                [row["cpu"] for row in rows], [row[key] for row in rows], marker=mark, ms=5, lw=1.2, color=colour,
                label=named(version),
            )  # fmt: skip
        style.finish(axis, xscale="log", yscale="log", xlabel="CPU time, one thread [s]", title=f"Error of {words}")
        for scale, which in ((axis.set_xticks, axis.get_xlim()), (axis.set_yticks, axis.get_ylim())):
            ticks = [tick for tick in TICKS if which[0] <= tick <= which[1]]
            scale(ticks, [f"{tick:g}" for tick in ticks])
        axis.minorticks_off()
    low, high = found["rows"][0]["particles"], found["rows"][-1]["particles"]
    style.legend_below(figure, axes[0, 0], ncol=3, title=f"{low} to {high} particles, from left to right")
    return figure


def main() -> None:
    """Measure as the command line says."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--against", default=[], action="append", **ratio_turns.VERSION)
    parser.add_argument("--quick", action="store_true", help="few particles only; prints, and keeps nothing")
    options = parser.parse_args()
    console = Console(width=140)
    told = result_files.provenance(COMMAND)
    found = measure(dict(options.against), options.quick, console.log)
    show(found, console)
    if not options.quick:
        result_files.keep("valley_accuracy", found, COMMAND, told)
        charts.make("valley_accuracy")


if __name__ == "__main__":
    main()
