"""A landslide is set up, run and scored: on a made-up slope, and on the measured ones where their data are."""

import numpy as np
import pytest
import xarray as xr

from validation.events import data, find_event
from validation.events.s1000 import measures, picture, setup
from validation.events.sets import read_set

from .synthetic import SET, write_landslide

pytestmark = pytest.mark.filterwarnings("ignore:.*left the grid")


@pytest.fixture
def slope(tmp_path, monkeypatch):
    monkeypatch.setenv("DEBRISFLOW_DATA", str(tmp_path / "data"))
    (tmp_path / "made_up.yaml").write_text(SET, encoding="utf-8")
    return write_landslide(tmp_path / "data" / "s1000"), read_set(tmp_path, "made_up")


def test_the_grid_is_that_of_the_files(slope):
    grid = setup.build_grid("s1000", {"soil_depth": 0.5, "bed_degree_of_saturation": 0.75})
    assert grid.shape == (30, 12) and grid.xy_of_lower_left == (581000.0, 5300000.0)
    assert (grid.status_at_node.reshape(grid.shape)[:, -1] == grid.BC_NODE_IS_CLOSED).all()
    release, soil = grid.at_node["debris_flow__release_depth"], grid.at_node["soil__depth"]
    assert release.max() == 2.0 and (soil >= release).all() and soil.min() == 0.5
    assert (grid.at_node["bed__degree_of_saturation"] == 0.75).all()


def test_a_run_is_scored(slope):
    observed, parameters = slope
    result = setup.run_landslide("s1000", parameters, 60, fan_rows=4)
    np.testing.assert_array_equal(result.observed_change, observed)
    found = measures.score(result)
    assert set(found) == set(measures.MEASURES)
    released = float(result.released_depth.sum()) * 100.0
    balance = found["raised outside"] - found["lowered outside"] + found["in scar"] + found["outflow"]
    assert balance == pytest.approx(released, rel=1e-9)  # volume is conserved
    assert 0.0 < found["csi outside"] < 1.0 and found["lowered outside"] > 0.0
    assert set(picture.shown(result).data_vars) == {"modelled_change", "source", "elevation", "observed_class"}


def landslide():
    """Return a result whose model has the observed change one cell too far south."""
    zero = np.zeros((8, 5))
    observed, source = zero.copy(), zero.copy()
    source[6, 2], observed[6, 2], observed[2:4, 2], observed[4, 2] = 1, -3.0, 1.0, -0.5
    modelled = observed.copy()
    modelled[1:4, 2], modelled[4, 2] = (1.0, 1.0, 0.1), 0.5
    y, x = 10.0 * np.arange(8), 10.0 * np.arange(5)
    maps = {
        "observed_change": observed, "modelled_change": modelled, "source": source, "released_depth": 3.0 * source,
        "fan": zero + (np.arange(8)[:, None] < 2), "mapped": (observed != 0.0), "elevation": zero + y[:, None],
    }  # fmt: skip
    dataset = xr.Dataset({name: (("y", "x"), values) for name, values in maps.items()}, {"y": y, "x": x})
    return dataset.assign_attrs(eroded=1.0, outflow=0.0, duration=2.0)


def test_measures_by_hand():
    found = measures.score(landslide())
    # outside: modelled in rows 1, 2, 4, observed in rows 2, 3, 4
    assert found["csi outside"] == 0.5 and found["csi"] == 0.6
    assert found["precision outside"] == found["recall outside"] == pytest.approx(2.0 / 3.0)
    assert found["correlation outside"] == pytest.approx(np.corrcoef([1, 1, 0.1, 0.5], [0, 1, 1, -0.5])[0, 1])
    assert found["correlation above fan"] == pytest.approx(np.corrcoef([1, 0.1, 0.5], [1, 1, -0.5])[0, 1])
    assert found["raised outside"] == pytest.approx(260.0) and found["lowered outside"] == 0.0
    assert found["in scar"] == 0.0 and found["toe"] == pytest.approx(10.0)


def test_references_bound_the_scores():
    found = measures.references(landslide())
    quiet, noisy = (found[f"perfect model, survey noise {noise:g} m"]["correlation outside"] for noise in (0.2, 0.59))
    assert 1.0 > quiet > noisy
    assert found["observed"]["raised outside"] == 200.0 and found["observed"]["lowered outside"] == 50.0
    spread = found["release spread along the path"]
    assert spread["raised outside"] - spread["lowered outside"] + spread["in scar"] == pytest.approx(300.0)


def test_classes_of_changes():
    change = xr.DataArray([-9.0, -1.5, -0.3, 0.1, 0.3, 2.0, 3.0])
    assert picture.classes(change).tolist() == [-3, -2, -1, 0, 1, 2, 3]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["s1000", "cascade2009"])
def test_the_measured_landslides_can_be_run(name):
    if reason := data.absence(name, "DEM_of_Difference.asc"):
        pytest.skip(reason)
    event = find_event(name)
    result = event.run(event.read_set(), 150)
    found = event.score(result)
    assert 0.25 < found["csi outside"] < 0.7  # 2000 particles: .46 and .44
    assert float(result.released_depth.sum()) * 100.0 == pytest.approx(22_481 if name == "s1000" else 91_500, rel=0.01)
