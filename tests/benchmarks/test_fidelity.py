"""The evidence about plans: scenes by seed, results that are kept, and the replay of a choice from them."""

import math

import numpy as np
import pytest
from landlab import RasterModelGrid

from benchmarks.fidelity import fit, presets, repeat, replay, runs, score
from benchmarks.fidelity.campaign import SETS, campaign, runs_of
from benchmarks.fidelity.dilatant import dilatant_scene
from benchmarks.fidelity.generator import random_scene
from benchmarks.fidelity.measure import measure, quantities
from benchmarks.fidelity.scenes import NAMED, NINE, Scene, maker
from benchmarks.fidelity.seeds import DILATANT, DRAWS, FIT, HELD_OUT, reason_against
from benchmarks.fidelity.variations import vary
from landlab_debrisflow import DebrisFlow, Setup


def small_scene():
    """Return a body on a slope that ends on a plain."""
    grid = RasterModelGrid((25, 60), xy_spacing=4.0)
    x, y = grid.x_of_node, grid.y_of_node - 48.0
    grid.add_field("topographic__elevation", 0.6 * np.maximum(0.0, 120.0 - x), at="node")
    grid.add_field("debris_flow__release_depth", 1.5 * (np.hypot(x - 30.0, y) < 15.0), at="node")
    return Scene(grid, {"erosion": "none", "friction": {"law": "coulomb", "basal_friction_angle": 33.0}}, 60.0)


def test_sets_are_large_apart_and_drawn():
    assert len(FIT) >= 60 and len(HELD_OUT) >= 120 and not set(FIT) & set(HELD_OUT)
    assert set(DRAWS) == {*FIT, *HELD_OUT, *DILATANT}
    assert len(NINE) == 9
    assert (
        len(set(campaign("x", [name for names in SETS.values() for name in names])))
        == 70 * 15 + 130 * 10 + 9 * 20 + 13 * 10
    )


def test_a_seed_makes_the_same_scene_again():
    one, other, third = random_scene(3), random_scene(3), random_scene(3, draw=1)
    assert one.keywords == other.keywords and one.keywords != third.keywords
    assert set(one.grid.at_node) == set(other.grid.at_node)
    for name in one.grid.at_node:
        np.testing.assert_array_equal(one.grid.at_node[name], other.grid.at_node[name])


@pytest.mark.parametrize("seed", [7, 2002, pytest.param(1007, marks=pytest.mark.slow)])
def test_scenes_are_accepted_and_release_what_lies_inside(seed):
    scene = maker(f"r{seed}")()
    DebrisFlow(scene.grid, **scene.keywords, numerics={"particle_count": 100})
    assert 30.0 <= scene.max_duration <= 400.0


def test_scenes_with_dilatancy_say_so():
    for scene in (dilatant_scene(2001), NAMED["loose debris"]()):
        setup = Setup(**scene.keywords)
        assert setup.has_dilatancy and not setup.two_phases and setup.material.water_table_ratio == 1.0
    assert dilatant_scene(2001).keywords == dilatant_scene(2001).keywords != dilatant_scene(2001, draw=1).keywords


def test_draws_are_refused_for_what_a_coarse_run_says():
    moved = {"outflow": 0.0, "centre": 50.0, "steps": 100}
    assert reason_against(moved, 5.0, False) == ""
    assert reason_against(moved | {"outflow": 0.03}, 5.0, False) == "leaves"
    assert reason_against(moved | {"centre": None}, 5.0, False) == "hardly moves"
    assert reason_against(moved | {"centre": 14.0}, 5.0, False) == "hardly moves"
    assert reason_against(moved | {"steps": 300}, 5.0, True) == "long"
    assert reason_against(moved | {"steps": 300}, 5.0, False) == ""


def test_results_are_appended_after_a_line_that_was_cut_off(tmp_path):
    path, one, other = tmp_path / "new" / "x.jsonl", runs.Run("a", "s", 250), runs.Run("a", "s", 500, "fast")
    runs.append(path, one, {"area": 1.5})
    with open(path, "a") as file:
        file.write('{"label": "a", "sce')
    runs.append(path, other, {"area": None})
    assert runs.read(path) == {one: {"area": 1.5}, other: {"area": None}}
    found = replay.by_scene(runs.read(path))
    assert found["s"]["", 250]["area"] == 1.5 and math.isnan(found["s"]["fast", 500]["area"])


def test_what_stands_in_the_file_is_not_run_again(tmp_path):
    path, said = tmp_path / "x.jsonl", []
    run = runs.Run("a", "no such scene", 250)
    runs.append(path, run, {"area": 1.0})
    runs.run_all([run], path, report=said.append)
    assert said == ["0 of 1 runs are left"]


def test_variations():
    scene = small_scene()
    _, keywords, numerics = vary(scene, 200, "more=-1.5+column=classical/21")
    assert numerics == {"particle_count": 197}
    assert keywords["column"] == {"law": "classical", "levels": 21} and "column" not in scene.keywords
    coarse, _, numerics = vary(scene, 200, "fast+coarse")
    assert coarse.shape == (13, 30) and numerics["preset"] == "fast"
    _, keywords, numerics = vary(NAMED["loose debris"](), 200, "levels=21+courant=0.1")
    assert keywords["column"]["levels"] == 21 and "dilatancy" in keywords["column"]
    assert numerics["courant_number"] == numerics["advective_courant_number"] == 0.1
    with pytest.raises(ValueError, match="unknown variation 'quick'"):
        vary(scene, 200, "quick")


def fake(factor=1.0, order=1.0, seconds=1.0):
    """Return runs of a scene whose quantities converge with an order, from above by 1 % x factor with 1000."""
    found = {}
    for run in runs_of("r1", "x"):
        error = 0.01 * factor * (1000.0 / run.particles) ** order
        found[run.variation, run.particles] = dict.fromkeys(quantities.UNITS, 10.0 * (1.0 + error)) | {
            "seconds": seconds * run.particles / 8000.0
        }
    return found


def test_replay_states_what_the_functions_of_a_plan_state():
    # d2 = 1 %, d1 = 2 %: base 1 % of Q; k b + f = 3 * .99 % + .2 % = 3.2 % of run-out and of speed
    choice = replay.replay(fake(), 0.05, ("run_out", "speed"))
    assert choice.particles == 1000
    assert choice.stated["run_out"] == pytest.approx(replay.stated_errors(replay.pilots_of(fake(), "fast"))["run_out"])
    assert choice.true["run_out"] == pytest.approx(1.01 / 1.000625 - 1.0)
    assert choice.cost == pytest.approx((250 + 500 + 1000 + 1000) / 8000)
    assert replay.replay(fake(), 0.02, ("run_out", "speed")).particles > 1000


def test_truth_of_nothing():
    assert replay.relative(0.0, 0.0) == 0.0
    assert math.isnan(replay.relative(1.0, 0.0)) and math.isnan(replay.relative(math.nan, 1.0))
    assert replay.relative(0.9, 1.0) == pytest.approx(0.1)


def test_fit_finds_order_and_covers():
    scenes = {f"r{k}": fake(factor) for k, factor in enumerate(np.random.default_rng(1).lognormal(0.0, 1.0, 60), 1)}
    found = fit.fit(scenes, list(scenes))["run_out"]
    assert found.order == pytest.approx(1.15)  # 1 as made, and 1.16 against a truth of 16 000, which has an error, too
    assert found.coverage >= 0.95 and found.factor >= 1.0


def test_score_counts_classes_and_covers():
    assert score.class_needed(fake(1.0)) == 1000
    assert score.class_needed(fake(5.0)) == 2000  # 5 % with 1000, 2.2 % with 2000
    assert score.class_needed(fake(100.0)) == 16000  # 12 % with 8000
    part, low, high = score.proportion([True] * 19 + [False])
    assert part == 0.95 and low == pytest.approx(0.7513, abs=1e-3) and high < 1.0
    mean, low, high = score.resampled([0.1, 0.2, 0.4], score.geometric_mean)
    assert mean == pytest.approx(0.2) and low < mean < high


@pytest.mark.slow
def test_replay_chooses_as_a_plan():
    tolerance, hold = 0.04, ("run_out", "area")
    plan = DebrisFlow(small_scene().grid, **small_scene().keywords).plan(tolerance, hold, max_duration=60.0)
    stored = {("fast", count): measure(small_scene, count, "fast") for count in (250, 500, 1000)}
    pilots = replay.pilots_of(stored, "fast")
    errors = replay.stated_errors(pilots)
    count = replay.next_count(replay.count_asked(errors, 1000, tolerance, hold), 1000, 8000)
    assert plan.particles == count
    for name, values in plan.runs.items():
        # five digits are kept
        assert {q: pytest.approx(values[q], rel=1e-4) for q in pilots[name]} == pilots[name]


def test_presets_are_compared_with_standard_steps(capsys):
    made = fake()
    run = made["", presets.PARTICLES]
    for word, cost in zip(presets.PRESETS, (0.5, 0.25), strict=True):
        changed = {name: value * 1.03 for name, value in run.items() if name in replay.QUANTITIES}
        made[word, presets.PARTICLES] = run | changed | {"seconds": cost * run["seconds"]}
    presets.print_presets({"r1": made, "r2": {}}, ["r1", "r2"])
    shown = capsys.readouterr().out
    assert "1 scenes" in shown and "0.50" in shown and "0.25" in shown and "3.0 / 3.0 / 3.0" in shown


def test_kept_runs_are_repeated_to_every_digit(capsys):
    made = {runs.Run("x", "r1", count): {"area": 1.0, "steps": 9, "seconds": 3.0} for count in (500, 1000, 2000)}
    drawn = repeat.draw_runs(made, ["r1"], 9, seed=1)
    assert {run.particles for run in drawn} == {500, 1000}
    assert repeat.print_repeated(made, drawn, lambda run: made[run] | {"seconds": 5.0})
    assert not repeat.print_repeated(made, drawn[:1], lambda run: made[run] | {"area": 1.00001})
    assert not repeat.print_repeated(made, drawn[:1], lambda run: {"failure": "broken"})
    shown = capsys.readouterr().out
    assert "2 of 2 runs are equal" in shown and "area 1.0 now 1.00001" in shown and "failure None now broken" in shown
