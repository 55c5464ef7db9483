"""Where the rules of time steps must fail: ``python -m benchmarks.step_stability --against REVISION=PYTHON``.

Three scenes of step_scenes.py, with steps of many lengths whatever the rules would allow, and with the steps that the
rules choose, each against the same scene in steps at least 16 times shorter than those of the rule before:

bend     a thin slab without friction slides at 13 to 45 m/s over a bend of 0.01 to 1 rad between two planes, concave
         and convex, and goes 0.1 to 2 nodes of 5 m in a step
edge     a slab slides at 8 m/s onto 50 m of ground that erodes and off it again, 0.1 to 2 nodes in a step
surge    a slab falls at 14 m/s into a body of 4 m that lies on 15 degrees, whose pull is 0.99 or 1.01 of its friction

PYTHON is the interpreter of another version, drawn beside this one. Keeps benchmarks/results/step_stability.json, from
which benchmarks/step_stability.txt and docs/figures/step_stability.png are made.
"""

import argparse
import json
import math
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table

from benchmarks import charts, ratio_turns, result_files, style

PROGRAM = Path(__file__).parent / "step_scenes.py"
COMMAND = "python -m benchmarks.step_stability --against REVISION=PYTHON"
TURNS = 0.01, 0.03, 0.1, 0.3, 1.0
WAYS = 0.12, 0.24, 0.48, 0.95, 1.4, 2.0
RATIOS = 0.99, 1.01
COURANT = 0.15, 0.3, 0.6, 1.0, 1.4, 2.0
FINE, SHORTER = 0.03, 16
"""Way in a step of the reference of slides [nodes]; how many times shorter the steps of that of a surge are."""


def of_a_slide(found, exact) -> dict[str, float]:
    """Return errors of a slide against one in shorter steps.

    Returns
    -------
    dict
        Error of the energy, and the largest gain of energy, over the kinetic energy at the end [-]; error of the way
        [m], of the grown volume over the growth [-].
    """
    kinetic, gained = exact["kinetic"][-1], exact["volume"][-1] - exact["volume"][0]
    return {
        "energy": (found["energy"][-1] - exact["energy"][-1]) / kinetic,
        "gain": gain(found) / kinetic,
        "x": found["x"][-1] - exact["x"][-1],
        "volume": (found["volume"][-1] - exact["volume"][-1]) / gained if gained > 0.0 else math.nan,
    }


def gain(found) -> float:
    """Return the largest rise of the energy over what it had fallen to before [m].

    Examples
    --------
    >>> gain({"energy": [3.0, 2.0, 2.5, 1.0]})
    0.5
    """
    energy = np.array(found["energy"])
    return float((energy - np.minimum.accumulate(energy)).max())


def of_a_surge(found, exact) -> dict[str, float]:
    """Return the gain of energy over the largest kinetic energy, errors of thickest place [-] and of the centre [m]."""
    if found is None:  # blown up
        return dict.fromkeys(("gain", "thickest", "x", "steps"), math.nan)
    return {
        "gain": gain(found) / max(exact["kinetic"]),
        "thickest": max(found["thickest"]) / max(exact["thickest"]) - 1.0,
        "x": found["x"][-1] - exact["x"][-1],
        "steps": len(found["lengths"]),
    }


def slides(ask):
    """Yield rows of bends and of the edge."""
    cases = [("bend", {"turn": sign * turn}) for turn in TURNS for sign in (1.0, -1.0)] + [("edge", {})]
    for name, keywords in cases:
        exact = ask(name, **keywords, way=FINE)
        for way in (*WAYS, None):
            found = ask(name, **keywords, way=way)
            yield {"case": name, **keywords, "way": found["way"], "ruled": way is None} | of_a_slide(found, exact)


def surges(ask):
    """Yield rows of the surge."""
    for ratio in RATIOS:
        exact = ask("surge", ratio=ratio, courant=COURANT[2] / SHORTER)
        for courant in COURANT:
            found = ask("surge", ratio=ratio, courant=courant)
            yield {"case": "surge", "ratio": ratio, "courant": courant} | of_a_surge(found, exact)


def measure(others, say) -> dict:
    """Return the rows of this version and of others."""
    rows = []
    with ratio_turns.versions(others) as (sides, grounds, _):
        for side, name in zip(sides, [ratio_turns.HERE, *others], strict=True):
            side.begin(str(PROGRAM), grounds)

            def ask(scene, side=side, **keywords):
                return json.loads(side.ask(json.dumps([scene, keywords])))

            for row in (*slides(ask), *surges(ask)):
                rows.append({"revision": name, **row})
                say(" ".join(f"{key} {value:.3g}" if isinstance(value, float) else f"{value}" for key, value in
                             rows[-1].items()))  # fmt: skip
            side.end()
    return {"revisions": list(others), "rows": rows}


VERSIONS = (style.BLUE, "o"), (style.ORANGE, "s"), (style.GREEN, "^")
"""Colour and mark of this version and of others."""


def chart():
    """Return the figure: error against the length of the step in the three scenes."""
    found = result_files.read("step_stability")
    rows, versions = found["rows"], [ratio_turns.HERE, *found["revisions"]]
    figure, axes = style.panels(1, 3, (15.0, 5.4))
    panel_of_bends(axes[0, 0], rows, versions)
    panel_of_the_edge(axes[0, 1], rows, versions)
    panel_of_surges(axes[0, 2], rows, versions)
    for axis in axes[0]:
        axis.legend(fontsize=8, frameon=False)
        axis.set_xticks([0.15, 0.3, 0.6, 1.0, 2.0], ["0.15", "0.3", "0.6", "1", "2"])
        axis.minorticks_off()
    return figure


def panel_of_bends(axis, rows, versions) -> None:
    """Draw the error of the energy; marks are the steps by the rules, open those of other versions."""
    colours = dict(zip(TURNS, (style.SKY, style.GREEN, style.BLUE, style.PURPLE, style.RED), strict=True))
    for turn, colour in colours.items():
        for sign, line in ((1.0, "-"), (-1.0, "--")):
            these = chosen(rows, case="bend", turn=sign * turn)
            drawn = chosen(these, revision=versions[0], ruled=False)
            label = f"{turn:g} rad" if sign > 0.0 else None
            axis.plot(*points(drawn, "way", "energy"), line, color=colour, lw=1.2, label=label)
            for version, (_, mark) in zip(versions, VERSIONS, strict=False):
                face = colour if version == versions[0] else "none"
                ruled = chosen(these, revision=version, ruled=True)
                axis.plot(*points(ruled, "way", "energy"), mark, ms=6, color=colour, mfc=face)
    style.finish(
        axis, xscale="log", yscale="log", xlabel="way in a step [nodes]",
        ylabel="error of the energy over the kinetic energy [-]",
        title="A bend, full: concave, dashed: convex\n(marks: steps by the rules, open: before)",
    )  # fmt: skip


def panel_of_the_edge(axis, rows, versions) -> None:
    """Draw the errors of volume and of place; marks are the steps by the rules."""
    for version, (colour, mark) in zip(versions, VERSIONS, strict=False):
        these = chosen(rows, case="edge", revision=version)
        for key, line, words in (("volume", "-", "volume over growth [-]"), ("x", "--", "centre [m]")):
            drawn, ruled = (points(chosen(these, ruled=choice), "way", key) for choice in (False, True))
            axis.plot(*drawn, line, color=colour, label=f"{words}, {named(version)}")
            axis.plot(*ruled, mark, ms=6, color=colour)
    style.finish(
        axis, xscale="log", yscale="log", xlabel="way in a step [nodes]", ylabel="error",
        title="Onto ground that erodes, and off it\n(marks: steps by the rules)",
    )  # fmt: skip


def panel_of_surges(axis, rows, versions) -> None:
    """Draw the error of the thickest place."""
    for version, (colour, mark) in zip(versions, VERSIONS, strict=False):
        for ratio, line in zip(RATIOS, ("-", "--"), strict=True):
            drawn = points(chosen(rows, case="surge", revision=version, ratio=ratio), "courant", "thickest")
            axis.plot(*drawn, line, marker=mark, ms=5, color=colour, label=f"{ratio:g}, {named(version)}")
    axis.axvline(0.6, color="0.4", lw=1, ls=":")
    style.finish(
        axis, xscale="log", yscale="log", xlabel="Courant number (dotted: default)",
        ylabel="error of the largest thickness [-]",
        title="A surge into a still body, pull over friction\n(lines end where a run blew up)",
    )  # fmt: skip


def points(rows, across, up) -> tuple[list[float], list[float]]:
    """Return coordinates, those upward without sign."""
    return [row[across] for row in rows], [abs(row[up]) for row in rows]


def named(version: str) -> str:
    """Return a version as legends call it."""
    return "now" if version == ratio_turns.HERE else version


def chosen(rows, **values):
    """Return the rows that have some values."""
    return [row for row in rows if all(row.get(key) == value for key, value in values.items())]


def report() -> str:
    """Return the text of benchmarks/step_stability.txt."""
    rows = result_files.read("step_stability")["rows"]

    def show(console):
        for case, heads in (
            ("bend", ("turn", "way", "ruled", "energy", "gain", "x")),
            ("edge", ("way", "ruled", "energy", "x", "volume")),
            ("surge", ("ratio", "courant", "gain", "thickest", "x", "steps")),
        ):  # fmt: skip
            table = Table(title=case, title_justify="left")
            for head in ("version", *heads):
                table.add_column(head, justify="right")
            for row in chosen(rows, case=case):
                cells = (f"{row[head]:.3g}" if not isinstance(row[head], bool) else "*" * row[head] for head in heads)
                table.add_row(row["revision"], *cells)
            console.print(table)

    return charts.printed(show, width=120)


def main() -> None:
    """Measure as the command line says."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--against", default=[], action="append", **ratio_turns.VERSION)
    options = parser.parse_args()
    found = measure(dict(options.against), Console(width=160).log)
    result_files.keep("step_stability", found, COMMAND)
    charts.make("step_stability")


if __name__ == "__main__":
    main()
