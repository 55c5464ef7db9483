"""Rank correlations: known values, which members count, and what cannot be ranked."""

import numpy as np
import pytest
from scipy import stats

from landlab_debrisflow import InputError, ParameterError
from landlab_debrisflow.ensemble import Ensemble
from landlab_debrisflow.sensitivity import rank_correlations
from landlab_debrisflow.sensitivity.rank import correlation_interval

from ..ensemble.scenes import ANGLE, SCENE, VARY
from .functions import NUMBERS, results_of

WORDS = {"law": ["coulomb", "voellmy", "manning"], **NUMBERS}


def test_correlations_are_those_of_scipy():
    results = results_of({"y": lambda a, b: np.exp(3.0 * a) - 0.3 * b})
    found = rank_correlations(results)
    measured = results.measures.y.values
    for name in ("x1", "x2"):
        expected = stats.spearmanr(results.design[name], measured).statistic
        assert float(found.rank_correlation.sel(measure="y", parameter=name)) == pytest.approx(expected, abs=1e-12)
    ranks = stats.rankdata(np.column_stack([results.design.x1, results.design.x2, measured]), axis=0)
    inverse = np.linalg.inv(np.corrcoef(ranks, rowvar=False))  # of which partial correlations are made, too
    expected = -inverse[:2, 2] / np.sqrt(inverse[2, 2] * np.diag(inverse)[:2])
    assert found.partial_rank_correlation.values[0] == pytest.approx(expected, abs=1e-9)
    assert found.members.item() == 64 and found.measure_units.item() == "m"
    assert found.attrs["sampling"] == "random" and found.attrs["left_out"] == ""


def test_a_monotone_measure_has_one_and_no_partial_one():
    found = rank_correlations(results_of({"up": lambda a, b: a**5, "down": lambda a, b: -a}))
    assert found.rank_correlation.sel(parameter="x1").values == pytest.approx([1.0, -1.0], abs=1e-15)
    assert found.rank_correlation_interval.sel(parameter="x1", measure="up").values == pytest.approx([1.0, 1.0])
    # nothing is left of the measure that x1 does not explain
    assert np.isnan(found.partial_rank_correlation.sel(parameter="x2")).all()


def test_partial_correlations_separate_correlated_values():
    rng = np.random.default_rng(1)
    found = rank_correlations(
        results_of(
            {"y": lambda a, b: a + 0.3 * rng.standard_normal(a.size)}, members=256,
            correlation={("x1", "x2"): 0.8},
        )
    ).sel(measure="y")  # fmt: skip
    assert float(found.rank_correlation.sel(parameter="x2")) > 0.4
    partial = found.partial_rank_correlation
    assert abs(float(partial.sel(parameter="x2"))) < 3.0 / np.sqrt(256.0) < float(partial.sel(parameter="x1"))


def test_intervals_hold_the_truth_as_often_as_they_say():
    """Of a bivariate normal the rank correlation is 6 / pi asin(r / 2)."""
    one, other = np.random.default_rng(2).standard_normal((2, 2000, 30))
    pearson = 0.6
    other = pearson * one + np.sqrt(1.0 - pearson**2) * other
    ranks, others = (stats.rankdata(part, axis=1) - 15.5 for part in (one, other))
    lower, upper = correlation_interval((ranks * others).sum(axis=1) / (ranks**2).sum(axis=1), 30, 0.9)
    truth = 6.0 / np.pi * np.arcsin(0.5 * pearson)
    # of 2000 intervals, three standard deviations are 0.02
    assert np.mean((lower <= truth) & (truth <= upper)) == pytest.approx(0.9, abs=0.02)


def test_failures_and_missing_measures_do_not_count():
    functions = {"y": lambda a, b: np.where(a > 0.8, np.nan, a + b), "z": lambda a, b: a + b}
    whole = results_of(functions, batch=8)
    some = results_of(functions, batch=8, failed=(0, 3), batches=[0, 2])
    left = np.setdiff1d(np.r_[0:8, 16:24], [0, 3])
    there = left[whole.design.x1.values[left] <= 0.8]
    found = rank_correlations(some)
    assert found.members.values.tolist() == [there.size, 14] and there.size < 14
    assert found.attrs["failed_members"] == 2
    expected = stats.spearmanr(whole.design.x2.values[there], whole.measures.y.values[there]).statistic
    assert float(found.rank_correlation.sel(measure="y", parameter="x2")) == pytest.approx(expected, abs=1e-12)


def test_constants_have_no_correlation():
    given = NUMBERS | {"x3": {"choices": [2.0]}}
    found = rank_correlations(results_of({"y": lambda a, b, c: a + b, "one": lambda a, b, c: np.ones_like(a)}, given))
    known = found.rank_correlation.notnull().to_series().unstack()
    assert known.loc["y"].tolist() == [True, True, False] and not known.loc["one"].any()
    assert found.rank_correlation_interval.notnull().sum() == 4 and found.partial_rank_correlation.notnull().sum() == 2


def test_words_are_left_out_and_named():
    found = rank_correlations(results_of({"y": lambda law, a, b: law + a}, WORDS))
    assert found.parameter.values.tolist() == ["x1", "x2"] and found.attrs["left_out"] == "law"
    with pytest.raises(InputError, match="law cannot be ranked, no other value varies; vary a number, or"):
        rank_correlations(results_of({"y": lambda law: law}, {"law": WORDS["law"]}))


def test_noise_is_left_out():
    vary = {"terrain.elevation_noise": {"rms": 0.1, "length": 20.0}, ANGLE: VARY[ANGLE]}
    results = Ensemble(SCENE | {"output": {"max_duration": 1e-6}}, vary, 8, "random").run(workers=1)
    found = rank_correlations(results)
    assert found.parameter.values.tolist() == [ANGLE] and found.attrs["left_out"] == "terrain.elevation_noise"


def test_members_that_share_values_count_once():
    results = results_of({"y": lambda a, b: a + b}, members=64, sampling="saltelli")
    found = rank_correlations(results)
    members = np.arange(64).reshape(16, 4)[:, [0, 3]].ravel()
    expected = stats.spearmanr(results.design.x1.values[members], results.measures.y.values[members]).statistic
    assert found.members.item() == 32 and found.rank_correlation.values[0, 0] == pytest.approx(expected, abs=1e-12)


def test_all_combinations_have_no_interval():
    given = {"x1": {"choices": [1.0, 2.0, 3.0]}, "x2": {"choices": [1.0, 2.0]}}
    found = rank_correlations(results_of({"y": lambda a, b: a + 10.0 * b}, given, None, "factorial"))
    assert found.rank_correlation.notnull().all() and found.rank_correlation_interval.isnull().all()


def test_three_members_have_no_interval():
    found = rank_correlations(results_of({"y": lambda a, b: a + b}, members=3))
    assert found.rank_correlation.notnull().all() and found.rank_correlation_interval.isnull().all()
    found = rank_correlations(results_of({"y": lambda a, b: a + b}, members=1))
    assert found.rank_correlation.isnull().all()


@pytest.mark.slow
def test_more_debris_flows_faster():
    results = Ensemble(SCENE, VARY, 16, "latin_hypercube").run(workers=1)
    found = rank_correlations(results, ["max_speed", "budget_released"], confidence=0.9)
    lower, upper = found.rank_correlation_interval.sel(measure="budget_released", parameter="release.volume").values
    assert lower == upper == 1.0
    assert float(found.rank_correlation.sel(measure="max_speed", parameter="release.volume")) > 0.8
    assert found.measure_units.values.tolist() == ["m s-1", "m3"] and found.attrs["digest"] == results.digest


def test_what_cannot_be_correlated_is_refused():
    results = results_of({"y": lambda a, b: a})
    with pytest.raises(InputError, match=r"no measure 'why'.*there are y"):
        rank_correlations(results, "why")
    with pytest.raises(ParameterError, match=r"confidence must lie between 0 and 1, such as 0.95, got 95"):
        rank_correlations(results, confidence=95)
    with pytest.raises(InputError, match="has no measures; run members first"):
        rank_correlations(results_of({"y": lambda a, b: a}, batches=[]))
