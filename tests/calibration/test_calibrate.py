"""Calibration of scenes: truths are found again, stores are continued, sums are those of batches in order."""

import shutil

import numpy as np
import pytest
import rasterio
import xarray as xr

from landlab_debrisflow import InputError, ParameterError
from landlab_debrisflow.calibration import (
    AtPoint,
    ElevationChange,
    Event,
    Measure,
    RunOut,
    calibrate,
    calibrate_events,
)
from landlab_debrisflow.calibration.predictive import weighted_sums
from landlab_debrisflow.ensemble import Ensemble
from landlab_debrisflow.hazard import write_hazard
from landlab_debrisflow.plots import draw_probability
from landlab_debrisflow.scene.gully import LATTICE

WEST, SOUTH = LATTICE.lower_left
HEAD = [[WEST + x, SOUTH + y] for x, y in ((20.0, 140.0), (45.0, 140.0), (45.0, 165.0), (20.0, 165.0))]
SCENE = {
    "terrain": {"example": "gully"}, "release": {"polygons": HEAD, "depth": 1.5},
    "friction": {"law": "voellmy", "basal_friction_angle": 28.0}, "numerics": {"particle_count": 30},
    "output": {"max_duration": 2.0},
}  # fmt: skip
VOLUME, ANGLE = "release.volume", "friction.basal_friction_angle"
VARY = {ANGLE: {"uniform": {"low": 22.0, "high": 34.0}}, VOLUME: {"lognormal": {"median": 700.0, "sigma": 0.3}}}
TRUTH = 900.0
RUNS = {"members": 16, "generations": 2, "maps": ("max_depth",), "workers": 1, "batch": 4, "seed": 1}


@pytest.fixture(scope="module")
def truth():
    """Return the run of known values, and the change of elevation that it leaves."""
    maps = "max_depth", "deposit_depth", "depth", "eroded_depth"
    runs = Ensemble(SCENE, sampling={ANGLE: [28.0], VOLUME: [TRUTH]}, maps=maps)
    (one,) = runs.run(workers=1).members()
    change = np.zeros(LATTICE.shape)
    change[one.rows, one.columns] = one.maps["deposit_depth"] + one.maps["depth"] - one.maps["eroded_depth"]
    return one, xr.DataArray(change, {"y": LATTICE.y, "x": LATTICE.x}, ("y", "x"))


@pytest.fixture(scope="module")
def observations(truth):
    one, change = truth
    return [
        Measure("eroded_volume", one.measures["eroded_volume"], 2.0), ElevationChange(change, 0.3, 10.0),
        AtPoint("max_depth", WEST + 50.0, SOUTH + 150.0, 0.5, 1.0),
    ]  # fmt: skip


@pytest.fixture(scope="module")
def store(tmp_path_factory):
    return tmp_path_factory.mktemp("calibration") / "store"


@pytest.fixture(scope="module")
def posterior(observations, store):
    return calibrate(SCENE, VARY, observations, store=store, **RUNS)


def test_the_truth_is_found_again(posterior):
    low, high = posterior.interval(0.9)[VOLUME]
    prior = np.ptp(np.quantile(posterior.members.release__volume[:16], [0.05, 0.95]))
    assert low < TRUTH < high and high - low < 0.7 * prior
    assert posterior.members.sizes == {"member": 32, "observation": 3}
    assert posterior.weights.sum() == pytest.approx(1.0) and posterior.members.generation.values[-1] == 1
    (noise,) = [note for note in posterior._table().notes if "threshold" in note]  # P(|e| > 0.2) of sd 0.3 is 0.505
    assert "errors of 0.3 m alone carry 50 %" in noise and "a threshold of 0.6 m leaves 5 %" in noise
    assert abs(float(posterior.members.release__volume[posterior.best]) - TRUTH) < 0.2 * TRUTH


def test_the_table_says_in_sample_baseline_and_noise_floor(posterior):
    text = " ".join(str(posterior).split())
    for words in (
        "in-sample", "prior is", "noise floor", "outside of the release", "inside the release", "volume lowered",
        "expected of a", "effective size", "release.volume", "perfect model", "correlation",
    ):  # fmt: skip
        assert words in text, words
    scores = {one.name: one for one in posterior.scores()}
    assert scores["misfit of eroded_volume"].unit == "m3"
    lowered = scores["misfit of eroded_volume"].values
    assert lowered["best member"] < lowered["posterior"] < lowered["prior"]
    outside = scores["CSI of change outside of the release"]
    assert outside.values["best member"] > outside.values["prior"] and 0.0 < outside.reference < 1.0


def test_predictive_maps_are_means_over_weights(posterior):
    maps = posterior.predictive({"max_depth": [0.5, 1.0], "eroded_depth": []})
    results, expected = posterior.results[""], np.zeros(LATTICE.shape)
    members = [one for generation in results for one in generation.members()]
    for one, weight in zip(members, posterior.weights, strict=True):
        expected += weight * (one.on_lattice("max_depth", LATTICE.shape) > 1.0)
    # the order of sums differs: rounding of numbers of at most 1
    assert np.allclose(maps.probability_of_max_depth.sel(max_depth_threshold=1.0), expected, rtol=0.0, atol=1e-14)
    assert float(maps.probability_of_max_depth.max()) == pytest.approx(1.0) and "mean_of_eroded_depth" in maps
    (panel,) = draw_probability(maps, "max_depth", 1.0).axes  # no standard error is known
    assert panel.get_title(loc="left") == "Probability of peak depth > 1 m"
    with pytest.raises(InputError, match="the map 'max_speed' was not kept"):
        posterior.predictive({"max_speed": 1.0})


def test_predictive_maps_are_written_as_hazard_maps_are(posterior, tmp_path):
    maps = posterior.predictive({"max_depth": [0.5], "eroded_depth": []})
    names = {path.name for path in write_hazard(tmp_path, maps)}
    maps_of = {"mean_of_max_depth.tif", "mean_of_eroded_depth.tif", "probability_of_max_depth_above_0.5_m.tif"}
    assert names == {"hazard.nc", *maps_of, "probability_of_max_depth_above_0.5_m.png"}
    with rasterio.open(tmp_path / "mean_of_max_depth.tif") as file:
        values = maps.mean_of_max_depth.values
        assert np.array_equal(file.read(1)[::-1], np.where(values > 0, values, np.nan).astype("f4"), equal_nan=True)
        assert float(file.tags()["effective_sample_size"]) == pytest.approx(posterior.effective_size)


def test_draws_of_the_posterior_are_members_of_another_ensemble(posterior):
    drawn = posterior.draw(40, seed=3)
    names = {str(values.attrs["key"]): name for name, values in drawn.data_vars.items() if "key" in values.attrs}
    assert set(names) == {ANGLE, VOLUME} and drawn.attrs["effective_sample_size"] == posterior.effective_size
    known = posterior.members[names[VOLUME]].values
    for value, weight in zip(known, posterior.weights, strict=True):
        assert abs(int((drawn[names[VOLUME]] == value).sum()) - 40 * weight) < 1.0
    other = Ensemble(SCENE | {"output": {"max_duration": 1.0}}, sampling=drawn.drop_vars(names[VOLUME]))
    assert other.members == 40 and other.values(0) == {ANGLE: float(drawn[names[ANGLE]][0])}
    with pytest.raises(InputError, match="members must lie in"):
        posterior.draw(0)


def test_sums_are_those_of_batches_in_their_order(posterior):
    generation, weights = posterior.results[""][0], np.random.default_rng(0).random(16)
    sums = weighted_sums([generation], weights, {"x": lambda one: one.maps["max_depth"].astype(float)})["x"]
    total, members = np.zeros(LATTICE.shape), list(generation.members())
    for first in range(0, 16, 4):
        part = np.zeros(LATTICE.shape)
        for one in members[first : first + 4]:
            part[one.rows, one.columns] += weights[one.member] * one.maps["max_depth"].astype(float)
        total += part
    assert sums.tobytes() == total.tobytes()


def test_a_store_is_continued_and_another_calibration_is_refused(posterior, observations, store, tmp_path):
    notes = []
    again = calibrate(SCENE, VARY, observations, store=store, notify=notes.append, **RUNS)
    assert again.weights.tobytes() == posterior.weights.tobytes()
    assert not [note for note in notes if "members done" in note]
    for other in ({"seed": 2}, {"members": 24}):
        with pytest.raises(InputError, match="holds another calibration, of digest"):
            calibrate(SCENE, VARY, observations, store=store, **RUNS | other)
    with pytest.raises(InputError, match="holds another calibration, of digest"):
        calibrate(SCENE, VARY, [Measure("eroded_volume", 80.0, 4.0)], store=store, **RUNS)
    (tmp_path / "generation_000.npy").touch()
    with pytest.raises(InputError, match=r"holds generations without calibration\.json"):
        calibrate(SCENE, VARY, observations, store=tmp_path, **RUNS)


def test_a_killed_calibration_goes_on_with_the_points_it_had(posterior, observations, store, tmp_path):
    half = tmp_path / "half"
    shutil.copytree(store, half)
    shutil.rmtree(half / "generation_001.zarr" / "batches" / "000002")
    notes = []
    again = calibrate(SCENE, VARY, observations, store=half, notify=notes.append, **RUNS)
    assert again.weights.tobytes() == posterior.weights.tobytes()
    assert [note for note in notes if "members done" in note] == ["ensemble: 16 of 16 members done"]


def test_more_particles_are_scored_beside_those_of_the_calibration(posterior):
    found = posterior.rescore(members=4, workers=1)
    assert list(found.sets) == ["30 particles", "60 particles"] and found.runs.scene.content is not None
    score = found.scores[0].values
    assert score["30 particles"] != score["60 particles"] and "60 particles" in str(found)


def test_the_posterior_predicts_another_event_beside_the_prior(posterior):
    scene = SCENE | {"material": {"initial_pressure_ratio": 0.5}}
    found = posterior.predict(Event(scene, [Measure("eroded_volume", 80.0, 4.0)]), members=4, workers=1)
    assert list(found.sets) == ["posterior", "prior"] and "out of sample" in str(found)


def test_an_event_is_left_out_and_scored(truth):
    one, _ = truth
    near, far = one.measures["eroded_volume"], one.measures["run_out"]
    events = {
        "first": Event(SCENE, [Measure("eroded_volume", near, 4.0)]),
        "second": Event(SCENE, [RunOut(WEST + 32.5 + far, SOUTH + 152.5, 2.0), Measure("run_out", far, 20.0)]),
    }
    joint = calibrate_events(events, VARY, **RUNS | {"generations": 1, "members": 12})
    left = joint.leave_one_out()
    # without the first event nothing tells the volume: its misfit is nearer to that of the prior
    score = left.events["first"].scores[0].values
    assert score["all events"] < score["left out"]
    assert left.events["first"].level.size > joint.effective_size and "left out" in str(left)
    assert joint.scores("second")[1].name == "misfit of run_out"
    with pytest.raises(InputError, match="event must be one of first, second"):
        joint.scores()


def test_without_errors_the_result_is_called_abc(observations):
    values = Measure("eroded_volume", 70.0), Measure("max_depth", 2.0)
    found = calibrate(SCENE, VARY, values, **RUNS | {"generations": 1, "members": 8})
    assert found.is_abc and "ABC" in str(found) and "depend on the tolerance" in str(found)
    with pytest.raises(InputError, match="one event alone cannot be left out"):
        found.leave_one_out()


def test_what_is_out_of_reach_is_named():
    found = calibrate(SCENE, VARY, [Measure("eroded_volume", 5000.0, 10.0)], **RUNS | {"generations": 1, "members": 8})
    assert "eroded_volume is out of reach: the nearest member is off by" in found._table().notes[-1]
    error = Measure("eroded_volume", 5000.0, 10.0, model_error=3000.0)
    found = calibrate(SCENE, VARY, [error], **RUNS | {"generations": 1, "members": 8})
    assert not any("out of reach" in note for note in found._table().notes)


def test_choices_and_correlations_are_calibrated(truth):
    noise = {"terrain.elevation_noise": {"rms": 0.05, "length": 20.0}}
    vary = VARY | {ANGLE: [26.0, 30.0], "release.velocity": [[0.0, 0.0], [1.0, 0.0]]} | noise
    target = Measure("eroded_volume", truth[0].measures["eroded_volume"], 4.0)
    found = calibrate(SCENE, vary, [target], correlation={(ANGLE, VOLUME): 0.3}, **RUNS | {"members": 8})
    assert set(found.probabilities(ANGLE)) == {"26.0", "30.0"}
    assert set(found.probabilities("release.velocity")) == {"[0.0, 0.0]", "[1.0, 0.0]"}
    assert sum(found.probabilities(ANGLE).values()) == pytest.approx(1.0)
    assert set(found.interval()) == {VOLUME, ANGLE} and "realisations of noise" in str(found)
    with pytest.raises(InputError, match=r"'release.volum' does not vary \(did you mean"):
        found.probabilities("release.volum")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"observations": []}, "has no observations"),
        ({"members": 4}, "members must lie in"),
        ({"scene": SCENE | {"numerics": {"particle_count": "auto"}}}, "need one number of particles"),
        ({"vary": {"release.polygons": [HEAD, HEAD[:3]]}}, "moves the release"),
        ({"correlation": {("a", "b"): 0.5}}, "does not vary"),
    ],
)
def test_bad_arguments_are_refused_before_a_run(change, words):
    given = {"scene": SCENE, "vary": VARY, "observations": [Measure("run_out", 1.0, 1.0)], "workers": 1} | change
    with pytest.raises((InputError, ParameterError), match=words):
        calibrate(given.pop("scene"), given.pop("vary"), given.pop("observations"), **given)
