"""Read files that no user meant to write: ``python -m benchmarks.fuzz --count 20000 --seed 1``.

Scenes, rasters, vector files, tables and checkpoints are drawn at random: good ones, good ones with one change, and
good ones with damaged bytes; contents of checkpoints are changed under a digest that is right. Each is read in a copy
of this process with limits of time and memory; of some that are accepted a flow is made and run for a few steps. A file
must be refused by an InputError, ParameterError or FieldError, or be read; where a library crashes is counted apart.

``--only N`` runs one case again and shows what it says, ``--coverage`` counts the lines of the readers that a sample
reaches, ``--refusals N`` shows some refusals.
"""

import argparse
import time
from collections import Counter
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from .cases import FORMS, KINDS, case, prepare
from .coverage import print_coverage
from .trial import GOOD, try_case, try_cases

OUTCOMES = (*GOOD, "error", "hang", "crash", "not finite", "written")
TEXT = Path(__file__).parent.with_suffix(".txt")


def main() -> int:
    """Run the command; return 1 if a file was not read as it should."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=2000, help="number of cases (default: %(default)s)")
    parser.add_argument("--first", type=int, default=0, help="number of the first case")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kind", choices=KINDS, help="only cases of this kind")
    parser.add_argument("--form", choices=FORMS, help="only cases of this form")
    parser.add_argument("--only", type=int, metavar="N", help="run one case")
    parser.add_argument("--keep", type=Path, help="directory for the files of cases that failed, and of one by --only")
    parser.add_argument("--coverage", action="store_true", help="count the lines of the readers that are reached")
    parser.add_argument("--workers", type=int, default=1, help="number of cases at a time (default: %(default)s)")
    parser.add_argument("--refusals", type=int, metavar="N", help="show N refusals, drawn at random")
    parser.add_argument("--write", action="store_true", help=f"keep the table in {TEXT.name}")
    arguments = parser.parse_args()
    console = Console(width=120)
    prepare()
    cases = [case(arguments.seed, number) for number in range(arguments.first, arguments.first + arguments.count)]
    cases = [one for one in cases if arguments.kind in (None, one.kind) and arguments.form in (None, one.form)]
    if arguments.only is not None:
        one = case(arguments.seed, arguments.only)
        outcome, _, _ = try_case(one, arguments.keep)
        console.print(escape(f"{one}\n{outcome.done}\n{outcome.name}: {outcome.words}"))
        return int(outcome.name not in GOOD)
    elif arguments.coverage:
        print_coverage(console, cases, arguments.workers)
    else:
        return _run(console, cases, arguments)
    return 0


def _run(console: Console, cases, arguments) -> int:
    counts, failures, refusals, began, cpu = Counter(), [], [], time.monotonic(), 0.0
    if arguments.keep is not None:
        arguments.keep.mkdir(exist_ok=True)
    tried = zip(cases, try_cases(cases, arguments.workers, arguments.keep), strict=True)
    for number, (one, (outcome, seconds, _)) in enumerate(tried, 1):
        if number % 1000 == 0:
            console.print(f"{number} files in {time.monotonic() - began:.0f} s")
        cpu += seconds
        counts[one.kind, one.form, outcome.name] += 1
        if outcome.name not in (*GOOD[:4],):
            failures.append((one, outcome))
            words = " ".join(outcome.words.split())[:240]
            told = f"{one.number} {one.kind}, {one.form}, {outcome.done}: {outcome.name} {words}"
            console.print(escape(told), highlight=False)
        elif outcome.name == "refused":
            refusals.append((one, outcome))
    table = Table(title=f"{len(cases)} files, seed {arguments.seed}")
    for column in ("", "files", *OUTCOMES):
        table.add_column(column, justify="left" if not column else "right")
    for place, names in ((0, KINDS), (1, FORMS), (None, ("all",))):
        for name in names:
            chosen = Counter()
            for key, count in counts.items():
                chosen[key[2]] += count if place is None or key[place] == name else 0
            table.add_row(name, str(chosen.total()), *(str(chosen[one]) for one in OUTCOMES))
        table.add_section()
    if arguments.refusals:
        for k in np.random.default_rng(arguments.seed).permutation(len(refusals))[: arguments.refusals]:
            one, outcome = refusals[k]
            console.print(escape(f"{one.number} {one.kind}, {outcome.done}\n    {outcome.words}"), highlight=False)
    seconds = f"{time.monotonic() - began:.0f} s, {cpu / max(len(cases), 1):.3f} s of CPU for a file"
    console.print(table, seconds)
    if arguments.write:
        with TEXT.open("w") as file:
            Console(file=file, width=140).print(
                f"python -m benchmarks.fuzz --count {arguments.count} --seed {arguments.seed}", table
            )
    return int(any(outcome.name not in GOOD for _, outcome in failures))
