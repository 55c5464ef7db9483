"""A flow that was saved and loaded goes on as if nothing had been, to the bit."""

import re

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.record.observers import EVERY_STEP

from .twins import SCENES, build, different, outcome, state


class Saves:
    """An observer that saves the flow after some of its steps, before the first one at 0."""

    interval = EVERY_STEP

    def __init__(self, folder, *steps):
        self.folder, self.steps, self.paths = folder, steps, []

    def observe(self, flow):
        if (step := flow.diagnostics.steps) in self.steps:
            self.paths.append(flow.save(self.folder / f"{step}.nc"))


def differences(flow, expected):
    """Return the places at which the state of a flow differs; 1 and np.int64(1) are equal, laws cache their choices."""
    one, other = (
        {k: re.sub(r"np\.\w+\(([^()]*)\)", r"\1", v) if isinstance(v, str) else v for k, v in found.items()}
        for found in (state(flow), expected)
    )
    column = "flow._simulation.surroundings[4][0]"
    return [(k, str(one.get(k))[:90], str(other.get(k))[:90]) for k in different(one, other) if column not in k]


@pytest.fixture(scope="module")
def twin():
    """The outcome and the state of flows that nobody interrupted, and the number of their steps."""
    known = {}

    def find(name):
        if name not in known:
            flow = build(name)
            flow.run_until_rest()
            known[name] = outcome(flow), state(flow), flow.diagnostics.steps
        return known[name]

    return find


@pytest.mark.parametrize("name", SCENES)
def test_saved_by_an_observer_and_loaded_it_goes_on(name, twin, tmp_path):
    expected, expected_state, steps = twin(name)
    rng = np.random.default_rng(4)
    saves = Saves(tmp_path, 0, 1, *rng.choice(np.arange(2, steps), 4, replace=False), steps)
    flow = build(name, [saves])
    flow.run_until_rest()
    assert not different(outcome(flow), expected) and not different(state(flow), expected_state)
    for path in saves.paths:
        again = DebrisFlow.load(path, observers=[Saves(tmp_path)])
        assert again.unfinished_until == 3600.0
        assert again.run_until_rest()
        assert different(outcome(again), expected) == []
        assert differences(again, expected_state) == []
