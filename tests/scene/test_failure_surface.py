"""A body that fails within an outline keeps its volume, and leaves a scar that can empty."""

import itertools
import math

import numpy as np
import pytest
from landlab import RasterModelGrid
from numpy.testing import assert_allclose, assert_array_equal

from landlab_debrisflow import DebrisFlow, InputError
from landlab_debrisflow.model.release.sites import find_sites, volume_below_lips
from landlab_debrisflow.scene import failing_depth, failure_surface
from landlab_debrisflow.scene.fall_lines import fall_to_exit, fill_pits
from landlab_debrisflow.scene.outline import read_outline
from landlab_debrisflow.spatial.raster import Raster

KINDS = ("tapered", "sloping_local_base_level", "ellipsoid", "uniform")
EMPTYING = KINDS[:3]
SPACING = (2.0, 3.0)


def plane(degrees=30.0, shape=(30, 40), spacing=(2.0, 2.0), turned=0.0):
    """Return coordinates of nodes, and the elevation of a plane that falls towards `turned` degrees from east [m]."""
    y, x = np.indices(shape) * np.array(spacing)[::-1, None, None]
    towards = math.radians(turned)
    return x, y, -math.tan(math.radians(degrees)) * (x * math.cos(towards) + y * math.sin(towards))


def rough(seed=0, shape=(30, 40)):
    """Return coordinates and elevation of a rough slope with pits, spacing `SPACING` [m]."""
    x, y, z = plane(25.0, shape, SPACING, turned=20.0)
    noise = np.random.default_rng(seed).standard_normal(shape)
    return x, y, z + 1.5 * noise + 2.0 * np.sin(y / 7.0)


def disc(x, y, radius=20.0):
    return np.hypot(x - x.mean(), y - y.mean()) < radius


def volume(depth, spacing=SPACING):
    return float(depth.sum()) * spacing[0] * spacing[1]


def below_lips(inside, elevation, depth, spacing):
    """Return the volume of a release below the lowest ground beside its site [m3], as the model measures it."""
    raster = Raster.from_status(np.zeros(inside.shape, np.uint8), spacing)
    nodes = np.flatnonzero(depth)
    failing = depth.ravel()[nodes]
    sites = find_sites(nodes, failing, raster)
    return volume_below_lips(
        sites, nodes, failing, (elevation - depth).ravel(), np.zeros(inside.size, bool), raster
    )  # fmt: skip


# ---- size ----


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("asked", ["mean_depth", "largest_depth", "volume"])
def test_size_is_kept_to_rounding(kind, asked):
    x, y, z = rough()
    inside = disc(x, y)
    wanted = {"mean_depth": 0.7, "largest_depth": 1.3, "volume": 900.0}[asked]
    depth = failure_surface(inside, z, SPACING, kind=kind, **{asked: wanted})
    got = {
        "mean_depth": depth[inside].mean(), "largest_depth": depth.max(), "volume": volume(depth),
    }[asked]  # fmt: skip
    assert_allclose(got, wanted, rtol=1e-14)
    assert depth.shape == z.shape and np.all(depth >= 0.0) and not depth[~inside].any()


@pytest.mark.parametrize("kind", KINDS)
def test_cells_that_lie_inside_by_a_part_fail_by_a_part(kind):
    x, y, z = plane()
    part = np.clip(20.5 - np.hypot(x - x.mean(), y - y.mean()), 0.0, 1.0)
    depth = failure_surface(part, z, 2.0, kind=kind, mean_depth=0.5)
    assert_allclose(depth.sum(), 0.5 * part.sum(), rtol=1e-14)
    if kind == "uniform":
        assert_allclose(depth, 0.5 * part, rtol=1e-14)
    whole = failure_surface(part > 0.0, z, 2.0, kind=kind, mean_depth=0.5)
    cut = (part > 0.0) & (part < 1.0)
    assert depth[cut].sum() < 0.8 * whole[cut].sum()


# ---- the scar can empty ----


@pytest.mark.parametrize("kind", EMPTYING)
def test_no_floor_lies_below_the_lip_of_rough_ground(kind):
    for seed in range(5):
        x, y, z = rough(seed)
        inside = disc(x, y)
        for largest in (0.5, 2.0, 5.0):
            depth = failure_surface(inside, z, SPACING, kind=kind, largest_depth=largest)
            assert below_lips(inside, z, depth, SPACING) < 1e-12 * volume(depth)
    assert below_lips(inside, z, 5.0 * inside, SPACING) > 0.02 * volume(5.0 * inside)


@pytest.mark.parametrize("kind", EMPTYING)
@pytest.mark.parametrize("turned", [0.0, 30.0, 45.0])
def test_no_floor_of_a_plane_has_a_pit(kind, turned):
    """However deep: each node of the floor has a way down and out."""
    x, y, z = plane(turned=turned)
    inside = disc(x, y)
    for largest in (1.0, 4.0, 8.0):
        floor = z - failure_surface(inside, z, 2.0, kind=kind, largest_depth=largest)
        filled = fill_pits(inside, floor)
        # an ellipsoid that is cut by the exits is level along a fall line, to the rise that fills pits
        assert np.abs(filled - floor).max() < 0.05 * largest


def test_uniform_depth_on_a_plane_has_a_pit():
    x, y, z = plane()
    inside = disc(x, y)
    floor = z - failure_surface(inside, z, 2.0, kind="uniform", mean_depth=2.0)
    lip = 2.0 * math.tan(math.radians(30.0))  # ground falls so far from the last node to the lip
    assert_allclose((fill_pits(inside, floor) - floor).max(), 2.0 - lip, rtol=1e-3)


# ---- tapered ----


@pytest.mark.parametrize(("degrees", "spacing"), [*itertools.product((20.0, 30.0), (1.0, 2.0, 5.0))])
def test_tapered_rim_on_a_plane(degrees, spacing):
    """In closed form: min(d, (1 - floor_fall) tan(theta) s), s the distance to the first node below the outline."""
    size = round(80.0 / spacing)
    x, y, z = plane(degrees, (size, size), (spacing, spacing))
    inside = (abs(x - 40.0) < 20.0) & (abs(y - 40.0) < 20.0)
    depth = failure_surface(inside, z, spacing, largest_depth=1.0)
    beyond = x[inside].max() + spacing
    rim = 0.2 * math.tan(math.radians(degrees)) * (beyond - x)
    assert_allclose(depth, np.where(inside, np.minimum(1.0, rim), 0.0), atol=1e-9)


def test_all_of_a_small_outline_is_rim_and_its_floor_gets_level_at_most():
    x, y, z = plane(20.0, (9, 9), (5.0, 5.0))
    inside = (abs(x - 20.0) < 6.0) & (abs(y - 20.0) < 6.0)  # three by three nodes
    fall = np.where(inside, math.tan(math.radians(20.0)) * (30.0 - x), 0.0)
    for mean in (1.0, 1.5, 3.0):
        depth = failure_surface(inside, z, 5.0, mean_depth=mean)
        assert_allclose(depth, fall * mean / fall[inside].mean(), rtol=1e-9)
    most = fall[inside].mean()
    assert_allclose(failure_surface(inside, z, 5.0, mean_depth=most * (1.0 - 1e-13)), fall, rtol=1e-9)
    for kind in EMPTYING:
        with pytest.raises(InputError, match=r"mean_depth is 3.7, but of this outline no body of more than 3.64 can"):
            failure_surface(inside, z, 5.0, kind=kind, mean_depth=3.7)
    assert failure_surface(inside, z, 5.0, kind="uniform", mean_depth=3.7).max() == pytest.approx(3.7)


def test_fall_of_the_floor_is_that_part_of_the_fall_of_the_ground():
    x, y, z = plane()
    for part in (0.0, 0.5, 0.9):
        depth = failure_surface(disc(x, y), z, 2.0, largest_depth=4.0 * (1.0 - part), floor_fall=part)
        floor, row = z - depth, x.shape[0] // 2
        rim = np.flatnonzero(depth[row])[-2:]  # two nodes above the lip
        assert_allclose(np.diff(floor[row][rim]), part * np.diff(z[row][rim]), atol=1e-6)


# ---- fall lines ----


@pytest.mark.parametrize("turned", [0.0, 17.0, 45.0, 200.0])
def test_fall_to_the_exit_of_a_disc_converges_to_chords(turned):
    errors = []
    for spacing in (2.0, 1.0):
        size = round(60.0 / spacing)
        x, y, z = plane(30.0, (size, size), (spacing, spacing), turned)
        towards = math.radians(turned)
        along = (x - x.mean()) * math.cos(towards) + (y - y.mean()) * math.sin(towards)
        across = -(x - x.mean()) * math.sin(towards) + (y - y.mean()) * math.cos(towards)
        inside = np.hypot(along, across) < 20.0
        chord = np.sqrt(np.maximum(0.0, 400.0 - across**2)) - along
        fall = fall_to_exit(inside, z, (spacing, spacing))
        error = fall / math.tan(math.radians(30.0)) - chord
        errors.append(np.sqrt(np.mean(error[inside] ** 2)))
    assert errors[1] < 0.75 * errors[0] and errors[1] < 1.5  # of chords up to 40 m


def test_pits_are_crossed_where_they_spill_and_walls_are_gone_round():
    x, y, z = plane()
    inside = disc(x, y)
    whole = fall_to_exit(inside, z, (2.0, 2.0))
    dented = z.copy()
    dented[14:17, 18:21] -= 3.0
    fall = fall_to_exit(inside, dented, (2.0, 2.0))
    apart = np.hypot(x - 38.0, y - 30.0) > 8.0
    assert np.abs(fall - whole)[apart].max() < 2.5  # spilling over their lower side
    walled = z.copy()
    walled[:, 30:] = np.nan  # everything below the outline
    cut = inside & (x < 60.0)
    assert fall_to_exit(cut, walled, (2.0, 2.0))[cut].max() < whole.max()
    assert_array_equal(fall_to_exit(cut, np.where(cut, z, np.nan), (2.0, 2.0)), np.zeros(z.shape))


# ---- sloping local base level ----


def lowered_again_and_again(inside, ground, tolerance, sweeps):
    """Return the floor by the words of Jaboyedoff et al. (2004): if the mean less the tolerance is lower, take it."""
    floor = ground.copy()
    for _ in range(sweeps):
        mean = floor.copy()
        mean[1:-1, 1:-1] = 0.25 * (floor[2:, 1:-1] + floor[:-2, 1:-1] + floor[1:-1, 2:] + floor[1:-1, :-2])
        floor = np.where(inside, np.minimum(floor, mean - tolerance), floor)
    return floor


@pytest.mark.parametrize("asked", [{"mean_depth": 0.4}, {"mean_depth": 0.05}])
def test_base_level_is_the_fixed_point_of_the_published_rule(asked):
    x, y, z = plane(shape=(20, 24))
    z = z + 0.6 * np.sin(x / 5.0) * np.cos(y / 6.0)
    inside = disc(x, y, 14.0)
    depth = failure_surface(inside, z, 2.0, kind="sloping_local_base_level", **asked)
    floor = z - depth
    beside = 0.25 * (np.roll(floor, 1, 0) + np.roll(floor, -1, 0) + np.roll(floor, 1, 1) + np.roll(floor, -1, 1))
    tolerance = (beside - floor)[depth > 1e-9].min()
    assert_allclose(floor, lowered_again_and_again(inside, z, tolerance, 3000), atol=1e-9)


def test_base_level_under_a_disc_is_a_paraboloid():
    x, y, z = plane(shape=(60, 60), spacing=(1.0, 1.0))
    inside = disc(x, y, 25.0)
    depth = failure_surface(inside, z, 1.0, kind="sloping_local_base_level", largest_depth=2.0)
    radius2 = (x - x.mean()) ** 2 + (y - y.mean()) ** 2
    assert_allclose(depth[inside], 2.0 * (1.0 - radius2 / 25.0**2)[inside], atol=0.1)  # the rim is one of cells


# ---- ellipsoid ----


def test_ellipsoid_has_axes_and_volume_of_the_outline():
    x, y, z = plane(20.0, (80, 100), (1.0, 1.0))
    turn = math.radians(35.0)
    along = (x - 50.0) * math.cos(turn) + (y - 40.0) * math.sin(turn)
    across = -(x - 50.0) * math.sin(turn) + (y - 40.0) * math.cos(turn)
    inside = (along / 30.0) ** 2 + (across / 15.0) ** 2 < 1.0
    depth = failure_surface(inside, z, 1.0, kind="ellipsoid", largest_depth=1.0)
    exact = np.sqrt(np.maximum(0.0, 1.0 - (along / 30.0) ** 2 - (across / 15.0) ** 2))
    assert_allclose(depth.sum(), 2.0 / 3.0 * math.pi * 30.0 * 15.0, rtol=0.02)
    inner = (along / 30.0) ** 2 + (across / 15.0) ** 2 < 0.8
    assert_allclose(depth[inner], exact[inner], atol=0.02)
    half = failure_surface(inside & (across > 0.0), z, 1.0, kind="ellipsoid", largest_depth=1.0)
    assert not half[across <= 0.0].any()


# ---- what cannot be used ----


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"kind": "taperd"}, r"unknown kind 'taperd' \(did you mean 'tapered'\?\); allowed: tapered, sloping"),
        ({"mean_depth": 1.0, "volume": 5.0}, "give exactly one of mean_depth, largest_depth, volume, got mean_depth, "),
        ({"mean_depth": None}, "give exactly one of mean_depth, largest_depth, volume, got none"),
        ({"mean_depth": -1.0}, r"mean_depth must lie in \(0, inf\) m, got -1.0"),
        ({"mean_depth": np.nan}, r"mean_depth must lie in \(0, inf\) m, got nan"),
        ({"floor_fall": 1.0}, r"floor_fall must lie in \[0, 1\), got 1.0"),
        ({"inside": np.zeros((30, 40))}, "inside must hold at least one node, got 'none'; does the outline lie"),
        ({"inside": np.ones((30, 40))}, "inside must leave out the outermost rows and columns, got 1 at row 0, column"),
        ({"inside": np.full((30, 40), 2.0)}, r"inside must lie in \[0, 1\], got 2 at row 0, column 0; give bool, or"),
        ({"inside": np.ones(1200)}, r"inside must have shape \(rows, columns\), got \(1200,\)"),
        ({"elevation": np.zeros((3, 3))}, r"elevation must have the shape of inside, \(30, 40\), got \(3, 3\)"),
        ({"elevation": np.full((30, 40), np.nan)}, "elevation must be finite inside the outline, got nan at row"),
        ({"elevation": np.zeros((30, 40))}, "no body of more than 0 can leave: the ground falls by 0 m at most"),
        ({"spacing": -1.0}, "spacing must be one or two lengths > 0 m, got -1.0"),
        ({"spacing": (1.0, 2.0, 3.0)}, "spacing must be one or two lengths > 0 m"),
    ],
)
def test_what_cannot_be_used_is_told(changes, message):
    x, y, z = plane()
    arguments = {"inside": disc(x, y), "elevation": z, "spacing": 2.0, "mean_depth": 1.0} | changes
    with pytest.raises(InputError, match=message):
        failure_surface(**arguments)


def test_a_fall_beyond_all_mountains_is_refused():
    x, y, z = plane()
    z[:, :18] = 1e15
    with pytest.raises(InputError, match=r"elevation has a relief of 1e\+15 m, more than any mountain"):
        failure_surface(disc(x, y), z, 2.0, mean_depth=1.0)


def test_arguments_stay_as_they_are():
    x, y, z = plane()
    z[0, 0] = np.inf
    inside, before = disc(x, y), z.copy()
    failure_surface(inside, z, 2.0, mean_depth=0.5)
    assert_array_equal(z, before)
    assert not np.isnan(read_outline(inside, z, 2.0).fall).any()


# ---- on a grid ----


def slope_grid():
    grid = RasterModelGrid((25, 60), xy_spacing=2.0)
    grid.add_field("topographic__elevation", 0.5 * (120.0 - grid.x_of_node), at="node")
    return grid, np.hypot(grid.x_of_node - 30.0, grid.y_of_node - 24.0) < 12.0


@pytest.mark.parametrize("kind", KINDS)
def test_only_the_uniform_one_is_doubted_by_the_component(kind, caplog):
    grid, inside = slope_grid()
    depth = failing_depth(grid, inside, kind=kind, mean_depth=3.0)
    grid.add_field("debris_flow__release_depth", depth.copy(), at="node")
    flow = DebrisFlow(grid, erosion="none", numerics={"particle_count": 50})
    flow.run_one_step(1e-6)
    assert flow.budget["released"] == pytest.approx(3.0 * inside.sum() * 4.0, rel=1e-13)
    assert ("lie below the lowest ground beside their scar" in caplog.text) == (kind == "uniform")


def test_nothing_leaves_over_closed_nodes():
    grid, inside = slope_grid()
    free = failing_depth(grid, inside, largest_depth=1.0)
    grid.status_at_node[(grid.x_of_node > 30.0) & ~inside] = grid.BC_NODE_IS_CLOSED
    assert failing_depth(grid, inside.reshape(grid.shape), largest_depth=1.0).sum() < 0.9 * free.sum()
    with pytest.raises(InputError, match="inside must have a value for each of 1500 nodes, got 3"):
        failing_depth(grid, inside[:3], largest_depth=1.0)


def test_a_depth_too_small_for_a_number_is_refused():
    grid, inside = slope_grid()
    with pytest.raises(InputError, match="e-321, too small for a body; ask for more"):
        failing_depth(grid, inside, largest_depth=1e-320)
