"""Mirror images behind closed nodes: where they are, and that the flow does not depend on where the wall begins."""

import numpy as np
import pytest

from landlab_debrisflow.model.walls import ghost_particles
from landlab_debrisflow.physics.contracts import FlowState, Position, Smoothing
from landlab_debrisflow.physics.flow import OnePhase
from landlab_debrisflow.spatial.cells import sort_into_cells
from landlab_debrisflow.spatial.raster import CLOSED, Raster
from landlab_debrisflow.spatial.summation import SMOOTHING_RATIO, Sums

ROWS, COLUMNS, D = 9, 11, 5.0
WEST, SOUTH = 0.5 * D, 0.5 * D  # faces of the closed rim [m]


def raster(closed="rim"):
    status = np.zeros((ROWS, COLUMNS), np.int64)
    if closed == "rim":
        status[[0, -1]] = status[:, [0, -1]] = CLOSED
    return Raster.from_status(status, (D, D))


def state(x, y, velocity=None, longest=1e9):
    n = x.size
    one, zero = np.ones(n), np.zeros(n)
    velocity = np.zeros((3, n)) if velocity is None else velocity
    return FlowState(
        Position(x, y, zero), velocity, one, Smoothing(SMOOTHING_RATIO * one, longest * one, one), one, zero, one, one,
        9.81, None,
    )  # fmt: skip


def reflect(flow, changed=None):
    n = flow.position.x.size
    touched = np.zeros(n, np.int8)
    changed = np.ones(n, bool) if changed is None else changed
    return *ghost_particles(flow, changed, raster(), touched), touched


def test_away_from_walls_nothing_is_touched():
    flow, changed = state(np.array([20.0, 30.0]), np.array([20.0, 25.0])), np.ones(2, bool)
    for closed in ("rim", "nothing"):
        touched = np.zeros(2, np.int8)
        same, also = ghost_particles(flow, changed, raster(closed), touched)
        assert same is flow and also is changed and not touched.any()


def test_images_are_mirrored_in_x_in_y_and_in_both():
    x, y = np.array([WEST + 1.0, 25.0]), np.array([SOUTH + 1.5, 20.0])
    velocity = np.array([[3.0, 1.0], [-4.0, 1.0], [0.5, 1.0]])
    flow, changed, _ = reflect(state(x, y, velocity), np.array([True, False]))
    assert flow.position.x.size == 5 and changed.tolist() == [True, False, True, True, True]
    ghosts = zip(flow.position.x[2:], flow.position.y[2:], flow.velocity[:, 2:].T, strict=True)
    found = {(a, b): (u, v, w) for a, b, (u, v, w) in ghosts}
    assert found == {
        (WEST - 1.0, SOUTH + 1.5): (-3.0, -4.0, 0.5),
        (WEST + 1.0, SOUTH - 1.5): (3.0, 4.0, 0.5),
        (WEST - 1.0, SOUTH - 1.5): (-3.0, 4.0, 0.5),
    }
    np.testing.assert_array_equal(flow.position.x[:2], x)


@pytest.mark.parametrize(("support", "ghosts"), [(19.9, 0), (20.1, 1)])
def test_a_wall_acts_from_as_far_as_the_support_reaches(support, ghosts):
    """The wall is 20 nodes away, so only a particle with a wide support is compared with it."""
    status = np.zeros((60, 60), np.uint8)
    status[30, 10] = CLOSED
    flow = state(np.array([30.5]), np.array([30.0]))
    flow = flow._replace(smoothing=flow.smoothing._replace(length=np.array([0.5 * support])))
    whole, _ = ghost_particles(flow, np.ones(1, bool), Raster.from_status(status, (1.0, 1.0)), np.zeros(1, np.int8))
    assert whole.position.x.size == 1 + ghosts


@pytest.mark.parametrize(("across", "touches"), [(-1.0, 1), (-1e-3, 1), (1e-3, 0), (1.0, 0)])
def test_what_leaves_a_wall_has_not_touched_it(across, touches):
    velocity = np.zeros((3, 1))
    velocity[:2, 0] = across, 1.0
    *_, touched = reflect(state(WEST + np.array([0.5]), np.array([15.0]), velocity))
    assert touched.tolist() == [touches]


def test_what_moves_within_its_own_spacing_has_touched():
    """Neither particles that only have their image in reach, 2.8 spacings from a wall at most, nor particles at
    rest."""
    x = WEST + np.array([0.5, 1.2, 0.5])
    velocity = np.zeros((3, 3))
    velocity[1, :2] = 1.0
    *_, touched = reflect(state(x, np.array([15.0, 20.0, 25.0]), velocity))
    assert touched.tolist() == [1, 0, 0]


def sums(flow, count, sweeps=1):
    """Return thickness, grad-h term, length, acceleration and rate of thickening of the first `count`."""
    out = Sums(np.empty(count), np.empty(count), np.empty(count), np.empty((3, count)), np.empty(count))
    for _ in range(sweeps):
        whole, _, _ = reflect(flow)
        cells = sort_into_cells(whole.position.x, whole.position.y, 2.0 * whole.smoothing.length)
        OnePhase().interact(whole, cells, 1.0, 1, out)
        flow = flow._replace(
            thickness=out.thickness.copy(),
            smoothing=flow.smoothing._replace(length=out.next_length.copy(), gradient_term=out.gradient_term.copy()),
        )
    return out


def filled(jitter=0.0):
    """Unit spacing and thickness from wall to wall; the basin is 45 m by 35 m."""
    x, y = (a.ravel() for a in np.meshgrid(WEST + 0.5 + np.arange(45.0), SOUTH + 0.5 + np.arange(35.0)))
    noise = np.random.default_rng(1).uniform(-jitter, jitter, (2, x.size))
    return x + noise[0], y + noise[1]


def test_a_lattice_does_not_feel_its_walls():
    x, y = filled()
    out = sums(state(x, y), x.size, sweeps=3)
    # as in the interior, tests/spatial/test_summation.py; without images thickness is .6 and the push 5 m/s2;
    # the noise of thickness, 2e-4, pushes with 1.3e-4 m/s2
    np.testing.assert_allclose(out.thickness, 1.0, rtol=0, atol=1e-3)
    assert abs(out.acceleration).max() < 5e-4


def test_a_disordered_lattice_is_as_thick_at_a_wall_as_elsewhere():
    x, y = filled(0.25)
    thickness = sums(state(x, y), x.size, sweeps=8).thickness
    edge = np.minimum.reduce([x - WEST, WEST + 45.0 - x, y - SOUTH, SOUTH + 35.0 - y])
    at_wall, inside = thickness[edge < 1.0], thickness[edge > 5.0]
    assert at_wall.mean() == pytest.approx(inside.mean(), abs=0.02)
    assert at_wall.std() < 1.5 * inside.std()


def test_what_is_pressed_into_a_corner_does_not_collapse():
    """A particle and three images in one place would sum to 2.2 V/l^2, and the smoothing length wants 1.96 V/l^2."""
    x, y = np.array([WEST + 1e-3]), np.array([SOUTH + 1e-3])
    out = sums(state(x, y, longest=2.0 * SMOOTHING_RATIO), 1, sweeps=60)
    assert 0.1 < out.thickness[0] < 0.5  # .22; .07 in the open


def test_a_wall_pushes_off_what_lies_at_it():
    x, y = np.array([WEST + 0.2]), np.array([20.0])
    push = sums(state(x, y), 1).acceleration[:, 0]
    assert push[0] > 0.1 and push[1] == push[2] == 0.0
