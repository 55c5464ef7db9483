"""The example after section 4.2 of Pastor et al. (2022), shortened; its claims are in tests/verification."""

import numpy as np
import pytest
import xarray as xr
from landlab.io import esri_ascii
from numpy.testing import assert_allclose

from landlab_debrisflow import InputError
from landlab_debrisflow.scene.tsing_shan import tsing_shan_valley
from tests.test_examples import load

SHORT = {"erodible_length": 200.0, "runout_length": 400.0, "width": 200.0}
FIELDS = {"dem": "topographic__elevation", "release": "debris_flow__release_depth", "erodible": "soil__depth"}


@pytest.fixture(scope="module")
def example():
    return load("tsing_shan")


@pytest.fixture
def rasters(tmp_path):
    """Write a short valley as a user's rasters; in a corner there are no data."""
    grid = tsing_shan_valley(**SHORT)
    grid.at_node["topographic__elevation"][0] = grid.at_node["soil__depth"][0] = -9999.0
    paths = [tmp_path / f"{name}.asc" for name in FIELDS]
    for path, name in zip(paths, FIELDS.values(), strict=True):
        with open(path, "w") as stream:
            esri_ascii.dump(grid, stream, name=name)
    return paths


@pytest.mark.slow
def test_a_users_rasters_are_read_as_they_are(example, rasters):
    grid, valley = example.read_terrain(*rasters), tsing_shan_valley(**SHORT)
    for name in FIELDS.values():
        assert_allclose(grid.at_node[name][1:], valley.at_node[name][1:], rtol=1e-5, atol=1e-6)
    assert grid.status_at_node[0] == grid.BC_NODE_IS_CLOSED
    assert grid.at_node["soil__depth"][0] == 0.0


@pytest.mark.slow
def test_rasters_that_do_not_fit_are_refused(example, rasters, tmp_path):
    other = tmp_path / "other.asc"
    with open(other, "w") as stream:
        esri_ascii.dump(tsing_shan_valley(**SHORT | {"width": 100.0}), stream, name="soil__depth")
    with pytest.raises(InputError, match=r"other\.asc has .* give rasters of the same extent and spacing"):
        example.read_terrain(*rasters[:2], other)


@pytest.mark.slow
def test_both_models_run_on_a_users_rasters(example, rasters, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(example, "CONSOLIDATION", (4e-4,))
    records = example.main(40, tmp_path, rasters, duration=14.0)
    told = capsys.readouterr().out
    assert "travel angle" in told and "dem.asc" in told
    assert list(records) == [("ALE", 4e-4), ("classical", 4e-4)]
    assert records["ALE", 4e-4].passing < 14.0
    with xr.open_dataset(tmp_path / "tsing_shan.nc") as maps:
        assert maps.sizes["run"] == 2 and float(maps.debris_flow__eroded_depth.max()) > 0.0
    for name in ("flow", "maps", "columns"):
        assert (tmp_path / f"tsing_shan_{name}.png").read_bytes()[:4] == b"\x89PNG"


def test_the_front_is_where_the_share_lies_behind(example):
    record = example.Record(tsing_shan_valley(**SHORT))
    assert record.distance(*record.centre) == 0.0
    values, weights = np.array([3.0, 1.0, 2.0]), np.array([1.0, 1.0, 98.0])
    assert load("tsing_shan_record").quantile(values, weights, 0.5) == 2.0
    assert load("tsing_shan_record").quantile(values, weights, 0.995) == 3.0
