"""Exposure of buildings and roads, by hand and on a flow that runs against a building."""

import geopandas
import numpy as np
import pandas as pd
import pytest
import shapely
import xarray as xr

from landlab_debrisflow import DebrisFlow, InputError
from landlab_debrisflow.geo.exposure import exposure, write_exposure
from landlab_debrisflow.record import write_maps
from validation.grids import inclined, release_slab

NAMES = "max_depth", "max_speed", "max_impact_pressure", "max_run_up", "deposit_depth", "arrival_time"


def by_hand(closed=()):
    """Maps over 4 x 5 cells of 10 m whose depth is 0.1 m times the number of the node."""
    number = np.arange(20.0).reshape(4, 5)
    values = {
        "max_depth": 0.1,
        "max_speed": 1.0,
        "max_impact_pressure": 1000.0,
        "max_run_up": 0.2,
        "deposit_depth": 0.05,
    }
    maps = {f"debris_flow__{name}": factor * number for name, factor in values.items()}
    maps["debris_flow__arrival_time"] = np.where(number > 0.0, 100.0 - number, -1.0)
    maps["topographic__elevation"] = np.zeros((4, 5))
    for row, column in closed:
        for name, array in maps.items():
            if name.removeprefix("debris_flow__") not in ("max_impact_pressure", "max_run_up"):
                array[row, column] = np.nan
    axes = {"y": 7000.0 + 10.0 * np.arange(4), "x": 5000.0 + 10.0 * np.arange(5)}
    return xr.Dataset({name: (("y", "x"), array) for name, array in maps.items()}, axes)


def shapes(*geometries, **columns):
    return geopandas.GeoDataFrame(columns, geometry=list(geometries))


def box(x, y, width, height):
    return shapely.box(5000.0 + x, 7000.0 + y, 5000.0 + x + width, 7000.0 + y + height)


def test_by_hand():
    # cell 7 is x 15 to 25, y 5 to 15; cell 8 begins at x = 25
    table = exposure(by_hand(), shapes(box(18, 8, 2, 2), box(20, 6, 10, 4), box(-4, -4, 2, 2), box(500, 0, 5, 5)))
    small, two, dry, away = table.to_dict("records")
    assert table.id.tolist() == [1, 2, 3, 4]
    assert small["max_depth_m"] == small["mean_max_depth_m"] == pytest.approx(0.7) and small["cells"] == 1
    assert small["max_impact_pressure_kPa"] == pytest.approx(7.0) and small["first_arrival_s"] == 93.0
    assert two["max_depth_m"] == pytest.approx(0.8) and two["mean_max_depth_m"] == pytest.approx(0.75)
    assert two["first_arrival_s"] == 92.0 and two["reached"] and two["on_grid"] == pytest.approx(1.0)
    assert two["max_deposit_depth_m"] == pytest.approx(0.4) and two["mean_deposit_depth_m"] == pytest.approx(0.375)
    for nothing in (dry, away):
        assert not nothing["reached"] and nothing["max_depth_m"] == 0.0 and np.isnan(nothing["first_arrival_s"])
    assert away["on_grid"] == 0.0 and away["cells"] == 0


def test_lines_points_and_shapes_on_sides():
    road = shapely.LineString([(5012.0, 7010.0), (5028.0, 7010.0)])  # 3 m in cell 6, 10 in 7, 3 in 8
    side = shapely.LineString([(5015.0, 7006.0), (5015.0, 7014.0)])  # along the side between cells 6 and 7
    well = shapely.Point(5031.0, 7012.0)
    table = exposure(by_hand(), shapes(road, side, well, name=["road", "side", "well"]), identifier="name")
    assert table.id.tolist() == ["road", "side", "well"]
    assert table.mean_max_depth_m.tolist() == pytest.approx([(3 * 0.6 + 10 * 0.7 + 3 * 0.8) / 16, 0.65, 0.8])
    assert table.max_depth_m.tolist() == pytest.approx([0.8, 0.7, 0.8])


def test_a_closed_building_has_the_values_at_its_faces():
    maps = by_hand(closed=[(1, 2)])  # cell 7; its neighbours are 2, 6, 8 and 12
    table = exposure(maps, shapes(box(18, 8, 2, 2), box(12, 8, 8, 2)))
    alone, wider = table.to_dict("records")
    assert alone["max_depth_m"] == pytest.approx(1.2) and alone["mean_max_depth_m"] == pytest.approx(0.7)
    assert alone["max_impact_pressure_kPa"] == pytest.approx(7.0) and alone["first_arrival_s"] == 88.0
    assert wider["max_depth_m"] == pytest.approx(1.2) and wider["mean_max_depth_m"] == pytest.approx(0.6)
    assert wider["mean_max_impact_pressure_kPa"] == pytest.approx((3 * 6.0 + 5 * 7.0) / 8)


def test_thin_peaks_do_not_count():
    table = exposure(by_hand(), shapes(box(18, 8, 2, 2)), least_depth=0.71)
    assert not table.reached[0] and table.max_speed_m_s[0] == 0.0 and np.isnan(table.first_arrival_s[0])


def test_shapes_of_another_system_are_brought_into_that_of_the_maps(tmp_path):
    maps = by_hand().assign_coords(x=500000.0 + 10.0 * np.arange(5), y=4100000.0 + 10.0 * np.arange(4))
    path = write_maps(tmp_path / "maps.nc", maps, crs="EPSG:32633")
    geographic = geopandas.GeoDataFrame(
        geometry=[shapely.box(500018.0, 4100008.0, 500020.0, 4100010.0)], crs="EPSG:32633"
    ).to_crs("EPSG:4326")
    geographic.to_file(tmp_path / "houses.gpkg")
    with xr.open_dataset(path) as stored:
        table = exposure(stored, tmp_path / "houses.gpkg")
    assert table.max_depth_m[0] == pytest.approx(0.7) and table.crs.to_epsg() == 32633
    back = geopandas.read_file(write_exposure(tmp_path / "table.gpkg", table))
    assert back.crs.to_epsg() == 32633 and back.drop(columns="geometry").equals(table.drop(columns="geometry"))
    sheet = pd.read_csv(write_exposure(tmp_path / "table.csv", table))
    assert sheet.max_depth_m[0] == pytest.approx(0.7) and "geometry" not in sheet
    assert sorted(path.name for path in tmp_path.iterdir()) == ["houses.gpkg", "maps.nc", "table.csv", "table.gpkg"]


def test_without_a_system_a_table_is_written_alike(tmp_path):
    table = exposure(by_hand(), shapes(box(18, 8, 2, 2)))
    assert geopandas.read_file(write_exposure(tmp_path / "table.gpkg", table)).max_depth_m[0] == pytest.approx(0.7)
    assert exposure(by_hand(), shapes(box(18, 8, 2, 2)), crs="EPSG:32633").crs.to_epsg() == 32633


@pytest.mark.slow
def test_a_building_in_the_way_of_a_flow():
    grid = inclined((20, 60), 5.0, 0.5, soil=1.0, foot=150.0)
    house = shapely.box(85.0, 40.0, 97.0, 56.0)
    x, y = grid.x_of_node, grid.y_of_node
    grid.status_at_node[(x > 85.0) & (x < 97.0) & (y > 40.0) & (y < 56.0)] = grid.BC_NODE_IS_CLOSED
    release_slab(grid, (30.0, 48.0), 8.0, 1.0)
    flow = DebrisFlow(grid, numerics={"particle_count": 60})
    flow.run_until_rest()
    row = exposure(flow.maps, shapes(house)).iloc[0]
    assert row.reached and 0.05 < row.max_depth_m <= float(flow.maps.debris_flow__max_depth.max())
    assert row.max_impact_pressure_kPa > 1.0 and 2.0 < row.first_arrival_s < flow.elapsed_time


@pytest.mark.parametrize(
    "given, words",
    [
        ("nowhere.gpkg", "cannot read nowhere.gpkg: there is no such file"),
        (pd.DataFrame({"a": [1]}), "got a table without geometry"),
        (shapes(), "there are no shapes"),
        (shapes(box(0, 0, 1, 1), None), "shape 2 of 2 cannot be used: empty"),
        (shapes(shapely.Polygon([(0, 0), (1, 1), (1, 0), (0, 1)])), "cannot be used: Self-intersection"),
        (shapes(box(900, 900, 5, 5)), "none of the 1 shapes touches the grid, which goes from"),
    ],
)
def test_refusals(given, words):
    with pytest.raises(InputError, match=words):
        exposure(by_hand(), given)


def test_refused_identifiers_and_maps():
    two = shapes(box(0, 0, 1, 1), box(5, 5, 1, 1), number=[4, 4])
    with pytest.raises(InputError, match="number 4 is there twice"):
        exposure(by_hand(), two, identifier="number")
    with pytest.raises(InputError, match=r"no attribute 'nmber' \(did you mean 'number'\?\)"):
        exposure(by_hand(), two, identifier="nmber")
    with pytest.raises(InputError, match="the maps lack debris_flow__max_run_up"):
        exposure(by_hand().drop_vars("debris_flow__max_run_up"), two)


def test_an_unreadable_file_is_told_of(tmp_path):
    (tmp_path / "houses.gpkg").write_bytes(b"no shapes")
    with pytest.raises(InputError, match=r"cannot read .*houses.gpkg"):
        exposure(by_hand(), tmp_path / "houses.gpkg")
