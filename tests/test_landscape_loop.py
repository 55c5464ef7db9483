"""Debris flows in the loop of a landscape model: accounts, peaks of every event, messages."""

import logging

import numpy as np
import pytest
import xarray as xr
from landlab import RasterModelGrid
from landlab.components import DepthDependentDiffuser, ExponentialWeatherer, FlowAccumulator, SpaceLargeScaleEroder

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.triggers import release_probable_sites
from validation.grids import COARSE, inclined, release_slab

from .test_examples import load

Z, SOIL, ROCK, RELEASE = "topographic__elevation", "soil__depth", "bedrock__elevation", "debris_flow__release_depth"
PEAK, ARRIVAL = "debris_flow__max_depth", "debris_flow__arrival_time"


@pytest.mark.slow
def test_the_example_shortened(capsys, monkeypatch):
    example = load("landscape")
    monkeypatch.setitem(example.SLOPE_STRENGTH, "soil__internal_friction_angle", 34.0)  # more fails in a few years
    weak = {"angle_int_frict": 0.55, "cohesion_eff": 5e3, "landslides_return_time": 500.0}
    monkeypatch.setattr(example, "ROCK_STRENGTH", weak)
    landscape = example.main(years=15, rows=60, columns=60, particles=150)
    entries, grid = landscape.ledger.entries, landscape.grid
    told = capsys.readouterr().out
    assert all(name in told for name in entries) and "of the volume they moved" in told
    flows = entries["debris flows"]
    assert [event.year.item() for event in landscape.events] == [5, 10, 15]
    assert flows.moved > 1e3 and flows.rock == 0.0
    # what a flow changes: elevation against its own budget, soil against elevation
    assert abs(flows.residual) < 1e-9 * flows.moved and abs(flows.grains) < 1e-9 * flows.moved
    assert -flows.edge == pytest.approx(landscape.flow.budget["outflow"], abs=1e-9 * flows.moved)
    # what others leave: the grains of rivers balance, of weathering and creep the volume; the rest are pores
    rivers, creep, rock = (entries[name] for name in ("rivers (SPACE)", "weathering, creep", "trigger: rock"))
    assert abs(rivers.grains) < 1e-9 * rivers.moved and abs(creep.residual) < 1e-9 * creep.moved
    assert abs(rock.grains) < 1e-9 * rock.moved and rock.residual > 0.1 * rock.moved
    assert rivers.residual < -0.1 * rivers.moved and creep.grains < -0.1 * creep.moved
    # elevations of 400 m change some hundred times: 6e-14 each
    assert max(entry.gap for entry in entries.values()) < 1e-11
    assert grid.at_node[SOIL].min() >= 0.0 and not grid.at_node[RELEASE].any()
    peaks = xr.concat(landscape.events, "year")
    assert peaks[PEAK].sizes["year"] == len(landscape.events) and np.all(peaks[PEAK].max(("x", "y")) > 0.5)


# ---- elevation, soil and bedrock ----


def masked(soil=1.0):
    """Return a valley in a mask of missing data, with an obstacle of closed nodes and a sink of open ones."""
    grid = inclined((24, 80), 5.0, 0.5, soil=soil, foot=150.0)
    x, y, z = grid.x_of_node, grid.y_of_node, grid.at_node[Z]
    z += 0.02 * abs(y - 57.5) + 300.0
    outside = (abs(y - 57.5) > 45.0) | (x > 360.0)
    z[outside] = grid.at_node[SOIL][outside] = -9999.0
    grid.set_nodata_nodes_to_closed(z, -9999.0)
    grid.status_at_node[(abs(x - 130.0) < 8.0) & (abs(y - 60.0) < 8.0)] = grid.BC_NODE_IS_CLOSED
    grid.status_at_node[(abs(x - 180.0) < 3.0) & (abs(y - 40.0) < 8.0)] = grid.BC_NODE_IS_FIXED_VALUE
    grid.add_field(ROCK, np.where(outside, -9999.0, z - grid.at_node[SOIL]), at="node")
    return grid


@pytest.mark.slow
def test_elevation_stays_soil_on_rock_whatever_the_boundaries():
    grid = masked()
    flow, kept = DebrisFlow(grid, numerics=COARSE), {name: grid.at_node[name].copy() for name in (Z, SOIL, ROCK)}
    still = grid.status_at_node != grid.BC_NODE_IS_CORE
    for event in range(4):
        release_slab(grid, (30.0 + 6.0 * event, 58.0), 9.0, 0.0)
        near = (abs(grid.x_of_node - 30.0 - 6.0 * event) < 9.0) & (abs(grid.y_of_node - 58.0) < 9.0)
        release_probable_sites(grid, near, depth=0.5)
        assert flow.run_until_rest() is True
        gap = abs(grid.at_node[Z] - grid.at_node[ROCK] - grid.at_node[SOIL])[~still].max()
        assert gap < 1e-12 * (1 + event)  # elevations of 400 m, rounded to 6e-14, changed in some steps of an event
    assert flow.budget["outflow"] > 0.0
    assert grid.at_node[ROCK].tobytes() == kept[ROCK].tobytes()
    for name in (Z, SOIL):
        assert grid.at_node[name][still].tobytes() == kept[name][still].tobytes()
    assert abs(grid.at_node[Z] - kept[Z]).max() > 0.3


@pytest.mark.slow
def test_every_event_between_other_components_closes():
    """The four of a landscape model change the ground in every year; each event balances by itself."""
    grid = inclined((24, 60), 10.0, 0.5, soil=1.0, foot=300.0)
    grid.at_node[Z] += 0.2 * abs(grid.y_of_node - 115.0) + np.random.default_rng(1).uniform(
        0.0, 0.05, grid.number_of_nodes
    )
    grid.add_field(ROCK, grid.at_node[Z] - grid.at_node[SOIL], at="node")
    grid.set_closed_boundaries_at_grid_edges(False, True, True, True)
    router = FlowAccumulator(grid, flow_director="FlowDirectorD8")
    router.run_one_step()
    rivers = SpaceLargeScaleEroder(grid, K_sed=1e-4, K_br=1e-5)
    weathering = ExponentialWeatherer(grid, soil_production_maximum_rate=1e-3)
    creep = DepthDependentDiffuser(grid, soil_transport_velocity=0.02)
    flow, core, area = DebrisFlow(grid, numerics=COARSE), grid.core_nodes, 100.0
    for year in range(3):
        release_slab(grid, (60.0 + 20.0 * year, 115.0), 16.0, 0.0)
        near = (abs(grid.x_of_node - 60.0 - 20.0 * year) < 16.0) & (abs(grid.y_of_node - 115.0) < 16.0)
        volume = release_probable_sites(grid, near)
        before, ground = flow.budget, {name: grid.at_node[name][core].copy() for name in (Z, SOIL)}
        assert flow.run_until_rest() is True
        gain = {name: value - before[name] for name, value in flow.budget.items()}
        moved = volume + gain["eroded"]
        assert gain["released"] == pytest.approx(volume, rel=1e-12) and gain["eroded"] > 0.0
        for name in (Z, SOIL):
            change = area * (grid.at_node[name][core] - ground[name]).sum()
            assert change == pytest.approx(gain["deposited"] - moved, abs=1e-9 * moved)
            assert change == pytest.approx(-gain["outflow"], abs=1e-9 * moved)
        router.run_one_step()
        rivers.run_one_step(1.0)
        weathering.run_one_step()
        creep.run_one_step(1.0)


# ---- peaks and messages ----


def two_sites():
    """Return two slopes towards a flat between them, with a dam of 20 m in its middle."""
    grid = RasterModelGrid((20, 80), xy_spacing=5.0)
    aside = abs(grid.x_of_node - 197.5)
    grid.add_field(Z, 0.5 * np.maximum(0.0, aside - 60.0) + np.maximum(0.0, 20.0 - aside), at="node")
    grid.add_full(SOIL, 1.0, at="node")
    return grid


def run_event(flow, x):
    flow.new_event()
    release_slab(flow.grid, (x, 48.0), 8.0, 0.9)
    assert flow.run_until_rest() is True
    return flow.maps[[PEAK, ARRIVAL]]


@pytest.mark.slow
def test_peaks_of_every_event_and_of_all():
    flow, alone = (DebrisFlow(two_sites(), numerics=COARSE) for _ in range(2))
    west = run_event(flow, 80.0)
    between = flow.elapsed_time
    east = run_event(flow, 315.0)
    assert float(west[PEAK].sel(x=slice(220.0, None)).max()) == 0.0 == float(east[PEAK].sel(x=slice(None, 175.0)).max())
    assert float(west[PEAK].max()) > 0.5 and float(east[PEAK].max()) > 0.5
    came = east[ARRIVAL].where(east[ARRIVAL] >= 0.0)
    assert float(came.min()) == pytest.approx(between, abs=0.5)  # a first step
    assert bool((came.notnull() == (east[PEAK] > 0.0)).all())
    for x in (80.0, 315.0):  # without new_event() the maps hold both
        release_slab(alone.grid, (x, 48.0), 8.0, 0.9)
        alone.run_until_rest()
    both = np.maximum(west[PEAK], east[PEAK])
    np.testing.assert_array_equal(alone.maps[PEAK], both)


def test_a_first_event_may_be_announced():
    flow = DebrisFlow(two_sites(), numerics=COARSE)
    flow.new_event()
    assert not flow.grid.at_node[PEAK].any() and flow.grid.at_node[ARRIVAL].max() == -1.0


def test_years_without_an_event_are_told_once_and_change_nothing(caplog):
    grid = two_sites()
    flow = DebrisFlow(grid, numerics=COARSE)
    caplog.set_level(logging.INFO, "landlab_debrisflow")
    for _ in range(5):
        grid.at_node[Z] += 1e-3
        kept = grid.at_node[Z].copy()
        assert flow.run_until_rest() is True
        assert grid.at_node[Z].tobytes() == kept.tobytes()
    assert [message[:13] for message in caplog.messages] == ["nothing to do"]
    assert flow.elapsed_time == 0.0
