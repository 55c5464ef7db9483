"""The ground of a scene: the lattice of the DEM, its window and spacing, soil and zones by place."""

import numpy as np
import pytest
import shapely
from numpy.testing import assert_allclose, assert_array_equal

from landlab_debrisflow.core.errors import InputError, ParameterError
from landlab_debrisflow.run.scene import Scene
from tests.geo.files import placed, write_tiff

from .dems import NORTH, WEST, place, square, write_shapes, write_slope

Z = "topographic__elevation"
RELEASE = {"polygons": square(20.0, 80.0, 30.0), "depth": 1.0}


def scene(folder, release=RELEASE, laws=None, **terrain):
    if not (folder / "dem.tif").exists():
        write_slope(folder / "dem.tif")
    return Scene.from_mapping(
        {"terrain": {"elevation": "dem.tif"} | terrain, "release": release} | (laws or {}), folder
    )


def at(terrain, name, x, y):
    """Return a value at the node of a cell east and south of the north-western corner."""
    return float(terrain[name].sel(x=WEST + x, y=NORTH - y, method="nearest"))


def test_a_small_dem_is_taken_whole(tmp_path):
    terrain = scene(tmp_path).terrain
    assert terrain[Z].shape == (40, 60) and list(terrain.data_vars) == [Z]
    assert terrain.x[0] == WEST + 2.5 and terrain.y[-1] == NORTH - 2.5 and "33N" in terrain.attrs["crs_wkt"]
    assert terrain.attrs["dem"] == "dem.tif" and len(terrain.attrs["dem_sha256"]) == 64 and terrain.attrs["notes"] == []


def test_voids_at_the_edge_that_are_filled_with_a_number_are_told(tmp_path):
    """A DEM that was turned and saved as integers has zeros round it; a plain at the sea has them, too."""
    corner = [(row, column, 0.0) for row in range(6) for column in range(6 - row)]
    write_slope(tmp_path / "dem.tif", holes=corner)
    (told,) = scene(tmp_path).terrain.attrs["notes"]
    assert "exactly 0 m at 21 nodes" in told and "terrain: nodata: 0" in told
    assert np.isnan(scene(tmp_path, nodata=0).terrain[Z].values).sum() == 21
    beach = [(row, column, 40.0) for row in range(7) for column in range(7)]
    write_slope(tmp_path / "dem.tif", holes=[*beach, *corner])
    assert scene(tmp_path).terrain.attrs["notes"] == []


def test_nodes_without_data_are_closed_and_holes_said(tmp_path):
    write_slope(tmp_path / "dem.tif", holes=[(0, 0, -9999.0), (10, 10, -9999.0), (10, 11, -9999.0)], nodata=-9999.0)
    made = scene(tmp_path)
    grid = made.grid()
    assert np.flatnonzero(grid.status_at_node == grid.BC_NODE_IS_CLOSED).size == 3
    assert any("1 holes without data, 2 nodes" in note for note in made.terrain.attrs["notes"])
    assert any("1 nodes at the edge" in note for note in made.terrain.attrs["notes"])


def test_a_further_value_marks_missing_data(tmp_path):
    write_slope(tmp_path / "dem.tif", holes=[(10, 10, 0.0)])
    assert np.isnan(scene(tmp_path, nodata=0).terrain[Z]).sum() == 1


def test_a_dem_without_data_is_refused(tmp_path):
    write_tiff(tmp_path / "dem.tif", np.full((40, 60), -9999.0))
    with pytest.raises(InputError, match="no data in the window"):
        _ = scene(tmp_path).terrain


# ---- window ----


def test_a_window_of_whole_cells(tmp_path):
    terrain = scene(tmp_path, window=[WEST + 11.0, NORTH - 150.0, WEST + 99.0, NORTH - 50.0]).terrain
    assert terrain[Z].shape == (20, 18) and terrain.x[0] == WEST + 12.5 and terrain.y[0] == NORTH - 147.5
    assert at(terrain, Z, 52.5, 100.0) == 1000.0 - 0.4 * 52.5


@pytest.mark.parametrize(
    ("window", "words"),
    [
        ([0.0, 0.0, 10.0, 10.0], "must hold 5 x 5 nodes.*covers x 400000 to 400300"),
        ([10.0, 0.0, 0.0, 10.0], "west < east"),
        ([10.0, 0.0, 0.0], "a list of 4 numbers"),
        ("reac", r"did you mean 'reach'\?"),
    ],
)
def test_bad_windows(tmp_path, window, words):
    with pytest.raises((InputError, ParameterError), match=words):
        _ = scene(tmp_path, window=window).terrain


def test_what_a_release_can_reach(tmp_path):
    """Down a plane of 21.8 degrees all is reached; up it the energy of 20 m, and the margin."""
    write_slope(tmp_path / "dem.tif", rows=200, columns=300)
    made = scene(tmp_path, {"polygons": square(700.0, 500.0, 30.0), "depth": 1.0}, window="reach", travel_angle=15.0)
    terrain = made.terrain
    x, y = np.meshgrid(5.0 * (np.arange(300) + 0.5), 5.0 * (np.arange(200) + 0.5))
    away = np.hypot(np.maximum(abs(x - 715.0) - 15.0, 0.0), np.maximum(abs(y - 515.0) - 15.0, 0.0))
    # from the highest node of the release, to a cell
    below = 20.0 + 0.4 * (x - 700.0) >= np.tan(np.radians(15.0)) * (away - 5.0)
    columns, rows = np.flatnonzero(below.any(axis=0)), np.flatnonzero(below.any(axis=1))
    assert abs(float(terrain.x[0]) - (WEST + 5.0 * columns[0] + 2.5 - 50.0)) <= 10.0
    assert float(terrain.x[-1]) == WEST + 1497.5
    assert terrain[Z].shape[0] in range(min(200, rows.size + 18), min(200, rows.size + 24) + 1)
    assert "of 200 x 300 nodes can be reached at a travel angle of 15 degrees" in " ".join(made.notes)


def test_a_ridge_higher_than_the_energy_is_not_crossed(tmp_path):
    x = 5.0 * (np.arange(300) + 0.5)
    values = np.broadcast_to(1000.0 + 60.0 * np.exp(-(((x - 700.0) / 60.0) ** 2)), (120, 300)).copy()
    write_tiff(tmp_path / "dem.tif", values, transform=placed(WEST, NORTH, 5.0, 5.0))
    low = {"polygons": square(300.0, 300.0, 30.0), "depth": 1.0}
    assert float(scene(tmp_path, low, window="reach", travel_angle=0.5).terrain.x[-1]) < WEST + 740.0
    high = {"polygons": square(690.0, 300.0, 20.0), "depth": 1.0}
    assert float(scene(tmp_path, high, window="reach", travel_angle=0.5).terrain.x[-1]) == WEST + 1497.5


def test_the_window_holds_all_releases(tmp_path):
    write_slope(tmp_path / "dem.tif", rows=300, columns=300, gradient=0.05)
    write_shapes(tmp_path / "a.gpkg", [shapely.Polygon(square(100.0, 100.0, 20.0))], depth=[1.0])
    depth = np.zeros((300, 300))
    depth[280:285, 20:24] = 1.0
    write_tiff(tmp_path / "depth.tif", depth, transform=placed(WEST, NORTH, 5.0, 5.0))
    hydrograph = {"hydrograph": [[0, 1], [10, 1]], "speed": 2.0, "width": 10.0}
    releases = [{"polygons": "a.gpkg"}, {"raster": "depth.tif"}, {"points": [place((600.0, 700.0))[0]], **hydrograph}]
    terrain = scene(tmp_path, releases, window="reach", travel_angle=30.0).terrain
    assert float(terrain.x[0]) < WEST + 100.0 and float(terrain.x[-1]) > WEST + 610.0
    assert float(terrain.y[-1]) > NORTH - 100.0 and float(terrain.y[0]) < NORTH - 1425.0
    assert terrain[Z].shape[1] < 200


def test_a_release_outside_is_named(tmp_path):
    with pytest.raises(InputError, match=r"release\[0\]: .* lies wholly outside the DEM"):
        _ = scene(tmp_path, {"polygons": square(900.0, 80.0, 30.0), "depth": 1.0}, window="reach").terrain


def test_a_large_dem_is_cut_unasked_and_thinned_out(tmp_path, monkeypatch):
    from landlab_debrisflow.scene import reach

    write_slope(tmp_path / "dem.tif", rows=600, columns=700, gradient=0.3)
    release = {"polygons": square(1500.0, 1500.0, 30.0), "depth": 1.0}
    whole = scene(tmp_path, release, travel_angle=12.0).terrain
    assert whole[Z].shape[1] < 450
    monkeypatch.setattr(reach, "MOST_EXAMINED", 10_000)
    thinned = scene(tmp_path, release, travel_angle=12.0).terrain
    assert thinned[Z].shape[0] == pytest.approx(whole[Z].shape[0], abs=60)
    assert np.all(np.isin(whole.x, thinned.x) | (whole.x < thinned.x[0] + 60.0))


# ---- spacing ----


def test_a_coarser_spacing_takes_means(tmp_path):
    made = scene(tmp_path, spacing=10)
    terrain = made.terrain
    assert terrain[Z].shape == (20, 30) and terrain.x[0] == WEST + 5.0 and terrain.y[0] == NORTH - 195.0
    assert_allclose(terrain[Z].values[0], 1000.0 - 0.4 * (terrain.x.values - WEST), rtol=1e-12)
    assert "means over cells" in " ".join(made.terrain.attrs["notes"])


def test_a_finer_spacing_adds_no_detail(tmp_path):
    made = scene(tmp_path, spacing=2.5, window=[WEST + 50.0, NORTH - 150.0, WEST + 250.0, NORTH - 50.0])
    terrain = made.terrain
    assert terrain[Z].shape == (40, 80) and terrain.x[0] == WEST + 51.25
    assert_allclose(terrain[Z].values[7], 1000.0 - 0.4 * (terrain.x.values - WEST), rtol=1e-9)
    assert "adds no detail" in " ".join(made.terrain.attrs["notes"])


def test_nodes_do_not_depend_on_the_window(tmp_path):
    whole = scene(tmp_path, spacing=12.0).terrain
    part = scene(tmp_path, spacing=12.0, window=[WEST + 50.0, NORTH - 150.0, WEST + 250.0, NORTH - 50.0]).terrain
    assert np.isin(part.x, whole.x).all() and np.isin(part.y, whole.y).all()
    assert_allclose(part[Z], whole[Z].sel(x=part.x, y=part.y), rtol=1e-12)


def test_missing_data_do_not_spread(tmp_path):
    write_slope(tmp_path / "dem.tif", holes=[(10, 10, -9999.0)])
    coarse = scene(tmp_path, spacing=10.0).terrain[Z]
    assert np.isfinite(coarse).all() and coarse.min() > 800.0
    fine = scene(tmp_path, spacing=1.0).terrain[Z]
    assert np.isnan(fine).sum() == 25 and fine.min() > 800.0


@pytest.mark.parametrize(
    ("spacing", "words"), [(100.0, "spacing: 100 m makes"), (0.001, "spacing: 0.001 m makes"), (0, "spacing must")]
)
def test_bad_spacings(tmp_path, spacing, words):
    with pytest.raises((InputError, ParameterError), match=words):
        _ = scene(tmp_path, spacing=spacing).terrain


# ---- soil and zones ----


def test_soil_as_number_raster_and_polygons(tmp_path):
    assert (scene(tmp_path, soil_depth=1.5).terrain["soil__depth"] == 1.5).all()
    values = np.full((20, 30), 2.0)
    values[0, 0] = -9999.0
    write_tiff(tmp_path / "soil.tif", values, transform=placed(WEST, NORTH, 10.0, 10.0), nodata=-9999.0)
    made = scene(tmp_path, soil_depth="soil.tif")
    assert at(made.terrain, "soil__depth", 100.0, 100.0) == 2.0 and at(made.terrain, "soil__depth", 2.5, 2.5) == 0.0
    notes = " ".join(made.terrain.attrs["notes"])
    assert "soil_depth: 0 at 4 nodes without data" in notes and "resampled from cells of 10 to 5 m" in notes
    write_shapes(tmp_path / "soil.gpkg", [shapely.Polygon(square(50.0, 50.0, 50.0))], soil_depth=[0.7])
    soil = scene(tmp_path, soil_depth="soil.gpkg").terrain["soil__depth"]
    assert np.count_nonzero(soil) == 100 and soil.max() == 0.7


def test_bad_soil(tmp_path):
    write_shapes(tmp_path / "soil.gpkg", [shapely.Polygon(square(50.0, 50.0, 50.0))], depth=[0.7])
    with pytest.raises(InputError, match=r"attribute soil_depth is missing \(did you mean|there are: depth"):
        _ = scene(tmp_path, soil_depth="soil.gpkg").terrain
    write_slope(tmp_path / "negative.tif", gradient=10.0)
    with pytest.raises(InputError, match=r"soil_depth: values of .*negative.tif must lie in \[0, inf\] m"):
        _ = scene(tmp_path, soil_depth="negative.tif").terrain
    write_slope(tmp_path / "small.tif", columns=30)
    with pytest.raises(InputError, match="does not cover the terrain"):
        _ = scene(tmp_path, soil_depth="small.tif").terrain


def test_zones_change_soil_pressure_and_parameters(tmp_path):
    zones = [
        {"polygons": square(0.0, 0.0, 100.0), "friction": {"basal_friction_angle": 35}, "soil_depth": 0.5},
        {"polygons": square(50.0, 0.0, 100.0), "bed_pressure_ratio": 0.3, "erosion": {"growth_rate": 0.0}},
        {"polygons": square(50.0, 0.0, 50.0), "bed_degree_of_saturation": 0.4},
        {"polygons": square(0.0, 50.0, 100.0), "friction": {"basal_friction_angle": 25.0}},
    ]
    made = scene(
        tmp_path, soil_depth=1.0, zones=zones, laws={"friction": {"law": "voellmy", "basal_friction_angle": 20.0}}
    )
    terrain = made.terrain
    angle = "friction__basal_friction_angle"
    assert [at(terrain, angle, *xy) for xy in ((20.0, 20.0), (20.0, 70.0), (140.0, 20.0))] == [35.0, 25.0, 20.0]
    assert [at(terrain, "soil__depth", *xy) for xy in ((20.0, 20.0), (140.0, 20.0))] == [0.5, 1.0]
    ratio = terrain["bed__excess_pore_pressure_ratio"]
    assert np.count_nonzero(ratio == 0.3) == 400 and np.count_nonzero(ratio == 0.65) == ratio.size - 400
    wet = terrain["bed__degree_of_saturation"]
    assert np.count_nonzero(wet == 0.4) == 100 and np.count_nonzero(wet == 1.0) == wet.size - 100
    told = scene(tmp_path, soil_depth=1.0, bed_pressure_ratio=0.2, zones=zones).terrain
    assert at(told, "bed__excess_pore_pressure_ratio", 20.0, 20.0) == 0.2 and told.attrs["notes"] == []
    told = scene(tmp_path, soil_depth=1.0, bed_degree_of_saturation=0.8, zones=zones).terrain[
        "bed__degree_of_saturation"
    ]
    assert np.count_nonzero(told == 0.4) == 100 and np.count_nonzero(told == 0.8) == told.size - 100
    wet = {"material": {"bed_degree_of_saturation": 0.7, "bed_pressure_ratio": 0.1}}
    told = scene(tmp_path, soil_depth=1.0, zones=zones, laws=wet | {"friction": "voellmy"}).terrain
    assert at(told, "bed__degree_of_saturation", 20.0, 20.0) == 0.7
    assert at(told, "bed__excess_pore_pressure_ratio", 20.0, 20.0) == 0.1
    assert (
        at(terrain, "erosion__growth_rate", 60.0, 20.0) == 0.0
        and at(terrain, "erosion__growth_rate", 20.0, 20.0) == 3e-3
    )
    assert (
        made.setup.friction.basal_friction_angle == angle and made.setup.erosion.growth_rate == "erosion__growth_rate"
    )
    assert Scene.from_mapping(made.to_mapping(), tmp_path).digest() == made.digest()


@pytest.mark.slow
def test_a_flow_reads_the_parameters_of_zones(tmp_path):
    """Friction of 80 degrees in a zone across the way stops a flow on a slope of 22."""
    zones = [{"polygons": place((100.0, 0.0), (300.0, 0.0), (300.0, 200.0), (100.0, 200.0)),
              "friction": {"basal_friction_angle": 80.0}}]  # fmt: skip
    laws = {"friction": {"law": "coulomb", "basal_friction_angle": 10.0}, "erosion": "none", "column": "none",
            "numerics": {"particle_count": 100}}  # fmt: skip
    farthest = []
    for given in ((), zones):
        flow = scene(tmp_path, zones=given, laws=laws).flow()
        flow.run_one_step(12.0)
        x = flow.grid.x_of_node[flow.grid.at_node["debris_flow__max_depth"] > 0.05]
        farthest.append(x.max() - WEST)
    assert farthest[0] > 200.0 and 100.0 < farthest[1] < 150.0


def test_parameters_as_rasters(tmp_path):
    values = np.full((40, 60), 30.0)
    values[:, :10], values[0, -1] = 20.0, -9999.0
    write_tiff(tmp_path / "angle.tif", values, transform=placed(WEST, NORTH, 5.0, 5.0), nodata=-9999.0)
    laws = {"friction": {"law": "coulomb", "basal_friction_angle": "angle.tif"}}
    made = scene(tmp_path, laws=laws)
    found = made.terrain["friction__basal_friction_angle"].values
    assert_array_equal(found[:, :10], 20.0)
    assert found[-1, -1] == pytest.approx(np.degrees(np.arctan(0.6))) and "at 1 nodes without data" in made.notes[0]
    assert made.setup.friction.basal_friction_angle == "friction__basal_friction_angle"
    write_tiff(tmp_path / "angle.tif", 5.0 * values, transform=placed(WEST, NORTH, 5.0, 5.0))
    with pytest.raises(InputError, match=r"angle.tif: basal_friction_angle must lie in \[0, 89\] deg, got"):
        _ = scene(tmp_path, laws=laws).terrain


@pytest.mark.parametrize(
    ("zone", "words"),
    [
        ({"friction": {"velocity_profile": "linear"}}, "velocity_profile may not vary in space.*basal_friction_angle"),
        ({"friction": {"basal_friction_angel": 30}}, r"did you mean 'basal_friction_angle'\?"),
        (
            {"friction": {"basal_friction_angle": 95}},
            r"zones\[0\]: friction: basal_friction_angle must lie in \[0, 89\] deg",
        ),
        ({"friction": {"basal_friction_angle": "high"}}, "must be a number"),
        ({"friction": 35}, "a mapping of words"),
        ({"soil_depth": -1.0}, r"soil_depth must lie in \[0, inf\] m"),
        ({"bed_degree_of_saturation": 1.5}, r"bed_degree_of_saturation must lie in \[0, 1\], got 1.5"),
        ({"bed_degree_of_saturation": "wet"}, "bed_degree_of_saturation must be a number"),
        ({}, "give soil_depth, bed_pressure_ratio, bed_degree_of_saturation, friction or erosion"),
        ({"soil": 1.0}, "unknown key 'soil'"),
    ],
)
def test_bad_zones(tmp_path, zone, words):
    with pytest.raises(ParameterError, match=words):
        scene(tmp_path, zones=[{"polygons": square(0.0, 0.0, 50.0)} | zone])


def test_a_zone_outside_of_the_dem_is_refused(tmp_path):
    with pytest.raises(InputError, match="wholly outside the DEM"):
        _ = scene(tmp_path, zones=[{"polygons": square(900.0, 0.0, 50.0), "soil_depth": 1.0}]).terrain


def test_a_reference_system_that_contradicts_the_dem(tmp_path):
    with pytest.raises(InputError, match=r"dem.tif is in EPSG:32633.*leave it out"):
        _ = scene(tmp_path, crs="EPSG:32632").terrain
    assert scene(tmp_path, crs="EPSG:32633").terrain.attrs["crs_wkt"]
