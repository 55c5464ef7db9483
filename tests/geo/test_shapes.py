"""Shapes of every form come in as valid geometry in the coordinates of the DEM, or are refused with a remedy."""

import json
import warnings

import geopandas
import numpy as np
import pytest
import shapely
from shapely import LineString, MultiPolygon, Point, Polygon, box

from landlab_debrisflow.core.errors import InputError
from landlab_debrisflow.geo.references import wkt_of
from landlab_debrisflow.geo.shapes import read_shapes

from .files import NORTH, UTM, WEST

BOUNDS = (WEST, NORTH - 60.0, WEST + 80.0, NORTH)
SQUARE = box(WEST + 10.0, NORTH - 40.0, WEST + 30.0, NORTH - 20.0)


def write(path, *geometries, crs=UTM, **columns):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # where there is no reference system
        geopandas.GeoDataFrame(columns, geometry=list(geometries), crs=crs).to_file(path, engine="pyogrio")
    return path


@pytest.mark.parametrize("name", ["a.gpkg", "a.geojson", "a.shp"])
def test_a_file_of_any_form(tmp_path, name):
    (shape,) = read_shapes(write(tmp_path / name, SQUARE, depth=[2.5]), wkt_of(UTM), bounds=BOUNDS)
    assert shape.geometry.equals_exact(SQUARE, 1e-6, normalize=True)
    assert shape.attributes == {"depth": 2.5} and shape.number("Depth") == 2.5


@pytest.mark.parametrize("name", ["a.gpkg", "a.geojson", "a.shp"])
def test_another_reference_system(tmp_path, name):
    moved = geopandas.GeoSeries([SQUARE], crs=UTM).to_crs("EPSG:4326")[0]
    (shape,) = read_shapes(write(tmp_path / name, moved, crs="EPSG:4326", k=[1]), wkt_of(UTM), bounds=BOUNDS)
    # 15 digits of degrees
    assert shapely.hausdorff_distance(shape.geometry, SQUARE) < 1e-6


def test_a_file_without_a_reference_system(tmp_path):
    notes = []
    write(tmp_path / "a.shp", SQUARE, crs=None, k=[1])
    assert read_shapes(tmp_path / "a.shp", wkt_of(UTM), notes=notes)[0].geometry.equals(SQUARE)
    assert "that of the DEM is taken" in notes[0]


def test_a_dem_without_a_reference_system(tmp_path):
    notes = []
    path = write(tmp_path / "a.gpkg", SQUARE)
    assert read_shapes(path, None, bounds=BOUNDS, notes=notes)[0].geometry.equals(SQUARE)
    assert "coordinates are taken as they are" in notes[0]
    with pytest.raises(InputError, match="give terrain: crs"):
        read_shapes(path, None, bounds=(0.0, 0.0, 100.0, 100.0))


def test_layers_are_chosen(tmp_path):
    path = tmp_path / "a.gpkg"
    for layer, shift in (("houses", 0.0), ("roads", 5.0)):
        frame = geopandas.GeoDataFrame(geometry=[shapely.affinity.translate(SQUARE, shift)], crs=UTM)
        frame.to_file(path, layer=layer, engine="pyogrio")
    with pytest.raises(InputError, match=r"several layers: houses, roads; choose one, such as a.gpkg:houses"):
        read_shapes(path)
    assert read_shapes(f"{path}:roads")[0].geometry.bounds[0] == WEST + 15.0
    with pytest.raises(InputError, match=r"no layer 'road' \(did you mean 'roads'\?\)"):
        read_shapes(f"{path}:road")


def test_tables(tmp_path):
    (tmp_path / "points.csv").write_text("name,X,y\nbridge,400010,5149970\nfan,400020,5149960\n")
    points = read_shapes(tmp_path / "points.csv", kind="point")
    assert [(p.geometry.x, p.geometry.y, p.attributes["name"]) for p in points] == [
        (400010.0, 5149970.0, "bridge"), (400020.0, 5149960.0, "fan"),
    ]  # fmt: skip
    (tmp_path / "areas.csv").write_text(f"depth;wkt\n1.5;{SQUARE.wkt}\n")
    (area,) = read_shapes(tmp_path / "areas.csv")
    assert area.geometry.equals(SQUARE) and area.number("depth") == 1.5
    (tmp_path / "none.csv").write_text("east,north\n1,2\n")
    with pytest.raises(InputError, match="points need the columns x and y"):
        read_shapes(tmp_path / "none.csv", kind="point")


def test_coordinates_instead_of_a_file():
    ring = ((0.0, 0.0), (10.0, 0.0), (10.0, 10.0))
    (shape,) = read_shapes((ring,))
    assert shape.geometry.area == 50.0 and shape.attributes == {}
    assert len(read_shapes((ring[:2], ring[1:]), kind="line")) == 2
    assert read_shapes(((3.0, 4.0),), kind="point")[0].geometry == Point(3.0, 4.0)
    with pytest.raises(InputError, match="make no polygon"):
        read_shapes((((0.0, 0.0), (1.0, 1.0)),))


def test_heights_are_dropped_holes_and_pieces_stay(tmp_path):
    ring = SQUARE.difference(box(WEST + 15.0, NORTH - 35.0, WEST + 20.0, NORTH - 30.0))
    pieces = MultiPolygon([shapely.force_3d(ring, 900.0), box(WEST + 50.0, NORTH - 20.0, WEST + 60.0, NORTH - 10.0)])
    (shape,) = read_shapes(write(tmp_path / "a.gpkg", pieces))
    assert not shape.geometry.has_z and shape.geometry.area == 400.0 - 25.0 + 100.0


def scaled(*points):
    return Polygon([(WEST + 10.0 + x, NORTH - 50.0 + y) for x, y in points])


BOW_TIE = scaled((0, 0), (20, 20), (20, 0), (0, 20))
SPIKE = scaled((0, 0), (20, 0), (20, 20), (10, 20), (10, 30), (10, 20), (0, 20))
LOOP = scaled((0, 0), (20, 0), (20, 20), (0.1, 20), (-0.1, 19.9), (-0.1, 20), (0, 19.9))


def test_a_bow_tie_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"crosses itself .*may be 0 or 200 m2"):
        read_shapes(write(tmp_path / "a.gpkg", BOW_TIE))


@pytest.mark.parametrize("outline", [SPIKE, LOOP])
def test_a_small_crossing_is_mended_and_said(tmp_path, outline):
    notes = []
    (shape,) = read_shapes(write(tmp_path / "a.gpkg", outline), wkt_of(UTM), notes=notes)
    assert shape.geometry.is_valid and shape.geometry.area == pytest.approx(400.0, rel=1e-3)
    assert "was mended" in notes[0]


def test_shapes_partly_outside_and_overlapping_are_said(tmp_path):
    notes = []
    half = box(WEST - 10.0, NORTH - 40.0, WEST + 10.0, NORTH - 20.0)
    other = box(WEST + 20.0, NORTH - 30.0, WEST + 40.0, NORTH - 10.0)
    touching = box(WEST + 30.0, NORTH - 40.0, WEST + 35.0, NORTH - 30.0)
    read_shapes(write(tmp_path / "a.gpkg", SQUARE, half, other, touching), bounds=BOUNDS, crs=wkt_of(UTM), notes=notes)
    assert notes == ["a.gpkg feature 2: 50 % lie outside the DEM", "a.gpkg: features overlap: 1 and 3 (100 m2)"]


def test_a_shape_outside_is_refused_with_both_extents(tmp_path):
    with pytest.raises(InputError, match=r"wholly outside.*x 500000 to 500001 m.*the DEM x 400000 to 400080 m"):
        read_shapes(write(tmp_path / "a.gpkg", box(5e5, 5e6, 5e5 + 1, 5e6 + 1)), crs=wkt_of(UTM), bounds=BOUNDS)


def test_features_outside_are_left_out_if_they_may_be(tmp_path):
    far, notes = box(5e5, 5e6, 5e5 + 1, 5e6 + 1), []
    path = write(tmp_path / "a.gpkg", far, SQUARE, far)
    (kept,) = read_shapes(path, wkt_of(UTM), bounds=BOUNDS, notes=notes, only_inside=True)
    assert kept.geometry.equals(SQUARE) and kept.label == "a.gpkg feature 2" and kept.feature == 2
    assert notes == ["a.gpkg: 2 of 3 features lie wholly outside the DEM and are left out"]
    with pytest.raises(InputError, match=r"feature 1 lies wholly outside.*are its coordinates in the same system"):
        read_shapes(write(tmp_path / "b.gpkg", far, far), wkt_of(UTM), bounds=BOUNDS, only_inside=True)


@pytest.mark.parametrize(
    ("geometry", "kind", "words"),
    [
        (LineString([(WEST, NORTH), (WEST + 1, NORTH)]), "polygon", "is a LineString, a polygon is needed"),
        (Point(WEST, NORTH), "polygon", "is a Point"),
        (SQUARE, "line", "is a Polygon, a line is needed"),
        (None, "polygon", "has no geometry"),
        (Polygon(), "polygon", "has no geometry"),
        (scaled((0, 0), (10, 10), (20, 20)), "polygon", "without area"),
        (shapely.MultiLineString([[(0, 0), (1, 0)], [(5, 0), (6, 0)]]), "line", "2 pieces"),
        (shapely.GeometryCollection([SQUARE, Point(WEST, NORTH)]), "polygon", "is a GeometryCollection"),
    ],
)
def test_other_geometry_is_refused(tmp_path, geometry, kind, words):
    path = write(tmp_path / "a.gpkg", geometry, SQUARE, crs=None)
    with pytest.raises(InputError, match=f"a.gpkg feature 1.*{words}"):
        read_shapes(path, kind=kind)


def test_lines_of_several_pieces_are_joined(tmp_path):
    line = shapely.MultiLineString([[(0, 0), (1, 0)], [(1, 0), (6, 0)]])
    assert read_shapes(write(tmp_path / "a.gpkg", line), kind="line")[0].geometry.length == 6.0


def truncated(path):
    whole = write(path.with_suffix(".gpkg"), *[SQUARE] * 200).read_bytes()
    path.with_suffix(".gpkg").write_bytes(whole[: len(whole) // 2])
    return path.with_suffix(".gpkg")


def without_index(path):
    write(path.with_suffix(".shp"), SQUARE, k=[1])
    path.with_suffix(".shx").unlink()
    return path.with_suffix(".shp")


def csv(content):
    def make(path):
        path.with_name("a.csv").write_bytes(content)
        return path.with_name("a.csv")

    return make


def table(path):
    path.write_text('{"type": "FeatureCollection", "features": []}')
    return path


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda path: path, "there is no such file"),
        (lambda path: path.touch() or path, "the file is empty"),
        (lambda path: path.write_text("no map") and path, "as shapes"),
        (lambda path: path.write_bytes(bytes(range(256)) * 9) and path, "as shapes"),
        (lambda path: path.write_text('{"type": "FeatureCollection", "features": [') and path, "as shapes"),
        (lambda path: path.mkdir() or path, "as shapes"),
        (table, "holds no shapes|without geometry"),
        (truncated, "as shapes"),
        (without_index, "copy a.shx beside it"),
        (lambda path: path.with_name("a.csv").write_text('x,y\n1,"\n') and path.with_name("a.csv"), "as shapes"),
        (lambda path: path.with_name("a.csv").write_text("wkt\nPOLY\n") and path.with_name("a.csv"), "as shapes"),
        (
            lambda path: path.with_name("a.csv").write_bytes(b"x,y\n\xff\xfe,1\n") and path.with_name("a.csv"),
            "as shapes",
        ),
    ],
)
def test_what_holds_no_shapes_is_refused(tmp_path, make, words):
    with pytest.raises(InputError, match=words):
        read_shapes(make(tmp_path / "a.geojson"))


def test_coordinates_that_are_not_finite(tmp_path):
    ring = [[0, 0], [1, 0], [1, 1e999], [0, 0]]
    feature = {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [ring]}}
    (tmp_path / "a.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": [feature]}))
    with pytest.raises(InputError):
        read_shapes(tmp_path / "a.geojson")


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ("deep", "must be a number .* got 'deep'"),
        ("1,5", "give the number 1.5"),
        (-1.0, r"lie in \[0, inf\] m, got -1.0"),
    ],
)
def test_attributes_that_are_no_numbers(tmp_path, value, words):
    (shape,) = read_shapes(write(tmp_path / "a.gpkg", SQUARE, depth=[value]))
    with pytest.raises(InputError, match=f"a.gpkg: depth.*{words}"):
        shape.number("depth", low=0.0)


def test_attributes_that_are_not_set(tmp_path):
    first, second = read_shapes(write(tmp_path / "a.gpkg", SQUARE, SQUARE, depth=[np.nan, 1.0], name=["a", None]))
    assert first.attributes == {"name": "a"} and second.attributes == {"depth": 1.0}
    assert first.number("depth", 7.0) == 7.0 and first.number("depth") is None
    assert "did you mean" in str(second.lacks("dept"))


def test_numbers_that_are_text(tmp_path):
    (shape,) = read_shapes(write(tmp_path / "a.gpkg", SQUARE, depth=["1.5"]))
    assert shape.number("depth") == 1.5


def test_coordinates_beyond_the_earth_are_refused():
    line = [[0.0, 0.0], [-9.2e18, 10.0]]
    with pytest.raises(InputError, match=r"the line has coordinates beyond 1e\+08 m"):
        read_shapes([line], kind="line")
