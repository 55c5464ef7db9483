"""New scenes run as they are, show the usual keys or every one with its default, and never replace a file."""

import dataclasses
import os
import re
from pathlib import Path

import pytest

from landlab_debrisflow import Hydrograph, Material, Numerics, Scene
from landlab_debrisflow.core.errors import InputError
from landlab_debrisflow.core.values import keys_of
from landlab_debrisflow.physics.registry import LAWS
from landlab_debrisflow.scene.gully import gully
from landlab_debrisflow.scene.keys import EnsembleKeys, OutputKeys, ReleaseKeys, TerrainKeys
from landlab_debrisflow.scene.new_scene import new_scene
from landlab_debrisflow.scene.read_yaml import read_yaml
from landlab_debrisflow.scene.template import USUAL, yaml_text
from tests.scene.test_scheduled_releases import HEAD, LATTICE, raster, vector


def dem(folder, name="dem.tif"):
    """Write the gully as a raster and return its path."""
    return folder / raster(folder, gully()[0], name)


def uncommented(text):
    """Return a scene in which all keys of the parts that are set are set."""
    text = re.sub(r"(?m)^# (material:|numerics:)$", r"\1", text)
    return re.sub(r"(?m)^  # (\w+: )", r"  \1", text)


def test_the_example_runs_and_shows_defaults(tmp_path):
    path = new_scene(tmp_path / "scene.yaml", full=True)
    scene = Scene.from_file(path)
    assert scene.notes == [] and scene.flow().grid.at_node["debris_flow__release_depth"].max() > 1.0
    other = tmp_path / "all.yaml"
    other.write_text(uncommented(path.read_text()))
    assert Scene.from_file(other).to_mapping() == scene.to_mapping()
    assert len(read_yaml(other).lines) > len(read_yaml(path).lines) + 60


def test_every_key_is_there_with_unit_and_meaning(tmp_path):
    text = new_scene(tmp_path / "scene.yaml", full=True).read_text()
    classes = [TerrainKeys, ReleaseKeys, OutputKeys, EnsembleKeys, Material, Numerics, Hydrograph]
    for cls in [*classes, *(law for laws in LAWS.values() for law in laws.values())]:
        for key, field in keys_of(cls).items():
            assert re.search(rf"(?m)^\W*{key}: ", text), key
            assert field.metadata["meaning"].split(",")[0][:25] in " ".join(text.replace("#", " ").split())
    assert max(map(len, text.splitlines())) <= 120


def test_laws_in_comments_are_those_of_the_declarations(tmp_path):
    blocks = re.split(r"(?m)^# or (\w+):$", new_scene(tmp_path / "scene.yaml", full=True).read_text())[1:]
    for kind, block in zip(blocks[::2], blocks[1::2], strict=True):
        lines = [line[2:] for line in block.split("\n\n")[0].splitlines() if line]
        path = tmp_path / "law.yaml"
        path.write_text("terrain: {example: gully}\n" + f"{kind}:\n" + "\n".join(lines) + "\n")
        law = getattr(Scene.from_file(path).setup, kind)
        assert law == type(law)() and dataclasses.fields(law)


def test_by_default_the_usual_keys_are_there_and_the_scene_is_the_same(tmp_path):
    short, full = new_scene(tmp_path / "short.yaml"), new_scene(tmp_path / "full.yaml", full=True)
    assert Scene.from_file(short).to_mapping() == Scene.from_file(full).to_mapping()
    example = short.read_text()
    assert "new --full" in example and "new --full" not in full.read_text()
    assert len(example.splitlines()) < 90 < 200 < len(full.read_text().splitlines())  # two screens, or a long list
    own = new_scene(tmp_path / "own.yaml", dem(tmp_path), tmp_path / vector(tmp_path, [HEAD], name=["a"])).read_text()
    for text in (example, own):
        assert max(map(len, text.splitlines())) <= 120
        for key in [*keys_of(LAWS["erosion"]["growth"]), *(key for keys in USUAL.values() for key in keys)]:
            assert re.search(rf"(?m)^(  |  # ){key}: ", text), key
        assert "or friction:" not in text and "# inflow:" not in text and "courant_number" not in text
    other = tmp_path / "all.yaml"
    other.write_text(uncommented(short.read_text()))
    assert Scene.from_file(other).to_mapping() == Scene.from_file(short).to_mapping()
    assert all(
        key in {field.name.rstrip("_") for field in dataclasses.fields(cls)} for cls in USUAL for key in USUAL[cls]
    )


def test_a_reference_system_for_a_dem_without(tmp_path):
    """The polygons of a GIS have one, a grid of text has none: without `crs` no scene could be begun."""
    values, lattice = gully()[0], LATTICE
    rows = "\n".join(" ".join(f"{value:.3f}" for value in row) for row in values[::-1])
    west, south = lattice.bounds[:2]
    (tmp_path / "dem.asc").write_text(
        f"ncols {values.shape[1]}\nnrows {values.shape[0]}\nxllcorner {west}\nyllcorner {south}\n"
        f"cellsize {lattice.spacing[0]}\nNODATA_value -9999\n{rows}\n"
    )
    drawn = tmp_path / vector(tmp_path, [HEAD], "EPSG:4326", "scar.geojson", name=["a"])
    with pytest.raises(InputError, match="--crs"):
        new_scene(tmp_path / "a.yaml", tmp_path / "dem.asc", drawn)
    path = new_scene(tmp_path / "a.yaml", tmp_path / "dem.asc", drawn, crs="EPSG:32632")
    assert "EPSG:32632" in path.read_text() and "names none" not in path.read_text()
    assert "EPSG" in "".join(Scene.from_file(path).terrain.crs_wkt.replace('"', " "))
    with pytest.raises(InputError, match=r"dem.tif is in EPSG:32632 .*crs says EPSG:32633"):
        new_scene(tmp_path / "b.yaml", dem(tmp_path), drawn, crs="EPSG:32633")
    with pytest.raises(InputError, match="crs: EPSG:32632 is for a DEM"):
        new_scene(tmp_path / "b.yaml", crs="EPSG:32632")


@pytest.mark.parametrize("schema", ["scene.schema.json"])
def test_editors_find_the_schema(tmp_path, schema):
    assert new_scene(tmp_path / "a.yaml").read_text().startswith(f"# yaml-language-server: $schema={schema}\n")


def test_with_files_of_a_user(tmp_path):
    for folder in ("data", "scenes"):
        (tmp_path / folder).mkdir()
    data = tmp_path / "data"
    ground = dem(data, "dem 5.tif")
    bare = new_scene(tmp_path / "scenes" / "bare.yaml", ground, data / vector(data, [HEAD], name=["a"]))
    text = bare.read_text()
    assert "  elevation: ../data/dem 5.tif " in text and "  polygons: ../data/release.gpkg " in text
    assert "61 x 141 nodes (rows x columns), spacing 5 x 5 m" in text and "EPSG:32632" in text and "30 cells" in text
    assert re.search(r"(?m)^  depth: 1.0 +# A GUESS, to be replaced: mean depth \[m\] of the 1 of 1 polygons", text)
    assert re.search(r"(?m)^  soil_depth: 1.0 +# A GUESS", text)
    scene = Scene.from_file(bare)
    assert abs(scene.releases[0].depth.sum() * LATTICE.area - 750.0) < 1e-6 and scene.terrain.soil__depth.max() == 1.0
    with_volume = vector(data, [HEAD], "EPSG:4326", "b.geojson", volume=[400.0])
    whole = new_scene(tmp_path / "scenes" / "whole.yaml", ground, data / with_volume)
    assert "mean depth [m] of the" not in whole.read_text()
    assert abs(Scene.from_file(whole).releases[0].depth.sum() * LATTICE.area - 400.0) < 1e-6
    depths = new_scene(tmp_path / "scenes" / "raster.yaml", ground, ground).read_text()
    assert "  raster: ../data/dem 5.tif " in depths


def test_points_get_a_hydrograph(tmp_path):
    import geopandas
    import shapely

    raster(
        tmp_path, Scene.from_mapping({"terrain": {"example": "gully"}}).terrain.topographic__elevation.values, "dem.tif"
    )
    at = [shapely.Point(LATTICE.x[40], LATTICE.y[30])]
    geopandas.GeoDataFrame({"name": ["a"]}, geometry=at, crs=LATTICE.crs).to_file(tmp_path / "points.gpkg")
    path = new_scene(tmp_path / "scene.yaml", tmp_path / "dem.tif", tmp_path / "points.gpkg")
    (surge,) = Scene.from_file(path).setup.inflow
    assert surge.volume == 0.5 * 20.0 * 300.0 and path.read_text().count("A GUESS") == 4


def test_relative_to_a_scene_in_the_working_directory(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    raster(
        Path(), Scene.from_mapping({"terrain": {"example": "gully"}}).terrain.topographic__elevation.values, "dem.tif"
    )
    assert "  elevation: dem.tif " in new_scene("scene.yaml", "dem.tif", vector(Path(), [HEAD], name=["a"])).read_text()


def test_refusals(tmp_path):
    there = tmp_path / "there.yaml"
    there.write_text("mine")
    ground = dem(tmp_path)
    for arguments, words in (
        ((there,), "is there already"), ((tmp_path / "a.txt",), "give a.yaml rather than a.txt"),
        ((tmp_path / "no" / "a.yaml",), "does not exist"), ((tmp_path / "a.yaml", ground), "the release is missing"),
        ((tmp_path / "a.yaml", None, ground), "the DEM is missing"),
        ((tmp_path / "a.yaml", tmp_path / "no.tif", ground), "no such file"),
        ((tmp_path / "a.yaml", ground, tmp_path / "no.gpkg"), "no such file"),
        ((tmp_path / "a.yaml", there, ground), "as a raster"),
    ):  # fmt: skip
        with pytest.raises(InputError, match=words):
            new_scene(*arguments)
    assert there.read_text() == "mine" and sorted(os.listdir(tmp_path)) == ["dem.tif", "there.yaml"]


@pytest.mark.parametrize(
    "value",
    [
        "dem.tif", "../a b.gpkg:layer", "no", "null", "~", "3", "1e5", ".5", "a: b", "#a", "é ü", "'", '"', "a\\b",
        "- a", "*a", "&a", "!a", "%a", "{a", "[a", "a,b", " a", "a ", "a #b", "tab\there", "true", ".inf", "./a", "..",
        "@", "x\u2028y",
    ],
)  # fmt: skip
def test_texts_come_back(tmp_path, value):
    path = tmp_path / "text.yaml"
    path.write_text(f"a: {yaml_text(value)}  # comment\nb: {yaml_text([value, 1.5])}\n", encoding="utf-8")
    assert read_yaml(path).mapping == {"a": value, "b": [value, 1.5]}
