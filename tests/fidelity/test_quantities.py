"""Quantities of a run, by hand and of a flow; their change while it creeps."""

from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from landlab import RasterModelGrid

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.fidelity.quantities import UNITS, Decay, origin_of, quantities

Y, X = np.arange(3) * 10.0, np.arange(5) * 10.0


def flow_at_rest(settled=True, **fields):
    """Return what looks like a flow on 3 x 5 nodes of 10 m, of whose fields those not given are 0."""
    names = "max_depth", "deposit_depth", "depth", "max_speed", "max_basal_pressure_ratio"
    values = {name: np.zeros((3, 5)) for name in names} | fields
    maps = xr.Dataset({f"debris_flow__{name}": (("y", "x"), found) for name, found in values.items()}, {"y": Y, "x": X})
    volume = np.zeros(0) if settled else np.array([98.5, 1.0, 0.5])
    particles = xr.Dataset({
        "volume": ("particle", volume), "x": ("particle", np.array([20.0, 40.0, 90.0])[: volume.size]),
        "y": ("particle", np.array([10.0] * volume.size)),
    })  # fmt: skip
    grid = RasterModelGrid((3, 5), xy_spacing=10.0)
    return SimpleNamespace(maps=maps, particles=particles, grid=grid, budget={"eroded": 7.0}, elapsed_time=12.0)


def test_by_hand():
    depth, lies = np.zeros((3, 5)), np.zeros((3, 5))
    depth[1, 1:4] = 0.05, 1.0, 3.0  # the first below 0.1 m
    lies[1, 2:4] = 1.0, 2.0
    speed = np.zeros((3, 5))
    speed[1, 1:4] = 90.0, 10.0, 20.0
    found = quantities(flow_at_rest(max_depth=depth, deposit_depth=lies, max_speed=speed), (0.0, 10.0))
    assert set(found) == set(UNITS)
    assert found["area"] == 200.0
    assert found["deposit"] == pytest.approx(5.0 / 3.0)
    assert found["run_out"] == 30.0 and found["centre"] == pytest.approx((20.0 + 2.0 * 30.0) / 3.0)
    assert found["max_speed"] == 20.0 and found["speed"] == pytest.approx(19.9) and found["mean_depth"] == 2.0
    assert found["eroded"] == 7.0 and found["duration"] == 12.0 and found["pressure"] == 0.0


def test_particles_count_as_long_as_there_are_any():
    found = quantities(flow_at_rest(settled=False), (20.0, 10.0))
    assert found["run_out"] == 20.0 and found["run_out_95"] == 0.0  # 99 % lie within 20 m, half a per cent at 70 m
    assert found["centre"] == pytest.approx(0.2 + 0.35)


def test_nothing_there_is_not_a_number():
    found = quantities(flow_at_rest(), (0.0, 0.0))
    assert all(np.isnan(found[name]) for name in ("run_out", "centre", "deposit", "speed", "depth", "pressure"))
    assert found["area"] == 0.0


def test_origin():
    grid = RasterModelGrid((3, 5), xy_spacing=10.0)
    lines = [SimpleNamespace(line_start=(0.0, 0.0), line_end=(0.0, 10.0), volume=1.0),
             SimpleNamespace(line_start=(40.0, 0.0), line_end=(40.0, 10.0), volume=3.0)]  # fmt: skip
    assert origin_of(grid, SimpleNamespace(inflow=lines)) == (30.0, 5.0)
    assert np.isnan(origin_of(grid, SimpleNamespace(inflow=()))).all()
    release = grid.add_zeros("debris_flow__release_depth", at="node")
    release[[6, 8]] = 1.0, 3.0
    assert origin_of(grid, SimpleNamespace(inflow=lines)) == (25.0, 10.0)


def test_decay_measures_when_energy_falls_below_parts_of_its_peak():
    decay, times = Decay(levels=(0.1,)), []
    flow = flow_at_rest(settled=False)
    for time, speed in enumerate((0.0, 1.0, 2.0, 0.6, 0.5, 0.65, 0.5, 1.5, 0.5)):
        moving = SimpleNamespace(volume=np.ones(1), velocity=np.full((3, 1), speed))
        decay.follow(moving, time - 1.0, float(time))
        if decay.interval < 1.0:
            flow.elapsed_time = float(time)
            decay.observe(flow)
            times.append((time, decay.found[0.1]["duration"]))
    # 0.36/4 < 0.1 at 3; 0.42/4 is no more than noise; anew after 1.5, 2.25/4 > 0.3
    assert times == [(3, 3.0), (8, 8.0)]


def test_decay_of_a_flow_changes_nothing():
    def run(*observers):
        grid = RasterModelGrid((20, 40), xy_spacing=5.0)
        x, y = grid.x_of_node, grid.y_of_node
        grid.add_field("topographic__elevation", 0.5 * np.maximum(0.0, 80.0 - x), at="node")
        grid.add_field("debris_flow__release_depth", 1.0 * (np.hypot(x - 30.0, y - 48.0) < 12.0), at="node")
        flow = DebrisFlow(grid, numerics={"particle_count": 60, "settle": False}, observers=observers)
        assert flow.run_until_rest(200.0)
        return flow

    decay, plain = Decay(), run()
    watched = run(decay)
    xr.testing.assert_identical(plain.particles, watched.particles)
    assert decay.origin == pytest.approx((30.0, 47.5), abs=2.5)
    early, late = decay.found[1e-2], decay.found[1e-3]
    assert 0.0 < early["duration"] < late["duration"] < watched.elapsed_time
    assert late["run_out"] == pytest.approx(quantities(watched, decay.origin)["run_out"], rel=0.05)
