"""The schema of scenes takes what `Scene` takes, and refuses what it refuses for its name, type, word or bounds."""

import copy
import json
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from jsonschema import Draft202012Validator

from landlab_debrisflow.core.errors import ParameterError
from landlab_debrisflow.core.values import keys_of
from landlab_debrisflow.physics.registry import LAWS
from landlab_debrisflow.scene.content import read_content, to_mapping
from landlab_debrisflow.scene.new_scene import new_scene
from landlab_debrisflow.scene.read_yaml import read_yaml
from landlab_debrisflow.scene.schema import scene_schema

ROOT = Path(__file__).parents[2]
SCHEMA = scene_schema()
VALIDATOR = Draft202012Validator(SCHEMA)
TRIANGLE = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]]
SURGE = {"line_start": [0.0, 0.0], "line_end": [0.0, 9.0], "times": [0.0, 9.0], "discharge": [5.0], "velocity": [2.0]}
LINES = {"river": [[0.0, 0.0], [5.0, 5.0]]}


def whole(laws):
    """Return the mapping of a scene with every key that these laws leave room for."""
    mapping = {
        "terrain": {
            "example": "gully", "soil_depth": 1.5, "bed_degree_of_saturation": 0.7,
            "window": [0.0, 0.0, 50.0, 50.0], "spacing": 4.0, "nodata": 0.0,
            "zones": [
                {"polygons": [TRIANGLE], "soil_depth": 0.5}, {"polygons": "forest.gpkg", "bed_pressure_ratio": 0.3},
            ],
            "edits": [
                {"dam": [LINES["river"]], "crest_height": 5.0}, {"buildings": "houses.gpkg", "height": 9.0},
                {"excavation": [TRIANGLE], "depth": 2.0, "slope": 30.0},
            ],
        },
        "release": [
            {"polygons": [TRIANGLE], "depth": 2.0, "velocity": [1.0, -2.0], "failure_surface": "uniform"},
            {"points": [[1.0, 2.0]], "hydrograph": [[0.0, 0.0], [60.0, 20.0]], "width": 5.0, "speed": 2.0},
            {"raster": "depth.tif", "from": "above", "time": 3.0},
        ],
        "output": {
            "interval": 5.0, "gauges": {"bridge": [1.0, 2.0]}, "sections": LINES, "thalweg": "line.gpkg",
            "exposure": {"7": TRIANGLE}, "maps": ["max_run_up"],
        },
        "inflow": [SURGE],
    }  # fmt: skip
    return to_mapping(read_content(mapping | laws))


WHOLES = [
    whole({kind: known[n] for kind, known in ((k, list(v)) for k, v in LAWS.items()) if n < len(known)})
    for n in range(max(map(len, LAWS.values())))
]


def errors(mapping):
    return [error.message for error in VALIDATOR.iter_errors(mapping)]


def refused(mapping):
    """Return the message by which a scene is refused, or an empty text."""
    try:
        read_content(mapping)
    except ParameterError as error:
        return str(error)
    return ""


def test_the_schema_is_one():
    Draft202012Validator.check_schema(SCHEMA)
    assert json.loads(json.dumps(SCHEMA)) == SCHEMA


def test_every_key_has_a_description_with_unit_and_default():
    for kind, laws in LAWS.items():
        for name, law in laws.items():
            shown = SCHEMA["$defs"][f"{kind}_{name}"]["properties"]
            assert list(shown) == ["law", *keys_of(law)]
    friction = SCHEMA["$defs"]["friction_voellmy"]["properties"]["cohesion"]
    assert friction["default"] == 0.0 and "[Pa]" in friction["description"]
    assert SCHEMA["$defs"]["release"]["properties"]["from"]["enum"] == ["ground", "above"]


@pytest.mark.parametrize("mapping", WHOLES)
def test_whole_scenes_are_taken(mapping):
    assert errors(mapping) == [] and not refused(mapping)


def test_new_scenes_are_taken(tmp_path):
    assert errors(read_yaml(new_scene(tmp_path / "scene.yaml")).mapping) == []


@pytest.mark.parametrize("path", sorted((ROOT / "examples").rglob("*.yaml")), ids=lambda path: path.name)
def test_examples_are_taken(path):
    assert errors(read_yaml(path).mapping) == []


def places(value, path=()):
    """Yield the path of every value below a mapping or list."""
    for key, inner in value.items() if isinstance(value, dict) else enumerate(value):
        yield (*path, key)
        if isinstance(inner, dict | list):
            yield from places(inner, (*path, key))


def changed(mapping, path, value):
    mapping = copy.deepcopy(mapping)
    target = mapping
    for step in path[:-1]:
        target = target[step]
    target[path[-1]] = value
    return mapping


BAD = st.one_of(
    st.none(), st.booleans(), st.floats(-1e9, 1e9), st.integers(-10, 10**7),
    st.sampled_from(["", "voelmy", "12", "abc"]), st.lists(st.floats(-5.0, 5.0), max_size=4),
    st.just({}), st.just({"law": "bingham"}), st.just([[1, 2, 3]]),
)  # fmt: skip
NOT_IN_THE_SCHEMA = (
    "give exactly one of dam", "needs either", "give soil_depth, bed_pressure_ratio", "with west < east",
    "not both", "must exceed", "belongs to", "given exactly", "missing", "must increase", "values for", "same point",
    "0 m3 s-1", "runs along", "from is above", "at most max_duration", "one line", "two numbers, x and y",
    "must be at least two", "speed must be more than 0", "infinitely thick", "an example",
)  # fmt: skip
"""Words of refusals of values that do not go together."""


@pytest.mark.slow
@settings(max_examples=400, deadline=None, derandomize=True)
@given(data=st.data())
def test_a_changed_value_that_is_refused_is_refused_by_the_schema(data):
    mapping = data.draw(st.sampled_from(WHOLES))
    path = data.draw(st.sampled_from(list(places(mapping))))
    mutated = changed(mapping, path, data.draw(BAD))
    refusal = refused(mutated)
    whole_number = "must be an integer" in refusal and ".0" in refusal  # JSON knows no difference between 2 and 2.0
    if refusal and not whole_number and not any(words in refusal for words in NOT_IN_THE_SCHEMA):
        assert errors(mutated), f"{path}: {refusal}"


@settings(max_examples=30, deadline=None, derandomize=True)
@given(data=st.data())
def test_a_key_too_many_is_refused_by_both(data):
    mapping = data.draw(st.sampled_from(WHOLES))
    inner = [path for path in places(mapping) if path[-1] not in ("gauges", "sections", "exposure")]
    target = copy.deepcopy(mapping)
    owners = [()] + [path for path in inner if isinstance(at(mapping, path), dict)]
    at(target, data.draw(st.sampled_from(owners)))[data.draw(st.sampled_from(["lw", "depht", "colour"]))] = 1.0
    assert refused(target) and errors(target)


def at(mapping, path):
    for step in path:
        mapping = mapping[step]
    return mapping
