"""Sampler: posteriors that are known in closed form are found, from functions in place of runs."""

import numpy as np
import pytest
from scipy import stats

from landlab_debrisflow import InputError
from landlab_debrisflow.calibration.criteria import Likelihood, Tolerance
from landlab_debrisflow.calibration.intervals import weighted_quantiles
from landlab_debrisflow.calibration.model_error import ErrorModel, ModelError, Stated
from landlab_debrisflow.calibration.proposal import Proposal, effective_size, log_prior, normal_scores
from landlab_debrisflow.calibration.sampler import draw_posterior

MATRIX = np.array([[1.0, 0.5], [0.2, -1.0], [0.3, 0.3]])
SD = np.array([0.1, 0.2, 0.1])
OBSERVED = MATRIX @ [1.0, -0.7] + [0.05, -0.1, 0.02]
PRECISION = np.eye(2) + MATRIX.T @ np.diag(SD**-2) @ MATRIX
MEAN = np.linalg.solve(PRECISION, MATRIX.T @ (OBSERVED / SD**2))
DEVIATION = np.sqrt(np.diag(np.linalg.inv(PRECISION)))


def likelihood(sds, count=1.0, model_error=None):
    return Likelihood(ErrorModel([Stated(sd, count, 1.0, model_error) for sd in sds]))


def linear(generation, points):
    """Return points and misfits of a linear model of normal parameters."""
    return points, normal_scores(points) @ MATRIX.T - OBSERVED


def moments(sample):
    scores, weights = normal_scores(sample.uniform), sample.level.weights
    mean = weights @ scores
    return mean, np.sqrt(weights @ (scores - mean) ** 2)


@pytest.mark.parametrize("seed", range(3))
def test_the_posterior_of_a_linear_model_is_the_known_one(seed):
    sample = draw_posterior(2, linear, likelihood(SD), 200, 4, seed)
    mean, deviation = moments(sample)
    assert sample.level.size > 200.0
    # 4 standard errors of the mean, and of the standard deviation, which is that of the mean over sqrt(2)
    tolerance = 4.0 / np.sqrt(sample.level.size)
    assert np.all(abs(mean - MEAN) < tolerance * DEVIATION)
    assert np.all(abs(deviation / DEVIATION - 1.0) < tolerance / np.sqrt(2.0))
    assert sample.steps == tuple(sorted(sample.steps)) and 0.0 < sample.steps[0] < 1.0


def test_weights_of_prior_over_mixture_have_the_mean_one_and_a_bound():
    sample = draw_posterior(2, linear, likelihood(SD), 200, 4, 5)
    ratio = np.exp(sample.log_ratio)
    assert ratio.max() <= 4.0 and abs(ratio.mean() - 1.0) < 4.0 * ratio.std() / np.sqrt(ratio.size)


def test_the_density_of_a_proposal_is_that_of_its_draws():
    random = np.random.default_rng(1)
    proposal = Proposal.around(random.normal([1.0, -1.0], [0.3, 0.1], (50, 2)), np.full(50, 0.02))
    points = proposal.draw(20000, random)
    scores = normal_scores(points)
    weights = np.exp(log_prior(scores) - proposal.log_density(scores, 20000))
    for k in range(2):  # weighted back to the prior, the coordinates are uniform
        mean = np.average(points[:, k], weights=weights)
        assert abs(mean - 0.5) < 4.0 * np.sqrt(1.0 / 12.0 / effective_size(weights))


def test_both_modes_are_found_with_their_weights():
    def square(generation, points):
        return points, normal_scores(points) ** 2 - 1.0

    parts = []
    for seed in range(4):
        sample = draw_posterior(1, square, likelihood([0.1]), 200, 4, seed)
        scores = normal_scores(sample.uniform)[:, 0]
        parts.append(sample.level.weights[scores > 0.0].sum())
        near = abs(abs(scores) - 1.0) < 0.25  # 5 standard deviations of 0.1 / (2 |x|)
        assert sample.level.weights[near].sum() > 0.99
    assert abs(np.mean(parts) - 0.5) < 4.0 * 0.5 / np.sqrt(4 * 200)


def test_a_list_of_choices_is_drawn_with_its_posterior_probabilities():
    values = np.array([0.0, 1.0, 3.0])

    def chosen(generation, points):
        return points, values[np.minimum((3.0 * points[:, :1]).astype(int), 2)] - 0.6

    sample = draw_posterior(1, chosen, likelihood([0.5]), 300, 3, 0)
    expected = stats.norm.pdf(values, 0.6, 0.5)
    index = np.minimum((3.0 * sample.uniform[:, 0]).astype(int), 2)
    found = np.bincount(index, sample.level.weights, minlength=3)
    assert found == pytest.approx(expected / expected.sum(), abs=4.0 * 0.5 / np.sqrt(sample.level.size))


def test_the_error_of_the_model_is_found_where_misfits_tell_it():
    # 200 independent values of a map that the model misses by 0.5, beside an error of observation of 0.1
    errors = ErrorModel([Stated(0.1, 200.0, 1.0, ModelError(1.0))])
    misfits = np.full((4, 1), np.sqrt(0.1**2 + 0.5**2))
    ((mean, low, high),) = errors.model_errors(misfits, np.full(4, 0.25)).values()
    # 1 / sqrt(2 n) = 5 % of the total is the standard deviation of an estimate; and steps of 1 % of the prior
    assert mean == pytest.approx(0.5, rel=0.05) and low < 0.5 < high and high - low < 0.15


def test_the_error_of_the_model_widens_the_posterior_as_the_marginal_likelihood_says():
    sample = draw_posterior(2, linear, likelihood(SD, model_error=ModelError(0.5)), 400, 4, 0)
    scores = np.stack(np.meshgrid(*[np.linspace(-4.0, 4.0, 81)] * 2, indexing="ij"), axis=-1).reshape(-1, 2)
    # the same integral on a grid of parameters and on a grid of errors
    errors = np.linspace(0.0, 2.5, 250)
    variance = SD[:, None] ** 2 + errors**2
    misfits = scores @ MATRIX.T - OBSERVED
    logs = -0.5 * np.sum(misfits[:, :, None] ** 2 / variance + np.log(variance), axis=1)
    weights = np.exp(logs) @ stats.halfnorm.pdf(errors, scale=0.5) * np.exp(log_prior(scores))
    weights /= weights.sum()
    mean = weights @ scores
    deviation = np.sqrt(weights @ (scores - mean) ** 2)
    found = moments(sample)
    tolerance = 4.0 / np.sqrt(sample.level.size)
    assert np.all(abs(found[0] - mean) < tolerance * deviation)
    assert np.all(abs(found[1] / deviation - 1.0) < tolerance)
    assert np.all(deviation > 1.2 * DEVIATION)


def test_abc_closes_in_on_the_observation_as_its_tolerance_shrinks():
    def normal(generation, points):
        return points, normal_scores(points) - 1.0

    samples = [draw_posterior(1, normal, Tolerance(200, ["x"]), 200, count, 0) for count in (2, 6)]
    deviations = [float(moments(one)[1][0]) for one in samples]
    assert samples[1].level.value < 0.5 * samples[0].level.value and deviations[1] < 0.6 * deviations[0]
    assert list(samples[1].steps) == sorted(samples[1].steps, reverse=True)
    assert moments(samples[1])[0] == pytest.approx([1.0], abs=4.0 * deviations[1] / np.sqrt(samples[1].level.size))


def test_equal_seeds_give_equal_members_and_stored_points_count():
    first, again = (draw_posterior(2, linear, likelihood(SD), 40, 3, 9) for _ in range(2))
    assert np.array_equal(first.uniform, again.uniform) and np.array_equal(first.level.weights, again.level.weights)
    stored = draw_posterior(2, lambda k, points: linear(k, np.full_like(points, 0.5)), likelihood(SD), 40, 2, 9)
    assert np.all(stored.uniform == 0.5)


def test_members_that_failed_have_no_weight():
    def half(generation, points):
        misfits = linear(generation, points)[1]
        misfits[::2] = np.nan
        misfits[1::4, 0] = np.inf
        return points, misfits

    sample = draw_posterior(2, half, likelihood(SD), 80, 3, 0)
    assert not sample.level.weights[::2].any() and not sample.level.weights[1::4].any()
    with pytest.raises(InputError, match="none of 8 members has a value at every observation"):
        draw_posterior(1, lambda k, points: (points, np.full((8, 1), np.nan)), likelihood([1.0]), 8, 2, 0)


def test_a_value_that_does_not_vary_makes_no_distance():
    with pytest.raises(InputError, match="outflow is equal in half of the members"):
        draw_posterior(1, lambda k, points: (points, np.zeros((8, 1))), Tolerance(8, ["outflow"]), 8, 2, 0)


def test_quantiles_of_many_equal_weights_are_those_of_the_sample():
    values = np.random.default_rng(0).normal(size=4000)
    found = weighted_quantiles(values, np.ones(4000), np.array([0.05, 0.5, 0.95]))
    assert found == pytest.approx(np.quantile(values, [0.05, 0.5, 0.95]), abs=0.01)  # a few steps of 1 / 4000
    assert weighted_quantiles(np.array([1, 2, 7]), np.array([0.2, 0.2, 0.6]), np.array(0.3)) == 2


def test_nine_of_ten_intervals_hold_the_truth():
    random, held, cases = np.random.default_rng(3), np.zeros(2), 100
    for case in range(cases):
        truth = random.standard_normal(2)
        observed = MATRIX @ truth + SD * random.standard_normal(3)
        sample = draw_posterior(
            2, lambda k, points, y=observed: (points, normal_scores(points) @ MATRIX.T - y), likelihood(SD), 40, 4, case
        )
        scores = normal_scores(sample.uniform)
        for k in range(2):
            low, high = weighted_quantiles(scores[:, k], sample.level.weights, np.array([0.05, 0.95]))
            held[k] += low <= truth[k] <= high
    # binomial: outside 80 to 97 of 100 in 1 % of attempts; the seed is fixed
    assert np.all((held >= 80) & (held <= 97)), held
