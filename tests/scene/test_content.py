"""Keys of scenes are checked with their place in the file, and come back as plain values."""

import json

import pytest

from landlab_debrisflow.core.errors import InputError, ParameterError
from landlab_debrisflow.scene.content import read_content, to_mapping
from landlab_debrisflow.scene.read_yaml import read_yaml

GROUND = "terrain:\n  example: gully\n"
TRIANGLE = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]]


def content(folder, text):
    path = folder / "scene.yaml"
    path.write_text(GROUND + text)
    file = read_yaml(path)
    return read_content(file.mapping, file)


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("relese: {}\n", 3, r"unknown key 'relese' \(did you mean 'release'\?\)"),
        ("max_duration: 5\n", 3, r"unknown key 'max_duration' \(it is one of output: indent it below\)"),
        ("friction:\n  law: voelmy\n", 4, r"friction: unknown law 'voelmy' \(did you mean 'voellmy'\?\)"),
        ("friction:\n\n  law: voellmy\n  cohesion: -1\n", 6, r"friction: Voellmy: cohesion must lie in"),
        ("friction:\n  law: voellmy\n  cohesin: 1\n", 5, r"Voellmy: unknown key 'cohesin' \(did you mean 'cohesion'"),
        (
            "friction:\n  law: voellmy\n  viscosity: 1\n",
            5,
            r"unknown key 'viscosity' \(it is one of coulomb, ",
        ),
        ("erosion:\n  growth_rate: 1\n", 3, "erosion: a mapping needs the key 'law'"),
        ("numerics:\n  threads: 1\n  settle: no\n", 5, "numerics: settle must be true or false, got 'no'"),
        ("numerics: 3\n", 3, "numerics must be a Numerics or a mapping"),
        ("release:\n  polygons: a.gpkg\n  depht: 3\n", 5, r"release: unknown key 'depht' \(did you mean 'depth'"),
        ("release:\n- polygons: a.gpkg\n- polygons: b.gpkg\n  depth: 0\n", 6, r"release\[1\]: depth must lie in \(0,"),
        ("release:\n- polygons: a.gpkg\n- 3\n", 5, r"release\[1\]: a mapping is needed"),
        ("release: a.gpkg\n", 3, "release: a mapping is needed, with keys such as polygons"),
        ("release: {}\n", 3, "exactly one of polygons, raster, points, got none"),
        ("release: {polygons: a, raster: b}\n", 3, "exactly one of .* got polygons and raster"),
        ("release: {raster: a, depth: 1}\n", 3, "depth belongs to polygons, not to raster"),
        ("release: {polygons: a, depth: 1, volume: 1}\n", 3, "give depth or volume, not both"),
        ("release: {polygons: a, from: grund}\n", 3, r"from must be one of ground, above; .*did you mean 'ground'"),
        ("release: {polygons: a, from: above, failure_surface: ellipsoid}\n", 3, "from is above"),
        ("release: {polygons: a, velocity: 3}\n", 3, "velocity must be a list of 2 numbers"),
        ("release: {polygons: a, velocity: [1, 2], speed: 3}\n", 3, "give velocity or speed, not both"),
        ("release: {points: [1, 2], width: 3}\n", 3, "missing: hydrograph, speed"),
        ("release: {points: [1, 2], width: 3, speed: 0, hydrograph: a.csv}\n", 3, "speed must be more than 0"),
        ("release: {polygons: [[0, 0], [1, 1]]}\n", 3, "polygons must have at least 3 pairs, got 2"),
        ("release:\n  polygons:\n  - [0, 0]\n  - [1, x]\n", 6, r"polygons\[1\] must be two finite numbers, got 'x'"),
        ("release: {polygons: [[0, 0], [1, 1, 1], [2, 2]]}\n", 3, r"polygons\[1\] must be two numbers in brackets"),
        ("release: {polygons: a, time: -1}\n", 3, "time must lie in"),
        ("output: {variables: [depth, sped]}\n", 3, r"variables\[1\] must be one of .*did you mean 'speed'"),
        ("output: {maps: 3}\n", 3, "maps must be a list of words"),
        ("output: {gauges: {a: 3}}\n", 3, r"gauges: a must be a point \[x, y\], got 3"),
        ("output: {gauges: {}}\n", 3, "gauges has no entry"),
        ("output: {gauges: 3}\n", 3, "gauges must be the name of a file or a mapping of names to a point"),
        ("output: {thalweg: [[[0, 0], [1, 1]], [[0, 0], [1, 1]]]}\n", 3, "thalweg must be one line, got 2"),
        ("output: {interval: 20, max_duration: 10}\n", 3, "interval must be at most max_duration, 10 s, got 20 s"),
        ("output: {directory: ''}\n", 3, "directory must be the name of a file"),
        ("inflow:\n- times: [0, 1]\n", 4, r"inflow\[0\]: Hydrograph: line_start and .* missing"),
        ("inflow: 3\n", 3, "inflow must be a Hydrograph"),
    ],
)
def test_what_is_refused_says_where(tmp_path, text, line, words):
    with pytest.raises(ParameterError, match=words) as refusal:
        content(tmp_path, text)
    assert str(refusal.value).startswith(f"{tmp_path / 'scene.yaml'} line {line}: ")


@pytest.mark.parametrize(
    "mapping", [None, [], {3: 4}, {"terrain": 3}, {"terrain": {3: 4}}, {"terrain": {"example": "gully"}, "output": [1]}]
)
def test_mappings_of_other_kinds(mapping):
    with pytest.raises(ParameterError):
        read_content(mapping)


def test_empty_keys_are_keys_that_are_not_there(tmp_path):
    text = "release:\noutput:\nfriction:\nmaterial:\nnumerics:\ninflow:\n"
    assert content(tmp_path, text) == content(tmp_path, "")


def test_a_scene_comes_back_from_plain_values():
    mapping = {
        "terrain": {"example": "gully", "soil_depth": 1.5},
        "release": [
            {"polygons": TRIANGLE, "depth": 2, "from": "above", "velocity": [1, -2]},
            {"polygons": [TRIANGLE, TRIANGLE], "volume": 200, "failure_surface": "ellipsoid", "time": 30},
            {"points": [[1, 2], [3, 4]], "hydrograph": [[0, 0], [60, 20]], "width": 5, "speed": 2},
            {"raster": "depth.tif"},
        ],
        "output": {
            "variables": "depth", "maps": ["max_run_up"], "gauges": {"bridge": [1, 2]}, "sections": "lines.gpkg",
            "thalweg": [[0, 0], [5, 5]], "exposure": {"7": TRIANGLE}, "interval": 5, "format": "zarr",
        },
        "friction": {"law": "Voellmy", "cohesion": "soil__cohesion"},
        "inflow": {"line_start": [0, 0], "line_end": [0, 9], "times": [0, 9], "discharge": 5, "velocity": 2},
    }  # fmt: skip
    found = read_content(mapping)
    assert found.release[0].from_ == "above" and found.release[0].velocity == (1.0, -2.0)
    assert found.output.gauges == (("bridge", (1.0, 2.0)),)
    plain = json.loads(json.dumps(to_mapping(found)))
    assert read_content(plain) == found
    assert plain["release"][0]["polygons"] == [TRIANGLE] and plain["output"]["gauges"] == {"bridge": [1.0, 2.0]}


def test_errors_of_files_name_the_line_of_the_name(tmp_path):
    from landlab_debrisflow import Scene

    path = tmp_path / "scene.yaml"
    path.write_text(GROUND + "release:\n- depth: 2\n  polygons: nowhere.gpkg\n")
    with pytest.raises(InputError, match=r"line 5: release\[0\]: cannot read .*nowhere.gpkg"):
        _ = Scene.from_file(path).releases
    path.write_text(GROUND + "output:\n  interval: 3\n  gauges: none.gpkg\n")
    with pytest.raises(InputError, match=r"line 5: output: gauges: cannot read .*none.gpkg"):
        _ = Scene.from_file(path).places
