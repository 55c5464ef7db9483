"""Maps of probabilities and quantiles, against members counted by hand."""

import numpy as np
import pytest

from landlab_debrisflow import InputError, ParameterError
from landlab_debrisflow.hazard import SWISS, hazard_maps
from landlab_debrisflow.hazard.counting import above

from .fakes import fake_results

NAN = np.nan
MAPS = "max_depth", "max_speed", "arrival_time", "max_impact_pressure"


def member(depth, speed=0.0, arrival=NAN, impact=0.0):
    """Return maps over two rows and three columns, from values at the second row, second and third column."""
    maps = {}
    for name, value, outside in zip(MAPS, (depth, speed, arrival, impact), (0.0, 0.0, NAN, 0.0), strict=True):
        maps[name] = np.full((2, 3), outside)
        maps[name][1, 1:] = value
    return maps


FOUR = [
    member([0.03, 0.6], [9.0, 2.0], [5.0, 20.0]),  # the first is a film, which does not count
    member([0.4, 1.5], [0.5, 0.7], [6.0, 30.0]),
    "SimulationError: a step became too small",
    member([1.2, 2.5], [4.0, 5.0], [7.0, 10.0], [0.0, 2e4]),
    member([0.0, 0.0], [0.0, 0.0], [NAN, NAN], [5e4, 0.0]),  # a wall: pressure without depth
]


@pytest.fixture(scope="module")
def four():
    return hazard_maps(
        fake_results(FOUR, maps=MAPS), {"max_depth": [0.5, 1.0], "max_impact_pressure": [1e4]}, [0.5, 0.75],
        scale=SWISS,
    )  # fmt: skip


def at(maps, name):
    """Return the values of a map at the two nodes that the flow touches, the others being checked to be empty."""
    values = maps[name]
    assert not np.nan_to_num(values.values[..., 0, :]).any() and not np.nan_to_num(values.values[..., 0]).any()
    return values.values[..., 1, 1:].tolist()


def test_probabilities_are_shares_of_the_members_that_came_to_their_end(four):
    assert at(four, "probability_of_reached") == [0.5, 0.75]
    assert at(four, "probability_of_max_depth") == [[0.25, 0.75], [0.25, 0.5]]
    assert at(four, "probability_of_max_impact_pressure") == [[0.25, 0.25]]
    assert four.attrs["members"] == 5 and four.attrs["members_completed"] == 4 and four.attrs["members_failed"] == 1
    assert four.attrs["failed_share"] == 0.2 and four.attrs["ensemble_digest"] == "d" * 32


def test_quantiles_lie_in_the_bin_of_their_member(four):
    """Depths are 0, 0, 0.4, 1.2 (the film is 0) and 0, 0.6, 1.5, 2.5."""
    half, three_quarters = np.array(at(four, "quantile_of_max_depth"))
    assert half[0] == 0.0
    factor = 10.0 ** (0.5 / 24.0) * (1.0 + 1e-6)
    for found, expected in ((half[1], 0.6), (three_quarters[0], 0.4), (three_quarters[1], 1.5)):
        assert expected / factor <= found <= expected * factor
    arrival = np.array(at(four, "quantile_of_arrival_time"))
    for found, expected in zip(arrival.T.ravel(), (6.0, 7.0, 20.0, 30.0), strict=True):
        assert expected / factor <= found <= expected * factor
    assert np.isnan(four.quantile_of_arrival_time.values[:, 0]).all()


def test_classes_take_depth_and_speed_of_one_member(four):
    """Member 0 is shallow, member 1 slow, member 3 strong at both nodes."""
    assert at(four, "probability_of_class") == [[0.5, 0.75], [0.25, 0.25]]
    assert four.hazard_class.values.tolist() == ["medium", "strong"]
    assert "PLANAT" in four.attrs["hazard_scale_source"]


def test_maps_have_place_and_units(four):
    assert four.x.values.tolist() == [400000.0, 400010.0, 400020.0] and "32N" in four.spatial_ref.attrs["crs_wkt"]
    assert four.probability_of_max_depth.attrs["grid_mapping"] == "spatial_ref"
    assert four.max_depth_threshold.attrs["units"] == "m" and four.quantile_of_max_speed.attrs["units"] == "m/s"


def test_the_order_of_members_does_not_matter(four):
    turned = hazard_maps(
        fake_results(FOUR[::-1], maps=MAPS, batch=2), {"max_depth": [0.5, 1.0], "max_impact_pressure": [1e4]},
        [0.5, 0.75], scale=SWISS,
    )  # fmt: skip
    assert turned.drop_attrs().identical(four.drop_attrs())


def test_members_that_have_not_been_run_are_told():
    found = hazard_maps(fake_results(FOUR, maps=MAPS, batch=2, run=[0]))
    assert found.attrs["members_completed"] == 2 and found.attrs["members_not_run"] == 3
    assert found.attrs["remark"] == "3 of 5 members have not been run yet"


@pytest.mark.parametrize(
    ("asked", "error", "words"),
    [
        ({"thresholds": {"max_depht": [1.0]}}, ParameterError, "did you mean 'max_depth'"),
        ({"thresholds": {"deposit_depth": [1.0]}}, ParameterError, "there are max_depth, max_speed"),
        ({"thresholds": {"arrival_time": [1.0]}}, ParameterError, "no map 'arrival_time'"),
        ({"thresholds": {"max_depth": [1.0, 0.5]}}, ParameterError, "must increase, got 1, 0.5"),
        ({"thresholds": {"max_depth": [-1.0]}}, ParameterError, "got -1.0"),
        ({"thresholds": {"max_depth": []}}, ParameterError, "at least one"),
        ({"thresholds": {"max_depth": ["deep"]}}, ParameterError, "must be numbers"),
        ({"thresholds": 1.0}, ParameterError, "must be a mapping"),
        ({"quantiles": [0.5, 1.0]}, ParameterError, "quantiles must lie in (0, 1), got 1.0"),
        ({"least_depth": -0.1}, ParameterError, "least_depth"),
        ({"scale": "swiss"}, ParameterError, "must be a HazardScale"),
    ],
)
def test_questions_that_have_no_answer_are_refused(asked, error, words):
    with pytest.raises(error) as told:
        hazard_maps(fake_results(FOUR, maps=MAPS), **asked)
    assert words in str(told.value)


def test_maps_that_are_needed_are_named():
    results = fake_results(FOUR, maps=("max_speed",))
    with pytest.raises(ParameterError, match="have not kept max_depth"):
        hazard_maps(results)
    with pytest.raises(ParameterError, match="needs the map 'max_speed'"):
        hazard_maps(fake_results(FOUR, maps=("max_depth",)), scale=SWISS)


def test_an_ensemble_without_members_is_refused(tmp_path):
    with pytest.raises(InputError, match="none of the 5 members has come to its end, 0 have failed; run"):
        hazard_maps(fake_results(FOUR, maps=MAPS, run=[]))
    with pytest.raises(InputError, match="4 have failed; the first error: Boom"):
        hazard_maps(fake_results(["Boom"] * 4 + FOUR[:1], maps=MAPS, run=[0]))
    with pytest.raises(InputError, match="does not exist"):
        hazard_maps(tmp_path / "members.zarr")
    (tmp_path / "half.zarr").mkdir()
    with pytest.raises(InputError, match="holds no ensemble"):
        hazard_maps(tmp_path / "half.zarr")


def test_a_value_at_a_threshold_does_not_exceed_it():
    assert above("max_depth", 0.5).came({"max_depth": np.array([0.5, 0.75])}).tolist() == [False, True]
