"""Errors against the number of particles, now and before a change of the engine."""

import numpy as np
from matplotlib.figure import Figure
from rich.console import Console
from rich.table import Table

from benchmarks import style
from landlab_debrisflow.fidelity.table import WORDS

from .campaign import FULL, SETS
from .replay import QUANTITIES, true_errors

COUNTS = (500, 1000, 2000)
"""Particles of the runs that are compared, with default steps."""

CHANGE = "footprints of particles were sharpened and suction was kept"
"""Change of the engine to which `before` refers; steps have become longer since then, too."""


def errors_by_count(scenes, names, name: str, counts=COUNTS, truth: int = FULL) -> np.ndarray:
    """Return the errors of a quantity with default steps, (counts, scenes), against a number of particles."""
    found = []
    for scene in names:
        runs = scenes[scene]
        if all(("", count) in runs for count in (*counts, truth)):
            found.append([true_errors(runs["", count], runs["", truth])[name] for count in counts])
    errors = np.array(found).reshape(-1, len(counts)).T
    return errors[:, np.isfinite(errors).all(axis=0)]


def common(*versions) -> list[str]:
    """Return the scenes to fit of which all versions have the runs that are compared."""
    needed = [("", count) for count in (*COUNTS, FULL)]
    return [name for name in SETS["fit"] if all(key in scenes.get(name, {}) for scenes in versions for key in needed)]


def print_convergence(now, before) -> None:
    """Print median, 90 % quantile and largest error against particles, now and before a change [%]."""
    names = common(now, before)
    table = Table(title=f"error against {FULL} of the same version, {len(names)} scenes: median / 90 % / largest [%]")
    for head in ("", *(f"{count}, {words}" for count in COUNTS for words in ("before", "now"))):
        table.add_column(head, justify="right" if head else "left")
    for name in QUANTITIES:
        cells = [
            " / ".join(f"{value:.1f}" for value in (np.median(found), np.quantile(found, 0.9), found.max()))
            for pair in zip(*(100.0 * errors_by_count(one, names, name) for one in (before, now)), strict=True)
            for found in pair
        ]
        table.add_row(WORDS[name], *cells)
    Console(width=160).print(table)


def draw_convergence(now, before) -> Figure:
    """Return median and 90 % of the errors against particles, now and before a change, against 8000 particles."""
    figure = Figure(figsize=(14.0, 6.0), layout="constrained")
    panels = figure.subplots(2, 4, sharex=True).ravel()
    names = common(now, before)
    for axes, name in zip(panels, QUANTITIES, strict=False):
        for scenes, words, colour in ((before, "before", "0.55"), (now, "now", style.BLUE)):
            errors = 100.0 * errors_by_count(scenes, names, name)
            if errors.size:
                axes.plot(COUNTS, np.median(errors, axis=1), "o-", color=colour, label=f"{words}: median")
                axes.plot(
                    COUNTS,
                    np.quantile(errors, 0.9, axis=1),
                    "s--",
                    color=colour,
                    label=f"{words}: 90 % of the scenes are below",
                )
        axes.set(xscale="log", title=WORDS[name], xticks=COUNTS, xticklabels=COUNTS)
        axes.set_ylim(bottom=0.0)
        axes.minorticks_off()
    panels[-1].axis("off")
    handles = panels[0].get_legend_handles_labels()
    panels[-1].legend(*handles, loc="center", frameon=False)
    figure.supxlabel("number of particles")
    figure.supylabel(f"error against {FULL} particles of the same version [%]", fontsize="medium")
    figure.suptitle(f"{len(names)} random scenes, default steps: now, and before {CHANGE}")
    return figure
