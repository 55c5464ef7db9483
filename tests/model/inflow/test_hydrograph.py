"""Integrals of what is given at times, and the rows that follow from them."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from landlab_debrisflow import Hydrograph, Numerics
from landlab_debrisflow.model.inflow.hydrograph import Integral
from landlab_debrisflow.model.inflow.inflow import Inflow

LINE = {"line_start": (10.0, 10.0), "line_end": (10.0, 30.0)}
discharges = st.lists(st.floats(0.0, 100.0), min_size=2, max_size=6).filter(lambda q: sum(q) > 1.0)


@settings(deadline=None, max_examples=50)
@example([0.0, 2.5000000000000004, 0.0078125], 1.0)  # a discharge that ends small
@given(discharges, st.floats(1e-3, 1.0))
def test_the_time_of_an_amount_is_the_inverse_of_the_integral(values, share):
    times = np.cumsum(1.0 + np.arange(len(values)))
    integral = Integral(times, np.array(values))
    assert integral.total == pytest.approx(np.sum(0.5 * (np.add(values[1:], values[:-1])) * np.diff(times)), rel=1e-14)
    time = integral.when(share * integral.total)
    assert times[0] <= time <= times[-1]
    # a discharge that starts from 0 makes the time of a small amount as uncertain as its square root
    assert integral(time) == pytest.approx(share * integral.total, rel=1e-9)


@pytest.mark.slow
@settings(deadline=None, max_examples=50)
@example([1.0, 0.0, 1.0], 163, 0.65625)  # a row that two surges share
@example([1.0, 0.0, 1.0], 1, 1.0)
@given(discharges, st.integers(1, 400), st.floats(0.1, 20.0))
def test_rows_stand_for_the_whole_volume_in_equal_parts(values, count, velocity):
    times = [float(k) * 3.0 for k in range(len(values))]
    hydrograph = Hydrograph(**LINE, times=times, discharge=values, velocity=velocity)
    inflow = Inflow([hydrograph], Numerics(particle_count=count))
    rows = inflow.sources[0].rows()
    assert sum(number for *_, number in rows) == count == inflow.sources[0].particles
    entered = [time for time, *_ in rows]
    assert entered == sorted(entered) and times[0] <= entered[0] and entered[-1] <= times[-1]
    inflow.rows_entered = len(rows)
    assert inflow.over and inflow.volume == pytest.approx(hydrograph.volume, rel=1e-13)
    for _, thickness, _ in rows:
        assert 0.0 < thickness <= hydrograph.largest_thickness * (1.0 + 1e-9)


def test_a_row_is_as_wide_apart_as_its_particles():
    inflow = Inflow([Hydrograph(**LINE, times=[0, 10], discharge=20.0, velocity=4.0)], Numerics(particle_count=800))
    rows = inflow.sources[0].rows()
    time, thickness, count = map(np.array, zip(*rows, strict=True))
    np.testing.assert_allclose(thickness, 20.0 / (4.0 * 20.0), rtol=1e-14)
    along, across = 4.0 * np.diff(time)[:-1], 20.0 / count[0]  # the last row takes what is left
    np.testing.assert_allclose(along, across, rtol=0.05)
    assert time[0] == pytest.approx(0.5 * across / 4.0, rel=0.05)


def test_a_thicker_flow_enters_in_fuller_rows():
    surge = Hydrograph(**LINE, times=[0, 5, 10], discharge=[0, 80, 0], velocity=4.0)
    rows = Inflow([surge], Numerics(particle_count=1000)).sources[0].rows()
    for _, thickness, count in rows[:-1]:
        assert count == max(1, round(20.0 * np.sqrt(thickness / (surge.volume / 1000))))


def test_velocity_may_start_and_end_with_the_discharge():
    surge = Hydrograph(**LINE, times=[0, 5, 10], discharge=[0, 80, 0], velocity=[0, 4, 0])
    assert surge.largest_thickness == 1.0
    thickness = [row[1] for row in Inflow([surge], Numerics()).sources[0].rows()]
    np.testing.assert_allclose(thickness, 1.0, rtol=1e-9)
