"""When ALE matters: difference of run-out against the basal Péclet number, ``python -m benchmarks.when_ale_matters``.

Both models on the stand-in terrain of `examples/tsing_shan.py`, with coefficients of consolidation from 1e-5 to
10 m2/s, other slopes and other erodible lengths, with and without loading. Pastor et al. (2022) leave this open.
Keeps benchmarks/results/when_ale_matters.json, from which benchmarks/when_ale_matters.txt and
docs/figures/when_ale_matters.png are made.
"""

import argparse
import itertools

from matplotlib.lines import Line2D

from benchmarks import charts, result_files, style
from benchmarks.example_scripts import load
from landlab_debrisflow.scene import tsing_shan_valley

tsing_shan = load("tsing_shan")

CONSOLIDATION = (1e-5, 1e-3, 1e-2, 0.1, 0.4, 1.0, 4.0, 10.0)  # [m2 s-1]

VALLEYS = {
    "as in the example": {},
    "moved by half a node": {"offset": (0.5, 0.5)},
    "erodible 357 m": {"erodible_length": 357.0},
    "erodible 1071 m": {"erodible_length": 1071.0},
    "channel 30° to 22°": {"slopes": (30.0, 22.0, 2.0)},
    "plain of 6°": {"slopes": (38.0, 28.0, 6.0)},
}
"""The second differs from the first in nothing but noise."""

LOADING = {"overburden": ("full", "-"), "none": ("none", "--"), "proportional": ("left", ":")}
"""Loading sources, how markers are filled and what lines are like. The last is done for the first valley only."""

WIDE = {"runout_length": 3500.0, "width": 1000.0}
EXTENT = {"overburden": {"runout_length": 1600.0}, "none": WIDE, "proportional": WIDE}
"""Of the grid [m]."""

LEVELS = {1e-5: 321, 1e-3: 161}
"""Of the columns, where the layer at the base of a classical column is thinnest: with 1e-5 m2/s, 500 particles and
loading the difference is 149, 164, 154, 160 m with 11, 41, 161, 321 levels. ALE: 589 to 585 m."""

COLUMNS = "valley", "loading", "c_v", "Pe_b", "ALE", "classical", "difference", "relative", "outflow", "soil left"
COLOURS = dict(zip(VALLEYS, ("black", "0.6", style.SKY, style.BLUE, style.GREEN, style.ORANGE), strict=True))
COMMAND = "python -m benchmarks.when_ale_matters"


def compare(valley, c_v, loading, particles):
    """Return the basal Péclet number and run-outs beyond erodible ground with both models [m]."""
    terrain, levels = EXTENT[loading] | VALLEYS[valley], LEVELS.get(c_v, tsing_shan.LEVELS)
    ale, classical = (
        tsing_shan.run(tsing_shan_valley(**terrain), model, c_v, particles, loading, levels=levels).measures
        for model in tsing_shan.COLUMNS
    )
    difference = ale["run-out"] - classical["run-out"]
    pair = ale, classical
    return {
        "Pe_b": ale["peclet"], "ALE": ale["beyond"], "classical": ale["beyond"] - difference,
        "difference": difference, "relative": difference / ale["beyond"],
        "outflow": max(one["outflow"] for one in pair), "soil left": min(one["soil left"] for one in pair),
    }  # fmt: skip


def chart():
    """Return the figure: difference in metres, and over the run-out with ALE; without runs that left the grid."""
    rows = result_files.read("when_ale_matters")["rows"]
    figure, axes = style.panels(1, 2, (12.0, 6.2), sharex=True)
    panels = dict(zip(("difference", "relative"), axes[0], strict=True))
    for valley, loading in dict.fromkeys((row["valley"], row["loading"]) for row in rows):
        inside = [row for row in rows if (row["valley"], row["loading"], row["outflow"]) == (valley, loading, 0.0)]
        fill, line = LOADING[loading]
        mark = {"color": COLOURS[valley], "marker": "o", "ms": 5, "lw": 0.8, "ls": line, "fillstyle": fill}
        for name, panel in panels.items():
            points = sorted((row["Pe_b"], row[name]) for row in inside)
            panel.plot(*zip(*points, strict=True), **mark)
    words = (
        "run-out with the ALE column less that with\nthe classical column [m]",
        "the same difference over the run-out\nwith the ALE column [-]",
    )
    for panel, label in zip(panels.values(), words, strict=True):
        panel.axhline(0.0, color="0.7", lw=0.8, zorder=0)
        panel.axvline(1.0, color="0.7", lw=0.8, zorder=0)
        where = "basal Péclet number $e_R h / c_v$ of the eroding flow\nas its front leaves erodible ground [-]"
        style.finish(panel, xscale="log", xlabel=where, ylabel=label)
    valleys = [Line2D([], [], color=colour, marker="o", label=valley) for valley, colour in COLOURS.items()]
    loadings = [
        Line2D([], [], color="0.3", marker="o", fillstyle=fill, ls=line, label=loading)
        for loading, (fill, line) in LOADING.items()
    ]
    below = {"frameon": False, "fontsize": 9}
    figure.legend(handles=valleys, loc="outside lower left", ncols=3, title="valley", **below)
    figure.legend(handles=loadings, loc="outside lower right", ncols=3, title="loading source of the column", **below)
    figure.suptitle("Run-out of the front beyond erodible ground")
    return figure


def row_of_text(row):
    """Return one line of the text file."""
    forms = ("10.3g", "10.0f", "10.0f", "10.1f", "10.3f", "10.0f", "10.2f")
    numbers = (f"{row[name]:{form}}" for name, form in zip(COLUMNS[3:], forms, strict=True))
    return f"{row['valley']:<22}{row['loading']:<12}{row['c_v']:>8g}" + "".join(numbers)


def report() -> str:
    """Return the text of benchmarks/when_ale_matters.txt."""
    found = result_files.read("when_ale_matters")
    head = (
        f"{found['particles']} particles; run-out of the front beyond erodible ground [m]; Pe_b: median by volume of "
        "what erodes\nas the front leaves erodible ground; outflow [m3]; least soil left where there was any [m]\n"
        f"{COLUMNS[0]:<22}{COLUMNS[1]:<12}{COLUMNS[2]:>8}" + "".join(f"{name:>10}" for name in COLUMNS[3:])
    )
    return "\n".join([head, *map(row_of_text, found["rows"])]) + "\n"


def main(particles=500, resume=False):
    """Run everything, and keep the results after every pair; with `resume` go on with the result file."""
    rows = result_files.read("when_ale_matters")["rows"] if resume else []
    done = {(row["valley"], row["loading"], row["c_v"]) for row in rows}
    for valley in VALLEYS:
        sources = [loading for loading in LOADING if loading != "proportional" or not VALLEYS[valley]]
        for loading, c_v in itertools.product(sources, CONSOLIDATION):
            if (valley, loading, c_v) in done:
                continue
            found = {name: float(value) for name, value in compare(valley, c_v, loading, particles).items()}
            rows.append({"valley": valley, "loading": loading, "c_v": c_v, **found})
            print(row_of_text(rows[-1]), flush=True)
            result_files.keep("when_ale_matters", {"particles": particles, "rows": rows}, COMMAND)
    charts.make("when_ale_matters")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--particles", type=int, default=500)
    parser.add_argument("--resume", action="store_true", help="go on with the result file")
    words = parser.parse_args()
    main(words.particles, words.resume)
