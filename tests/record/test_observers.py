"""Observers see the event as it is, and refuse paths before anything is computed."""

import errno
import io
import os
import tempfile

import numpy as np
import pytest
import xarray as xr
from landlab import RasterModelGrid
from rich.console import Console

from landlab_debrisflow import DebrisFlow, InputError
from landlab_debrisflow.record.files import check_writable, write_atomically
from landlab_debrisflow.record.observers import Progress, Snapshots


def slope_with(*observers):
    grid = RasterModelGrid((14, 40), xy_spacing=5.0)
    grid.add_field("topographic__elevation", np.maximum(0.0, 60.0 - 0.5 * grid.x_of_node), at="node")
    grid.add_full("soil__depth", 1.0, at="node")
    release = grid.add_zeros("debris_flow__release_depth", at="node")
    release[(abs(grid.x_of_node - 30) < 8) & (abs(grid.y_of_node - 32) < 8)] = 1.0
    return DebrisFlow(grid, numerics={"particle_count": 60}, observers=observers)


@pytest.mark.slow
def test_progress_is_silent_without_a_terminal():
    stream = io.StringIO()
    slope_with(Progress(1.0, console=Console(file=stream))).run_one_step(2.0)
    assert stream.getvalue() == ""


@pytest.mark.slow
def test_progress_tells_time_volume_and_speed_on_a_terminal():
    stream = io.StringIO()
    console = Console(file=stream, force_terminal=True, width=120)
    flow = slope_with(Progress(1.0, "slope [a]", console))
    flow.run_one_step(2.0)
    first, second, _ = stream.getvalue().split("\r")
    assert "slope [a]:     1." in first  # at the end of the step that crosses 1 s
    assert "2.0 s" in second and f"{flow.budget['moving']:.0f} m3" in second
    assert f"{flow.grid.at_node['debris_flow__speed'].max():.1f} m/s" in second
    flow.run_until_rest()
    last = stream.getvalue().split("\r")[-1]
    assert "at rest" in last and last.endswith("\n")


def test_snapshots_are_the_maps_at_each_interval_and_at_rest():
    snapshots = Snapshots(1.5)
    flow = slope_with(snapshots)
    flow.run_one_step(3.0)
    now = flow.maps
    flow.run_until_rest()
    series = snapshots.dataset
    first, second = series.time.values[:2]
    assert 1.5 <= first < 2.0 and second == 3.0  # steps are 0.3 s long; the call ends at 3 s
    assert float(series.time[-1]) == flow.elapsed_time
    assert series.time.attrs["units"] == "s"
    xr.testing.assert_equal(series.isel(time=1).drop_vars("time"), now)
    assert float(series.debris_flow__eroded_depth.diff("time").min()) >= 0.0
    assert float(series.debris_flow__depth.isel(time=0).max()) > 0.0
    assert series.attrs["friction"] == "Coulomb"
    assert not any(name.startswith("budget") for name in series.attrs)


def test_snapshots_are_written_at_rest_and_read_back_alike(tmp_path):
    path = tmp_path / "event.nc"
    snapshots = Snapshots(2.0, path, ["debris_flow__depth", "debris_flow__deposit_depth"])
    flow = slope_with(snapshots)
    flow.run_one_step(2.0)
    assert not path.exists()
    flow.run_until_rest()
    with xr.open_dataset(path) as stored:
        xr.testing.assert_equal(stored.load(), snapshots.dataset)
        assert list(stored) == ["debris_flow__depth", "debris_flow__deposit_depth"]
        assert stored.debris_flow__depth.attrs["units"] == "m"
    assert os.listdir(tmp_path) == ["event.nc"]


def test_unknown_field_names_the_known_ones():
    with pytest.raises(InputError, match=r"no field 'depht' in the maps; there are .*debris_flow__depth"):
        slope_with(Snapshots(1.0, variables=["depht"])).run_one_step(1.0)


def test_nothing_observed_and_nowhere_to_write(tmp_path):
    with pytest.raises(InputError, match="nothing was observed yet"):
        _ = Snapshots(1.0, tmp_path / "x.nc").dataset
    with pytest.raises(InputError, match="no path"):
        Snapshots(1.0).write()


@pytest.mark.parametrize("interval", [0.0, -1.0, float("nan"), float("inf"), True, "1"])
@pytest.mark.parametrize("observer", [Progress, Snapshots])
def test_interval_is_checked(observer, interval):
    with pytest.raises(InputError, match="interval must be a finite number of seconds > 0"):
        observer(interval)


def test_path_is_refused_before_computing(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="does not exist; create it first"):
        Snapshots(1.0, tmp_path / "missing" / "x.nc")
    with pytest.raises(InputError, match="it is a directory"):
        Snapshots(1.0, tmp_path)
    with pytest.raises(InputError, match="is not a directory"):
        check_writable(tmp_path / "file" / "x.nc")
    assert check_writable(str(tmp_path / "x.nc")) == tmp_path / "x.nc"
    assert os.listdir(tmp_path) == ["file"]


def test_folder_that_nothing_can_be_written_to_is_refused(tmp_path, monkeypatch):
    """As it is said by the system: permission bits bind neither root nor a full or read-only file system."""

    def refuse(*arguments, **keywords):
        raise PermissionError(errno.EACCES, "Permission denied")

    monkeypatch.setattr(tempfile, "TemporaryFile", refuse)
    with pytest.raises(InputError, match=r"cannot write .*x\.nc: Permission denied in .*; choose another directory"):
        check_writable(tmp_path / "x.nc")


def test_protected_file_is_refused(tmp_path, monkeypatch):
    kept = tmp_path / "kept.nc"
    kept.write_text("")
    monkeypatch.setattr(os, "access", lambda path, mode: not (path == kept and mode == os.W_OK))  # root always may
    with pytest.raises(InputError, match="write-protected"):
        check_writable(kept)
    assert check_writable(tmp_path / "x.nc")


def test_failed_write_leaves_the_old_file_and_nothing_else(tmp_path):
    path = tmp_path / "x.txt"
    path.write_text("old")

    def fail(temporary):
        temporary.write_text("half")
        raise RuntimeError("disk full")

    with pytest.raises(RuntimeError, match="disk full"):
        write_atomically(path, fail)
    assert path.read_text() == "old"
    assert os.listdir(tmp_path) == ["x.txt"]
    write_atomically(path, lambda temporary: temporary.write_text("new"))
    assert path.read_text() == "new"
