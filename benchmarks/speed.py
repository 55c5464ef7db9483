"""Speed: ``python -m benchmarks.speed [--quick] [--peer PYTHON]``; some ten minutes in all.

With ``--against PYTHON``, an interpreter that has another version of the package, nothing but the cost of both is
measured, in turns (speed_against.py).

Rates in million particle-steps per second, N = 1e3 ... 1e6, beside what the machine can do; where the time of a scene
goes; the scene, ensembles of it and the start; what a larger raster costs; with --peer, an interpreter that
has avaframe 2.1, com1DFA at equal numbers and at equal error. Figures of one thread are CPU time, those of two wall
time, which others on the machine lengthen: its load stands on top. Least or median of repeats, as each table says.
Keeps benchmarks/results/speed.json, from which benchmarks/speed.txt and docs/figures/speed.png are made. How each is
measured: speed_machine.py, speed_engine.py, speed_scene.py, speed_grids.py, speed_peer.py.
"""

import argparse
import sys

from rich.console import Console
from rich.table import Table

from benchmarks import charts, result_files, speed_against, style
from benchmarks import speed_engine as engine
from benchmarks import speed_grids as grids
from benchmarks import speed_machine as machine
from benchmarks import speed_peer as peers
from benchmarks import speed_scene as scenes
from validation.rivals import com1dfa

SUMS, STEPS = "density + force", "whole step"
COLOUR = {SUMS: style.BLUE, STEPS: style.ORANGE, "demo's physics": style.GREEN, "com1DFA": style.RED}
STEPPED = {1_000: (5.0, 5), 10_000: (5.0, 3), 100_000: (2.0, 2), 1_000_000: (0.5, 1)}  # seconds run, repeats
DEMO = {1_000: (5.0, 3), 10_000: (5.0, 2), 100_000: (1.0, 1)}
CURVES = {
    SUMS: "sums over neighbours (density and force)", STEPS: "whole step without columns",
    "demo's physics": "whole step with erosion and columns", "com1DFA": "AvaFrame com1DFA 2.1, whole step",
}  # fmt: skip
COMMAND = "python -m benchmarks.speed"


class Report:
    """All tables, and the curves of the chart."""

    def __init__(self, say):
        self.put, self.tables, self.curves = say, [], []

    def add(self, title, heads, rows):
        """Note a table: title, headings and rows of words."""
        self.tables.append({"title": title, "heads": list(heads), "rows": [list(row) for row in rows]})

    def curve(self, name, n, one, two):
        """Note a point of the chart: rate with one thread and with two [million particle steps per second]."""
        self.curves.append({"curve": name, "particles": n, "one": one, "two": two})

    def of_the_machine(self):
        found = machine.measure()
        rows = [(name, *(f"{v:.1f}" for v in values)) for name, values in found.items()]
        self.add("The machine (wall time, best of some)", ("quantity", "one thread", "two"), rows)
        return found["peak, 32 bits [GF/s]"][0]

    def of_the_sums(self, counts, peak):
        heads = (
            "particles", "M/s, one thread", "M/s, two", "sorting, ns", "pairs computed", "in reach", "GF/s", "of peak",
        )  # fmt: skip
        rows = []
        for n in counts:
            flow = engine.cap(n)
            flow.run_one_step(0.1 if n > 200_000 else 0.5)
            row = engine.sums(flow, 40 if n < 50_000 else 15 if n < 500_000 else 5)
            rates = n / row.cpu / 1e6, n / row.walls[1] / 1e6
            flops = engine.FLOPS * row.computed * n / (row.cpu - row.sorting) / 1e9
            rows.append((
                f"{n}", f"{rates[0]:.2f}", f"{rates[1]:.2f}", f"{1e9 * row.sorting / n:.0f}", f"{row.computed:.0f}",
                f"{row.acting:.1f}", f"{flops:.1f}", f"{flops / peak:.0%}",
            ))  # fmt: skip
            self.curve(SUMS, n, *rates)
            self.put(f"{SUMS}, {n}: {rates[0]:.2f} M/s")
        self.add(f"{SUMS}, a spreading cap, least of some passes", heads, rows)

    def of_the_steps(self, word, make, runs):
        rows = []
        for n, (duration, repeats) in runs.items():
            row = engine.whole(n, lambda threads, n=n: make(n, threads), duration, repeats)
            rates = n / row.cpu / 1e6, n / row.walls[1] / 1e6
            rows.append((f"{n}", f"{row.steps}", *(f"{r:.2f}" for r in rates)))
            self.curve(STEPS if "similarity" in word else "demo's physics", n, *rates)
            self.put(f"{STEPS}, {word}, {n}: {rates[0]:.2f} M/s")
        title = f"{STEPS}, {word}, all of a call included, least of some runs"
        self.add(title, ("particles", "steps", "M/s, one thread", "M/s, two"), rows)

    def of_the_stages(self, counts, repeats):
        found = {n: engine.profile(lambda n=n: engine.valley(n), repeats) for n in counts}
        heads = [f"{n}: {unit}" for n in counts for unit in ("ms", "ns", "%")]
        rows = []
        for name in next(iter(found.values()))[0]:
            cells = []
            for spent, done in found.values():
                cells += [
                    f"{1e3 * spent[name]:.1f}",
                    f"{1e9 * spent[name] / done.awake:.0f}",
                    f"{100 * spent[name] / spent['all']:.1f}",
                ]
            rows.append((name, *cells))
        self.add("The demo's scene by stage: CPU ms, ns per particle and step, part", ("stage", *heads), rows)

    def of_scenes(self, counts, repeats):
        rows = []
        for n in counts:
            row = scenes.scene(n, repeats)
            times = f"{row.cpu:.2f}", f"{row.least:.2f}"
            rows.append((f"{n}", *times, f"{row.steps}", f"{row.asleep:.1%}", f"{row.volume:.0f}"))
            self.put(f"scene, {n}: {row.cpu:.2f} s")
        heads = ("particles", "CPU s, median", "least", "steps", "asleep", "deposited m3")
        self.add("The demo's valley to rest, 11 levels", heads, rows)
        rates, cpu = scenes.ensemble(2)
        rows = [(name, f"{rate:.0f}") for name, rate in rates.items()]
        rows.append(("two threads, if both cores were theirs (120 s over CPU s)", f"{120.0 / cpu:.0f}"))
        title = f"{scenes.MEMBERS} scenes of {scenes.MEMBER} particles on two cores, best of two"
        self.add(title, ("way", "scenes a minute, wall"), rows)
        cold, warm = scenes.start()
        rows = [("kernels read from the cache", f"{warm:.2f}"), ("kernels compiled", f"{cold:.1f}")]
        self.add("Import and first step, beyond the import of landlab", ("start", "CPU s"), rows)

    def of_rasters(self, pairs):
        touched, times = grids.compare(pairs)
        small, large = touched
        rows = []
        for word, field in (("erosion", "eroded"), ("the record", "shown")):
            a, b = getattr(small, field), getattr(large, field)
            apart = sum(p != q for p, q in zip(a, b, strict=True)) if len(a) == len(b) else "other"
            name = f"nodes touched by {word} in {len(a)} turns, {apart} of them unlike"
            rows.append((name, f"{sum(a)}", f"{sum(b)}", f"{sum(b) / sum(a):.4f}"))
        kept = sum(small.kept), sum(large.kept)
        name = "node values kept in case of an error, whole rows"
        rows.append((name, *(f"{k}" for k in kept), f"{kept[1] / kept[0]:.1f}"))
        rows += [(f"CPU s of the {name}", f"{a:.3f}", f"{b:.3f}", f"{r:.2f}") for name, (a, b, r) in times.items()]
        one, other = (grids.memory(**each) for each in (grids.SMALL, grids.LARGE))
        for name, field in (
            ("fields", "fields"),
            ("after a call, besides", "after"),
            ("in it at most, besides", "most"),
        ):
            here, there = getattr(one, field), getattr(other, field)
            rows.append((f"bytes per node, {name}", f"{here:.0f}", f"{there:.0f}", f"{there / here:.2f}"))
        title = f"One event on 200 x 200 and on 2000 x 2000 nodes, medians of {pairs} turns"
        self.add(title, ("quantity", "200", "2000", "ratio"), rows)

    def of_the_peer(self, python, radii):
        both, equal = peers.compare(python, radii, self.put)
        heads = (
            "particles", "its steps", "ours", "its CPU s", "ours", "its M/s", "ours", "ratio", "its L2, raster",
            "its L2, particles", "our L2, raster", "particles",
        )  # fmt: skip
        rows = []
        for its, mine in both:
            rows.append((
                f"{its.particles}", f"{its.steps}", f"{mine.steps}", f"{its.cpu:.2f}", f"{mine.cpu:.3f}",
                f"{its.rate:.2f}", f"{mine.rate:.2f}", f"{mine.rate / its.rate:.1f}", f"{its.raster_error:.4f}",
                f"{its.particle_error:.4f}", f"{mine.raster_error:.4f}", f"{mine.particle_error:.4f}",
            ))  # fmt: skip
            self.curve("com1DFA", its.particles, its.rate, None)
        self.add("com1DFA and ours, similarity solution, equal numbers", heads, rows)
        heads = ("L2 of h", "to reach", "its particles", "CPU s", "ours", "CPU s", "its CPU over ours")
        rows = []
        for word, (error, its, mine) in equal.items():
            ends = (f"{mine.particles}", f"{mine.cpu:.3f}", f"{its.cpu / mine.cpu:.0f}") if mine else ("none", "", "")
            rows.append((word, f"{error:.4f}", f"{its.particles}", f"{its.cpu:.2f}", *ends))
        self.add("At the error of its best row", heads, rows)


def show(tables, console) -> None:
    """Print tables of a report."""
    for one in tables:
        made = Table(title=one["title"].replace("[", r"\["), title_justify="left")
        made.add_column(one["heads"][0], no_wrap=True)
        for word in one["heads"][1:]:
            made.add_column(word, justify="right")
        for row in one["rows"]:
            made.add_row(*(word.replace("[", r"\[") for word in row))
        console.print(made)


def report() -> str:
    """Return the text of benchmarks/speed.txt."""
    found = result_files.read("speed")
    told = found["measured"]

    def print_all(console):
        console.print(f"{told['processor']}, {told['cores']} cores; load before: {told['load']}\n")
        show(found["tables"], console)

    return charts.printed(print_all, width=180)


def chart():
    """Return the figure: rates against the number of particles."""
    points = result_files.read("speed")["curves"]
    figure, axes = style.panels(1, 1, (9.4, 5.6))
    axis = axes[0, 0]
    for name, colour in COLOUR.items():
        rows = [point for point in points if point["curve"] == name]
        if not rows:
            continue
        n, one, two = ([row[key] for row in rows] for key in ("particles", "one", "two"))
        words = CURVES[name]
        axis.plot(n, one, color=colour, marker="D" if name == "com1DFA" else "o", label=f"{words}, one thread")
        if name != "com1DFA":
            axis.plot(n, two, color=colour, marker="o", mfc="none", ls="--", label=f"{words}, two (wall)")
    style.finish(
        axis, xscale="log", yscale="log", xlabel="number of particles", ylabel="million particle steps per second",
        xlim=(7e2, 1.4e6),
    )  # fmt: skip
    low, high = axis.get_ylim()
    ticks = [tick for tick in (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50) if low <= tick <= high]
    axis.set_yticks(ticks, [f"{tick:g}" for tick in ticks])
    style.legend_below(figure, axis, ncol=2)
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="few particles only; prints, and keeps nothing")
    parser.add_argument("--peer", metavar="PYTHON", type=com1dfa.interpreter, help="an interpreter with avaframe==2.1")
    parser.add_argument("--against", metavar="PYTHON", help="an interpreter with another version of the package")
    options = parser.parse_args()
    if options.against:
        sys.exit(not speed_against.compare(options.against, 2 if options.quick else speed_against.PROCESSES))
    most = 10_000 if options.quick else 1_000_000
    console = Console(width=180)
    command = f"{COMMAND} --peer PYTHON" if options.peer else COMMAND
    told = result_files.provenance(command)  # before it makes a load itself
    made = Report(console.log)
    engine.cap(1000).run_one_step(1.0)  # compiles
    engine.valley(200).run_one_step(5.0)
    made.of_the_sums([n for n in STEPPED if n <= most], made.of_the_machine())
    made.of_the_steps("similarity solution (Coulomb, no column, no erosion)", engine.cap, _up_to(STEPPED, most))
    made.of_the_steps("the demo's valley (erosion, columns)", engine.placed_valley, _up_to(DEMO, most))
    made.of_the_stages((1500, 5000), 1 if options.quick else 3)
    made.of_scenes((1500, 5000), 1 if options.quick else 5)
    made.of_rasters(1 if options.quick else 7)
    if options.peer:
        made.of_the_peer(options.peer, peers.RADII[: 2 if options.quick else None])
    if options.quick:
        show(made.tables, console)
        return
    result_files.keep("speed", {"tables": made.tables, "curves": made.curves}, command, told)
    charts.make("speed")


def _up_to(runs, most):
    return {n: rest for n, rest in runs.items() if n <= most}


if __name__ == "__main__":
    main()
