"""Measures of an event, by their definitions on maps made by hand."""

import math

import numpy as np
import pytest
import xarray as xr

import landlab_debrisflow
from landlab_debrisflow import DebrisFlow, InputError, measures
from landlab_debrisflow.record.measures import quantile

X, Y = 100.0 + 10.0 * np.arange(6), 200.0 + 5.0 * np.arange(3)  # cells of 50 m2
FALL = np.broadcast_to(50.0 - 0.5 * (X - 100.0), (3, 6))


def maps(elevation=FALL, **outputs):
    """Return maps with some outputs and zeros in the others."""
    names = ("release_depth", "max_depth", "max_speed", "eroded_depth", "deposit_depth", "max_basal_peclet_number")
    data = {
        f"debris_flow__{name}": (("y", "x"), np.array(outputs.get(name, np.zeros((3, 6))), float)) for name in names
    }
    return xr.Dataset({"topographic__elevation": (("y", "x"), np.array(elevation)), **data}, {"y": Y, "x": X})


def row(*values):
    """Return a map with these values in the middle row and zeros elsewhere."""
    return np.array([np.zeros(6), values, np.zeros(6)])


BEFORE = maps(release_depth=row(1.0, 1.0, 0.0, 0.0, 0.0, 0.0))
AFTER = maps(
    max_depth=row(2.0, 1.5, 1.0, 0.05, 0.5, 0.0), max_speed=row(1.0, 4.0, 3.0, 2.0, 1.0, 0.0),
    eroded_depth=row(0.0, 0.005, 0.4, 0.2, 0.0, 0.0), deposit_depth=row(0.0, 0.0, 0.0, 0.05, 0.45, 0.0),
    max_basal_peclet_number=row(0.0, 99.0, 30.0, 10.0, 0.0, 0.0),
)  # fmt: skip


def test_areas_and_volumes():
    found = measures(AFTER)
    assert found.inundated_area == 250.0 and measures(AFTER, flow_threshold=0.1).inundated_area == 200.0
    assert found.eroded_area == 100.0 and measures(AFTER, erosion_threshold=0.0).eroded_area == 150.0
    assert found.deposit_area == 50.0 and measures(AFTER, deposit_threshold=0.05).deposit_area == 100.0
    assert found.eroded_volume == pytest.approx(0.605 * 50.0) and found.deposit_volume == pytest.approx(25.0)


def test_depths_and_peaks():
    found = measures(AFTER, deposit_threshold=0.01)
    assert found.max_depth == 2.0 and found.max_speed == 4.0
    assert found.max_eroded_depth == 0.4 and found.max_deposit_depth == 0.45
    assert found.mean_deposit_depth == pytest.approx(0.25) and found.median_deposit_depth == pytest.approx(0.25)
    assert found.max_basal_peclet_number == 30.0 and found.median_basal_peclet_number == 20.0


def test_way_from_the_centre_of_the_release_and_from_its_crown():
    found = measures(AFTER, BEFORE)  # nine tenths of the deposit lie at x = 140, a tenth at 130
    assert found.run_out == 35.0 and found.farthest_run_out == 35.0  # the centre is at x = 105
    assert found.centre_run_out == pytest.approx(34.0)
    assert found.fall_height == 20.0 and found.travel_distance == 40.0
    assert found.travel_angle == pytest.approx(math.degrees(math.atan(0.5)))


def test_the_front_is_where_the_share_lies_behind():
    tail = maps(deposit_depth=row(0.0, 0.0, 9.0, 0.9, 0.1, 0.0))
    far = {share: float(measures(tail, BEFORE, front_fraction=share).run_out) for share in (0.5, 0.95, 0.995)}
    assert far == {0.5: 15.0, 0.95: 25.0, 0.995: 35.0}
    assert measures(tail, BEFORE, front_fraction=0.5).farthest_run_out == 35.0
    assert quantile(np.array([3.0, 1.0, 2.0]), np.array([1.0, 1.0, 98.0]), 0.995) == 3.0


def test_a_distance_of_ones_own():
    found = measures(AFTER, distance=lambda x, y: x - 120.0 + 0.0 * y)
    assert found.run_out == 20.0 and "travel_angle" not in found
    both = measures(AFTER, BEFORE, distance=lambda x, y: x - 120.0)
    assert both.run_out == 20.0 and both.travel_distance == 40.0


def test_only_what_is_inside():
    inside = np.broadcast_to(X < 125.0, (3, 6))
    found = measures(AFTER, BEFORE, inside=inside)
    assert found.max_deposit_depth == 0.0 and math.isnan(found.mean_deposit_depth)
    assert found.eroded_volume == pytest.approx(0.405 * 50.0)
    assert found.run_out == 35.0  # of the whole event
    assert found.identical(measures(AFTER, BEFORE, inside=inside.ravel()))  # nodes of the grid


def test_missing_nodes_count_as_nothing():
    holes = AFTER.where(X != 100.0)
    assert measures(holes).inundated_area == 200.0 and measures(holes).max_speed == 4.0
    assert measures(holes).eroded_volume == measures(AFTER).eroded_volume


def test_nothing_happened():
    found = measures(maps(), BEFORE)
    assert found.inundated_area == 0.0 and found.deposit_volume == 0.0 and found.max_speed == 0.0
    for name in ("run_out", "centre_run_out", "travel_angle", "median_deposit_depth", "max_basal_peclet_number"):
        assert math.isnan(found[name]), name
    nothing_failed = measures(AFTER, maps())  # what flowed in across a line has no crown
    assert math.isnan(nothing_failed.run_out) and math.isnan(nothing_failed.travel_angle)
    assert nothing_failed.deposit_volume == pytest.approx(25.0)


def test_every_measure_has_unit_and_meaning():
    for name, value in measures(AFTER, BEFORE).items():
        assert value.shape == () and value.attrs["units"] and value.attrs["long_name"], name
    assert measures(AFTER, BEFORE).travel_angle.units == "degree"


@pytest.mark.parametrize("other", [xr.Dataset(), AFTER.expand_dims(time=2)], ids=["no maps", "of two moments"])
def test_it_needs_maps_of_one_moment(other):
    with pytest.raises(InputError, match="needs a DebrisFlow or its maps at one moment"):
        measures(other)


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"front_fraction": 0.0}, r"front_fraction must lie in \(0, 1\], got 0.0"),
        ({"deposit_threshold": -0.1}, "thresholds must be finite depths >= 0"),
        ({"inside": np.ones((2, 6), bool)}, r"one value for each of the 3 x 6 nodes, got shape \(2, 6\)"),
        ({"before": BEFORE.isel(x=slice(5))}, "before has"),
    ],
)
def test_what_cannot_be_measured_is_refused(wrong, words):
    with pytest.raises(InputError, match=words):
        measures(AFTER, **wrong)


@pytest.mark.parametrize("wrong", [(3,), (BEFORE, 5), (BEFORE.to_dict(),)], ids=["a number", "before", "a mapping"])
def test_what_is_no_flow_is_refused(wrong):
    with pytest.raises(InputError, match=r"measures: (needs a DebrisFlow or its maps|before must be flow\.maps)"):
        measures(*wrong)


def test_of_a_flow_that_moves_and_of_its_deposit(valley):
    flow = DebrisFlow(valley, numerics={"particle_count": 100})
    before = flow.maps
    flow.run_one_step(2.0)
    moving, p = measures(flow, before), flow.particles
    far = np.hypot(p.x - 30.0, p.y - 50.0)
    assert float(moving.farthest_run_out) == pytest.approx(float(far.max())) and moving.elapsed_time == 2.0
    assert moving.run_out <= moving.farthest_run_out
    flow.run_until_rest()
    settled = measures(flow, before)
    assert settled.identical(measures(flow.maps, before))  # no particles are left
    assert settled.run_out > moving.run_out
    for name, volume in flow.budget.items():
        assert settled[f"budget_{name}"] == volume
    assert settled.deposit_volume == pytest.approx(flow.budget["deposited"], rel=1e-12)
    assert settled.eroded_volume == pytest.approx(flow.budget["eroded"], rel=1e-12)
    # the slope of 27 degrees ends in a flat: the line from crown to front falls less steeply
    assert 0.0 < settled.travel_angle < 26.6
    assert float(settled.travel_angle) == pytest.approx(
        math.degrees(math.atan2(settled.fall_height, settled.travel_distance))
    )


def test_it_is_public():
    assert landlab_debrisflow.measures is measures and "measures" in landlab_debrisflow.__all__
