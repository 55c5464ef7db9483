"""A release laid on top of the ground digs nothing, whatever lies or moves there."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from landlab_debrisflow import DebrisFlow, InputError
from landlab_debrisflow.scene import lay_on_top
from validation.grids import COARSE, changed_fields, copy_fields, dry_block, inclined, place, release, release_slab

DEPTH, Z, SOIL = "debris_flow__release_depth", "topographic__elevation", "soil__depth"
CALM = {"erosion": "none", "numerics": COARSE}


def slope(soil=None):
    return inclined((20, 60), 5.0, 0.4, soil=soil, foot=150.0)


def slab(grid, depth=1.5, centre=(60.0, 48.0), half=12.0):
    """Return the depth of a square slab, 20 nodes of the slope [m]."""
    return depth * (np.maximum(abs(grid.x_of_node - centre[0]), abs(grid.y_of_node - centre[1])) < half)


@pytest.mark.parametrize("soil", [None, 0.0, 2.0])
def test_the_ground_below_it_is_as_it_was_and_the_budget_closes(soil):
    grid = slope(soil)
    before = copy_fields(grid)
    lay_on_top(grid, slab(grid).reshape(grid.shape))
    assert_array_equal(grid.at_node[Z] - before[Z] > 0.0, slab(grid) > 0.0)
    flow = place(DebrisFlow(grid, **CALM))
    for name in before:
        assert_allclose(grid.at_node[name], before[name], atol=1e-13)
    assert not grid.at_node[DEPTH].any() and (soil is None) == (SOIL not in grid.at_node)
    flow.run_until_rest()
    budget = flow.budget
    assert budget["released"] == 1.5 * 20 * 25.0 and abs(budget["residual"]) < 1e-12 * budget["released"]
    rise = grid.at_node[Z] - before[Z]
    assert_allclose(rise.sum() * 25.0, budget["deposited"], rtol=1e-9)  # the terrain has lost nothing
    if soil is not None:
        assert_allclose(grid.at_node[SOIL] - soil, rise, atol=1e-9)  # the deposit is soil


def test_soil_below_it_erodes_and_the_mass_itself_is_none():
    grids = slope(0.05), slope(1.8)
    for grid in grids:
        lay_on_top(grid, slab(grid))
        DebrisFlow(grid, numerics=COARSE).run_one_step(6.0)
    eroded = [grid.at_node["debris_flow__eroded_depth"].max() for grid in grids]
    assert eroded[0] == pytest.approx(0.05, rel=1e-12) and eroded[1] > 0.06


def test_it_is_added_to_what_fails_there_from_the_ground_and_to_itself():
    grid = slope(1.0)
    ground = grid.at_node[Z].copy()
    release_slab(grid, (60.0, 48.0), 12.0, 1.0)  # as deep as the soil
    lay_on_top(grid, slab(grid, 0.25))
    lay_on_top(grid, slab(grid, 0.5))
    lay_on_top(grid, slab(grid, 0.5, (75.0, 48.0)))
    flow = place(DebrisFlow(grid, **CALM))
    assert_allclose(flow.budget["released"], (1.0 + 0.25 + 0.5 + 0.5) * 20 * 25.0, rtol=1e-14)
    assert_allclose(ground - grid.at_node[Z], slab(grid, 1.0), atol=1e-12)
    assert_allclose(grid.at_node[SOIL], 1.0 - slab(grid, 1.0), atol=1e-12)


def raise_and_dig(grid, depth):
    """Raise the ground by 1 m, of which only a half fails."""
    release(grid, depth, on_top=True)
    grid.at_node[DEPTH] *= 0.5


def raise_beside(grid, depth):
    """Let ground fail that is raised by no more, and raise one node elsewhere."""
    release(grid, depth, on_top=True)
    grid.at_node[Z][1300] += 0.1


@pytest.mark.parametrize(
    ("change", "freed"),
    [(lay_on_top, 0), (release, 0), (lambda *a: release(*a, on_top=True), 0), (raise_and_dig, 1), (raise_beside, 1)],
    ids=["laid on top", "from the ground", "by hand", "more than fails", "elsewhere"],
)
def test_it_frees_nothing_that_has_come_to_rest(change, freed):
    """Only ground that is higher than before once the release is off has changed: all is then free to move."""
    grid = inclined((20, 120), 2.0, 0.0)
    release_slab(grid, (40.0, 18.0), 8.0, 1.0, on_top=True)
    flow = DebrisFlow(grid, **dry_block(0.5, particle_count=60))
    assert flow.run_until_rest()
    calls = []
    flow._simulation.set_free = lambda: calls.append(1)
    change(grid, slab(grid, 1.0, (180.0, 18.0), 8.0))
    place(flow)
    assert len(calls) == freed


def test_mass_on_a_moving_flow_moves_nothing_of_it():
    grid = slope()
    lay_on_top(grid, slab(grid))
    flow = DebrisFlow(grid, **CALM)
    flow.run_one_step(4.0)
    p = flow._simulation.particles
    first = np.argsort(p.identity)
    before = {name: getattr(p, name)[..., first].copy() for name in ("x", "y", "z", "velocity", "lowest_z")}
    deepest = p.depth.max()
    second = slab(grid, 0.8, (p.x.mean(), p.y.mean()))
    lay_on_top(grid, second)
    place(flow)
    first = np.argsort(p.identity)[: first.size]
    for name, values in before.items():
        assert_allclose(getattr(p, name)[..., first], values, atol=1e-6, err_msg=name)
    assert p.depth[first].max() > deepest + 0.4  # the new mass lies on it
    assert flow.budget["released"] == pytest.approx(20 * 25.0 * 1.5 + 25.0 * second.sum())
    assert flow.run_until_rest()


@pytest.mark.parametrize(
    ("node", "value", "message"),
    [
        (610, -1.0, r"lay_on_top: depth must be >= 0 m, got -1 at node 610 \(row 10, column 10\)"),
        (610, np.nan, "lay_on_top: depth must be finite, got nan at node 610"),
        (0, 1.0, "lay_on_top: depth is 1 m on node 0 .*, a boundary or closed node; release only on core nodes"),
        (610, -9999.0, "-9999 marks missing data"),
    ],
)
def test_what_is_refused(node, value, message):
    grid = slope(2.0)
    depth = np.zeros(1200)
    depth[node] = value
    before = copy_fields(grid)
    with pytest.raises(InputError, match=message):
        lay_on_top(grid, depth)
    with pytest.raises(InputError, match="depth must have a value for each of 1200 nodes, got 3"):
        lay_on_top(grid, np.zeros(3))
    assert not changed_fields(grid, before)
