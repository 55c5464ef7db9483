"""The erodible ledger: particles on a node share what is left, and nothing is taken twice."""

import numpy as np
import pytest

from landlab_debrisflow.spatial.raster import CLOSED, CORE, Raster
from landlab_debrisflow.spatial.transfer import Cover
from landlab_debrisflow.terrain.bed import Bed
from landlab_debrisflow.terrain.surface import Surface

SHAPE, DX, DY = (7, 8), 2.0, 4.0  # powers of two: weights of nodes out of reach are exactly zero
AREA = DX * DY


def make_bed(soil, ratio=None):
    size = SHAPE[0] * SHAPE[1]
    elevation = 100.0 + np.random.default_rng(1).normal(0.0, 1.0, size)
    soil = None if soil is None else np.broadcast_to(np.asarray(soil, float), size).copy()
    ratio = np.full(size, 0.65) if ratio is None else ratio
    surface = Surface(elevation.reshape(SHAPE), (DX, DY))
    return Bed(raster(), surface, elevation, soil, np.zeros(size), ratio)


def raster():
    status = np.full(SHAPE, CLOSED)
    status[1:-1, 1:-1] = CORE
    return Raster.from_status(status, (DX, DY))


COVER = Cover(raster())  # one for all, as a bed has one: nodes keep their slots


def lying(x, y, half_width):
    """Return the footprints of particles by place and half-width of their hat functions [m]."""
    ones = np.ones(x.size)
    return COVER.footprints(x, y, 0.25 * half_width**2, ones, ones)


@pytest.fixture
def places():
    """Where forty particles are, on few nodes."""
    rng = np.random.default_rng(2)
    return rng.uniform(0.6 * DX, 6.4 * DX, 40), rng.uniform(0.6 * DY, 5.4 * DY, 40)


@pytest.fixture
def crowd(places):
    """Their footprints, with hat functions up to four cells wide."""
    return lying(*places, np.random.default_rng(2).uniform(0.1, 8.0, 40))


def test_granted_is_what_is_asked_while_there_is_enough(crowd):
    bed = make_bed(1.0)
    wanted = np.full(40, 0.01)
    granted, ratio = bed.erode(crowd, wanted)
    np.testing.assert_allclose(granted, wanted, rtol=1e-14)  # weights sum to one up to round-off
    np.testing.assert_allclose(ratio, 0.65, rtol=1e-14)


@pytest.mark.parametrize("wanted", [0.01, 1.0, 100.0])
def test_granted_is_taken_and_never_past_the_erodible_depth(crowd, wanted):
    soil = np.random.default_rng(3).uniform(0.0, 0.5, SHAPE[0] * SHAPE[1])
    soil[20:24] = 0.0
    bed = make_bed(soil)
    elevation, total = bed.elevation.copy(), 0.0
    for _ in range(30):
        granted, _ = bed.erode(crowd, np.full(40, wanted))
        assert np.all(granted >= 0.0) and np.all(granted <= wanted * (1.0 + 1e-14))
        total += granted.sum()
    assert np.all(bed.soil >= 0.0)  # exactly: the ledger takes the smaller one
    taken = soil - bed.soil
    # 30 grants of 40 particles: round-off of a thousand additions
    assert taken.sum() * AREA == pytest.approx(total, rel=1e-13)
    # dz = d soil up to the last digits of an elevation of 100 m
    np.testing.assert_allclose(elevation - bed.elevation, taken, rtol=0, atol=3e-14)
    np.testing.assert_allclose(bed.eroded_depth, taken, rtol=0, atol=1e-15)
    if wanted == 100.0:
        assert np.all(bed.soil[np.flatnonzero(taken)] < 1e-12)  # used up


def test_particles_on_one_node_share_what_is_left_by_what_they_ask():
    bed = make_bed(0.1)
    x, y = np.full(2, 3 * DX), np.full(2, 3 * DY)  # on node (3, 3), no wider than the spacing
    granted, _ = bed.erode(lying(x, y, np.full(2, 0.5)), np.array([1.0, 3.0]))
    np.testing.assert_allclose(granted, 0.1 * AREA * np.array([0.25, 0.75]), rtol=1e-14)
    granted, ratio = bed.erode(lying(x, y, np.full(2, 0.5)), np.array([1.0, 3.0]))
    assert np.all(granted == 0.0) and np.all(ratio == 0.0)


def test_the_ratio_is_that_of_the_soil_given():
    ratio = np.zeros(SHAPE).ravel()
    ratio[3 * SHAPE[1] + 3], ratio[3 * SHAPE[1] + 4] = 0.2, 0.8
    soil = np.zeros(SHAPE).ravel()
    soil[3 * SHAPE[1] + 3] = 1.0
    x, y = np.array([3.5 * DX]), np.array([3.0 * DY])  # half way, but only the first node has soil
    _, got = make_bed(soil, ratio).erode(lying(x, y, np.array([0.1])), np.array([0.01]))
    assert got[0] == pytest.approx(0.2, rel=1e-14)
    _, got = make_bed(1.0, ratio).erode(lying(x, y, np.array([0.1])), np.array([0.01]))
    assert got[0] == pytest.approx(0.5, rel=1e-14)


def test_boundary_nodes_are_left_alone(crowd):
    bed = make_bed(1.0)
    before = bed.elevation.copy()
    bed.erode(crowd, np.full(40, 0.1))
    bed.lay_down(*bed.depth_of(crowd, np.full(40, 0.1)))
    rim = ~bed.raster.core
    np.testing.assert_array_equal(bed.elevation[rim], before[rim])
    assert np.all(bed.soil[rim] == 1.0)


@pytest.mark.parametrize("soil", [None, 0.5])
def test_what_is_laid_down_is_all_there(crowd, soil):
    bed = make_bed(soil)
    before = bed.elevation.copy()
    volume = np.random.default_rng(4).uniform(0.1, 1.0, 40)
    nodes, depth = bed.depth_of(crowd, volume)
    bed.lay_down(nodes, depth)
    assert depth.sum() * AREA == pytest.approx(volume.sum(), rel=1e-14)
    np.testing.assert_allclose((bed.elevation - before)[nodes], depth, rtol=0, atol=3e-14)  # last digits of 100 m
    if soil is not None:
        np.testing.assert_array_equal(bed.soil[nodes], soil + depth)


def test_the_surface_follows_the_bed(crowd, places):
    bed = make_bed(1.0)
    bed.erode(crowd, np.full(40, 0.5))
    again = Surface(bed.elevation.reshape(SHAPE), (DX, DY))
    # up to the edge; values of 100 m and their derivatives: round-off
    np.testing.assert_allclose(bed.surface.sample(*places), again.sample(*places), rtol=0, atol=1e-12)


def test_a_bed_without_soil_grants_nothing(crowd):
    granted, ratio = make_bed(None).erode(crowd, np.ones(40))
    assert not granted.any() and not ratio.any()
