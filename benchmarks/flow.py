"""Accuracy of the flow against its cost: ``python -m benchmarks.flow [--quick] [--peer PYTHON]``.

Every case runs with the shipped engine through its public interface and one default setting; beside it the same
engine with fixed smoothing lengths (the paper's class of SPH), a plain finite-volume scheme and, with --peer, an
interpreter that has avaframe 2.1, com1DFA. Norms are defined in validation/measure.py, what is measured where in
validation/cases. Keeps benchmarks/results/flow.json and, with --peer, flow_com1dfa.json, from which benchmarks/flow.txt
and docs/figures/flow.png are made.

With --against NAME=FOLDER, NAME is a version and FOLDER its checkout, whose own cases run with its own engine in turns
with ours; CPU times of both are medians of three turns, and the figure has a curve more.

One setting is not the default's: settling is off, so that there are particles to look at.

Errors of ours are those at the particles; beside them stands what the raster shows. In the panels of dam breaks CPU
time is that of twelve rows: of ours their part of the whole width, of finite volumes twelve times one row. com1DFA
takes a whole body, and its errors are those of its raster.
"""

import argparse
import math
import statistics
from contextlib import nullcontext
from dataclasses import asdict, replace
from functools import partial

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from benchmarks import charts, result_files, style
from benchmarks.checkout_calls import checkouts
from benchmarks.ratio_turns import named_version, turns
from validation import comparison
from validation.cases import basins, blocks, planes
from validation.measure import Norms, Result
from validation.rivals import com1dfa

STRIPS = "Ritter", "Stoker", "Mangeney", "dam break 22/21"


def _cases():
    """Yield case, how to run ours, numbers for ours, how to run finite volumes, numbers for them."""
    along, rows = (48, 96, 198), (50, 100, 200, 400)
    for case in (planes.ritter, planes.stoker, planes.mangeney):
        name = case.__name__.capitalize()
        yield name, case, along, partial(comparison.dam_break, name), rows
    yield "dam break 22/21", planes.slope_dam_break, along, comparison.slope_dam_break, rows
    many, cells = (500, 2000, 8000), (40, 80, 160)
    yield "similarity", planes.similarity, many, comparison.similarity, cells
    yield "cap 30 deg", planes.cap, many, comparison.cap, (*cells, 320)
    for case in (basins.thacker_planar, basins.thacker_curved):
        name = case.__name__.replace("_", " ").capitalize()
        yield name, case, many, partial(comparison.thacker, name), cells
    for word, ahead in (("wet", 0.1), ("dry", 0.0)):
        ours, volumes = partial(basins.circular_dam_break, ahead=ahead), partial(comparison.circular_dam, ahead=ahead)
        yield f"circular dam, {word}", ours, (1000, 4000, 16000), volumes, cells


CASES = {name: rest for name, *rest in _cases()}
MARKS = {
    "ours": (style.BLUE, "o", "this package"),
    "before": (style.SKY, "v", "this package, an earlier version"),
    "fixed length": (style.ORANGE, "s", "SPH with a fixed smoothing length"),
    "finite volume": (style.GREEN, "^", "finite volumes, second order"),
    "com1DFA": (style.RED, "D", "AvaFrame com1DFA 2.1"),
}
TITLES = {
    "Ritter": "Ritter: dam break, dry and level", "Stoker": "Stoker: dam break on standing water",
    "Mangeney": "Mangeney: dam break, dry slope", "dam break 22/21": "dam break, slope 22°, friction 21°",
    "similarity": "similarity solution, slope 35°", "cap 30 deg": "spreading cap, slope 30°",
    "Thacker planar": "Thacker: basin, level surface", "Thacker curved": "Thacker: basin, curved surface",
    "circular dam, wet": "circular dam on standing water", "circular dam, dry": "circular dam, dry",
}  # fmt: skip


def kept() -> list[Result]:
    """Return the results of the files, com1DFA between the cases of the chart and those without a rival."""
    rows, peer = (result_files.read(name)["results"] for name in ("flow", "flow_com1dfa"))
    rows = sorted([*rows, *peer], key=lambda row: (row["case"] not in CASES, row["method"] == "com1DFA"))
    return [result(row) for row in rows]


def methods(results) -> dict[str, tuple[str, str, str]]:
    """Return colour, mark and name of the methods that results have."""
    there = {run.method for run in results}
    return {method: mark for method, mark in MARKS.items() if method in there}


TURNS = 3


def in_turns(asking, case, numbers) -> list[Result]:
    """Return the results of ours and of another checkout, taken in turns."""
    results = []
    for number in numbers:
        found = turns(asking, TURNS, lambda ask, number=number: ask("flow", case, number))
        for k, method in enumerate(("ours", "before")):
            run, cpu = result(found[0][k]), statistics.median(turn[k]["cpu"] for turn in found)
            results.append(replace(run, method=method, cpu=cpu))
    return sorted(results, key=lambda run: run.method != "ours")


def result(row) -> Result:
    """Return a result from its mapping."""
    return Result(**row | {"h": Norms(*row["h"]), "hu": Norms(*row["hu"])})


def charted(quick, put, asking=()):
    """Run all methods on the cases of the chart; with `asking`, two checkouts, both engines in turns."""
    results = []
    for case, (ours, numbers, volumes, cells) in CASES.items():
        cut = slice(0, 2 if quick else None)
        ours(numbers[0])  # compiles
        for ask in asking:
            ask("flow", case, numbers[0])
        runs = [(partial(comparison.fixed, ours), n) for n in numbers[:2]]  # it does not converge
        runs += [(volumes, n) for n in cells[cut]]
        own = in_turns(asking, case, numbers[cut]) if asking else (ours(n) for n in numbers[cut])
        results += [*map(put, own), *(put(run(n)) for run, n in runs)]
    return results


def uncharted(quick, put):
    """Run ours on the cases without a rival."""
    size = 1 if quick else 4
    results = [put(planes.cap(500 * size, degrees)) for degrees in (0.0, 15.0, 45.0)]
    results += [put(planes.ridge(n)) for n in (24, 48)[: 1 if quick else 2]]
    results += [put(case(48, walls=True)) for case in (planes.ritter, planes.stoker, planes.mangeney)]
    results += [put(blocks.block(500, degrees)) for degrees in (0.0, 10.0, 16.0, 20.0, 30.0, 45.0, 60.0)]
    results += [put(blocks.eroding_block(300)), put(blocks.consolidating_block(400))]
    results += [put(blocks.resting_slab(200)), put(blocks.stopping_slab(300))]
    for n in (1000, 4000, 16000)[: 1 if quick else 3]:
        results += [put(basins.lake_damped(n)), put(basins.lake_rough(n))]
    finest, fields = basins.curved_channel(2000 * size)
    results += [put(basins.curved_channel(n, finest=fields)[0]) for n in (500, 2000)[: 1 if quick else 2]]
    return [*results, put(finest)]


def order(results, result):
    """Return the observed order of L1 of h in the particles' spacing, from the run before of the same kind."""
    same = [r for r in results if (r.case, r.method) == (result.case, result.method)]
    at = same.index(result)
    # `along` of a body in the plane is the root of the number of particles; com1DFA's spacing is its kernel radius
    ratio = result.along / same[at - 1].along if at else 1.0
    if result.method == "com1DFA" and at:
        ratio = same[at - 1].scalars["kernel radius [m]"] / result.scalars["kernel radius [m]"]
    return math.log(same[at - 1].h.l1 / result.h.l1) / math.log(ratio) if at and ratio > 1.0 else math.nan


def tables(results, console) -> None:
    """Print errors, then the measures that only one case has."""
    errors = Table(title="Relative errors (definitions: validation/measure.py)", title_justify="left")
    words = ("case", "method", "along", "all", "steps", "CPU s", "M/s")
    words += (*(f"{norm} {field}" for field in ("h", "hu") for norm in ("L1", "L2", "max")), "order")
    for word in words:
        errors.add_column(word, justify="left" if word in ("case", "method") else "right", no_wrap=True)
    for r in results:
        if not math.isnan(r.h.l1):
            numbers = [f"{v:.4f}" for v in (*r.h, *r.hu)]
            now = order(results, r)
            row = [r.case, r.method, str(r.along), str(r.particles), str(r.steps), f"{r.cpu:.3g}", f"{r.rate:.2f}"]
            errors.add_row(*row, *numbers, "" if math.isnan(now) else f"{now:.2f}")
    console.print(errors)
    special = Table(title="Measures of single cases (ours, fixed length, com1DFA)", title_justify="left")
    for word in ("case", "method", "all", "steps", "CPU s", "measures"):
        special.add_column(
            word, no_wrap=word != "measures", justify="right" if word in ("all", "steps", "CPU s") else "left"
        )
    for r in results:
        if r.scalars:
            text = ", ".join(f"{name} {value:.3g}" for name, value in r.scalars.items() if not math.isnan(value))
            special.add_row(r.case, r.method, str(r.particles), str(r.steps), f"{r.cpu:.3g}", escape(text))
    console.print(special)


def report() -> str:
    """Return the text of benchmarks/flow.txt."""
    return charts.printed(lambda console: tables(kept(), console), width=190)


def chart():
    """Return the figure: error against CPU time, one panel per case."""
    results = kept()
    figure, axes = style.panels(2, 5, (15.5, 7.0), sharey=True, sharex=True)
    for axis, case in zip(axes.ravel(), CASES, strict=True):
        for method, (colour, mark, words) in methods(results).items():
            these = [r for r in results if (r.case, r.method) == (case, method)]
            times = [max(r.cpu, 1e-3) for r in these]
            mark_of = {"color": colour, "marker": mark, "ms": 5}
            axis.plot(times, [100.0 * r.h.l1 for r in these], lw=1.3, label=words, **mark_of)
            axis.plot(times, [100.0 * r.hu.l1 for r in these], lw=0.9, ls=":", mfc="none", **mark_of)
        words = TITLES[case] + ("\n(time of 12 rows)" if case in STRIPS else "")
        style.finish(axis, xscale="log", yscale="log", ylim=(0.1, 100.0), xlim=(2e-3, 40.0), title=words)
        axis.set_yticks([0.1, 1.0, 10.0, 100.0], ["0.1", "1", "10", "100"])
        axis.set_xticks([0.01, 0.1, 1.0, 10.0], ["0.01", "0.1", "1", "10"])
    for axis in axes[:, 0]:
        axis.set_ylabel("relative L1 error [%]")
    for axis in axes[1]:
        axis.set_xlabel("CPU time, one thread [s]")
    words = "Full lines and marks: thickness h. Dotted, open: momentum hu. More particles or cells to the right."
    style.legend_below(figure, axes[0, 0], ncol=5, title=words)
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="few particles only; prints, and keeps nothing")
    parser.add_argument("--peer", metavar="PYTHON", type=com1dfa.interpreter, help="an interpreter with avaframe==2.1")
    parser.add_argument("--against", metavar="NAME=FOLDER", type=named_version, help="another version and its checkout")
    options = parser.parse_args()
    console = Console(width=190)

    def put(result):
        console.log(f"{result.case}, {result.method}, {result.along}: {result.cpu:.2f} CPU s")
        return result

    with checkouts(dict([options.against])) if options.against else nullcontext(()) as asking:
        results = [*charted(options.quick, put, asking), *uncharted(options.quick, put)]
    peer = [put(result) for result in com1dfa.results(options.peer, options.quick)] if options.peer else []
    if options.quick:
        tables([*results, *peer], console)
        return
    command = "python -m benchmarks.flow" + (" --against NAME=FOLDER" if options.against else "")
    data = {"before": options.against[0] if options.against else "", "results": [asdict(r) for r in results]}
    result_files.keep("flow", data, command)
    if peer:
        command = "python -m benchmarks.flow --peer PYTHON"
        result_files.keep("flow_com1dfa", {"results": [asdict(r) for r in peer]}, command)
    charts.make("flow")


if __name__ == "__main__":
    main()
