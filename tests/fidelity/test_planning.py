"""Plans of flows: what they leave alone, what they refuse, and how they are used."""

import contextlib
import dataclasses
import functools
import json
import logging
import os
import signal
import threading

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow, Hydrograph, InputError, ParameterError, Setup, SimulationError
from landlab_debrisflow.fidelity.constants import ERROR_LAWS
from landlab_debrisflow.fidelity.event import event_of_grid
from landlab_debrisflow.fidelity.pilots import collected_warnings
from landlab_debrisflow.fidelity.plan import Plan
from landlab_debrisflow.fidelity.wishes import Wishes, wishes_of
from landlab_debrisflow.laws import ALE

from .valleys import SHORT, fields, flow_on, valley

EASY = {"tolerance": 0.5, "hold": ["run_out"]}


class Watching:
    """Observer that notes when it is prepared and called."""

    interval = 0.25

    def __init__(self):
        self.counts, self.calls = [], 0

    def prepare(self, grid, setup):
        self.counts.append(setup.numerics.particle_count)

    def observe(self, flow):
        self.calls += 1


@pytest.fixture(scope="module")
def planned():
    """Return a plan, of which tests change nothing."""
    return flow_on(valley()).plan(**EASY, max_duration=SHORT, raster=True)


@pytest.mark.slow
def test_grid_flow_and_observers_are_left_alone(caplog):
    watching, grid = Watching(), valley()
    flow = flow_on(grid, observers=watching, numerics={"particle_count": 60})
    before, statuses, maps = fields(grid), np.array(grid.status_at_node), flow.maps
    with caplog.at_level(logging.INFO):
        plan = flow.plan(**EASY, max_duration=SHORT)
    assert {record.levelno for record in caplog.records} == {logging.INFO}
    assert {name for name in before if not np.array_equal(before[name], grid.at_node[name])} == set()
    assert set(grid.at_node) == set(before) and np.array_equal(statuses, grid.status_at_node)
    assert flow.maps.drop_attrs().identical(maps.drop_attrs()) and flow.setup.numerics.particle_count == 60
    told = [record.getMessage() for record in caplog.records if record.name.endswith(".progress")]
    assert any("pilot run with 1000 particles" in words for words in told)
    assert (watching.counts, watching.calls) == ([60], 0)
    assert plan.particles == 1000 and plan.setup.numerics.particle_count == 1000
    untouched = flow_on(valley(), numerics={"particle_count": 60})
    for one in (flow, untouched):
        one.run_one_step(SHORT)
    assert all(np.array_equal(untouched.grid.at_node[name], grid.at_node[name]) for name in fields(grid))


@pytest.mark.slow
def test_a_plan_prints_choices_and_errors(planned):
    text, page = str(planned), planned._repr_html_()
    for words in (
        "1 000 particles",
        "ale with 11 levels",
        "T_c/T",
        "fast",
        "tau (g/h)^(1/2)",
        "of CPU time",
        "max_duration",
    ):
        assert words in text
    for name in ERROR_LAWS:
        assert planned.errors[name] >= 0.0 and planned.raster_errors[name] >= 0.0, name
    assert "run-out" in text and "half the change with every second node" in text
    assert "held" in text and "<table>" in page and "peak speed" in page and repr(planned) == text
    assert planned.still_moving and planned.cost.steps > 0 and set(planned.runs) == {250, 500, 1000}


@pytest.mark.slow
def test_a_plan_is_plain_values_and_back(planned):
    mapping = json.loads(json.dumps(planned.to_mapping()))
    again = Plan.from_mapping(mapping, flow_on(valley()).setup)
    assert again == planned and again.numerics == planned.numerics and again.column == ALE()
    for name in mapping:
        for value in (None, 3, "x", [], {}, [[]], {"a": 1}):
            with contextlib.suppress(InputError):  # what is taken can be shown, and measured by
                assert str(Plan.from_mapping(mapping | {name: value}, planned.setup))
    for broken in ({}, mapping | {"format": 99}, mapping | {"runs": 3}, mapping | {"numerics": {"threads": 0}}, 3):
        with pytest.raises(InputError, match="plan"):
            Plan.from_mapping(broken, planned.setup)


@pytest.mark.slow
def test_an_adopted_plan_is_used_and_reported(planned):
    watching, grid = Watching(), valley()
    flow = flow_on(grid, observers=watching)
    text = str(flow.report())
    assert "no plan: the error is not known" in text and "standard: Courant numbers 0.6 and 0.5, rest energy" in text
    flow.adopt(planned)
    flow.adopt(planned)  # nothing more to do
    assert flow.setup.numerics == planned.numerics and set(watching.counts) == {None, 1000}
    assert "not run yet" in str(flow.report()) and flow.report().errors == planned.errors
    flow.run_until_rest(SHORT)
    report = flow.report()
    assert report.particles == 1000 and report.steps == planned.cost.steps and "the pilot runs" in report.source
    assert report.errors == planned.errors and report.seconds > 0.0
    assert report.to_mapping()["errors"]["run_out"] == planned.errors["run_out"]
    assert "still moving at 1 s" in str(report) == repr(report) and "<table>" in report._repr_html_()
    by_hand = flow_on(valley(), numerics=planned.numerics, column=planned.column)
    by_hand.run_until_rest(SHORT)
    assert all(np.array_equal(by_hand.grid.at_node[name], grid.at_node[name]) for name in fields(grid))
    with pytest.raises(InputError, match="the flow moves already, with 1000 particles"):
        flow.adopt(planned)


@pytest.mark.slow
def test_a_plan_of_another_scene_is_refused(planned):
    for flow, words in (
        (flow_on(valley(), friction="coulomb"), "another setup"),
        (flow_on(valley(), numerics={"settle": False}), "another setup"),
        (flow_on(valley(release=0.9)), "another terrain, soil or release"),
        (flow_on(valley(soil=1.5)), "another terrain, soil or release"),
    ):
        with pytest.raises(InputError, match=words):
            flow.adopt(planned)
        assert flow.setup.numerics.particle_count is None
    with pytest.raises(InputError, match="a Plan is needed"):
        flow.adopt(planned.numerics)


@pytest.mark.slow
def test_what_cannot_be_planned_is_refused():
    flow = flow_on(valley(release=0.0))
    with pytest.raises(InputError, match="nothing is released and nothing flows in"):
        flow.plan()
    flow = flow_on(valley(), numerics={"particle_count": 20, "settle": False})
    flow.run_one_step(0.2)
    with pytest.raises(InputError, match="moves already, with 20 particles"):
        flow.plan()
    line = Hydrograph(
        line_start=(1010.0, 2020.0), line_end=(1010.0, 2050.0), times=[0.0, 9.0], discharge=9.0, velocity=2.0
    )  # fmt: skip
    flow = flow_on(valley(release=0.0), inflow=line, numerics={"particle_count": 20})
    flow.run_one_step(5.0)
    with pytest.raises(InputError, match="moves already"):
        flow.plan()


@pytest.mark.parametrize(
    ("keywords", "words"),
    [
        ({"tolerance": 5}, r"tolerance must lie in \[0.001, 0.5\], got 5.0; 0.05 are 5 %"),
        ({"tolerance": "0.05"}, "give the number 0.05 without quotes"),
        ({"hold": ["time_to_rest"]}, "time_to_rest cannot be held: a flow ends in a creep"),
        ({"hold": "runout"}, r"did you mean 'run_out'\?"),
        ({"hold": ()}, "hold is empty"),
        ({"hold": 3}, "hold must be a list of words"),
        ({"max_particles": 500}, "max_particles must lie in"),
        ({"max_cost": 0.0}, "max_cost must lie in"),
        ({"raster": "yes"}, "raster must be true or false"),
        ({"max_duration": 0.0}, "max_duration must be more than 0 s"),
        ({"max_duration": "long"}, "max_duration must be a number of seconds"),
    ],
)
def test_bad_wishes_are_refused(keywords, words):
    with pytest.raises((InputError, ParameterError), match=words):
        untouched().plan(**keywords)


@functools.cache
def untouched():
    """Return a flow that does nothing."""
    return flow_on(valley())


class Breaking:
    """Law of erosion without soil that calls a function in its tenth step."""

    def __init__(self, function):
        self._function, self.times = function, 0

    def entrainment_rate(self, state, out):
        self.times += 1
        if self.times == 10:
            self._function()
        out[:] = 0.0


def interrupt():
    os.kill(os.getpid(), signal.SIGINT)


def diverge():
    raise SimulationError("speed", None, 0.0, 0.0)


@pytest.mark.slow
@pytest.mark.parametrize(("function", "error"), [(interrupt, KeyboardInterrupt), (diverge, SimulationError)])
def test_ctrl_c_and_failures_in_a_pilot_run_change_nothing(function, error):
    grid = valley()
    flow = flow_on(grid, erosion=Breaking(function))
    before = fields(grid)
    with pytest.raises(error) as failure:
        flow.plan(max_duration=60.0)
    assert failure.value.__notes__ == ["in a pilot run with 250 particles; grid and flow are as they were"]
    assert all(np.array_equal(before[name], grid.at_node[name]) for name in before)
    flow.run_one_step(0.5)  # it is as good as new
    assert flow.elapsed_time == 0.5


@pytest.mark.slow
def test_auto_plans_in_run_until_rest(tmp_path, caplog):
    """It plans once, keeps its number for the next event, and a checkpoint goes on with it."""
    auto = {"numerics": {"particle_count": "auto"} | EASY}
    flow = flow_on(valley(), **auto)
    with pytest.raises(InputError, match=r"particle_count is 'auto'.*run_until_rest\(\), or flow.adopt"):
        flow.run_one_step(1.0)
    flow.run_until_rest(SHORT)
    assert flow.setup.numerics.particle_count == 1000 and not flow.setup.numerics.automatic
    by_plan = flow_on(valley(), **auto)
    by_plan.adopt(by_plan.plan(**EASY, max_duration=SHORT))
    by_plan.run_until_rest(SHORT)
    assert by_plan.report().errors == flow.report().errors
    flow.save(tmp_path / "flow.nc")
    again = DebrisFlow.load(tmp_path / "flow.nc")
    assert again.setup == flow.setup and again.report().plan == flow.report().plan
    for one in (flow, again):
        one.run_one_step(0.5)
    assert all(np.array_equal(again.grid.at_node[name], flow.grid.at_node[name]) for name in fields(flow.grid))


def test_wishes_are_those_of_numerics_unless_told_otherwise():
    auto = Setup(numerics={"particle_count": "auto", "tolerance": 0.2, "hold": "area"})
    assert wishes_of(auto, tolerance=None) == Wishes(tolerance=0.2, hold=("area",))
    assert wishes_of(auto, hold=["speed"], max_cost=3.0) == Wishes(tolerance=0.2, hold=("speed",), max_cost=3.0)
    assert wishes_of(Setup()) == Wishes() == Wishes(tolerance=0.05, hold=("run_out", "speed"), max_particles=8000)


def test_warnings_of_other_threads_are_logged_while_a_pilot_runs(caplog):
    log = logging.getLogger("landlab_debrisflow")
    with collected_warnings() as found:
        log.warning("of the pilot run")
        other = threading.Thread(target=log.warning, args=("of another flow",))
        other.start()
        other.join()
    assert found == ["of the pilot run"] and [record.message for record in caplog.records] == ["of another flow"]


@pytest.mark.slow
def test_creep_is_told_apart(planned):
    assert "creeping" not in str(dataclasses.replace(planned, creep=0.004))
    text = " ".join(str(dataclasses.replace(planned, creep=0.017, creep_level=0.01)).split())
    assert "run-out changed by 1.7 % after the kinetic energy had fallen below 1 % of its peak" in text


@pytest.mark.slow
def test_auto_without_a_release_waits_for_one(caplog):
    flow = flow_on(valley(release=0.0), numerics={"particle_count": "auto"})
    assert flow.run_until_rest() and flow.setup.numerics.automatic
    assert "nothing to do" in caplog.text


@pytest.mark.slow
def test_a_later_event_is_planned_anew_and_clock_and_accounts_go_on():
    grid = valley(shape=(15, 50))
    flow = flow_on(grid, friction={"law": "coulomb", "basal_friction_angle": 40.0}, numerics={"particle_count": 40})
    assert flow.run_until_rest(60.0)
    before, time, steps = flow.budget, flow.elapsed_time, flow.diagnostics.steps
    x, y = grid.x_of_node - 1000.0, grid.y_of_node - 2000.0
    grid.at_node["debris_flow__release_depth"][np.hypot(x - 60.0, y - 35.0) < 8.0] = 0.5
    flow.adopt(flow.plan(**EASY, max_duration=60.0))
    assert (flow.budget, flow.elapsed_time, flow.diagnostics.steps) == (before, time, steps)
    flow.run_until_rest(60.0)
    budget = flow.budget
    assert budget["released"] > before["released"] and abs(budget["residual"]) < 1e-9 * budget["released"]
    assert flow.elapsed_time > time and "was not the only one" in flow.report().source


@pytest.mark.slow
def test_limits_keep_what_there_is_and_say_so():
    flow = flow_on(valley())
    strict = flow.plan(0.001, hold=["run_out", "deposit"], max_duration=SHORT, max_particles=3000, raster=False)
    assert strict.particles == 3000 and "run_out" in strict.not_held and "deposit" in strict.not_held
    assert "no more than max_particles" in strict.rules["particles"][1] and strict.numerics.preset == "standard"
    assert strict.raster_errors == {} and "not examined" in str(strict)
    cheap = flow.plan(0.001, hold=["run_out"], max_duration=SHORT, max_cost=1e-3, raster=False)
    assert cheap.particles == 1000 and "max_cost" in cheap.rules["particles"][1]


@pytest.mark.slow
def test_digests_of_the_ground():
    """They differ where something differs that an event reads, not with what a component adds."""
    grid = valley()
    digest = event_of_grid(grid, flow_on(valley()).setup, 1.0, DebrisFlow).ground_digest()
    flow = flow_on(grid)
    assert event_of_grid(grid, flow.setup, 1.0, DebrisFlow).ground_digest() == digest
    grid.at_node["bed__drained"] = np.zeros(grid.number_of_nodes)
    assert event_of_grid(grid, flow.setup, 1.0, DebrisFlow).ground_digest() == digest
    grid.at_node["bed__drained"][3] = 1.0
    assert event_of_grid(grid, flow.setup, 1.0, DebrisFlow).ground_digest() != digest


@pytest.mark.slow
def test_a_plan_keeps_dilatancy():
    column = {"law": "ale", "levels": 7, "dilatancy": {"permeability": 1e-10, "critical_solid_fraction": 0.62}}
    flow = flow_on(valley(), column=column, friction="coulomb", material={"initial_pressure_ratio": 0.0})
    own = flow.setup.column
    plan = flow.plan(**EASY, max_duration=SHORT, raster=False)
    assert plan.column == own and "ale with dilatancy and 7 levels (your own choice)" in str(plan)
    again = Plan.from_mapping(json.loads(json.dumps(plan.to_mapping())), flow.setup)
    assert again == plan and again.column == own
    flow.adopt(plan)
    flow.run_until_rest(SHORT)
    assert flow.setup.column == own and "ale with dilatancy and 7 levels" in str(flow.report())
    assert "debris_flow__solid_fraction" in flow.maps
