"""The life of an event (docs/theory.md#event)."""

import logging

import numpy as np
import pytest
from landlab import RasterModelGrid

from landlab_debrisflow import DebrisFlow, InputError
from validation.grids import COARSE, changed_fields, copy_fields, inclined, place, release_slab

RELEASE, Z, SOIL = "debris_flow__release_depth", "topographic__elevation", "soil__depth"


@pytest.mark.slow
def test_a_grid_of_zeros_is_enough(caplog):
    grid = RasterModelGrid((10, 10))
    grid.add_zeros(Z, at="node")
    flow = DebrisFlow(grid)
    assert {name for name, entry in flow._info.items() if not entry["optional"]} <= set(grid.at_node)
    with caplog.at_level(logging.WARNING):
        flow.run_one_step(1.0)
        assert flow.run_until_rest() is True
    assert [record.getMessage()[:13] for record in caplog.records] == ["nothing to do"]  # said once, not twice
    assert not grid.at_node[Z].any() and not any(flow.budget.values())
    assert np.all(grid.at_node["debris_flow__arrival_time"] == -1.0)


def test_what_fails_is_taken_from_the_ground(slope):
    before, release = copy_fields(slope), slope.at_node[RELEASE].copy()
    flow = place(DebrisFlow(slope, numerics=COARSE | {"settle": False}))
    at = slope.at_node
    assert not at[RELEASE].any()
    np.testing.assert_array_equal(at[Z], before[Z] - release - at["debris_flow__eroded_depth"])
    np.testing.assert_array_equal(at[SOIL], before[SOIL] - release - at["debris_flow__eroded_depth"])
    assert flow.budget["released"] == flow.budget["moving"] == 225.0  # nine nodes of 25 m2
    # moving mass shows only in the depth
    assert at["debris_flow__depth"].sum() * 25.0 == pytest.approx(225.0, rel=1e-13)  # round-off


@pytest.mark.slow
def test_a_step_advances_exactly_as_long_as_asked(slope):
    flow = DebrisFlow(slope, numerics=COARSE)
    for dt in (3.7, 1e-6, 2, np.float32(0.5), np.int64(1)):
        before = flow.elapsed_time
        flow.run_one_step(dt=dt)
        assert flow.elapsed_time == before + float(dt)  # not one ulp aside


@pytest.mark.slow
def test_no_time_is_no_change(slope):
    flow = DebrisFlow(slope, numerics=COARSE)
    for _ in range(2):  # before the release is taken, and with mass on its way
        before, particles = copy_fields(slope), flow.particles
        flow.run_one_step(0)
        assert flow.run_until_rest(0.0) == flow.at_rest
        assert not changed_fields(slope, before) and flow.particles.identical(particles)
        flow.run_one_step(2.0)


@pytest.mark.slow
def test_an_event_that_ends_is_laid_into_the_terrain(valley):
    before = copy_fields(valley)
    flow = DebrisFlow(valley, numerics=COARSE)
    assert flow.run_until_rest() is True and flow.at_rest
    at = valley.at_node
    assert flow.particles.sizes["particle"] == 0 and not at["debris_flow__depth"].any()
    assert not at["debris_flow__speed"].any()
    rise = at[Z] - before[Z]
    # elevations of 75 m: their last digit is 1.4e-14 m
    np.testing.assert_allclose(rise, at[SOIL] - before[SOIL], rtol=0, atol=1e-13)
    np.testing.assert_allclose(
        rise, at["debris_flow__deposit_depth"] - before[RELEASE] - at["debris_flow__eroded_depth"], rtol=0, atol=1e-13
    )
    assert np.all(at[SOIL] >= 0.0)
    rim = valley.status_at_node != valley.BC_NODE_IS_CORE
    np.testing.assert_array_equal(at[Z][rim], before[Z][rim])
    assert flow.budget["deposited"] > 225.0 and flow.budget["eroded"] > 50.0  # it grew on the way
    where = at["debris_flow__deposit_depth"].argmax()
    assert valley.x_of_node[where] > 120.0  # and came to rest beyond the foot of the slope, at 150 m


@pytest.mark.slow
def test_time_after_rest_only_passes(valley):
    flow = DebrisFlow(valley, numerics=COARSE)
    flow.run_until_rest()
    before, now = copy_fields(valley), flow.elapsed_time
    flow.run_one_step(1e9)
    assert not changed_fields(valley, before) and flow.elapsed_time == now + 1e9
    assert flow.run_until_rest() is True and flow.elapsed_time == now + 1e9


def test_what_is_not_settled_waits(valley):
    flow = DebrisFlow(valley, numerics=COARSE | {"settle": False})
    assert flow.run_until_rest() is True
    at, moving = valley.at_node, flow.budget["moving"]
    assert flow.budget["deposited"] == 0.0 and moving > 225.0 and flow.particles.sizes["particle"] == 100
    # it lies there, still on top of the bare bed
    assert at["debris_flow__deposit_depth"].sum() * 25.0 == pytest.approx(moving, rel=1e-13)  # round-off
    bed, pressure = at[Z].copy(), flow.columns.excess_pore_pressure.values
    flow.run_one_step(1e4)
    assert np.array_equal(at[Z], bed)
    # its columns consolidate: c_v t/h^2 = 4 for a metre
    assert np.all(flow.columns.excess_pore_pressure.values[:, 0] < 0.2 * pressure[:, 0])
    deposit = at["debris_flow__deposit_depth"].copy()
    flow.settle()
    assert flow.budget["deposited"] == pytest.approx(moving, rel=1e-13) and flow.budget["moving"] == 0.0
    np.testing.assert_allclose(at[Z] - bed, deposit, rtol=0, atol=1e-13)  # elevations of up to 75 m
    before = copy_fields(valley)
    flow.settle()  # again: nothing
    assert not changed_fields(valley, before)


@pytest.mark.slow
def test_an_event_cut_short_settles_nothing_and_can_go_on(valley):
    flow = DebrisFlow(valley, numerics=COARSE)
    assert flow.run_until_rest(max_duration=3.0) is False
    assert not flow.at_rest and flow.elapsed_time == 3.0
    assert flow.budget["deposited"] == 0.0 and flow.budget["moving"] > 0.0
    before = copy_fields(valley)
    with pytest.raises(InputError, match="still moves"):
        flow.settle()
    assert not changed_fields(valley, before)
    assert flow.run_until_rest() is True
    assert flow.budget["moving"] == 0.0 and flow.budget["deposited"] > 225.0


@pytest.mark.slow
def test_events_follow_each_other_on_one_grid(valley):
    flow, release = DebrisFlow(valley, numerics=COARSE), valley.at_node[RELEASE].copy()
    flow.run_until_rest()
    first, z, deposit = flow.budget, valley.at_node[Z].copy(), valley.at_node["debris_flow__deposit_depth"].copy()
    valley.at_node[SOIL] += 0.5  # another component made soil
    valley.at_node[RELEASE][:] = np.minimum(release, valley.at_node[SOIL])
    again = float(valley.at_node[RELEASE].sum() * 25.0)
    assert flow.run_until_rest() is True and again > 50.0
    assert flow.budget["released"] == pytest.approx(first["released"] + again, rel=1e-15)
    assert flow.budget["eroded"] > first["eroded"] and flow.budget["deposited"] > first["deposited"] + again
    assert np.all(valley.at_node["debris_flow__deposit_depth"] >= deposit)
    assert not np.array_equal(valley.at_node[Z], z)


def test_a_second_release_joins_what_moves(valley):
    flow = DebrisFlow(valley, numerics=COARSE | {"settle": False})
    flow.run_one_step(2.0)
    release_slab(valley, (60.0, 48.0), 8.0, 0.2)
    flow.run_one_step(1.0)
    # 45 m3 in particles as large as those that move, 2.25 m3 and little more
    assert flow.particles.sizes["particle"] == 120 and flow.budget["released"] == pytest.approx(270.0, rel=1e-15)


@pytest.mark.slow
def test_fields_are_written_in_place(valley):
    arrays = {name: valley.at_node[name] for name in (Z, SOIL, RELEASE)}
    flow = DebrisFlow(valley, numerics=COARSE)
    arrays |= {name: valley.at_node[name] for name in flow._info if name in valley.at_node}
    flow.run_until_rest()
    assert set(arrays) == set(valley.at_node)
    for name, array in arrays.items():
        assert np.shares_memory(array, valley.at_node[name]) and array.ndim == 1, name


@pytest.mark.slow
def test_ten_short_steps_are_one_long_step(valley):
    long = DebrisFlow(valley, numerics=COARSE)
    long.run_one_step(10.0)
    other = inclined((20, 80), 5.0, 0.5, soil=1.0, foot=150.0)
    release_slab(other, (30.0, 48.0), 8.0, 1.0)
    short = DebrisFlow(other, numerics=COARSE)
    for _ in range(10):
        short.run_one_step(1.0)
    assert short.elapsed_time == long.elapsed_time == 10.0
    # only the lengths of the steps that reach a whole second differ: measured 3e-5 and 6 cm of 80 m
    assert short.budget["moving"] == pytest.approx(long.budget["moving"], rel=5e-4)
    assert float(short.particles.x.mean()) == pytest.approx(float(long.particles.x.mean()), abs=0.15)


@pytest.mark.slow
@pytest.mark.parametrize("spacing", [(5.0, 4.0), (4.0, 5.0)])
def test_the_spacing_may_differ_between_the_axes(spacing):
    grid = inclined((24, 60), spacing, 0.5, soil=1.0)
    release_slab(grid, (30.0, 48.0), 8.0, 1.0)
    z = grid.at_node[Z].copy()
    flow = DebrisFlow(grid, numerics=COARSE)
    released = float(grid.at_node[RELEASE].sum()) * 20.0
    flow.run_until_rest()
    budget = flow.budget
    assert budget["released"] == released
    assert (grid.at_node[Z] - z).sum() * 20.0 == pytest.approx(
        budget["deposited"] - budget["released"] - budget["eroded"],
        abs=1e-9,  # 1440 elevations of 1e-14 m, 20 m2 each
    )


@pytest.mark.slow
def test_where_the_grid_lies_does_not_matter(slope):
    far = inclined((20, 60), 5.0, 0.5, soil=1.0, xy_of_lower_left=(5e5, 4e6))
    release_slab(far, (5e5 + 30.0, 4e6 + 48.0), 8.0, 1.0)
    flows = [DebrisFlow(grid, numerics=COARSE) for grid in (slope, far)]
    for flow in flows:
        flow.run_one_step(5.0)
    for name in slope.at_node:
        np.testing.assert_array_equal(slope.at_node[name], far.at_node[name], name)
    np.testing.assert_array_equal(flows[0].particles.x + 5e5, flows[1].particles.x)


@pytest.mark.slow
def test_a_mass_wasting_id_fails_with_all_its_soil(slope):
    release = slope.at_node[RELEASE].copy()
    slope.at_node[RELEASE][:] = 0.0
    ids = slope.add_zeros("mass__wasting_id", at="node", dtype=int)
    ids[release > 0.0] = 7
    slope.at_node[SOIL][:] = 0.8
    flow = place(DebrisFlow(slope, numerics=COARSE | {"settle": False}))
    assert flow.budget["released"] == pytest.approx(0.8 * 225.0, rel=1e-15)
    assert not ids.any()  # taken, not to fail again
    assert not slope.at_node[SOIL][release > 0.0].any()


@pytest.mark.slow
def test_without_soil_nothing_erodes_and_a_release_needs_none():
    grid = inclined((20, 60), 5.0, 0.5)
    release_slab(grid, (30.0, 48.0), 8.0, 5.0)
    flow = DebrisFlow(grid, numerics=COARSE)
    flow.run_until_rest()
    assert flow.budget["eroded"] == 0.0 and flow.budget["released"] == 1125.0
    assert SOIL not in grid.at_node


@pytest.mark.slow
def test_without_consolidation_the_peclet_number_is_infinite_where_it_erodes(valley):
    flow = DebrisFlow(valley, numerics=COARSE, material={"coefficient_of_consolidation": 0.0})
    flow.run_one_step(5.0)
    peclet, eroded = (valley.at_node[f"debris_flow__{name}"] for name in ("max_basal_peclet_number", "eroded_depth"))
    assert np.all(np.isinf(peclet[eroded > 1e-3]))
    assert not np.any(np.isnan(peclet))


@pytest.mark.slow
def test_settling_takes_no_new_release(valley):
    flow = DebrisFlow(valley, numerics=COARSE | {"settle": False})
    assert flow.run_until_rest()
    release_slab(valley, (60.0, 50.0), 8.0, 0.2)
    waiting = valley.at_node["debris_flow__release_depth"].copy()
    moving = flow.budget["moving"]
    flow.settle()
    np.testing.assert_array_equal(valley.at_node["debris_flow__release_depth"], waiting)
    assert flow.budget["deposited"] == pytest.approx(moving, rel=1e-12)  # round-off of the elevations


@pytest.mark.slow
def test_settling_nothing_changes_nothing(valley):
    valley.at_node["debris_flow__release_depth"][:] = 0.0
    flow = DebrisFlow(valley, numerics=COARSE)
    before = copy_fields(valley)
    flow.settle()
    assert not changed_fields(valley, before)
