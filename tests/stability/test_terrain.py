"""Ground on which methods fail (docs/theory.md#failures): gullies, cliffs, pits, noise, walls, 0 and 80 degrees."""

import math

import numpy as np
import pytest

from validation.cases import stability as scenes
from validation.watch import NoThrust, Scene

from .checks import assert_sound


@pytest.mark.slow
@pytest.mark.parametrize("angle", [0.0, 20.0])
@pytest.mark.parametrize("depth", [1.0, 5.0, 20.0])
def test_a_gully_one_cell_wide(depth, angle):
    scene = Scene(scenes.gully(depth), 12.0, angle).run()
    assert_sound(scene)
    # most of it stays in the channel once it is deeper than the flow
    if depth > 1.0:
        assert np.median(abs(scene.flow.particles.y.values - 50.0)) < 5.0


@pytest.mark.slow
@pytest.mark.parametrize("angle", [0.0, 15.0])
@pytest.mark.parametrize("height", [50.0, 200.0])
def test_a_cliff(height, angle):
    scene = Scene(scenes.cliff(height), 10.0, angle).run()
    assert_sound(scene)
    assert scene.flow.budget["outflow"] < scene.flow.budget["released"]


@pytest.mark.slow
def test_a_cliff_is_no_dam():
    """On 17 degrees with 10 of friction everything slides to the edge, and over it: 2 m above, 50 m below."""
    scene = Scene(scenes.cliff(50.0), 30.0, 10.0, count=300).run()
    p = scene.flow.particles
    above = float(p.volume.values[p.x.values < 97.0].sum())
    assert above < 0.02 * scene.flow.budget["released"]  # measured 0; .96 where the surface has a lip of 3.7 m


@pytest.mark.slow
@pytest.mark.parametrize("angle", [0.0, 20.0])
@pytest.mark.parametrize("depth", [5.0, 20.0, 100.0])
def test_a_pit_ejects_nothing(depth, angle):
    scene = Scene(scenes.pit(depth), 20.0, angle, count=300).run()
    # Measured 0, .7 and .2 % of the kinetic energy, with friction up to 1.5 %: a step crosses half of the pit's wall.
    # What piles up at the bottom of a hole of 20 : 1 is chaotic: rounding alone (another compilation) made it > 2 %
    assert_sound(scene, energy=0.02 if depth < 100.0 else 0.1)
    # what comes out is not higher than what was there before: measured -2.0, -9.3 and -44 m. The top is twice a
    # quarter of the depth above the body, for a node that fails reaches half a spacing beyond
    assert scene.watch.head <= 0.0


@pytest.mark.slow
@pytest.mark.parametrize("depth", [20.0, 50.0, 200.0])
def test_particles_without_pressure_keep_their_head_in_a_pit(depth):
    """What the drift gains off a tangent is paid for: without that +28 m of head out of 20, +4100 m out of 200."""
    scene = Scene(scenes.pit(depth), 20.0, count=300, flow=NoThrust()).run()
    assert scene.watch.head <= 0.0  # measured -9.6, -22 and -86 m; twice `rise` is 10, 25 and 100 m


@pytest.mark.slow
@pytest.mark.parametrize("amplitude", [1.0, 2.0])
def test_particles_without_pressure_keep_their_head_over_noise(amplitude):
    scene = Scene(scenes.noisy_slope(amplitude), 14.0, flow=NoThrust()).run()
    assert scene.watch.head <= 0.0  # measured -5.1 and -8.5 m
    assert scene.watch.speed <= scene.watch.allowed  # measured 0.98 and 0.96


def test_no_step_jumps_over_the_terrain():
    """Over a plane 0.95 node spacings at most, also where nothing but gravity acts."""
    scene = Scene(scenes.plane(0.5, 1.0), 10.0, looks=10, count=100, flow=NoThrust()).run()
    # the last but one: a call ends with half a step, lest there be a sliver
    assert scene.steps.lengths[-4] * scene.watch.speed == pytest.approx(0.95 * 5.0, rel=0.05)


@pytest.mark.slow
@pytest.mark.parametrize("angle", [0.0, 15.0])
@pytest.mark.parametrize("amplitude", [1.0, 2.0])
def test_noise_of_the_elevation(amplitude, angle):
    assert_sound(Scene(scenes.noisy_slope(amplitude), 14.0, angle).run())


@pytest.mark.slow
@pytest.mark.parametrize("angle", [0.0, 15.0])
@pytest.mark.parametrize("gap", [False, True])
def test_walls_of_closed_nodes(gap, angle):
    scene = Scene(scenes.walls(gap), 20.0, angle).run()
    assert_sound(scene)
    p, grid = scene.flow.particles, scene.grid
    row, column = (np.floor(p[k].values / 5.0 + 0.5).astype(int) for k in "yx")
    assert not (grid.status_at_node[row * 61 + column] == grid.BC_NODE_IS_CLOSED).any()
    assert scene.flow.outflow_by_edge["inside"] == 0.0  # where a particle over a closed node would be booked
    behind = float(p.volume.values[p.x.values > 207.0].sum()) + scene.flow.outflow_by_edge["east"]
    assert (behind > 0.0) == gap


@pytest.mark.slow
def test_a_wall_never_makes_faster():
    """Nor does a corner, into which all of it falls at 48 m/s: images must not let the smoothing length collapse."""
    scene = Scene(scenes.steep_corner(), 5.0, count=200).run()
    assert_sound(scene)
    assert scene.watch.head <= scene.watch.rise  # measured +.12 m; the thickness where it piles up makes the bound lax
    assert scene.watch.speed <= scene.watch.allowed  # measured .93


@pytest.mark.slow
@pytest.mark.parametrize("degrees", [0.0, 80.0])
@pytest.mark.parametrize("thickness", [1e-3, 1.0, 100.0])
def test_slopes_and_thicknesses_at_their_ends(degrees, thickness):
    scene = Scene(scenes.plane(math.tan(math.radians(degrees)), thickness), 2.0, count=300).run()
    # Upright sides that collapse on a flat: measured up to 1.0e-2 and 5.0e-3 (1 and 100 m, 280 to 400 particles), of
    # first order in the step (an eighth of the Courant number: 2.0e-3 and 8e-4). Looks once cut the steps to .04 s
    assert_sound(scene, **({} if degrees else {"energy": 0.015}))
    if degrees:  # the middle falls with g sin(theta); the pressure moves the parts, not the whole
        fall = scene.watch.centre[0][2] - np.array(scene.watch.centre)[:, 2]
        t = np.array(scene.watch.times)[: fall.size]
        expected = 0.5 * 9.81 * math.sin(math.radians(degrees)) ** 2 * t[-1] ** 2
        assert fall[-1] == pytest.approx(expected, rel=2e-3)
