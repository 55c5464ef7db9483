"""Choice of one set from a small family on five flows, scored on the sixth: ``python -m validation.events.olivares``.

The family was declared before the first score: low end, centre and high end of the published ranges of three values.
For every flow the member with the largest mean IoU on the five others is taken. All members are kept in family.json.
"""

import itertools
import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from landlab_debrisflow.record import write_atomically
from validation.provenance import commit

from ..sets import ParameterSet
from .measures import measure_flow
from .setup import FLOWS, Observed

FAMILY = {"initial_pressure_ratio": "material", "turbulent_coefficient": "friction", "growth_rate": "erosion"}
"""Values that vary, and their sections. The bed has the pressure ratio of the release."""
FILE = Path(__file__).parent / "family.json"
DIGITS = 5


def members(centre: ParameterSet) -> Iterator[tuple[dict[str, float], ParameterSet]]:
    """Yield the varied values and the set of each member of the family."""
    ranges = {}
    for key, section in FAMILY.items():
        value = centre.values[section][key]
        ranges[key] = (value.span[0], value.value, value.span[1])
    for chosen in itertools.product(*ranges.values()):
        varied = dict(zip(ranges, chosen, strict=True))
        member = centre
        for key, value in varied.items():
            member = member.changed(FAMILY[key], key, value)
        yield varied, member.changed("material", "bed_pressure_ratio", varied["initial_pressure_ratio"])


def choose(scores: Sequence[Mapping[int, float]]) -> dict[int, int]:
    """Return for every flow the place of the member with the largest mean IoU on the other flows.

    Parameters
    ----------
    scores : sequence of mapping
        IoU by flow of every member.

    Examples
    --------
    >>> choose([dict.fromkeys(range(1, 7), 0.5), dict.fromkeys(range(1, 6), 0.4) | {6: 0.8}])
    {1: 0, 2: 0, 3: 0, 4: 0, 5: 0, 6: 0}
    """
    means = {flow: [np.mean([each[other] for other in FLOWS if other != flow]) for each in scores] for flow in FLOWS}
    return {flow: int(np.argmax(means[flow])) for flow in FLOWS}


def run_family(
    observed: Observed, centre: ParameterSet, particle_count: int, chosen_count: int, say: Callable[[str], object]
) -> dict[str, Any]:
    """Run all members that family.json does not have, and the chosen ones with more particles; return its content.

    Parameters
    ----------
    observed : Observed
    centre : ParameterSet
        Committed.
    particle_count, chosen_count : int
        Numbers of particles of the members and of the members chosen, which are scored.
    say : callable
        Given one line for each member.
    """
    name = centre.commit().name
    rows = [row for row in read()["members"] if (row["set_commit"], row["particles"]) == (name, particle_count)]
    told = {"set_commit": name, "code": commit(), "date": datetime.now(UTC).date().isoformat()}
    family = list(members(centre))
    for varied, member in family:
        if not any(row["values"] == varied for row in rows):
            flows = {str(flow): measure_flow(observed, flow, member, particle_count) for flow in FLOWS}
            rows.append({"values": varied, "particles": particle_count, **told, "flows": flows})
            _write(rows, [])
            say(f"{varied}: median IoU {np.median([each['iou'] for each in flows.values()]):.3f}")
    order = [next(row for row in rows if row["values"] == varied) for varied, _ in family]
    places = choose([{flow: row["flows"][str(flow)]["iou"] for flow in FLOWS} for row in order])
    chosen = []
    for flow, place in places.items():
        varied, member = family[place]
        found = measure_flow(observed, flow, member, chosen_count)
        chosen.append({"flow": flow, "values": varied, "particles": chosen_count, **told, "measures": found})
        say(f"flow {flow}: chosen on the others {varied}, IoU {found['iou']:.3f}")
    _write(rows, chosen)
    return read()


def read() -> dict[str, Any]:
    """Return the content of family.json: ``members`` and ``chosen``, empty before the first run."""
    if not FILE.is_file():
        return {"members": [], "chosen": []}
    return json.loads(FILE.read_text(encoding="utf-8"))


def chosen_measures() -> dict[int, dict[str, float]]:
    """Return the measures of every flow with the member that was chosen on the others; empty before the first run."""
    return {row["flow"]: row["measures"] for row in read()["chosen"]}


def best_measures() -> dict[int, dict[str, float]]:
    """Return the measures of every flow with the member that suits itself best; empty before the first run."""
    rows = read()["members"]
    if len(rows) < 3 ** len(FAMILY):
        return {}
    return {flow: max((row["flows"][str(flow)] for row in rows), key=lambda found: found["iou"]) for flow in FLOWS}


def _write(rows: list[dict], chosen: list[dict]) -> None:
    lists = [
        f'"{name}": [\n  ' + ",\n  ".join(json.dumps(_rounded(row)) for row in each) + "\n ]"
        for name, each in (("members", rows), ("chosen", chosen))
    ]
    text = "{\n " + ",\n ".join(lists) + "\n}\n"
    write_atomically(FILE, lambda path: path.write_text(text, encoding="utf-8"))


def _rounded(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _rounded(each) for key, each in value.items()}
    return float(f"{value:.{DIGITS}g}") if isinstance(value, float) else value
