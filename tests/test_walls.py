"""Closed nodes are walls without a gap, of any shape, at any speed and for any length of call."""

import numpy as np
import pytest
from landlab import RasterModelGrid

from landlab_debrisflow import DebrisFlow
from validation.grids import dry_block, place, release_slab, throw

SPACING, SLOPE, SPEED = 5.0, 0.5, 30.0

# shape: the closed nodes by column and row, and which nodes lie beyond
WALLS = {
    "straight": (lambda c, r: c == 22, lambda c, r: c > 22),
    "diagonal, one node thick": (lambda c, r: c + r == 42, lambda c, r: c + r > 42),
    "antidiagonal": (lambda c, r: c - r == 7, lambda c, r: c - r > 7),
    "corner pocket": (
        lambda c, r: (c == 22) & (abs(r - 16) < 9) | (abs(r - 16) == 9) & (c > 10) & (c < 23),
        lambda c, r: (c > 22) | (abs(r - 16) > 9),
    ),
}


def thrown(wall, towards, slope=SLOPE, **numerics):
    """Throw 100 particles at a wall; they cross a quarter of a node spacing in a step, however long the call."""
    grid = RasterModelGrid((32, 36), xy_spacing=SPACING)
    row, column = np.divmod(np.arange(grid.number_of_nodes), 36)
    towards = np.array(towards) / np.hypot(*towards)
    along = towards[0] * grid.x_of_node + towards[1] * grid.y_of_node
    grid.add_field("topographic__elevation", 300.0 - slope * along, at="node")
    grid.status_at_node[wall(column, row)] = grid.BC_NODE_IS_CLOSED
    release_slab(grid, (75.0, 80.0), 13.0, 1.5, on_top=True)
    flow = place(DebrisFlow(grid, **dry_block(0.2, particle_count=100, **numerics)))
    throw(flow, SPEED * np.array([*towards, -slope]))
    return flow


def nearest(flow):
    x, y = flow.particles.x.values, flow.particles.y.values
    return np.floor(x / SPACING + 0.5).astype(int), np.floor(y / SPACING + 0.5).astype(int)


@pytest.mark.slow
@pytest.mark.parametrize("step", [0.03, 0.7, 3.0])
@pytest.mark.parametrize("shape", WALLS)
def test_nothing_gets_into_a_wall_or_through(shape, step):
    wall, beyond = WALLS[shape]
    flow = thrown(wall, {"diagonal, one node thick": (1, 1), "antidiagonal": (1, -1)}.get(shape, (1, 0)))
    for _ in range(int(3.0 / step)):
        flow.run_one_step(step)
        column, row = nearest(flow)
        assert not np.any(wall(column, row)) and not np.any(beyond(column, row))
    assert flow.budget["outflow"] == 0.0 or shape == "straight"  # round its ends some get to the open edges
    assert flow.budget["outflow"] + flow.budget["moving"] == pytest.approx(flow.budget["released"], rel=1e-14)
    stopped = np.hypot(flow.particles.velocity_x, flow.particles.velocity_y).values
    assert stopped.mean() < 0.3 * SPEED  # they ran against it, with 30 m/s from 35 m away


@pytest.mark.slow
def test_a_long_shallow_run_along_a_diagonal_wall_does_not_leak():
    """Every node of the wall is passed, at every distance from its corner."""
    wall, beyond = WALLS["diagonal, one node thick"]
    flow = thrown(wall, (1, 0))
    flow.run_one_step(3.0)
    assert not np.any(beyond(*nearest(flow)))


@pytest.mark.slow
def test_a_channel_one_node_wide_lets_through_what_its_walls_do_not_stop():
    flow = thrown(lambda c, r: (r != 16) & (c > 18) & (c < 28), (1, 0))
    inside = False
    for _ in range(40):
        flow.run_one_step(0.1)
        column, row = nearest(flow)
        within = (column > 18) & (column < 28)
        inside |= bool(within.any())
        assert np.all(row[within] == 16)
    passed = flow.outflow_by_edge["east"] + float(flow.particles.volume[column > 27].sum())
    assert inside and passed > 10.0
    assert flow.budget["outflow"] + flow.budget["moving"] == pytest.approx(flow.budget["released"], rel=1e-14)


def test_what_lies_in_a_closed_basin_comes_to_rest_there():
    wall, beyond = WALLS["corner pocket"]
    flow = thrown(wall, (1, 0), slope=0.0)
    assert flow.run_until_rest(60.0) is True
    assert not np.any(beyond(*nearest(flow)))
