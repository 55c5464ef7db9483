"""Choice of one set from a small family on five flows, scored on the sixth: ``python -m validation.events.olivares``.

The family was declared before the first score: low end, centre and high end of the published ranges of three values.
For every flow the member with the largest mean IoU on the five others is taken.
"""

import itertools
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from ..sets import ParameterSet
from .setup import FLOWS

FAMILY = {"initial_pressure_ratio": "material", "turbulent_coefficient": "friction", "growth_rate": "erosion"}
"""Values that vary, and their sections. The bed has the pressure ratio of the release."""


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
