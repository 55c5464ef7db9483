"""Probabilities of shapes, against members counted by hand."""

import geopandas
import numpy as np
import pytest
import shapely

from landlab_debrisflow import InputError, Scene
from landlab_debrisflow.ensemble import Ensemble
from landlab_debrisflow.geo.exposure import exposure
from landlab_debrisflow.hazard import SWISS, exposure_probabilities
from landlab_debrisflow.scene.gully import LATTICE

from ..ensemble.scenes import SCENE, VARY, square
from .fakes import fake_results

WEST, SOUTH = LATTICE.lower_left
MAPS = "max_depth", "max_speed", "arrival_time", "max_impact_pressure"


def box(column, row, columns=1, rows=1):
    """Return cells of the gully as a polygon, well within their edges."""
    dx, dy = LATTICE.spacing
    west, south = WEST + dx * (column - 0.5), SOUTH + dy * (row - 0.5)
    return shapely.box(west + 0.1, south + 0.1, west + dx * columns - 0.1, south + dy * rows - 0.1)


def member(values):
    """Return maps over the gully that are 0 except for (row, column): depth, speed, arrival, impact."""
    maps = {name: np.full(LATTICE.shape, np.nan if name == "arrival_time" else 0.0) for name in MAPS}
    for node, numbers in values.items():
        for name, number in zip(MAPS, numbers, strict=True):
            maps[name][node] = number
    return maps


@pytest.fixture(scope="module")
def results():
    drawn = [
        member({(10, 20): (1.5, 0.5, 8.0, 1e3), (10, 21): (0.5, 4.0, 6.0, 5e4)}),  # deep and fast, not at one node
        member({(10, 21): (2.0, 3.0, 12.0, 2e4)}),
        member({(40, 5): (1.0, 1.0, 3.0, 0.0)}),
        member({(10, 20): (0.01, 9.0, 2.0, 1e6)}),
    ]
    return fake_results(drawn, maps=MAPS, lattice=LATTICE, scene=SCENE)


@pytest.fixture(scope="module")
def houses():
    shapes = [box(20, 10, 2), box(5, 40), box(100, 50)]
    return geopandas.GeoDataFrame({"name": ["A", "B", "C"]}, geometry=shapes, crs=LATTICE.crs)


def test_the_largest_value_of_a_member_in_a_shape_counts(results, houses):
    asked = {"max_depth": [1.0], "max_impact_pressure": [3e4]}
    table = exposure_probabilities(results, houses, asked, identifier="name", scale=SWISS)
    assert table["id"].tolist() == ["A", "B", "C"] and table["cells"].tolist() == [2, 1, 1]
    assert table["p_reached"].tolist() == [0.5, 0.25, 0.0]
    assert table["p_max_depth_above_1_m"].tolist() == [0.5, 0.0, 0.0]  # 1.0 does not exceed 1.0
    assert table["p_max_impact_pressure_above_30_kPa"].tolist() == [0.25, 0.0, 0.0]
    assert table["p_class_medium"].tolist() == [0.5, 0.25, 0.0]
    assert table["p_class_strong"].tolist() == [0.25, 0.0, 0.0]
    assert table["earliest_arrival_s"].tolist()[:2] == [6.0, 3.0] and np.isnan(table["earliest_arrival_s"][2])
    assert table["median_arrival_s"][0] == pytest.approx(6.0, rel=0.05)
    assert (table["p_reached_low"] <= table["p_reached"]).all() and table["p_reached_high"][2] > 0.4


def test_a_wall_has_its_pressure_and_the_depth_beside_it(houses):
    """Node (10, 20) is a building without ground."""
    scene = Scene.from_mapping(SCENE)
    scene.terrain.topographic__elevation[10, 20] = np.nan
    drawn = [member({(10, 20): (0.0, 0.0, np.nan, 5e4), (10, 21): (0.7, 3.0, 9.0, 0.0)})] * 2
    results = fake_results(drawn, maps=MAPS, lattice=LATTICE, scene=SCENE)
    wall = geopandas.GeoDataFrame(geometry=[box(20, 10)], crs=LATTICE.crs)
    table = exposure_probabilities(
        results, wall, {"max_depth": [0.5], "max_impact_pressure": [3e4]}, scene=scene
    ).iloc[0]  # fmt: skip
    assert table["p_reached"] == 1.0 and table["p_max_depth_above_0.5_m"] == 1.0
    assert table["p_max_impact_pressure_above_30_kPa"] == 1.0 and table["earliest_arrival_s"] == 9.0


def test_each_member_has_the_table_of_its_own_run():
    """Shares of members are those of the tables that single runs write."""
    scene = SCENE | {"output": SCENE["output"] | {"exposure": square(40.0, 130.0, 12.0)}}
    ensemble = Ensemble(scene, VARY, 3, "random", seed=2)
    results = ensemble.run(workers=1)
    table = exposure_probabilities(results, thresholds={"max_speed": [6.0], "max_depth": [0.3]}, scene=ensemble.scene)
    shapes = geopandas.GeoDataFrame(
        geometry=[one.geometry for one in ensemble.scene.places.exposure.values()], crs=LATTICE.crs
    )
    singles = []
    for one in results.members():
        flow = ensemble.scene.flow()  # a Dataset with all maps, of which the kept ones are replaced
        maps = flow.maps.copy(deep=True)
        for name in results.maps:
            values = one.on_lattice(name, LATTICE.shape).astype(float)
            maps[f"debris_flow__{name}"].values[:] = np.nan_to_num(values, nan=-1.0)
        singles.append(exposure(maps, shapes, crs=LATTICE.crs).iloc[0])
    assert table["p_reached"][0] == np.mean([one["reached"] for one in singles])
    assert table["p_max_speed_above_6_m_s"][0] == np.mean([one["max_speed_m_s"] > 6.0 for one in singles])
    assert table["p_max_depth_above_0.3_m"][0] == np.mean([one["max_depth_m"] > 0.3 for one in singles])
    assert table["earliest_arrival_s"][0] == min(one["first_arrival_s"] for one in singles)


def test_shapes_that_cannot_be_used_are_refused(results, houses):
    with pytest.raises(InputError, match="none of the 3 shapes touches the grid"):
        exposure_probabilities(results, houses.translate(1e5).to_frame("geometry"))
    with pytest.raises(InputError, match="no exposed polygons"):
        exposure_probabilities(results)
    with pytest.raises(InputError, match="did you mean 'name'"):
        exposure_probabilities(results, houses, identifier="names")
