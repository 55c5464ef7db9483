"""Members: the run of a member is that of a scene with its values."""

import geopandas
import numpy as np
import pytest
import rasterio
import shapely
from scipy import stats

from landlab_debrisflow import InputError, ParameterError, Scene, simulate
from landlab_debrisflow.ensemble import Ensemble
from landlab_debrisflow.ensemble.member import prepare_member
from landlab_debrisflow.ensemble.noise import correlated_noise
from landlab_debrisflow.geo.lattice import Lattice
from landlab_debrisflow.scene.gully import gully

from .scenes import ANGLE, SCENE, SOUTH, WEST, square

ZONE = {"polygons": square(0.0, 100.0, 100.0), "friction": {"basal_friction_angle": 33.0}}
WET = {"polygons": square(0.0, 100.0, 100.0), "bed_pressure_ratio": 0.7}
POINTS = {"points": [WEST + 60.0, SOUTH + 150.0], "hydrograph": [[0.0, 20.0], [9.0, 20.0]], "width": 10, "speed": 3}


def with_zone(zone):
    return SCENE | {"terrain": SCENE["terrain"] | {"zones": [zone]}}


def compare(ensemble, scene):
    """Compare the first member of an ensemble with the maps of a scene."""
    results, maps = ensemble.run(workers=1), simulate(None, Scene.from_mapping(scene))
    (found,) = results.members()
    assert found.error == ""
    for name in results.maps:
        expected = maps[f"debris_flow__{name}"].values.astype(np.float32)
        if name == "arrival_time":
            expected[expected < 0.0] = np.nan
        assert np.array_equal(found.on_lattice(name, expected.shape), expected, equal_nan=True), name
    return found


def test_a_member_is_the_run_of_a_scene_with_its_values():
    vary = {ANGLE: [24.0], "release.volume": [900.0]}
    scene = SCENE | {
        "friction": {"law": "voellmy", "basal_friction_angle": 24.0},
        "release": {"polygons": square(20.0, 140.0), "volume": 900.0},
    }
    found = compare(Ensemble(SCENE, vary, sampling="factorial"), scene)
    assert found.values == {key: choices[0] for key, choices in vary.items()}
    assert found.maps["max_depth"].dtype == np.float32 and found.maps["max_depth"].any(axis=0).all()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("vary", "scene"),
    [
        ({"release.polygons": [square(60.0, 140.0, 20.0)]}, SCENE | {
            "release": {"polygons": square(60.0, 140.0, 20.0), "depth": 1.5},
        }),
        ({"terrain.soil_depth": [0.4]}, SCENE | {"terrain": {"example": "gully", "soil_depth": 0.4}}),
        ({"friction": [{"law": "coulomb", "basal_friction_angle": 22.0}]}, SCENE | {
            "friction": {"law": "coulomb", "basal_friction_angle": 22.0},
        }),
        ({"numerics.shock_viscosity": [2.0]}, SCENE | {"numerics": {"particle_count": 40, "shock_viscosity": 2.0}}),
    ],
)  # fmt: skip
def test_other_members_are_runs_of_scenes_with_their_values(vary, scene):
    compare(Ensemble(SCENE, vary, sampling="factorial"), scene)


@pytest.mark.slow
def test_a_value_outside_zones_leaves_that_of_the_zone():
    scene = with_zone(ZONE)
    other = scene | {"friction": {"law": "voellmy", "basal_friction_angle": 22.0}}
    compare(Ensemble(scene, {ANGLE: [22.0]}, sampling="factorial"), other)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("vary", "scene", "other"),
    [
        ({"terrain.zones.friction.basal_friction_angle": [25.0]}, with_zone(ZONE),
         with_zone(ZONE | {"friction": {"basal_friction_angle": 25.0}})),
        ({"material.bed_pressure_ratio": [0.5]}, with_zone(WET),
         with_zone(WET) | {"material": {"bed_pressure_ratio": 0.5}}),
        ({"release.factor": [1.4]}, SCENE | {"release": POINTS},
         SCENE | {"release": POINTS | {"hydrograph": [[0.0, 28.0], [9.0, 28.0]]}}),
    ],
)  # fmt: skip
def test_members_of_zones_and_points(vary, scene, other):
    compare(Ensemble(scene, vary, sampling="factorial"), other)


def test_a_factor_multiplies_the_released_volume():
    results = Ensemble(SCENE, {"release.factor": [1.0, 1.5]}, sampling="factorial").run(workers=1)
    one, more = results.measures.budget_released.values
    assert more == pytest.approx(1.5 * one, rel=1e-12)


def test_a_member_that_fails_is_kept_and_others_count():
    """A volume that no body within the outline can have: the release is refused."""
    results = Ensemble(SCENE, {"release.volume": [500.0, 1e9, 600.0]}, sampling="factorial").run(workers=1)
    (failure,) = results.failures
    assert (failure.member, failure.values) == (1, {"release.volume": 1e9})
    assert failure.error.startswith("InputError: ") and failure.maps == {} and failure.measures == {}
    assert np.isfinite(results.measures.max_depth.values).tolist() == [True, False, True]
    assert [one.error == "" for one in results.members()] == [True, False, True] and results.done.all()


def test_noise_is_new_for_every_member_and_known_from_its_number():
    vary = {"terrain.elevation_noise": {"rms": 0.2, "length": 20.0}}
    ensemble = Ensemble(SCENE, vary, 2, "random", seed=5)
    basis, plain = ensemble.basis(), gully()[0]
    first, second = (
        prepare_member(basis, ensemble.values(member)).terrain["topographic__elevation"].values - plain
        for member in (0, 1)
    )
    number = ensemble.values(1)["terrain.elevation_noise"]
    expected = correlated_noise(basis.lattice, 0.2, 20.0, (5, number))
    assert second == pytest.approx(expected, abs=1e-12) and abs(np.corrcoef(first.ravel(), second.ravel())[0, 1]) < 0.25
    results = ensemble.run(workers=1)
    assert results.failures == [] and len(set(results.measures.inundated_area.values)) == 2


def test_noise_has_its_correlation():
    """10 000 nodes are some 100 independent places; the mean of 20 realisations scatters by 1/sqrt(2000) = 0.022."""
    lattice = Lattice((100, 100), (5.0, 10.0), (0.0, 0.0))
    fields = [correlated_noise(lattice, 0.3, 50.0, (0, number)) for number in range(20)]
    assert np.sqrt(np.mean(np.square(fields))) == pytest.approx(0.3, rel=0.05)
    for rows, columns in ((0, 5), (0, 10), (5, 0), (0, 20)):
        distance = np.hypot(10.0 * rows, 5.0 * columns)
        product = [np.mean(one[: 100 - rows, : 100 - columns] * one[rows:, columns:]) for one in fields]
        assert np.mean(product) / 0.09 == pytest.approx(np.exp(-((distance / 50.0) ** 2)), abs=0.07)


@pytest.mark.slow
def test_members_have_the_nodes_of_the_scene_whatever_they_can_reach(tmp_path):
    """A window that follows from the releases is that of all releases among the choices."""
    elevation, _, lattice = gully()
    with rasterio.open(
        tmp_path / "dem.tif", "w", driver="GTiff", width=lattice.shape[1], height=lattice.shape[0], count=1,
        dtype="float64", crs=lattice.crs,
        transform=rasterio.transform.from_origin(lattice.bounds[0], lattice.bounds[3], *lattice.spacing),
    ) as file:  # fmt: skip
        file.write(elevation[::-1], 1)
    places = [square(20.0, 140.0), square(300.0, 140.0)]
    terrain = {"elevation": "dem.tif", "window": "reach", "travel_angle": 25.0, "soil_depth": 1.0}
    scenes = [
        Scene.from_mapping(SCENE | {"terrain": terrain, "release": {"polygons": place, "depth": 1.0}}, tmp_path)
        for place in places
    ]
    vary = {"release.polygons": places, "terrain.soil_depth": [0.5, 1.0]}
    ensemble = Ensemble(scenes[1], vary, sampling="factorial")
    results = ensemble.run(workers=1)
    assert results.failures == []
    west = min(scene.lattice.bounds[0] for scene in scenes)
    assert results.lattice.bounds[0] == west < scenes[1].lattice.bounds[0]


def test_a_volume_that_an_attribute_overrides_is_refused(tmp_path):
    shape = shapely.Polygon(square(20.0, 140.0))
    frame = geopandas.GeoDataFrame({"Volume": [500.0]}, geometry=[shape], crs="EPSG:32632")
    frame.to_file(tmp_path / "slides.geojson")
    scene = Scene.from_mapping(SCENE | {"release": {"polygons": "slides.geojson"}}, tmp_path)
    vary = {"release.volume": [500.0, 600.0]}
    with pytest.raises(
        InputError, match=r"release.volume would vary in vain: .* attribute volume.*vary release 1.factor"
    ):
        Ensemble(scene, vary, sampling="factorial").run(workers=1)
    results = Ensemble(scene, {"release.factor": [1.2]}, sampling="factorial").run(workers=1)
    assert results.measures.budget_released.values == pytest.approx([600.0], rel=1e-9)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"vary": {}}, r"vary must be a mapping of dotted names"),
        ({"vary": {ANGLE: [20.0], "friction": ["coulomb"]}}, r"basal_friction_angle and friction vary the same"),
        ({"vary": {ANGLE: stats.norm(28, 1)}, "sampling": "factorial"}, r"factorial needs a list of choices for fric"),
        ({"vary": {ANGLE: [20.0, 30.0]}, "sampling": "factorial", "members": 3}, r"factorial has 2 members"),
        ({"vary": {ANGLE: [20.0]}, "sampling": "latin"}, r"sampling must be one of .*; got 'latin'"),
        ({"vary": {ANGLE: [20.0]}, "members": 0}, r"members must lie in \[1, 1e\+06\], got 0"),
        ({"vary": {ANGLE: [20.0]}, "seed": -1}, r"seed must lie in"),
        ({"vary": {ANGLE: [20.0]}, "maps": ["max_dept"]}, r"maps\[0\] must be one of .*did you mean 'max_depth'"),
        ({"vary": {ANGLE: [20.0]}, "batch": 0}, r"batch must lie in \[1, 10000\], got 0"),
        ({"vary": {ANGLE: [20.0]}, "sampling": "saltelli", "correlation": [[1.0]], "members": 6}, r"leave corr"),
        ({"vary": {ANGLE: [20.0]}, "sampling": "factorial", "correlation": [[1.0]]}, r"is not for factorial"),
    ],
)  # fmt: skip
def test_an_ensemble_that_cannot_be_is_refused(arguments, message):
    with pytest.raises(ParameterError, match=message):
        Ensemble(SCENE, **arguments)
