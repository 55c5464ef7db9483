"""Scenes that leave their number of particles to a plan: check, run, resume, and as a function."""

import copy
import math

import numpy as np
import pytest

from landlab_debrisflow import InputError, ParameterError, Scene, simulate
from landlab_debrisflow.cli import exit_codes, main
from landlab_debrisflow.record.monitor import Monitor
from landlab_debrisflow.run.check import check
from landlab_debrisflow.run.planning import event_of_scene
from landlab_debrisflow.run.runner import resume_scene, run_scene

from .running import MAPPING, Stopping, assert_same

AUTO = {"particle_count": "auto", "tolerance": 0.5, "hold": ["run_out"]}
SHORT = {"max_duration": 4.5, "columns": 2}


def scene(folder, **changes):
    """Return a scene of two releases, the second of which starts shortly before the end."""
    mapping = copy.deepcopy(MAPPING) | {"numerics": AUTO, "output": SHORT}
    return Scene.from_mapping(mapping | changes, folder)


def test_keys_are_checked_and_kept(tmp_path):
    assert scene(tmp_path).to_mapping()["numerics"]["particle_count"] == "auto"
    assert scene(tmp_path).setup.numerics.hold == ("run_out",)
    for numerics, words in (
        ({"tolerance": 0.1}, "give particle_count: auto, or leave out tolerance"),
        ({"particle_count": "atuo"}, r"integer \[-\] or 'auto', got 'atuo' \(did you mean 'auto'\?\)"),
        ({"particle_count": "auto", "particle_spacing": 2.0}, "not both"),
        ({"particle_count": "auto", "tolerance": 5}, "0.05 are 5 %"),
    ):
        with pytest.raises(ParameterError, match=words):
            scene(tmp_path, numerics=numerics)


@pytest.mark.slow
def test_an_event_has_all_releases(tmp_path):
    event = event_of_scene(scene(tmp_path))
    volumes = [float(one.depth.sum()) * 25.0 for one in scene(tmp_path).releases]
    assert event.volume == pytest.approx(sum(volumes), rel=1e-12) and min(volumes) > 0.0
    coarse = event.coarse()
    assert (
        coarse.volume == pytest.approx(event.volume, rel=1e-12) and coarse.releases[1].depth.shape == coarse.grid.shape
    )
    assert float(event.release_depth.sum()) * 25.0 == pytest.approx(event.volume, rel=1e-12)


class Planned(Scene):
    """Scene with a plan that was made before, whose rules are those of the costs then."""

    made, found = 0, None

    def plan(self, **wishes):
        Planned.made += 1
        if Planned.found is None:
            raise KeyboardInterrupt
        return Planned.found


def planned_scene(folder):
    """Return the scene in a new folder, with the plan that `Planned` holds."""
    folder.mkdir(exist_ok=True)
    return Planned(scene(folder).to_mapping(), folder)


@pytest.fixture
def plan():
    """Return the plan of the scene."""
    Planned.found, Planned.made = Planned.found or scene(".").plan(raster=False), 0
    return Planned.found


@pytest.fixture
def whole(tmp_path, plan):
    """Results of a run by a plan that nothing interrupted."""
    return run_scene(planned_scene(tmp_path / "whole"), monitor=Monitor(live=False))


@pytest.mark.slow
def test_a_run_uses_its_plan_and_reports(whole):
    plan = whole.record.plan
    assert plan["particles"] == 1000 and whole.record.scene["numerics"]["particle_count"] == "auto"
    assert whole.maps.attrs["numerics_particle_count"] == 1000 and whole.maps.attrs["numerics_preset"] == "fast"
    assert "Statement on a run by a plan" in whole.report and "run-out" in whole.report and "CPU" not in whole.report
    assert (whole.directory / "report.txt") in whole.files
    assert whole.record.statement["particles"] >= 1000 and set(whole.record.statement["errors"]) >= {"run_out", "speed"}
    assert (whole.directory / "columns.nc").is_file()


@pytest.mark.slow
@pytest.mark.parametrize("step", [1, 30])
def test_an_interrupted_run_goes_on_by_its_plan(whole, step, tmp_path):
    """Before the first checkpoint, and from one."""
    with pytest.raises(KeyboardInterrupt):
        run_scene(planned_scene(tmp_path), monitor=Stopping(step))
    results = resume_scene(planned_scene(tmp_path), monitor=Monitor(live=False))
    assert Planned.made == 2  # for the two runs, and not for the one that goes on
    for directory in (results.directory, whole.directory):
        for path in directory.glob("checkpoint*"):
            path.unlink()
    assert_same(results.directory, whole.directory)


@pytest.mark.slow
def test_a_plan_that_fails_leaves_nothing(tmp_path):
    Planned.found = None
    with pytest.raises(KeyboardInterrupt) as failure:
        run_scene(planned_scene(tmp_path), monitor=Monitor(live=False))
    assert failure.value.__notes__ == ["nothing was kept"] and not (tmp_path / "scene_out").exists()


@pytest.mark.slow
def test_check_prints_the_plan(tmp_path, capsys):
    said = []
    found = check(scene(tmp_path), said.append)
    assert found.plan.particles == 1000 and said[0] == "plan: pilot run with 250 particles"
    assert "Plan: 1 000 particles" in str(found) and "odd:" in str(found)
    with pytest.raises(InputError, match="nothing is released"):
        check(scene(tmp_path, release=[]))
    path = tmp_path / "slope.yaml"
    path.write_text(
        "terrain: {example: gully}\nrelease: {polygons: [[400020, 5200145], [400050, 5200145], [400050, 5200170]], "
        "depth: 1}\noutput: {max_duration: 0.5}\nnumerics: {particle_count: auto, tolerance: 0.5}\n"
    )
    assert main.main(["check", str(path)]) == exit_codes.DONE
    out, err = capsys.readouterr()
    assert out.startswith("Plan: ") and "pilot run with 1000 particles" in err
    assert main.main(["run", str(path)]) == exit_codes.STILL_MOVING
    assert "Statement on a run by a plan" in capsys.readouterr().out


@pytest.mark.slow
def test_planned_scenes_and_simulate_agree(tmp_path):
    one = scene(tmp_path)
    planned = one.with_plan(one.plan())
    assert planned.setup.numerics.particle_count == 1000 and one.setup.numerics.automatic
    assert planned.digest() == one.digest() and planned.to_mapping() == one.to_mapping()
    maps, by_hand = simulate(None, one), simulate(planned.setup, one)
    assert np.array_equal(maps.debris_flow__max_depth, by_hand.debris_flow__max_depth, equal_nan=True)
    flow = planned.flow()
    assert flow.report().plan is planned.adopted_plan and not math.isnan(flow.report().errors["speed"])
    with pytest.raises(InputError, match="run_until_rest"):
        one.flow().run_one_step(1.0)
