"""Set-up and measures of the flume with an erodible bed, on series made by hand; with measured data where there are."""

import numpy as np
import pytest
import xarray as xr

from validation.events import data, find_event
from validation.events.flume_entrainment import measures, setup
from validation.events.sets import set_names

EVENT = find_event("flume_entrainment")
missing = data.absence("flume_sgm", "dem.asc") or data.absence("flume_entrainment", "soil_depth.asc")
needs_data = pytest.mark.skipif(bool(missing), reason=missing)


def surge(time, arrival, peak):
    """Return a series that rises in .2 s and falls in 6 s."""
    return np.interp(time, [arrival, arrival + 0.2, arrival + 6.2], [0.0, peak, 0.0])


def beds(speeds=(10.0, 12.5, 8.0, 9.0), scours=(0.0, 8.0, 1.0, 0.0)):
    """Return series of a control, a wet and a dry bed whose fronts reach 32 m at 4 s."""
    time = setup.TIMES
    thickness = [
        [surge(time, 1.0, 0.3), surge(time, 4.0, 0.2), surge(time, 4.0 + measures.REACH / each, 0.2)]
        for each in speeds
    ]  # fmt: skip
    volume = [np.interp(time, [4.0, 6.0], [0.0, each]) for each in scours]
    places = np.array([0.0, 0.005, 0.1])  # never, too little, 10 cm in 2 s from 4 s on
    eroded = [np.interp(time, [4.0, 6.0], [0.0, 1.0])[:, None] * places * (each > 0.0) for each in scours]
    momentum = [each * np.interp(time, [0.0, 5.0, 20.0], [0.0, 1e4, 0.0]) for each in speeds]
    return xr.Dataset(
        {
            "thickness": (("run", "station", "time"), thickness),
            "pressure": (("run", "station", "time"), 1e4 * np.array(thickness)),
            "momentum": (("run", "time"), momentum), "eroded_volume": (("run", "time"), volume),
            "eroded": (("run", "time", "s"), np.array(eroded)), "outflow": ("run", [0.0, 0.0, 0.5, 0.0]),
        },
        {"run": list(setup.KINDS), "station": ["2 m", "32 m", "66 m"], "time": time, "s": [10.0, 20.0, 30.0]},
    )  # fmt: skip


def test_speeds_momenta_and_scour_of_series_made_by_hand():
    found = EVENT.score(beds())
    assert found["control speed"] == pytest.approx(10.0, rel=0.01)
    for word in ("speed", "foot"):
        assert found[f"wet {word}"] == pytest.approx(1.25, rel=0.01)  # series have steps of .05 s
        assert found[f"dry {word}"] == pytest.approx(0.8, rel=0.01)
    assert found["shape speed"] == pytest.approx(0.9, rel=0.01)
    assert (found["wet momentum"], found["dry momentum"]) == pytest.approx((1.25, 0.8))
    assert found["scour ratio"] == pytest.approx(1.0 / 8.0) and found["wet scour"] == 8.0
    assert found["scour rate"] == pytest.approx(5.0, rel=1e-6)  # cm/s, of the one place that counts
    assert found["outflow"] == 0.5 and np.isnan(found["threshold"])
    assert set(found) == set(EVENT.measures)
    assert all(target.met(found[target.measure]) for target in EVENT.targets)


def test_a_plug_behind_the_front_has_no_speed():
    result = beds()
    result["thickness"][0, 1] = surge(setup.TIMES, 15.0, 3.0)
    found = EVENT.score(result)
    assert np.isnan(found["control speed"]) and np.isnan(found["wet speed"])


def test_signs_the_other_way_meet_no_target_but_the_rate():
    found = EVENT.score(beds(speeds=(10.0, 9.0, 11.0, 10.0), scours=(0.0, 2.0, 1.0, 0.0)))
    assert [target.measure for target in EVENT.targets if target.met(found[target.measure])] == ["scour rate"]


def test_the_switch_is_where_half_of_the_scour_is_reached():
    contents = {"water_content": [0.1, 0.2, 0.3]}
    scour = xr.Dataset({"scour_by_content": ("water_content", [0.0, 1.0, 4.0])}, contents)
    assert measures.switch(scour) == pytest.approx(0.2 + 0.1 / 3.0)
    scour["scour_by_content"][:] = 4.0
    assert np.isnan(measures.switch(scour))  # all yield alike


def test_sets_differ_in_what_they_say():
    sets = {name: EVENT.read_set(name) for name in set_names(EVENT.folder / "sets")}
    laws = {name: each.plain("erosion")["law"] for name, each in sets.items()}
    assert laws.pop("liquefied_bed") == "liquefied_bed" and set(laws.values()) == {"excess_traction"}
    assert sets["water_content"].plain("site")["wet_degree_of_saturation"] == 0.64
    assert [words for words, _ in setup._beds(sets["slip"], with_contents=True)] == list(setup.KINDS)
    beds = dict(setup._beds(sets["measured_pressure"], with_contents=True))
    assert len(beds) == 11 and beds["0.28"].degree_of_saturation == pytest.approx(0.7)
    assert beds["control"].degree_of_saturation is None and beds["dry bed"].is_drain and not beds["wet bed"].is_drain


@needs_data
@pytest.mark.slow
def test_the_bed_lies_on_the_concrete_and_the_control_has_none():
    control = setup.build_grid(setup.BedWater(None))
    wet = setup.build_grid(setup.BedWater(1.0, 0.8, True))
    soil = wet.at_node["soil__depth"] - wet.at_node["debris_flow__release_depth"]
    assert soil.sum() * wet.dx * wet.dy == pytest.approx(11.3, abs=0.1)  # the published volume
    np.testing.assert_allclose(
        wet.at_node["topographic__elevation"] - control.at_node["topographic__elevation"], soil, atol=1e-12
    )
    assert np.array_equal(wet.at_node["bed__drained"] > 0.0, soil > 0.0)
    assert "bed__degree_of_saturation" not in control.at_node
