"""Each new rule of the steps switched off once: ``python -m benchmarks.step_rules --against REVISION=PYTHON``.

The stand-in for Tsing Shan with 1500 and 5000 particles, and S-1000 with five numbers of particles around 2000, to
rest: with all rules, without one, without any, and with another version (REVISION), in turns. CPU time and steps are
over those of REVISION; errors of the valley are against steps 16 times shorter (of this version, the same particles),
those of S-1000 against the mean of REVISION, whose spread over the five stands beside.

A rule is switched off by replacing a constant or a function of a module (`RULES`). Keeps
benchmarks/results/step_rules.json, from which benchmarks/step_rules.txt and a table of docs/accuracy.md are made.
"""

import argparse
import json
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table

from benchmarks import charts, ratio_turns, result_files
from benchmarks.ratio_rows import COUNTS
from benchmarks.rules_off import RULES

PROGRAM = Path(__file__).parent / "rules_off.py"
COMMAND = "python -m benchmarks.step_rules --against REVISION=PYTHON"
ALL, NONE = "all rules", "no new rule"
SHORTER = 16
MEASURES = "run_out", "centre", "eroded"


def requests(scene: str, keywords: dict) -> dict[str, str]:
    """Return the line that asks for a scene, with all rules and without some."""
    off = {ALL: [], **{f"without {rule}": [rule] for rule in RULES}, NONE: list(RULES)}
    return {name: json.dumps([scene, keywords | {"without": rules}]) for name, rules in off.items()}


def in_turns(sides, name, scene, keywords, count, say) -> dict[str, list[dict]]:
    """Return the answers for all variants of a scene, and for the other version, per turn."""
    here, other = sides
    asked = [(key, here, line) for key, line in requests(scene, keywords).items()]
    asked.append((name, other, json.dumps([scene, keywords | {"without": []}])))
    found = ratio_turns.turns(asked, count, lambda one: json.loads(one[1].ask(one[2])))
    say(f"{scene} {keywords}")
    return {key: [turn[k] for turn in found] for k, (key, *_) in enumerate(asked)}


def of_the_valley(found, exact, name) -> list[dict]:
    """Return rows of the valley: medians of ratios over turns, and errors."""
    rows = []
    for key, turns in found.items():
        row = {"variant": key, "steps": turns[0]["steps"] / found[name][0]["steps"]}
        row["cpu"] = float(np.median([a["cpu"] / b["cpu"] for a, b in zip(turns, found[name], strict=True)]))
        rows.append(row | {measure: turns[0][measure] - exact[measure] for measure in MEASURES})
    return rows


def of_s1000(found, name) -> list[dict]:
    """Return rows of S-1000: ratios of sums over the five, means against those of the other version, and spreads."""
    rows = []
    for key, (answer, *_) in found.items():
        base = found[name][0]
        row = {"variant": key} | {ratio: sum(answer[ratio]) / sum(base[ratio]) for ratio in ("steps", "cpu")}
        for measure in MEASURES:
            row[measure] = float(np.mean(answer[measure]) - np.mean(base[measure]))
            row[f"{measure}, spread"] = float(np.std(answer[measure], ddof=1))
        rows.append(row)
    return rows


def measure(name, python, data, quick, say) -> dict:
    """Return the rows of all scenes."""
    rows = []
    with ratio_turns.versions({name: python}, data) as (sides, grounds, there):
        for side in sides:
            side.begin(str(PROGRAM), grounds)
            side.ask(json.dumps(["to_rest", {"count": 50, "without": []}]))
        for count in (1500,) if quick else (1500, 5000):
            keywords = {"count": count}
            exact = json.loads(sides[0].ask(json.dumps(["to_rest", {**keywords, "shorter": SHORTER, "without": []}])))
            found = in_turns(sides, name, "to_rest", keywords, 1 if quick else 5, say)
            rows += [{"scene": f"valley, {count}", **row} for row in of_the_valley(found, exact, name)]
        for friction in ("voellmy", "coulomb") if "s1000" in there and not quick else ():
            found = in_turns(sides, name, "s1000", {"friction": friction, "counts": COUNTS}, 1, say)
            rows += [{"scene": f"S-1000, {friction}", **row} for row in of_s1000(found, name)]
        for side in sides:
            side.end()
    return {"revision": name, "rows": rows}


def show(found, console) -> None:
    """Print the table."""
    table = Table(title=f"Rules of the steps, over {found['revision']}", title_justify="left")
    heads = "scene", "variant", "steps", "CPU", "run-out [m]", "centre [m]", "eroded [m3]"
    for head in heads:
        table.add_column(head, justify="left" if head in heads[:2] else "right", no_wrap=True)
    for row in found["rows"]:
        table.add_row(*cells(row))
    console.print(table)


def cells(row) -> list[str]:
    """Return the cells of a row."""
    numbers = []
    for measure, form in zip(MEASURES, ("+.0f", "+.1f", "+.0f"), strict=True):
        spread = f" ± {row[f'{measure}, spread']:.0f}" if f"{measure}, spread" in row else ""
        numbers.append(f"{row[measure]:{form}}{spread}")
    return [row["scene"], row["variant"], f"{row['steps']:.2f}", f"{row['cpu']:.2f}", *numbers]


def report() -> str:
    """Return the text of benchmarks/step_rules.txt."""
    return charts.printed(lambda console: show(result_files.read("step_rules"), console), width=130)


def main() -> None:
    """Measure as the command line says."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--against", required=True, **ratio_turns.VERSION)
    parser.add_argument("--data", metavar="FOLDER", help="of the rasters of S-1000; by default $DEBRISFLOW_DATA")
    parser.add_argument("--quick", action="store_true", help="few particles only; prints, and keeps nothing")
    options = parser.parse_args()
    console = Console(width=130)
    found = measure(*options.against, options.data, options.quick, console.log)
    show(found, console)
    if not options.quick:
        result_files.keep("step_rules", found, COMMAND)
        charts.make("step_rules")


if __name__ == "__main__":
    main()
