"""Scenes: from a file or a mapping to a grid and a flow; digest, plain values, pickles."""

import json
import pickle

import numpy as np
import pytest
import yaml

from landlab_debrisflow import Scene, Setup
from landlab_debrisflow.core.errors import InputError
from landlab_debrisflow.scene.gully import LATTICE

WEST, SOUTH = LATTICE.lower_left
HEAD = [[WEST + x, SOUTH + y] for x, y in ((20, 145), (50, 145), (50, 170), (20, 170))]
MAPPING = {
    "terrain": {"example": "gully"},
    "release": {"polygons": HEAD, "depth": 1.5},
    "friction": {"law": "voellmy", "cohesion": 100.0},
    "numerics": {"particle_count": 100},
}


def written(folder, mapping=MAPPING, name="gully.yaml"):
    path = folder / name
    path.write_text(yaml.safe_dump(mapping))
    return path


def test_from_a_file(tmp_path):
    path = written(tmp_path)
    scene = Scene.from_file(path)
    assert (scene.name, scene.folder, scene.output_directory) == ("gully", tmp_path, tmp_path / "gully_out")
    assert scene.text == path.read_text() and scene.path == path
    assert scene.setup == Setup(friction=MAPPING["friction"], numerics=MAPPING["numerics"])
    named = Scene.from_mapping(MAPPING | {"output": {"directory": "results"}}, tmp_path)
    assert named.output_directory == tmp_path / "results" and named.text is None


def test_the_grid_is_new_each_time_and_lies_where_the_terrain_does():
    scene = Scene.from_mapping(MAPPING)
    grid, other = scene.grid(), scene.grid()
    assert grid.shape == LATTICE.shape and grid.xy_of_lower_left == LATTICE.lower_left
    grid.at_node["topographic__elevation"] -= 5.0
    assert other.at_node["topographic__elevation"].min() > grid.at_node["topographic__elevation"].min()
    assert np.array_equal(other.at_node["topographic__elevation"], scene.terrain.topographic__elevation.values.ravel())


def test_a_flow_has_the_releases_of_its_beginning():
    later = {"polygons": HEAD, "depth": 0.5, "time": 20.0}
    scene = Scene.from_mapping(MAPPING | {"release": [MAPPING["release"], later]})
    flow = scene.flow()
    assert flow.setup == scene.setup
    assert abs(flow.grid.at_node["debris_flow__release_depth"].sum() * LATTICE.area - 1125.0) < 1e-9
    assert [release.time for release in scene.releases] == [0.0, 20.0]


def test_plain_values_make_the_same_scene(tmp_path):
    scene = Scene.from_file(written(tmp_path))
    again = Scene.from_mapping(json.loads(json.dumps(scene.to_mapping())), tmp_path)
    assert again.to_mapping() == scene.to_mapping() and again.digest() == scene.digest()
    assert Scene.from_file(written(tmp_path, scene.to_mapping(), "whole.yaml")).digest() == scene.digest()


def test_the_digest_is_that_of_what_results_depend_on(tmp_path):
    (tmp_path / "surge.csv").write_text("0,0\n60,20\n")
    points = {"points": [WEST + 200.0, SOUTH + 150.0], "hydrograph": "surge.csv", "width": 10, "speed": 3}
    mapping = MAPPING | {"release": [MAPPING["release"], points]}
    scenes = [Scene.from_mapping(mapping | {"output": {"max_duration": t}}, tmp_path) for t in (10, 20)]
    digest = scenes[0].digest()
    assert scenes[1].digest() == digest
    assert Scene.from_mapping(mapping | {"friction": "voellmy"}, tmp_path).digest() != digest
    (tmp_path / "surge.csv").write_text("0,0\n60,21\n")
    assert scenes[0].digest() != digest


def test_the_digest_sees_rasters_that_laws_name(tmp_path):
    mapping = MAPPING | {"friction": {"law": "voellmy", "basal_friction_angle": "angle.tif"}}
    (tmp_path / "angle.tif").write_bytes(b"one")
    digest = Scene.from_mapping(mapping, tmp_path).digest()
    (tmp_path / "angle.tif").write_bytes(b"two")
    assert Scene.from_mapping(mapping, tmp_path).digest() != digest


def test_pickles_take_the_keys_along(tmp_path):
    scene = Scene.from_file(written(tmp_path))
    assert scene.grid().number_of_nodes == LATTICE.size  # the terrain has been read
    sent = pickle.loads(pickle.dumps(scene))
    assert sent.digest() == scene.digest() and sent.text == scene.text
    assert np.array_equal(sent.releases[0].depth, scene.releases[0].depth)
    assert len(pickle.dumps(scene)) < 20_000


def test_places_of_output(tmp_path):
    output = {
        "gauges": {"bridge": [WEST + 400, SOUTH + 150]},
        "sections": {"apex": [[WEST + 330, SOUTH + 100], [WEST + 330, SOUTH + 200]]},
        "thalweg": [[WEST + 30, SOUTH + 157], [WEST + 330, SOUTH + 150], [WEST + 690, SOUTH + 150]],
        "exposure": {"house 7": [[WEST + 500, SOUTH + 140], [WEST + 512, SOUTH + 140], [WEST + 512, SOUTH + 150]]},
    }
    places = Scene.from_mapping(MAPPING | {"output": output}).places
    assert places.gauges["bridge"].tolist() == [WEST + 400, SOUTH + 150]
    assert places.sections["apex"].shape == (2, 2) and places.thalweg.shape == (3, 2)
    assert places.exposure["house 7"].geometry.area == 60.0
    nothing = Scene.from_mapping(MAPPING).places
    assert (nothing.gauges, nothing.sections, nothing.thalweg, nothing.exposure) == ({}, {}, None, {})


def test_places_from_files(tmp_path):
    import geopandas
    import shapely

    points = [shapely.Point(WEST + 400, SOUTH + 150), shapely.Point(WEST + 500, SOUTH + 150)]
    for file, names in (("named.gpkg", {"Name": ["bridge", "mill"]}), ("bare.gpkg", {"depth": [1.0, 2.0]})):
        geopandas.GeoDataFrame(names, geometry=points, crs=LATTICE.crs).to_crs(4326).to_file(tmp_path / file)
    found = {
        file: Scene.from_mapping(MAPPING | {"output": {"gauges": file}}, tmp_path).places.gauges
        for file in ("named.gpkg", "bare.gpkg")
    }
    assert list(found["named.gpkg"]) == ["bridge", "mill"] and list(found["bare.gpkg"]) == ["1", "2"]
    assert np.allclose(found["named.gpkg"]["mill"], [WEST + 500, SOUTH + 150], atol=1e-3)
    squares = [point.buffer(10.0) for point in (shapely.Point(0, 0), *points)]
    for name, shapes in (("far.gpkg", squares), ("stray.gpkg", [shapely.Point(0, 0), *points])):
        geopandas.GeoDataFrame(geometry=shapes, crs=LATTICE.crs).to_file(tmp_path / name)
    scene = Scene.from_mapping(MAPPING | {"output": {"exposure": "far.gpkg"}}, tmp_path)
    assert list(scene.places.exposure) == ["2", "3"]  # numbers of the features in the file
    assert "far.gpkg: 1 of 3 features lie wholly outside the DEM and are left out" in scene.notes
    twice = geopandas.GeoDataFrame({"id": [7, 7]}, geometry=points, crs=LATTICE.crs)
    twice.to_file(tmp_path / "twice.gpkg")
    for output, words in (
        ({"gauges": "twice.gpkg"}, "both named '7'"), ({"sections": "named.gpkg"}, "line"),
        ({"gauges": "stray.gpkg"}, "output: gauges: stray.gpkg feature 1 lies wholly outside"),
        ({"gauges": {"far": [0.0, 0.0]}}, "output: gauges: far: the point lies wholly outside"),
    ):  # fmt: skip
        with pytest.raises(InputError, match=words):
            _ = Scene.from_mapping(MAPPING | {"output": output}, tmp_path).places
