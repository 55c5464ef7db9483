"""Releases of a scene: volumes kept, places and attributes checked, fields set on a grid."""

import geopandas
import numpy as np
import pytest
import rasterio
import shapely
from landlab import RasterModelGrid
from numpy.testing import assert_allclose

from landlab_debrisflow import Scene
from landlab_debrisflow.core.errors import InputError, ParameterError
from landlab_debrisflow.scene.gully import LATTICE
from landlab_debrisflow.scene.releases import ScheduledRelease, set_release

WEST, SOUTH = LATTICE.lower_left
AREA = LATTICE.area


def box(x, y, width=30.0, height=25.0):
    """Return an outline, its corner east and north of the first node [m]."""
    x, y = WEST + x, SOUTH + y
    return [[x, y], [x + width, y], [x + width, y + height], [x, y + height]]


HEAD = box(20.0, 145.0)


def scene(*releases, folder=".", **keys):
    return Scene.from_mapping({"terrain": {"example": "gully"}, "release": list(releases)} | keys, folder)


def only(*releases, folder="."):
    (release,) = scene(*releases, folder=folder).releases
    return release


def vector(folder, outlines, crs=LATTICE.crs, file="release.gpkg", **attributes):
    frame = geopandas.GeoDataFrame(attributes, geometry=[shapely.Polygon(one) for one in outlines], crs=LATTICE.crs)
    frame.to_crs(crs).to_file(folder / file)
    return file


@pytest.mark.parametrize("surface", ["tapered", "sloping_local_base_level", "ellipsoid", "uniform"])
def test_the_volume_is_kept_whatever_the_surface(surface):
    shape = {"polygons": HEAD, "failure_surface": surface}
    assert_allclose(only(shape | {"volume": 900.0}).depth.sum() * AREA, 900.0, rtol=1e-12)
    assert_allclose(only(shape | {"depth": 1.2}).depth.sum() * AREA, 1.2 * 750.0, rtol=1e-9)


def test_the_default_surface_can_empty_and_above_is_laid_as_it_is():
    ground, above = only({"polygons": HEAD, "depth": 1.5}), only({"polygons": HEAD, "depth": 1.5, "from": "above"})
    assert ground.source == "ground" and ground.depth.max() > 1.6  # the rim tapers
    assert above.source == "above" and close(above.depth.max(), 1.5)


def close(value, wanted):
    return abs(value - wanted) < 1e-9 * wanted


def test_attributes_come_before_keys(tmp_path):
    name = vector(tmp_path, [HEAD, box(80.0, 145.0)], Depth=[2.0, np.nan])
    release = only({"polygons": name, "depth": 1.0}, folder=tmp_path)
    left = LATTICE.x < WEST + 65.0
    assert_allclose(release.depth[:, left].sum() * AREA, 2.0 * 750.0, rtol=1e-9)
    assert_allclose(release.depth[:, ~left].sum() * AREA, 1.0 * 750.0, rtol=1e-9)


def test_polygons_of_another_reference_system_come_to_the_same_place(tmp_path):
    here = only({"polygons": HEAD, "volume": 900.0})
    there = only({"polygons": vector(tmp_path, [HEAD], "EPSG:4326", "a.geojson", volume=[900.0])}, folder=tmp_path)
    assert_allclose(there.depth, here.depth, atol=0.02)


@pytest.mark.parametrize(
    ("attributes", "words"),
    [
        ({"name": ["a"]}, "neither an attribute depth .*attributes are name"),
        ({"depht": [1.0]}, r"attributes are depht \(did you mean 'depth'\?\)"),
        ({"depth": [1.0], "volume": [2.0]}, "both a depth and a volume"),
        ({"depth": [0.0]}, "more than 0, got 0"),
        ({"volume": [-5.0]}, "more than 0, got -5"),
        ({"depth": ["deep"]}, "a number, got 'deep'"),
        ({"depth": ["1,5"]}, "a number, got '1,5'; write it with a decimal point"),
        ({"depth": [None]}, "neither an attribute depth .*it has no attribute with a value"),
        ({"depth": [1500.0]}, "at most 1000 m, got 1500"),
    ],
)
def test_attributes_that_are_refused(tmp_path, attributes, words):
    name = vector(tmp_path, [HEAD], file="a.geojson", **attributes)
    with pytest.raises(InputError, match=words):
        only({"polygons": name}, folder=tmp_path)


def test_what_no_scar_can_hold_is_refused_with_the_remedy():
    with pytest.raises(InputError, match=r"release\[0\]: .* no body of more than .* from: above"):
        only({"polygons": HEAD, "depth": 40.0})
    assert close(only({"polygons": HEAD, "depth": 40.0, "from": "above"}).depth.max(), 40.0)


def test_what_lies_on_the_edge_is_left_out_and_said():
    outline = box(-2.5, 145.0)
    kept = only({"polygons": outline, "volume": 900.0, "failure_surface": "uniform"})
    cut = only({"polygons": outline, "depth": 1.2, "failure_surface": "uniform"})
    assert_allclose(kept.depth.sum() * AREA, 900.0, rtol=1e-12)
    assert_allclose(cut.depth.sum() * AREA, 1.2 * 25.0 * 25.0, rtol=1e-9)  # the column of 5 m on the edge is no core
    assert not cut.depth[:, 0].any() and any("16.7 % of it lie" in note for note in cut.notes)
    with pytest.raises(InputError, match="covers no node of the terrain that may hold mass"):
        only({"polygons": box(-2.0, 100.0, 4.0), "depth": 1.0})


def test_doubts():
    assert any("covers 4 nodes" in note for note in only({"polygons": box(28.0, 148.0, 7, 7), "depth": 0.5}).notes)
    deep = only({"polygons": HEAD, "depth": 3.0}).notes
    assert any("deeper than the soil at" in note for note in deep)
    level = {"polygons": HEAD, "depth": 1.0, "failure_surface": "uniform"}
    same = Scene.from_mapping({"terrain": {"example": "gully", "soil_depth": 0.9999}, "release": level}).notes
    assert not any("deeper than the soil" in note for note in same)
    assert any("up to 150 m deep" in note for note in only({"polygons": HEAD, "depth": 150.0, "from": "above"}).notes)
    assert scene(friction="voellmy").notes == ["nothing is released and nothing flows in; give release or inflow"]


def raster(folder, values, name="depth.tif"):
    west, south, east, north = LATTICE.bounds
    place = rasterio.transform.from_bounds(west, south, east, north, *values.shape[::-1])
    profile = {"driver": "GTiff", "height": values.shape[0], "width": values.shape[1], "count": 1, "dtype": "float32"}
    with rasterio.open(folder / name, "w", crs=LATTICE.crs, transform=place, nodata=-9999.0, **profile) as file:
        file.write(values[::-1].astype("float32"), 1)
    return name


def test_rasters(tmp_path):
    depth = np.zeros(LATTICE.shape)
    depth[28:33, 5:10] = 1.25
    depth[40, 0] = 3.0
    release = only({"raster": raster(tmp_path, np.where(depth > 0, depth, -9999.0))}, folder=tmp_path)
    depth[40, 0] = 0.0
    assert np.array_equal(release.depth, depth) and any("75 m3 on the edge" in note for note in release.notes)
    losses = only({"raster": raster(tmp_path, -depth)}, folder=tmp_path)
    assert np.array_equal(losses.depth, depth) and any("losses of elevation, up to 1.25 m" in x for x in losses.notes)
    mask = only({"raster": raster(tmp_path, 1.0 * (depth > 0.0))}, folder=tmp_path)
    assert any("every depth is exactly 1 m" in note for note in mask.notes)
    assert not any("exactly 1 m" in note for note in release.notes)
    both = depth - 0.5 * (depth[:, ::-1] > 0.0)
    refused = (both, "got -0.5 to 1.25 m; cut out"), (0.0 * depth, "no depth > 0"), (1e3 * depth, "at most")
    for values, words in refused:
        with pytest.raises(InputError, match=words):
            only({"raster": raster(tmp_path, values)}, folder=tmp_path)


def test_releases_come_in_the_order_of_their_times():
    late, early = {"polygons": HEAD, "depth": 1.0, "time": 30}, {"polygons": box(80.0, 145.0), "depth": 1.0, "time": 5}
    assert [release.time for release in scene(late, early).releases] == [5.0, 30.0]


def test_a_speed_goes_down_the_slope_along_the_bed():
    still, moving = only({"polygons": HEAD, "depth": 1.0}), only({"polygons": HEAD, "depth": 1.0, "speed": 10.0})
    assert still.velocity is None
    inside = moving.depth > 0.0
    vx, vy = moving.velocity[:, inside]
    assert not moving.velocity[:, ~inside].any() and np.ptp(vx) < 1e-12 < vx.min() and abs(vy).max() < vx.min()
    slope = np.hypot(vx[0], vy[0]) / 10.0  # cosine of the slope
    assert np.cos(np.radians(40.0)) < slope < np.cos(np.radians(25.0))
    given = only({"polygons": HEAD, "depth": 1.0, "velocity": [3.0, -1.0]})
    assert_allclose(given.velocity[:, inside].T, np.tile([3.0, -1.0], (inside.sum(), 1)), rtol=1e-12)


def plane(soil=0.5):
    grid = RasterModelGrid((6, 7), xy_spacing=2.0)
    grid.add_field("topographic__elevation", 10.0 - grid.x_of_node, at="node")
    if soil is not None:
        grid.add_full("soil__depth", soil, at="node")
    return grid


@pytest.mark.parametrize("soil", [0.5, None])
@pytest.mark.parametrize("source", ["ground", "above"])
def test_fields_of_a_grid(source, soil):
    grid, depth = plane(soil), np.zeros((6, 7))
    depth[2, 3] = 1.5
    velocity = np.stack([2.0 * (depth > 0.0), 0.0 * depth])
    before = grid.at_node["topographic__elevation"].copy()
    for _ in range(2):  # the second one joins the first
        set_release(grid, ScheduledRelease(0.0, depth, source, velocity))
    node, raised = 2 * 7 + 3, 3.0 if source == "above" else 0.0
    assert grid.at_node["debris_flow__release_depth"][node] == 3.0
    assert grid.at_node["debris_flow__release_velocity_x"][node] == 2.0
    assert grid.at_node["topographic__elevation"][node] - before[node] == raised
    if soil is not None:
        assert grid.at_node["soil__depth"][node] == (3.5 if source == "above" else 3.0)
    assert np.count_nonzero(grid.at_node["topographic__elevation"] - before) == (source == "above")


def test_points_become_inflow_down_the_slope(tmp_path):
    (tmp_path / "surge.csv").write_text("t,Q\n0,0\n60,20\n300,0\n")
    point = [WEST + 200.0, SOUTH + 150.0]
    found = scene(
        {"points": point, "hydrograph": "surge.csv", "width": 10.0, "speed": 3.0, "time": 5.0}, folder=tmp_path,
        inflow={"line_start": [WEST + 20, SOUTH + 100], "line_end": [WEST + 20, SOUTH + 130], "times": [0, 9],
                "discharge": 1.0, "velocity": 1.0},
    )  # fmt: skip
    _, surge = found.setup.inflow
    assert surge.times == (5.0, 65.0, 305.0) and surge.discharge == (0.0, 20.0, 0.0) and surge.velocity == (3.0,)
    assert_allclose(np.add(surge.line_start, surge.line_end) / 2.0, point)
    assert_allclose(surge.length, 10.0)
    assert abs(surge.direction) < 45.0 and found.releases == []  # the gully falls to the east
    for place, words in (([WEST + 1.0, SOUTH + 150.0], "edge of the terrain"), ([0.0, 0.0], "outside")):
        with pytest.raises(InputError, match=words):
            _ = scene({"points": place, "hydrograph": [[0, 1], [9, 1]], "width": 10.0, "speed": 3.0}).setup


def test_a_release_at_rest_slows_a_moving_one_on_its_nodes():
    grid, depth = plane(), np.zeros((6, 7))
    depth[2, 3] = 0.2
    set_release(grid, ScheduledRelease(0.0, depth, "ground", np.stack([2.0 * (depth > 0.0), 0.0 * depth])))
    set_release(grid, ScheduledRelease(0.0, 3.0 * depth, "ground", None))
    assert grid.at_node["debris_flow__release_velocity_x"][2 * 7 + 3] == pytest.approx(0.5, rel=1e-12)


@pytest.mark.parametrize("surface", ["tapered", "ellipsoid", "uniform"])
def test_the_largest_depth_is_met(surface):
    found = only({"polygons": HEAD, "largest_depth": 1.5, "failure_surface": surface})
    assert found.depth.max() == pytest.approx(1.5, rel=1e-12)
    with pytest.raises(ParameterError, match="give depth or largest_depth, not both"):
        scene({"polygons": HEAD, "depth": 1.0, "largest_depth": 1.5})
