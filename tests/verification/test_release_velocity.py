"""Ground that fails while it moves, against closed forms of a block on a plane."""

import math

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.model.step_rule import MOST_EVEN
from validation.grids import dry_block, inclined, place, release_slab

G, DEGREES, SPACING = 9.81, 25.0, 5.0
SLOPE, ANGLE = math.tan(math.radians(DEGREES)), math.radians(DEGREES)


def block(speed, friction, towards=(1.0, 0.0), start=(100.0, 60.0), particles=1, **numerics):
    """Return a dry block on a plane that falls eastward, released at a speed along the bed [m s-1] towards a side."""
    grid = inclined((25, 161), SPACING, SLOPE)
    depth = release_slab(grid, start, 6.0, 0.02, on_top=True)
    east, north = towards
    over_map = speed / math.sqrt(east**2 * (1.0 + SLOPE**2) + north**2)
    for name, part in (("x", east), ("y", north)):
        grid.add_field(f"debris_flow__release_velocity_{name}", np.where(depth > 0.0, over_map * part, 0.0), at="node")
    return DebrisFlow(grid, **dry_block(friction, particle_count=particles, **numerics))


def height(flow):
    return float(flow.particles.z.mean())


@pytest.mark.parametrize("friction", [0.6, 0.9])
@pytest.mark.parametrize("downhill", [True, False])
def test_way_and_time_to_stop(friction, downhill):
    """A way of v^2 / 2a in v / a, with a = g (mu cos(theta) -+ sin(theta))."""
    speed = 10.0
    slowing = G * (friction * math.cos(ANGLE) - (1.0 if downhill else -1.0) * math.sin(ANGLE))
    flow = block(speed, friction, (1.0 if downhill else -1.0, 0.0), start=(200.0, 60.0))
    assert flow.run_until_rest()
    way = (200.0 - float(flow.particles.x[0])) / math.cos(ANGLE)
    # it is arrested at 1 % of its speed; the last steps last 1/16 of what crosses half a node spacing at first, .016 s
    assert 0.99 * speed / slowing <= flow.elapsed_time <= speed / slowing + 0.03
    assert abs(way) == pytest.approx(speed**2 / (2.0 * slowing), rel=1e-3) and (way > 0.0) != downhill


def test_run_up_without_friction():
    """Up by v^2 / 2g after v / (g sin(theta)), and back with the same speed."""
    speed = 12.0
    flow = block(speed, 0.0, (-1.0, 0.0), start=(300.0, 60.0), rest_energy=0.0)
    place(flow)
    began, upward = height(flow), speed / (G * math.sin(ANGLE))
    flow.run_one_step(upward - flow.elapsed_time)
    assert height(flow) - began == pytest.approx(speed**2 / (2.0 * G), rel=1e-6)
    assert abs(float(flow.particles.velocity_x[0])) < 1e-6
    lowest = flow.grid.at_node["debris_flow__max_run_up"].max()
    assert lowest == pytest.approx(speed**2 / (2.0 * G), abs=0.05)
    flow.run_one_step(upward)
    assert height(flow) == pytest.approx(began, abs=1e-5)
    assert float(flow.particles.velocity_x[0]) == pytest.approx(speed * math.cos(ANGLE), rel=1e-6)


def test_along_the_contour_it_is_a_parabola_on_the_plane():
    speed, duration = 8.0, 3.0
    flow = block(speed, 0.0, (0.0, 1.0), rest_energy=0.0)
    place(flow)
    flow.run_one_step(duration - flow.elapsed_time)
    fall = 0.5 * G * math.sin(ANGLE) * duration**2 * math.cos(ANGLE)
    assert float(flow.particles.x[0]) == pytest.approx(100.0 + fall, rel=1e-6)
    assert float(flow.particles.y[0]) == pytest.approx(60.0 + speed * duration, rel=1e-6)


def test_a_body_of_many_particles_slides_as_one():
    speed, friction, duration = 10.0, 0.3, 4.0
    flow = block(speed, friction, particles=100)
    flow.run_one_step(duration)
    gain = G * (math.sin(ANGLE) - friction * math.cos(ANGLE))
    way = speed * duration + 0.5 * gain * duration**2
    # 2 cm of debris spread by pressure, symmetrically
    assert float(flow.particles.x.mean()) == pytest.approx(100.0 + way * math.cos(ANGLE), rel=2e-3)


def test_the_first_step_knows_the_speed():
    flow = place(block(80.0, 0.3))
    assert flow._simulation.state.limits.longest_step * 80.0 <= MOST_EVEN * SPACING
