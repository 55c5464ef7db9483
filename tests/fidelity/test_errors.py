"""Stated errors by hand and for quantities that converge by a known power of the number of particles."""

import math

import pytest

from landlab_debrisflow.fidelity.constants import ERROR_LAWS, PILOTS
from landlab_debrisflow.fidelity.errors import (
    count_asked,
    error_base,
    errors_after,
    errors_with,
    next_count,
    stated_errors,
)
from landlab_debrisflow.fidelity.quantities import UNITS
from landlab_debrisflow.fidelity.raster import raster_errors


def converging(bias, order, counts=PILOTS, **others):
    """Return runs in which all quantities are 100 (1 + bias (1000/N)^order)."""
    return {count: dict.fromkeys(UNITS, 100.0 * (1.0 + bias * (1000 / count) ** order)) | others for count in counts}


def test_the_base_is_the_larger_of_the_last_change_and_half_of_that_before():
    runs = {250: {"area": 80.0}, 500: {"area": 110.0}, 1000: {"area": 100.0}}
    assert error_base(runs, ["area"]) == 0.15
    assert error_base(runs | {1000: {"area": 150.0}}, ["area"]) == pytest.approx(40.0 / 150.0)


def test_related_quantities_bound_one_that_did_not_change_by_accident():
    runs = {n: {"run_out": 100.0, "centre": centre} for n, centre in ((250, 50.0), (500, 50.0), (1000, 52.0))}
    assert error_base(runs, ["run_out"]) == 0.0
    assert error_base(runs, ["run_out", "centre"]) == pytest.approx(2.0 / 52.0)


def test_quantities_that_are_nothing_or_not_known():
    runs = converging(0.1, 1.0)
    nothing = {count: run | {"eroded": 0.0} for count, run in runs.items()}
    assert stated_errors(nothing)["eroded"] == 0.0
    lost = {count: run | {"eroded": float(count == 500)} for count, run in runs.items()}
    assert stated_errors(lost)["eroded"] == math.inf
    assert next_count(count_asked(stated_errors(lost), 1000, 0.05, ["eroded"]), 1000, 8000) == 8000
    unknown = {count: run | {"speed_90": math.nan} for count, run in runs.items()}
    assert math.isnan(stated_errors(unknown)["speed"]) and math.isfinite(stated_errors(unknown)["depth"])
    assert count_asked(stated_errors(unknown), 1000, 0.05, ["speed"]) == 1000.0


@pytest.mark.parametrize("bias", [-0.06, -0.01, 0.003, 0.04])
@pytest.mark.parametrize("name", [name for name, law in ERROR_LAWS.items() if not law.reason])
def test_a_stated_error_covers_a_bias_that_falls_as_fast_as_the_law_says(name, bias):
    law = ERROR_LAWS[name]
    runs = converging(bias, law.order)
    assert stated_errors(runs)[name] >= abs(bias) / (1.0 + bias)
    for count in (2000, 4000, 8000):
        left = abs(bias) * (1000 / count) ** law.order
        assert errors_with(stated_errors(runs), count, 1000)[name] >= left
        both = runs | converging(bias, law.order, [count])
        assert errors_after(both, count, 1000)[name] >= left


def test_an_error_after_the_run_by_hand():
    """k b + f = 2.6 * 0.02 + 0.001 with 1000; that by 2^-0.7; 1.5 times 3 % over 2^0.7 - 1, and f."""
    runs = {n: dict.fromkeys(UNITS, value) for n, value in ((250, 95.0), (500, 98.0), (1000, 100.0), (2000, 100.0))}
    assert stated_errors({n: runs[n] for n in PILOTS})["speed"] == pytest.approx(0.053)
    assert errors_after(runs, 2000, 1000)["speed"] == pytest.approx(0.053 * 0.5**0.7)
    runs[2000] = dict.fromkeys(UNITS, 103.0)
    assert errors_after(runs, 2000, 1000)["speed"] == pytest.approx(1.5 * 3.0 / 103.0 / (2**0.7 - 1.0) + 0.001)
    assert errors_after(runs, 1000, 1000) == stated_errors({n: runs[n] for n in PILOTS})


def test_the_number_asked_for_leaves_the_tolerance():
    errors = stated_errors(converging(0.08, 0.5))
    for name in ("run_out", "speed", "depth", "area"):
        asked = count_asked(errors, 1000, 0.05, [name])
        assert asked > 1000 and errors_with(errors, math.ceil(asked), 1000)[name] == pytest.approx(0.05, rel=1e-3)
    assert count_asked(errors, 1000, 0.5, ["run_out"]) == 1000.0


@pytest.mark.parametrize(
    ("asked", "most", "count"), [(1000, 8000, 1000), (1001, 8000, 2000), (4000, 8000, 4000), (9e9, 5000, 5000)]
)
def test_the_next_number_is_a_doubling_up_to_the_limit(asked, most, count):
    assert next_count(asked, 1000, most) == count


def test_the_error_of_the_raster_is_half_the_change():
    fine = dict.fromkeys(UNITS, 100.0) | {"eroded": 0.0, "pressure": 0.0, "run_out": 200.0}
    coarse = fine | {"run_out": 190.0, "area": 130.0, "pressure": 1.0}
    found = raster_errors(fine, coarse)
    assert (found["run_out"], found["area"], found["eroded"], found["speed"]) == (0.025, 0.15, 0.0, 0.0)
    assert math.isnan(found["pressure"])
