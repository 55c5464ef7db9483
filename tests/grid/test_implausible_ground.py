"""Numbers that mark missing data, and ground that nothing has, are refused; what is steep or far away is not."""

import io

import numpy as np
import pytest
from landlab import RasterModelGrid
from landlab.io import esri_ascii

from landlab_debrisflow import DebrisFlow, InputError
from validation.cases import stability as scenes
from validation.grids import COARSE, changed_fields, copy_fields, inclined, release_slab

Z, SOIL, RELEASE = "topographic__elevation", "soil__depth", "debris_flow__release_depth"
FILLS = [-9999.0, -32768.0, -32767.0, 32767.0, 65535.0, -99999.0, -2147483648.0, 1e20, -1e30]
FLOATS = [float(np.finfo(np.float32).min), float(np.finfo(float).max), 9.969209968386869e36, float(np.float32(1e20))]
CLOSE = "grid.set_nodata_nodes_to_closed(grid.at_node['topographic__elevation'], "


def slope_at(height, soil=None):
    """A slope onto a flat, `height` above the datum [m], with something about to fail, and nodes of a void in its way.

    Returns
    -------
    RasterModelGrid, ndarray of int
    """
    grid = inclined((20, 60), 5.0, 0.5, soil=soil, foot=200.0)
    grid.at_node[Z] += height
    release_slab(grid, (30.0, 48.0), 8.0, 0.5)
    return grid, np.flatnonzero((abs(grid.x_of_node - 100.0) < 8.0) & (abs(grid.y_of_node - 50.0) < 12.0))


def refusal(grid):
    """Return the words with which a first call is refused; nothing is changed."""
    flow, before = DebrisFlow(grid, numerics=COARSE), copy_fields(grid)
    with pytest.raises(InputError) as error:
        flow.run_one_step(0.1)
    assert not changed_fields(grid, before)
    return str(error.value)


def follow(message, grid):
    """Do what the message says, and run."""
    remedy = message[message.index("grid.") :].split("; ")[0]
    exec(remedy, {"grid": grid, "np": np})
    DebrisFlow(grid, numerics=COARSE).run_one_step(0.1)


@pytest.mark.slow
@pytest.mark.parametrize("height", [0.0, 200.0, 3000.0])
@pytest.mark.parametrize("value", FILLS + FLOATS)
def test_fill_values_are_refused_with_count_place_and_remedy(value, height):
    grid, void = slope_at(height)
    grid.at_node[Z][void] = value
    message = refusal(grid)
    row, column = divmod(int(void[0]), 60)
    assert f"at {void.size} nodes" in message and f"node {void[0]} (row {row}, column {column})" in message
    call = message[message.index(CLOSE) + len(CLOSE) :].split(")")[0]
    assert float(call) == value
    follow(message, grid)
    assert np.all(grid.status_at_node[void] == grid.BC_NODE_IS_CLOSED)


@pytest.mark.slow
@pytest.mark.parametrize("value", [-32768.0, 1e20])
def test_it_does_not_matter_how_much_is_missing(value):
    """A single node, or most of a raster that was rotated."""
    grid, _ = slope_at(200.0)
    grid.at_node[Z][20 * 30 + 50] = value
    follow(refusal(grid), grid)
    grid, _ = slope_at(200.0)
    beyond = grid.x_of_node > 120.0
    grid.at_node[Z][beyond] = value
    assert f"at {np.count_nonzero(beyond)} nodes" in refusal(grid)


@pytest.mark.slow
def test_a_void_read_from_a_file_is_refused_whatever_its_header_says():
    for nodata in (-9999, -32768, -340282346638528859811704183484516925440):
        grid, void = slope_at(200.0)
        z = grid.at_node[Z].copy()
        z[void] = nodata
        head = f"ncols 60\nnrows 20\nxllcorner 0\nyllcorner 0\ncellsize 5\nNODATA_value {nodata}\n"
        rows = [" ".join(map(repr, map(float, row))) for row in z.reshape(20, 60)[::-1]]
        grid = esri_ascii.load(io.StringIO(head + "\n".join(rows)), name=Z, at="node")
        assert "close them" in refusal(grid)


def test_what_is_no_number_is_counted_and_closed_as_printed():
    grid, void = slope_at(200.0)
    grid.at_node[Z][void] = np.nan
    message = refusal(grid)
    assert f"the first of {void.size}" in message
    follow(message, grid)


@pytest.mark.parametrize("value", [-5000.0, 9000.0, 8888.0, 15000.0])
def test_cliffs_higher_than_any_are_refused(value):
    grid, void = slope_at(1500.0)
    grid.at_node[Z][void] = value
    message = refusal(grid)
    assert f"is {value:g} m at {void.size} nodes" in message and f"node {void[0]} " in message
    follow(message, grid)


@pytest.mark.slow
def test_the_smoothed_rim_of_a_void_is_refused_too():
    grid, void = slope_at(1500.0)
    grid.at_node[Z][void] = np.linspace(-9000.0, -5000.0, void.size)  # as bilinear resampling leaves it
    follow(refusal(grid), grid)
    assert np.all(grid.status_at_node[void] == grid.BC_NODE_IS_CLOSED)


@pytest.mark.slow
def test_elevations_in_millimetres_are_refused():
    grid, _ = slope_at(200.0)
    grid.at_node[Z] *= 1000.0
    assert "elevations and coordinates are in m" in refusal(grid)


@pytest.mark.parametrize("value", [0.0, -1.0, -99.0, -999.0])
def test_voids_filled_with_a_number_that_exists_are_refused(value):
    grid, void = slope_at(300.0)
    grid.at_node[Z][void] = value
    message = refusal(grid)
    assert f"exactly {value:g} m at {void.size} nodes, the first is node {void[0]} " in message
    follow(message, grid)


@pytest.mark.slow
@pytest.mark.parametrize("value", [-1000.0, 1.0, 255.0])
def test_deep_voids_filled_with_any_number_are_refused(value):
    grid, void = slope_at(600.0)
    grid.at_node[Z][void] = value
    follow(refusal(grid), grid)
    assert np.array_equal(np.flatnonzero(grid.status_at_node == grid.BC_NODE_IS_CLOSED), void)


def test_the_message_says_how_to_keep_what_is_meant():
    """A shaft of three by five nodes, 400 m deep."""
    grid, void = slope_at(600.0)
    grid.at_node[Z][void] = 255.0
    assert "if it is ground, give it another elevation" in refusal(grid)
    grid.at_node[Z][void] += 1e-3 * np.arange(void.size)
    accepted(grid)


def test_only_the_void_is_closed_where_there_is_ground_at_the_same_elevation():
    grid, void = slope_at(500.0)
    sea = grid.x_of_node > 280.0
    grid.at_node[Z] -= 500.0 * np.clip((grid.x_of_node - 210.0) / 70.0, 0.0, 1.0)
    grid.at_node[Z][sea | np.isin(np.arange(sea.size), void)] = 0.0
    follow(refusal(grid), grid)
    assert np.array_equal(np.flatnonzero(grid.status_at_node == grid.BC_NODE_IS_CLOSED), void)


def accepted(grid):
    DebrisFlow(grid, friction={"law": "coulomb", "basal_friction_angle": 20.0}, numerics=COARSE).run_one_step(0.1)


@pytest.mark.slow
@pytest.mark.parametrize("offset", [-11000.0, 0.0, 8000.0, 20000.0, 1e6])
def test_the_datum_is_nobodys_business(offset):
    grid, _ = slope_at(offset)
    accepted(grid)


@pytest.mark.slow
@pytest.mark.parametrize(
    "build",
    [
        lambda: scenes.pit(200.0), lambda: scenes.pit(100.0), lambda: scenes.pit(50.0, spacing=1.0),
        lambda: scenes.cliff(200.0), lambda: scenes.cliff(1000.0), scenes.gully, scenes.noisy_slope, scenes.walls,
        lambda: scenes.plane(np.tan(np.radians(80.0)), 1.0), lambda: scenes.plane(0.5, 100.0),
        lambda: scenes.pit(1000.0),
    ],
)  # fmt: skip
def test_pits_cliffs_and_steep_slopes_are_ground(build):
    accepted(build())


@pytest.mark.slow
def test_a_flat_below_walls_is_ground_if_it_opens_to_the_edge():
    row, column = np.mgrid[:21, :41]
    grid = scenes.raster(np.where((column > 20) & (abs(row - 10) < 6), 0.0, 400.0), 5.0)
    release_slab(grid, (50.0, 50.0), 8.0, 1.0)
    accepted(grid)


@pytest.mark.slow
def test_a_lake_in_a_caldera_is_ground():
    """At sea level, below walls of 200 m at 45 degrees."""
    y, x = np.mgrid[:41, :41] - 20.0
    grid = scenes.raster(np.clip(5.0 * (np.hypot(x, y) - 10.0), 0.0, 200.0), 5.0)
    release_slab(grid, (30.0, 100.0), 8.0, 1.0)
    accepted(grid)


@pytest.mark.slow
@pytest.mark.parametrize("value", [-9999.0, 32767.0, 1e20, -3.4028234663852886e38])
@pytest.mark.parametrize("name", [SOIL, RELEASE])
def test_fill_values_of_soil_and_release_are_replaced_as_printed(name, value):
    grid, void = slope_at(0.0, soil=1.0)
    grid.at_node[name][void] = value
    message = refusal(grid)
    assert message.startswith(name) and f"node {void[0]} " in message and f"at {void.size} nodes" in message
    follow(message, grid)
    assert not np.any(grid.at_node[name][void])


@pytest.mark.parametrize("value", [-9999.0, 32767.0, 1e20])
def test_fill_values_at_closed_nodes_are_nobodys_business(value):
    grid, void = slope_at(0.0, soil=1.0)
    grid.status_at_node[void] = grid.BC_NODE_IS_CLOSED
    for name in (Z, SOIL, RELEASE):
        grid.at_node[name][void] = value
    accepted(grid)


@pytest.mark.slow
def test_a_fill_value_of_ids_lets_nothing_fail():
    grid, void = slope_at(0.0, soil=1.0)
    grid.at_node[RELEASE][:] = 0.0
    ids = grid.add_zeros("mass__wasting_id", at="node", dtype=int)
    ids[:] = 65535
    ids[void] = 3
    message = refusal(grid)
    assert message.startswith("mass__wasting_id is 65535") and f"at {ids.size - void.size} nodes" in message
    follow(message, grid)
    assert not np.any(ids)  # the rest was taken


def test_deep_soil_is_soil():
    """Some say "inexhaustible" with a large number."""
    grid, _ = slope_at(0.0, soil=9999.0)
    DebrisFlow(grid, erosion="none", numerics=COARSE).run_one_step(0.1)


@pytest.mark.slow
def test_a_grid_closed_everywhere_has_no_ground_to_refuse():
    grid = RasterModelGrid((5, 5), xy_spacing=5.0)
    grid.add_full(Z, -9999.0, at="node")
    grid.status_at_node[:] = grid.BC_NODE_IS_CLOSED
    DebrisFlow(grid).run_one_step(1.0)


def test_the_remedy_in_a_scene_file_is_told():
    z = np.full((20, 30), 400.0)
    z[8:12, 10:14] = 0.0
    grid = RasterModelGrid(z.shape, xy_spacing=5.0)
    grid.add_field("topographic__elevation", z.ravel(), at="node")
    assert "; in a scene file terrain: nodata: 0; or" in refusal(grid)
