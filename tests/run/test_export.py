"""Maps written as a run went, in other formats; runs that are gone on with by their directory or file."""

import numpy as np
import pytest
import rasterio
import xarray as xr

from landlab_debrisflow import InputError, Scene
from landlab_debrisflow.record.monitor import Monitor
from landlab_debrisflow.run.export import export
from landlab_debrisflow.run.resume import resume
from landlab_debrisflow.run.runner import run_scene

from .running import FIRST, Stopping, scene

FILE = f"""\
terrain: {{example: gully, soil_depth: 2.0}}
release: {{polygons: {FIRST}, depth: 1.5}}
output: {{max_duration: 4.0, interval: 2.0}}
numerics: {{particle_count: 60}}
"""


@pytest.mark.slow
def test_all_formats_hold_the_same_maps(tmp_path):
    results = run_scene(scene(tmp_path, max_duration=5.0), monitor=Monitor(live=False))
    folder = results.directory
    assert export(folder) == [folder / "series.nc"] and export(folder, "zarr") == [folder / "series.zarr"]
    with xr.open_dataset(folder / "series.nc") as first, xr.open_zarr(folder / "series.zarr") as second:
        maps = first.load()
        assert all(np.array_equal(maps[name].values, second[name].values) for name in maps)
    paths = export(folder, "geotiff")
    assert len(paths) == maps.sizes["time"] * sum("time" in data.dims for data in maps.values()) and all(
        path.is_file() for path in paths
    )
    last = [path for path in paths if path.name.startswith("debris_flow__depth_")][-1]
    with rasterio.open(last) as file:
        values = file.read(1)[::-1]
        assert file.crs.to_epsg() == 32632 and values.shape == results.maps.debris_flow__max_depth.shape
    assert values.max() == maps.debris_flow__depth.values[-1].max() > 0.0
    row, column = np.unravel_index(values.argmax(), values.shape)
    deepest = maps.debris_flow__depth.isel(time=-1).stack(node=("y", "x")).idxmax()
    assert (results.maps.y[row], results.maps.x[column]) == deepest.item()
    before = {path.name for path in folder.iterdir()}
    for path in (folder / "series").glob("maps_*.nc"):
        path.unlink()  # as after rest
    (folder / "series.zarr").rename(tmp_path / "first.zarr")
    assert export(folder, "zarr") == [folder / "series.zarr"]
    with xr.open_zarr(folder / "series.zarr") as second:
        assert all(np.array_equal(maps[name].values, second[name].values) for name in maps)
    assert {path.name for path in folder.iterdir()} == before


def test_no_maps_and_no_format(tmp_path):
    with pytest.raises(InputError, match="must be netcdf, zarr or geotiff, got 'grib'"):
        export(tmp_path, "grib")
    with pytest.raises(InputError, match="holds no results of a run"):
        export(tmp_path)


@pytest.mark.slow
def test_a_run_without_maps_says_how_to_get_them(tmp_path):
    results = run_scene(scene(tmp_path, max_duration=1.0, interval=None), monitor=Monitor(live=False))
    with pytest.raises(InputError, match="set output: interval in the scene"):
        export(results.directory)


@pytest.mark.slow
def test_a_run_goes_on_by_its_directory_or_its_file(tmp_path, monkeypatch):
    (tmp_path / "scenes").mkdir()
    path = tmp_path / "scenes" / "slope.yaml"
    path.write_text(FILE, encoding="utf-8")
    for given in (path, path.with_name("slope_out")):
        with pytest.raises(KeyboardInterrupt):
            run_scene(Scene.from_file(path), overwrite=True, monitor=Stopping(5))
        assert resume(given, monitor=Monitor(live=False)).elapsed_time == 4.0
    copy = path.with_name("slope_out") / "scene.yaml"
    assert copy.read_text(encoding="utf-8") == FILE
    (tmp_path / "scenes").rename(tmp_path / "moved")  # both together
    monkeypatch.chdir(tmp_path / "moved" / "slope_out")
    assert resume(".", monitor=Monitor(live=False)).elapsed_time == 4.0
    (tmp_path / "moved" / "slope.yaml").write_text(FILE.replace("interval: 2.0", "directory: other"), encoding="utf-8")
    with pytest.raises(InputError, match="which now writes to"):
        resume(".")


@pytest.mark.slow
def test_a_scene_from_a_mapping_goes_on_in_python_only(tmp_path):
    with pytest.raises(KeyboardInterrupt):
        run_scene(scene(tmp_path), monitor=Stopping(5))
    with pytest.raises(InputError, match="came from no scene file"):
        resume(tmp_path / "scene_out")
