"""GeoTIFF maps: north up, where the grid is, with unit, digest and a style."""

import errno
import os
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
import rasterio
import rioxarray

from landlab_debrisflow import DebrisFlow, InputError
from landlab_debrisflow.geo.geotiff import MAPS, lattice_of, write_geotiff, write_geotiffs
from landlab_debrisflow.geo.lattice import Lattice
from landlab_debrisflow.geo.rasters import read_raster
from landlab_debrisflow.geo.styles import STYLES, Style, class_colours, class_labels, style_for, write_style
from validation.grids import inclined, release_slab


@pytest.fixture(scope="module")
def flow():
    grid = inclined((20, 60), (5.0, 4.0), 0.5, soil=1.0, foot=150.0, xy_of_lower_left=(500000.0, 4100000.0))
    release_slab(grid, (500050.0, 4100038.0), 8.0, 1.0)
    flow = DebrisFlow(grid, numerics={"particle_count": 60})
    flow.run_until_rest()
    return flow


def test_maps_come_back_where_they_were(flow, tmp_path):
    paths = write_geotiffs(tmp_path, flow.maps, [*MAPS, "topographic__elevation"], crs="EPSG:32633")
    assert [path.name for path in paths] == [f"{name}.tif" for name in (*MAPS, "topographic__elevation")]
    assert sorted(os.listdir(tmp_path)) == sorted(f"{path.stem}{s}" for path in paths for s in (".tif", ".qml"))
    with rasterio.open(paths[0]) as file:
        assert file.crs.to_epsg() == 32633 and file.transform.e < 0.0 < file.transform.a
        assert file.bounds == (499997.5, 4099998.0, 500297.5, 4100078.0)
        assert np.isnan(file.nodata) and file.dtypes == ("float32",) and file.units == ("m",)
        assert file.profile["compress"] == "deflate" and file.profile["tiled"]
        tags = file.tags()
        assert tags["setup_digest"] == flow.setup.digest() and tags["long_name"] == "Largest depth so far"
        assert tags["software"].startswith("landlab_debrisflow ") and tags["peaks_masked_below"] == "0.05 m"
        x, y = 500050.0, 4100036.0  # a node in the release
        depth = float(flow.maps.debris_flow__max_depth.sel(x=x, y=y))
        assert float(next(file.sample([(x, y)]))[0]) == pytest.approx(depth, rel=1e-6) and depth > 0.3
    for name, path in zip(MAPS, paths, strict=False):
        raster = rioxarray.open_rasterio(path).squeeze().sortby("y")
        given = flow.maps[f"debris_flow__{name}"].values
        shown = np.isfinite(raster.values)
        assert np.array_equal(raster.values[shown], given[shown].astype(np.float32)) and shown.any()
        assert raster.x.values == pytest.approx(flow.maps.x.values, abs=1e-6)
        assert raster.y.values == pytest.approx(flow.maps.y.values, abs=1e-6)
        raster.close()
    back = read_raster(paths[-1])
    assert back.lattice.shape == (20, 60) and back.lattice.lower_left == (500000.0, 4100000.0)
    assert np.nanmax(abs(back.values - flow.maps.topographic__elevation.values)) < 1e-5


def test_nothing_is_left_when_the_disk_is_full(flow, tmp_path, monkeypatch):
    write_geotiff(tmp_path / "a.tif", np.ones((2, 3)), Lattice((2, 3), (1.0, 1.0), (0.0, 0.0)))
    before = (tmp_path / "a.tif").read_bytes()

    def full(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(OSError, match="No space left"):
        write_geotiff(tmp_path / "a.tif", np.zeros((2, 3)), Lattice((2, 3), (1.0, 1.0), (0.0, 0.0)))
    assert os.listdir(tmp_path) == ["a.tif"] and (tmp_path / "a.tif").read_bytes() == before


def test_refusals(flow, tmp_path):
    with pytest.raises(InputError, match=r"no map 'max_dpth' \(did you mean 'max_depth'\?\); there are "):
        write_geotiffs(tmp_path, flow.maps, ["max_speed", "max_dpth"])
    with pytest.raises(InputError, match="a map is twice among the names"):
        write_geotiffs(tmp_path, flow.maps, ["max_speed", "debris_flow__max_speed"])
    with pytest.raises(InputError, match=r"cannot write to '.*nowhere': it does not exist"):
        write_geotiffs(tmp_path / "nowhere", flow.maps)
    with pytest.raises(InputError, match="no such coordinate reference system, got 'UTM'"):
        write_geotiffs(tmp_path, flow.maps, crs="UTM")
    with pytest.raises(InputError, match=r"must have the shape of the lattice \(2, 3\), got \(3, 2\)"):
        write_geotiff(tmp_path / "a.tif", np.zeros((3, 2)), Lattice((2, 3), (1.0, 1.0), (0.0, 0.0)))
    with pytest.raises(InputError, match="maps must be a Dataset over y and x"):
        lattice_of(None)
    with pytest.raises(InputError, match="y from south to north"):
        lattice_of(flow.maps.sortby("y", ascending=False))
    assert os.listdir(tmp_path) == []


def test_a_style_says_to_qgis_where_classes_end(tmp_path):
    path = write_style(tmp_path / "map.qml", Style((0.05, 0.5), "YlGnBu", unit="m"), transparent_below=True)
    items = ElementTree.parse(path).findall("pipe/rasterrenderer/rastershader/colorrampshader/item")
    assert [item.get("value") for item in items] == ["0.05", "0.5", "inf"]
    assert [item.get("label") for item in items] == ["< 0.05 m", "0.05 – 0.5 m", "> 0.5 m"]
    assert [item.get("alpha") for item in items] == ["0", "255", "255"]
    with pytest.raises(InputError, match=r"bounds must increase, at least one, got \(1.0, 1.0\)"):
        write_style(tmp_path / "map.qml", Style((1.0, 1.0), "YlGnBu"))


@pytest.mark.parametrize("name", STYLES)
def test_classes_differ_in_lightness(name):
    """The order is seen without hues, and in grey print: 5 % of the range between neighbours."""
    style = STYLES[name]
    lightness = class_colours(style) @ np.array([0.2126, 0.7152, 0.0722]) / 255.0
    steps = np.diff(lightness)
    assert np.all(steps < -0.03) or np.all(steps > 0.03), lightness
    assert len(class_labels(style)) == len(style.bounds) + 1


def test_a_map_without_a_style_of_its_own_is_divided_evenly():
    assert style_for("soil__depth", np.array([0.0, 6.0, np.nan])).bounds == pytest.approx((1, 2, 3, 4, 5))
    assert style_for("soil__depth", np.array([np.nan])).bounds[0] > 0.0
