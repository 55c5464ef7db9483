"""Copies of grids: nothing of the original changes; every second node keeps volumes, places and the ground."""

import numpy as np
import pytest

from landlab_debrisflow import InputError
from landlab_debrisflow.fidelity.grids import coarse_grid, copy_grid, every_second, write_release

from .valleys import fields, flow_on, valley


@pytest.mark.parametrize("shape", [(5, 5), (6, 9), (7, 8), (10, 10)])
def test_sums_and_centres_stay(shape):
    values = np.zeros(shape)
    values[2:-3, 2:-3] = np.random.default_rng(3).random((shape[0] - 5, shape[1] - 5))
    values[2, 2] = 1.0
    coarse = every_second(values)
    assert coarse.sum() * 4.0 == pytest.approx(values.sum(), rel=1e-14)
    for axis in (0, 1):
        before = np.arange(shape[axis]) @ values.sum(axis=1 - axis) / values.sum()
        after = 2.0 * np.arange(coarse.shape[axis]) @ coarse.sum(axis=1 - axis) / coarse.sum()
        assert after == pytest.approx(before, rel=1e-12)
    assert every_second(np.ones(shape)).sum() * 4.0 == pytest.approx(np.prod(shape))


@pytest.mark.parametrize("shape", [(15, 30), pytest.param((16, 31), marks=pytest.mark.slow)])
def test_a_coarse_grid_has_the_release_on_the_same_ground(shape):
    grid = valley(shape)
    grid.status_at_node[grid.nodes_at_top_edge] = 4
    before = fields(grid)
    coarse = coarse_grid(grid)
    assert all(np.array_equal(before[name], grid.at_node[name]) for name in before)
    assert coarse.shape == tuple((n + 1) // 2 for n in shape) and (coarse.dx, coarse.dy) == (10.0, 10.0)
    assert tuple(coarse.xy_of_lower_left) == (1000.0, 2000.0)
    at, depth = coarse.at_node, coarse.at_node["debris_flow__release_depth"]
    assert depth.sum() * 100.0 == pytest.approx(grid.at_node["debris_flow__release_depth"].sum() * 25.0, rel=1e-13)
    assert np.average(coarse.x_of_node, weights=depth) == pytest.approx(1030.0)
    assert not depth[coarse.boundary_nodes].any()
    bed = (grid.at_node["topographic__elevation"] - grid.at_node["debris_flow__release_depth"]).reshape(shape)
    assert at["topographic__elevation"] - depth == pytest.approx(bed[::2, ::2].ravel(), abs=1e-12)
    assert np.all(at["soil__depth"] >= depth)
    status = np.array(coarse.status_at_node).reshape(coarse.shape)
    assert np.all(status[-1] == 4) and np.all(status[1:-1, -1] == 1) and np.all(status[1:-1, 1:-1] == 0)


@pytest.mark.slow
def test_momentum_stays_with_the_release():
    grid = valley()
    depth = grid.at_node["debris_flow__release_depth"]
    grid.add_field("debris_flow__release_velocity_x", np.where(depth > 0.0, 3.0, 0.0), at="node")
    coarse = coarse_grid(grid)
    spread = coarse.at_node["debris_flow__release_depth"]
    assert coarse.at_node["debris_flow__release_velocity_x"] == pytest.approx(np.where(spread > 0.0, 3.0, 0.0))
    flow_on(coarse, numerics={"particle_count": 50}).run_one_step(0.1)  # the border takes it


@pytest.mark.slow
def test_every_second_node_of_few_or_of_closed_ones_is_refused():
    with pytest.raises(InputError, match="every second node of 4 x 30 nodes makes no grid"):
        coarse_grid(valley((4, 30), release=0.0))
    grid = valley((15, 30))
    failing = np.flatnonzero(grid.at_node["debris_flow__release_depth"])
    grid.status_at_node[np.setdiff1d(grid.core_nodes, failing[:1])] = 4
    grid.at_node["debris_flow__release_depth"][failing[1:]] = 0.0
    grid.status_at_node[failing[0]] = 0
    assert (failing[0] // 30 % 2, failing[0] % 30 % 2) != (0, 0)  # the node is none that stays
    with pytest.raises(InputError, match="stays where it may flow"):
        coarse_grid(grid)


@pytest.mark.slow
def test_ids_of_mass_wasting_become_depths():
    grid = valley()
    depth = grid.at_node["debris_flow__release_depth"]
    ids = grid.add_field("mass__wasting_id", (depth > 0.0).astype(int), at="node")
    expected = np.where(depth > 0.0, grid.at_node["soil__depth"], 0.0)
    depth[:] = 0.0
    copied = copy_grid(grid)
    write_release(copied)
    assert np.array_equal(copied.at_node["debris_flow__release_depth"], expected)
    assert not copied.at_node["mass__wasting_id"].any() and ids.any() and not depth.any()
    coarse = coarse_grid(grid)
    assert coarse.at_node["debris_flow__release_depth"].sum() * 4.0 == pytest.approx(expected.sum())


@pytest.mark.slow
def test_outputs_of_a_component_are_not_copied():
    grid = valley()
    flow_on(grid, numerics={"particle_count": 20}).run_one_step(0.2)
    copied = copy_grid(grid)
    assert "debris_flow__max_depth" not in copied.at_node and "soil__depth" in copied.at_node
