"""Forecasts of cost from pilot runs whose steps and times follow known laws."""

import math

import pytest

from landlab_debrisflow.fidelity.cost import Cost, forecast_cost


def costs(power, fixed, each, counts=(250, 500, 1000)):
    """Return costs with 100 (N/1000)^power steps of fixed + each * N seconds."""
    steps = {n: 100.0 * (n / 1000) ** power for n in counts}
    return {n: Cost(steps[n], steps[n] * (fixed + each * n)) for n in counts}


@pytest.mark.parametrize("power", [0.3, 0.5, 1.0])
def test_steps_by_a_power_and_times_on_a_line_are_found_again(power):
    found = forecast_cost(costs(power, 1e-3, 1e-6), 4000)
    assert found.steps == pytest.approx(100.0 * 4**power)
    assert found.seconds == pytest.approx(found.steps * 5e-3)


def test_steps_grow_and_times_do_not_fall():
    assert forecast_cost(costs(0.0, 1e-3, 1e-6), 8000).steps == pytest.approx(100.0 * 8**0.3)
    assert forecast_cost(costs(0.5, 1e-3, -5e-7), 8000).seconds == pytest.approx(100.0 * 8**0.5 * 5e-4)
    steep = forecast_cost(costs(0.5, -2e-4, 1e-6), 8000)  # no faster than in proportion to the number
    assert steep.seconds == pytest.approx(100.0 * 8**0.5 * 8e-4 * 8.0)


def test_times_of_runs_that_compiled_do_not_count():
    known = costs(0.5, 1e-3, 1e-6)
    broken = known | {250: Cost(known[250].steps, math.nan)}
    assert forecast_cost(broken, 4000).seconds == pytest.approx(forecast_cost(known, 4000).seconds)
    assert math.isnan(forecast_cost({n: Cost(one.steps, math.nan) for n, one in known.items()}, 4000).seconds)


def test_a_range_is_that_of_the_nearest_number():
    assert Cost(100.0, 13.0).between(2000) == Cost(100.0, 13.0).between(2500)
    assert Cost(100.0, 13.0).between(2000) == pytest.approx((10.0, 13.0 / 0.87))
