"""The surface goes through the nodes, is C1, exact for quadratics, and never reads closed nodes."""

import numpy as np
import pytest

from landlab_debrisflow.terrain.surface import Surface

DX, DY = 2.0, 5.0  # not equal: a mix-up of the axes shows


@pytest.fixture
def rough():
    return np.random.default_rng(1).normal(0.0, 10.0, (9, 12))


def nodes_of(shape):
    y, x = np.meshgrid(DY * np.arange(shape[0]), DX * np.arange(shape[1]), indexing="ij")
    return x.ravel(), y.ravel()


def test_it_goes_through_the_nodes(rough):
    z = Surface(rough, (DX, DY)).sample(*nodes_of(rough.shape))[0]
    np.testing.assert_allclose(z, rough.ravel(), rtol=0, atol=2e-14)  # round-off of values of 30, at the far edges


def quadratic(x, y):
    """Return z and all its derivatives as `sample` orders them."""
    one = np.ones_like(x)
    return np.array([
        3.0 + 0.5 * x - 0.2 * y + 0.03 * x**2 - 0.04 * x * y + 0.01 * y**2,
        0.5 + 0.06 * x - 0.04 * y, -0.2 - 0.04 * x + 0.02 * y, 0.06 * one, -0.04 * one, 0.02 * one,
    ])  # fmt: skip


def test_quadratics_are_exact_inside():
    shape = (9, 12)
    x, y = nodes_of(shape)
    surface = Surface(quadratic(x, y)[0].reshape(shape), (DX, DY))
    rng = np.random.default_rng(2)
    # the outermost cells use the rim, which is linear
    px, py = rng.uniform(DX, 10 * DX, 200), rng.uniform(DY, 7 * DY, 200)
    # values of order 10 over spacings of order 1: round-off of some 1e-14
    np.testing.assert_allclose(surface.sample(px, py), quadratic(px, py), rtol=0, atol=1e-12)


def test_planes_are_exact_up_to_the_edge_and_beyond():
    shape = (5, 6)
    x, y = nodes_of(shape)
    surface = Surface((1.0 + 0.5 * x - 0.25 * y).reshape(shape), (DX, DY))
    px, py = np.array([0.0, 0.3, 9.9, 10.0, 10.9, -0.9]), np.array([0.0, 19.9, 0.2, 20.0, 22.0, -2.0])
    z = surface.sample(px, py)
    np.testing.assert_allclose(z[0], 1.0 + 0.5 * px - 0.25 * py, rtol=0, atol=1e-13)  # round-off
    np.testing.assert_allclose(z[1:3], [[0.5] * 6, [-0.25] * 6], rtol=0, atol=1e-13)


@pytest.mark.parametrize("axis", [0, 1])
def test_value_and_gradient_are_continuous_across_cells(rough, axis):
    surface = Surface(rough, (DX, DY))
    rng = np.random.default_rng(3)
    lines, along = DX * np.arange(1, 11), rng.uniform(0.0, 8 * DY, 10)
    if axis == 1:
        lines, along = DY * np.arange(1, 8), rng.uniform(0.0, 11 * DX, 7)
    gap = 1e-9
    points = [(lines + side * gap, along) if axis == 0 else (along, lines + side * gap) for side in (-1, 1)]
    before, after = (np.array(surface.sample(*point)) for point in points)
    # a jump would be of order 1; the Hessian, of order 10, moves the gradient by 2e-8
    np.testing.assert_allclose(before[:3], after[:3], rtol=0, atol=1e-6)
    assert np.abs(before[3:] - after[3:]).max() > 1e-3  # C1, not C2: the test can tell


def test_derivatives_are_those_of_the_values(rough):
    surface = Surface(0.01 * rough, (DX, DY))  # bends of less than 45 degrees: no slope is limited
    rng = np.random.default_rng(4)
    step = 1e-5
    # away from the cell borders, where second derivatives jump
    x = (rng.integers(0, 11, 100) + rng.uniform(0.01, 0.99, 100)) * DX
    y = (rng.integers(0, 8, 100) + rng.uniform(0.01, 0.99, 100)) * DY
    east, west = np.array(surface.sample(x + step, y)), np.array(surface.sample(x - step, y))
    north, south = np.array(surface.sample(x, y + step)), np.array(surface.sample(x, y - step))
    _, zx, zy, zxx, zxy, zyy = surface.sample(x, y)
    by_x, by_y = (east - west) / (2 * step), (north - south) / (2 * step)
    # central differences: third derivatives of order 1 times step^2, and round-off 1e-16/1e-5
    np.testing.assert_allclose(by_x[:3], [zx, zxx, zxy], rtol=0, atol=1e-7)
    np.testing.assert_allclose(by_y[:3], [zy, zxy, zyy], rtol=0, atol=1e-7)


@pytest.mark.parametrize("inside", [False, True])
def test_values_of_closed_nodes_are_never_read(rough, inside):
    closed = np.zeros(rough.shape, bool)
    closed[:, 0] = closed[:2, :3] = closed[8, :] = True
    closed[4, 5] = closed[5, 6] = inside
    rng = np.random.default_rng(5)
    x, y = rng.uniform(0.0, 11 * DX, 500), rng.uniform(0.0, 8 * DY, 500)
    reads = []
    for value in (-9999.0, 1e30, np.nan):
        z = np.where(closed, value, rough)
        reads.append(Surface(z, (DX, DY), closed).sample(x, y))
    np.testing.assert_array_equal(reads[0], reads[1])
    np.testing.assert_array_equal(reads[0], reads[2])
    assert abs(reads[0][0]).max() < 200.0  # extrapolated from neighbours of order 10 to 30


def test_a_plane_goes_on_below_closed_nodes():
    shape = (8, 10)
    x, y = nodes_of(shape)
    plane = (0.5 * x - 0.25 * y).reshape(shape)
    closed = np.zeros(shape, bool)
    closed[:, :3] = True
    surface = Surface(np.where(closed, -9999.0, plane), (DX, DY), closed)
    rng = np.random.default_rng(6)
    px, py = rng.uniform(2.5 * DX, 9 * DX, 50), rng.uniform(0.0, 7 * DY, 50)  # a particle may touch half a cell
    np.testing.assert_allclose(surface.sample(px, py)[0], 0.5 * px - 0.25 * py, rtol=0, atol=1e-12)  # round-off


def test_moving_a_node_moves_the_surface_there_only(rough):
    surface, moved = Surface(rough, (DX, DY)), rough.copy()
    moved[4, 5] -= 1.0
    surface.move_to(np.array([4 * 12 + 5]), np.array([moved[4, 5]]))
    x, y = nodes_of(rough.shape)
    again = Surface(moved, (DX, DY))
    # values of order 10: round-off
    np.testing.assert_allclose(surface.sample(x + 0.3, y + 0.3), again.sample(x + 0.3, y + 0.3), rtol=0, atol=1e-13)


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("height", [1.0, 50.0, -200.0])
def test_a_cliff_has_no_dam_along_its_edge_and_no_ditch_at_its_foot(axis, height):
    """Cubic convolution alone overshoots by 2/27 of the height on either side."""
    index = np.mgrid[:8, :12][1 - axis]
    surface = Surface(np.where(index < 4, 0.0, height), (DX, DY))
    along = np.linspace(1.0, 6.0, 501) * (DX, DY)[axis]
    across = np.full(501, 2.3 * (DY, DX)[axis])
    z = surface.sample(along, across)[0] if axis == 0 else surface.sample(across, along)[0]
    low, high = min(0.0, height), max(0.0, height)
    over = max(low - z.min(), z.max() - high) / abs(height)
    bend = abs(height) / (DX, DY)[axis]  # over the spacing: limited from 1 on, wholly from 2
    assert over < 1e-15 if bend >= 2.0 else over == pytest.approx(2.0 / 27.0, rel=1e-4)


def test_slope_x_is_not_limited_along_y():
    """Along the edge of a cliff that falls with y, dz/dx is off by 2/27 of its change; dz/dy is exact."""
    row, column = np.mgrid[:8, :12]
    surface = Surface(np.where(row < 4, 100.0 + column * DX, 0.0), (DX, DY))  # dz/dx is 1 above the cliff, 0 below
    x, y = np.meshgrid(np.linspace(6.3, 15.7, 20), np.linspace(6.3, 28.7, 501))
    x, y, small = x.ravel(), y.ravel(), 1e-5
    sample = surface.sample(x, y)
    slope_x = (surface.sample(x + small, y)[0] - surface.sample(x - small, y)[0]) / (2.0 * small)
    slope_y = (surface.sample(x, y + small)[0] - surface.sample(x, y - small)[0]) / (2.0 * small)
    # measured 2/27 less 1e-6, at the points nearest to a third of a node from the edge
    assert abs(sample.slope_x - slope_x).max() == pytest.approx(2.0 / 27.0, rel=1e-4)
    # the curvature, 24 per m at most, jumps on lines of nodes
    np.testing.assert_allclose(sample.slope_y, slope_y, rtol=0, atol=0.5 * 24.0 * small)


def test_elevation_alone_is_that_of_the_whole_reading(rough):
    surface, rng = Surface(rough, (DX, DY)), np.random.default_rng(4)
    x, y = rng.uniform(-DX, 12 * DX, 200), rng.uniform(-DY, 9 * DY, 200)
    z = np.empty(200)
    surface.elevation_into(x, y, z)
    # the same polynomial; terms of up to 1e3 m, beyond the rim, may be added in another order
    np.testing.assert_allclose(z, surface.sample(x, y).elevation, rtol=0, atol=1e-12)
