"""The closed forms against the printed tables of docs/theory.md#column-solutions and against each other."""

import doctest

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import erf

from landlab_debrisflow.exact import columns
from landlab_debrisflow.physics.column import ale, classical, constant_ratio, diagnostics, driver, none
from landlab_debrisflow.physics.column import initial as start

XI = (0.1, 0.25, 0.5, 0.75, 0.9)
TABLE = [
    (0.01, 0.05, (0.75208556, 0.42950113, 0.11394816, 0.01763858, 0.00392295)),
    (0.01, 0.5, (0.89883958, 0.74723714, 0.49594034, 0.24707639, 0.09871642)),
    (1.0, 0.1, (0.84753336, 0.61218929, 0.28326544, 0.09243639, 0.03097181)),
    (1.0, 1.0, (0.94089764, 0.83184861, 0.59859240, 0.31356233, 0.12708034)),
    (1.0, 5.0, (0.97831517, 0.92025035, 0.73090485, 0.41115915, 0.17028512)),
    (10.0, 0.01, (0.67844640, 0.17061076, 0.00125779, 2.6e-7, 0.0)),
    (10.0, 0.1, (0.99011530, 0.92730926, 0.58528299, 0.16827556, 0.04423750)),
    (10.0, 1.0, (1.0, 0.99999994, 0.99949447, 0.90162057, 0.47910144)),
]


@pytest.mark.parametrize("number, time, values", TABLE)
def test_growing_column_has_all_printed_digits(number, time, values):
    assert_allclose(columns.growing_column(XI, time, number), values, rtol=0.0, atol=0.5e-8 + 1e-12)


@pytest.mark.parametrize("number", [0.0, 1e-3, 1.0, 1e4, 1e8])
@pytest.mark.parametrize("time", [1e-8, 1e-6, 1e-2, 1.0, 1e2])
def test_growing_column_neither_overflows_nor_leaves_its_bounds(number, time):
    with np.errstate(over="raise", invalid="raise", divide="raise"):
        for initial in (0.0, 0.3, 1.0):
            profile = columns.growing_column(np.linspace(0.0, 1.0, 21), time, number, initial)
            assert np.all((profile > -1e-12) & (profile < 1.0 + 1e-12))
            assert_allclose(profile[[0, -1]], [1.0, 0.0], atol=1e-12)


def test_growing_column_solves_the_equation():
    """eq. 35 by central differences: h^2 error 1e-8 and cancellation 1e-16/1e-8."""
    xi, time, number, step = np.array([0.2, 0.5, 0.8]), 0.3, 4.0, 1e-4

    def p(x, t):
        return columns.growing_column(x, t, number, 0.2)

    h = 1.0 + number * time
    rate = (p(xi, time + step) - p(xi, time - step)) / (2.0 * step)
    slope = (p(xi + step, time) - p(xi - step, time)) / (2.0 * step)
    bend = (p(xi + step, time) - 2.0 * p(xi, time) + p(xi - step, time)) / step**2
    assert_allclose(rate + number / h * (1.0 - xi) * slope, bend / h**2, atol=1e-5)


def test_without_growth_it_is_the_plain_heat_equation():
    xi = np.linspace(0.0, 1.0, 11)
    assert_allclose(columns.growing_column(xi, 100.0, 0.0), 1.0 - xi, atol=1e-12)


def test_constant_local_peclet_between_its_limits():
    xi = np.linspace(0.0, 1.0, 11)
    assert_allclose(columns.constant_local_peclet(xi, 0.0), 1.0 - xi)
    assert_allclose(columns.constant_local_peclet(xi, 1e-6), 1.0 - xi, atol=1e-6)
    assert_allclose(columns.constant_local_peclet(xi, 8.0), erf(2.0 * (1.0 - xi)) / erf(2.0))
    assert_allclose(columns.constant_local_peclet(xi, 1e6)[:-1], 1.0)


def test_consolidation_has_the_printed_digits():
    base = [float(columns.consolidation(0.0, time)) for time in (0.05, 0.1, 0.2, 0.5, 1.0)]
    assert_allclose(base, [0.7477, 0.6432, 0.4959, 0.2360, 0.0687], atol=0.5e-4)
    # untouched layer h/10, h = 3.16 m, c_v = 4e-4 m2/s, after 32, 160 and 400 s
    layer = [float(columns.consolidation(0.0, 4e-4 * t / 3.16**2, "basal_layer", 0.1)) for t in (32, 160, 400)]
    assert_allclose(layer, [0.95, 0.62, 0.42], atol=0.5e-2)


def test_consolidation_at_small_times():
    """Half space: slope at the closed base, and a layer that the surface does not influence."""
    time = 1e-4
    assert_allclose(columns.consolidation(0.0, time), 1.0 - 2.0 * np.sqrt(time / np.pi), rtol=1e-12)
    assert_allclose(columns.consolidation(0.0, time, "basal_layer", 0.02), erf(0.02 / (2.0 * np.sqrt(time))), rtol=1e-9)
    assert_allclose(columns.consolidation(np.array([0.0, 0.5]), 0.0), [1.0, 0.5], atol=3e-5)  # 10 000 terms


def test_peclet_numbers_are_ratios_of_times():
    thickness, rate, coefficient = np.array([0.5, 2.0]), 0.05, 4e-4
    number = diagnostics.basal_peclet_number(rate, thickness, coefficient)
    times = diagnostics.consolidation_time(thickness, coefficient) / diagnostics.erosion_time(thickness, rate)
    assert_allclose(number, times, rtol=1e-15)


@pytest.mark.parametrize("module", [ale, columns, classical, constant_ratio, driver, none, diagnostics, start])
def test_docstrings(module):
    with np.errstate(all="raise", under="ignore"):
        assert doctest.testmod(module).failed == 0


@pytest.mark.parametrize("levels", [3, 11, 21, 41])
@pytest.mark.parametrize("layer", [0.0, 0.01, 0.1, 0.125, 0.5])
def test_a_basal_layer_starts_with_its_own_content(levels, layer):
    """Ratio .01, so that liquefaction does not cut it; a layer up to the surface loses half a cell there."""
    profile = start.initial_profile(np.array([100.0]), levels, 0.01, "basal_layer", layer)
    mean = (profile.sum() - 0.5 * (profile[0, 0] + profile[0, -1])) / (levels - 1)
    assert_allclose(mean, layer, rtol=1e-12, atol=1e-15)


@pytest.mark.parametrize("profile", ["linear", "uniform", "basal_layer"])
def test_no_start_is_more_than_liquefied(profile):
    eta = np.linspace(1.0, 0.0, 11)
    for ratio in (0.0, 0.65, 1.0):
        pressure = start.initial_profile(np.array([0.0, 50.0]), 11, ratio, profile, 1.0)
        assert np.all((pressure >= 0.0) & (pressure <= np.array([[0.0], [50.0]]) * eta))
        assert_allclose(pressure[1, 0], ratio * 50.0)
