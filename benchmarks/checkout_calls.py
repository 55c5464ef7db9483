"""Run benchmarks of another checkout by their own code: a program, ``PYTHONPATH=CHECKOUT python -P checkout_calls.py``.

Reads requests from its input, one a line: a JSON list of a name of `CALLS` and its arguments; answers each with JSON.
"""

import json
import sys
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import asdict


def flow(case, number):
    """Return the result of a case of benchmarks.flow."""
    from benchmarks.flow import CASES

    return asdict(CASES[case][0](number))


def column_cost(case, scheme, levels, peclet):
    """Return the CPU time of a column and step [ns]."""
    from benchmarks.column import cost

    return cost(case, scheme, levels, peclet, repeats=1)


def column_errors(case, scheme, levels):
    """Return the worst errors of basal pressure and depth mean by Peclet number."""
    from benchmarks.column import errors

    return [found.tolist() for found in errors(case, scheme, levels)]


CALLS = {one.__name__: one for one in (flow, column_cost, column_errors)}


@contextmanager
def checkouts(others: Mapping[str, str]) -> Iterator[list]:
    """Start a process of this checkout and of each other one, folders by name; yields what asks them.

    Yields
    ------
    list of callable
        Each takes the name of a call and its arguments, and returns the answer.
    """
    import tempfile

    from benchmarks.result_files import ROOT
    from benchmarks.speed_against import Side

    with ExitStack() as stack:
        sides = []
        for path in (str(ROOT), *others.values()):
            side = Side(sys.executable, path, stack.enter_context(tempfile.TemporaryDirectory()))
            side.begin(__file__)
            stack.callback(side.end)
            sides.append(side)
        yield [lambda *request, side=side: json.loads(side.ask(json.dumps(request))) for side in sides]


if __name__ == "__main__":
    for line in sys.stdin:
        name, *arguments = json.loads(line)
        print(json.dumps(CALLS[name](*arguments)), flush=True)
