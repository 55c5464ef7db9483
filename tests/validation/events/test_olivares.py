"""Set-up, measures, baseline and choice of the six flows at the Rio Olivares, on a valley made for the purpose."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from landlab_debrisflow import InputError
from validation.events import data, olivares
from validation.events.olivares import baseline, leave_one_out, measures, picture, setup

MISSING = data.absence("olivares", "dem.asc")
SPACING = 12.5
SETS = ("literature", "proportional", "regional")


def made_valley():
    """Return six sources at the head of a valley that falls by 0.4 towards east, with outlines of five rows around it.

    The outlines begin at the sources in column 5, and end in columns 40, 41, ..., 45.
    """
    rows, columns = np.indices((41, 60))
    elevation = 0.4 * SPACING * (59 - columns) + 0.3 * SPACING * abs(rows - 20) + 1000.0
    number, source = np.zeros((2, 41, 60), int)
    return elevation, number, source, rows, columns


@pytest.fixture
def observed():
    """Return a valley of which flow k has its source in its thalweg; outlines overlap, so only one is in the raster."""

    def one(flow=1):
        elevation, number, source, rows, columns = made_valley()
        number[(abs(rows - 20) <= 2) & (columns >= 5) & (columns <= 39 + flow)] = flow
        source[(abs(rows - 20) <= 2) & (columns >= 5) & (columns <= 9)] = flow
        points = dict.fromkeys(setup.FLOWS, (400000.0 + 6 * SPACING, 6300000.0 + 20 * SPACING))
        return setup.Observed(elevation, number, source, (400000.0, 6300000.0), SPACING, points)

    return one


def test_volume_of_a_release_by_hand():
    # 10^-0.649 5000^1.262: log10 is -0.649 + 1.262 * 3.69897 = 4.0191
    site = {"volume_logarithm": -0.649, "volume_exponent": 1.262}
    assert setup.release_volume(5000.0, site) == pytest.approx(10**4.0191, rel=1e-4)


@pytest.mark.parametrize("name", SETS)
def test_sets_have_sources_and_say_what_was_known(name):
    found = olivares.EVENT.read_set(name)
    assert "No score existed" in found.known_when_chosen or "before any score" in found.known_when_chosen
    assert found.keywords()["friction"]["law"] == "voellmy" and found.plain("site")["soil_depth"] == 1.22


def test_release_has_the_volume_of_the_rule_and_lies_in_the_source(observed):
    site = olivares.EVENT.read_set().plain("site")
    there = observed()
    grid = setup.build_grid(there, 1, site)
    depth = grid.at_node["debris_flow__release_depth"].reshape(grid.shape)
    expected = setup.release_volume(25 * SPACING**2, site)
    assert depth.sum() * SPACING**2 == pytest.approx(expected, rel=1e-9)
    assert not depth[there.source == 0].any()
    assert np.all(grid.at_node["soil__depth"] >= grid.at_node["debris_flow__release_depth"])


@pytest.mark.slow
def test_shift_moves_the_release_by_half_a_cell_and_keeps_its_volume(observed):
    site = olivares.EVENT.read_set().plain("site")
    centres = []
    for east in (-0.5, 0.0, 0.5):
        grid = setup.build_grid(observed(), 1, site, (east, 0.0))
        depth = grid.at_node["debris_flow__release_depth"]
        centres.append(np.average(grid.x_of_node, weights=depth))
        assert depth.sum() * SPACING**2 == pytest.approx(setup.release_volume(25 * SPACING**2, site), rel=1e-9)
    # a tapered body is deeper uphill, so that its centre moves by about, not exactly, half a cell
    assert np.diff(centres) == pytest.approx([0.5 * SPACING] * 2, rel=0.4)


def test_measures_of_an_outline_itself(observed):
    there = observed()
    found = measures.compare(there.flow == 1, there, 1)
    assert found == {"iou": 1.0, "precision": 1.0, "recall": 1.0, "toe": 0.0, "reach": 0.0}


def test_measures_by_hand(observed):
    there = observed()
    wet = np.zeros(there.flow.shape, bool)
    wet[20, 5:51] = True  # 46 cells, 36 of them of the 180 mapped; ten columns beyond the toe
    found = measures.compare(wet, there, 1)
    assert found["iou"] == pytest.approx(36 / 190)
    assert (found["precision"], found["recall"]) == pytest.approx((36 / 46, 36 / 180))
    # the toe is a corner of the outline, two rows beside the end of the wet cells
    assert found["toe"] == pytest.approx(SPACING * np.hypot(10, 2))
    assert found["reach"] == pytest.approx(SPACING * (44 - np.hypot(34, 2)))


def test_a_flow_that_wets_nothing_has_no_reach(observed):
    found = measures.compare(np.zeros((41, 60), bool), observed(), 1)
    assert found["iou"] == 0.0 and found["recall"] == 0.0
    assert all(np.isnan(found[name]) for name in ("precision", "toe", "reach"))


def test_summary_shows_flows_1_and_3_apart():
    single = {
        flow: {"iou": 0.1 * flow, "precision": 0.5, "recall": 0.5, "toe": 100.0 * flow, "reach": 0.0}
        for flow in setup.FLOWS
    }
    found = measures.summary(single)
    assert found["median iou"] == pytest.approx(0.35) and found["median iou of 2, 4, 5, 6"] == pytest.approx(0.45)
    assert found["right reaches"] == 3.0 and found["iou 3"] == pytest.approx(0.3)
    assert set(found) == set(measures.MEASURES)


def test_ceilings_of_a_strip(observed):
    there = observed()
    for flow in range(2, 7):  # only flow 1 is in this raster
        there.flow[flow, flow] = flow
    found = measures.ceilings(there)
    # 5 x 36 cells; a cell to each side adds 2 x (5 + 36), and takes away all but 3 x 34
    assert found["outline, one cell wider"][1]["iou"] == pytest.approx(180 / 262)
    assert found["outline, one cell narrower"][1]["iou"] == pytest.approx(102 / 180)


@pytest.mark.slow
def test_baseline_follows_the_thalweg_to_the_mapped_reach(observed):
    there = observed()
    paths = baseline.steepest_paths(there)[1]
    assert len(paths) == 25 and all(path[-1, 0] == 20 and path[-1, 1] == 59 for path in paths)
    cells = baseline.widened_paths(there, 1, paths, others=False)
    rows, columns = np.nonzero(cells)
    reach, width, slope = baseline.outline_size(there, 1)
    assert width == pytest.approx(180 * SPACING**2 / reach) and slope == pytest.approx(0.4, abs=0.03)
    # sources in rows 18 to 22, widened by two cells; paths end at the reach, the end is widened, too
    assert int(width / 2 / SPACING) == 2 and (rows.min(), rows.max()) == (16, 24) and rows[columns > 12].min() == 18
    assert abs(int(columns.max()) - 42) <= 1


def test_choice_leaves_the_flow_itself_out():
    liked = dict.fromkeys(setup.FLOWS, 0.4) | {6: 0.95}  # best of all by its mean, because of flow 6
    steady = dict.fromkeys(setup.FLOWS, 0.45)
    assert leave_one_out.choose([liked, steady]) == {1: 0, 2: 0, 3: 0, 4: 0, 5: 0, 6: 1}


def test_family_spans_the_published_ranges():
    found = [varied for varied, _ in leave_one_out.members(olivares.EVENT.read_set())]
    assert len(found) == 27 and len({tuple(each.values()) for each in found}) == 27
    assert {each["growth_rate"] for each in found} == {5e-4, 1.22e-3, 3e-3}
    _, last = list(leave_one_out.members(olivares.EVENT.read_set()))[-1]
    assert last.plain("material")["bed_pressure_ratio"] == last.plain("material")["initial_pressure_ratio"] == 0.7


@pytest.mark.slow
def test_a_flow_runs_down_its_valley(observed):
    found = measures.measure_flow(observed(), 1, olivares.EVENT.read_set(), 100)
    assert found["recall"] > 0.3 and found["reach"] > 0.0  # the thalweg is the way, and falls by 0.4 to the edge


def test_absent_data_is_told(monkeypatch, tmp_path):
    monkeypatch.setenv("DEBRISFLOW_DATA", str(tmp_path))
    setup.read_observed.cache_clear()
    with pytest.raises(InputError, match=r"olivares/dem\.asc"):
        setup.read_observed()
    setup.read_observed.cache_clear()


@pytest.mark.skipif(bool(MISSING), reason=MISSING)
def test_data_lie_as_described():
    there = setup.read_observed()
    assert there.elevation.shape == (238, 547) and there.spacing == SPACING
    cells = [int(np.sum(there.source == flow)) for flow in setup.FLOWS]
    assert cells == [46, 32, 38, 46, 51, 48]
    for flow, (x, y) in there.points.items():
        column, row = np.rint((np.array((x, y)) - there.corner) / SPACING).astype(int)
        assert there.source[row, column] == flow


@pytest.mark.slow
@pytest.mark.skipif(bool(MISSING), reason=MISSING)
def test_figure_has_a_map_for_every_flow():
    figure = olivares.EVENT.draw(olivares_result())
    assert isinstance(figure, Figure)
    assert sum("IoU" in axes.get_title(loc="left") for axes in figure.axes) == 6


def olivares_result():
    """Return a result in which the flows have gone exactly as mapped."""
    import xarray as xr

    there = setup.read_observed()
    depth = np.stack([1.0 * (there.flow == flow) for flow in setup.FLOWS])
    y, x = (at + SPACING * np.arange(n) for at, n in zip(there.corner[::-1], there.flow.shape, strict=True))
    found = xr.Dataset({"max_depth": (("flow", "y", "x"), depth)}, {"flow": list(setup.FLOWS), "y": y, "x": x})
    return picture.shown(found).assign_attrs(set="literature")
