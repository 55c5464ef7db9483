"""What is computed though it is hardly meant is said once, with a suggestion."""

import logging

import numpy as np
import pytest
from landlab import RasterModelGrid

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.grid import doubts
from validation.grids import COARSE, copy_fields, inclined, release_slab

Z, SOIL, RELEASE, IDS = "topographic__elevation", "soil__depth", "debris_flow__release_depth", "mass__wasting_id"


@pytest.fixture
def said(caplog):
    """Build a flow, let what fails appear, twice, and return what was logged."""
    caplog.set_level(logging.WARNING, "landlab_debrisflow")

    def run(grid, **keywords):
        caplog.clear()
        flow = DebrisFlow(grid, **{"numerics": COARSE} | keywords)
        for _ in range(2):
            flow.run_one_step(1e-6)
            grid.at_node[RELEASE][grid.number_of_nodes // 2 + 30] = 1e-3
        assert all(record.levelno == logging.WARNING for record in caplog.records)
        others = "a pit that they cannot leave", "another DebrisFlow on this grid"  # true here
        return [message for message in caplog.messages if not any(words in message for words in others)]

    return run


@pytest.fixture
def built(caplog):
    """Build a flow and return what was logged."""
    caplog.set_level(logging.WARNING, "landlab_debrisflow")

    def build(grid, **keywords):
        caplog.clear()
        DebrisFlow(grid, **keywords)
        return caplog.messages

    return build


@pytest.mark.slow
@pytest.mark.parametrize(
    ("keywords", "words"),
    [
        (
            {"friction": {"law": "coulomb", "basal_friction_angle": 0.54}},
            ("friction: basal_friction_angle", "30.9 deg"),
        ),
        ({"friction": {"law": "voellmy", "basal_friction_angle": 1.5}}, ("basal_friction_angle is 1.5 degrees",)),
        ({"friction": {"law": "mu_i", "static_friction_angle": 0.36, "limiting_friction_angle": 20.0}}, ("20.6 deg",)),
        ({"friction": {"law": "coulomb", "basal_friction_angle": np.linspace(0.3, 0.6, 1200)}}, ("34.4 deg",)),
        ({"material": {"solid_density": 2.65, "water_density": 0.0}}, ("material: solid_density", "2.65", "g/cm3")),
        ({"material": {"water_density": 1.0}}, ("material: water_density is 1 kg m-3", "g/cm3")),
        ({"material": {"solid_density": 26500.0}}, ("solid_density is 26500",)),
        ({"friction": {"law": "mu_i", "grain_density": 2.5}}, ("friction: grain_density is 2.5",)),
        ({"erosion": {"law": "growth", "growth_rate": 3.0}}, ("erosion: growth_rate is 3 per metre",)),
        ({"erosion": {"law": "growth", "growth_rate": np.linspace(0.0, 2.0, 1200)}}, ("growth_rate is 2 per",)),
        ({"material": {"coefficient_of_consolidation": 12.0}}, ("is 12 m2 s-1", "per year", "3.8e-07")),
    ],
)
def test_parameters_in_other_units(slope, said, keywords, words):
    messages = said(slope, **keywords)
    assert len(messages) == 1 and all(word in messages[0] for word in words), messages


@pytest.mark.slow
@pytest.mark.parametrize(
    "keywords",
    [
        {"material": {"water_density": 0.0}},
        {"friction": {"law": "coulomb", "basal_friction_angle": 0.0}},
        {"friction": {"law": "coulomb", "basal_friction_angle": 1.0}},  # nobody has whole radians
        {"friction": {"law": "coulomb", "basal_friction_angle": 2.0}},
        {"friction": {"law": "coulomb", "basal_friction_angle": np.where(np.arange(1200) < 600, 0.5, 20.0)}},
        {"friction": "bingham"},
        {"erosion": {"law": "growth", "growth_rate": 0.0}},
        {"erosion": {"law": "growth", "growth_rate": 1.0}},
        {"material": {"coefficient_of_consolidation": 0.0}},
        {"material": {"solid_density": 500.0, "water_density": 0.0}},
        {"material": {"solid_density": 8000.0}},
    ],
)
def test_what_is_documented_or_just_plausible_is_not_doubted(slope, said, keywords):
    assert said(slope, **keywords) == []


def test_a_field_of_radians_is_doubted_where_nodes_are_open(slope, built):
    angle = slope.add_full("friction__angle", 0.6, at="node")
    law = {"law": "coulomb", "basal_friction_angle": "friction__angle"}
    assert "34.4 deg" in built(slope, friction=law)[0]
    slope.status_at_node[:60] = slope.BC_NODE_IS_CLOSED
    angle[60:], angle[:60] = 30.0, 0.6
    assert built(slope, friction=law) == []


# ---- consolidation ----


def hillside(thickness, length=20, **shape):
    """Return a slope of 30 degrees above flat ground, with a release `thickness` m deep and `length` nodes square."""
    grid = RasterModelGrid((length + 10, 90), **({"xy_spacing": 1.0} | shape))
    x = grid.x_of_node - grid.xy_of_lower_left[0]
    grid.add_field(Z, np.maximum(0.0, 0.577 * (60.0 * grid.dx - x)), at="node")
    release = np.zeros(grid.shape)
    release[5 : 5 + length, 5 : 5 + length] = thickness
    grid.add_field(RELEASE, release.ravel(), at="node")
    return grid


def consolidation_doubt(said, grid, coefficient=None, **keywords):
    """Return what is said of consolidation by a flow."""
    material = {} if coefficient is None else {"coefficient_of_consolidation": coefficient}
    material |= keywords.pop("material", {})
    return [words for words in said(grid, material=material, **keywords) if "h2/c_v" in words]


def test_pressure_that_is_gone_at_once_is_doubted(said):
    """By hand: h^2/c_v = 2^2/4 = 1 s; 35 m of fall take 7.3 (32/9.81)^1/2 = 13 s, of which a tenth is more than 1 s."""
    (words,) = consolidation_doubt(said, hillside(2.0), 4.0)
    assert "2 m thick" in words and "h2/c_v = 1 s" in words and "13 s" in words and "gone before" in words


@pytest.mark.slow
@pytest.mark.parametrize(
    "keywords",
    [
        {"coefficient": 2.0},  # in 2 s, more than a tenth of the event
        {"coefficient": 12.0},  # its unit is doubted
        {"coefficient": 4.0, "material": {"initial_pressure_ratio": 0.0}},
        {"coefficient": 4.0, "material": {"water_density": 0.0}},
        {"coefficient": 4.0, "column": "none"},
        {"coefficient": 4.0, "column": "constant_ratio"},
        {"coefficient": 4.0, "flow": "two_phase"},
        {"coefficient": 1e-9},
        {"coefficient": 0.0},
    ],
)
def test_other_consolidation_is_not_doubted(said, keywords):
    assert consolidation_doubt(said, hillside(2.0), **keywords) == []


def test_the_default_is_doubted_in_a_flow_of_decimetres(said):
    """A release as of a flume: 10 m3 of 1 m, which spread to 10^(1/3)/20 = 0.11 m, h^2/c_v = 29 s."""
    grid = hillside(1.0, length=3, xy_spacing=1.05, xy_of_lower_left=(4e5, 5.2e6))
    (words,) = consolidation_doubt(said, grid)
    assert "the default" in words and "h2/c_v = 2.5e+03 s" in words and "0.11 m" in words and "within 29 s" in words
    assert "permeability" in words


@pytest.mark.slow
def test_the_default_is_not_doubted_in_metres_of_debris_nor_another_value(said):
    assert consolidation_doubt(said, hillside(2.0)) == []
    small = hillside(1.0, length=3)
    assert consolidation_doubt(said, small, 4.4e-2) == [] and consolidation_doubt(said, small, 4.1e-4) == []
    assert consolidation_doubt(said, hillside(0.005, length=3)) == []  # a film


@pytest.mark.slow
def test_pressure_that_a_wet_bed_renews_is_not_doubted(said):
    for soil, keywords, doubted in (
        (1.0, {}, False), (1.0, {"erosion": "none"}, True), (1.0, {"material": {"bed_pressure_ratio": 0.0}}, True),
    ):  # fmt: skip
        grid = hillside(2.0)
        grid.add_field("soil__depth", np.where(grid.at_node[RELEASE] > 0.0, 2.0, soil), at="node")
        assert bool(consolidation_doubt(said, grid, 4.0, **keywords)) == doubted
    for ratio in (0.5, 0.0):
        grid = hillside(2.0)
        grid.add_full("soil__depth", 2.0, at="node")
        grid.add_full("bed__excess_pore_pressure_ratio", ratio, at="node")
        assert bool(consolidation_doubt(said, grid, 4.0)) == (ratio == 0.0)


@pytest.mark.slow
def test_the_largest_site_counts(said):
    grid = hillside(1.0, length=3)
    grid.at_node[RELEASE].reshape(grid.shape)[3:10, 20:40] = 2.0
    assert consolidation_doubt(said, grid) == []


# ---- coordinates ----


def earth(corner, spacing, relief=1500.0, **keywords):
    grid = RasterModelGrid((20, 60), xy_spacing=spacing, xy_of_lower_left=corner, **keywords)
    column = np.arange(grid.number_of_nodes) % 60
    grid.add_field(Z, relief * np.maximum(0.0, 1.0 - column / 40.0), at="node")
    return grid


@pytest.mark.parametrize(
    ("corner", "spacing", "relief"),
    [
        ((-121.5, 47.3), 1.0 / 3600.0, 1500.0),  # SRTM
        ((114.0, 22.4), (1.0 / 10800.0, 1.0 / 10800.0), 500.0),
        ((0.0, 0.0), 1.0 / 3600.0, 1500.0),  # a tutorial's
        ((-121.5, -47.3), 1.0 / 3600.0, 0.0),
        ((6.0, 45.0), 0.05, 3000.0),
    ],
)
def test_coordinates_in_degrees(built, corner, spacing, relief):
    messages = built(earth(corner, spacing, relief))
    assert len(messages) == 1 and "degrees" in messages[0] and "project the DEM" in messages[0]


def test_what_follows_from_degrees_is_not_said_besides():
    grid = earth((-121.5, 47.3), 1.0 / 3600.0)
    assert list(doubts.release_doubts(grid, np.array([605]), np.array([3.0]))) == []


@pytest.mark.parametrize("unit", ["degrees", "Degrees_east", "deg", "°"])
def test_a_grid_that_says_so_itself(built, unit):
    assert "degrees" in built(earth((5e5, 4e6), 5.0, 10.0, xy_axis_units=unit))[0]


def test_coordinates_in_kilometres(built):
    messages = built(earth((500.0, 4000.0), 0.005))
    assert len(messages) == 1 and "in km?" in messages[0]


@pytest.mark.parametrize(
    ("corner", "spacing", "relief"),
    [((0.0, 0.0), 0.005, 0.2), ((5e5, 4e6), 5.0, 300.0), ((0.0, 0.0), 0.5, 20.0), ((0.0, 0.0), 30.0, 3000.0)],
    ids=["a flume", "UTM", "a bank", "a mountain"],
)
def test_metres_are_metres(built, corner, spacing, relief):
    assert built(earth(corner, spacing, relief)) == []


@pytest.mark.slow
@pytest.mark.parametrize("offset", [20000.0, -15000.0])
def test_ground_that_is_nowhere_on_earth_is_computed_and_doubted(said, slope, offset):
    slope.at_node[Z] += offset
    messages = said(slope)
    assert len(messages) == 1 and "nowhere on Earth" in messages[0]


# ---- names ----


@pytest.mark.slow
@pytest.mark.parametrize("name", ["soil_depth", "Soil__Depth", "soil__thickness", "soil__dept", "soil"])
def test_soil_by_another_name(said, name):
    grid = inclined((20, 60), 5.0, 0.5)
    release_slab(grid, (30.0, 48.0), 8.0, 0.5)
    grid.add_full(name, 1.0, at="node")
    messages = said(grid)
    assert len(messages) == 1 and repr(name) in messages[0] and "'soil__depth'" in messages[0]
    exec(messages[0].split("; ")[1], {"grid": grid})  # as printed
    release_slab(grid, (30.0, 48.0), 8.0, 0.5)
    assert said(grid) == [] and SOIL in grid.at_node


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "ours"),
    [
        ("bed_drained", "bed__drained"),
        ("bed__excess_pore_presure_ratio", "bed__excess_pore_pressure_ratio"),
        ("mass_wasting_id", IDS),
        ("mass__wasting_ids", IDS),
    ],
)
def test_other_inputs_by_another_name(slope, said, name, ours):
    slope.add_ones(name, at="node")
    messages = said(slope)
    assert len(messages) == 1 and repr(name) in messages[0] and repr(ours) in messages[0]


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", ["release_thickness", "release_depth", "debris_flow__release_thickness", "landslide_release", "Release"]
)
def test_a_release_by_another_name(valley, said, name):
    valley.add_field(name, valley.at_node[RELEASE].copy(), at="node")
    valley.delete_field("node", RELEASE)
    flow = DebrisFlow(valley, numerics=COARSE)
    messages = [m for m in run(flow, said) if "nothing to do" in m]
    assert len(messages) == 1 and repr(name) in messages[0]
    exec(messages[0].split("meant? ")[1], {"grid": valley})
    flow.run_one_step(0.1)
    assert flow.budget["released"] == 225.0


def run(flow, said):
    """Run a flow twice, and return what was logged."""
    logger, messages = logging.getLogger("landlab_debrisflow"), []
    handler = logging.Handler()
    handler.emit = lambda record: messages.append(record.getMessage())
    logger.addHandler(handler)
    try:
        assert flow.run_until_rest() is True
        flow.run_one_step(1.0)
    finally:
        logger.removeHandler(handler)
    return messages


@pytest.mark.slow
def test_ids_without_soil_release_nothing_and_say_why(said):
    grid = inclined((20, 60), 5.0, 0.5)
    ids = grid.add_zeros(IDS, at="node", dtype=int)
    ids[500:503] = 1
    (message,) = run(DebrisFlow(grid), said)
    assert message.startswith("nothing to do") and f"{IDS} > 0 at 3 nodes" in message and "no soil__depth" in message
    grid.add_zeros(SOIL, at="node")
    (message,) = run(DebrisFlow(grid), said)
    assert "soil__depth is 0 at all of them" in message


@pytest.mark.slow
@pytest.mark.parametrize(
    "name",
    ["snow__depth", "water__depth", "rock__depth", "soil_production__rate", "soil__erodibility", "bedrock__elevation",
     "mass_wasting__volume", "relief", "debris_flow__hazard", "bed__thickness", "soil_type"],
)  # fmt: skip
def test_other_fields_are_left_alone(said, name):
    grid = inclined((20, 60), 5.0, 0.5)
    release_slab(grid, (30.0, 48.0), 8.0, 0.5)
    grid.add_ones(name, at="node")
    assert said(grid) == []


def test_a_name_beside_ours_or_without_values_is_left_alone(slope, said):
    slope.add_ones("soil_depth", at="node")
    slope.add_zeros("bed_drained", at="node")
    slope.add_ones("release_thickness", at="node")
    assert said(slope) == []


@pytest.mark.slow
def test_a_field_that_a_law_reads_is_left_alone(said):
    grid = inclined((20, 60), 5.0, 0.5)
    release_slab(grid, (30.0, 48.0), 8.0, 0.5)
    grid.add_ones("soil_depth", at="node")
    assert said(grid, erosion={"law": "growth", "growth_rate": "soil_depth"}) == []


# ---- release ----


def test_a_release_deeper_than_wide(said):
    grid = inclined((20, 60), 5.0, 0.5)
    depth = release_slab(grid, (230.0, 48.0), 8.0, 14.0)  # three nodes of 5 m
    depth[5 * 60 + 10 : 5 * 60 + 14] = 7.5  # 20 m by 5 m
    messages = said(grid)
    assert len(messages) == 1 and "7.5 m on 5 m around node 310 (row 5, column 10)" in messages[0]


def test_a_release_in_centimetres(said):
    grid = inclined((20, 60), 5.0, 0.5)
    release_slab(grid, (30.0, 48.0), 8.0, 150.0)
    assert "150 m on 15 m" in said(grid)[0]


def test_deep_releases_are_doubted_once(valley, caplog):
    flow = DebrisFlow(valley, numerics=COARSE)
    for _ in range(3):
        valley.at_node[SOIL][:] = 200.0
        release_slab(valley, (30.0, 48.0), 8.0, 150.0)
        flow.run_one_step(1e-6)
    assert len([m for m in caplog.messages if "deeper than it is wide" in m]) == 1


def test_a_release_just_as_deep_as_wide_is_not_doubted(said):
    grid = inclined((20, 60), 5.0, 0.5)
    depth = release_slab(grid, (30.0, 48.0), 8.0, 15.0)
    depth[5 * 60 + 40] = 5.0
    assert said(grid) == []


@pytest.mark.slow
def test_doubts_change_nothing(slope):
    before = copy_fields(slope)
    flow = DebrisFlow(slope, material={"solid_density": 2.65, "water_density": 0.0}, numerics=COARSE)
    assert all(np.array_equal(before[name], slope.at_node[name]) for name in before)
    assert flow.setup.material.solid_density == 2.65
