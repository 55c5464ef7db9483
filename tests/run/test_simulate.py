"""`simulate` is a function: equal input gives equal maps, and the input stays as it was, in other processes, too."""

import multiprocessing
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest
import xarray as xr
from landlab import RasterModelGrid

from landlab_debrisflow import Scene, Setup, simulate
from landlab_debrisflow.core.errors import InputError, ParameterError
from landlab_debrisflow.fidelity.grids import copy_grid
from landlab_debrisflow.run.grids import build_grid
from tests.run.test_scene import HEAD, MAPPING

SETUP = {"friction": "voellmy", "numerics": {"particle_count": 60}}


def slope(north_up=False):
    """Return a slope with soil, a release and a node without data."""
    x, y = np.arange(100.0, 340.0, 5.0), np.arange(50.0, 130.0, 5.0)
    z = np.maximum(0.0, 120.0 - 0.5 * x) + 0.0 * y[:, None]
    z[2, 3] = np.nan
    release = 1.0 * ((abs(x - 130.0) < 8.0) & (abs(y[:, None] - 90.0) < 8.0))
    fields = {"topographic__elevation": z, "soil__depth": 2.0 + 0.0 * z, "debris_flow__release_depth": release}
    fields["soil__depth"][2, 3] = 1.0
    terrain = xr.Dataset({name: (("y", "x"), values) for name, values in fields.items()}, {"y": y, "x": x})
    return terrain.isel(y=slice(None, None, -1)) if north_up else terrain


def test_what_is_given_stays_as_it_was():
    terrain, grid, setup = slope(), build_grid(slope()), Setup(**SETUP)
    kept, names = terrain.copy(deep=True), set(grid.at_node)
    fields = {name: grid.at_node[name].copy() for name in names}
    status, mapping = grid.status_at_node.copy(), {**SETUP}
    maps = [simulate(setup, terrain, 20.0), simulate(mapping, grid, 20.0), simulate(setup, slope(True), 20.0)]
    assert terrain.identical(kept) and mapping == SETUP and setup == Setup(**SETUP)
    assert set(grid.at_node) == names and np.array_equal(grid.status_at_node, status)
    assert all(np.array_equal(grid.at_node[name], fields[name]) for name in names)
    assert maps[0].debris_flow__max_depth.max() > 0.5 and np.isnan(maps[0].debris_flow__max_depth.values[2, 3])
    for other in maps[1:]:
        assert all(other[name].equals(maps[0][name]) for name in maps[0].data_vars)


def test_duration_and_rest():
    assert simulate(SETUP, slope(), 2.0).attrs["elapsed_time"] == 2.0
    assert simulate(SETUP, slope(), 2.0).attrs["at_rest"] == 0
    still = slope()
    still["topographic__elevation"] = 0.0 * still.topographic__elevation
    assert simulate(SETUP, still).attrs["at_rest"] == 1


@pytest.mark.slow
def test_a_scene_brings_setup_duration_and_releases_at_their_times():
    later = {"polygons": HEAD, "depth": 0.5, "time": 4.0, "from": "above"}
    mapping = MAPPING | {"release": [MAPPING["release"], later], "output": {"max_duration": 8.0}}
    scene = Scene.from_mapping(mapping)
    terrain = scene.terrain.copy(deep=True)
    maps = simulate(None, scene)
    assert maps.attrs["elapsed_time"] == 8.0 and abs(maps.attrs["budget_released"] - 1500.0) < 1e-9
    assert scene.terrain.identical(terrain)
    assert simulate(None, scene, 3.0).attrs["budget_released"] == pytest.approx(1125.0, rel=1e-12)
    other = simulate({"friction": "coulomb", "numerics": {"particle_count": 60}}, scene, 3.0)
    assert other.attrs["friction"] != maps.attrs["friction"]


@pytest.mark.slow
def test_in_a_pool_of_processes():
    scene = Scene.from_mapping(MAPPING | {"output": {"max_duration": 3.0}})
    here = simulate(None, scene), simulate(SETUP, slope(), 3.0)
    with ProcessPoolExecutor(2, multiprocessing.get_context("spawn")) as pool:
        there = pool.submit(simulate, None, scene), pool.submit(simulate, Setup(**SETUP), slope(), 3.0)
        for one, other in zip(here, there, strict=True):
            assert all(one[name].equals(other.result()[name]) for name in one.data_vars)


@pytest.mark.parametrize(
    ("terrain", "words"),
    [
        (None, "must be a Dataset"), (3.0, "must be a Dataset"), (xr.Dataset(), "topographic__elevation over y and x"),
        (slope().rename(x="east"), "over y and x"), (slope().isel(x=slice(0, 2)), "at least 3"),
        (slope().assign_coords(x=np.geomspace(1.0, 9.0, 48)), "equally spaced"),
        (slope().assign_coords(x=np.zeros(48)), "in order"), (slope().isel(x=0), "over y and x"),
    ],
)  # fmt: skip
def test_terrains_that_are_refused(terrain, words):
    with pytest.raises(InputError, match=words):
        simulate(None, terrain)


def test_other_arguments_that_are_refused():
    with pytest.raises(ParameterError, match="unknown law"):
        simulate({"friction": "honey"}, slope())
    for duration in (-1.0, np.nan, np.inf):
        with pytest.raises(InputError, match="max_duration must lie in"):
            simulate(None, slope(), duration)


def test_copies_of_grids_are_whole():
    grid = RasterModelGrid((4, 5), xy_spacing=(2.0, 3.0), xy_of_lower_left=(10.0, 20.0))
    grid.add_field("mass__wasting_id", np.arange(20), at="node")
    grid.status_at_node[6] = grid.BC_NODE_IS_CLOSED
    copied = copy_grid(grid)
    assert (copied.dx, copied.dy, copied.xy_of_lower_left) == (2.0, 3.0, (10.0, 20.0))
    assert np.array_equal(copied.status_at_node, grid.status_at_node)
    assert copied.at_node["mass__wasting_id"].dtype == int
    copied.at_node["mass__wasting_id"][:] = 0
    assert grid.at_node["mass__wasting_id"][19] == 19
