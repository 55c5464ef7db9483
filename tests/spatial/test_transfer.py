"""Particles to nodes and back: nothing is lost, nothing falls outside, constants stay constant."""

import numpy as np
import pytest

from landlab_debrisflow.spatial.raster import CLOSED, CORE, Raster
from landlab_debrisflow.spatial.transfer import WIDEST, scatter

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
    return x, y, rng.uniform(0.0, 6.0 * DX, 300)


def add(raster, particles, values):
    """Return the nodes reached and the sums, shape (k, nodes), of values, shape (k, n)."""
    sums = np.zeros((ROWS * COLUMNS, values.shape[0]))
    at = scatter(raster, *particles, values.T, sums, np.empty(ROWS * COLUMNS, np.int64))
    return at.copy(), sums.T


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


@pytest.mark.parametrize("asked", [0.5, 1.0, 2.5, WIDEST, 10.0])
def test_the_hat_function_is_as_wide_as_the_particle_within_limits(asked):
    raster, centre = Raster.from_status(np.full((21, 21), CORE), (1.0, 1.0)), np.array([10.0])
    sums = np.zeros((441, 1))
    scatter(raster, centre, centre, np.array([asked]), np.ones((1, 1)), sums, np.empty(441, np.int64))
    half_width = min(max(asked, 1.0), WIDEST)
    hat = np.maximum(0.0, 1.0 - abs(np.arange(21) - 10.0) / half_width)
    expected = np.outer(hat, hat) / hat.sum() ** 2
    np.testing.assert_allclose(sums.reshape(21, 21), expected, rtol=0, atol=1e-15)  # round-off


def test_a_particle_beside_the_edge_keeps_its_volume_inside(raster):
    particles = np.array([0.5 * DX]), np.array([0.5 * DY]), np.array([0.1])
    at, sums = add(raster, particles, np.ones((1, 1)))
    assert at.tolist() == [COLUMNS + 1] and sums[0, COLUMNS + 1] == 1.0
