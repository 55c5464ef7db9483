"""Cost of this version over that of others, in turns: ``python -m benchmarks.ratios --against REVISION=PYTHON``.

PYTHON is the interpreter of an environment with the version REVISION; --against may be repeated. A machine is not as
fast from one hour to the next, so each version waits in a process of its own, all run a scene of ratio_scenes.py in
turns, who begins changing, and only the ratios within a turn count. Processes are started anew some times. The scenes
have their laws, loading, material and numerics written out, so no default of a version enters.

Printed are medians of this version, and the ratio to each other version with its quartiles: of rates above 1, of costs
below 1, this version is faster. CPU time, but for two threads over one, which is wall time. The rows:

sums and steps       cap of the similarity solution; steps of the valley have erosion and columns, too
fixed cost           CPU time of a step in the valley for no particles: the line through 50 to 800 of them
valley, S-1000       to rest; S-1000 with 2000 particles and with up to 3 % more and fewer, and what they find (--data)
two phases           CPU time of a step of two phases over that of one, as many particles in each
start                fresh process with an empty folder of kernels, beyond the import of landlab
memory               traced bytes that a component holds, over the nodes
com1DFA              particle steps per second over those of AvaFrame com1DFA 2.1 (--peer)

All rows take an hour, so --rows takes words of some: their values replace those that are kept, if the versions are the
same. Keeps benchmarks/results/ratios.json, from which benchmarks/ratios.txt, docs/figures/ratios.png and a table of
docs/time_steps.md are made; every row says from which commit, when and under what load. With --quick nothing is kept.
"""

import argparse

from rich.console import Console
from rich.table import Table

from benchmarks import charts, ratio_turns, result_files, style
from validation.rivals import com1dfa

COMMAND = "python -m benchmarks.ratios --against REVISION=PYTHON"


def show(found, console) -> None:
    """Print the rows, then what S-1000 found."""
    table = Table(title="This version, and ratios to others with quartiles", title_justify="left")
    for word in ("", "unit", "turns", "here", *(f"over {name}" for name in found["revisions"])):
        table.add_column(word, justify="left" if word in ("", "unit") else "right", no_wrap=True)
    for row in found["rows"]:
        ratios = ("{1:.3f} ({0:.3f} to {2:.3f})".format(*row["ratios"][name]) for name in found["revisions"])
        name = row["row"] + (" (rate)" if row["rate"] else "")
        table.add_row(name, row["unit"], f"{row['turns']}", f"{row['here']:.4g}", *ratios)
    console.print(table)
    if found["S-1000"]:
        table = Table(title="S-1000, mean and standard deviation over numbers of particles", title_justify="left")
        heads = {"run_out": "99 % of the deposit [m]", "eroded": "eroded [m3]", "end": "at rest [s]", "steps": "steps"}
        for word in ("friction", "version", *heads.values()):
            table.add_column(word, justify="left" if word in ("friction", "version") else "right", no_wrap=True)
        for row in found["S-1000"]:
            cells = (f"{row[key]:.0f} ± {row[f'{key}, deviation']:.0f}" for key in heads)
            table.add_row(row["friction"], row["revision"], *cells)
        console.print(table)


def report() -> str:
    """Return the text of benchmarks/ratios.txt."""
    return charts.printed(lambda console: show(result_files.read("ratios"), console), width=140)


def kept() -> dict:
    """Return what has been kept before; nothing if there is none."""
    return result_files.read("ratios") if (result_files.FOLDER / "ratios.json").is_file() else {}


def joined(found, before) -> dict:
    """Return what was found, and of before the rows that were not measured now, if the other versions are the same.

    Examples
    --------
    >>> old = {"revisions": ["a"], "rows": [{"row": "x", "n": 1}, {"row": "y", "n": 1}], "S-1000": []}
    >>> joined({"revisions": ["a"], "rows": [{"row": "x", "n": 2}], "S-1000": []}, old)["rows"]
    [{'row': 'x', 'n': 2}, {'row': 'y', 'n': 1}]
    """
    if before.get("revisions") != found["revisions"]:
        return found
    rows = {row["row"]: row for one in (before, found) for row in one["rows"]}
    events = {(row["friction"], row["revision"]): row for one in (before, found) for row in one["S-1000"]}
    return {"revisions": found["revisions"], "rows": list(rows.values()), "S-1000": list(events.values())}


def speed_up(row, name) -> list[float]:
    """Return quartiles of how many times as fast, or as small, this version is, in rising order.

    Examples
    --------
    >>> speed_up({"rate": False, "ratios": {"old": [0.25, 0.5, 0.5]}}, "old")
    [2.0, 2.0, 4.0]
    """
    low, middle, high = row["ratios"][name]
    return [low, middle, high] if row["rate"] else [1.0 / high, 1.0 / middle, 1.0 / low]


def chart():
    """Return the figure: how many times as fast this version is, row by row."""
    found = result_files.read("ratios")
    rows = found["rows"][::-1]
    figure, axes = style.panels(1, 1, (9.4, 1.2 + 0.29 * len(rows)))
    axis, revisions = axes[0, 0], found["revisions"]
    for k, (name, colour) in enumerate(zip(revisions, (style.BLUE, style.ORANGE, style.GREEN), strict=False)):
        places = [at + 0.18 * (0.5 * (len(revisions) - 1) - k) for at in range(len(rows))]
        low, middle, high = zip(*(speed_up(row, name) for row in rows), strict=True)
        errors = [[m - a for m, a in zip(middle, low, strict=True)], [b - m for m, b in zip(middle, high, strict=True)]]
        axis.errorbar(middle, places, xerr=errors, fmt="o", ms=5, lw=1.2, color=colour, label=f"over {name}")
    axis.axvline(1.0, color="0.4", lw=1)
    axis.set_yticks(range(len(rows)), [row["row"] for row in rows])
    words = "times as fast, as cheap or as small (median and quartiles of turns in one run)"
    style.finish(axis, xscale="log", xlabel=words, ylim=(-0.6, len(rows) - 0.4))
    low, high = axis.get_xlim()
    ticks = [tick for tick in (0.25, 0.5, 0.7, 1, 1.4, 2, 3, 4, 6, 8, 10, 20) if low <= tick <= high]
    axis.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axis.minorticks_off()
    style.legend_below(figure, axis, ncol=len(revisions))
    return figure


def main() -> None:
    """Measure as the command line says."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--against", required=True, action="append", **ratio_turns.VERSION)
    parser.add_argument("--data", metavar="FOLDER", help="of the rasters of S-1000; by default $DEBRISFLOW_DATA")
    parser.add_argument("--peer", metavar="PYTHON", type=com1dfa.interpreter, help="an interpreter with avaframe==2.1")
    parser.add_argument("--rows", metavar="WORD", nargs="+", default=[], help="words of the rows to be measured")
    parser.add_argument("--quick", action="store_true", help="one turn of the short scenes")
    options = parser.parse_args()
    console = Console(width=140)
    told = result_files.provenance(COMMAND)  # before it makes a load itself
    found = ratio_turns.measure(
        dict(options.against), data=options.data, peer=options.peer, words=options.rows, quick=options.quick,
        say=console.log,
    )  # fmt: skip
    show(found, console)
    if not options.quick:
        for row in found["rows"]:
            row |= {key: told[key] for key in ("commit", "date", "load")}
        result_files.keep("ratios", joined(found, kept()), COMMAND, told)
        charts.make("ratios")


if __name__ == "__main__":
    main()
