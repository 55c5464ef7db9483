"""The balance of momentum: gravity, bed, friction, thrust, walls, inflow, outflow and soil."""

import math

import numpy as np
import pytest
from landlab import RasterModelGrid

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.model import step
from validation.grids import dry_block, inclined, place, release_cap, release_slab

G = 9.81


class Sums:
    """What acts on the particles, added up at every kick.

    Each sum over neighbours is made of floats: it is known to 6e-8 of the sum of the sizes of its parts. These are
    g_n h 2.33/l on a lattice, for 2.33/l is the integral of |grad W|. Before that they are equal and opposite
    between two particles, to the last bit.
    """

    def __init__(self, flow, monkeypatch):
        phases = flow._simulation.phases
        self.bed, self.thrust, self.sizes, kick = np.zeros(3), np.zeros(3), 0.0, phases.kick

        def watched(p, exchange, velocity, yield_stress, drag, rest_speed, dt, threads):
            ground, cosine = p.surface_sample, p.cos_slope
            normal = cosine * np.array([-ground[1], -ground[2], np.ones(cosine.size)])
            across = ((p.thrust + np.array([[0.0], [0.0], [-G]])) * normal).sum(axis=0)
            self.thrust += dt * (p.volume * p.thrust).sum(axis=1)
            self.bed -= dt * (p.volume * (np.array([[0.0], [0.0], [G]]) + across * normal)).sum(axis=1)
            self.sizes += dt * float((p.volume * G * cosine * p.thickness * 2.33 / p.smoothing_length).sum())
            kick(p, exchange, velocity, yield_stress, drag, rest_speed, dt, threads)

        monkeypatch.setattr(phases, "kick", watched)

    @property
    def rounding(self):
        """What the momentum is known to, had all sums been rounded the same way [m4 s-1]."""
        return 0.5 * np.finfo(np.float32).eps * self.sizes


def momentum(flow):
    """Return the sum of V v over all particles, shape (3,) [m4 s-1]."""
    p = flow._simulation.particles
    return (p.volume * p.velocity).sum(axis=1)


def thrown(grid, velocity, **keywords):
    """Release what is to fail and give all of it one velocity along the bed (map components) [m/s]."""
    failing = grid.at_node["debris_flow__release_depth"] > 0.0
    for axis, component in zip("xy", velocity, strict=True):
        grid.add_field(f"debris_flow__release_velocity_{axis}", np.where(failing, component, 0.0), at="node")
    return place(DebrisFlow(grid, **keywords))


def body(slope=0.0, shape=(30, 60), soil=None, **keywords):
    grid = inclined(shape, 5.0, slope, soil=soil)
    release_cap(grid, (75.0, 72.0), (25.0, 25.0), 2.0, on_top=True)
    return grid, dry_block(0.0, particle_count=300, rest_energy=0.0, **keywords)


@pytest.mark.slow
def test_a_body_on_a_smooth_plain_keeps_its_momentum(monkeypatch):
    grid, keywords = body()
    flow = thrown(grid, (12.0, -3.0), **keywords)
    before, sums = momentum(flow), Sums(flow, monkeypatch)
    flow.run_one_step(5.0)
    p = flow.particles
    assert float(p.x.std()) > 15.0 and flow.budget["outflow"] == 0.0  # its thrust has spread it from 10 m
    # measured 7e-10 of the momentum, and 1.6e-7 if all sums were rounded the same way
    np.testing.assert_allclose(momentum(flow), before, rtol=0, atol=sums.rounding)


@pytest.mark.slow
def test_on_an_incline_it_gains_what_gravity_gives_along_the_bed(monkeypatch):
    slope = 0.5
    grid, keywords = body(slope)
    flow = thrown(grid, (0.0, 4.0), **keywords)
    before, start, sums = momentum(flow), flow.elapsed_time, Sums(flow, monkeypatch)
    flow.run_one_step(3.0)
    cosine = 1.0 / math.hypot(1.0, slope)
    along = np.array([cosine, 0.0, -slope * cosine])
    gain = flow.budget["moving"] * G * slope * cosine * (flow.elapsed_time - start)
    assert flow.budget["outflow"] == 0.0
    # gravity and the reaction of a plane bed are constant, so any step is exact. Measured 6e-10, bound 9e-8
    np.testing.assert_allclose(momentum(flow) - before, gain * along, rtol=0, atol=sums.rounding)


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


@pytest.mark.slow
def test_soil_that_is_picked_up_brings_no_momentum(monkeypatch):
    """The balance closes with the reaction of the bed alone, into which the body digs a hollow."""
    grid, keywords = body(soil=5.0, erosion={"law": "growth", "growth_rate": 3e-3})
    flow = thrown(grid, (12.0, -3.0), **keywords)
    sums, bend, follow_bed = Sums(flow, monkeypatch), np.zeros(3), step.follow_bed

    def watched(first, last, ground, velocity, *rest):  # the reaction of a bed that curves
        was = velocity.copy()
        follow_bed(first, last, ground, velocity, *rest)
        bend[:] += (flow._simulation.particles.volume * (velocity - was)).sum(axis=1)

    monkeypatch.setattr(step, "follow_bed", watched)
    before, volume = momentum(flow), flow.budget["moving"]
    flow.run_one_step(4.0)
    size, bed = np.linalg.norm(before), sums.bed + bend
    assert flow.budget["moving"] > 1.1 * volume and flow.budget["outflow"] == 0.0
    # equal and opposite also between particles that took up unequal volumes: measured 3e-10, bound 1.6e-7
    assert np.abs(sums.thrust).max() < sums.rounding
    np.testing.assert_allclose(momentum(flow) - before, bed + sums.thrust, rtol=0, atol=1e-12 * size)
    # the sides of the hollow, up to 18 cm deep, push back: measured 6e-3
    assert 1e-3 < abs(bed[0]) / size < 1e-2


@pytest.mark.slow
def test_entrainment_itself_conserves_momentum_to_round_off(monkeypatch):
    """The stage alone: V v before it is V' v' after it, for every particle."""
    grid, keywords = body(soil=5.0, erosion={"law": "growth", "growth_rate": 3e-2})
    flow = thrown(grid, (12.0, -3.0), **keywords)
    taken, entrain, move = [], step.entrain, step.move

    def watched_entrain(p, *rest):
        taken.append(p.volume * p.velocity)
        return entrain(p, *rest)

    def watched_move(p, bed, velocity_ratio, *rest):
        move(p, bed, velocity_ratio, *rest)
        np.testing.assert_allclose(p.volume * p.velocity, taken.pop(), rtol=1e-14, atol=1e-300)
        assert np.all(velocity_ratio < 1.0)

    monkeypatch.setattr(step, "entrain", watched_entrain)
    monkeypatch.setattr(step, "move", watched_move)
    flow.run_one_step(0.5)


@pytest.mark.slow
@pytest.mark.parametrize(("side", "axis", "velocity"), [("east", 0, (9.0, 2.0)), ("north", 1, (2.0, 9.0))])
def test_a_wall_takes_the_momentum_towards_it_and_no_other(side, axis, velocity):
    """One that hits a wall alone keeps what it has along the wall; its image pushes it back, and no further aside."""
    grid = inclined((30, 30), 5.0, 0.0)
    grid.set_closed_boundaries_at_grid_edges(True, True, True, True)
    release_slab(grid, (70.0, 70.0), 3.0, 1.0, on_top=True)
    flow = thrown(grid, velocity, **dry_block(0.0, particle_count=1, rest_energy=0.0))
    p = flow._simulation.particles
    p.least_thickness[:], p.smoothing_length[:] = 1.0, 7.0  # alone it would think itself as wide as the basin
    flow._simulation._refresh(8)
    before = momentum(flow)
    flow.run_one_step(9.0)  # there are 72.5 m to go
    p, after = flow.particles, momentum(flow)
    position = float((p.x, p.y)[axis][0])
    assert after[1 - axis] == pytest.approx(before[1 - axis], rel=1e-14)
    # its image comes towards it, and the shock viscosity stops them: measured .69 m/s after 9 s, 1.4 m from the wall,
    # which is half a node spacing inside the closed nodes
    assert abs(after[axis]) < 0.1 * before[axis]
    assert 145.0 - 2.5 - 2.5 <= position <= 145.0 - 2.5


@pytest.mark.slow
def test_a_body_against_a_wall_loses_what_the_wall_gives(monkeypatch):
    """The impulse of the wall, added up where it acts, is all that changes the momentum on a smooth plain."""
    grid = inclined((20, 40), 5.0, 0.0)
    grid.set_closed_boundaries_at_grid_edges(True, True, True, True)
    release_slab(grid, (120.0, 47.5), 18.0, 1.0, on_top=True)
    flow = thrown(grid, (15.0, 0.0), **dry_block(0.0, particle_count=200, rest_energy=0.0))
    sums, impulse = Sums(flow, monkeypatch), np.zeros(3)

    def watch(name, act, place):
        def acting(*arguments):
            velocity, volume = arguments[place], flow._simulation.particles.volume
            was = velocity.copy()
            result = act(*arguments)
            impulse[:] += (volume * (velocity - was)).sum(axis=1)
            return result

        monkeypatch.setattr(step, name, acting)

    watch("stop_at_walls", step.stop_at_walls, 2)
    watch("drift", step.drift, 2)
    before = momentum(flow)
    flow.run_one_step(5.0)
    after = momentum(flow)
    assert flow.budget["outflow"] == 0.0
    # What remains of all thrust is that of the images behind the wall, and points away from it: measured .69 of the
    # momentum there was, and at most 3e-4 are left to the wall itself. Along it, too, 3e-4: what has come nearer than a
    # quarter of its spacing has its image farther off, and then an image pulls along the wall otherwise than it is
    # pulled
    assert impulse[0] <= 0.0 and sums.thrust[0] < -0.5 * before[0] and abs(sums.thrust[1]) < 5e-4 * before[0]
    np.testing.assert_allclose(after - before, impulse + sums.thrust, rtol=0, atol=1e-12 * before[0])


@pytest.mark.slow
def test_what_leaves_takes_its_momentum_with_it(monkeypatch):
    grid, keywords = body(shape=(30, 40))
    flow = thrown(grid, (20.0, 1.0), **keywords)
    out, drift = np.zeros(3), step.drift

    def watched(first, position, velocity, *rest):
        left = drift(first, position, velocity, *rest)
        p, gone = flow._simulation.particles, rest[-1] >= 0
        out[:] += (p.volume[gone] * velocity[:, gone]).sum(axis=1)
        return left

    monkeypatch.setattr(step, "drift", watched)
    before, sums = momentum(flow), Sums(flow, monkeypatch)
    flow.run_one_step(6.0)
    assert 100.0 < flow.budget["outflow"] < 0.9 * flow.budget["released"]
    # measured 2e-10 of the momentum, bound 1e-7
    np.testing.assert_allclose(momentum(flow) + out, before, rtol=0, atol=sums.rounding)


@pytest.mark.slow
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
