"""Choices that are no physics: they must not change the answer beyond their accuracy."""

import itertools
import math

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow, Numerics, ParameterError
from landlab_debrisflow.model.peak_maps import PeakMaps
from landlab_debrisflow.scene.setup import Setup
from validation.grids import COARSE, copy_fields, dry_block, inclined, release_cap


def test_the_number_of_particles():
    assert Numerics().count_for(123.0) == Numerics.DEFAULT_COUNT
    assert Numerics(particle_count=7).count_for(123.0) == 7
    assert Numerics(particle_spacing=2.0).count_for(400.0) == 100
    assert Numerics(particle_spacing=100.0).count_for(1.0) == 1
    with pytest.raises(ParameterError, match="not both"):
        Numerics(particle_count=7, particle_spacing=1.0)


@pytest.mark.slow
def test_threads_change_nothing(valley):
    start = copy_fields(valley)
    ends = []
    for threads in (1, 2, 1, 2):
        for name, values in start.items():
            valley.at_node[name][:] = values
        for name in set(valley.at_node) - set(start):
            valley.delete_field("node", name)
        flow = DebrisFlow(valley, numerics={"particle_count": 300, "threads": threads})
        flow.run_until_rest()
        ends.append((copy_fields(valley), flow.budget, flow.elapsed_time))
    for other in ends[1:]:
        assert ends[0][1:] == other[1:]
        for name, values in ends[0][0].items():
            np.testing.assert_array_equal(values, other[0][name], name)


def test_presets_fill_in_what_is_not_given():
    standard, fast, fastest = (Numerics(preset=name) for name in ("standard", "fast", "fastest"))
    assert standard == Numerics()
    assert (standard.courant_number, standard.advective_courant_number, standard.rest_energy) == (0.6, 0.5, 1e-4)
    assert (fast.courant_number, fast.advective_courant_number, fast.rest_energy) == (1.0, 1.0, 1e-4)
    assert (fastest.courant_number, fastest.advective_courant_number, fastest.rest_energy) == (1.0, 1.0, 1e-3)
    mixed = Numerics(preset="fast", rest_energy=1e-2)
    assert mixed.courant_number == 1.0 and mixed.rest_energy == 1e-2
    assert Setup.from_mapping(Setup(numerics=mixed).to_mapping()).numerics == mixed


@pytest.mark.parametrize(
    ("depth", "advective", "nodes", "roughness"),
    [
        (1.0, 0.5, 0.95, 0.0), (0.05, 0.5, 0.95, 0.0), (0.05, 0.25, 0.475, 0.0), (0.05, 1.0, 1.0, 0.0),
        (1.0, 2.0, 2.0, 0.0), (0.05, 0.5, 0.5, 0.5),
    ],
)  # fmt: skip
def test_no_step_jumps_over_the_terrain(monkeypatch, depth, advective, nodes, roughness):
    """Not even the first, from rest: a thin body has slow waves, and the Courant condition lets it fall far.

    A plane is even ground; rough ground is not.
    """
    grid = inclined((25, 60), 5.0, math.tan(math.radians(35.0)))
    grid.at_node["topographic__elevation"] += roughness * np.random.default_rng(1).uniform(-1.0, 1.0, grid.size("node"))
    release_cap(grid, (60.0, 60.0), (30.0, 30.0), depth, on_top=True)
    flow = DebrisFlow(
        grid, **dry_block(0.2, particle_count=100, advective_courant_number=advective, courant_number=1.0)
    )
    steps, is_due = [], PeakMaps.is_due

    def watch(self, *arguments):
        p = flow._simulation.particles
        steps.append((p.x.copy(), p.y.copy()))
        return is_due(self, *arguments)

    monkeypatch.setattr(PeakMaps, "is_due", watch)
    flow.run_one_step(5.0)
    longest = max(np.hypot(*np.subtract(b, a)).max() for a, b in itertools.pairwise(steps))
    # with what gravity and thrust may add on the way
    assert 0.5 * nodes * 5.0 < longest <= nodes * 5.0


@pytest.mark.slow
def test_shorter_steps_change_little(valley):
    start = copy_fields(valley)
    centres = []
    for courant_number in (0.6, 0.15):
        for name in set(valley.at_node) - set(start):
            valley.delete_field("node", name)
        for name, values in start.items():
            valley.at_node[name][:] = values
        flow = DebrisFlow(valley, numerics=COARSE | {"courant_number": courant_number})
        flow.run_until_rest()
        deposit = valley.at_node["debris_flow__deposit_depth"]
        centres.append((deposit * valley.x_of_node).sum() / deposit.sum())
    # of 260 m of travel; measured .21 m: with the default a step crosses up to half a node
    assert abs(centres[0] - centres[1]) < 0.4
