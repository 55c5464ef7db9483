"""Accuracy of the pore-pressure columns against their cost: python -m benchmarks.column [--against NAME=FOLDER]

Error: the basal pressure that friction sees at every stored flow step (all of the first 40 after a switch
and every fifth), over the pressure of the bed, and the same of the depth mean; the worst of eight Peclet
numbers 1e-3 ... 1e4, against `validation/cases/column_reference.py`, a solver of another kind converged to 2e-10.
400 flow steps per erosion time. Cost: CPU time of one thread per column and step over the whole history of
a case, median of five; the schemes take turns, so that their ratios are of one run.

With --against, NAME is a version and FOLDER its checkout, whose default scheme takes part in the turns with its own
code: the figure then has its marks, too.

Keeps benchmarks/results/column.json, from which benchmarks/column.txt and docs/figures/column.png are made.
"""

import argparse
import itertools
import statistics
import time
from contextlib import nullcontext

import numpy as np
from scipy.integrate import solve_ivp

from benchmarks import charts, result_files, style
from benchmarks.checkout_calls import checkouts
from benchmarks.ratio_turns import named_version, turns
from landlab_debrisflow.physics.column import ALE, Classical
from landlab_debrisflow.physics.column.driver import Columns, depth_mean
from validation.cases.column_reference import CASES, FILE, PER_UNIT

LEVELS, SCHEMES = (11, 21, 41), ("default", "every step", "upwind", "lax_wendroff")
REFERENCE = np.load(FILE)
PECLET = REFERENCE["peclet"]
DEAREST = 20_000  # explicit sub-steps in one step of the flow, beyond which a case is not run


def law_of(case, scheme: str, levels: int):
    """Return the law of a case."""
    choices = {"levels": levels, "loading_source": case.loading}
    if scheme == "every step":
        choices["tolerance"] = 0.0
    elif scheme != "default":
        choices["scheme"] = scheme
    return (ALE if case.law == "ale" else Classical)(**choices)


def history(case):
    """Return thickness, volume and bed pressure of a case at every step, the start included."""
    steps = round(case.duration * PER_UNIT)
    times = np.arange(steps + 1) / PER_UNIT
    limits = sorted({0.0, case.duration, *case.switches})
    thickness, volume = np.ones(steps + 1), np.ones(steps + 1)
    for begin, end in itertools.pairwise(limits):
        inside = (times > begin + 1e-9) & (times < end + 1e-9)
        at = np.flatnonzero(inside)[0] - 1

        def rates(t, y, begin=begin, end=end):
            t = min(max(t, begin + 1e-9), end - 1e-9)
            erosion = case.erosion_rate(t)
            return [erosion - case.divergence_rate(t) * y[0], erosion / y[0] * y[1]]

        found = solve_ivp(
            rates, (begin, end), (thickness[at], volume[at]), "DOP853", np.append(times[inside][:-1], end), rtol=1e-12,
            atol=1e-12,
        )  # fmt: skip
        thickness[inside], volume[inside] = found.y
    bed = np.array([case.base_pressure(t, h) for t, h in zip(times, thickness, strict=True)])
    return thickness, volume, bed


class Run:
    """Columns of a case, some for each of given Peclet numbers."""

    def __init__(self, case, scheme, levels, peclet, each=1):
        self.case, self.law, self.peclet = case, law_of(case, scheme, levels), np.repeat(peclet, each)
        self.thickness, self.volume, self.bed = history(case)
        eta, count = np.linspace(1.0, 0.0, levels), self.peclet.size
        start = {"cold": 0.0 * eta, "warm": np.where(eta > 0.0, 1.0, 0.0), "linear": case.start_base * eta}[case.start]
        first = self.step(0)
        self.columns = Columns(
            self.law, np.tile(start, (count, 1)), first["thickness"], bounded=False, bed_pressure=self.bed[0],
            liquefaction_pressure=first["liquefaction_pressure"], coefficient_of_consolidation=1.0 / self.peclet,
        )  # fmt: skip

    def step(self, k):
        """Return the members of `ColumnForcing` of step ``k``, each per column but the pressure of the bed."""
        entrained = self.volume[k] - self.volume[k - 1] if k else 0.0
        each = {
            "volume": self.volume[k],
            "thickness": self.thickness[k],
            "liquefaction_pressure": self.thickness[k] if self.case.base_pressure(0.5, 2.0) != 1.0 else 1.0,
            "entrained": entrained if entrained >= 1e-13 else 0.0,  # rounding
        }
        members = {name: np.full(self.peclet.size, value) for name, value in each.items()}
        return members | {"bed_pressure": self.bed[k : k + 1]}

    def advance(self, k):
        """Take step ``k``."""
        self.columns.step(1.0 / PER_UNIT, **self.step(k))

    def mean(self):
        """Return the depth mean of the profiles, which stay as they are."""
        return depth_mean(self.columns.profile())


def affordable(scheme, levels):
    """Return which Peclet numbers an explicit scheme is run at."""
    if scheme != "lax_wendroff":
        return np.ones(PECLET.size, bool)
    return 2.0 * (levels - 1) ** 2 / PECLET / PER_UNIT < DEAREST


def errors(name, scheme, levels):
    """Return the worst error of the basal pressure and of the depth mean, each by Peclet number."""
    case, used = CASES[name], affordable(scheme, levels)
    run = Run(case, scheme, levels, PECLET[used])
    stored = dict(zip(REFERENCE[f"{name}/steps"].tolist(), range(10**6), strict=False))
    base, mean = np.full((2, PECLET.size), np.nan)
    base[used] = mean[used] = 0.0
    for k in range(1, run.volume.size):
        run.advance(k)
        if (at := stored.get(k)) is None:
            continue
        exact = REFERENCE[f"{name}/p_base"][at, used]
        base[used] = np.fmax(base[used], np.abs(run.columns.basal_pressure - exact) / run.bed[k])
        if k % 20 == 0:
            exact = REFERENCE[f"{name}/depth_mean"][at, used]
            mean[used] = np.fmax(mean[used], np.abs(run.mean() - exact) / run.bed[k])
    return base, mean


def cost(name, scheme, levels, peclet, repeats=5):
    """Return the CPU time per column and step [ns]."""
    substeps = 2.0 * (levels - 1) ** 2 / peclet / PER_UNIT
    count = max(2, int(4000 / (1.0 + substeps))) if scheme == "lax_wendroff" else 2000
    times = []
    for _ in range(repeats if substeps < 10.0 or scheme != "lax_wendroff" else 1):
        run = Run(CASES[name], scheme, levels, np.array([peclet]), count)
        columns = run.columns
        forcings = [columns.forcing._replace(**run.step(k)) for k in range(1, run.volume.size)]
        begin = time.process_time()
        for forcing in forcings:
            run.law.advance(columns.state, forcing, 1.0 / PER_UNIT, columns.basal_pressure)
        times.append((time.process_time() - begin) / count / len(forcings) * 1e9)
    return statistics.median(times)


BEFORE, ONCE = "before", ("A_cold", "A_warm")
COSTED = ("A_cold", "D_switches", "E_swing_overburden")
"""Cases whose CPU time is measured."""


def compare(asking):
    """Yield rows of the default scheme, in turns with that of another checkout, which is called "before"."""
    for name, levels in itertools.product(COSTED, LEVELS):
        spent = []
        for number in PECLET.tolist():
            request = "column_cost", name, "default", levels, number
            spent.append(np.median(turns(asking, 5, lambda ask, request=request: ask(*request)), axis=0))
        for scheme, found in zip(("default", BEFORE), np.transpose(spent), strict=True):
            yield {"case": name, "scheme": scheme, "levels": levels, "cost": found}
    for name, levels in itertools.product(ONCE, LEVELS):
        base, mean = np.array(asking[1]("column_errors", name, "default", levels))
        yield {"case": name, "scheme": BEFORE, "levels": levels, "base": base, "mean": mean}


def measure(asking=()):
    """Yield a row of every error and cost: case, scheme, levels, and values by Péclet number.

    `asking` are this and another checkout, whose default schemes are timed in turns.
    """
    for name in CASES:
        for scheme in SCHEMES:
            for levels in LEVELS:
                if scheme == "lax_wendroff" and levels == 41 and not name.startswith("A"):
                    continue
                base, mean = errors(name, scheme, levels)
                yield {"case": name, "scheme": scheme, "levels": levels, "base": base, "mean": mean}
    for name in COSTED:
        for levels in LEVELS:
            for scheme in SCHEMES:
                if scheme == "lax_wendroff" and (levels == 41 or name != "A_cold"):
                    continue
                if scheme == "default" and asking:
                    continue
                used = affordable(scheme, levels)
                found = np.full(PECLET.size, np.nan)
                found[used] = [cost(name, scheme, levels, number) for number in PECLET[used]]
                yield {"case": name, "scheme": scheme, "levels": levels, "cost": found}

    if asking:
        yield from compare(asking)


def cost_of_many() -> float:
    """Return the CPU time per step of a million columns of 11 levels with their forcing [ns each]."""
    many = Run(CASES["A_cold"], "default", 11, np.array([10.0]), 1_000_000)
    begin = time.process_time()
    for k in range(1, 21):
        many.advance(k)
    return (time.process_time() - begin) / 20e6 * 1e9


def kept():
    """Return errors (base, mean) and costs by case, scheme and levels, and the cost of a million columns."""
    found = result_files.read("column")
    errors_kept, costs = {}, {}
    for row in found["rows"]:
        key = row["case"], row["scheme"], row["levels"]
        if "cost" in row:
            costs[key] = np.array(row["cost"])
        else:
            errors_kept[key] = np.array(row["base"]), np.array(row["mean"])
    return errors_kept, costs, found["cost of many [ns]"]


def report() -> str:
    """Return the text of benchmarks/column.txt."""
    worst, dear, many = kept()
    heads = [(scheme, levels) for scheme in SCHEMES for levels in LEVELS]
    lines = [
        "worst error over flow steps and eight Peclet numbers 1e-3 ... 1e4: of p_b over the bed's / of the depth mean",
        "case                               " + "".join(f"{s} {n}".rjust(20) for s, n in heads),
    ]
    for name in CASES:
        pairs = (worst.get((name, *head)) for head in heads)
        row = ["-" if pair is None else f"{np.nanmax(pair[0]):.1e} / {np.nanmax(pair[1]):.1e}" for pair in pairs]
        lines.append(f"{name:35s}" + "".join(text.rjust(20) for text in row))
    lines.append("")
    for name in COSTED:
        lines.append(f"ns per column and step, {name}; Pe = " + "  ".join(f"{number:g}" for number in PECLET))
        for (case, scheme, levels), found in dear.items():
            if case == name:
                lines.append(f"  {levels:3d} {scheme:14s}" + "".join(f"{value:10.1f}" for value in found))
    lines.append("")
    for levels in LEVELS:
        size = 8 * (levels + ALE(levels=levels).memory_size + 2)
        lines.append(f"{levels} levels: {size} bytes per column, its basal pressure included")
    lines.append(f"1e6 columns, 11 levels, 20 steps with their forcing: {many:.0f} ns each")
    return "\n".join(lines) + "\n"


NAMES = {"default": "default", "every step": "default, updated at every step", "upwind": "upwind, implicit",
         "lax_wendroff": "Lax–Wendroff (the paper's)", BEFORE: "default, earlier version"}  # fmt: skip


def chart():
    """Return the figure: error against cost and against the Péclet number."""
    worst, dear, _ = kept()
    figure, axes = style.panels(2, 2, (12.0, 9.0))
    colours = dict(zip((*SCHEMES, BEFORE), (style.BLUE, style.SKY, style.ORANGE, style.RED, style.GREEN), strict=True))
    marks = {11: "o", 21: "s", 41: "^"}
    ordinary = [name for name in CASES if name[0] not in "EH"]
    shown = (
        (axes[0, 1], ONCE, 0, "Basal pressure after one stop of erosion"),
        (axes[1, 0], ordinary, 0, "Basal pressure, all cases but swinging loads and the classical law"),
        (axes[1, 1], ordinary, 1, "Depth mean of the pressure, the same cases"),
    )
    for scheme in (*SCHEMES, BEFORE):
        for levels in LEVELS:
            mark = {"marker": marks[levels], "color": colours[scheme], "alpha": 0.8, "ms": 5}
            label = f"{NAMES[scheme]}, {levels} levels"
            if ("A_cold", scheme, levels) in dear:
                error = np.nanmax([worst[name, scheme, levels][0] for name in ONCE], axis=0)
                axes[0, 0].plot(dear["A_cold", scheme, levels], np.maximum(error, FLOOR), ls="", label=label, **mark)
            for axis, names, which, _ in shown if scheme in SCHEMES else ():
                if all((name, scheme, levels) in worst for name in names):
                    error = np.nanmax([worst[name, scheme, levels][which] for name in names], axis=0)
                    axis.plot(PECLET, np.maximum(error, FLOOR), label=label, lw=1.0, **mark)
    words = {
        "xscale": "log",
        "yscale": "log",
        "ylabel": "largest error over the bed's pressure [-]",
        "ylim": (7e-6, 0.7),
    }
    title = "Basal pressure after one stop of erosion: one mark for each Péclet number"
    style.finish(axes[0, 0], xlabel="CPU time per column and step [ns]", title=title, **words)
    for axis, *_, title in shown:
        style.finish(axis, xlabel="Péclet number of erosion [-]", title=title, **words)
    note = f"errors below {FLOOR:g} are drawn there"
    style.legend_below(figure, axes[0, 1], ncol=4, title=note)
    return figure


FLOOR = 1e-5


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--against", metavar="NAME=FOLDER", type=named_version, help="another version and its checkout")
    against = parser.parse_args().against
    rows = []
    with checkouts(dict([against])) if against else nullcontext(()) as asking:
        for row in measure(asking):
            print({name: np.nanmax(value) if isinstance(value, np.ndarray) else value for name, value in row.items()})
            rows.append(row)
    command = "python -m benchmarks.column" + (" --against NAME=FOLDER" if against else "")
    data = {"before": against[0] if against else "", "rows": rows, "cost of many [ns]": cost_of_many()}
    result_files.keep("column", data, command)
    charts.make("column")


if __name__ == "__main__":
    main()
