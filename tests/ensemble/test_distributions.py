"""Distributions of varied values, and those that are refused."""

import numpy as np
import pytest
from scipy import stats

from landlab_debrisflow import ParameterError
from landlab_debrisflow.ensemble.distributions import distribution_of
from landlab_debrisflow.ensemble.names import Name

ANGLE = Name("friction.basal_friction_angle", ("friction", "basal_friction_angle"), "deg", "", (0.0, 89.9), True, float)
COUNT = Name("column.levels", ("column", "levels"), "-", "", (3.0, 100.0), False, int)
FILE = Name("terrain.elevation", ("terrain", "elevation"), "m", "", number=None)
NOISE = Name("terrain.elevation_noise", ("terrain", "elevation_noise"), "m", "")
UNIFORM = (np.arange(1000) + 0.5) / 1000.0


@pytest.mark.parametrize(
    ("given", "frozen"),
    [
        ({"normal": {"mean": 30.0, "sd": 2.0}}, stats.norm(30.0, 2.0)),
        ({"uniform": {"low": 20.0, "high": 30.0}}, stats.uniform(20.0, 10.0)),
        ({"lognormal": {"median": 25.0, "sigma": 0.1}}, stats.lognorm(0.1, scale=25.0)),
        ({"triangular": {"low": 20.0, "mode": 22.0, "high": 30.0}}, stats.triang(0.2, 20.0, 10.0)),
        ({"truncated_normal": {"mean": 30.0, "sd": 5.0, "low": 20, "high": 35}}, stats.truncnorm(-2, 1, 30.0, 5.0)),
    ],
)
def test_plain_values_are_distributions_of_scipy(given, frozen):
    wide = ANGLE._replace(bounds=(-np.inf, np.inf))
    values = distribution_of(wide, given).values_at(UNIFORM)
    assert values == pytest.approx(frozen.ppf(UNIFORM), rel=1e-12)
    assert values == pytest.approx(distribution_of(wide, frozen).values_at(UNIFORM), rel=1e-12)


def test_choices_come_with_their_probabilities():
    found = distribution_of(ANGLE, {"choices": [20.0, 25.0, 30.0], "probabilities": [0.2, 0.5, 0.3]})
    values, counts = np.unique(found.values_at(UNIFORM), return_counts=True)
    assert (values.tolist(), counts.tolist()) == ([20.0, 25.0, 30.0], [200, 500, 300])
    assert np.bincount(distribution_of(FILE, ["one.tif", "two.tif"]).values_at(UNIFORM)).tolist() == [500, 500]


def test_whole_numbers_are_whole():
    values = distribution_of(COUNT, stats.randint(5, 8)).values_at(UNIFORM)
    assert values.dtype.kind == "i" and set(values.tolist()) == {5, 6, 7}


def test_noise_has_different_realisations():
    values = distribution_of(NOISE, {"rms": 0.3, "length": 20.0}).values_at(UNIFORM)
    assert np.unique(values).size == UNIFORM.size


@pytest.mark.parametrize(
    ("name", "given", "message"),
    [
        (ANGLE, stats.norm(2.0, 2.0), r"15.9 % of the distribution lie outside \(0, 89.9\] deg; .*truncated_normal"),
        (COUNT, stats.uniform(0.0, 6.0), r"50 % of the distribution lie outside \[3, 100\]"),
        (ANGLE, {"normals": {"mean": 2, "sd": 1}}, r"unknown distribution 'normals' \(did you mean 'normal'\?\)"),
        (ANGLE, {"normal": {"mean": 28.0, "std": 1.0}}, r"normal needs mean, sd, got"),
        (ANGLE, {"normal": {"mean": 28.0, "sd": -1.0}}, r"normal: sd must be more than 0, got -1"),
        (ANGLE, {"uniform": {"low": 30.0, "high": 20.0}}, r"low must be less than high, got 30 and 20"),
        (ANGLE, {"triangular": {"low": 20.0, "mode": 40.0, "high": 30.0}}, r"mode must lie in \[20, 30\], got 40"),
        (ANGLE, {"normal": {"mean": "28", "sd": 1.0}}, r"normal: mean must be a finite number, got '28'"),
        (ANGLE, [20.0, -3.0], r"choices must lie in \(0, 89.9\], got -3.0"),
        (ANGLE, [], r"choices must be a list of one value or more"),
        (ANGLE, [True, 20.0], r"choices must be numbers \[deg\] or names of rasters, got True"),
        (ANGLE, {"choices": [20.0, 30.0], "probabilities": [0.5, 0.6]}, r"sum up to 1"),
        (ANGLE, {"choices": [20.0, 30.0], "probabilities": [1.0]}, r"2 choices need as many probabilities"),
        (ANGLE, {"choices": [20.0], "weights": [1.0]}, r"unknown key 'weights'"),
        (ANGLE, 28.0, r"a distribution of scipy.stats, a list or a mapping such as .* is needed, got 28.0"),
        (FILE, stats.norm(0, 1), r"is not a number: give a list of choices"),
        (NOISE, {"rms": 0.3}, r"a mapping of rms \[m\] and length \[m\] is needed"),
        (NOISE, {"rms": 0.3, "length": 0.0}, r"must be more than 0 m, got 0.3 and 0"),
    ],
)
def test_what_is_no_distribution_is_refused(name, given, message):
    with pytest.raises(ParameterError, match=message):
        distribution_of(name, given)


def test_discrete_values_may_lie_on_the_bound():
    assert distribution_of(COUNT, stats.randint(3, 5)).values_at(UNIFORM).min() == 3
