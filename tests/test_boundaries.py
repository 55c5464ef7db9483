"""Open, closed and NODATA nodes: who leaves, who stays, and what is never read (docs/theory.md#boundaries)."""

import logging

import numpy as np
import pytest
from landlab import RasterModelGrid

from landlab_debrisflow import DebrisFlow
from validation.grids import COARSE, copy_fields, dry_block, inclined, place, release_slab

Z, SOIL = "topographic__elevation", "soil__depth"


@pytest.mark.slow
@pytest.mark.parametrize(("edge", "fall"), [("east", (-1, 0)), ("west", (1, 0)), ("north", (0, -1)), ("south", (0, 1))])
def test_what_leaves_is_counted_by_edge(edge, fall):
    grid = RasterModelGrid((30, 30), xy_spacing=5.0)
    z = grid.add_field(Z, 100.0 + 0.7 * (fall[0] * grid.x_of_node + fall[1] * grid.y_of_node), at="node")
    release_slab(grid, (72.5, 72.5), 10.0, 0.5)
    before = z.copy()
    flow = DebrisFlow(grid, friction={"law": "coulomb", "basal_friction_angle": 10.0}, numerics=COARSE)
    assert flow.run_until_rest() is True
    left = flow.outflow_by_edge
    assert set(left) == {"west", "east", "south", "north", "inside"}
    assert left[edge] == flow.budget["outflow"] == pytest.approx(flow.budget["released"], rel=1e-13)
    rim = grid.status_at_node != grid.BC_NODE_IS_CORE
    np.testing.assert_array_equal(z[rim], before[rim])


@pytest.mark.slow
def test_an_open_node_inside_is_a_sink(valley):
    sink = np.flatnonzero((valley.x_of_node == 175.0) & (abs(valley.y_of_node - 47.5) < 30.0))
    valley.status_at_node[sink] = valley.BC_NODE_IS_FIXED_VALUE
    before = valley.at_node[Z].copy()
    flow = DebrisFlow(valley, numerics=COARSE)
    flow.run_until_rest()
    assert flow.outflow_by_edge["inside"] > 10.0
    np.testing.assert_array_equal(valley.at_node[Z][sink], before[sink])
    beyond = valley.x_of_node > 190.0  # particles jump no node: a quarter of a spacing a step
    assert not valley.at_node["debris_flow__max_depth"][beyond].any()


@pytest.mark.slow
def test_closed_walls_hold_and_say_so(slope, caplog):
    slope.set_closed_boundaries_at_grid_edges(True, True, True, True)
    before = copy_fields(slope)
    flow = DebrisFlow(slope, numerics=COARSE)
    with caplog.at_level(logging.WARNING, "landlab_debrisflow"):
        assert flow.run_until_rest() is True
    # a body pressed against a wall comes to rest like any other (here after 23 s), and does not erode there
    assert flow.elapsed_time < 60.0 and flow.budget["eroded"] < 340.0
    assert flow.budget["outflow"] == 0.0 and not any(flow.outflow_by_edge.values())
    warnings = [record.getMessage() for record in caplog.records]
    assert len(warnings) == 1 and "m3 ran against closed or NODATA nodes" in warnings[0]
    assert 0.0 < float(warnings[0].split()[0]) <= 1.005 * flow.budget["deposited"]  # printed with three digits
    closed = slope.status_at_node == slope.BC_NODE_IS_CLOSED
    for name in (Z, SOIL):
        np.testing.assert_array_equal(slope.at_node[name][closed], before[name][closed])
    # all lies at the lower wall
    deposit = slope.at_node["debris_flow__deposit_depth"]
    assert (deposit * slope.x_of_node).sum() / deposit.sum() > 250.0


@pytest.mark.slow
def test_nodata_in_the_way_says_so_and_an_open_edge_does_not(caplog):
    grid = inclined((20, 40), 5.0, 0.5)
    release_slab(grid, (30.0, 48.0), 8.0, 1.0)
    hole = (abs(grid.x_of_node - 100.0) < 8.0) & (abs(grid.y_of_node - 48.0) < 20.0)
    for nodata in (False, True):
        if nodata:
            grid.at_node[Z][hole] = -9999.0
            grid.set_nodata_nodes_to_closed(grid.at_node[Z], -9999.0)
            release_slab(grid, (30.0, 48.0), 8.0, 1.0)
        flow = DebrisFlow(grid, numerics=COARSE)
        with caplog.at_level(logging.WARNING, "landlab_debrisflow"):
            flow.run_until_rest()
        messages = [m for m in caplog.messages if "ran against closed or NODATA nodes" in m]
        assert len(messages) == nodata
    assert float(messages[0].split()[0]) > 50.0  # most of 225 m3 lay in its way


@pytest.mark.slow
@pytest.mark.parametrize("value", [1e30, np.nan])
def test_values_of_nodata_nodes_are_never_read(value):
    results = []
    for nodata in (-9999.0, value):
        grid = inclined((20, 60), 5.0, 0.5, soil=1.0, foot=150.0)
        hole = (abs(grid.x_of_node - 100.0) < 8.0) & (abs(grid.y_of_node - 60.0) < 8.0) | (grid.y_of_node < 30.0)
        grid.at_node[Z][hole] = -9999.0
        grid.set_nodata_nodes_to_closed(grid.at_node[Z], -9999.0)
        grid.at_node[Z][hole] = grid.at_node[SOIL][hole] = nodata
        release_slab(grid, (30.0, 48.0), 8.0, 1.0)
        flow = DebrisFlow(grid, numerics=COARSE)
        assert flow.run_until_rest() is True
        np.testing.assert_array_equal(grid.at_node[Z][hole], nodata)
        results.append(({name: grid.at_node[name][~hole] for name in grid.at_node}, flow.budget))
    assert results[0][1] == results[1][1]
    for name, values in results[0][0].items():
        np.testing.assert_array_equal(values, results[1][0][name], name)


@pytest.mark.slow
def test_statuses_may_change_between_calls(slope):
    flow = DebrisFlow(slope, numerics=COARSE)
    flow.run_one_step(2.0)
    slope.set_closed_boundaries_at_grid_edges(True, True, True, True)
    flow.run_until_rest()
    assert flow.budget["outflow"] == 0.0 and flow.budget["deposited"] > 225.0


@pytest.mark.slow
def test_terrain_changed_by_others_is_read_at_each_call(slope):
    flow = place(DebrisFlow(slope, numerics=COARSE | {"settle": False}))
    slope.at_node[Z][:] = 0.5 * (295.0 - slope.x_of_node[::-1])  # now it falls towards the west
    flow.run_one_step(3.0)
    assert np.all(flow.particles.velocity_x < 0.0)


def test_a_neighbour_that_leaves_wakes_those_asleep():
    """What lies still is not summed again, unless what it was summed over has gone."""
    grid = inclined((12, 12), 5.0, 0.0)
    release_slab(grid, (45.0, 30.0), 8.0, 1.0, on_top=True)
    flow = place(DebrisFlow(grid, **dry_block(0.6, particle_count=100)))
    sim = flow._simulation
    p = sim.particles
    p.x += 52.4 - p.x.max()  # the open nodes take over at 52.5 m
    p.velocity[:] = 0.0
    p.velocity[0, np.argmax(p.x)] = 30.0
    sim._refresh(8)
    p.still_steps[:] = 1000
    sim.set_free()
    sim.advance(0.01)
    assert p.count == 99 and sim.state.outflow.total
    after = p.thickness.copy()
    p.still_steps[:] = 0
    sim._refresh(8)
    # a neighbour is worth some 10 % of the thickness beside it; the Newton step of one time step leaves 1 %
    np.testing.assert_allclose(after, p.thickness, rtol=0.03)
