"""Points of a design: strata, seeds, replicates, correlations."""

import numpy as np
import pytest
from SALib.sample import sobol as salib_sobol
from scipy import stats

from landlab_debrisflow import ParameterError
from landlab_debrisflow.ensemble import Ensemble
from landlab_debrisflow.ensemble.correlation import correlated, rank_matrix
from landlab_debrisflow.ensemble.sampling import draw_points

from .scenes import SCENE, VARY

KEYS = ["a", "b", "c"]


@pytest.mark.parametrize("method", ["random", "latin_hypercube", "sobol", "saltelli"])
def test_a_seed_gives_one_sample(method):
    points, again, other = (draw_points(method, 160, 3, seed, 1 if method == "latin_hypercube" else None) if
                            method != "sobol" else draw_points(method, 128, 3, seed) for seed in (1, 1, 2))  # fmt: skip
    assert points.uniform.tobytes() == again.uniform.tobytes() and (points.uniform != other.uniform).any()
    assert points.uniform.min() >= 0.0 and points.uniform.max() < 1.0


def test_every_replicate_of_a_latin_hypercube_fills_all_strata():
    points = draw_points("latin_hypercube", 100, 3, 0)
    counts = np.bincount(points.replicate)
    assert counts.tolist() == [13] * 4 + [12] * 4
    for number, count in enumerate(counts):
        strata = np.sort((points.uniform[points.replicate == number] * count).astype(int), axis=0)
        assert (strata == np.arange(count)[:, None]).all()


def test_few_members_are_one_sample():
    assert set(draw_points("latin_hypercube", 15, 2, 0).replicate) == {0}


def test_sobol_needs_powers_of_two():
    assert np.bincount(draw_points("sobol", 256, 2, 0).replicate).tolist() == [32] * 8
    with pytest.raises(
        ParameterError, match=r"power of two of members in each of 8 replicates, got 200; give 128 or 256"
    ):
        draw_points("sobol", 200, 2, 0)


def test_saltelli_has_the_order_of_salib():
    """The same base points as SALib's own: unscrambled points of Sobol, compared in the order of rows."""
    points = draw_points("saltelli", 5 * 8, 3, 0).uniform.reshape(8, 5, 3)
    problem = {"num_vars": 3, "names": KEYS, "bounds": [[0, 1]] * 3}
    theirs = salib_sobol.sample(problem, 8, calc_second_order=False, seed=1).reshape(8, 5, 3)
    for blocks in (points, theirs):
        first, last = blocks[:, 0], blocks[:, -1]
        for k in range(3):
            swapped = first.copy()
            swapped[:, k] = last[:, k]
            assert (blocks[:, k + 1] == swapped).all()
    with pytest.raises(ParameterError, match=r"saltelli needs 5 members, .* got 41; give 40 or 80"):
        draw_points("saltelli", 41, 3, 0)


def test_a_design_of_saltelli_has_whole_base_points_by_default():
    design = Ensemble(SCENE, VARY, sampling="saltelli").design
    assert design.sizes["member"] == 64 * (2 + 2)


@pytest.mark.parametrize(("method", "replicates"), [("random", 4), ("saltelli", 2)])
def test_replicates_belong_to_two_methods(method, replicates):
    with pytest.raises(ParameterError, match=f"replicates are for latin_hypercube and sobol, not {method}"):
        draw_points(method, 20, 3, 0, replicates)


def test_more_replicates_than_members_are_refused():
    with pytest.raises(ParameterError, match=r"replicates must lie in \[1, 4\], the members, got 5"):
        draw_points("latin_hypercube", 4, 3, 0, 5)


@pytest.mark.parametrize("method", ["random", "latin_hypercube", "sobol"])
def test_rank_correlations_are_those_asked_for(method):
    points = draw_points(method, 2048, 3, 0, None if method == "random" else 1)
    found = correlated(points, KEYS, {("a", "b"): 0.7, ("b", "c"): -0.4}, method == "latin_hypercube")
    ranks = stats.spearmanr(found).statistic
    # the scatter of a rank correlation of 2048 random points is (1 - rho^2) / sqrt(2048), at most 0.022
    assert ranks[[0, 1, 0], [1, 2, 2]] == pytest.approx([0.7, -0.4, 0.0], abs=0.07)
    assert stats.kstest(found[:, 1], "uniform").pvalue > 0.01


def test_a_correlated_latin_hypercube_is_one():
    points = draw_points("latin_hypercube", 64, 2, 0)
    found = correlated(points, KEYS[:2], [[1.0, 0.8], [0.8, 1.0]], True)
    inside = found[points.replicate == 3]
    assert (np.sort((inside * 8).astype(int), axis=0) == np.arange(8)[:, None]).all()


@pytest.mark.parametrize(
    ("correlation", "message"),
    [
        ({("a", "b"): 0.9, ("b", "c"): 0.9, ("a", "c"): -0.9}, r"not positive definite \(least eigenvalue -0.8"),
        ({("a", "d"): 0.9}, r"'d' does not vary.*; varied: a, b, c"),
        ({("a", "b"): 1.5}, r"a with b must lie in \(-1, 1\), got 1.5"),
        ({("a", "a"): 0.5}, r"a with itself is 1"),
        ({"a": 0.5}, r"a pair of names is needed"),
        ([[1.0, 0.5], [0.5, 1.0]], r"a symmetric matrix 3 x 3"),
        ("strong", r"must be a mapping of pairs"),
    ],
)
def test_correlations_that_nothing_has_are_refused(correlation, message):
    with pytest.raises(ParameterError, match=message):
        correlated(draw_points("random", 8, 3, 0), KEYS, correlation, False)


def test_pairs_may_be_nested_as_in_yaml():
    assert (rank_matrix(KEYS, {"a": {"c": 0.5}}) == rank_matrix(KEYS, {("c", "a"): 0.5})).all()
