"""Dotted names: every value of a scene has one, and unknown ones are asked back."""

import pytest

from landlab_debrisflow import ParameterError, Scene
from landlab_debrisflow.ensemble.edits import with_values
from landlab_debrisflow.ensemble.names import find_name, scene_names

from .scenes import SCENE, SOUTH, WEST, square

ZONES = [{"polygons": square(100.0, 100.0), "friction": {"cohesion": 50.0}, "soil_depth": 1.0}]
RICH = SCENE | {
    "terrain": SCENE["terrain"] | {"zones": ZONES, "soil_depth": 2.0},
    "release": [SCENE["release"], {"polygons": square(60.0, 140.0), "volume": 300.0, "time": 2.0}],
    "inflow": {"line_start": [WEST + 50.0, SOUTH + 130.0], "line_end": [WEST + 50.0, SOUTH + 170.0],
               "times": [0.0, 9.0], "discharge": 5.0, "velocity": 2.0},
    "column": {"law": "ale", "dilatancy": {}},
}  # fmt: skip


@pytest.fixture(scope="module")
def content():
    return Scene.from_mapping(RICH).content


@pytest.mark.parametrize(
    ("key", "value", "read"),
    [
        ("friction.basal_friction_angle", 25.0, lambda c: c.setup.friction.basal_friction_angle),
        ("release 2.volume", 99.0, lambda c: c.release[1].volume),
        ("release 1.volume", 99.0, lambda c: c.release[0].volume),
        ("terrain.zones 1.soil_depth", 0.5, lambda c: c.terrain.zones[0].soil_depth),
        ("terrain.zones.friction.cohesion", 7.0, lambda c: c.terrain.zones[0].friction["cohesion"]),
        ("terrain.soil_depth", 0.7, lambda c: c.terrain.soil_depth),
        ("inflow.velocity", 4.0, lambda c: c.setup.inflow[0].velocity[0]),
        ("material.porosity", 0.5, lambda c: c.setup.material.porosity),
        ("column.dilatancy.critical_solid_fraction", 0.61, lambda c: c.setup.column.dilatancy.critical_solid_fraction),
        ("numerics.shock_viscosity", 2.0, lambda c: c.setup.numerics.shock_viscosity),
    ],
)
def test_a_value_takes_the_place_of_that_of_the_scene(content, key, value, read):
    assert read(content) != value
    changed = with_values(content, {find_name(key, content).path: value})
    assert read(changed) == value
    assert sum(one != other for one, other in zip(changed, content, strict=True)) == 1


def test_a_volume_takes_the_place_of_a_depth(content):
    changed = with_values(content, {("release", 0, "volume"): 500.0, ("release", 0, "time"): 1.0})
    assert (changed.release[0].volume, changed.release[0].depth, changed.release[0].time) == (500.0, None, 1.0)


def test_a_law_may_be_exchanged_as_a_whole(content):
    name = find_name("friction", content)
    changed = with_values(content, {name.path: {"law": "coulomb", "basal_friction_angle": 31.0}})
    assert type(changed.setup.friction).__name__ == "Coulomb"


def test_a_value_out_of_bounds_is_refused_when_it_is_set(content):
    with pytest.raises(ParameterError, match="porosity must lie in"):
        with_values(content, {("material", "porosity"): 1.5})


@pytest.mark.parametrize(
    ("key", "message"),
    [
        ("friction.basal_fricton_angle", r"unknown name .*did you mean 'friction.basal_friction_angle'"),
        ("frictn.cohesion", r"did you mean 'friction.cohesion'"),
        ("release.volume", r"release.volume fits 2 of release; name one: release 1.volume or release 2.volume"),
        ("release 3.volume", r"did you mean 'release [12].volume'"),
        ("numerics.particle_count", r"cannot vary: one number of particles holds for all members"),
        ("terrain.spacing", r"cannot vary: all members have the nodes of the scene"),
        ("output.max_duration", r"output does not change a run"),
        ("numerics.threads", r"a member has one thread"),
        ("weather", r"unknown name 'weather'; give a name such as friction.basal_friction_angle"),
        (3, r"unknown name 3"),
    ],
)
def test_a_name_that_cannot_vary_is_refused(content, key, message):
    with pytest.raises(ParameterError, match=message):
        find_name(key, content)


def test_names_are_unique_and_have_their_units(content):
    names = list(scene_names(content))
    assert len({name.key for name in names}) == len(names) > 80
    assert find_name("release 2.volume", content).unit == "m3"
    assert find_name("release 1.factor", content).bounds == (0.0, float("inf"))
