"""Maps written as a run goes: whole files, the window of the flow, one file of all, and going on after a kill."""

import errno
import os
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from landlab_debrisflow import DebrisFlow, InputError
from landlab_debrisflow.record import MapSeries, Snapshots, combine_maps
from landlab_debrisflow.record import map_series as module
from validation.grids import COARSE, inclined, release_slab

DEPTHS = "debris_flow__depth", "debris_flow__eroded_depth", "debris_flow__deposit_depth"


def flow_with(*observers, **keywords):
    grid = inclined((40, 60), 5.0, 0.5, soil=1.0, foot=150.0, xy_of_lower_left=(5000.0, 7000.0))
    release_slab(grid, (5050.0, 7100.0), 8.0, 1.0)
    return DebrisFlow(grid, observers=observers, numerics={"particle_count": 60}, **keywords)


def test_all_maps_are_those_of_snapshots_as_single_precision(tmp_path):
    series, snapshots = MapSeries(2.0, tmp_path, crs="EPSG:32633"), Snapshots(2.0)
    flow = flow_with(series, snapshots)
    flow.run_until_rest()
    whole = snapshots.dataset
    assert [path.name for path in series.files] == sorted(os.listdir(tmp_path))
    with xr.open_dataset(combine_maps(tmp_path, tmp_path / "all.nc"), decode_coords="all") as combined:
        assert combined.time.values == pytest.approx(whole.time.values, abs=0.0)
        assert combined.time.attrs["units"] == "s"
        assert combined.spatial_ref.attrs["crs_wkt"].startswith("PROJCRS")
        for name in combined.data_vars:
            assert combined[name].dtype == np.float32
            inside = whole[name].sel(x=combined.x, y=combined.y)
            assert np.array_equal(combined[name].values, inside.values.astype(np.float32)), name
            assert float(np.nansum(abs(whole[name]))) == pytest.approx(float(np.nansum(abs(inside))), rel=1e-12), name
        assert combined.sizes["y"] < 30 and combined.attrs["setup_digest"] == flow.setup.digest()
        assert float(combined.debris_flow__eroded_depth[-1].sum()) > 1.0


@pytest.mark.slow
def test_zarr_holds_what_netcdf_holds(tmp_path):
    pytest.importorskip("zarr")
    flow_with(MapSeries(4.0, tmp_path, ["depth", "speed"], crs="EPSG:32633")).run_one_step(8.0)
    with (
        xr.open_dataset(combine_maps(tmp_path, tmp_path / "all.nc"), decode_coords="all") as one,
        xr.open_zarr(combine_maps(tmp_path, tmp_path / "all.zarr"), decode_coords="all") as other,
    ):
        xr.testing.assert_equal(one.load(), other.load())
        assert other.debris_flow__depth.attrs == one.debris_flow__depth.attrs
    combine_maps(tmp_path, tmp_path / "all.zarr")  # in place of the old one
    assert not [name for name in os.listdir(tmp_path) if name.startswith(".")]


def test_a_file_holds_the_window_of_the_flow_only(tmp_path):
    series = MapSeries(1.0, tmp_path, ["depth"])
    flow = flow_with(series)
    flow.run_one_step(1.0)
    with xr.open_dataset(series.files[0]) as first:
        assert first.sizes["y"] < 20 and first.sizes["x"] < 20
        depth = flow.maps.debris_flow__depth
        assert float(first.debris_flow__depth.sum()) == pytest.approx(float(depth.sum()), rel=1e-6)
        assert float(first.time) == flow.elapsed_time


@pytest.mark.slow
def test_a_run_that_goes_on_ends_with_the_same_files(tmp_path):
    once, again = tmp_path / "once", tmp_path / "again"
    once.mkdir(), again.mkdir()
    whole = flow_with(MapSeries(1.0, once))
    whole.run_one_step(4.0)
    whole.run_one_step(4.0)
    killed = MapSeries(1.0, again)
    flow = flow_with(killed)
    flow.run_one_step(4.0)
    state = killed.state()
    flow.run_one_step(2.0)  # later than the checkpoint
    assert len(killed.files) > len(state["times"])
    resumed = MapSeries(1.0, again, replace=True)
    other = flow_with()
    other.run_one_step(4.0)
    resumed.prepare(other.grid, other.setup)
    resumed.restore(state)
    assert sorted(os.listdir(again)) == [path.name for path in resumed.files]
    other._observers = (resumed,)
    other.run_one_step(4.0)
    assert sorted(os.listdir(again)) == sorted(os.listdir(once))
    for name in os.listdir(once):
        with xr.open_dataset(once / name) as one, xr.open_dataset(again / name) as two:
            xr.testing.assert_equal(one, two)


@pytest.mark.slow
def test_files_that_are_gone_are_told_of(tmp_path):
    series = MapSeries(1.0, tmp_path, ["depth"])
    flow_with(series).run_one_step(2.0)
    state = series.state()
    series.files[0].unlink()
    with pytest.raises(InputError, match=r"maps_000000\.nc was written before the checkpoint and is not in"):
        MapSeries(1.0, tmp_path, replace=True).restore(state)


def test_an_earlier_series_is_replaced_only_when_asked_to(tmp_path):
    (tmp_path / "maps_000007.nc").write_bytes(b"old")
    (tmp_path / "maps_of_mine.nc").write_bytes(b"mine")
    (tmp_path / ".maps_000007.4711.nc").write_bytes(b"half a file of a process that was killed")
    with pytest.raises(InputError, match=r"already holds 1 maps of a series.*replace=True"):
        MapSeries(1.0, tmp_path)
    series = MapSeries(1.0, tmp_path, ["depth"], replace=True)
    flow = flow_with(series)
    assert (tmp_path / "maps_000007.nc").exists()
    flow.run_one_step(1.0)
    assert sorted(os.listdir(tmp_path)) == ["maps_000000.nc", "maps_of_mine.nc"]


@pytest.mark.slow
def test_a_full_disk_ends_the_call_and_leaves_whole_files(tmp_path, monkeypatch):
    series = MapSeries(1.0, tmp_path, ["depth"])
    flow = flow_with(series)
    flow.run_one_step(1.0)
    real = os.replace

    def full(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    with pytest.raises(OSError, match="No space left") as refused:
        flow.run_one_step(3.0)
    assert any("everything computed until then is kept" in note for note in refused.value.__notes__)
    monkeypatch.setattr(os, "replace", real)
    assert os.listdir(tmp_path) == ["maps_000000.nc"]
    flow.run_one_step(3.0)
    assert len(os.listdir(tmp_path)) == len(series.files) > 2


def test_maps_of_an_undone_call_are_written_anew(tmp_path):
    series, grid = MapSeries(1.0, tmp_path, ["depth"]), inclined((5, 5), 5.0, 0.0)
    for name in module.REACHED:
        grid.add_zeros(f"debris_flow__{name}", at="node")
    series.prepare(grid, SimpleNamespace(two_phases=False, has_dilatancy=False, to_attributes=dict))
    for time in (1.0, 2.0, 3.0, 2.0):
        series.observe(SimpleNamespace(grid=grid, elapsed_time=time))
    assert series.state()["times"].tolist() == [1.0, 2.0]
    assert sorted(os.listdir(tmp_path)) == ["maps_000000.nc", "maps_000001.nc"]


@pytest.mark.parametrize(
    "arguments, words",
    [
        ({"interval": 0.0}, "interval must be a finite number of seconds > 0"),
        ({"variables": ["dpth"]}, r"no output field 'dpth' \(did you mean 'depth'\?\)"),
        ({"variables": []}, "variables must name at least one output field"),
        ({"crs": "EPSG:999999"}, "no such coordinate reference system"),
        ({"directory": "nowhere"}, "cannot write to 'nowhere': it does not exist"),
    ],
)
def test_refusals(tmp_path, arguments, words):
    with pytest.raises(InputError, match=words):
        MapSeries(**{"interval": 1.0, "directory": tmp_path} | arguments)


def test_a_map_of_two_phases_is_refused_for_one(tmp_path):
    with pytest.raises(InputError, match="debris_flow__solid_fraction is in columns with dilatancy only"):
        DebrisFlow(inclined((5, 5), 5.0, 0.0), observers=MapSeries(1.0, tmp_path, ["solid_fraction"]))
    with pytest.raises(InputError, match="debris_flow__solid_depth is in flows of two phases only"):
        flow_with(MapSeries(1.0, tmp_path, ["solid_depth"]))


@pytest.mark.parametrize(
    ("laws", "name"),
    [({"flow": "two_phase"}, "solid_depth"), ({"column": {"law": "ale", "dilatancy": {}}}, "solid_fraction")],
)
def test_a_map_that_only_some_flows_have(tmp_path, laws, name):
    grid = inclined((20, 40), 5.0, 0.5)
    release_slab(grid, (30.0, 48.0), 8.0, 1.0)
    DebrisFlow(grid, observers=MapSeries(1.0, tmp_path, [name]), numerics=COARSE, **laws).run_one_step(1.0)
    with xr.open_dataset(max(tmp_path.iterdir())) as written:
        assert float(written[f"debris_flow__{name}"].max()) > 0.0


def test_what_cannot_be_combined(tmp_path):
    with pytest.raises(InputError, match="holds no maps of a MapSeries"):
        combine_maps(tmp_path, tmp_path / "all.nc")
    (tmp_path / "maps_000000.nc").write_bytes(b"nothing")
    with pytest.raises(InputError, match=r"cannot read .*maps_000000.nc"):
        combine_maps(tmp_path, tmp_path / "all.nc")
    assert os.listdir(tmp_path) == ["maps_000000.nc"]
