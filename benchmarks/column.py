"""Accuracy of the pore-pressure columns against their cost: python -m benchmarks.column

Error: the basal pressure that friction sees at every stored flow step (all of the first 40 after a switch
and every fifth), over the pressure of the bed, and the same of the depth mean; the worst of eight Peclet
numbers 1e-3 ... 1e4, against `validation/cases/column_reference.py`, a solver of another kind converged to 2e-10.
400 flow steps per erosion time. Cost: CPU time of one thread per column and step over the whole history of
a case, median of five; the schemes take turns, so that their ratios are of one run.

Writes docs/column.png and benchmarks/column.txt.
"""

import argparse
import statistics
import time
from itertools import pairwise
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from scipy.integrate import solve_ivp

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
    for begin, end in pairwise(limits):
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


def main() -> None:
    lines, worst, dear = [], {}, {}

    def put(line):
        print(line, flush=True)
        lines.append(line)

    put("worst error over flow steps and eight Peclet numbers 1e-3 ... 1e4: of p_b over the bed's / of the depth mean")
    put("case                               " + "".join(f"{s} {n}".rjust(20) for s in SCHEMES for n in LEVELS))
    for name in CASES:
        row = []
        for scheme in SCHEMES:
            for levels in LEVELS:
                if scheme == "lax_wendroff" and levels == 41 and not name.startswith("A"):
                    row.append("-")
                    continue
                base, mean = errors(name, scheme, levels)
                worst[name, scheme, levels] = base, mean
                row.append(f"{np.nanmax(base):.1e} / {np.nanmax(mean):.1e}")
        put(f"{name:35s}" + "".join(text.rjust(20) for text in row))
    put("")
    for name in ("A_cold", "D_switches", "E_swing_overburden"):
        put(f"ns per column and step, {name}; Pe = " + "  ".join(f"{number:g}" for number in PECLET))
        for levels in LEVELS:
            for scheme in SCHEMES:
                if scheme == "lax_wendroff" and (levels == 41 or name != "A_cold"):
                    continue
                used = affordable(scheme, levels)
                found = np.full(PECLET.size, np.nan)
                found[used] = [cost(name, scheme, levels, number) for number in PECLET[used]]
                dear[name, scheme, levels] = found
                put(f"  {levels:3d} {scheme:14s}" + "".join(f"{value:10.1f}" for value in found))
    put("")
    for levels in LEVELS:
        put(
            f"{levels} levels: {8 * (levels + ALE(levels=levels).memory_size + 2)} bytes per column, "
            "its basal pressure included"
        )
    many = Run(CASES["A_cold"], "default", 11, np.array([10.0]), 1_000_000)
    begin = time.process_time()
    for k in range(1, 21):
        many.advance(k)
    each = (time.process_time() - begin) / 20e6 * 1e9
    put(f"1e6 columns, 11 levels, 20 steps with their forcing: {each:.0f} ns each")
    Path(__file__).with_suffix(".txt").write_text("\n".join(lines) + "\n")
    draw(worst, dear)


def draw(worst, dear) -> None:
    """Draw error against cost and against the Peclet number."""
    figure, axes = plt.subplots(2, 2, figsize=(12, 9), constrained_layout=True)
    colours = dict(zip(SCHEMES, ("tab:blue", "tab:cyan", "tab:orange", "tab:red"), strict=True))
    marks = {11: "o", 21: "s", 41: "^"}
    once = ("A_cold", "A_warm")
    ordinary = [name for name in CASES if name[0] not in "EH"]
    panels = (
        (axes[0, 1], once, 0, "One stop of erosion, constant bed pressure"),
        (axes[1, 0], ordinary, 0, "All cases but swinging loads and the classical law"),
        (axes[1, 1], ordinary, 1, "The same cases, depth mean"),
    )
    for scheme in SCHEMES:
        for levels in LEVELS:
            look = {"marker": marks[levels], "color": colours[scheme], "label": f"{scheme}, {levels}", "alpha": 0.7}
            if ("A_cold", scheme, levels) in dear:
                error = np.nanmax([worst[name, scheme, levels][0] for name in once], axis=0)
                axes[0, 0].plot(dear["A_cold", scheme, levels], np.maximum(error, 1e-5), linestyle="", **look)
            for axis, names, which, _ in panels:
                if all((name, scheme, levels) in worst for name in names):
                    error = np.nanmax([worst[name, scheme, levels][which] for name in names], axis=0)
                    axis.plot(PECLET, np.maximum(error, 1e-5), **look)
    axes[0, 0].plot([15.0], [4e-3], "k*", ms=12, label="aim, 11 levels")
    axes[0, 0].plot([25.0], [1.5e-3], "k+", ms=12, mew=2, label="aim, 21 levels")
    axes[0, 0].set(xlabel="CPU time per column and step (ns)", title="One stop of erosion, a mark per Peclet number")
    for axis in axes.ravel():
        axis.set(xscale="log", yscale="log", ylabel="worst error over the bed's pressure (-)", ylim=(7e-6, 0.5))
    for axis, *_, title in panels:
        axis.set(xlabel="Peclet number (-)", title=title)
    legends = [axis.get_legend_handles_labels() for axis in (axes[0, 1], axes[0, 0])]
    named = {label: handle for handles, labels in legends for handle, label in zip(handles, labels, strict=True)}
    title = "scheme, levels\n(below 1e-5:\ndrawn there)"
    figure.legend(named.values(), named.keys(), loc="outside right center", title=title)
    figure.savefig(Path(__file__).parents[1] / "docs" / "column.png", dpi=110)


if __name__ == "__main__":
    argparse.ArgumentParser(description=__doc__.splitlines()[0]).parse_args()
    main()
