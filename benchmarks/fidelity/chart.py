"""Chart of error against cost, with stated against true errors beside it."""

import math

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter

from benchmarks import style
from landlab_debrisflow.fidelity.table import WORDS

from .campaign import FAST, FULL, PHYSICS_PARTICLES, SETS, TRUTH
from .replay import QUANTITIES, complete, replay, true_errors
from .score import HELD, pairs

COLOURS = (style.BLUE, style.ORANGE, style.GREEN, style.RED, style.PURPLE, style.SKY, "0.35")
"""Of the quantities."""

FLOOR = 1e-3
"""Errors below this are drawn here: less is not known [-]."""

PERCENT = FuncFormatter(lambda value, _: f"{100.0 * value:g} %")

MARKS = {
    "column=none": ("v", "without a column"), "column=classical": ("s", "classical column"),
    "column=ale": ("o", "ALE column"), "flow=two_phase": ("D", "two phases"),
    "flow=one_phase": ("p", "one phase"),
}  # fmt: skip
"""Choices of physics that are marked, with 1000 particles."""


def largest_error(result, truth, names=HELD) -> float:
    """Return the largest error of some quantities [-]."""
    errors = true_errors(result, truth)
    return max((errors[name] for name in names if math.isfinite(errors[name])), default=math.nan)


def draw_error_and_cost(scenes) -> Figure:
    """Return the chart of error against cost, with stated against true errors beside it."""
    figure = Figure(figsize=(14.0, 7.6), layout="constrained")
    axes, beside = figure.subplots(1, 2, width_ratios=(1.45, 1.0))
    random = complete(scenes, [*SETS["fit"], *SETS["held-out"]])
    for number, name in enumerate([*random, *complete(scenes, SETS["nine"])]):
        nine = name in SETS["nine"]
        runs = scenes[name]
        full, truth = runs["", FULL]["seconds"], runs["", TRUTH]
        points = [(runs["fast", n]["seconds"] / full, largest_error(runs["fast", n], truth)) for n in FAST]
        colour = f"C{SETS['nine'].index(name)}" if nine else "0.8"
        x, y = zip(*points, strict=True)
        label = name if nine else ("random scenes" if number == 0 else None)
        axes.plot(x, np.maximum(y, FLOOR), color=colour, lw=1.6 if nine else 0.6, zorder=3 if nine else 1, label=label)
        choice = replay(runs, 0.05, HELD)
        error = max(FLOOR, max(choice.true[q] for q in HELD))
        marker = {"marker": "*", "ms": 14 if nine else 5, "color": colour if nine else "0.55", "ls": "none"}
        axes.plot(choice.cost, error, **marker, mec="k" if nine else "none", mew=0.6, zorder=5 if nine else 2)
        if nine:
            mark_physics(axes, runs, full, truth, colour)
    for marker, words in MARKS.values():
        axes.plot([], [], marker, color="0.5", mec="k", ls="none", label=f"{words}, {PHYSICS_PARTICLES} particles")
    axes.plot([], [], "*", ms=10, color="0.5", mec="k", ls="none", label="plan for 5 %, pilot runs counted")
    axes.axhline(0.05, color="k", lw=0.8, ls=":", label="tolerance of the plans")
    axes.set(xscale="log", yscale="log", xlabel=f"CPU time over that of {FULL} particles with default steps [-]")
    axes.set(ylabel=f"error of run-out or peak speed, the larger, against {TRUTH} particles")
    axes.yaxis.set_major_formatter(PERCENT)
    axes.set_title(f"A line for each scene: fast steps with {', '.join(map(str, FAST))} particles", fontsize="medium")
    draw_stated(beside, [replay(scenes[name], 0.05, HELD) for name in complete(scenes, SETS["held-out"])])
    place = {"fontsize": "small", "frameon": False}
    figure.legend(*axes.get_legend_handles_labels(), ncols=4, loc="outside lower left", **place)
    figure.legend(*beside.get_legend_handles_labels(), ncols=2, loc="outside lower right", **place)
    return figure


def mark_physics(axes, runs, full, truth, colour) -> None:
    """Mark what other choices of physics give in a scene."""
    for word, (marker, _) in MARKS.items():
        if (run := runs.get((word, PHYSICS_PARTICLES))) is not None:
            error = max(FLOOR, largest_error(run, truth))
            axes.plot(run["seconds"] / full, error, marker, color=colour, mec="k", mew=0.5, ms=6, zorder=4)


def draw_stated(axes, choices) -> None:
    """Draw stated against true errors of unseen scenes, by quantity."""
    for number, name in enumerate(QUANTITIES):
        stated, true = pairs(choices, name).T
        covered = float(np.mean(true <= stated)) if true.size else math.nan
        label = f"{WORDS[name]}: stated covers true in {100.0 * covered:.0f} %"
        colour = COLOURS[number]
        axes.plot(np.maximum(true, FLOOR), np.maximum(stated, FLOOR), ".", color=colour, ms=5, label=label)
    ends = np.array([FLOOR, 2.0])
    axes.plot(ends, ends, "k-", lw=0.8, label="stated equals true")
    axes.set(xscale="log", yscale="log", xlim=ends, ylim=ends, xlabel="true error", ylabel="stated error of particles")
    axes.xaxis.set_major_formatter(PERCENT)
    axes.yaxis.set_major_formatter(PERCENT)
    axes.set_title(f"{len(choices)} unseen scenes, plans for 5 % of run-out and speed", fontsize="medium")
