"""Dams, walls, excavations and buildings: as high and as wide as asked, without gaps, and thick enough."""

import numpy as np
import pytest
import shapely
from numpy.testing import assert_allclose, assert_array_equal
from scipy.ndimage import label

from landlab_debrisflow.core.errors import InputError, ParameterError
from landlab_debrisflow.run.scene import Scene

from .dems import NORTH, WEST, place, square, write_shapes, write_slope

Z, SOIL = "topographic__elevation", "soil__depth"
ACROSS = place((150.0, 20.0), (150.0, 180.0))
DIAGONAL = place((60.0, 30.0), (233.0, 171.0))
X, Y = np.meshgrid(5.0 * (np.arange(60) + 0.5), 5.0 * (np.arange(40) + 0.5))
GROUND = 1000.0 - 0.4 * X


def edited(folder, *edits, rows=40, **terrain):
    """Return elevation, soil and closed nodes from north to south, and the notes."""
    if not (folder / "dem.tif").exists():
        write_slope(folder / "dem.tif", rows=rows)
    keys = {"elevation": "dem.tif", "soil_depth": 1.0, "edits": list(edits)} | terrain
    made = Scene.from_mapping({"terrain": keys}, folder).terrain
    closed = made["closed"].values[::-1] if "closed" in made else np.zeros(GROUND.shape, bool)
    return made[Z].values[::-1], made[SOIL].values[::-1], closed, made.attrs["notes"]


def distance_to(line):
    return shapely.distance(shapely.LineString(line), shapely.points(WEST + X, NORTH - Y))


# ---- dams ----


def test_the_crest_of_a_dam_is_reached_exactly(tmp_path):
    z, soil, _, notes = edited(tmp_path, {"dam": ACROSS, "crest_elevation": 948.0, "crest_width": 6.0})
    crest = distance_to(ACROSS) <= 3.0
    assert_array_equal(z[crest], 948.0)
    side = 948.0 - (distance_to(ACROSS) - 0.5 * np.hypot(5.0, 5.0)) * (2.0 / 3.0)
    expected = np.maximum(GROUND, np.where(distance_to(ACROSS) <= 0.5 * np.hypot(5.0, 5.0), 948.0, side))
    assert_allclose(z, expected, rtol=1e-12)
    assert_array_equal(soil, np.where(z > GROUND, 0.0, 1.0))
    assert "m3 on" in notes[-1] and "crest widened from 6 to 7.07 m" in notes[-1]
    volume = float(notes[-1].split(": ")[-1].split()[0])
    assert volume == pytest.approx((z - GROUND).sum() * 25.0, rel=1e-3)


@pytest.mark.parametrize("across", [place((150.0, 0.0), (150.0, 200.0)), place((40.0, 0.0), (255.0, 200.0))])
@pytest.mark.parametrize("kind", ["dam", "wall"])
def test_a_crest_has_no_gap(tmp_path, across, kind):
    """No way along nodes that share a side or a corner leads through it below the crest."""
    width = {"dam": {"crest_width": 1.0}, "wall": {}}[kind]
    z, *_ = edited(tmp_path, {kind: across, "crest_elevation": 1100.0, **width})
    areas, count = label(z < 1100.0, np.ones((3, 3)))
    assert areas[-1, 0] != areas[0, -1] and count == 2


def test_a_crest_follows_the_ground_along_its_line(tmp_path):
    z, *_ = edited(tmp_path, {"dam": DIAGONAL, "crest_height": 6.0, "slope": 45.0})
    line = shapely.LineString(DIAGONAL)
    points = shapely.points(WEST + X, NORTH - Y)
    nearest = shapely.line_interpolate_point(line, shapely.line_locate_point(line, points))
    crest = shapely.distance(line, points) <= 2.5
    assert_allclose(z[crest], 1000.0 - 0.4 * (shapely.get_x(nearest[crest]) - WEST) + 6.0, atol=1e-9)


def test_sides_that_never_meet_the_ground_are_said(tmp_path):
    """Sides of 24 degrees on ground of 22."""
    *_, notes = edited(tmp_path, {"dam": ACROSS, "crest_height": 4.0, "slope": 24.0})
    assert "give a steeper slope" in notes[-1]
    *_, notes = edited(tmp_path, {"dam": ACROSS, "crest_height": 4.0, "slope": 60.0})
    assert "steeper" not in notes[-1]


def test_a_dam_below_the_ground_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"edits\[0\]: dam.*no node is raised, the crest \(100 to 100 m\) lies below"):
        edited(tmp_path, {"dam": ACROSS, "crest_elevation": 100.0})


def test_a_dam_of_a_few_nodes_is_refused_with_a_spacing(tmp_path):
    small = place((150.0, 100.0), (154.0, 100.0))
    with pytest.raises(InputError, match=r"is nowhere 3 nodes thick .*a spacing of at most"):
        edited(tmp_path, {"dam": small, "crest_height": 0.5, "crest_width": 1.0})


def test_a_line_far_longer_than_the_terrain_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"edits\[0\]: dam.* is 5e\+07 m long, the terrain has 360.6 m from corner"):
        edited(tmp_path, {"dam": [place((150.0, 20.0))[0], [WEST - 5e7, NORTH - 20.0]], "crest_height": 5.0})


# ---- walls ----


def test_a_wall_is_upright_and_three_nodes_thick(tmp_path):
    z, soil, closed, _ = edited(tmp_path, {"wall": place((150.0, 20.0), (150.0, 180.0)), "crest_height": 4.0})
    raised = z > GROUND + 1e-9
    middle = raised[10:30]
    assert np.all(middle.sum(axis=1) >= 3) and not closed.any()
    assert_array_equal(middle, (distance_to(ACROSS) <= 7.5 + 1e-9)[10:30])
    assert_allclose(z[10:30][middle], 1000.0 - 0.4 * 150.0 + 4.0)
    assert_array_equal(soil == 0.0, raised)


def test_a_thin_wall_is_refused_with_the_spacing_that_would_do(tmp_path):
    thin = {"wall": ACROSS, "crest_height": 4.0, "crest_width": 6.0}
    with pytest.raises(InputError, match=r"6 m thick, less than 3 nodes of 5 m.*a spacing of at most 2 m"):
        edited(tmp_path, thin)
    write_slope(tmp_path / "fine.tif", rows=100, columns=150, spacing=2.0)
    made = Scene.from_mapping({"terrain": {"elevation": "fine.tif", "edits": [thin]}}, tmp_path).terrain
    x = 2.0 * (np.arange(150) + 0.5)
    assert np.all((made[Z].values[40:60] > 1000.0 - 0.4 * x + 1e-9).sum(axis=1) >= 3)


@pytest.mark.slow
def test_a_wall_that_is_overtopped(tmp_path):
    """A wall of 1 m in the way of 3 m: it is ground, and flow gets over."""
    write_slope(tmp_path / "dem.tif", rows=16, columns=60)
    wall = {"wall": place((120.0, -10.0), (120.0, 90.0)), "crest_height": 1.0}
    mapping = {
        "terrain": {"elevation": "dem.tif", "edits": [wall]},
        "release": {"polygons": square(30.0, 25.0, 30.0), "depth": 3.0},
        "friction": {"law": "coulomb", "basal_friction_angle": 10.0}, "erosion": "none", "column": "none",
        "numerics": {"particle_count": 100},
    }  # fmt: skip
    flow = Scene.from_mapping(mapping, tmp_path).flow()
    flow.run_one_step(12.0)
    reached = flow.grid.x_of_node[flow.grid.at_node["debris_flow__max_depth"] > 0.05]
    assert reached.max() > WEST + 160.0


# ---- excavations ----


def test_an_excavation_with_sloping_sides(tmp_path):
    hole = square(100.0, 50.0, 60.0)
    z, soil, _, notes = edited(tmp_path, {"excavation": hole, "depth": 3.0, "slope": 30.0}, soil_depth=2.0)
    inside = (X > 100.0) & (X < 160.0) & (Y > 50.0) & (Y < 110.0)
    inward = np.minimum.reduce([X - 100.0, 160.0 - X, Y - 50.0, 110.0 - Y])
    cut = np.where(inside, np.minimum(3.0, inward * np.tan(np.radians(30.0))), 0.0)
    assert_allclose(z, GROUND - cut, rtol=1e-9)
    assert_allclose(soil, np.maximum(2.0 - cut, 0.0), atol=1e-9)
    assert f"{cut.sum() * 25.0:.0f} m3 dug out, up to 3 m deep" in notes[-1]


def test_an_excavation_to_a_level_floor(tmp_path):
    z, *_ = edited(tmp_path, {"excavation": square(100.0, 50.0, 60.0), "floor_elevation": 940.0, "slope": 90})
    inside = (X > 100.0) & (X < 160.0) & (Y > 50.0) & (Y < 110.0)
    assert_allclose(z, np.where(inside, np.minimum(GROUND, 940.0), GROUND))
    with pytest.raises(InputError, match="nothing is dug"):
        edited(tmp_path, {"excavation": square(100.0, 50.0, 60.0), "floor_elevation": 990.0})


# ---- buildings ----


def test_buildings_are_closed_or_raised(tmp_path):
    houses = [shapely.Polygon(square(100.0, 50.0, 20.0)), shapely.Polygon(square(100.0, 120.0, 20.0))]
    write_shapes(tmp_path / "houses.gpkg", houses, height=[np.nan, 7.0])
    z, soil, closed, notes = edited(tmp_path, {"buildings": "houses.gpkg"})
    first = (X > 100.0) & (X < 120.0) & (Y > 50.0) & (Y < 70.0)
    second = (X > 100.0) & (X < 120.0) & (Y > 120.0) & (Y < 140.0)
    assert_array_equal(closed, first)
    assert_allclose(z, np.where(second, 1000.0 - 0.4 * 102.5 + 7.0, GROUND))
    assert_array_equal(soil == 0.0, first | second)
    assert notes[-1] == "edits[0]: buildings: 1 are closed nodes, 1 are raised ground"
    grid = Scene.from_mapping(
        {"terrain": {"elevation": "dem.tif", "edits": [{"buildings": "houses.gpkg"}]}}, tmp_path
    ).grid()
    assert_array_equal((grid.status_at_node == grid.BC_NODE_IS_CLOSED).reshape(40, 60)[::-1], first)


def test_thin_buildings_are_refused_or_left_out(tmp_path):
    houses = [shapely.Polygon(square(100.0, 50.0, 20.0)), shapely.Polygon(square(100.0, 120.0, 9.0))]
    write_shapes(tmp_path / "houses.gpkg", houses)
    with pytest.raises(InputError, match=r"1 of 2 buildings.* feature 2.*a spacing of 2.1 m would do"):
        edited(tmp_path, {"buildings": "houses.gpkg"})
    *_, closed, notes = edited(tmp_path, {"buildings": "houses.gpkg", "thin": "leave_out"})
    assert closed.sum() == 16 and "1 thinner than 3 nodes are left out" in notes[-1]


@pytest.mark.parametrize("angle", range(0, 90, 7))
def test_the_spacing_that_would_do_does(tmp_path, angle):
    """Of a square building of 9 m, however it is turned."""
    write_slope(tmp_path / "dem.tif", rows=60, columns=60, spacing=2.1)
    house = shapely.affinity.rotate(shapely.Polygon(square(60.0 + 0.1 * angle, 60.0, 9.0)), angle)
    write_shapes(tmp_path / "house.gpkg", [house])
    made = Scene.from_mapping({"terrain": {"elevation": "dem.tif", "edits": [{"buildings": "house.gpkg"}]}}, tmp_path)
    assert made.terrain["closed"].sum() >= 9


# ---- all ----


def test_edits_are_made_in_order(tmp_path):
    dam = {"dam": ACROSS, "crest_elevation": 948.0}
    gap = {"excavation": square(140.0, 90.0, 20.0), "floor_elevation": 930.0, "slope": 90}
    z, *_ = edited(tmp_path, dam, gap)
    gone = (X > 140.0) & (X < 160.0) & (Y > 90.0) & (Y < 110.0)
    assert_allclose(z[gone], 930.0)
    z, *_ = edited(tmp_path, gap, dam)
    assert_allclose(z[gone & (distance_to(ACROSS) <= 2.5)], 948.0)


def test_edits_outside_of_the_window_are_said(tmp_path):
    window = [WEST, NORTH - 200.0, WEST + 100.0, NORTH]
    edits = [
        {"dam": ACROSS, "crest_elevation": 948.0}, {"excavation": square(200.0, 50.0, 20.0), "depth": 1.0},
        {"buildings": square(200.0, 50.0, 20.0)},
    ]  # fmt: skip
    write_slope(tmp_path / "dem.tif")
    keys = {"elevation": "dem.tif", "window": window, "edits": edits}
    notes = Scene.from_mapping({"terrain": keys}, tmp_path).terrain.attrs["notes"]
    assert sum("lies outside of the window, nothing is changed" in note for note in notes) == 3


def test_nodes_without_data_stay_without(tmp_path):
    write_slope(tmp_path / "dem.tif", holes=[(20, 29, -9999.0), (20, 30, -9999.0), (12, 21, -9999.0)])
    edits = [
        {"dam": ACROSS, "crest_height": 5.0}, {"excavation": square(90.0, 50.0, 40.0), "depth": 1.0},
        {"buildings": square(90.0, 50.0, 40.0), "height": 4.0},
    ]  # fmt: skip
    z, *_ = edited(tmp_path, *edits)
    assert np.isnan(z).sum() == 3 and np.nanmax(z) < 1000.0


@pytest.mark.parametrize(
    ("edit", "words"),
    [
        ({"dam": ACROSS}, "dam needs either crest_elevation"),
        ({"dam": ACROSS, "crest_elevation": 1.0, "crest_height": 1.0}, "needs either"),
        ({"dam": ACROSS, "crest_height": 1.0, "depth": 1.0}, "depth belongs to excavation, not to dam"),
        ({"dam": ACROSS, "wall": ACROSS, "crest_height": 1.0}, "exactly one of .* got dam and wall"),
        ({"crest_height": 1.0}, "exactly one of .* got none"),
        ({"dam": ACROSS, "crest_height": 0.0}, "crest_height must"),
        ({"dam": [[1.0, 2.0]], "crest_height": 1.0}, "at least 2 pairs|a line"),
        ({"dams": ACROSS}, r"did you mean 'dam'\?"),
        ({"excavation": square(0.0, 0.0, 9.0), "depth": 1.0, "floor_elevation": 2.0}, "needs either depth"),
        ({"buildings": square(0.0, 0.0, 9.0), "thin": "drop"}, "one of refuse, leave_out"),
    ],
)
def test_bad_keys(tmp_path, edit, words):
    with pytest.raises(ParameterError, match=words):
        edited(tmp_path, edit)


@pytest.mark.parametrize(
    ("edit", "words"),
    [
        ({"dam": "none.gpkg", "crest_height": 1.0}, "there is no such file"),
        ({"dam": "house.gpkg", "crest_height": 1.0}, "is a Polygon, a line is needed"),
        ({"buildings": "house.gpkg", "height": 3.0}, "height must be a number"),
        ({"excavation": square(900.0, 0.0, 9.0), "depth": 1.0}, "wholly outside the DEM"),
        ({"excavation": square(101.0, 101.0, 1.0), "depth": 1.0}, "no node lies inside, nodes are 5 m apart"),
    ],
)
def test_bad_files(tmp_path, edit, words):
    write_shapes(tmp_path / "house.gpkg", [shapely.Polygon(square(100.0, 50.0, 20.0))], height=["tall"])
    with pytest.raises(InputError, match=rf"edits\[0\]: \w+: .*{words}"):
        edited(tmp_path, edit)
