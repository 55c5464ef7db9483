"""Forecasts: steps from those of a pilot run, doubts about angles, releases and resolution."""

import copy
import dataclasses
import math
from types import SimpleNamespace

import numpy as np
import pytest

from landlab_debrisflow import InputError, Scene
from landlab_debrisflow.run import pilot as pilots
from landlab_debrisflow.run.doubts import below_lip, scene_doubts
from landlab_debrisflow.run.forecast import Forecast, forecast, timed_runs
from landlab_debrisflow.run.pilot import Pilot, Start, run_pilot, run_start
from tests.scene.dems import square, write_slope

from .running import FIRST, MAPPING


def scene(**changes):
    mapping = copy.deepcopy(MAPPING) | {"release": {"polygons": FIRST, "depth": 1.5}}
    return Scene.from_mapping(mapping | changes)


def pilot(steps, particles=100):
    numbers = dict.fromkeys(Pilot._fields, 0.0) | {"steps": steps, "particles": particles}
    return Pilot(**numbers)


def test_steps_that_waves_limit_are_shorter_with_more_particles():
    limited_by_waves, limited_by_terrain = [(0.1, 10.0)] * 50, [(0.1, 0.1)] * 50
    assert pilot(limited_by_waves).steps_with(400) == pytest.approx(100.0)
    assert pilot(limited_by_terrain).steps_with(400) == pytest.approx(50.0)
    assert pilot(limited_by_waves).steps_with(100) == pytest.approx(50.0)
    assert pilot([(0.1, 0.15)]).steps_with(25) == pytest.approx(0.1 / 0.15)  # longer, until the terrain limits them


def test_costs_of_steps_are_those_of_the_whole_run_over_those_of_the_start():
    times = iter(np.cumsum([1.0] * 25 + [3.0] * 75))
    steps = pilots._Steps(5.0, 60.0, lambda: next(times))
    still = SimpleNamespace(
        awake=1, velocity=np.ones((3, 1)), volume=np.ones(1), entrainment_rate=np.zeros(1), depth=np.ones(1)
    )
    for k in range(100):
        steps.follow(still, 0.1 * k, 0.1 * (k + 1))
    assert steps.cost_ratio == pytest.approx((20 + 3.0 * 75) / 95)
    assert steps.erosion_time == math.inf


def test_gauges_off_the_map_are_refused_before_anything_is_computed():
    with pytest.raises(InputError, match=r"gauges: .*outside the DEM"):
        forecast(scene(output={"gauges": {"bridge": [0.0, 0.0]}}))


def test_times_of_pilot_runs_that_compiled_do_not_count():
    """Kernels that compile in the first steps of a pilot run make its later steps look cheap."""
    for seconds, runs in ((15.0, 2), (0.1, 1)):
        starts = iter([start_of(seconds), start_of(0.2)])
        numbers = iter([pilot([], 1), pilot([], 2)])
        start, run = timed_runs(None, lambda _, starts=starts: next(starts), lambda _, numbers=numbers: next(numbers))
        assert run.particles == runs and start.seconds == (0.2 if runs == 2 else 0.1)


def start_of(seconds):
    return Start(particles=1, consolidation_time=1.0, seconds=seconds, seconds_per_step=1e-3, doubts=[])


@pytest.mark.slow
def test_a_forecast_is_the_outcome_of_its_pilot_runs_and_prints():
    given = scene(output={"max_duration": 4.0})
    found, pilot_run, start = forecast(given), run_pilot(given), run_start(given)
    assert found.duration == pilot_run.duration == 4.0 and found.complete and not found.at_rest
    assert found.particles == start.particles == int(given.flow().setup.numerics.particle_count)
    assert found.steps == pilot_run.steps_with(start.particles)
    assert found.consolidation_time == pytest.approx(1.5**2 / 4e-4, rel=1.0)  # h^2 / c_v; thicker in the middle
    assert found.released == pytest.approx(1.5 * 30 * 25, rel=1e-12)
    text = str(found)
    assert f", {found.consolidation_time / found.duration:.2g} times the duration" in str(found)
    for words in ("T_c", "T_e", "Pe_b", "steps", "wall time", "(max_duration), still moving"):
        assert words in text


def test_what_was_not_reached_is_told_as_a_bound():
    numbers = {field.name: 1.0 for field in dataclasses.fields(Forecast)}
    numbers |= {"nodes": (3, 4), "spacing": (5.0, 5.0), "notes": ("a note",), "doubts": ("a doubt",), "complete": False}
    text = str(Forecast(**numbers))
    assert "more than 1 s" in text and "notes:\n  - a note\nodd:\n  - a doubt" in text


def doubts(**changes):
    return list(scene_doubts(scene(**changes)))


def test_a_usual_scene_has_no_doubts():
    assert doubts(numerics={"particle_count": 60}) == []


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"friction": {"law": "coulomb", "basal_friction_angle": 0.6}}, "0.6 rad are 34.4 deg"),
        ({"numerics": {"particle_count": 1}}, "does not see the terrain"),
        ({"numerics": {"particle_count": 60000}}, "more particles than the terrain has detail for"),
        ({"release": {"polygons": FIRST, "depth": 1.0, "time": 9.0}}, "comes after max_duration, 9 s"),
        ({"release": {"polygons": FIRST, "depth": 30.0, "from": "above"}}, "a flow is shallow only if"),
        ({"release": {"polygons": FIRST, "depth": 12.0, "failure_surface": "uniform"}}, "below the lip of the scar"),
    ],
)
def test_doubts(changes, words):
    assert [doubt for doubt in doubts(**changes) if words in doubt]


def test_erosion_without_soil_is_doubted(tmp_path):
    write_slope(tmp_path / "dem.tif")
    mapping = {
        "terrain": {"elevation": str(tmp_path / "dem.tif")},
        "release": {"polygons": square(100.0, 50.0, 40.0), "depth": 1.0},
        "numerics": {"particle_count": 60},
    }
    (doubt,) = scene_doubts(Scene.from_mapping(mapping))
    assert "nothing erodes, though the law of erosion is Growth" in doubt
    assert list(scene_doubts(Scene.from_mapping(mapping | {"erosion": "none"}))) == []
    mapping["terrain"]["soil_depth"] = 2.0
    assert list(scene_doubts(Scene.from_mapping(mapping))) == []


def test_pits_of_the_ground_are_not_those_of_a_release():
    ground = np.add.outer(np.zeros(7), np.arange(9.0))
    ground[3, 4] -= 3.0  # a pit 2 m deep below its lip, not by the release
    thin = np.zeros((7, 9))
    thin[3, 4] = 0.5
    assert below_lip(ground, thin) == (pytest.approx(0.5), pytest.approx(0.5))
    assert below_lip(np.where(ground > 7.0, np.nan, ground), thin) == below_lip(ground, thin)
