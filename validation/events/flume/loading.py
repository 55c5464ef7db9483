"""Does a column that thins keep its effective stress? ``python -m validation.events.flume.loading [--particles N]``.

Prints arrivals, peaks and toe of the flume with the three loading sources of a column, with and without pressure made
by shear. The sets are changed here and nothing is recorded: this is a scan.
"""

import argparse
from dataclasses import replace

from rich.console import Console
from rich.table import Table

from ..sets import ParameterSet, read_set
from . import EVENT

LOADINGS = ("overburden", "proportional", "none")
CASES = {
    "dilatancy, 5e-9 m²": ("george_iverson_2014", {}),
    "dilatancy, 5e-9 m², start ratio 0.9": ("george_iverson_2014", {"material": {"initial_pressure_ratio": 0.9}}),
    "dilatancy, measured 4e-11 m²": ("george_iverson_2014", {"column": {"dilatancy.permeability": 4e-11}}),
    "dilatancy, measured 1e-11 m²": ("measured_permeability", {}),
    "no dilatancy, hydrostatic start": ("no_dilatancy", {}),  # proportional and none: no excess pressure at all
    "no dilatancy, start ratio 0.65": ("no_dilatancy", {"material": {"initial_pressure_ratio": 0.65}}),
    "no dilatancy, start ratio 0.9": ("no_dilatancy", {"material": {"initial_pressure_ratio": 0.9}}),
    "no dilatancy, c_v 4e-4 m² s⁻¹, start ratio 0.65": (
        "no_dilatancy", {"material": {"initial_pressure_ratio": 0.65, "coefficient_of_consolidation": 4e-4}}
    ),
    "no dilatancy, c_v 4e-4 m² s⁻¹, start ratio 0.9": (
        "no_dilatancy", {"material": {"initial_pressure_ratio": 0.9, "coefficient_of_consolidation": 4e-4}}
    ),
}  # fmt: skip
"""Set, and values that differ from it, by words."""

SHOWN = ("arrival h 32 m", "arrival h 66 m", "peak h 32 m", "peak h 66 m", "largest_thickness", "toe")


def changed(set_name: str, values: dict[str, dict[str, float]], loading: str) -> ParameterSet:
    """Return a set with other values and a loading source."""
    parameters = read_set(EVENT.folder / "sets", set_name)
    for section, keys in values.items():
        for key, value in keys.items():
            parameters = parameters.changed(section, key, value)
    column = {**parameters.values["column"], "loading_source": loading}
    return replace(parameters, values={**parameters.values, "column": column}, change=loading)


def main() -> None:
    """Run all cases with all loadings and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--particles", type=int, default=EVENT.particle_count)
    particles = parser.parse_args().particles
    console = Console(width=150)
    table = Table("", "loading", *(EVENT.measures[key].words for key in SHOWN), title=f"{particles} particles")
    for words, (set_name, values) in CASES.items():
        for loading in LOADINGS:
            scores = EVENT.score(EVENT.run(changed(set_name, values, loading), particles))
            table.add_row(words, loading, *(EVENT.measures[key].form.format(scores[key]) for key in SHOWN))
            console.print(words, loading, {key: round(scores[key], 3) for key in SHOWN}, highlight=False)
    console.print(table, highlight=False)


if __name__ == "__main__":
    main()
