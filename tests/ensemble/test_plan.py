"""Plan of an ensemble: errors of maps from pilot runs, and the number of particles that follows."""

import numpy as np
import pytest

from landlab_debrisflow import InputError, Scene
from landlab_debrisflow.ensemble import Ensemble
from landlab_debrisflow.ensemble.pilots import spread_members
from landlab_debrisflow.ensemble.plan import (
    COUNTS,
    ORDER,
    EnsemblePlan,
    PilotRuns,
    choose_resolution,
    difference,
)  # fmt: skip
from landlab_debrisflow.ensemble.result import MemberResult

from .scenes import ANGLE, VARY
from .scenes import SCENE as LONG

SCENE = LONG | {"output": {"max_duration": 1.0}}

MEMBERS, NODES = 8, 4000
SPREAD = 0.5


def pilot_runs(scatter=0.0, systematic=0.0, steps=0.0, arrival=False):
    """Return pilot runs whose maps have errors c n^(-1/2) of a size with the fine runs, and a difference of steps."""
    random = np.random.default_rng(0)
    ladder = np.arange(MEMBERS) - 0.5 * (MEMBERS - 1)
    truth = np.repeat(4.0 + SPREAD * ladder[:, None] / ladder.std(ddof=1), NODES, axis=1)

    def results(values, count):
        noise = scatter * random.standard_normal(values.shape) + systematic
        maps = values + noise * (COUNTS[-1] / count) ** ORDER
        name = "arrival_time" if arrival else "max_depth"
        return [
            MemberResult(k, {}, {}, slice(0, 1), slice(0, NODES), {name: one[None].astype(np.float32)})
            for k, one in enumerate(maps)
        ]

    coarse, fine = (results(truth, count) for count in COUNTS)
    standard = [
        one._replace(maps={name: values + np.float32(steps) for name, values in one.maps.items()}) for one in coarse
    ]
    return PilotRuns(coarse, fine, standard)


@pytest.mark.parametrize("size", [{"scatter": 0.2}, {"systematic": 0.2}, {"scatter": 0.12, "systematic": 0.16}])
def test_the_error_of_the_fine_run_is_found_from_the_difference(size):
    runs = pilot_runs(**size)
    fine, coarse = (np.array([one.maps["max_depth"][0] for one in part]) for part in (runs.fine, runs.coarse))
    # a scatter s leaves s^2 / 8 sqrt(2 / 4000) = (0.05 s)^2 in the systematic part, 0.02 or 0.044 after extrapolation
    assert difference(fine, coarse).error == pytest.approx(0.2, rel=0.05)


@pytest.mark.parametrize("arrival", [False, True])
def test_the_number_of_particles_makes_the_error_a_fifth_of_the_spread(arrival):
    count, fast, maps = choose_resolution(pilot_runs(scatter=0.2, arrival=arrival))
    (held,) = maps.values()
    assert held.spread == pytest.approx(np.hypot(0.5, 0.2), rel=0.05)
    assert fast and count % 100 == 0 and held.ratio <= 0.2
    expected = 1000 * (0.2 / (0.2 * held.spread)) ** 2
    assert count == pytest.approx(expected, rel=0.08, abs=100)


def test_small_errors_ask_for_no_more_than_the_coarse_runs_have():
    assert choose_resolution(pilot_runs(scatter=0.001))[0] == COUNTS[0]


def test_a_limit_leaves_maps_that_are_not_held():
    count, _, maps = choose_resolution(pilot_runs(scatter=0.5), most=2000)
    assert count == 2000 and maps["max_depth"].ratio > 0.2


def test_steps_that_shift_a_map_are_not_taken():
    """Half the error allowed, 0.05 of a spread of 0.5: a shift of 0.04 counts as error, one of 0.06 is too much."""
    kept, other = (choose_resolution(pilot_runs(scatter=0.02, steps=shift)) for shift in (0.04, 0.06))
    assert (kept[1], other[1]) == (True, False)
    assert kept[2]["max_depth"].error > 0.04 > other[2]["max_depth"].error


def test_pilot_members_are_spread():
    design = Ensemble(SCENE, VARY, 200, "random").design
    chosen = spread_members(design, 8)
    assert len(set(chosen)) == 8 and chosen == sorted(chosen)
    values = np.stack([design[name].values for name in list(design.data_vars)[:2]], axis=1)
    low, middle, high = np.quantile(values, [0.2, 0.5, 0.8], axis=0)
    inside = values[chosen]
    assert (inside < low).any(axis=0).all() and (inside > high).any(axis=0).all()
    assert (abs(inside - middle) < abs(high - low)).all(axis=1).any()
    assert spread_members(design.isel(member=slice(0, 3)), 8) == [0, 1, 2]


@pytest.mark.slow
def test_the_plan_is_part_of_the_results_and_made_once(tmp_path):
    ensemble = Ensemble(SCENE, VARY, 4, "random", fidelity="auto", maps=["max_depth", "arrival_time"])
    told = []
    results = ensemble.run(store=tmp_path / "members.zarr", workers=1, notify=told.append)
    plan = results.plan
    assert (
        plan.pilots == (0, 1, 2, 3) and plan.particles >= COUNTS[0] and set(plan.maps) == {"max_depth", "arrival_time"}
    )
    assert sum("pilot run" in text for text in told) == 8
    assert ensemble.run(store=tmp_path / "members.zarr", workers=1, notify=(again := []).append).plan == plan
    assert again == [] and EnsemblePlan.from_mapping(plan.to_mapping()) == plan
    setup = plan.applied(ensemble.scene.setup)
    assert setup.numerics.particle_count == plan.particles and setup.friction == ensemble.scene.setup.friction
    assert "particles" in str(plan) and "of the spread between members" in str(plan)
    other = Ensemble(SCENE, VARY, 4, "random", maps=["max_depth", "arrival_time"])
    assert other.digest() != ensemble.digest() and not other.automatic
    scene = SCENE | {"numerics": {"particle_count": "auto"}}
    assert Ensemble(scene, VARY, 4, "random").automatic


@pytest.mark.slow
def test_a_plan_of_the_scene_holds_for_all_members():
    scene = Scene.from_mapping(SCENE)
    plan = scene.plan(hold="eroded", tolerance=0.5)
    ensemble, plain = (Ensemble(one, VARY, 2, "random") for one in (scene.with_plan(plan), scene))
    setup = ensemble.basis().content.setup
    assert (setup.numerics, setup.column) == (plan.numerics, plan.column) and setup.friction == scene.setup.friction
    assert ensemble.digest() != plain.digest() and not ensemble.automatic


@pytest.mark.slow
def test_pilots_that_fail_are_told():
    with pytest.raises(InputError, match=r"needs 3 pilot members that come to their end, got 2 of 2"):
        Ensemble(SCENE, {ANGLE: [24.0, 28.0]}, sampling="factorial", fidelity="auto").run(workers=1)
    vary = {"release.volume": [500.0, 1e9, 1e9, 600.0]}
    with pytest.raises(InputError, match=r"got 2 of 4; member 1 failed as a pilot: InputError: "):
        Ensemble(SCENE, vary, sampling="factorial", fidelity="auto").run(workers=1)
