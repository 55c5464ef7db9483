"""Speed: ``python -m benchmarks.speed [--quick] [--peer PYTHON]``; some ten minutes in all.

With ``--against PYTHON``, an interpreter that has another version of the package, nothing but the cost of both is
measured, in turns (speed_against.py).

Rates in million particle-steps per second, N = 1e3 ... 1e6, beside what the machine can do; where the time of a scene
goes; the scene, ensembles of it and the start; what a larger raster costs; with --peer, an interpreter that
has avaframe 2.1, com1DFA at equal numbers and at equal error. Figures of one thread are CPU time, those of two wall
time, which others on the machine lengthen: its load stands on top. Least or median of repeats, as each table says.
Writes benchmarks/speed.txt and docs/speed.png. What is measured how: speed_machine.py, speed_engine.py,
speed_scene.py, speed_grids.py, speed_peer.py.
"""

import argparse
import os
import sys
from pathlib import Path

import matplotlib.pyplot as plt
from rich.console import Console
from rich.table import Table

from benchmarks import speed_against
from benchmarks import speed_engine as engine
from benchmarks import speed_grids as grids
from benchmarks import speed_machine as machine
from benchmarks import speed_peer as peers
from benchmarks import speed_scene as scenes
from validation.rivals import com1dfa

SUMS, STEPS = "density + force", "whole step"
REACH = {SUMS: (7.0, 10.0), STEPS: (3.5, 7.0)}  # M particle-steps/s, one thread: to reach, ambitious
COLOUR = {SUMS: "tab:blue", STEPS: "tab:orange", "demo's physics": "tab:green", "com1DFA": "tab:red"}
STEPPED = {1_000: (5.0, 5), 10_000: (5.0, 3), 100_000: (2.0, 2), 1_000_000: (0.5, 1)}  # seconds run, repeats
DEMO = {1_000: (5.0, 3), 10_000: (5.0, 2), 100_000: (1.0, 1)}
JUDGED = {4.125: 8.0, 2.0: 15.0}  # kernel radii of com1DFA [m] at which the ratio of rates is judged


def table(title, first, *others):
    made = Table(title=title, title_justify="left")
    made.add_column(first, no_wrap=True)
    for word in others:
        made.add_column(word, justify="right")
    return made


class Report:
    """All tables, the targets with what was measured, and what the chart shows."""

    def __init__(self, console):
        self.console, self.tables, self.targets, self.curves = console, [], [], {}

    def put(self, words):
        self.console.log(words)

    def aim(self, what, measured, least=None, most=None, ambitious=None):
        """Note a target: a number to be at least, or at most, and an ambitious one."""
        good = measured >= least if least is not None else measured <= most
        best = ambitious is not None and (measured >= ambitious if least is not None else measured <= ambitious)
        limit = f">= {least:g}" if least is not None else f"<= {most:g}"
        limit += f" ({ambitious:g})" if ambitious is not None else ""
        self.targets.append(
            (what, f"{measured:.3g}", limit, "reached, ambitious too" if best else "reached" if good else "short")
        )

    def of_the_machine(self):
        found = machine.measure()
        made = table("The machine (wall time, best of some)", "what", "one thread", "two")
        for name, values in found.items():
            made.add_row(name.replace("[", r"\["), *(f"{v:.1f}" for v in values))
        self.tables.append(made)
        return found["peak, 32 bits [GF/s]"][0]

    def of_the_sums(self, counts, peak):
        made = table(
            f"{SUMS}, a spreading cap, least of some passes", "particles", "M/s, one thread", "M/s, two", "sorting, ns",
            "pairs computed", "in reach", "GF/s", "of peak",
        )  # fmt: skip
        for n in counts:
            flow = engine.cap(n)
            flow.run_one_step(0.1 if n > 200_000 else 0.5)
            row = engine.sums(flow, 40 if n < 50_000 else 15 if n < 500_000 else 5)
            rates = n / row.cpu / 1e6, n / row.walls[1] / 1e6
            flops = engine.FLOPS * row.computed * n / (row.cpu - row.sorting) / 1e9
            made.add_row(
                f"{n}", f"{rates[0]:.2f}", f"{rates[1]:.2f}", f"{1e9 * row.sorting / n:.0f}", f"{row.computed:.0f}",
                f"{row.acting:.1f}", f"{flops:.1f}", f"{flops / peak:.0%}",
            )  # fmt: skip
            self.curve(SUMS, n, *rates)
            self.put(f"{SUMS}, {n}: {rates[0]:.2f} M/s")
        self.tables.append(made)

    def of_the_steps(self, word, make, runs):
        made = table(
            f"{STEPS}, {word}, all of a call included, least of some runs", "particles", "steps", "M/s, one thread",
            "M/s, two",
        )  # fmt: skip
        for n, (duration, repeats) in runs.items():
            row = engine.whole(n, lambda threads, n=n: make(n, threads), duration, repeats)
            rates = n / row.cpu / 1e6, n / row.walls[1] / 1e6
            made.add_row(f"{n}", f"{row.steps}", *(f"{r:.2f}" for r in rates))
            self.curve(STEPS if "similarity" in word else "demo's physics", n, *rates)
            self.put(f"{STEPS}, {word}, {n}: {rates[0]:.2f} M/s")
        self.tables.append(made)

    def curve(self, name, n, one, two):
        self.curves.setdefault(name, []).append((n, one, two))

    def of_the_stages(self, counts, repeats):
        found = {n: engine.profile(lambda n=n: engine.valley(n), repeats) for n in counts}
        heads = [f"{n}: {unit}" for n in counts for unit in ("ms", "ns", "%")]
        made = table("The demo's scene by stage: CPU ms, ns per particle and step, part", "stage", *heads)
        for name in next(iter(found.values()))[0]:
            cells = []
            for spent, done in found.values():
                cells += [
                    f"{1e3 * spent[name]:.1f}",
                    f"{1e9 * spent[name] / done.awake:.0f}",
                    f"{100 * spent[name] / spent['all']:.1f}",
                ]
            made.add_row(name, *cells)
        self.tables.append(made)

    def of_scenes(self, counts, repeats):
        made = table(
            "The demo's valley to rest, 11 levels",
            "particles",
            "CPU s, median",
            "least",
            "steps",
            "asleep",
            "deposited m3",
        )
        for n, (reach, best) in counts.items():
            row = scenes.scene(n, repeats)
            made.add_row(
                f"{n}", f"{row.cpu:.2f}", f"{row.least:.2f}", f"{row.steps}", f"{row.asleep:.1%}", f"{row.volume:.0f}"
            )
            self.aim(f"scene of {n} particles, median CPU s", row.cpu, most=reach, ambitious=best)
            self.put(f"scene, {n}: {row.cpu:.2f} s")
        self.tables.append(made)
        rates, cpu = scenes.ensemble(2)
        made = table(
            f"{scenes.MEMBERS} scenes of {scenes.MEMBER} particles on two cores, best of two",
            "way",
            "scenes a minute, wall",
        )
        for name, rate in rates.items():
            made.add_row(name, f"{rate:.0f}")
        made.add_row("two threads, if both cores were theirs (120 s over CPU s)", f"{120.0 / cpu:.0f}")
        self.tables.append(made)
        self.aim("scenes a minute, two threads", rates["two threads"], least=200, ambitious=400)
        self.aim("scenes a minute, two processes", rates["two processes"], least=200, ambitious=400)
        cold, warm = scenes.start()
        self.aim("warm start beyond landlab's import, CPU s", warm, most=1.0, ambitious=0.6)
        self.aim("cold start beyond landlab's import, CPU s", cold, most=8.0, ambitious=5.0)

    def of_rasters(self, pairs):
        touched, times = grids.compare(pairs)
        made = table(
            f"One event on 200 x 200 and on 2000 x 2000 nodes, medians of {pairs} turns", "", "200", "2000", "ratio"
        )
        small, large = touched
        for word, field in (("erosion", "eroded"), ("the record", "shown")):
            a, b = getattr(small, field), getattr(large, field)
            apart = sum(p != q for p, q in zip(a, b, strict=True)) if len(a) == len(b) else "other"
            made.add_row(
                f"nodes touched by {word} in {len(a)} turns, {apart} of them unlike",
                f"{sum(a)}",
                f"{sum(b)}",
                f"{sum(b) / sum(a):.4f}",
            )
        kept = sum(small.kept), sum(large.kept)
        made.add_row(
            "node values kept in case of an error, whole rows", *(f"{k}" for k in kept), f"{kept[1] / kept[0]:.1f}"
        )
        for name, (a, b, ratio) in times.items():
            made.add_row(f"CPU s of the {name}", f"{a:.3f}", f"{b:.3f}", f"{ratio:.2f}")
            if name != grids.SYSTEM_APART:  # it tells why, and is not what was to be reached
                self.aim(f"CPU of the {name}, 2000 x 2000 over 200 x 200", ratio, most=1.2)
        self.tables.append(made)

    def of_the_peer(self, python, radii):
        both, equal = peers.compare(python, radii, self.put)
        heads = (
            "particles", "its steps", "ours", "its CPU s", "ours", "its M/s", "ours", "ratio", "its L2, raster",
            "its L2, particles", "our L2, raster", "particles",
        )  # fmt: skip
        made = table("com1DFA and ours, similarity solution, equal numbers", *heads)
        for radius, (its, mine) in zip(radii, both, strict=True):
            ratio = mine.rate / its.rate
            made.add_row(
                f"{its.particles}", f"{its.steps}", f"{mine.steps}", f"{its.cpu:.2f}", f"{mine.cpu:.3f}",
                f"{its.rate:.2f}", f"{mine.rate:.2f}", f"{ratio:.1f}", f"{its.raster_error:.4f}",
                f"{its.particle_error:.4f}", f"{mine.raster_error:.4f}", f"{mine.particle_error:.4f}",
            )  # fmt: skip
            self.curve("com1DFA", its.particles, its.rate, None)
            if radius in JUDGED:
                self.aim(f"rate over com1DFA's at {its.particles} particles", ratio, least=JUDGED[radius])
        self.tables.append(made)
        made = table(
            "At the error of its best row",
            "L2 of h",
            "to reach",
            "its particles",
            "CPU s",
            "ours",
            "CPU s",
            "its CPU over ours",
        )
        for word, (error, its, mine) in equal.items():
            ends = (f"{mine.particles}", f"{mine.cpu:.3f}", f"{its.cpu / mine.cpu:.0f}") if mine else ("none", "", "")
            made.add_row(word, f"{error:.4f}", f"{its.particles}", f"{its.cpu:.2f}", *ends)
            if mine:
                self.aim(
                    f"CPU of com1DFA over ours at the error of its best row, {word}", its.cpu / mine.cpu, least=50.0
                )
        self.tables.append(made)

    def show(self):
        for made in self.tables:
            self.console.print(made)
        made = table("Targets", "what", "measured", "to reach (ambitious)", "verdict")
        for row in self.targets:
            made.add_row(*row)
        self.console.print(made)


def draw(curves, path) -> None:
    """Draw rates against the number of particles."""
    figure, axis = plt.subplots(figsize=(8.0, 5.2), constrained_layout=True)
    for name, rows in curves.items():
        n, one, two = zip(*rows, strict=True)
        axis.plot(n, one, color=COLOUR[name], marker="D" if name == "com1DFA" else "o", label=f"{name}, one thread")
        if two[0]:
            axis.plot(n, two, color=COLOUR[name], marker="o", mfc="none", ls="--", label=f"{name}, two (wall)")
    for name, values in REACH.items():
        for value, style, word in zip(values, ("-", ":"), ("to reach", "ambitious"), strict=True):
            axis.axhline(value, color=COLOUR[name], ls=style, lw=1.2, alpha=0.7)
            place = {"ha": "left" if name == SUMS else "right", "va": "top" if value == REACH[STEPS][0] else "bottom"}
            end = 7.3e2 if name == SUMS else 1.35e6
            axis.annotate(f"{name}, {word}", (end, value), fontsize=8, color=COLOUR[name], **place)
    axis.set(
        xscale="log",
        yscale="log",
        xlabel="particles",
        ylabel="million particle-steps per second",
        ylim=(0.15, 14.0),
        xlim=(7e2, 1.4e6),
    )
    axis.set_yticks([0.2, 0.5, 1, 2, 5, 10], ["0.2", "0.5", "1", "2", "5", "10"])
    axis.grid(alpha=0.3)
    figure.legend(fontsize=8, ncol=4, loc="outside lower center", frameon=False)
    figure.savefig(path, dpi=90)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="few particles only; writes nothing")
    parser.add_argument("--peer", metavar="PYTHON", type=com1dfa.interpreter, help="an interpreter with avaframe==2.1")
    parser.add_argument("--against", metavar="PYTHON", help="an interpreter with another version of the package")
    options = parser.parse_args()
    if options.against:
        sys.exit(not speed_against.compare(options.against, 2 if options.quick else speed_against.PROCESSES))
    most = 10_000 if options.quick else 1_000_000
    console = Console(record=True, width=180)
    load = os.getloadavg()[0]
    report = Report(console)
    engine.cap(1000).run_one_step(1.0)  # compiles
    engine.valley(200).run_one_step(5.0)
    report.of_the_sums([n for n in STEPPED if n <= most], report.of_the_machine())
    report.of_the_steps("similarity solution (Coulomb, no column, no erosion)", engine.cap, _up_to(STEPPED, most))
    report.of_the_steps("the demo's valley (erosion, columns)", engine.placed_valley, _up_to(DEMO, most))
    for name, (reach, best) in REACH.items():
        least = min(one for n, one, _ in report.curves[name] if n >= 10_000)
        report.aim(f"{name}, one thread, M/s, least from 1e4 particles up", least, least=reach, ambitious=best)
    report.of_the_stages((1500, 5000), 1 if options.quick else 3)
    report.of_scenes({1500: (0.6, 0.25), 5000: (2.0, 0.9)}, 1 if options.quick else 5)
    report.of_rasters(1 if options.quick else 7)
    if options.peer:
        report.of_the_peer(options.peer, peers.RADII[: 2 if options.quick else None])
    console.export_text()  # forget the log
    console.print(f"Cores: {os.cpu_count()}; load before and after: {load:.1f}, {os.getloadavg()[0]:.1f}\n")
    report.show()
    if not options.quick:
        root = Path(__file__).parents[1]
        (root / "benchmarks" / "speed.txt").write_text(console.export_text())
        draw(report.curves, root / "docs" / "speed.png")


def _up_to(runs, most):
    return {n: rest for n, rest in runs.items() if n <= most}


if __name__ == "__main__":
    main()
