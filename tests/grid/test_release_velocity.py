"""Ground that fails while it moves: the velocity is read with the release, checked, and 0 once taken."""

import numpy as np
import pytest
import xarray as xr
from numpy.testing import assert_allclose, assert_array_equal

from landlab_debrisflow import DebrisFlow, InputError
from validation.grids import COARSE, changed_fields, copy_fields, dry_block, inclined, place, release_slab

DEPTH, VX, VY = (f"debris_flow__release_{name}" for name in ("depth", "velocity_x", "velocity_y"))


def scene(velocity=(6.0, -2.0), soil=2.0, **keywords):
    """Return a slope with a slab that fails at a velocity over the map [m s-1]; None: without that field."""
    grid = inclined((20, 60), 5.0, 0.4, soil=soil, **keywords)
    depth = release_slab(grid, (60.0, 48.0), 16.0, 1.0)
    for name, component in zip((VX, VY), velocity, strict=True):
        if component is not None:
            grid.add_field(name, np.where(depth > 0.0, component, 0.0), at="node")
    return grid


@pytest.mark.parametrize("flow_law", ["one_phase", "two_phase"])
def test_all_particles_of_all_phases_begin_with_it_along_the_bed(flow_law):
    grid = scene()
    flow = place(DebrisFlow(grid, flow=flow_law, erosion="none", numerics=COARSE))
    p = flow.particles
    assert_allclose(p.velocity_x, 6.0, atol=1e-5)  # in 1e-9 s gravity and pressure do no more
    assert_allclose(p.velocity_y, -2.0, atol=1e-5)
    inner = (abs(p.x - 60.0) < 5.0) & (abs(p.y - 48.0) < 5.0)  # beside the walls of the scar the bed is steeper
    assert_allclose(p.velocity_z[inner], -0.4 * 6.0, atol=1e-5)
    for name in (DEPTH, VX, VY):
        assert not grid.at_node[name].any()
    assert_allclose(grid.at_node["debris_flow__max_speed"].max(), np.linalg.norm([6.0, 2.0, 2.4]), rtol=0.2)


def test_the_field_that_is_missing_is_zero():
    p = place(DebrisFlow(scene((None, 3.0)), erosion="none", numerics=COARSE)).particles
    assert_allclose(p.velocity_x, 0.0, atol=1e-7)
    assert_allclose(p.velocity_y, 3.0, atol=1e-7)


def test_momentum_of_uneven_velocity_and_depth_is_kept():
    grid, generator = scene((None, None)), np.random.default_rng(1)
    depth = grid.at_node[DEPTH]
    depth *= generator.uniform(0.2, 1.0, depth.size)
    for name in (VX, VY):
        grid.add_field(name, np.where(depth > 0.0, generator.normal(0.0, 5.0, depth.size), 0.0), at="node")
    momentum = [float((depth * grid.at_node[name]).sum()) * 25.0 for name in (VX, VY)]
    p = place(DebrisFlow(grid, erosion="none", numerics=COARSE)).particles
    found = [float((p.volume * velocity).sum()) for velocity in (p.velocity_x, p.velocity_y)]
    assert_allclose(found, momentum, atol=1e-6 * float(p.volume.sum()))


def test_fields_of_zeros_change_nothing_to_the_bit():
    grids = scene((None, None)), scene((0.0, 0.0))
    flows = [DebrisFlow(grid, numerics=COARSE) for grid in grids]
    for flow in flows:
        flow.run_one_step(4.0)
    xr.testing.assert_identical(flows[0].particles, flows[1].particles)
    assert {VX, VY} == changed_fields(grids[1], copy_fields(grids[0]))


def test_a_body_that_friction_would_hold_is_not_arrested_before_it_has_slowed_down():
    grid = inclined((20, 120), 2.0, 0.0)
    depth = release_slab(grid, (40.0, 18.0), 8.0, 0.5, on_top=True)
    grid.add_field(VX, np.where(depth > 0.0, 8.0, 0.0), at="node")
    flow = DebrisFlow(grid, **dry_block(0.4, particle_count=60))
    assert flow.run_until_rest()
    stops = 8.0 / (0.4 * 9.81)
    assert 0.8 * stops < flow.elapsed_time < 2.0 * stops
    x = flow.particles.x
    assert_allclose(float(x.mean()), 40.0 + 8.0**2 / (2.0 * 0.4 * 9.81), rtol=0.05)


def test_a_second_release_with_velocity_joins_a_moving_flow():
    grid = scene((0.0, 0.0))
    flow = DebrisFlow(grid, erosion="none", numerics=COARSE)
    flow.run_one_step(5.0)
    before = flow.particles
    momentum = float((before.volume * before.velocity_y).sum())
    depth = release_slab(grid, (200.0, 48.0), 12.0, 1.0)
    grid.at_node[VY][depth > 0.0] = 4.0
    released = float(depth.sum()) * 25.0
    place(flow)
    p = flow.particles
    assert_allclose(float((p.volume * p.velocity_y).sum()), momentum + 4.0 * released, rtol=1e-6)
    assert abs(flow.budget["residual"]) < 1e-12 * flow.budget["released"]


def test_a_call_that_is_undone_leaves_it():
    grid = scene()
    flow = DebrisFlow(grid, numerics=COARSE)
    before = copy_fields(grid)
    flow._simulation.phases.after_summation = lambda *_: 1 / 0
    with pytest.raises(ZeroDivisionError):
        flow.run_one_step(1.0)
    assert not changed_fields(grid, before)


@pytest.mark.parametrize(
    ("where", "value", "message"),
    [
        ("released", np.nan, r"velocity_x must be finite, in m/s, got nan at node \d+ \(row \d+, column \d+\); set 0"),
        ("released", -np.inf, "velocity_x must be finite, in m/s, got -inf at node"),
        ("released", -9999.0, r"got -9999 at node .* -9999 marks missing data, at 1 nodes: grid.at_node"),
        ("elsewhere", np.nan, "velocity_x must be finite, in m/s, got nan at node"),
        ("elsewhere", 3.0, r"velocity_x is 3 m/s at node .*, the first of 1 nodes where nothing fails; set it to 0"),
    ],
)
def test_what_is_refused(where, value, message):
    grid = scene()
    nodes = np.flatnonzero((grid.at_node[DEPTH] > 0.0) == (where == "released"))
    grid.at_node[VX][nodes[nodes.size // 2]] = value
    before = copy_fields(grid)
    flow = DebrisFlow(grid, numerics=COARSE)
    fields = copy_fields(grid)
    with pytest.raises(InputError, match=message):
        flow.run_one_step(1.0)
    assert not changed_fields(grid, fields) and set(before) < set(fields)


def test_closed_nodes_may_hold_anything():
    grid = scene()
    grid.status_at_node[700] = grid.BC_NODE_IS_CLOSED
    grid.at_node[VX][700] = np.nan
    place(DebrisFlow(grid, numerics=COARSE))


def test_the_dtype_is_checked():
    grid = scene((None, None))
    grid.add_field(VX, np.zeros(1200, int), at="node")
    with pytest.raises(InputError, match=r"debris_flow__release_velocity_x must have the dtype float64, got int64"):
        DebrisFlow(grid)


def test_speeds_of_no_landslide_are_doubted_once(caplog):
    grid = scene((120.0, 0.0))
    flow = place(DebrisFlow(grid, numerics=COARSE))
    release_slab(grid, (60.0, 48.0), 16.0, 0.5)
    grid.at_node[VX][:] = np.where(grid.at_node[DEPTH] > 0.0, 150.0, 0.0)
    place(flow)
    doubts = [message for message in caplog.messages if "when it fails" in message]
    assert doubts == [
        "a release moves at 120 m/s when it fails, faster than any landslide: was the velocity meant in km/h or cm/s? "
        "It is in m/s"
    ]


def test_soil_that_fails_by_its_mass_wasting_id_may_move(caplog):
    grid = scene((5.0, 0.0))
    grid.add_field("mass__wasting_id", (grid.at_node[DEPTH] > 0.0).astype(int), at="node")
    grid.at_node[DEPTH][:] = 0.0
    flow = place(DebrisFlow(grid, erosion="none", numerics=COARSE))
    assert_allclose(flow.particles.velocity_x, 5.0, atol=1e-7)
    assert_array_equal(grid.at_node[VX], 0.0)
