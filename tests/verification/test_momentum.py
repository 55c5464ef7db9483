"""The balance of momentum: gravity, bed, friction, thrust, walls, inflow, outflow and soil."""

import math

import numpy as np
import pytest
from landlab import RasterModelGrid

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.model import step

from ..grids import dry_block, inclined, place, release_cap, release_slab

G = 9.81


def momentum(flow):
    """Return the sum of V v over all particles, shape (3,) [m4 s-1]."""
    p = flow._simulation.particles
    return (p.volume * p.velocity).sum(axis=1)


def thrown(grid, velocity, **keywords):
    """Release what is to fail and give all of it one velocity along the bed (map components) [m/s]."""
    flow = place(DebrisFlow(grid, **keywords))
    simulation = flow._simulation
    simulation._arrested = False
    simulation._find_everything()
    u, v = velocity
    zx, zy = simulation.ground[1:3]
    simulation.particles.velocity[:] = np.array([u + 0.0 * zx, v + 0.0 * zx, u * zx + v * zy])
    return flow


def body(slope=0.0, shape=(30, 60), soil=None, **keywords):
    grid = inclined(shape, 5.0, slope, soil=soil)
    release_cap(grid, (75.0, 72.0), (25.0, 25.0), 2.0, on_top=True)
    return grid, dry_block(0.0, particle_count=300, rest_energy=0.0, **keywords)


def test_a_body_on_a_smooth_plain_keeps_its_momentum():
    grid, keywords = body()
    flow = thrown(grid, (12.0, -3.0), **keywords)
    before = momentum(flow)
    flow.run_one_step(5.0)
    p = flow.particles
    assert float(p.x.std()) > 15.0 and flow.budget["outflow"] == 0.0  # its thrust has spread it from 10 m
    # forces between particles of equal volume are equal and opposite to the last digit, also at different times of
    # their sleep: round-off of 300 x 80 sums
    np.testing.assert_allclose(momentum(flow), before, rtol=0, atol=1e-12 * np.linalg.norm(before))


def test_on_an_incline_it_gains_what_gravity_gives_along_the_bed():
    slope = 0.5
    grid, keywords = body(slope)
    flow = thrown(grid, (0.0, 4.0), **keywords)
    before, start = momentum(flow), flow.elapsed_time
    flow.run_one_step(3.0)
    cosine = 1.0 / math.hypot(1.0, slope)
    along = np.array([cosine, 0.0, -slope * cosine])
    gain = flow.budget["moving"] * G * slope * cosine * (flow.elapsed_time - start)
    assert flow.budget["outflow"] == 0.0
    # Gravity and the reaction of a plane bed are constant, so any step is exact. But the chords between particles
    # and with them the thrust lie in the plane only to the digits of elevation
    np.testing.assert_allclose(momentum(flow) - before, gain * along, rtol=0, atol=1e-11 * gain)


def test_coulomb_friction_takes_what_its_law_says():
    slope, mu = 0.5, 0.2
    grid = inclined((30, 60), 5.0, slope)
    release_slab(grid, (60.0, 72.0), 18.0, 0.05, on_top=True)
    flow = thrown(grid, (5.0, 0.0), **dry_block(mu, particle_count=200, rest_energy=0.0))
    before, start = momentum(flow), flow.elapsed_time
    flow.run_one_step(3.0)
    cosine = 1.0 / math.hypot(1.0, slope)
    gain = flow.budget["moving"] * G * (slope - mu) * cosine * (flow.elapsed_time - start)
    # all slide downslope, but for the spreading of a sheet of 5 cm aslant to it: measured 4e-6
    assert (momentum(flow) - before)[0] / cosine == pytest.approx(gain, rel=3e-5)


def test_soil_that_is_picked_up_brings_no_momentum(monkeypatch):
    """The balance closes with the reaction of the bed alone, into which the body digs a hollow."""
    grid, keywords = body(soil=5.0, erosion={"law": "growth", "growth_rate": 3e-3})
    flow = thrown(grid, (12.0, -3.0), **keywords)
    bed, thrust, kick, turn = np.zeros(3), np.zeros(3), step.kick, step.turn

    def watched_kick(velocity, push, ground, cosine, *rest):
        volume, dt = flow._simulation.particles.volume, rest[-1]
        normal = cosine * np.array([-ground[1], -ground[2], np.ones(cosine.size)])
        force = push + np.array([[0.0], [0.0], [-G]])
        thrust[:] += dt * (volume * push).sum(axis=1)
        bed[:] += dt * (volume * (force - push - (force * normal).sum(axis=0) * normal)).sum(axis=1)
        kick(velocity, push, ground, cosine, *rest)

    def watched_turn(velocity, *rest):  # the reaction of a bed that curves
        was = velocity.copy()
        turn(velocity, *rest)
        bed[:] += (flow._simulation.particles.volume * (velocity - was)).sum(axis=1)

    monkeypatch.setattr(step, "kick", watched_kick)
    monkeypatch.setattr(step, "turn", watched_turn)
    before, volume = momentum(flow), flow.budget["moving"]
    flow.run_one_step(4.0)
    size = np.linalg.norm(before)
    assert flow.budget["moving"] > 1.1 * volume and flow.budget["outflow"] == 0.0
    # equal and opposite also between particles that took up unequal volumes
    assert np.abs(thrust).max() < 1e-13 * size
    np.testing.assert_allclose(momentum(flow) - before, bed, rtol=0, atol=1e-12 * size)
    # the sides of the hollow, up to 18 cm deep, push back: measured 6e-3
    assert 1e-3 < abs(bed[0]) / size < 1e-2


def test_entrainment_itself_conserves_momentum_to_round_off(monkeypatch):
    """The stage alone: V v before it is V' v' after it, for every particle."""
    grid, keywords = body(soil=5.0, erosion={"law": "growth", "growth_rate": 3e-2})
    flow = thrown(grid, (12.0, -3.0), **keywords)
    taken, entrain, move = [], step.entrain, step.move

    def watched_entrain(sim, dt):
        taken.append(sim.particles.volume * sim.particles.velocity)
        return entrain(sim, dt)

    def watched_move(sim, dt, dilution):
        move(sim, dt, dilution)
        np.testing.assert_allclose(sim.particles.volume * sim.particles.velocity, taken.pop(), rtol=1e-14, atol=1e-300)
        assert np.all(dilution < 1.0)

    monkeypatch.setattr(step, "entrain", watched_entrain)
    monkeypatch.setattr(step, "move", watched_move)
    flow.run_one_step(0.5)


@pytest.mark.parametrize(("side", "axis", "velocity"), [("east", 0, (9.0, 2.0)), ("north", 1, (2.0, 9.0))])
def test_a_wall_takes_the_momentum_towards_it_and_no_other(side, axis, velocity):
    """One that hits a wall alone keeps what it has along the wall, and stays at it."""
    grid = inclined((30, 30), 5.0, 0.0)
    grid.set_closed_boundaries_at_grid_edges(True, True, True, True)
    release_slab(grid, (72.5, 72.5), 3.0, 1.0, on_top=True)
    flow = thrown(grid, velocity, **dry_block(0.0, particle_count=1, rest_energy=0.0))
    flow._simulation.particles.thrust[:] = 0.0
    before = momentum(flow)
    flow.run_one_step(9.0)  # there are 68 m to go
    p, after = flow.particles, momentum(flow)
    assert after[axis] == 0.0 and after[1 - axis] == pytest.approx(before[1 - axis], rel=1e-14)
    # the wall is half a node spacing inside the closed nodes, and a step is at most a quarter of one
    position = float((p.x, p.y)[axis][0])
    assert 145.0 - 2.5 - 1.25 <= position <= 145.0 - 2.5


def test_a_body_against_a_wall_loses_what_the_wall_gives(monkeypatch):
    """The impulse of the wall, added up where it acts, is all that changes the momentum on a smooth plain."""
    grid = inclined((20, 40), 5.0, 0.0)
    grid.set_closed_boundaries_at_grid_edges(True, True, True, True)
    release_slab(grid, (120.0, 47.5), 18.0, 1.0, on_top=True)
    flow = thrown(grid, (15.0, 0.0), **dry_block(0.0, particle_count=200, rest_energy=0.0))
    impulse, stop_at_walls, drift = np.zeros(3), step.stop_at_walls, step.drift

    def watched(act):
        def acting(x, y, velocity, *rest):
            was, volume = velocity.copy(), flow._simulation.particles.volume
            act(x, y, velocity, *rest)
            impulse[:] += (volume * (velocity - was)).sum(axis=1)

        return acting

    monkeypatch.setattr(step, "stop_at_walls", watched(stop_at_walls))
    monkeypatch.setattr(step, "drift", watched(drift))
    before = momentum(flow)
    flow.run_one_step(5.0)
    after = momentum(flow)
    assert flow.budget["outflow"] == 0.0 and impulse[0] < -0.5 * before[0]
    np.testing.assert_allclose(after - before, impulse, rtol=0, atol=1e-12 * before[0])


def test_what_leaves_takes_its_momentum_with_it(monkeypatch):
    grid, keywords = body(shape=(30, 40))
    flow = thrown(grid, (20.0, 1.0), **keywords)
    out, drift = np.zeros(3), step.drift

    def watched(x, y, velocity, dilution, dx, dy, columns, status, dt, left, touched_wall):
        drift(x, y, velocity, dilution, dx, dy, columns, status, dt, left, touched_wall)
        p, gone = flow._simulation.particles, left >= 0
        out[:] += (p.volume[gone] * velocity[:, gone]).sum(axis=1)

    monkeypatch.setattr(step, "drift", watched)
    before = momentum(flow)
    flow.run_one_step(6.0)
    assert 100.0 < flow.budget["outflow"] < 0.9 * flow.budget["released"]
    np.testing.assert_allclose(momentum(flow) + out, before, rtol=0, atol=1e-12 * np.linalg.norm(before))


def test_inflow_brings_its_momentum_and_the_thrust_behind_it():
    """Control volume behind the line, no friction: dP/dt = L (h v^2 + g h^2/2)."""
    speed, thickness, length = 5.0, 0.5, 40.0
    grid = RasterModelGrid((50, 30), xy_spacing=4.0)
    grid.add_zeros("topographic__elevation", at="node")
    line = {"line_start": (20.0, 78.0), "line_end": (20.0, 118.0), "direction": 0.0}
    inflow = line | {"times": [0.0, 10.0], "discharge": speed * thickness * length, "velocity": speed}
    flow = DebrisFlow(grid, **dry_block(0.0, particle_count=2000), inflow=inflow)
    flow.run_one_step(2.0)  # the first has left the strip
    before, entered, start = momentum(flow), flow.budget["inflow"], flow.elapsed_time
    flow.run_one_step(4.0)
    gain, came = momentum(flow) - before, flow.budget["inflow"] - entered
    assert flow.budget["outflow"] == 0.0
    thrust = 0.5 * G * thickness**2 * length * (flow.elapsed_time - start)
    # Measured .983: at the ends of the line nothing pushes from aside. .44 without the strip
    assert (gain[0] - came * speed) / thrust == pytest.approx(1.0, abs=0.04)
    assert gain[0] == pytest.approx(came * speed + thrust, rel=0.01)
    assert abs(gain[1]) < 1e-3 * gain[0]
