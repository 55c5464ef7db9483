"""Sobol indices against exact ones; which base points count; what is refused."""

import numpy as np
import pytest

from landlab_debrisflow import InputError, ParameterError
from landlab_debrisflow.sensitivity import sobol_indices

from .functions import NUMBERS, results_of

SURE = 0.997
"""Level at which intervals are three standard deviations, and rather too wide for base points of Sobol's sequence."""


def ishigami(one, two, three):
    """Return the function of Ishigami & Homma (1990) with a = 7 and b = 0.1."""
    return np.sin(one) + 7.0 * np.sin(two) ** 2 + 0.1 * three**4 * np.sin(one)


def ishigami_indices():
    """Return its first-order and total indices: variances of x1, x2, and x1 with x3."""
    first = 0.5 * (1.0 + 0.1 * np.pi**4 / 5.0) ** 2
    second, both = 7.0**2 / 8.0, 8.0 * 0.1**2 * np.pi**8 / 225.0
    variance = first + second + both
    return np.array([first, second, 0.0]) / variance, np.array([first + both, second, both]) / variance


WEIGHTS = np.array([0.0, 1.0, 4.5, 9.0])


def g_function(*values):
    """Return the function of Saltelli & Sobol (1995), a product of (|4 x - 2| + a) / (1 + a)."""
    return np.prod([(abs(4.0 * x - 2.0) + a) / (1.0 + a) for x, a in zip(values, WEIGHTS, strict=True)], axis=0)


def g_indices():
    """Return its first-order and total indices: a factor has the variance 1 / (3 (1 + a)^2) and the mean 1."""
    own = 1.0 / (3.0 * (1.0 + WEIGHTS) ** 2)
    variance = np.prod(1.0 + own) - 1.0
    return own / variance, own * np.prod(1.0 + own) / (1.0 + own) / variance


ANGLES = {f"x{k}": {"uniform": {"low": -np.pi, "high": np.pi}} for k in range(3)}
UNIT = {f"x{k}": {"uniform": {"low": 0.0, "high": 1.0}} for k in range(4)}


@pytest.mark.parametrize(
    ("function", "exact", "given"), [(ishigami, ishigami_indices(), ANGLES), (g_function, g_indices(), UNIT)]
)
def test_indices_are_the_exact_ones_within_their_intervals(function, exact, given):
    results = results_of({"y": function}, given, 512 * (len(given) + 2), "saltelli", batch=512)
    found, sure = (sobol_indices(results, "y", confidence=level) for level in (0.95, SURE))
    for name, expected in zip(("first_order", "total_order"), exact, strict=True):
        lower, upper = sure[f"{name}_interval"].values[0].T
        assert np.all((lower <= expected) & (expected <= upper))
        lower, upper = found[f"{name}_interval"].values[0].T
        assert np.all(upper - lower < 0.35) and found[name].values[0] == pytest.approx(0.5 * (lower + upper))
    assert found.base_points.item() == 512


def simple(**options):
    """Return results of a measure of which x1 makes 0.8 of the variance."""
    functions = {"y": lambda a, b: 2.0 * a + b, "z": lambda a, b: np.where(a > 0.7, np.nan, a), "c": lambda a, b: 0 * a}
    return results_of(functions, **{"members": 256, "sampling": "saltelli", "batch": 8} | options)


def test_intervals_depend_on_the_seed_alone():
    results = simple()
    one = sobol_indices(results, "y")
    np.random.seed(3)  # which SALib draws from without a seed
    assert one.identical(sobol_indices(results, "y"))
    other = sobol_indices(results, "y", seed=1)
    assert other.first_order.identical(one.first_order) and not other.total_order_interval.equals(
        one.total_order_interval
    )


def test_effects_that_are_not_monotone_are_seen():
    found = sobol_indices(results_of({"y": lambda a, b: (a - 0.5) ** 2 + 0.1 * b}, members=512, sampling="saltelli"))
    # variances 1/180 and 0.01/12
    share = (1.0 / 180.0) / (1.0 / 180.0 + 0.01 / 12.0)
    lower, upper = found.total_order_interval.sel(measure="y", parameter="x1").values
    assert lower <= share <= upper and lower > 0.5


def test_words_have_indices():
    given = {"law": ["coulomb", "voellmy"], "x1": NUMBERS["x1"]}
    found = sobol_indices(
        results_of({"y": lambda law, a: law + 0.1 * a}, given, 256, "saltelli")
    )  # fmt: skip
    assert found.parameter.values.tolist() == ["law", "x1"] and found.first_order.values[0, 0] > 0.9


def test_base_points_count_whole():
    """A batch is two base points; 2 and 3 are not there, and member 5 fails in base point 1."""
    found = sobol_indices(simple(failed=(5,), batches=[0, *range(2, 32)]))
    assert found.base_points.sel(measure="y").item() == 61 and found.attrs["failed_members"] == 1
    whole = simple()
    points = whole.measures.y.values.reshape(-1, 4)[[0, *range(4, 64)]]
    one, first, _, two = points.T  # as Saltelli et al. (2010) have it, by hand
    both = np.r_[one, two]
    expected = np.mean((two - points.mean()) * (first - one)) / both.var()
    assert found.first_order.sel(measure="y", parameter="x1").item() == pytest.approx(expected, abs=1e-12)


def test_measures_that_are_constant_or_often_missing_have_none():
    found = sobol_indices(simple())
    assert found.first_order.notnull().all("parameter").values.tolist() == [True, False, False]
    assert found.base_points.sel(measure="z").item() < 40 and found.base_points.sel(measure="c").item() == 64


def test_what_has_no_indices_is_refused():
    with pytest.raises(InputError, match=r"Sobol indices need sampling: saltelli; these members are of random: run an"):
        sobol_indices(simple(sampling="random"))
    with pytest.raises(InputError, match=r"6 of 64 base points are there, 32 are needed; run more members, 4 for each"):
        sobol_indices(simple(batches=[0, 1, 2]))
    with pytest.raises(InputError, match=r"7 of 64 base points hold a member that failed, at most 10 % may be left"):
        sobol_indices(simple(failed=range(0, 28, 4)))
    for words, match in (({"seed": -1}, "seed must be"), ({"resamples": 1.5}, "resamples must be"), (
        {"confidence": 1.0}, "confidence must lie"
    )):  # fmt: skip
        with pytest.raises(ParameterError, match=match):
            sobol_indices(simple(), **words)
