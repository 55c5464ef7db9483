"""Measures at given times are interpolated between the two steps around, and nothing is made up beyond."""

from types import SimpleNamespace

import numpy as np
import pytest

from landlab_debrisflow import InputError
from landlab_debrisflow.record.observers import EVERY_STEP
from landlab_debrisflow.record.series import Series

from ..twins import Failed, Fails, build, run_through


def measure(flow):
    p = flow.particles
    return {"time": flow.elapsed_time, "eroded": flow.budget["eroded"], "centre": [float(p[k].mean()) for k in "xy"]}


class Steps:
    """Keeps all measures of every step."""

    interval = EVERY_STEP

    def __init__(self):
        self.kept = {}

    def observe(self, flow):
        self.kept[flow.elapsed_time] = measure(flow)


def wanted(times):
    return Series(times, lambda flow: {f"the {name}": value for name, value in measure(flow).items()})


@pytest.mark.slow
def test_they_are_interpolated_between_the_steps_around():
    steps, times = Steps(), np.arange(0.0, 12.0, 0.37)
    series = wanted(times)
    flow = build("eroding", [steps, series])
    flow.run_until_rest()
    found, known = series.dataset, sorted(steps.kept)
    assert flow.elapsed_time > times[-1] and "between the two steps around" in found.attrs["interpolation"]
    np.testing.assert_array_equal(found.time, times)
    np.testing.assert_allclose(found["the time"], times, rtol=1e-14, atol=0.0)
    by_hand = np.interp(times, known, [steps.kept[time]["eroded"] for time in known])
    np.testing.assert_allclose(found["the eroded"], by_hand, rtol=1e-12, atol=0.0)
    for k in range(2):
        by_hand = np.interp(times, known, [steps.kept[time]["centre"][k] for time in known])
        np.testing.assert_allclose(found["the centre"][:, k], by_hand, rtol=1e-12, atol=0.0)
    assert found["the eroded"].dims == ("time",) and found.time.attrs["units"] == "s"
    assert float(found["the eroded"][0]) == 0.0 < float(found["the eroded"][-1])


@pytest.mark.slow
def test_times_of_steps_are_met_exactly_and_those_not_reached_are_left_out():
    steps = Steps()
    build("eroding", [steps]).run_until_rest()
    known = sorted(steps.kept)
    series = wanted([*known[::7], known[-1] + 1.0])
    build("eroding", [series]).run_until_rest()
    assert series.dataset.time.values.tolist() == known[::7]
    assert series.dataset["the eroded"].values.tolist() == [steps.kept[time]["eroded"] for time in known[::7]]


@pytest.mark.slow
def test_calls_and_interruptions_make_no_gaps():
    times = np.arange(0.0, 6.0, 0.25)
    one, pieces, broken = wanted(times), wanted(times), wanted(times)
    flow = build("eroding", [one])
    flow.run_one_step(6.0)
    flow = build("eroding", [pieces])
    for _ in range(3):
        flow.run_one_step(2.0)
    flow = build("eroding", [Fails(5, 11, 20, error=Failed), broken])
    assert run_through(flow, 6.0) == 3
    assert pieces.dataset.time.values.tolist() == times.tolist()
    assert broken.dataset.identical(one.dataset)


def test_what_was_before_the_first_look_is_not_known():
    series = wanted([0.5, 1.0, 3.0])
    flow = build("eroding")
    flow.run_one_step(1.0)
    flow._observers = (series,)
    flow.run_one_step(3.0)
    assert series.dataset.time.values.tolist() == [1.0, 3.0]


def test_nothing_observed_is_nothing():
    assert Series([1.0], measure).dataset.sizes == {"time": 0}


@pytest.mark.parametrize("times", [[1.0, 1.0], [2.0, 1.0], [np.nan], [[1.0, 2.0]], [0.0, np.inf]])
def test_times_must_increase(times):
    with pytest.raises(InputError, match="times must be finite numbers of seconds that increase"):
        Series(times, measure)


def test_a_measure_must_be_one():
    with pytest.raises(InputError, match="measure must be callable"):
        Series([1.0], {"eroded": 0.0})
    sizes = iter(range(100))
    flow = build("eroding", [Series([1.0], lambda flow: {"some": np.zeros(next(sizes))})])
    with pytest.raises(InputError, match=r"same names and shapes every time, got some \(1,\) after some \(0,\)"):
        flow.run_until_rest()


def test_a_measure_without_a_name_is_refused():
    flow = SimpleNamespace(elapsed_time=0.0, budget={"eroded": 46.0})
    with pytest.raises(InputError, match=r"mapping of names to numbers, .* got 46.0"):
        Series([0.0], lambda flow: flow.budget["eroded"]).observe(flow)
