"""Sums over neighbours of odd sets of particles, against all pairs in double precision."""

import numpy as np
import pytest

from landlab_debrisflow.spatial.cells import cells_of_phase, sort_into_cells
from landlab_debrisflow.spatial.cross_summation import CrossPhaseInput, CrossPhaseSums, sum_over_other_phase
from landlab_debrisflow.spatial.packing import Position
from landlab_debrisflow.spatial.summation import SummationInput, Sums, sum_over_neighbours

VISCOSITY = 0.8

ROUNDING = 1e-5
"""As the engine promises, relative to the largest; floats are rounded to 6e-8, reciprocal roots to 3e-7."""


def particles(count, x, y, **others):
    """Return the input of the sums, with some variety in all that is not given."""
    rng = np.random.default_rng(count)
    state = {
        "x": np.broadcast_to(x, count) + 0.0, "y": np.broadcast_to(y, count) + 0.0, "z": rng.uniform(0.0, 1.0, count),
        "velocity": rng.normal(0.0, 1.0, (3, count)), "volume": rng.uniform(1.0, 2.0, count),
        "length": rng.uniform(1.0, 1.5, count), "strength": rng.uniform(4.0, 9.0, count),
        "celerity": rng.uniform(1.0, 3.0, count), "thickness": rng.uniform(0.5, 2.0, count),
        "thickening": rng.normal(0.0, 1.0, count), "inertia": rng.uniform(0.5, 2.0, count),
    }  # fmt: skip
    return {**state, **others}


def sums(c, count=None):
    """Return thickness, grad-h term, next length, acceleration and thickening of the first `count` particles."""
    n = c["x"].size if count is None else count
    out = Sums(np.empty(n), np.empty(n), np.empty(n), np.empty((3, n)), np.empty(n))
    cells = sort_into_cells(c["x"], c["y"], 2.0 * c["length"])
    given = SummationInput(
        Position(c["x"], c["y"], c["z"]), c["velocity"], c["volume"], c["length"], c["length"], c["strength"],
        c["celerity"], c["thickness"], c["thickening"], c["inertia"],
    )  # fmt: skip
    sum_over_neighbours(cells, given, VISCOSITY, out)
    return out


def all_pairs(c):
    """Return thickness, acceleration and thickening by the formulas of `sum_over_neighbours` in double precision."""
    apart = np.array([c[axis][:, None] - c[axis] for axis in "xyz"])
    apart_v = c["velocity"][:, :, None] - c["velocity"][:, None, :]
    r, length = np.sqrt((apart**2).sum(axis=0)), c["length"][:, None]
    q = np.minimum(1.0, r / (2.0 * length))
    weight = 7.0 / (4.0 * np.pi * length**2) * (1.0 - q) ** 4 * (1.0 + 4.0 * q)
    weight[np.diag_indices(r.shape[0])] *= 0.9764
    slope = -35.0 / (4.0 * np.pi * length**4) * (1.0 - q) ** 3  # dW/dr over r
    closing, k = -(apart_v * apart).sum(axis=0), 0.5 * np.maximum(0.0, c["thickening"] / c["thickness"])
    w = np.maximum(0.0, closing - np.minimum(k[:, None], k) * r * r) / np.maximum(r, 1e-300)
    larger = np.maximum(c["thickness"][:, None], c["thickness"])
    shock = 0.25 * VISCOSITY * (c["celerity"][:, None] + c["celerity"] + 3.0 * w) * w / larger
    pair = (c["strength"][:, None] + shock) * slope + (c["strength"] + shock) * slope.T
    force = -np.einsum("j,ij,kij->ki", c["volume"], pair, apart)
    return weight @ c["volume"], force / c["inertia"], np.einsum("j,ij,ij->i", c["volume"], slope, -closing)


RNG = np.random.default_rng(7)

CASES = {
    "one": particles(1, 3.0, 4.0),
    "a dozen in one place": particles(12, 3.0, 4.0, z=np.full(12, 1.0)),
    "a row": particles(100, np.linspace(0.0, 60.0, 100), 0.0),
    "a column": particles(100, 0.0, np.linspace(0.0, 60.0, 100)),
    "two bodies 100 km apart": particles(200, RNG.uniform(0.0, 8.0, 200) + 1e5 * (np.arange(200) % 2), 0.0),
    "supports that differ by 1000": particles(
        300, RNG.uniform(0.0, 2000.0, 300), RNG.uniform(0.0, 2000.0, 300),
        length=np.where(np.arange(300) % 10 == 0, 1000.0, RNG.uniform(1.0, 2.0, 300)),
        volume=np.where(np.arange(300) % 10 == 0, 1e6, 1.0), thickness=np.ones(300),
    ),
    "pulls by negative volumes": particles(
        400, RNG.uniform(0.0, 20.0, 400), RNG.uniform(0.0, 20.0, 400), volume=np.repeat([1.0, -0.8], 200)
    ),
    "a steep wall": particles(300, RNG.uniform(0.0, 10.0, 300), RNG.uniform(0.0, 10.0, 300), z=RNG.uniform(0, 80, 300)),
}  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_the_sums_are_those_over_all_pairs(name):
    c = CASES[name]
    found, (thickness, acceleration, thickening) = sums(c), all_pairs(c)
    np.testing.assert_allclose(found.thickness, thickness, rtol=0, atol=ROUNDING * abs(thickness).max())
    largest = np.hypot(*abs(acceleration).max(axis=1)[:2])
    np.testing.assert_allclose(found.acceleration, acceleration, rtol=0, atol=ROUNDING * largest + 1e-300)
    atol = ROUNDING * abs(thickening).max() + 1e-300
    np.testing.assert_allclose(found.convergence, thickening, rtol=0, atol=atol)


def test_order_in_memory_matters_no_more_than_rounding():
    c = particles(500, RNG.uniform(0.0, 20.0, 500), RNG.uniform(0.0, 20.0, 500))
    mixed = RNG.permutation(500)
    for one, other in zip(sums(c), sums({name: values[..., mixed] for name, values in c.items()}), strict=True):
        np.testing.assert_allclose(one[..., mixed], other, rtol=0, atol=2e-6 * abs(one).max())


def test_a_ghost_beside_the_last_particle_acts_alone():
    c = particles(18, np.append(np.full(17, 5.0), 6.0), np.append(np.linspace(0.0, 3.0, 17), 3.0))
    found, (thickness, acceleration, _) = sums(c, 17), all_pairs(c)
    np.testing.assert_allclose(found.thickness, thickness[:17], rtol=ROUNDING)
    size = abs(acceleration).max()
    np.testing.assert_allclose(found.acceleration, acceleration[:, :17], rtol=0, atol=ROUNDING * size)


@pytest.mark.parametrize("name", ["velocity", "volume", "strength", "celerity", "thickness"])
def test_what_is_not_a_number_stays_so(name):
    c = particles(200, RNG.uniform(0.0, 12.0, 200), RNG.uniform(0.0, 12.0, 200))
    c[name] = c[name].copy()
    c[name][..., 77] = np.nan
    assert not all(np.isfinite(values[..., 77]).all() for values in sums(c))


@pytest.mark.parametrize("name", ["two bodies 100 km apart", "supports that differ by 1000", "a row"])
def test_sums_over_the_other_phase_are_those_over_all_its_particles(name):
    c, averaged = CASES[name], RNG.uniform(1.0, 2.0, CASES[name]["x"].size)
    n, water = averaged.size, np.arange(averaged.size) % 3 == 0
    cells = sort_into_cells(c["x"], c["y"], 2.0 * c["length"])
    given = CrossPhaseInput(Position(c["x"], c["y"], c["z"]), c["volume"], c["length"], c["strength"], averaged)
    out = CrossPhaseSums(np.zeros(n), np.zeros(n), np.zeros(n), np.zeros((3, n)))
    sum_over_other_phase(cells_of_phase(cells, ~water), cells_of_phase(cells, water), given, out)
    apart = np.array([c[axis][:, None] - c[axis] for axis in "xyz"])
    length, other = c["length"][:, None], c["volume"] * (water[:, None] != water)
    q = np.minimum(1.0, np.sqrt((apart**2).sum(axis=0)) / (2.0 * length))
    thickness = (other * 7.0 / (4.0 * np.pi * length**2) * (1.0 - q) ** 4 * (1.0 + 4.0 * q)).sum(axis=1)
    slope = -35.0 / (4.0 * np.pi * length**4) * (1.0 - q) ** 3
    pair = other * (c["strength"][:, None] * slope + c["strength"] * slope.T)
    force = -np.einsum("ij,kij->ki", pair, apart)
    np.testing.assert_allclose(out.thickness, thickness, rtol=0, atol=ROUNDING * thickness.max())
    np.testing.assert_allclose(out.force, force, rtol=0, atol=ROUNDING * abs(force).max())
    weights = other * (1.0 - q) ** 4 * (1.0 + 4.0 * q)
    mean = (weights @ averaged) / np.maximum(weights.sum(axis=1), 1e-300)
    np.testing.assert_allclose(out.mean, mean, rtol=ROUNDING, atol=1e-300)
