"""Inflow across a line: what enters, when, where to, and how it ends (README, "Inflow")."""

import numpy as np
import pytest
from landlab.bmi import wrap_as_bmi

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.model import step
from validation.grids import COARSE, changed_fields, copy_fields, inclined, release_slab

from .twins import Failed, failing

Z = "topographic__elevation"
LINE = {"line_start": (20.0, 38.0), "line_end": (20.0, 58.0)}
SURGE = LINE | {"times": [1.0, 4.0, 10.0], "discharge": [0.0, 40.0, 0.0], "velocity": [4.0, 6.0, 3.0]}
VOLUME = 0.5 * 40.0 * 9.0


def discharged(hydrograph, time):
    """Integrate the discharge over fine steps [m3]."""
    t = np.linspace(0.0, time, 100001)
    q = np.interp(t, hydrograph["times"], hydrograph["discharge"], left=0.0, right=0.0)
    return float(np.sum(0.5 * (q[1:] + q[:-1]) * np.diff(t)))


@pytest.fixture
def hill():
    """The valley without anything that fails."""
    return inclined((20, 80), 5.0, 0.5, soil=1.0, foot=150.0)


def test_the_volume_is_the_integral_of_the_discharge(hill):
    flow = DebrisFlow(hill, inflow=SURGE, erosion="none", numerics={"particle_count": 300})
    rows = flow._simulation.inflow
    largest = np.diff(rows._sum).max()
    for time in (0.5, 2.0, 4.0, 7.0):
        flow.run_one_step(time - flow.elapsed_time)
        # a row enters as a whole when half of it has crossed the line
        assert abs(flow.budget["inflow"] - discharged(SURGE, time)) <= 0.5 * largest
        assert flow.budget["moving"] == pytest.approx(flow.budget["inflow"], rel=1e-14)  # round-off of the sum
    assert largest < 0.06 * VOLUME
    flow.run_one_step(3.0)
    assert flow.budget["inflow"] == pytest.approx(VOLUME, rel=1e-14)
    # when nothing more flows in nothing is prescribed any more, not even right behind the line
    assert rows.prescribed(flow._simulation.particles).size == 0 and float(flow.particles.x.min()) < 21.0
    volumes = flow.particles.volume.values
    assert volumes.size == 300 and np.all(volumes == volumes[0])  # no light beside heavy


@pytest.mark.slow
def test_an_event_ends_when_all_has_entered_and_come_to_rest(hill):
    second = SURGE | {"times": [2000.0, 2001.0, 2010.0]}
    before = hill.at_node[Z].copy()
    flow = DebrisFlow(hill, inflow=[SURGE, second], numerics=COARSE)
    flow.run_one_step(1000.0)  # the first lies still long before
    speed = np.abs(flow.particles.velocity_x.values)
    assert not speed.any() and not flow.at_rest and flow.budget["deposited"] == 0.0
    assert flow.run_until_rest() is True and flow.elapsed_time > 2010.0
    budget = flow.budget
    assert budget["inflow"] == pytest.approx(VOLUME + 0.5 * 40.0 * 10.0, rel=1e-14)
    assert budget["deposited"] == pytest.approx(budget["inflow"] + budget["eroded"], rel=1e-12)  # elevations of 75 m
    rise = float((hill.at_node[Z] - before).sum()) * 25.0
    assert rise == pytest.approx(budget["inflow"], rel=1e-10)
    flow.run_one_step(1e9)  # afterwards nothing happens any more
    assert flow.budget == budget


class Watch:
    interval = 1.0

    def __init__(self):
        self.times = []

    def observe(self, flow):
        self.times.append(flow.elapsed_time)


def test_time_before_anything_enters_costs_nothing(hill, monkeypatch):
    watch, steps = Watch(), []
    advance = step.advance
    monkeypatch.setattr(step, "advance", lambda sim, dt: (steps.append(dt), advance(sim, dt)))
    late = SURGE | {"times": [1e6, 1e6 + 1.0, 1e6 + 2.0]}
    flow = DebrisFlow(hill, inflow=late, numerics=COARSE, observers=[watch])
    flow.run_one_step(4e5)
    flow.run_one_step(6e5)
    assert steps == watch.times == [] and flow.elapsed_time == 1e6
    assert not flow.at_rest and flow.budget["moving"] == 0.0
    flow.run_one_step(1.5)
    assert len(steps) < 100
    (look,) = watch.times
    assert 1e6 + 1.0 <= look < 1e6 + 1.0 + max(steps)  # at the end of the step that passes it
    assert flow.budget["inflow"] > 10.0


@pytest.mark.slow
def test_many_calls_are_one_call(hill):
    flows = []
    for calls in (1, 7, 60):
        grid = inclined((20, 80), 5.0, 0.5, soil=1.0, foot=150.0)
        flow = DebrisFlow(grid, inflow=SURGE, numerics={"particle_count": 200})
        for _ in range(calls):
            flow.run_one_step(6.0 / calls)
        flows.append(flow)
    one, *others = flows
    for flow in others:
        # Rows do not depend on steps, but a particle flows by itself from the end of the step in which it leaves
        # the strip. Measured 1.1 m for the few at the front, 34 m further, and 0.05 m in the mean; erosion .044
        assert flow.budget["inflow"] == one.budget["inflow"]
        assert flow.budget["eroded"] == pytest.approx(one.budget["eroded"], rel=0.06)
        apart = np.hypot(flow.particles.x - one.particles.x, flow.particles.y - one.particles.y)
        assert float(apart.max()) < 2.0 and float(apart.median()) < 0.2
        assert float(flow.particles.x.mean()) == pytest.approx(float(one.particles.x.mean()), abs=0.15)


def test_a_slow_inflow_is_not_arrested_after_a_fast_release(hill, monkeypatch):
    release_slab(hill, (60.0, 48.0), 8.0, 1.0)
    slow = LINE | {"line_end": (20.0, 40.0), "times": [0.0, 500.0], "discharge": 0.05, "velocity": 0.05}
    flow = DebrisFlow(hill, inflow=slow, numerics={"particle_count": 50})
    simulation, waited = flow._simulation, []
    pass_time = simulation._pass_time
    monkeypatch.setattr(simulation, "_pass_time", lambda end: (waited.append(end), pass_time(end)))
    flow.run_one_step(60.0)
    p = simulation.particles
    held = simulation.inflow.prescribed(p)
    # It would wait if all were arrested. The first row enters after 10 s, the release lies still after 30 s
    assert waited == [] and held.size
    np.testing.assert_allclose(np.linalg.norm(p.velocity[:, held], axis=0), 0.05, rtol=1e-12)


@pytest.mark.slow
def test_it_joins_a_release_and_erodes_only_beyond_the_strip(hill):
    release_slab(hill, (80.0, 48.0), 8.0, 1.0)
    flow = DebrisFlow(hill, inflow=SURGE, numerics={"particle_count": 200})
    flow.run_one_step(5.0)
    budget = flow.budget
    assert budget["released"] == 225.0 and budget["inflow"] > 50.0 and budget["eroded"] > 10.0
    assert flow.particles.sizes["particle"] > 250
    simulation = flow._simulation
    held = simulation.inflow.prescribed(simulation.particles)
    assert held.size and not simulation.particles.entrainment_rate[held].any()
    assert flow.run_until_rest() is True


@pytest.mark.slow
def test_a_call_that_fails_lets_nothing_in(hill):
    flow = DebrisFlow(hill, inflow=SURGE, numerics=COARSE)
    flow.run_one_step(3.0)
    before, particles, budget = copy_fields(hill), flow.particles, flow.budget
    with failing(9), pytest.raises(Failed):
        flow.run_one_step(5.0)
    assert not changed_fields(hill, before) and flow.particles.identical(particles)
    assert flow.budget == budget and flow.elapsed_time == 3.0
    flow.run_until_rest()
    other = inclined((20, 80), 5.0, 0.5, soil=1.0, foot=150.0)
    same = DebrisFlow(other, inflow=SURGE, numerics=COARSE)
    same.run_one_step(3.0)
    same.run_until_rest()
    assert flow.budget == same.budget


@pytest.mark.slow
def test_maps_say_what_flowed_in(hill, tmp_path):
    flow = DebrisFlow(hill, inflow=SURGE, numerics=COARSE)
    flow.run_one_step(3.0)
    maps = flow.maps
    assert maps.attrs["inflow_0_discharge"] == (0.0, 40.0, 0.0)
    assert maps.attrs["budget_inflow"] == flow.budget["inflow"] > 0.0
    maps.to_netcdf(tmp_path / "maps.nc")


@pytest.mark.slow
def test_from_yaml_text():
    model = wrap_as_bmi(DebrisFlow)()
    model.initialize("""
debris_flow:
    erosion: none
    numerics: {particle_count: 50}
    inflow:
      - {line_start: [20, 40], line_end: [20, 50], times: [0, 10], discharge: [5, 5], velocity: 3}
clock: {start: 0.0, stop: 10.0, step: 5.0}
grid:
    RasterModelGrid:
    - [20, 40]
    - xy_spacing: [5.0, 5.0]
    - fields:
        node:
          topographic__elevation:
            plane:
              - {point: [0.0, 0.0, 100.0], normal: [0.5, 0.0, 1.0]}
""")
    model.update()
    assert model._base.budget["inflow"] == pytest.approx(25.0, abs=1.0)
