"""Inflow across a line: what enters, when, where to, and how it ends (README, "Inflow")."""

import numpy as np
import pytest
from landlab import RasterModelGrid
from landlab.bmi import wrap_as_bmi

from landlab_debrisflow import DebrisFlow, Hydrograph
from landlab_debrisflow.model import step

from .grids import COARSE, changed_fields, copy_fields, inclined, release_slab

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
    assert rows.held(flow._simulation.particles).size == 0 and float(flow.particles.x.min()) < 21.0
    volumes = flow.particles.volume.values
    assert volumes.size == 300 and np.all(volumes == volumes[0])  # no light beside heavy


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
    assert len(steps) < 100 and watch.times == [1e6 + 1.0]
    assert flow.budget["inflow"] > 10.0


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
        # the strip. Measured 1.1 m for the few at the front, 34 m further, and 0.05 m in the mean; erosion 6e-3
        assert flow.budget["inflow"] == one.budget["inflow"]
        assert flow.budget["eroded"] == pytest.approx(one.budget["eroded"], rel=0.02)
        apart = np.hypot(flow.particles.x - one.particles.x, flow.particles.y - one.particles.y)
        assert float(apart.max()) < 2.0 and float(apart.median()) < 0.1
        assert float(flow.particles.x.mean()) == pytest.approx(float(one.particles.x.mean()), abs=0.15)


def test_a_step_longer_than_a_row_takes_lets_in_all_of_them_where_they_belong(hill):
    flow = DebrisFlow(hill, inflow=LINE | {"times": [0, 100], "discharge": 40, "velocity": 4}, numerics=COARSE)
    with flow._all_or_nothing():
        flow._begin()
    simulation = flow._simulation
    simulation.inflow.enter(simulation, 50.0)
    p, cosine = simulation.particles, 1.0 / np.hypot(1.0, 0.5)
    assert p.volume.sum() == pytest.approx(2000.0, rel=0.05)
    x = np.unique(p.x.round(9))
    spacing = np.diff(x)
    row = np.count_nonzero(p.x == p.x.max()) * p.volume[0]
    # a row of volume V stands for V/(h L) along the slope, h = Q/(v L)
    np.testing.assert_allclose(spacing, row / (40.0 / 4.0) * cosine, rtol=1e-8)
    assert x[0] - 20.0 < spacing[0]
    assert not np.any(p.inflow_row[p.x > 20.0 + 1.01 * cosine * simulation.inflow.sources[0].strip] >= 0)


def test_in_the_strip_rows_are_where_the_velocity_has_brought_them():
    flow = DebrisFlow(inclined((20, 80), 5.0, 0.5), inflow=SURGE, erosion="none", numerics={"particle_count": 400})
    flow.run_one_step(3.5)
    p, inflow = flow._simulation.particles, flow._simulation.inflow
    held, source = inflow.held(p), inflow.sources[0]
    assert np.unique(p.inflow_row[held]).size > 1
    way = source.way(3.5) - source.way(inflow._time[p.inflow_row[held]])
    np.testing.assert_allclose(p.x[held], 20.0 + way / np.hypot(1.0, 0.5), rtol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(p.velocity[:, held], axis=0), 4.0 + 2.0 * 2.5 / 3.0, rtol=1e-12)


def test_no_step_leaps_over_rows(monkeypatch):
    """On a coarse grid fast thin flow could go ten times as far in a step as its rows are apart."""
    grid = inclined((20, 40), 50.0, 0.3)
    line = {"line_start": (150.0, 400.0), "line_end": (150.0, 500.0)}
    flow = DebrisFlow(
        grid, inflow=line | {"times": [0, 30], "discharge": 200, "velocity": 20}, numerics={"particle_count": 20000},
        erosion="none",
    )  # fmt: skip
    rows, advance, inflow = [], step.advance, flow._simulation.inflow

    def watched(sim, dt):
        before = inflow.rows_entered
        advance(sim, dt)
        rows.append(inflow.rows_entered - before)

    monkeypatch.setattr(step, "advance", watched)
    flow.run_one_step(2.0)
    assert sum(rows) > 20 and max(rows) <= 2


def test_a_slow_inflow_is_not_arrested_after_a_fast_release(hill, monkeypatch):
    release_slab(hill, (60.0, 48.0), 8.0, 1.0)
    slow = LINE | {"line_end": (20.0, 40.0), "times": [0.0, 500.0], "discharge": 0.05, "velocity": 0.05}
    flow = DebrisFlow(hill, inflow=slow, numerics={"particle_count": 50})
    simulation, waited = flow._simulation, []
    pass_time = simulation._pass_time
    monkeypatch.setattr(simulation, "_pass_time", lambda end: (waited.append(end), pass_time(end)))
    flow.run_one_step(60.0)
    p = simulation.particles
    held = simulation.inflow.held(p)
    # It would wait if all were arrested. The first row enters after 10 s, the release lies still after 30 s
    assert waited == [] and held.size
    np.testing.assert_allclose(np.linalg.norm(p.velocity[:, held], axis=0), 0.05, rtol=1e-12)


@pytest.mark.parametrize(("towards", "degrees"), [((1, 0), 0), ((-1, 0), 180), ((0, 1), 90), ((0.6, -0.8), None)])
def test_it_flows_downslope_across_the_line_or_where_it_is_told(towards, degrees):
    towards = np.array(towards)
    grid = RasterModelGrid((31, 31), xy_spacing=(4.0, 5.0), xy_of_lower_left=(1000.0, -500.0))
    x, y = grid.x_of_node - 1060.0, grid.y_of_node + 425.0
    grid.add_field(Z, 100.0 - 0.3 * (towards[0] * x + towards[1] * y), at="node")
    across = 12.0 * np.array([-towards[1], towards[0]])
    centre = np.array([1060.0, -425.0])
    line = {"line_start": centre - across, "line_end": centre + across}
    where = []
    for direction in (None, degrees):
        inflow = Hydrograph(**line, times=[0.0, 5.0], discharge=20.0, velocity=3.0, direction=direction)
        flow = DebrisFlow(grid, inflow=inflow, erosion="none", numerics={"particle_count": 1000})
        flow.run_one_step(2.0)
        p = flow.particles
        where.append(np.array([p.x.mean(), p.y.mean()]) - centre)
    # symmetric but for the shift of the rows against each other, a quarter of .4 m
    np.testing.assert_allclose(where[0], np.hypot(*where[0]) * towards, atol=0.1)
    np.testing.assert_allclose(where[0], where[1], atol=1e-6)
    assert np.hypot(*where[0]) > 2.5


def test_it_flows_in_obliquely_with_the_discharge_given():
    grid = inclined((40, 40), 5.0, 0.0)
    oblique = LINE | {"times": [0, 10], "discharge": 30, "velocity": 5, "direction": 30}
    flow = DebrisFlow(grid, inflow=oblique, erosion="none", numerics={"particle_count": 400})
    flow.run_one_step(5.0)
    p = flow.particles
    assert flow.budget["inflow"] == pytest.approx(150.0, rel=0.02)
    held = flow._simulation.inflow.held(flow._simulation.particles)
    ratio = p.velocity_y.values[held] / p.velocity_x.values[held]
    np.testing.assert_allclose(ratio, np.tan(np.radians(30.0)), rtol=1e-12)
    # seen from 30 degrees aside the line is shorter and the flow thicker
    np.testing.assert_allclose(p.thickness.values[held], 30.0 / (5.0 * 20.0 * np.cos(np.radians(30.0))), rtol=1e-12)


@pytest.mark.parametrize("column", ["ale", "classical", {"law": "ale", "scheme": "lax_wendroff"}])
def test_pore_pressure_comes_in_as_given(hill, column):
    inflow = LINE | {"times": [0.0, 10.0], "discharge": 40.0, "velocity": 4.0, "pressure_ratio": [0.2, 0.8]}
    undrained = {"coefficient_of_consolidation": 0.0}
    flow = DebrisFlow(hill, inflow=inflow, erosion="none", numerics=COARSE, material=undrained, column=column)
    flow.run_one_step(5.0)
    p, rows = flow.particles, flow._simulation.particles.inflow_row
    held, time = rows >= 0, flow._simulation.inflow._time
    ratio = (p.basal_excess_pore_pressure / p.liquefaction_pressure).values[held]
    np.testing.assert_allclose(ratio, 0.2 + 0.06 * time[rows[held]], rtol=1e-12)
    assert 3.0 < time[rows[held]].min() < time[rows[held]].max() < 5.0
    columns = flow.columns.excess_pore_pressure.values[held]
    np.testing.assert_allclose(columns[:, 5], 0.5 * columns[:, 0], rtol=1e-12)  # linear, as the material says


def test_without_a_ratio_it_is_that_of_a_release(hill):
    inflow = LINE | {"times": [0.0, 10.0], "discharge": 40.0, "velocity": 4.0}
    flow = DebrisFlow(hill, inflow=inflow, erosion="none", numerics=COARSE, material={"initial_pressure_ratio": 0.4})
    flow.run_one_step(1.0)
    ratio = flow.particles.basal_excess_pore_pressure / flow.particles.liquefaction_pressure
    assert float(ratio[-1]) == pytest.approx(0.4, abs=0.02)  # it has drained for a moment


def test_it_joins_a_release_and_erodes_only_beyond_the_strip(hill):
    release_slab(hill, (80.0, 48.0), 8.0, 1.0)
    flow = DebrisFlow(hill, inflow=SURGE, numerics={"particle_count": 200})
    flow.run_one_step(5.0)
    budget = flow.budget
    assert budget["released"] == 225.0 and budget["inflow"] > 50.0 and budget["eroded"] > 10.0
    assert flow.particles.sizes["particle"] > 250
    simulation = flow._simulation
    held = simulation.inflow.held(simulation.particles)
    assert held.size and not simulation.particles.entrainment_rate[held].any()
    assert flow.run_until_rest() is True


class Raises:
    interval = 2.0

    def observe(self, flow):
        raise RuntimeError("no paper left")


def test_a_call_that_fails_lets_nothing_in(hill):
    flow = DebrisFlow(hill, inflow=SURGE, numerics=COARSE)
    flow.run_one_step(3.0)
    before, particles, budget = copy_fields(hill), flow.particles, flow.budget
    flow._observers = (Raises(),)
    with pytest.raises(RuntimeError):
        flow.run_one_step(5.0)
    assert not changed_fields(hill, before) and flow.particles.identical(particles)
    assert flow.budget == budget and flow.elapsed_time == 3.0
    flow._observers = ()
    flow.run_until_rest()
    other = inclined((20, 80), 5.0, 0.5, soil=1.0, foot=150.0)
    same = DebrisFlow(other, inflow=SURGE, numerics=COARSE)
    same.run_one_step(3.0)
    same._simulation._changed = True  # an undone call finds everything anew
    same.run_until_rest()
    assert flow.budget == same.budget


def test_several_hydrographs_have_particles_of_one_size(hill):
    small = LINE | {
        "times": [0, 9],
        "discharge": 2,
        "velocity": 3,
        "line_start": (20.0, 15.0),
        "line_end": (20.0, 25.0),
    }
    flow = DebrisFlow(hill, inflow=(Hydrograph(**SURGE), small), numerics={"particle_count": 400}, erosion="none")
    flow.run_one_step(10.0)
    volumes = np.unique(flow.particles.volume.values)
    assert volumes.size == 2 and volumes[1] / volumes[0] < 1.05
    assert flow.budget["inflow"] == pytest.approx(VOLUME + 18.0, rel=1e-14)
    assert flow.particles.sizes["particle"] == pytest.approx(400, abs=2)


def test_the_spacing_given_is_that_at_the_thickest(hill):
    flow = DebrisFlow(hill, inflow=SURGE, numerics={"particle_spacing": 1.5})
    thickest = 40.0 / (6.0 * 20.0)
    assert flow._simulation.inflow.sources[0].particle_volume == pytest.approx(1.5**2 * thickest, rel=0.02)


def test_maps_say_what_flowed_in(hill, tmp_path):
    flow = DebrisFlow(hill, inflow=SURGE, numerics=COARSE)
    flow.run_one_step(3.0)
    maps = flow.maps
    assert maps.attrs["inflow 0 discharge [m3 s-1]"] == (0.0, 40.0, 0.0)
    assert maps.attrs["budget inflow [m3]"] == flow.budget["inflow"] > 0.0
    maps.to_netcdf(tmp_path / "maps.nc")


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
