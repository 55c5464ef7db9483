"""SPH sums against all pairs in numpy, their symmetry, and what a regular lattice must give."""

import numpy as np
import pytest

from landlab_debrisflow.spatial.cells import sort_into_cells
from landlab_debrisflow.spatial.packing import Position
from landlab_debrisflow.spatial.summation import (
    SELF_WEIGHT,
    SMOOTHING_RATIO,
    SummationInput,
    Sums,
    sum_over_neighbours,
)

VISCOSITY = 0.8

ROUNDING = 2e-6
"""Floats are rounded to 6e-8, reciprocal roots to 3e-7, positions to 1e-7 of the mean support: here, where lengths
differ by a factor of six, 1e-6 of the smallest."""


def cloud(count, seed):
    """Random particles with smoothing lengths of ratio 1 to 6 and volumes of ratio 1 to 3."""
    rng = np.random.default_rng(seed)
    x, y = rng.uniform(-3.0, 50.0, count), rng.uniform(10.0, 30.0, count)
    x[: count // 10] += 400.0  # some far away
    length = rng.uniform(1.0, 6.0, count)
    return {
        "x": x, "y": y, "z": rng.uniform(0.0, 2.0, count), "volume": rng.uniform(1.0, 3.0, count),
        "length": length, "velocity": rng.normal(0.0, 1.0, (3, count)), "strength": rng.uniform(4.0, 9.0, count),
        "celerity": rng.uniform(1.0, 3.0, count), "thickness": rng.uniform(0.5, 2.0, count),
        "thickening": rng.normal(0.0, 1.0, count), "inertia": rng.uniform(0.5, 2.0, count),
    }  # fmt: skip


def sums(c, longest, threads=1, changed=None, out=None):
    """Return thickness, grad-h term, next length, acceleration and thickening."""
    n = c["x"].size
    out = [np.empty(n), np.empty(n), np.empty(n), np.empty((3, n)), np.empty(n)] if out is None else out
    cells = sort_into_cells(c["x"], c["y"], 2.0 * c["length"], changed)
    given = SummationInput(
        Position(c["x"], c["y"], c["z"]), c["velocity"], c["volume"], c["length"], longest, c["strength"],
        c["celerity"], c["thickness"], c["thickening"], c.get("inertia", np.ones(n)),
    )  # fmt: skip
    sum_over_neighbours(cells, given, VISCOSITY, Sums(*out), threads)
    return out


def wendland(r, length):
    q = np.minimum(1.0, r / (2.0 * length))
    return 7.0 / (4.0 * np.pi * length**2) * (1.0 - q) ** 4 * (1.0 + 4.0 * q)


def plain_sum(c, length):
    """Sum the thickness over all pairs, for smoothing lengths of shape (n,)."""
    r, _ = distances(c)
    weights = wendland(r, length[:, None])
    weights[np.diag_indices(length.size)] *= SELF_WEIGHT
    return weights @ c["volume"]


def distances(c):
    position = np.array([c["x"], c["y"], c["z"]])
    apart = position[:, :, None] - position[:, None, :]  # (3, i, j): from j to i
    return np.sqrt((apart**2).sum(axis=0)), apart


def reference_gradient(c):
    """The formula of `sum_over_neighbours` with dW/dr by central differences."""
    r, apart = distances(c)
    np.fill_diagonal(r, 1.0)
    unit = apart / r
    step = 1e-5
    length = c["length"][:, None]
    slope_i = (wendland(r + step, length) - wendland(r - step, length)) / (2 * step)
    slope_j = (wendland(r + step, length.T) - wendland(r - step, length.T)) / (2 * step)
    apart_v = c["velocity"][:, :, None] - c["velocity"][:, None, :]
    uniform = 0.5 * np.maximum(0.0, c["thickening"] / c["thickness"])
    w = np.minimum(0.0, (apart_v * unit).sum(axis=0) + np.minimum(uniform[:, None], uniform) * r)
    larger = np.maximum(c["thickness"][:, None], c["thickness"])
    shock = 0.25 * VISCOSITY * (c["celerity"][:, None] + c["celerity"] - 3.0 * w) * -w / larger
    pair = (c["strength"][:, None] + shock) * slope_i + (c["strength"] + shock) * slope_j
    np.fill_diagonal(pair, 0.0)
    np.fill_diagonal(slope_i, 0.0)
    acceleration = -np.einsum("j,ij,kij->ki", c["volume"], pair, unit) / c["inertia"]
    thickening = np.einsum("j,ij,kij,kij->i", c["volume"], slope_i, unit, apart_v)
    return acceleration, thickening


@pytest.mark.parametrize(("count", "seed"), [(300, 1), (120, 2), (2, 3), (1, 4)])
def test_thickness_is_the_sum_over_all_pairs(count, seed):
    c = cloud(count, seed)
    capped, omega, length, _, _ = sums(c, longest=c["length"])  # at the cap the plain sum holds
    exact = plain_sum(c, c["length"])
    np.testing.assert_allclose(capped, exact, rtol=ROUNDING)
    assert np.all(omega == 1.0)
    np.testing.assert_allclose(
        length, np.minimum(c["length"], SMOOTHING_RATIO * np.sqrt(c["volume"] / exact)), rtol=ROUNDING
    )


def test_the_newton_step_uses_the_slope_of_the_sum():
    c = cloud(300, 5)
    h, omega, _, _, _ = sums(c, longest=np.full(300, 1e9))
    length, step = c["length"], 1e-6
    slope = (plain_sum(c, length + step) - plain_sum(c, length - step)) / (2 * step)
    now = SMOOTHING_RATIO**2 * c["volume"] / length**2
    expected = np.maximum(0.4, 1.0 + 0.5 * length / now * slope)
    # 1 - SLOPE (25 s1 - 14 s2 - 10 s0) of three sums of some volumes each
    np.testing.assert_allclose(omega, expected, rtol=0, atol=10 * ROUNDING)
    step = np.clip((now - plain_sum(c, length)) / expected, -now, 0.5 * now)  # never to nothing, never beyond double
    np.testing.assert_allclose(h, now - step, rtol=10 * ROUNDING)  # amplified by 1/Omega


@pytest.mark.parametrize(("count", "seed"), [(300, 1), (120, 2), (2, 3), (1, 4)])
def test_the_gradient_is_the_sum_over_all_pairs(count, seed):
    c = cloud(count, seed)
    *_, acceleration, thickening = sums(c, longest=c["length"])
    exact, exact_thickening = reference_gradient(c)
    size = np.abs(exact).max() + 1e-300
    np.testing.assert_allclose(acceleration / size, exact / size, rtol=0, atol=ROUNDING)
    np.testing.assert_allclose(thickening, exact_thickening, rtol=0, atol=ROUNDING * abs(exact_thickening).max())


def test_pairs_push_each_other_equally():
    c = cloud(500, 6)
    *_, acceleration, _ = sums(c, longest=c["length"])
    force = c["inertia"] * c["volume"] * acceleration
    # positions differ by whole numbers, the same from either side: what is left is the rounding of each sum
    assert np.all(abs(force.sum(axis=1)) < 6e-8 * abs(force).sum(axis=1))


def lattice(kind, slope):
    """A regular lattice of unit spacing on a plane; volume 1 on unit area: thickness 1."""
    i, j = np.meshgrid(np.arange(-14, 15), np.arange(-14, 15))
    if kind == "square":
        along, across = i.ravel() + 0.0, j.ravel() + 0.0
    else:
        along, across = (i + 0.5 * (j % 2)).ravel() * np.sqrt(2 / np.sqrt(3)), j.ravel() * np.sqrt(np.sqrt(3) / 2)
    return along / np.hypot(1, slope), across, slope * along / np.hypot(1, slope)


@pytest.mark.parametrize("slope", [0.0, 1.0])
@pytest.mark.parametrize("kind", ["square", "hexagonal"])
@pytest.mark.parametrize("longest", [SMOOTHING_RATIO, 1e9])
def test_a_regular_lattice_has_its_exact_thickness(kind, slope, longest):
    x, y, z = lattice(kind, slope)
    n = x.size
    c = {"x": x, "y": y, "z": z, "volume": np.ones(n), "length": np.full(n, SMOOTHING_RATIO)}
    c |= {name: np.ones(n) for name in ("strength", "celerity", "thickness")}
    c |= {"velocity": np.zeros((3, n)), "thickening": np.zeros(n)}
    h, _, _, acceleration, _ = sums(c, longest=np.full(n, longest))
    middle = np.flatnonzero(x**2 + y**2 + z**2 < 9.0)
    # SELF_WEIGHT is the mean of both lattices: 2e-4 for either; the plain sum is 6.7e-3 too deep
    np.testing.assert_allclose(h[middle], 1.0, rtol=0, atol=1e-3)
    assert abs(acceleration[:, middle]).max() < 5e-7  # symmetry: positions rounded to 1e-7, gradients of order 1


@pytest.mark.parametrize("threads", [2, 3])
def test_results_do_not_depend_on_the_number_of_threads(threads):
    c = cloud(700, 7)
    for one, other in zip(sums(c, 2.0 * c["length"]), sums(c, 2.0 * c["length"], threads), strict=True):
        np.testing.assert_array_equal(one, other)


def test_what_sleeps_is_left_alone_and_what_wakes_is_computed_alike():
    c = cloud(700, 8)
    changed = c["x"] > 40.0
    full = sums(c, 2.0 * c["length"])
    marker = [np.full_like(values, -1.0) for values in full]
    cells = sort_into_cells(c["x"], c["y"], 2.0 * c["length"], changed)
    awake = cells.computed
    assert changed.sum() < awake.sum() < 700
    for one, other in zip(full, sums(c, 2.0 * c["length"], changed=changed, out=marker), strict=True):
        np.testing.assert_array_equal(one[..., awake], other[..., awake])
        assert np.all(other[..., ~awake] == -1.0)
    # every particle with a changed particle in reach, or in the reach of one, is awake
    r, _ = distances(c)
    support = 2.0 * np.maximum(c["length"][:, None], c["length"])
    assert np.all(awake[np.any((r < support) & changed, axis=1)])


def test_uniform_convergence_is_no_shock():
    """Points that all move towards one: viscosity adds nothing once the convergence is known.

    Its pressure would be uniform, too, if the celerity did not grow to the east.
    """
    x, y, z = lattice("hexagonal", 0.0)
    n, rate = x.size, 0.3
    c = {"x": x, "y": y, "z": z, "volume": np.ones(n), "length": np.full(n, SMOOTHING_RATIO)}
    c |= {"velocity": -rate * np.array([x, y, z]), "thickening": np.full(n, 2.0 * rate), "thickness": np.ones(n)}
    c |= {"strength": np.ones(n), "celerity": 10.0 + 0.3 * x}
    middle = np.flatnonzero(x**2 + y**2 < 50.0)
    *_, free, _ = sums(c, np.full(n, 1e9))
    *_, damped, _ = sums(c | {"thickening": np.zeros(n)}, np.full(n, 1e9))
    *_, still, _ = sums(c | {"velocity": np.zeros((3, n))}, np.full(n, 1e9))
    assert abs(damped - still)[:, middle].max() > 0.01
    assert abs(free - still)[:, middle].max() < 1e-5


def test_those_beyond_act_and_are_not_moved():
    c = cloud(200, 9)
    full = sums(c, c["length"])
    out = [np.empty(150), np.empty(150), np.empty(150), np.empty((3, 150)), np.empty(150)]
    for one, other in zip(full, sums(c, c["length"], out=out), strict=True):
        np.testing.assert_array_equal(one[..., :150], other)
