"""Sampling errors, against fields whose probability or variance is known."""

import numpy as np
import pytest
from scipy import stats

from landlab_debrisflow.ensemble.sampling import draw_points
from landlab_debrisflow.hazard import hazard_maps, members_needed
from landlab_debrisflow.hazard.errors import from_replicates, wilson
from landlab_debrisflow.hazard.quantiles import rank_intervals

from .fakes import fake_results


def test_wilson_is_that_of_scipy():
    for count in (0, 1, 20, 40):
        found, known = wilson(np.array([count]), 40), stats.binomtest(count, 40).proportion_ci(method="wilson")
        assert found.low[0] == pytest.approx(known.low, abs=1e-12)
        assert found.high[0] == pytest.approx(known.high, abs=1e-12)


@pytest.mark.parametrize("probability", [0.02, 0.2, 0.5])
def test_intervals_of_random_members_hold_the_known_probability(probability):
    """10 000 nodes of independent events, 64 members.

    The exact coverage of Wilson's interval follows from the binomial distribution, between 93 and 98 % here; the
    share of the nodes has a standard deviation of at most 0.26 %.
    """
    rng, members = np.random.default_rng(3), 64
    drawn = [{"max_depth": (rng.random((100, 100)) < probability).astype(float)} for _ in range(members)]
    found = hazard_maps(fake_results(drawn, batch=16), {"max_depth": [0.5]})
    low, high = (found[f"probability_of_max_depth_{end}"].values[0] for end in ("low", "high"))
    count = np.arange(members + 1)
    every = wilson(count, members)
    inside = (every.low <= probability) & (probability <= every.high)
    expected = float(stats.binom.pmf(count, members, probability) @ inside)
    held = float(np.mean((low <= probability) & (probability <= high)))
    assert abs(held - expected) < 0.011 and 0.925 < expected < 0.985


def shares(method, seed, members=256, boundary=0.37):
    """Return the members of each replicate with x + y / 4 below a boundary, and their numbers."""
    points = draw_points(method, members, 2, seed, 8)
    came = points.uniform[:, 0] + 0.25 * points.uniform[:, 1] < boundary
    return np.bincount(points.replicate, came, 8).astype(int)[:, None], np.bincount(points.replicate)


@pytest.mark.parametrize("method", ["latin_hypercube", "sobol"])
def test_replicates_tell_the_variance_of_their_mean(method):
    """The mean square of the stated standard errors is the variance of the probabilities of 600 ensembles.

    Both have a relative standard deviation of 5.8 and 2.2 % (chi-square with 599, and with 7 degrees of freedom
    600 times); four of both together are 25 %.
    """
    pairs = [from_replicates(*shares(method, seed)) for seed in range(600)]
    p, error = (np.array([getattr(one, name)[0] for one in pairs]) for name in ("probability", "standard_error"))
    assert p.mean() == pytest.approx(0.37 - 0.125, abs=4.0 * p.std() / 600**0.5)
    assert np.mean(error**2) == pytest.approx(p.var(ddof=1), rel=0.25)
    assert p.var() < 0.5 * 0.245 * 0.755 / 256  # stratified: a random sample would scatter more
    low, high = (np.array([getattr(one, name)[0] for one in pairs]) for name in ("low", "high"))
    assert 0.92 < np.mean((low <= 0.245) & (high >= 0.245)) < 0.985  # shares are discrete, Student's t is not


def test_replicates_that_agree_have_the_interval_of_wilson():
    found = from_replicates(np.array([[0, 4]] * 8), np.full(8, 8))
    known = wilson(np.array([0, 32]), 64)
    assert np.array_equal(found.low, known.low) and np.array_equal(found.high, known.high)


def test_replicates_of_different_lengths_count_by_their_members():
    """Four replicates of two members and four of one, by hand: p = 7 / 12."""
    found = from_replicates(np.array([[2], [1], [1], [0], [1], [1], [1], [0]]), np.array([2, 2, 2, 2, 1, 1, 1, 1]))
    p = 7 / 12
    squares = 4 * ((1 - p) ** 2 + 2 * (0.5 - p) ** 2 + p**2) + 3 * (1 - p) ** 2 + p**2
    assert found.standard_error[0] == pytest.approx((8 / 7 * squares / 144) ** 0.5)


def test_designs_without_an_error_say_so():
    drawn = [{"max_depth": np.full((2, 2), float(k % 2))} for k in range(16)]
    replicate = np.repeat(np.arange(8), 2)
    for sampling, group, words in (
        ("factorial", None, "shares of its combinations"), ("table", None, "independent=True"),
        ("saltelli", None, "share their values"), ("latin_hypercube", None, "there is 1"),
        ("sobol", np.repeat(np.arange(4), 4), "there are 4"),
    ):  # fmt: skip
        found = hazard_maps(fake_results(drawn, sampling, group))
        assert np.isnan(found.probability_of_max_depth_low).all() and words in found.attrs["no_sampling_error"]
        assert np.isnan(found.quantile_of_max_depth_high).all() and (found.probability_of_reached == 0.5).all()
    for sampling, group, options in (("table", None, {"independent": True}), ("latin_hypercube", replicate, {})):
        found = hazard_maps(fake_results(drawn, sampling, group), **options)
        assert np.isfinite(found.probability_of_reached_low).all() and "no_sampling_error" not in found.attrs


def test_ranks_hold_the_quantile_of_a_distribution():
    """20 000 samples of 60: the share with the true quantile between both ranks is at least 95 %, less 3 deviations."""
    drawn = np.sort(np.random.default_rng(1).random((20_000, 60)), axis=1)
    for quantile in (0.2, 0.5):
        _, low, high = rank_intervals(quantile, 60)[:, 60]
        held = np.mean((drawn[:, low - 1] <= quantile) & (quantile <= drawn[:, high - 1]))
        assert 0.945 < held < 0.985


def test_the_number_of_members_gives_the_error_that_is_asked_for():
    assert members_needed(0.05) == 100 and members_needed(0.02) == 625
    assert wilson(np.array([50]), 100).standard_error[0] == pytest.approx(0.05, rel=0.03)
