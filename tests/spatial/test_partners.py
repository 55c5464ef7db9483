"""Partners against all pairs, and the same pairs by the other phase."""

import numpy as np
import pytest

from landlab_debrisflow.spatial.cells import cells_of_phase, sort_into_cells
from landlab_debrisflow.spatial.packing import Position
from landlab_debrisflow.spatial.partners import MOST_PARTNERS, NEAREST, PARTNER_RADIUS, find_partners, reverse


def mixture(count, seed, spread=3.0, side=12.0):
    """Return positions, volumes, smoothing lengths and whether each of `count` particles is of water, in any order."""
    random = np.random.default_rng(seed)
    position = Position(*random.uniform(0.0, side, (2, count)), random.uniform(0.0, 0.5, count))
    return position, random.uniform(0.5, 2.0, count), random.uniform(1.0, spread, count), random.random(count) < 0.5


def found(position, volume, length, water, particles=None):
    """Return the partners of the grains; `particles` are those that are no ghosts, the first ones."""
    particles = water.size if particles is None else particles
    cells = sort_into_cells(position.x, position.y, 2.0 * length)
    of_phases = cells_of_phase(cells, ~water), cells_of_phase(cells, water)
    here = Position(*(values[:particles] for values in position))
    return find_partners(*of_phases, here, volume[:particles], length[:particles])


@pytest.mark.parametrize("ghosts", [0, 60])
def test_they_are_all_in_reach_with_the_weights_of_their_distance(ghosts):
    position, volume, length, water = mixture(300, 1)
    position.x[np.flatnonzero(~water)[0]] = 40.0  # a grain without water around
    partners, many = found(position, volume, length, water, 300 - ghosts), 300 - ghosts
    assert np.array_equal(partners.of, np.flatnonzero(~water[:many]))
    counts = []
    for k, i in enumerate(partners.of):
        here = slice(partners.first[k], partners.first[k + 1])
        r2 = sum((values[:many] - values[i]) ** 2 for values in position)
        radius = PARTNER_RADIUS * length[i]
        near = np.flatnonzero(water[:many] & (r2 < radius**2))
        assert sorted(partners.index[here]) == near.tolist()
        weight = volume[:many] * (1.0 - np.sqrt(r2) / radius) ** 2 / (r2 + (NEAREST * radius) ** 2)
        if near.size:
            # rounding of the sum, and of 1 - r/R where this is nearly 0
            exact = (weight / weight[near].sum())[partners.index[here]]
            np.testing.assert_allclose(partners.weight[here], exact, rtol=1e-12, atol=1e-14)
        counts.append(near.size)
    assert min(counts) == 0 and max(counts) > 12 and partners.first[-1] == sum(counts)


def test_there_are_no_more_than_there_is_room_for():
    position, volume, length, water = mixture(400, 2, side=2.0)
    partners = found(position, volume, length, water)
    counts = np.diff(partners.first)
    assert counts.max() == MOST_PARTNERS and counts.size == (~water).sum()
    sums = np.add.reduceat(partners.weight, partners.first[:-1])
    np.testing.assert_allclose(sums, 1.0, rtol=1e-14)  # 32 roundings


def test_reversed_pairs_are_the_same_pairs():
    position, volume, length, water = mixture(300, 3)
    position.x[np.flatnonzero(water)[7]] = 40.0  # water that is nobody's partner
    partners = found(position, volume, length, water)
    grains = reverse(partners, np.flatnonzero(water))
    assert grains.of.size == water.sum() and np.any(np.diff(grains.first) == 0)
    by_grain = np.repeat(partners.of, np.diff(partners.first)), partners.index, partners.weight
    by_water = partners.of[grains.index], np.repeat(grains.of, np.diff(grains.first)), grains.weight
    one, other = (np.lexsort(pairs[1::-1]) for pairs in (by_grain, by_water))
    for a, b in zip(by_grain, by_water, strict=True):
        assert np.array_equal(a[one], b[other])
    for k in range(grains.of.size):  # in the order of the grains, so that sums do not depend on anything else
        assert np.all(np.diff(grains.index[grains.first[k] : grains.first[k + 1]]) > 0)
