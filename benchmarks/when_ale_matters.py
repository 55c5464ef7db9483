"""When ALE matters: difference of run-out against the basal Péclet number, ``python -m benchmarks.when_ale_matters``.

Both models on the stand-in terrain of `examples/tsing_shan.py`, with coefficients of consolidation from 1e-5 to
10 m2/s, other slopes and other erodible lengths, with and without loading. Pastor et al. (2022) leave this open.
Writes benchmarks/when_ale_matters.txt and docs/when_ale_matters.png.
"""

import argparse
import itertools
import sys
from pathlib import Path

from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from landlab_debrisflow.plots import save_figure
from landlab_debrisflow.record import write_atomically
from landlab_debrisflow.scene import tsing_shan_valley

sys.path.insert(0, str(Path(__file__).parents[1] / "examples"))  # examples are scripts, not a package
import tsing_shan

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
"""Of the columns, where 41 are too few for the layer a classical column has at its base: with 1e-5 m2/s, 400 particles
and loading the difference is 64, 161, 169, 172 m with 41, 161, 321, 641 levels (-82 m with 11). ALE: 1207 to 1203 m."""

COLUMNS = "valley", "loading", "c_v", "Pe_b", "ALE", "classical", "difference", "relative", "outflow", "soil left"
OUTPUT = Path(__file__).with_suffix(".txt"), Path(__file__).parents[1] / "docs" / "when_ale_matters.png"


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


def draw(found):
    """Return the chart: difference in metres, and over the run-out with ALE; without runs that left the grid."""
    figure = Figure(figsize=(11.0, 5.2), layout="constrained")
    axes = figure.subplots(1, 2, sharex=True)
    colours = dict(zip(VALLEYS, ("k", "0.6", "tab:cyan", "tab:blue", "tab:green", "tab:orange"), strict=True))
    for (valley, loading), (panel, name) in itertools.product(
        dict.fromkeys(key[:2] for key in found), zip(axes, ("difference", "relative"), strict=True)
    ):
        inside = [f for key, f in found.items() if key[:2] == (valley, loading) and f["outflow"] == 0.0]
        points = sorted((f["Pe_b"], f[name]) for f in inside)
        style = {"color": colours[valley], "marker": "o", "ms": 5, "lw": 0.8}
        fill, line = LOADING[loading]
        panel.plot(*zip(*points, strict=True), ls=line, fillstyle=fill, **style)
    for panel, words in zip(
        axes, ("run-out, ALE less classical [m]", "the same over the run-out with ALE [-]"), strict=True
    ):
        panel.axhline(0.0, color="0.8", lw=0.8, zorder=0)
        panel.axvline(1.0, color="0.8", lw=0.8, zorder=0)
        where = "basal Péclet number $e_R h / c_v$ of what erodes\nas the front leaves erodible ground"
        panel.set(xscale="log", xlabel=where, ylabel=words)
    handles = [Line2D([], [], color=colour, marker="o", label=valley) for valley, colour in colours.items()]
    handles += [
        Line2D([], [], color="0.3", marker="o", fillstyle=fill, ls=line, label=f"loading source {loading}")
        for loading, (fill, line) in LOADING.items()
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=5, frameon=False)
    figure.suptitle("When ALE matters: run-out of the front beyond erodible ground")
    return figure


def row(key, values):
    """Return one line of the text file."""
    valley, loading, c_v = key
    numbers = (f"{values[name]:{form}}" for name, form in zip(
        COLUMNS[3:], ("10.3g", "10.0f", "10.0f", "10.1f", "10.3f", "10.0f", "10.2f"), strict=True))  # fmt: skip
    return f"{valley:<22}{loading:<12}{c_v:>8g}" + "".join(numbers)


def main(particles=500, output=OUTPUT):
    """Run everything, and write text and figure after every valley."""
    found = {}
    head = (
        f"{particles} particles; run-out of the front beyond erodible ground [m]; Pe_b: median by volume of what "
        "erodes\nas the front leaves erodible ground; outflow [m3]; least soil left where there was any [m]\n"
        f"{COLUMNS[0]:<22}{COLUMNS[1]:<12}{COLUMNS[2]:>8}" + "".join(f"{name:>10}" for name in COLUMNS[3:])
    )
    for valley in VALLEYS:
        done = [loading for loading in LOADING if loading != "proportional" or not VALLEYS[valley]]
        for loading, c_v in itertools.product(done, CONSOLIDATION):
            found[valley, loading, c_v] = compare(valley, c_v, loading, particles)
        lines = [head, *(row(key, values) for key, values in found.items())]
        write_atomically(output[0], lambda path, lines=lines: path.write_text("\n".join(lines) + "\n"))
        save_figure(draw(found), output[1], dpi=110)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--particles", type=int, default=500)
    words = parser.parse_args()
    main(words.particles)
