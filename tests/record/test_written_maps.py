"""Written maps: thin peaks masked, their place on the earth, all parameters."""

import numpy as np
import pytest
import rasterio
import rioxarray  # noqa: F401  the accessor rio
import xarray as xr

from landlab_debrisflow import DebrisFlow, InputError
from landlab_debrisflow.record import mask_peaks, write_maps
from validation.grids import inclined, release_slab


@pytest.fixture(scope="module")
def flow():
    grid = inclined((20, 60), 5.0, 0.5, soil=1.0, foot=150.0, xy_of_lower_left=(500000.0, 4100000.0))
    release_slab(grid, (500050.0, 4100048.0), 8.0, 1.0)
    grid.status_at_node[70:73] = grid.BC_NODE_IS_CLOSED
    flow = DebrisFlow(grid, numerics={"particle_count": 60})
    flow.run_one_step(6.0)
    return flow


def test_maps_are_found_on_the_earth(flow, tmp_path):
    path = write_maps(tmp_path / "maps.nc", flow.maps, crs="EPSG:32633", attributes={"terrain_sha256": "0af3"})
    with xr.open_dataset(path, decode_coords="all") as stored:
        assert stored.rio.crs.to_epsg() == 32633
        assert stored.rio.bounds() == (499997.5, 4099997.5, 500297.5, 4100097.5)
        assert stored.attrs["terrain_sha256"] == "0af3" and stored.attrs["setup_digest"] == flow.setup.digest()
        assert stored.attrs["peaks_masked_below"] == 0.05 and "date_created" in stored.attrs
        deep = flow.maps.debris_flow__max_depth >= 0.05
        assert 0 < int(deep.sum()) < int((flow.maps.debris_flow__max_depth > 0.0).sum())
        for name in ("max_depth", "max_speed", "arrival_time", "max_run_up"):
            assert np.array_equal(np.isfinite(stored[f"debris_flow__{name}"]), deep), name
        xr.testing.assert_equal(stored.debris_flow__depth.drop_vars("spatial_ref"), flow.maps.debris_flow__depth)
    with rasterio.open(f"netcdf:{path}:debris_flow__max_depth") as file:  # GDAL turns it north up
        assert file.crs.to_epsg() == 32633 and file.bounds == (499997.5, 4099997.5, 500297.5, 4100097.5)


def test_without_a_system_maps_are_written_alike(flow, tmp_path):
    with xr.open_dataset(write_maps(tmp_path / "maps.nc", flow.maps, least_depth=0.0)) as stored:
        assert "spatial_ref" not in stored
        reached = flow.maps.debris_flow__max_depth > 0.0
        assert np.array_equal(np.isfinite(stored.debris_flow__max_speed), reached)


def test_walls_keep_what_struck_them():
    def over(*values):
        return ("y", "x"), np.array([values])

    maps = xr.Dataset(
        {
            "debris_flow__max_depth": over(0.0, 0.02, 1.0, np.nan, np.nan),
            "debris_flow__max_impact_pressure": over(0.0, 5.0, 6.0, 7.0, 0.0),
        }
    )
    masked = mask_peaks(maps, 0.05)
    assert np.array_equal(masked.debris_flow__max_depth, [[np.nan, np.nan, 1.0, np.nan, np.nan]], equal_nan=True)
    pressure = [[np.nan, np.nan, 6.0, 7.0, np.nan]]
    assert np.array_equal(masked.debris_flow__max_impact_pressure, pressure, equal_nan=True)
    assert float(maps.debris_flow__max_impact_pressure[0, 1]) == 5.0


def test_refusals(flow, tmp_path):
    with pytest.raises(InputError, match=r"least_depth must lie in \[0, inf\] m, got -1"):
        mask_peaks(flow.maps, -1.0)
    with pytest.raises(InputError, match="the maps lack debris_flow__max_depth"):
        mask_peaks(flow.maps[["debris_flow__depth"]])
    with pytest.raises(InputError, match="attribute 'terrain' must be a text or a number"):
        write_maps(tmp_path / "maps.nc", flow.maps, attributes={"terrain": flow.maps})
    with pytest.raises(InputError, match="no such coordinate reference system, got 'WGS'"):
        write_maps(tmp_path / "maps.nc", flow.maps, crs="WGS")
    assert list(tmp_path.iterdir()) == []
