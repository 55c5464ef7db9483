"""Particles to nodes: nothing is lost, nothing falls outside, and a flow ends where its particles end."""

import numpy as np
import pytest

from landlab_debrisflow.spatial.footprints import on_nodes
from landlab_debrisflow.spatial.raster import CLOSED, CORE, Raster
from landlab_debrisflow.spatial.transfer import WIDEST, Cover, scatter, sharpened_cover

ROWS, COLUMNS, DX, DY = 9, 12, 2.0, 3.0


@pytest.fixture
def raster():
    status = np.full((ROWS, COLUMNS), CLOSED)
    status[1:-1, 1:-1] = CORE
    status[4, 5] = status[6, 2] = CLOSED
    return Raster.from_status(status, (DX, DY))


@pytest.fixture
def particles():
    """Where particles may be: their nearest node is a core node; hat functions from a point to wider than allowed."""
    rng = np.random.default_rng(1)
    x, y = rng.uniform(0.51 * DX, 10.49 * DX, 300), rng.uniform(0.51 * DY, 7.49 * DY, 300)
    return x, y, rng.uniform(0.01, 3.0 * DX, 300)


def lying(raster, x, y, spacing):
    """Return footprints of particles 1 m deep, by place and spacing, shape (n,) [m]."""
    ones = np.ones(x.size)
    return Cover(raster).footprints(x, y, spacing**2, ones, ones)


def add(raster, particles, values):
    """Return the nodes reached and the sums, shape (k, nodes), of values, shape (k, n)."""
    nodes = raster.status.size
    sums = np.zeros((nodes, values.shape[0]))
    at = scatter(on_nodes(lying(raster, *particles)), values.T, sums, np.empty(nodes, np.int64))
    return at.copy(), sums.T


def depth_of(particles, size=60):
    """Return the depth of particles 1 m deep on core nodes 1 m apart, shape (size, size) [m]."""
    raster = Raster.from_status(np.full((size, size), CORE), (1.0, 1.0))
    return add(raster, particles, particles[2][None] ** 2)[1].reshape(size, size)


def filled(spacing, west, east, south, north):
    """Return particles on a square lattice that fill a rectangle whose sides are multiples of their spacing [m]."""
    x, y = np.meshgrid(np.arange(west + spacing / 2, east, spacing), np.arange(south + spacing / 2, north, spacing))
    return x.ravel(), y.ravel(), np.full(x.size, spacing)


def test_amounts_are_conserved_and_only_core_nodes_get_any(raster, particles):
    values = np.random.default_rng(2).uniform(0.1, 1.0, (3, 300))
    at, sums = add(raster, particles, values)
    np.testing.assert_allclose(sums.sum(axis=1), values.sum(axis=1), rtol=1e-14)  # round-off of 300 additions
    assert not sums[:, ~raster.core].any()
    assert sorted(at) == sorted(np.flatnonzero(sums[0]))  # each once
    assert np.all(sums >= 0.0)


def test_particles_without_volume_do_not_count(raster, particles):
    values = np.ones((2, 300))
    values[0, 50:] = 0.0
    _, sums = add(raster, particles, values)
    np.testing.assert_allclose(sums.sum(axis=1), 50.0, rtol=1e-14)


@pytest.mark.parametrize("spacing", [0.25, 0.5, 1.25, 0.5 * WIDEST, 5.0])
def test_one_alone_is_a_hat_function_sharpened_where_its_own_cover_is_low(spacing):
    depth = depth_of((np.array([10.0]), np.array([10.0]), np.array([spacing])), 21)
    width = min(max(2.0 * spacing, 1.0), WIDEST)
    hat = np.maximum(0.0, 1.0 - abs(np.arange(21) - 10.0) / width)
    hat = np.outer(hat, hat) / hat.sum() ** 2
    if width > 1.0:
        covered = hat / hat.max()
        away = (1.0 - np.sqrt(2.0 * np.minimum(covered, 1.0 - covered))) * width  # from the edge, in nodes
        sharp = 0.5 * np.maximum(0.0, 1.0 - away) ** 2
        hat = np.where(covered <= 0.5, sharp, 1.0 - sharp) * hat.max()
    np.testing.assert_allclose(depth, spacing**2 * hat / hat.sum(), rtol=0, atol=1e-14)  # round-off


def test_sharpened_cover_is_that_of_the_node_spacing_at_the_same_distance():
    distance = np.linspace(-1.0, 1.0, 41)  # beyond the edge, in half-widths

    def cover(d):
        return np.where(d > 0.0, 0.5 * np.maximum(0.0, 1.0 - d) ** 2, 1.0 - 0.5 * np.maximum(0.0, 1.0 + d) ** 2)

    for blur in (1.0, 0.6, 0.25):
        found = [sharpened_cover(float(c), blur) for c in cover(distance)]
        np.testing.assert_allclose(found, cover(distance / blur), rtol=0, atol=1e-7)  # the root of a rounded cover


@pytest.mark.parametrize("spacing", [0.25, 0.5, 0.8, 1.0, 1.25, 2.0])
@pytest.mark.parametrize("offset", [0.05, 0.35, 0.65, 0.95])
def test_an_edge_is_blurred_by_one_node_whatever_the_particles(spacing, offset):
    west = 10.0 + offset
    depth = depth_of(filled(spacing, west, west + 40.0, 10.25, 50.25))
    beyond = west - np.arange(5, 18)
    even = np.where(
        beyond > 0.0, 0.5 * np.maximum(0.0, 1.0 - beyond) ** 2, 1.0 - 0.5 * np.maximum(0.0, 1.0 + beyond) ** 2
    )
    # that of even matter, up to its lattice, and to what normalising the weights moves inwards: measured .062 at most;
    # whole hat functions, 2 wide on each side, miss it by .28 with a spacing of 1 and by .39 with 2
    assert abs(depth[30, 5:18] - even).max() < 0.07
    # out of reach of the edge a square lattice ripples: by .6 %, and by 4.2 % with a spacing of .8 (whole hats: 7.9 %)
    assert abs(depth[20:41, 20:41] - 1.0).max() < (0.05 if spacing == 0.8 else 0.01)


@pytest.mark.parametrize("place", [30.0, 30.3, 30.5])
@pytest.mark.parametrize("spacing", [1.0, 2.0])
def test_a_single_file_keeps_a_footprint(place, spacing):
    """Its cover is half at most: the edge is where it is half of that, a spacing beside the middle, and blurred."""
    x = np.arange(5.0, 55.0, spacing)
    depth = depth_of((x, np.full(x.size, place), np.full(x.size, spacing)))
    rows = np.flatnonzero(depth[:, 20:40].any(axis=1))
    away = abs(np.arange(60) - place)
    assert set(np.flatnonzero(away <= 0.5 * spacing)) <= set(rows) <= set(np.flatnonzero(away <= spacing + 1.0))


def test_a_symmetric_flow_is_sharpened_on_both_sides_alike():
    depth = depth_of(filled(1.5, 15.0, 45.0, 15.0, 45.0), 61)
    for turned in (depth[::-1], depth[:, ::-1], depth.T):
        np.testing.assert_allclose(depth, turned, rtol=0, atol=1e-13)  # order of additions


def test_a_wall_is_no_edge():
    """A flow that fills the ground between walls is on every node, also in the corners."""
    status = np.full((12, 12), CLOSED)
    status[1:-1, 1:-1] = CORE
    raster = Raster.from_status(status, (1.0, 1.0))
    at, sums = add(raster, filled(2.0, 0.5, 10.5, 0.5, 10.5), np.full((1, 25), 4.0))
    assert sorted(at) == np.flatnonzero(raster.core).tolist()
    assert sums[0].sum() == pytest.approx(100.0, rel=1e-14)


def test_two_phases_in_one_place_cover_it_once():
    """Their volumes are halves, at the depth of both: the same nodes as of one phase, and the same depth."""
    x, y, spacing = filled(1.5, 15.3, 45.3, 15.3, 45.3)
    raster = Raster.from_status(np.full((60, 60), CORE), (1.0, 1.0))
    twice, half = np.tile([x, y], 2), np.full(2 * x.size, 0.5)
    found = Cover(raster).footprints(*twice, half * 1.5**2, np.ones(2 * x.size), half)
    sums = np.zeros((3600, 1))
    scatter(on_nodes(found), half[:, None] * 1.5**2, sums, np.empty(3600, np.int64))
    np.testing.assert_allclose(sums[:, 0], depth_of((x, y, spacing)).ravel(), rtol=0, atol=1e-14)


def test_footprints_are_found_anew_only_if_something_has_changed(raster, particles):
    x, y, spacing = particles
    cover, volume, depth, fraction = Cover(raster), spacing**2, np.ones(300), np.ones(300)
    given = x, y, volume, depth, fraction
    first = cover.footprints(*given)
    assert cover.footprints(*(values.copy() for values in given)) is first
    for values in given:
        values[299] *= 1.0 - 1e-12
        again = cover.footprints(*given)
        assert again is not first
        first = again
    shorter = cover.footprints(*(values[:50] for values in given))
    np.testing.assert_array_equal(shorter[3], lying(raster, x[:50], y[:50], np.sqrt(volume[:50]))[3])


def test_a_particle_beside_the_edge_keeps_its_volume_inside(raster):
    particles = np.array([0.5 * DX]), np.array([0.5 * DY]), np.array([0.1])
    at, sums = add(raster, particles, np.ones((1, 1)))
    assert at.tolist() == [COLUMNS + 1] and sums[0, COLUMNS + 1] == 1.0
