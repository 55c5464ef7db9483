"""Run and score measured events: ``python -m validation.events [EVENT ...]``, all of them by default.

Prints the scores and the targets of the set that is shown, and appends the scores to scores.json of the event. With the
set and the number of particles that are shown, result.nc is written, and the tables of docs/events.md anew; ``nox -s
figures`` draws the figures.
"""

import argparse
import math
import sys
import time

from rich.console import Console
from rich.table import Table
from rich.text import Text

from landlab_debrisflow.core.errors import InputError

from . import EVENTS, find_event, page, record
from .event import Event
from .sets import ParameterSet


def run_and_record(event: Event, parameters: ParameterSet, particle_count: int) -> dict[str, float]:
    """Run an event with a set, record the scores, keep the result if it is the one that is shown; return the scores."""
    parameters.commit()  # refuses before anything runs
    result = event.run(parameters, particle_count)
    scores = event.score(result)
    record.add_scores(event, parameters, particle_count, scores, event.references(result))
    shown = event.default_set, event.particle_count, ""
    if (parameters.name, particle_count, parameters.change) == shown:
        record.keep_result(event, parameters, result)
    return scores


def run_event(event: Event, options: argparse.Namespace, console: Console) -> None:
    """Run the sets, scans and refinements of an event that are asked for, and print their scores."""
    count, columns = options.particles or event.particle_count, {}
    for parameters in [event.read_set(name) for name in options.set or [event.default_set]]:
        runs = [(parameters, count)]
        if options.scan is not None:
            runs += [(changed, count) for changed in parameters.scan(options.scan)]
        if options.refine:
            runs += [(parameters, number) for number in (*record.nearby_counts(count), 2 * count)]
        for changed, number in runs:
            begin = time.perf_counter()
            words = ", ".join(filter(None, (changed.name, changed.change, f"{number} particles")))
            columns[words] = run_and_record(event, changed, number)
            console.print(f"{event.name}: {words}, {time.perf_counter() - begin:.0f} s", highlight=False)
    console.print(table(event, columns), highlight=False)
    console.print(page.targets(event.name), highlight=False, markup=False)


def table(event: Event, rows: dict[str, dict[str, float]]) -> Table:
    """Return the scores that are tabulated, one run in a row; scores.json has all of them."""
    shown = Table(title=event.title, title_justify="left")
    shown.add_column("", no_wrap=True)
    measures = {key: measure for key, measure in event.measures.items() if measure.tabulated}
    for measure in measures.values():
        shown.add_column(Text(measure.words), justify="right")
    for words, values in rows.items():
        cells = (measure.text(values.get(key, math.nan)) for key, measure in measures.items())
        shown.add_row(Text(words), *cells)
    return shown


def main(arguments: list[str] | None = None) -> int:
    """Run events by name."""
    parser = argparse.ArgumentParser(prog="python -m validation.events", description=__doc__.splitlines()[0])
    parser.add_argument("events", nargs="*", metavar="EVENT", help=f"by default all: {', '.join(EVENTS)}")
    parser.add_argument("--set", action="append", metavar="NAME", help="set of parameters, by default the one shown")
    parser.add_argument("--particles", type=int, metavar="N", help="by default the number of the event")
    parser.add_argument(
        "--scan",
        nargs="?",
        const="",
        metavar="WORD",
        help="every value at the ends of its published range, too; with WORD those with it in their key",
    )
    parser.add_argument("--refine", action="store_true", help="numbers of particles near N (noise) and 2 N, too")
    options = parser.parse_args(arguments)
    if options.particles is not None and options.particles < 1:
        parser.error(f"--particles must be 1 or more, got {options.particles}")
    console = Console(width=max(160, Console().width))
    try:
        for event in [find_event(name) for name in options.events or EVENTS]:
            run_event(event, options, console)
        for path in page.fill():
            console.print(f"Wrote {path}", highlight=False, soft_wrap=True)
    except InputError as error:
        print(f"validation.events: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
