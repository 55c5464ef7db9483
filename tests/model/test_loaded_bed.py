"""A bed whose pore pressure follows what lies on it, under a flow."""

import math

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.core.errors import InputError
from validation.grids import changed_fields, copy_fields, inclined, release_slab

from ..twins import Failed, failing

FIELD = "bed__excess_pore_pressure"
SLOPE = 0.5
B = 0.3


def slope(loading=B, drainage_time=None, soil=1.0, foot=None, shape=(15, 40), **keywords):
    """Return a grid and a flow that runs down it, of 940 m3."""
    grid = inclined(shape, 5.0, SLOPE, soil=soil, foot=foot)
    release_slab(grid, (40.0, 2.5 * (shape[0] - 1)), 12.6, 1.5, on_top=True)
    material = {"bed_loading_coefficient": loading, "bed_drainage_time": drainage_time}
    numerics = {"particle_count": 100, "settle": False} | keywords.pop("numerics", {})
    return grid, DebrisFlow(grid, material=material, numerics=numerics, **keywords)


def load_of(flow):
    """Return rho g h cos^2(theta) from what lies on every node of the plane [Pa]."""
    p, bed = flow._simulation.particles, flow._simulation.bed
    at, depth = bed.depth_of(bed.footprints(p), p.volume)
    load = np.zeros(flow.grid.number_of_nodes)
    load[at] = 1990.0 * 9.81 * depth / (1.0 + SLOPE**2)
    return load


@pytest.mark.parametrize("calls", [1, 7])
def test_without_drainage_new_ground_bears_what_lies_on_it_now(calls):
    """Rises and falls add up to the load of the moment, whatever came before; in one call or many."""
    grid, flow = slope(soil=None)
    flow.run_one_step(1e-9)
    fresh = load_of(flow) == 0.0
    # the mass that fails has lain there before; its thickness is known to what sums in 32 bits leave
    assert grid.at_node[FIELD].max() < 1e-6 * B * load_of(flow).max()
    for _ in range(calls):
        flow.run_one_step(7.0 / calls)
    load = load_of(flow)
    assert np.count_nonzero(load[fresh]) > 60 and flow.budget["outflow"] == 0.0
    # round-off of 20 kPa, some 100 times
    np.testing.assert_allclose(grid.at_node[FIELD][fresh], B * load[fresh], rtol=0, atol=1e-9)
    assert np.all(grid.at_node[FIELD] >= 0.0)


@pytest.mark.slow
def test_it_drains_while_nothing_moves_and_between_calls_time_stands_still():
    grid, flow = slope(drainage_time=20.0, foot=60.0, numerics={"settle": True})
    rain = np.where(grid.x_of_node > 170.0, 4e3, 0.0)
    grid.at_node[FIELD][:] = rain
    assert flow.run_until_rest(200.0)
    lasted, before = flow.elapsed_time, grid.at_node[FIELD].copy()
    np.testing.assert_allclose(before[rain > 0.0], 4e3 * math.exp(-lasted / 20.0), rtol=1e-12)  # nothing came there
    assert np.count_nonzero(before[rain == 0.0]) > 30  # under the deposit
    flow.run_one_step(30.0)
    np.testing.assert_allclose(grid.at_node[FIELD], before * math.exp(-30.0 / 20.0), rtol=1e-12, atol=1e-300)


def test_soil_comes_in_with_the_pressure_the_flow_has_made():
    """Undrained, new ground has r_b = B rho/rho' under any load; that is the ratio that goes to the columns."""
    _, flow = slope(soil=5.0)
    flow.run_one_step(7.0)
    sim = flow._simulation
    front = (sim.particles.x > 80.0) & (sim.particles.entrained_volume > 0.0)
    assert np.count_nonzero(front) > 20
    # round-off of loads that came and went
    np.testing.assert_allclose(sim.particles.entrained_ratio[front], B * 1990.0 / 990.0, rtol=1e-9)


@pytest.mark.slow
def test_a_bed_that_keeps_its_pressure_lets_the_flow_run_farther():
    def run_out(drainage_time):
        _, flow = slope(0.15, drainage_time, foot=100.0, shape=(41, 70))
        assert flow.run_until_rest(300.0)
        budget = flow.budget
        assert abs(budget["residual"]) < 1e-12 * budget["eroded"] and budget["eroded"] > 100.0
        assert budget["outflow"] == 0.0
        return float(flow.particles.x.mean())

    kept, drained = run_out(None), run_out(0.01)
    assert kept > drained + 10.0  # measured 139 and 120 m


@pytest.mark.slow
def test_grains_and_water_weigh_what_their_mixture_weighs():
    """At the start, on bare ground: two sets of particles in one place are one load, not two."""
    loads = []
    for law in ("one_phase", "two_phase"):
        _, flow = slope(flow=law, soil=None)
        flow.run_one_step(1e-9)
        loads.append(flow._simulation.bed.pore_pressure._load)
    # the particles of either are elsewhere: a sum over all nodes, of a body that has the same depth
    assert loads[1].sum() == pytest.approx(loads[0].sum(), rel=0.05)


def test_a_call_that_fails_leaves_the_pressure_as_it_was():
    grid, flow = slope(drainage_time=20.0)
    grid.at_node[FIELD][:] = 1e3
    flow.run_one_step(1.0)
    before = copy_fields(grid)
    with failing(10), pytest.raises(Failed):
        flow.run_one_step(5.0)
    assert changed_fields(grid, before) == set()
    flow.run_one_step(1.0)
    assert grid.at_node[FIELD][-1] == pytest.approx(1e3 * math.exp(-2.0 / 20.0), rel=1e-12)


def test_who_looks_in_between_sees_the_present():
    """Beside the flow and far from it."""

    class Looks:
        interval = 1.0
        times, found = (), ()

        def observe(self, flow):
            self.times += (flow.elapsed_time,)
            self.found += (flow.grid.at_node[FIELD][[6 * 40 + 2, -1]],)

    looks = Looks()
    grid, flow = slope(drainage_time=20.0, observers=[looks], shape=(60, 40))
    grid.at_node[FIELD][:] = 1e3
    flow.run_one_step(3.0)
    assert len(looks.times) == 3
    expected = 1e3 * np.exp(-np.array(looks.times) / 20.0)
    np.testing.assert_allclose(looks.found, np.stack([expected, expected], axis=1), rtol=1e-12)


def test_a_ratio_beside_it_is_refused():
    grid, flow = slope()
    grid.add_full("bed__excess_pore_pressure_ratio", 0.5, at="node")
    with pytest.raises(InputError, match=r"bed_loading_coefficient > 0 .* delete the field"):
        flow.run_one_step(1.0)


def test_suction_in_the_bed_is_refused():
    grid, flow = slope()
    grid.at_node[FIELD][47] = -3.0
    with pytest.raises(InputError, match=r"bed__excess_pore_pressure must lie in \[0, inf\] Pa, got -3 at node 47"):
        flow.run_one_step(1.0)


def test_off_by_default():
    grid = inclined((6, 8), 5.0, SLOPE)
    DebrisFlow(grid)
    assert FIELD not in grid.at_node
