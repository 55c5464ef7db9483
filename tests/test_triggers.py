"""Landslides of other components as the release of a debris flow."""

import numpy as np
import pytest
from landlab import RasterModelGrid
from landlab.components import BedrockLandslider, LandslideProbability, PriorityFloodFlowRouter

from landlab_debrisflow import DebrisFlow, InputError
from landlab_debrisflow.triggers import release_bedrock_landslides, release_probable_sites
from validation.grids import COARSE, changed_fields, copy_fields, inclined

Z, SOIL, ROCK, RELEASE = "topographic__elevation", "soil__depth", "bedrock__elevation", "debris_flow__release_depth"
PROBABILITY, EROSION = "landslide__probability_of_failure", "landslide__erosion"

# ---- probable sites ----


def likely(*sites, shape=(8, 12), spacing=(10.0, 5.0), soil=1.5):
    """Return a grid with a probability of failure at some rows and columns: (rows, columns, probability) for each."""
    grid = RasterModelGrid(shape, xy_spacing=spacing)
    grid.add_field(Z, 50.0 - 0.5 * grid.x_of_node, at="node")
    if soil is not None:
        grid.add_full(SOIL, soil, at="node")
    values = grid.add_zeros(PROBABILITY, at="node").reshape(grid.shape)
    for rows, columns, probability in sites:
        values[rows, columns] = probability
    return grid


def released(grid):
    return grid.at_node[RELEASE].reshape(grid.shape)


def test_sites_above_the_threshold_fail_as_deep_as_the_soil():
    grid = likely((slice(1, 3), slice(1, 4), 0.5), (5, 7, 0.499))
    assert release_probable_sites(grid) == 6 * 1.5 * 50.0
    assert np.all(released(grid)[1:3, 1:4] == 1.5) and np.count_nonzero(released(grid)) == 6


def test_small_sites_stay_and_diagonals_do_not_join():
    """Two nodes and one that touches them at a corner; a site of three is just large enough."""
    grid = likely((2, slice(2, 4), 0.9), (3, 4, 0.9), (5, slice(5, 8), 0.9))
    assert release_probable_sites(grid, least_area=150.0, depth=1.0) == 3 * 1.0 * 50.0
    assert np.flatnonzero(released(grid).any(axis=1)).tolist() == [5]


@pytest.mark.parametrize("depth", [0.4, np.full(96, 0.4), np.full((8, 12), 0.4), "thickness", np.float32(0.4)])
def test_depth_as_number_array_or_field_is_limited_to_the_soil(depth):
    grid = likely((2, slice(2, 4), 0.9))
    grid.add_full("thickness", 0.4, at="node")
    grid.at_node[SOIL].reshape(grid.shape)[2, 3] = 0.1
    release_probable_sites(grid, depth=depth)
    assert released(grid)[2, 2:4] == pytest.approx([0.4, 0.1])


def test_without_a_field_of_soil_the_depth_is_as_given():
    grid = likely((2, 2, 0.9), soil=None)
    assert release_probable_sites(grid, depth=2.0) == 100.0
    with pytest.raises(InputError, match="the grid has no soil__depth, the thickness that fails by default; add it"):
        release_probable_sites(grid)


def test_bare_rock_divides_sites_and_boundaries_never_fail():
    grid = likely((slice(None), 4, 1.0))
    grid.at_node[SOIL].reshape(grid.shape)[3, 4] = 0.0
    grid.status_at_node[5 * 12 + 4] = grid.BC_NODE_IS_CLOSED
    release_probable_sites(grid, least_area=100.0)
    assert np.flatnonzero(released(grid)[:, 4]).tolist() == [1, 2]  # 4 and 6 are alone, 0 and 7 are on the boundary


def test_a_mask_is_a_probability():
    grid = likely()
    mask = np.zeros(grid.shape, bool)
    mask[2, 3:5] = True
    assert release_probable_sites(grid, mask) == 150.0 == release_probable_sites(grid, mask.ravel().astype(int))


def test_what_stands_in_the_field_stays_where_it_is_deeper():
    grid = likely((2, slice(2, 5), 0.9))
    grid.add_zeros(RELEASE, at="node")
    released(grid)[2, 1:4] = 0.1, 1.2, 0.2
    assert release_probable_sites(grid, depth=0.5) == pytest.approx(50.0 * (0.1 + 1.2 + 0.5 + 0.5))
    assert released(grid)[2, 1:5] == pytest.approx([0.1, 1.2, 0.5, 0.5])


def test_nodes_that_are_not_core_may_hold_anything():
    grid = likely((2, 2, 0.9))
    grid.at_node[PROBABILITY][0], grid.at_node[PROBABILITY][5], grid.at_node[SOIL][3] = np.nan, -9999.0, -9999.0
    assert release_probable_sites(grid) == 75.0


@pytest.mark.slow
def test_sites_are_drawn_as_wholes_and_as_often_as_they_are_likely():
    grid = likely((slice(1, 3), slice(1, 3), 0.2), (slice(4, 6), slice(1, 3), 0.6), (slice(4, 6), slice(5, 9), 0.9))
    grid.at_node[PROBABILITY].reshape(grid.shape)[4, 1:3] = 1.0  # 0.8 on average
    draws, failed = np.random.default_rng(5), np.zeros((1000, 3))
    for row in failed:
        grid.at_node[RELEASE] = np.zeros(96)
        volume = release_probable_sites(grid, threshold=0.1, seed=draws)
        sites = [released(grid)[rows, columns] for rows, columns in (
            (slice(1, 3), slice(1, 3)), (slice(4, 6), slice(1, 3)), (slice(4, 6), slice(5, 9)))]  # fmt: skip
        assert all(len(np.unique(site)) == 1 for site in sites)
        row[:] = [site.max() > 0.0 for site in sites]
        assert volume == pytest.approx(sum(site.sum() for site in sites) * 50.0)
    # the standard deviation of a mean of 1000 is 0.013 at most: three of them
    assert failed.mean(axis=0) == pytest.approx([0.2, 0.8, 0.9], abs=0.04)


def test_a_seed_draws_the_same_again_and_a_generator_goes_on():
    sites = [(1 + 2 * (k // 5), 1 + 2 * (k % 5), 0.5) for k in range(15)]

    def draw(seed):
        grid = likely(*sites)
        release_probable_sites(grid, seed=seed)
        return released(grid).tobytes()

    assert draw(3) == draw(3) != draw(4)
    generator = np.random.default_rng(3)
    assert draw(3) == draw(generator) != draw(generator)


@pytest.mark.parametrize(
    ("keywords", "said"),
    [
        ({"probability": "landslide_probability_of_failure"}, r"did you mean 'landslide__probability_of_failure'\?"),
        ({"probability": "slope"}, "does not have at its nodes; run LandslideProbability first, or name another field"),
        ({"probability": np.full(96, 2.0)}, r"probability must lie in \[0, 1\], got 2 at node 13 \(row 1, column 1\)"),
        ({"probability": np.full(96, np.nan)}, r"probability must lie in \[0, 1\], got nan at node 13"),
        ({"probability": np.zeros(95)}, r"probability has the shape \(95,\), the grid 96 nodes in \(8, 12\)"),
        ({"probability": object()}, "probability must be the name of a field or numbers at nodes"),
        ({"threshold": 0.0}, r"threshold must lie in \(0, 1\], got 0"),
        ({"threshold": 50}, r"threshold must lie in \(0, 1\], got 50"),
        ({"threshold": "0.5"}, "threshold must be a number, got '0.5'; give the number 0.5 without quotes"),
        ({"threshold": True}, "threshold must be a number, got True"),
        ({"depth": -1.0}, "depth must be a thickness >= 0 m, got -1 at node 13"),
        ({"depth": np.full(96, -9999.0)}, "depth must be a thickness >= 0 m, got -9999 at node 13"),
        ({"depth": "soil_depth"}, r"did you mean 'soil__depth'\?"),
        ({"depth": np.nan}, "depth must be a thickness >= 0 m, got nan"),
        ({"least_area": -1.0}, r"least_area must lie in \[0, inf\] m2, got -1"),
        ({"seed": "a"}, "seed must be a whole number >= 0 or a numpy Generator, got 'a'"),
        ({"seed": -1}, "seed must be a whole number >= 0"),
    ],
)
def test_what_cannot_be_used_is_refused_and_changes_nothing(keywords, said):
    grid = likely((2, 2, 0.9))
    before = copy_fields(grid)
    with pytest.raises(InputError, match=said):
        release_probable_sites(grid, **keywords)
    assert not changed_fields(grid, before)


def test_a_grid_of_another_kind_or_a_field_of_another_type_is_refused():
    with pytest.raises(InputError, match="a release needs a RasterModelGrid, got ndarray"):
        release_probable_sites(np.zeros(3))
    grid = likely((2, 2, 0.9))
    grid.add_zeros(RELEASE, at="node", dtype=int)
    with pytest.raises(InputError, match="debris_flow__release_depth must have the dtype float64, got int64"):
        release_probable_sites(grid)


@pytest.mark.slow
def test_the_map_of_landlabs_component_triggers_a_flow():
    grid = inclined((20, 80), 5.0, 0.6, soil=1.0, foot=150.0)
    wet = (abs(grid.x_of_node - 40.0) < 12.0) & (abs(grid.y_of_node - 48.0) < 12.0)
    fields = {
        "topographic__slope": 0.6, "topographic__specific_contributing_area": np.where(wet, 5000.0, 1.0),
        "soil__transmissivity": 5.0, "soil__saturated_hydraulic_conductivity": 0.0, "soil__density": 2000.0,
        "soil__mode_total_cohesion": 2000.0, "soil__minimum_total_cohesion": 1000.0,
        "soil__maximum_total_cohesion": 3000.0, "soil__internal_friction_angle": 35.0, "soil__thickness": 1.0,
    }  # fmt: skip
    for name, values in fields.items():
        grid.add_field(name, np.broadcast_to(values, grid.number_of_nodes).astype(float), at="node")
    slopes = LandslideProbability(grid, number_of_iterations=50, seed=1)
    slopes.calculate_landslide_probability()
    volume = release_probable_sites(grid, threshold=0.5, least_area=100.0)
    assert volume == np.count_nonzero(wet) * 25.0
    flow = DebrisFlow(grid, numerics=COARSE)
    assert flow.run_until_rest() is True and flow.budget["released"] == pytest.approx(volume, rel=1e-14)


# ---- bedrock landslides ----


def cliff(soil=1.0, closed=(), **keywords):
    """Return a slope above a river, its router, and the component that lets it fail; soil of varying depth on rock."""
    grid = RasterModelGrid((12, 14), xy_spacing=10.0)
    x, y = grid.x_of_node, grid.y_of_node
    rock = 0.05 * x + 1.6 * np.clip(y - 20.0, 0.0, 50.0) + np.random.default_rng(2).uniform(0.0, 2.0, x.size)
    grid.add_field(SOIL, soil * (1.0 + 0.5 * np.sin(x / 20.0)), at="node")
    grid.add_field(ROCK, rock, at="node")
    grid.add_field(Z, rock + grid.at_node[SOIL], at="node")
    grid.status_at_node[list(closed)] = grid.BC_NODE_IS_CLOSED
    router = PriorityFloodFlowRouter(grid, separate_hill_flow=True, suppress_out=True)
    router.run_one_step()
    usual = {"landslides_return_time": 1.0, "angle_int_frict": 0.8, "cohesion_eff": 1e3, "seed": 3}
    return grid, BedrockLandslider(grid, **usual | keywords)


def on_a_copy(**keywords):
    """Return the same ground before and after the component has run by itself, with its run-out."""
    grid, landslider = cliff(**keywords)
    before = copy_fields(grid)
    landslider.run_one_step(10.0)
    return before, copy_fields(grid), landslider


@pytest.mark.parametrize("phi", [0.0, 0.3])
def test_what_fails_is_what_the_component_erodes_and_its_run_out_is_taken_back(phi):
    twice = {"phi": phi, "critical_sliding_nodes": [76, 34], "threshold_slope": 3.0}  # the second undercuts the first
    before, after, alone = on_a_copy(**twice)
    deposit = after["landslide__deposition"]
    assert deposit[after[EROSION] > 0.0].max() > 0.5  # it has run out, and partly onto what failed
    assert abs(before[Z] - after[Z] + deposit - after[EROSION])[after[EROSION] > 0.0].max() > 0.5
    grid, landslider = cliff(**twice)
    core = grid.status_at_node == 0
    volume = release_bedrock_landslides(landslider, 10.0)
    failed = before[Z] - after[Z] + deposit
    # elevations of 80 m, four operations on them
    failed[(after[EROSION] == 0.0) | ~core] = 0.0
    np.testing.assert_allclose(grid.at_node[RELEASE], failed, atol=1e-13)
    assert volume == pytest.approx(grid.at_node[RELEASE].sum() * 100.0, rel=1e-14)
    assert landslider.landslides_size == alone.landslides_size
    for name in ("landslide__deposition", "LS_sediment__flux", "landslide_sediment_point_source"):
        assert not grid.at_node[name].any()
    assert grid.at_node[Z].tobytes() == before[Z].tobytes()
    assert grid.at_node[ROCK] == pytest.approx(np.where(core, after[ROCK], before[ROCK]), abs=1e-13)
    together(grid)


def together(grid):
    assert abs(grid.at_node[Z] - grid.at_node[ROCK] - grid.at_node[SOIL]).max() < 1e-12
    assert np.all(grid.at_node[RELEASE] <= grid.at_node[SOIL])


def test_broken_rock_takes_more_room():
    grid, landslider = cliff()
    rock = grid.at_node[ROCK].copy()
    solid = release_bedrock_landslides(landslider, 10.0)
    lost = (rock - grid.at_node[ROCK]).sum() * 100.0
    assert lost > 0.5 * solid
    grid, landslider = cliff()
    z = grid.at_node[Z].copy()
    broken = release_bedrock_landslides(landslider, 10.0, porosity=0.4)
    assert broken - solid == pytest.approx(lost * (1.0 / 0.6 - 1.0), rel=1e-12)
    assert (grid.at_node[Z] - z).sum() * 100.0 == pytest.approx(broken - solid, rel=1e-10)
    together(grid)


@pytest.mark.slow
def test_a_flow_takes_what_failed_and_leaves_ground_together():
    grid, landslider = cliff(closed=(5 * 14 + 6, 5 * 14 + 7))
    z = grid.at_node[Z].copy()
    volume = release_bedrock_landslides(landslider, 10.0, porosity=0.3)
    scar = grid.at_node[Z] - grid.at_node[RELEASE]
    flow = DebrisFlow(grid, erosion="none", numerics=COARSE)
    flow.run_one_step(1e-9)
    assert flow.budget["released"] == pytest.approx(volume, rel=1e-14)  # two sums of the same depths
    np.testing.assert_allclose(grid.at_node[Z], scar, rtol=0.0, atol=1e-13)
    assert np.all(scar <= z + 1e-13)
    assert flow.run_until_rest() is True
    together(grid)


def test_years_without_a_landslide_change_nothing():
    grid, landslider = cliff(landslides_return_time=1e12)
    before = copy_fields(grid)
    assert release_bedrock_landslides(landslider, 1.0) == 0.0
    assert changed_fields(grid, before) == {RELEASE} and not grid.at_node[RELEASE].any()


def test_boundary_nodes_are_not_released():
    before, after, _ = on_a_copy()
    grid, landslider = cliff()
    edge = grid.status_at_node != 0
    assert after[EROSION][edge].any()  # the component lets them fail by default
    release_bedrock_landslides(landslider, 10.0)
    for name in (Z, SOIL, ROCK):
        assert grid.at_node[name][edge].tobytes() == before[name][edge].tobytes()


def test_a_component_that_fails_leaves_the_ground_as_it_was(monkeypatch):
    grid, landslider = cliff()
    before = copy_fields(grid)
    monkeypatch.setattr(landslider, "_landslide_runout", lambda dt: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        release_bedrock_landslides(landslider, 10.0)
    assert changed_fields(grid, before) == {EROSION}


@pytest.mark.parametrize(
    ("keywords", "said"),
    [
        ({"dt": 0.0}, r"dt must lie in \(0, inf\), got 0"),
        ({"dt": "1"}, "dt must be a number, got '1'; give the number 1.0 without quotes"),
        ({"porosity": 1.0}, r"porosity must lie in \[0, 1\), got 1"),
    ],
)
def test_bad_arguments_are_refused_and_change_nothing(keywords, said):
    grid, landslider = cliff()
    before = copy_fields(grid)
    with pytest.raises(InputError, match=said):
        release_bedrock_landslides(landslider, **{"dt": 1.0} | keywords)
    assert not changed_fields(grid, before)


def test_another_component_is_refused():
    grid, landslider = cliff()
    with pytest.raises(InputError, match=r"landslider must be a BedrockLandslider, got Raster"):
        release_bedrock_landslides(grid, 1.0)
    grid.delete_field("node", EROSION)
    with pytest.raises(InputError, match=r"got BedrockLandslider, and its grid has no landslide__erosion"):
        release_bedrock_landslides(landslider, 1.0)
    flow = DebrisFlow(likely())
    with pytest.raises(InputError, match=r"got DebrisFlow, and its grid has no bedrock__elevation, landslide__erosion"):
        release_bedrock_landslides(flow, 1.0)
