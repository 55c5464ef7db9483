"""Columns of Pastor et al. (2022), figures 6 to 9, beside exact solutions: ``python -m benchmarks.paper_columns``.

Runs the solvers of examples/paper_columns.py and keeps benchmarks/results/paper_columns.json, from which
docs/figures/paper_columns.png is drawn.
"""

import argparse

import numpy as np

from benchmarks import charts, result_files
from benchmarks.example_scripts import load

LEVELS = 11
COMMAND = "python -m benchmarks.paper_columns"


def measure():
    """Return pressures of figure 6, and of figures 7 to 9, over that of the bed, as rows, and largest errors."""
    script = load("paper_columns")
    fronts = {scheme: script.pressure(script.solve_front(scheme, LEVELS)) for scheme in script.SCHEMES}
    profiles = {
        (scheme, reading, name): script.pressure(script.solve_profiles(scheme, reading, number, LEVELS))
        for scheme in script.SCHEMES
        for reading in script.EXACT
        for name, number in script.PECLET.items()
    }
    level = np.linspace(0.0, 1.0, LEVELS)
    return {
        "levels": LEVELS,
        "errors": {scheme: script.compare(scheme, level, fronts, profiles) for scheme in script.SCHEMES},
        "fronts": [{"scheme": scheme, "pressure": values} for scheme, values in fronts.items()],
        "profiles": [
            {"scheme": scheme, "reading": reading, "figure": name, "pressure": values}
            for (scheme, reading, name), values in profiles.items()
        ],
    }


def chart():
    """Return the figure."""
    found = result_files.read("paper_columns")
    fronts = {row["scheme"]: np.array(row["pressure"]) for row in found["fronts"]}
    profiles = {(row["scheme"], row["reading"], row["figure"]): np.array(row["pressure"]) for row in found["profiles"]}
    level = np.linspace(0.0, 1.0, found["levels"])
    return load("paper_columns_figure").draw(load("paper_columns"), level, fronts, profiles, found["errors"])


def main() -> None:
    argparse.ArgumentParser(description=__doc__.splitlines()[0]).parse_args()
    result_files.keep("paper_columns", measure(), COMMAND)
    charts.make("paper_columns")


if __name__ == "__main__":
    main()
