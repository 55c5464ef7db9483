"""Rest is local: each body comes to rest by its own motion, and those that touch each other rest together."""

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.model.rest import find_bodies
from validation.grids import dry_block, inclined, place, release, release_slab

FOOT = 300.0
"""Where both slopes of `two_slopes` end [m]."""


def two_slopes(slow=0.0, fast=0.0, flow="one_phase", laid=0.0):
    """Return a flow on a grid with a gentle slope in the south, a steep one in the north, and a ridge between.

    `slow` and `fast` are the depths that fail there [m]: 25 m3 creep in one particle, 30 000 m3 rush. `laid` is another
    that lies on the flat at the foot of the steep slope.
    """
    grid = inclined((61, 121), 5.0, 0.0)
    x, y = grid.x_of_node, grid.y_of_node
    z = np.where(y > 150.0, 0.7, 0.32) * np.maximum(0.0, FOOT - x) + 100.0 * np.exp(-(((y - 100.0) / 20.0) ** 2))
    depth = slow * (np.hypot(x - 40.0, y - 40.0) < 2.0) + fast * (np.hypot(x - 60.0, y - 220.0) < 40.0)
    depth += laid * (np.hypot(x - 450.0, y - 220.0) < 12.0)
    grid.at_node["topographic__elevation"][:] = z + depth
    release(grid, depth)
    keywords = dry_block(0.3, particle_count=1 if fast == 0.0 else 400)
    if flow == "two_phase":
        keywords["material"] = {}
        keywords["friction"] = {"law": "coulomb", "basal_friction_angle": 31.1}  # 0.3 of the weight, as the dry block
    return DebrisFlow(grid, flow=flow, **keywords)


def south(flow):
    """Return the mean place along the slope [m] and speed [m/s] of what failed in the south."""
    p = flow.particles
    here = p.y.values < 100.0
    return float(p.x.values[here].mean()), float(np.hypot(p.velocity_x, p.velocity_y).values[here].mean())


@pytest.mark.slow
def test_a_slow_slide_does_not_stop_because_a_large_one_did():
    alone, beside = two_slopes(slow=1.0), two_slopes(slow=1.0, fast=6.0)
    for flow in (alone, beside):
        assert flow.run_until_rest(600.0) is True
    # until 300 m on 0.32 it gains 0.02 g cos(theta), then loses 0.3 g: it comes to rest some 17 m beyond the foot
    assert south(alone)[0] == pytest.approx(FOOT + 17.0, abs=3.0)
    # steps differ, and a slide of one particle stops where steps end
    assert south(beside)[0] == pytest.approx(south(alone)[0], abs=1.0)


@pytest.mark.slow
def test_a_large_slide_that_has_stopped_stays_so_while_a_slow_one_moves():
    flow = two_slopes(slow=1.0, fast=6.0)
    flow.run_one_step(40.0)
    p = flow._simulation.particles
    north = p.y > 150.0
    assert not p.velocity[:, north].any() and np.all(p.arrested[north] == 1)
    assert south(flow)[1] > 1.0 and not flow.at_rest
    before = flow.particles.x[flow.particles.y > 150.0]
    flow.run_one_step(1.0)
    p = flow.particles
    np.testing.assert_array_equal(p.x[p.y > 150.0], before)


@pytest.mark.slow
def test_what_lies_elsewhere_is_not_woken_by_a_release():
    flow = two_slopes(fast=6.0)
    flow.run_until_rest(200.0)
    p = flow.particles
    before = np.sort(p.x[p.y > 150.0])
    flow.grid.at_node["debris_flow__release_depth"][15 * 121 + 8] = 1.0  # on the side of the ridge
    flow.run_one_step(5.0)
    p = flow.particles
    assert south(flow)[1] > 0.5
    np.testing.assert_array_equal(np.sort(p.x[p.y > 150.0]), before)


@pytest.mark.slow
def test_a_flow_sets_free_what_it_runs_into():
    flow = two_slopes(laid=2.0)
    assert flow.run_until_rest() is True
    lying = flow.particles.sizes["particle"]
    flow.grid.at_node["debris_flow__release_depth"][:] = two_slopes(fast=6.0).grid.at_node["debris_flow__release_depth"]
    was = float(flow.particles.x.mean())
    flow.run_until_rest(200.0)
    assert flow.particles.x[:lying].mean() > was + 5.0


@pytest.mark.slow
def test_a_slow_slide_of_two_phases_does_not_stop_either():
    alone, beside = two_slopes(slow=1.0, flow="two_phase"), two_slopes(slow=1.0, fast=6.0, flow="two_phase")
    for flow in (alone, beside):
        flow.run_one_step(45.0)
    assert south(beside)[1] > 1.0
    assert south(beside) == pytest.approx(south(alone), rel=0.02)  # steps differ


@pytest.mark.slow
def test_what_leans_on_a_wall_comes_to_rest():
    """Judged by friction alone, which cannot hold it on this slope, it crept at 1e-12 m/s for ever."""
    grid = inclined((20, 40), 5.0, 0.5)
    hole = (abs(grid.x_of_node - 100.0) < 8.0) & (abs(grid.y_of_node - 48.0) < 20.0)
    grid.status_at_node[hole] = grid.BC_NODE_IS_CLOSED
    release(grid, 1.0 * (abs(grid.x_of_node - 30.0) < 8.0) * (abs(grid.y_of_node - 48.0) < 8.0))
    flow = DebrisFlow(grid, numerics={"particle_count": 100, "settle": False})
    assert flow.run_until_rest(200.0) is True
    assert flow.budget["moving"] > 20.0  # it lies behind the wall


def test_bodies_are_those_that_feel_each_other():
    rng = np.random.default_rng(0)
    for n in (1, 2, 30, 300):
        x, y, z = rng.uniform(0.0, 30.0, (3, n)) * np.array([[1.0], [1.0], [0.1]])
        support = rng.uniform(0.2, 2.0, n)
        distance = np.sqrt(sum((a[:, None] - a) ** 2 for a in (x, y, z)))
        linked = distance < np.maximum(support[:, None], support)
        label = np.arange(n)
        while True:  # the slow way: every particle takes the least number among its neighbours
            least = np.where(linked, label, n).min(axis=1)
            if np.array_equal(least, label):
                break
            label = least
        found = find_bodies(x, y, z, support)
        np.testing.assert_array_equal(found, np.unique(label, return_inverse=True)[1])


@pytest.mark.slow
def test_the_peak_goes_with_the_particles_when_a_body_parts():
    flow = two_slopes(fast=6.0)
    flow.run_one_step(3.0)
    simulation = flow._simulation
    bodies, p = simulation.state.bodies, simulation.particles
    bodies.separate(p)
    whole = bodies.peak.sum()
    p.x[p.x > np.median(p.x)] += 1000.0
    bodies.separate(p)
    assert bodies.peak.sum() == pytest.approx(whole, rel=1e-12)
    parts = np.bincount(p.body, p.volume)
    # by volume: within the volume of the few that had parted before
    np.testing.assert_allclose(np.sort(bodies.peak / whole), np.sort(parts / parts.sum()), atol=0.02)


REST_ENERGY, GRAVITY = 1e-4, 9.81


@pytest.fixture
def creeping():
    """Bodies and particles of a slide of one body whose energy is between rest and the most of creep."""
    grid = inclined((9, 9), 5.0, 0.5)
    release_slab(grid, (20.0, 20.0), 10.0, 1.0)
    flow = place(DebrisFlow(grid, **dry_block(0.3, particle_count=20)))
    bodies, p = flow._simulation.state.bodies, flow._simulation.particles
    p.velocity[:] = np.array([[0.3], [0.0], [0.0]])
    bodies.set_free(p)
    bodies.separate(p)
    assert bodies.volume.size == 1
    bodies.peak[:] = 0.09 * bodies.volume / (5.0 * REST_ENERGY)  # twice less than creep may have
    return bodies, p


def test_what_is_slow_for_long_creeps(creeping):
    bodies, p = creeping
    # 1e-3 g gives a body the speed that creep has at most in this time
    speed = 0.3 * np.sqrt(2.0)
    patience = speed / (1e-3 * GRAVITY)
    assert bodies.judge(p, REST_ENERGY, GRAVITY, 7.0) is None
    assert bodies.judge(p, REST_ENERGY, GRAVITY, 7.0 + 0.99 * patience) is None
    most_unheld = bodies.judge(p, REST_ENERGY, GRAVITY, 7.0 + 1.01 * patience)
    assert most_unheld == pytest.approx(bodies.volume, rel=1e-6) and np.all(most_unheld < bodies.volume)
    # what was fast meanwhile begins anew
    p.velocity *= 2.0
    assert bodies.judge(p, REST_ENERGY, GRAVITY, 8.0 + 1.01 * patience) is None
    p.velocity *= 0.5
    assert bodies.judge(p, REST_ENERGY, GRAVITY, 9.0 + 1.01 * patience) is None


def test_what_is_as_slow_as_at_rest_need_not_wait(creeping):
    bodies, p = creeping
    p.velocity *= 0.4  # 0.8 of the rest energy
    assert bodies.judge(p, REST_ENERGY, GRAVITY, 7.0) == pytest.approx(0.5 * bodies.volume)


def test_a_body_that_creeps_is_arrested_where_friction_holds_some_of_it(creeping):
    bodies, p = creeping
    bodies.judge(p, REST_ENERGY, GRAVITY, 0.0)
    held, none = np.zeros(p.awake, bool), np.zeros(0, int)
    bodies.arrest(p, bodies.judge(p, REST_ENERGY, GRAVITY, 1e3), held, none)
    assert p.velocity.any() and not bodies.at_rest  # water that moves slowly is not held anywhere
    held[0] = True
    bodies.arrest(p, bodies.judge(p, REST_ENERGY, GRAVITY, 1e3), held, np.array([1]))
    assert p.velocity.any() and not bodies.at_rest  # some of it flows in
    bodies.arrest(p, bodies.judge(p, REST_ENERGY, GRAVITY, 1e3), held, none)
    assert not p.velocity.any() and bodies.at_rest


def test_a_body_that_parts_or_meets_another_keeps_its_patience(creeping):
    bodies, p = creeping
    bodies.judge(p, REST_ENERGY, GRAVITY, 5.0)
    p.x[p.x > np.median(p.x)] += 1000.0
    bodies.separate(p)
    assert bodies.slow_since.size > 1 and np.all(bodies.slow_since == 5.0)
    bodies.slow_since[0] = np.inf  # one of them has become fast
    p.x[p.x > 1000.0] -= 1000.0
    bodies.separate(p)
    assert bodies.slow_since.tolist() == [np.inf]


@pytest.mark.parametrize(("rest_energy", "slowest"), [(0.0, 0.0), (1e-5, 10.0**-2.5), (1e-4, 1e-2), (1e-2, 1e-2)])
def test_a_particle_rests_below_one_hundredth_of_the_speed_at_most(creeping, rest_energy, slowest):
    bodies, p = creeping
    bodies.judge(p, rest_energy, GRAVITY, 0.0)
    at_peak = float(np.sqrt(bodies.peak / bodies.volume)[0])
    np.testing.assert_allclose(p.rest_speed, slowest * at_peak, rtol=1e-12)
