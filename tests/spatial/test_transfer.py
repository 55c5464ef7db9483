"""Particles to nodes: nothing is lost, nothing falls outside, and a flow ends where its particles end."""

import numpy as np
import pytest

from landlab_debrisflow.spatial.raster import CLOSED, CORE, Raster
from landlab_debrisflow.spatial.transfer import COVERED, NARROW, WIDEST, Cover, scatter

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
    at = scatter(lying(raster, *particles), values.T, sums, np.empty(nodes, np.int64))
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
def test_one_alone_is_a_hat_function_cut_where_its_own_cover_is_low(spacing):
    depth = depth_of((np.array([10.0]), np.array([10.0]), np.array([spacing])), 21)
    hat = np.maximum(0.0, 1.0 - abs(np.arange(21) - 10.0) / min(max(2.0 * spacing, 1.0), WIDEST))
    hat = np.outer(hat, hat) / hat.sum() ** 2
    cover = spacing**2 * hat  # and, 1 m deep, its depth
    hat[cover < min(COVERED / max(1.0, cover.max()) ** 0.5, NARROW * cover.max())] = 0.0
    np.testing.assert_allclose(depth, spacing**2 * hat / hat.sum(), rtol=0, atol=1e-14)  # round-off


@pytest.mark.parametrize("spacing", [0.25, 0.5, 1.0, 2.0])
@pytest.mark.parametrize("offset", [0.05, 0.35, 0.65, 0.95])
def test_a_flow_ends_at_its_edge(spacing, offset):
    west, east = 10.0 + offset, 50.0 + offset
    depth = depth_of(filled(spacing, west, east, 10.25, 50.25))
    columns = np.flatnonzero(depth.any(axis=0))
    # the cover, 1/2 at the edge, changes by 1 over a half-width there; it and the depth ripple by 0.6 % on a lattice
    beyond = 0.02 * max(2.0 * spacing, 1.0)
    assert np.all((columns > west - beyond) & (columns < east + beyond))
    assert columns[0] < west + 1.0 + beyond and columns[-1] > east - 1.0 - beyond  # no node inside is left out
    # out of reach of the cut: hat functions on a square lattice ripple by up to 0.6 % there
    assert abs(depth[20:41, 20:41] - 1.0).max() < 0.01


def test_without_the_cut_that_test_fails(monkeypatch):
    """A hat function of two spacings puts a tenth of the depth 0.55 of its half-width beyond the edge."""
    body = filled(2.0, 10.05, 50.05, 10.25, 50.25)
    assert depth_of(body)[30, 52] == 0.0
    monkeypatch.setattr("landlab_debrisflow.spatial.transfer._find_footprints", whole_hat_functions)
    assert depth_of(body)[30, 52] > 0.1


def whole_hat_functions(raster, x, y, volume, depth, fraction, *scratch):
    """Return footprints as wide as hat functions are, of particles of a spacing of 2 m far from any boundary."""
    across = np.maximum(0.0, 1.0 - abs(x[:, None] - np.arange(raster.columns)) / 4.0)
    along = np.maximum(0.0, 1.0 - abs(y[:, None] - np.arange(raster.rows)) / 4.0)
    weight = (along[:, :, None] * across[:, None, :]).reshape(x.size, -1)
    particle, node = np.nonzero(weight)
    ends = np.searchsorted(particle, np.arange(x.size + 1))
    return None, (ends[:-1], ends[1:], node, (weight / weight.sum(axis=1)[:, None])[particle, node])


@pytest.mark.parametrize("place", [30.0, 30.3, 30.5])
@pytest.mark.parametrize("spacing", [1.0, 2.0])
def test_a_single_file_is_as_wide_as_its_spacing(place, spacing):
    x = np.arange(5.0, 55.0, spacing)
    depth = depth_of((x, np.full(x.size, place), np.full(x.size, spacing)))
    rows = np.flatnonzero(depth[:, 20:40].any(axis=1))
    away = abs(np.arange(60) - place)
    assert set(np.flatnonzero(away <= 0.5 * spacing)) <= set(rows)
    # the largest cover is that of a node, which is up to half a node off the middle of the file
    assert set(rows) <= set(np.flatnonzero(away <= 0.5 * spacing + 0.5 * NARROW))


def test_a_symmetric_flow_is_cut_on_both_sides_alike():
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
    scatter(found, half[:, None] * 1.5**2, sums, np.empty(3600, np.int64))
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
