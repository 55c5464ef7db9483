"""Inflow across a line: rows of particles in the strip, where they are, how fast, how thick and under what pressure."""

import numpy as np
import pytest
from landlab import RasterModelGrid

from landlab_debrisflow import DebrisFlow, Hydrograph
from landlab_debrisflow.model import step
from validation.grids import COARSE, inclined

Z = "topographic__elevation"
LINE = {"line_start": (20.0, 38.0), "line_end": (20.0, 58.0)}
SURGE = LINE | {"times": [1.0, 4.0, 10.0], "discharge": [0.0, 40.0, 0.0], "velocity": [4.0, 6.0, 3.0]}
VOLUME = 0.5 * 40.0 * 9.0


@pytest.fixture
def hill():
    """The valley without anything that fails."""
    return inclined((20, 80), 5.0, 0.5, soil=1.0, foot=150.0)


def test_a_step_longer_than_a_row_takes_lets_in_all_of_them_where_they_belong(hill):
    flow = DebrisFlow(hill, inflow=LINE | {"times": [0, 100], "discharge": 40, "velocity": 4}, numerics=COARSE)
    with flow._call.rollback.undo_on_failure():
        flow._call.begin()
    simulation = flow._simulation
    simulation.inflow.enter(simulation.particles, simulation.bed.surface, simulation.surroundings.columns, 50.0)
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
    simulation = flow._simulation
    p, inflow = simulation.particles, simulation.inflow
    held, source = inflow.prescribed(p), inflow.sources[0]
    assert np.unique(p.inflow_row[held]).size > 1
    way = source.way(3.5) - source.way(inflow._time[p.inflow_row[held]])
    np.testing.assert_allclose(p.x[held], 20.0 + way / np.hypot(1.0, 0.5), rtol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(p.velocity[:, held], axis=0), 4.0 + 2.0 * 2.5 / 3.0, rtol=1e-12)


@pytest.mark.slow
def test_no_step_leaps_over_rows(monkeypatch):
    """On a coarse grid fast thin flow could go ten times as far in a step as its rows are apart."""
    grid = inclined((20, 40), 50.0, 0.3)
    line = {"line_start": (150.0, 400.0), "line_end": (150.0, 500.0)}
    flow = DebrisFlow(
        grid, inflow=line | {"times": [0, 30], "discharge": 200, "velocity": 20}, numerics={"particle_count": 20000},
        erosion="none",
    )  # fmt: skip
    rows, advance = [], step.advance

    def watched(sim, dt):
        before = sim.inflow.rows_entered
        advance(sim, dt)
        rows.append(sim.inflow.rows_entered - before)

    monkeypatch.setattr(step, "advance", watched)
    flow.run_one_step(2.0)
    assert sum(rows) > 20 and max(rows) <= 2


@pytest.mark.slow
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
    simulation = flow._simulation
    held = simulation.inflow.prescribed(simulation.particles)
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
    p, simulation = flow.particles, flow._simulation
    rows, time = simulation.particles.inflow_row, simulation.inflow._time
    held = rows >= 0
    ratio = (p.basal_excess_pore_pressure / p.liquefaction_pressure).values[held]
    np.testing.assert_allclose(ratio, 0.2 + 0.06 * time[rows[held]], rtol=1e-12)
    assert 3.0 < time[rows[held]].min() < time[rows[held]].max() < 5.0
    columns = flow.columns.excess_pore_pressure.values[held]
    np.testing.assert_allclose(columns[:, 5], 0.5 * columns[:, 0], rtol=1e-12)  # linear, as the material says


@pytest.mark.slow
def test_without_a_ratio_it_is_that_of_a_release(hill):
    inflow = LINE | {"times": [0.0, 10.0], "discharge": 40.0, "velocity": 4.0}
    flow = DebrisFlow(hill, inflow=inflow, erosion="none", numerics=COARSE, material={"initial_pressure_ratio": 0.4})
    flow.run_one_step(1.0)
    ratio = flow.particles.basal_excess_pore_pressure / flow.particles.liquefaction_pressure
    assert float(ratio[-1]) == pytest.approx(0.4, abs=0.02)  # it has drained for a moment


@pytest.mark.slow
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
