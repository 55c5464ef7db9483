"""Outputs of a short flow of few particles: every observer, every file."""

import geopandas
import numpy as np
import rasterio
import shapely
import xarray as xr

from landlab_debrisflow.geo.exposure import exposure, write_exposure
from landlab_debrisflow.geo.geotiff import write_geotiffs
from landlab_debrisflow.record import (
    Front,
    Gauges,
    MapSeries,
    MarkedColumns,
    Sections,
    Tracks,
    combine_maps,
    write_maps,
)  # fmt: skip

from .scenes import run

LINE = [(38.0, 0.0), (38.0, 40.0)]


def test_every_observer_and_every_file(tmp_path):
    series = MapSeries(0.2, tmp_path, crs="EPSG:32633")
    others = (
        Sections({"a": LINE}, 0.2), Gauges({"g": (30.0, 20.0)}, 0.2), Front([(0.0, 20.0), (110.0, 20.0)], 0.2),
        Tracks(0.2, 3), MarkedColumns(0.2, [1]),
    )  # fmt: skip
    flow = run(1.2, observers=(series, *others))
    flow.run_one_step(0.4)
    for observer in (series, *others):
        observer.restore(observer.state())
    sections, gauges, front, tracks, columns = (observer.dataset for observer in others)
    assert float(sections.crossed_volume[0]) > 0.0 and sections.sizes["time"] == 8
    assert float(gauges.depth.max()) > 0.1 and float(front.front_distance[-1]) > float(front.front_distance[0])
    assert float(tracks.speed.max()) > 1.0 and float(columns.excess_pore_pressure.max()) > 0.0
    for name in ("all.nc", "all.zarr"):
        path = combine_maps(tmp_path, tmp_path / name)
        with xr.open_dataset(path, engine="zarr" if name.endswith("zarr") else "netcdf4") as whole:
            assert whole.sizes["time"] == len(series.files) > 2
    path = write_maps(tmp_path / "end.nc", flow.maps, crs="EPSG:32633", attributes={"terrain_sha256": "0af3"})
    for path in write_geotiffs(tmp_path, flow.maps, crs="EPSG:32633"):
        with rasterio.open(path) as file:
            assert file.shape == flow.grid.shape
    houses = geopandas.GeoDataFrame(geometry=[shapely.box(30.0, 18.0, 34.0, 22.0)])
    table = exposure(flow.maps, houses)
    assert table.reached[0] and np.isfinite(table.first_arrival_s[0])
    for name in ("table.gpkg", "table.csv"):
        assert write_exposure(tmp_path / name, table).is_file()


def test_gauges_and_sections_of_two_phases():
    sections, gauges = Sections({"a": LINE}, 0.2), Gauges({"g": (30.0, 20.0)}, 0.2)
    run(1.2, observers=(sections, gauges), flow="two_phase")
    solid = gauges.dataset.solid_fraction.values
    assert np.nanmin(solid) > 0.0 and np.nanmax(solid) < 1.0
    assert 0.0 < float(sections.dataset.crossed_solid_volume[0]) < float(sections.dataset.crossed_volume[0])
