"""The work of a step is that of the flow, whatever the raster around it."""

import tracemalloc

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.grid.fields import OUTPUT_PREFIX
from validation.rasters import raster, touched_by, valley

SHIFT = 6
SCENE = {"spacing": 4.0, "foot": 38, "axis": 38, "top": 35, "radius": 6.0, "particles": 150}
"""All of it lies between 128 and 256 m from the lower left node, shifted or not: floats are as dense there, so that
both runs round alike and must be equal to the last bit."""


@pytest.fixture(scope="module")
def runs():
    flows = valley(nodes=60, offset=0, **SCENE), valley(nodes=240, offset=SHIFT, **SCENE)
    return flows, [touched_by(flow) for flow in flows]


@pytest.mark.slow
def test_the_same_nodes_are_touched_in_every_step(runs):
    _, (small, large) = runs
    assert len(small.eroded) > 50 and max(small.eroded) > 0 and max(small.shown) > 0
    assert small.eroded == large.eroded
    assert small.shown == large.shown


def test_what_is_touched_is_a_small_part(runs):
    _, (_, large) = runs
    assert max(large.eroded) < 200 and max(large.shown) < 400  # of 57 600


def test_results_are_equal_to_the_last_bit(runs):
    (small, large), _ = runs
    for name in small.grid.at_node:
        if name.startswith(OUTPUT_PREFIX) or name in ("topographic__elevation", "soil__depth"):
            part = large.grid.at_node[name].reshape(large.grid.shape)[SHIFT : SHIFT + 60, SHIFT : SHIFT + 60]
            assert np.array_equal(small.grid.at_node[name].reshape(60, 60), part), name


@pytest.mark.slow
def test_nothing_else_changes(runs):
    (_, large), _ = runs
    outside = np.ones(large.grid.shape, bool)
    outside[SHIFT : SHIFT + 60, SHIFT : SHIFT + 60] = False
    fresh = valley(nodes=240, offset=SHIFT, **SCENE).grid
    for name in fresh.at_node:
        now, before = (grid.at_node[name].reshape(grid.shape)[outside] for grid in (large.grid, fresh))
        assert np.array_equal(now, before), name


BESIDES = 2 * 8.0 + 2 * 8.0 + 8.0 + 4.0 + 1.0
"""Bytes per node that a component may hold besides its fields: depths eroded and settled in all calls, elevation as the
last call left it and as the surface it interpolates, depth eroded in the event, slot of a node, its status."""


def memory_besides_fields(nodes):
    """Return the memory of a component besides the fields that it adds, after a call [B]."""
    scene = {name: value for name, value in SCENE.items() if name != "particles"}
    grid = raster(nodes=nodes, offset=SHIFT, **scene)
    before, _ = set(grid.at_node), grid.core_nodes  # which a fixture of all tests reads, and Landlab keeps
    tracemalloc.start()
    try:
        flow = DebrisFlow(grid, numerics={"particle_count": 40})
        flow.run_one_step(2.0)
        assert flow.budget["eroded"] > 0.0
        return tracemalloc.get_traced_memory()[0] - sum(grid.at_node[n].nbytes for n in set(grid.at_node) - before)
    finally:
        tracemalloc.stop()


@pytest.mark.slow
def test_memory_besides_the_fields_is_that_of_the_flow():
    memory_besides_fields(60)  # loads what the first call loads
    small, large = memory_besides_fields(300), memory_besides_fields(600)
    # of rows that the flow passes, values are kept in case of an error: some 25 rows of 17 arrays, 4 B per node here
    assert (large - small) / (600.0**2 - 300.0**2) < BESIDES + 5.0
