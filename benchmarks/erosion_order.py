"""Order of erosion in the length of the step: ``python -m benchmarks.erosion_order --against REVISION=PYTHON``.

The stand-in for Tsing Shan with 1500 particles, which leaves its erodible ground after some 35 s, in the steps of its
rules and in steps 2, 4 and 16 times shorter, all numbers of particles and places at release the same. Printed are the
differences to the shortest steps in centre of mass, front (99 % of the volume) and volume, and the order that two rows
with steps in the ratio 2 show. Beside this version another one (REVISION). Keeps benchmarks/results/erosion_order.json,
from which benchmarks/erosion_order.txt and a table of docs/accuracy.md are made.
"""

import argparse
import json
import math

from rich.console import Console
from rich.table import Table

from benchmarks import charts, ratio_turns, result_files
from benchmarks.step_stability import PROGRAM, chosen

COMMAND = "python -m benchmarks.erosion_order --against REVISION=PYTHON"
TIMES, COUNT = (20.0, 30.0, 36.0), 1500
SHORTER, FINEST = (1, 2, 4), 16
MEASURES = {"x": "centre [m]", "front": "front [m]", "volume": "volume [m3]"}
HEADS = "version", "time [s]", "steps shorter", "steps", *MEASURES.values(), "order, centre", "order, volume"


def measure(others, count, say) -> dict:
    """Return rows of differences to the shortest steps of the same version, and of that to this version's."""
    rows, names = [], [ratio_turns.HERE, *others]
    with ratio_turns.versions(others) as (sides, grounds, _):
        finest = None
        for side, name in zip(sides, names, strict=True):
            side.begin(str(PROGRAM), grounds)
            runs = {
                shorter: json.loads(side.ask(json.dumps(
                    ["valley_at", {"times": TIMES, "count": count, "shorter": shorter}]
                )))
                for shorter in (*SHORTER, FINEST)
            }  # fmt: skip
            side.end()
            finest = finest or runs[FINEST]
            for shorter, run in runs.items():
                against = finest if shorter == FINEST else runs[FINEST]
                for k, time in enumerate(TIMES):
                    rows.append(
                        {"revision": name, "time": time, "shorter": shorter, "steps": len(run["lengths"])}
                        | {key: run[key][k] - against[key][k] for key in MEASURES}
                    )
            say(f"{name}: {[len(run['lengths']) for run in runs.values()]} steps")
    return {"revisions": list(others), "particles": count, "rows": rows}


def order(coarse: float, fine: float, ratio: float) -> float:
    """Return the observed order in the length of the step, from differences to steps that are `ratio` of the longer.

    The shortest steps have an error themselves: an error a dt^p differs from it by a dt^p (1 - (1/ratio)^p).

    Examples
    --------
    >>> round(order(16.0 - 1.0, 8.0 - 1.0, 16.0), 3), round(order(256.0 - 1.0, 64.0 - 1.0, 16.0), 3)
    (1.0, 2.0)
    """
    if coarse * fine <= 0.0:
        return math.nan
    low, high = 0.05, 6.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        expected = (1.0 - ratio**-middle) / (0.5**middle - ratio**-middle)
        low, high = (middle, high) if expected < coarse / fine else (low, middle)
    return middle


def show(found, console) -> None:
    """Print the table."""
    title = f"Differences to steps {FINEST} times shorter, {found['particles']} particles"
    table = Table(title=title, title_justify="left")
    for head in HEADS:
        table.add_column(head, justify="left" if head == "version" else "right", no_wrap=True)
    for row in found["rows"]:
        table.add_row(*cells(row, found["rows"]))
    console.print(table)


def cells(row, rows) -> list[str]:
    """Return the cells of a row; orders are those between steps twice as long and these."""
    words = [row["revision"], f"{row['time']:g}", f"{row['shorter']}", f"{row['steps']}"]
    words += [f"{row[key]:+.{digits}f}" for key, digits in (("x", 2), ("front", 1), ("volume", 1))]
    longer = chosen(rows, revision=row["revision"], time=row["time"], shorter=row["shorter"] // 2)
    if not longer or row["shorter"] == FINEST:
        return [*words, "", ""]
    orders = [order(longer[0][key], row[key], FINEST / longer[0]["shorter"]) for key in ("x", "volume")]
    return [*words, *("" if math.isnan(value) else f"{value:.1f}" for value in orders)]


def report() -> str:
    """Return the text of benchmarks/erosion_order.txt."""
    return charts.printed(lambda console: show(result_files.read("erosion_order"), console), width=120)


def main() -> None:
    """Measure as the command line says."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--against", default=[], action="append", **ratio_turns.VERSION)
    parser.add_argument("--quick", action="store_true", help="few particles only; prints, and keeps nothing")
    options = parser.parse_args()
    console = Console(width=120)
    found = measure(dict(options.against), 200 if options.quick else COUNT, console.log)
    show(found, console)
    if not options.quick:
        result_files.keep("erosion_order", found, COMMAND)
        charts.make("erosion_order")


if __name__ == "__main__":
    main()
