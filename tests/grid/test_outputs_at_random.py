"""Whatever is done to components on a grid, in whatever order: the maps and the budget of each agree."""

import random

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow, InputError
from validation.grids import release_slab
from validation.measure import body

from .test_outputs import ARRIVAL, DEPOSIT, ERODED, FAR, NEAR, PEAKS, RELEASE, SOIL, Fails, scene

pytestmark = pytest.mark.slow

LAWS = (
    {}, {"flow": "two_phase"}, {"friction": "voellmy"}, {"column": "none", "erosion": "none"},
    {"material": {"bed_porosity": 0.5}},
)  # fmt: skip


class Player:
    """Does things at random to components on one grid."""

    def __init__(self, seed):
        self.dice = random.Random(seed)
        self.grid = scene(walled=self.dice.random() < 0.3)
        self.flows, self.done = [], []
        self.build(None)

    def build(self, continues):
        numerics = {"particle_count": 40, "settle": self.dice.random() < 0.6}
        flow = DebrisFlow(self.grid, numerics=numerics, continues=continues, **self.dice.choice(LAWS))
        self.flows.append(flow)

    def release(self, flow):
        release_slab(self.grid, self.dice.choice([NEAR, FAR]), 8.0, 0.2)
        at = self.grid.at_node
        at[RELEASE][:] = np.minimum(at[RELEASE], at[SOIL]) * (self.grid.status_at_node == 0)
        flow.run_one_step(self.dice.choice([0.5, 4.0]))

    def rest(self, flow):
        flow.run_until_rest(self.dice.choice([3.0, 300.0]))

    def fail(self, flow):
        flow._observers = (Fails(),)
        try:
            flow.run_one_step(7.0)
        except RuntimeError:
            pass
        finally:
            flow._observers = ()

    def scribble(self, flow):
        self.grid.at_node[self.dice.choice([ERODED, DEPOSIT])][:] = self.dice.choice([0.0, 3.0])

    def move(self):
        what = (self.release, self.rest, self.fail, self.scribble, self.build, DebrisFlow.settle, DebrisFlow.new_event)
        what, flow = self.dice.choices(what, (4, 2, 1, 1, 2, 1, 1))[0], self.dice.choice(self.flows)
        self.done.append((what.__name__, self.flows.index(flow)))
        try:
            what(None if what == self.build and self.dice.random() < 0.5 else flow)
        except InputError as refusal:
            self.done.append(str(refusal))

    def check(self, flow):
        maps, budget, area, particles = flow.maps, flow.budget, 25.0, body(flow)
        still = ~np.any(particles.velocity, axis=0)
        # rounding of elevations of 75 m at some hundred nodes in some ten events
        size = 1e-10 * (1.0 + budget["released"])
        assert float(maps[ERODED].sum()) * area == pytest.approx(budget["eroded"], abs=size), self.done
        lies = budget["deposited"] + float(particles.volume[still].sum())
        assert float(maps[DEPOSIT].sum()) * area == pytest.approx(lies, abs=size), self.done
        assert abs(budget["residual"]) < size, self.done
        reached, open_ = maps[ARRIVAL].values >= 0.0, self.grid.status_at_node.reshape(self.grid.shape) != 4
        for peak in PEAKS:
            assert not maps[peak].values[open_ & ~reached].any(), (peak, self.done)
        np.testing.assert_array_equal(maps["debris_flow__max_depth"].values > 0.01, reached)


@pytest.mark.parametrize("seed", range(8))
def test_maps_and_budget_agree(seed):
    player = Player(seed)
    for _ in range(12):
        player.move()
        for flow in player.flows:
            player.check(flow)
