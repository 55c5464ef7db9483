"""Rasters of another lattice come onto that of the DEM; the same lattice comes as it is."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from landlab_debrisflow.core.errors import InputError
from landlab_debrisflow.geo.lattice import Lattice
from landlab_debrisflow.geo.references import transformed, wkt_of
from landlab_debrisflow.geo.resampling import read_onto, resample

from .files import NORTH, UTM, WEST, elevations, placed, write_tiff

Z = elevations()
LATTICE = Lattice((12, 16), (5.0, 5.0), (WEST + 2.5, NORTH - 57.5), wkt_of(UTM))


def plane(x, y):
    return 0.01 * (x - WEST) + 0.02 * (NORTH - y)


def write_plane(path, spacing, rows, columns, shift=0.0, crs=UTM):
    x = WEST + shift + spacing * (np.arange(columns) + 0.5)
    y = NORTH - shift - spacing * (np.arange(rows) + 0.5)
    return write_tiff(
        path, plane(*np.meshgrid(x, y)), crs=crs, transform=placed(WEST + shift, NORTH - shift, spacing, spacing)
    )


@pytest.mark.parametrize("shift", [0.0, 0.004])
def test_the_same_lattice_is_taken_as_it_is(tmp_path, shift):
    notes = []
    path = write_tiff(tmp_path / "soil.tif", Z, transform=placed(WEST + shift, NORTH - shift, 5.0, 5.0))
    assert_array_equal(read_onto(path, LATTICE, notes=notes), Z[::-1])
    assert notes == []
    part = LATTICE.cut(LATTICE.window_around((WEST + 20.0, NORTH - 30.0, WEST + 40.0, NORTH - 10.0)))
    assert_array_equal(read_onto(path, part), Z[2:6, 4:8][::-1])


@pytest.mark.parametrize(
    ("spacing", "rows", "columns", "shift"), [(10.0, 6, 8, 0.0), (5.0, 16, 20, -7.0), (1.0, 80, 100, -8.0)]
)
def test_another_lattice_is_resampled_and_said(tmp_path, spacing, rows, columns, shift):
    notes = []
    found = read_onto(write_plane(tmp_path / "soil.tif", spacing, rows, columns, shift), LATTICE, notes=notes)
    assert f"resampled from cells of {spacing:g} to 5 m" in notes[-1]
    inner = found[2:-2, 2:-2]  # bilinear and means keep a plane; at the edge of the file values are those of the edge
    assert_allclose(inner, plane(*np.meshgrid(LATTICE.x, LATTICE.y))[2:-2, 2:-2], atol=1e-9)
    assert np.isfinite(found).all()


def test_another_reference_system(tmp_path):
    x, y = transformed(np.array([WEST]), np.array([NORTH]), wkt_of(UTM), wkt_of("EPSG:32632"))
    path = tmp_path / "soil.tif"
    write_tiff(path, np.full((60, 80), 1.5), crs="EPSG:32632", transform=placed(x[0] - 60.0, y[0] + 60.0, 5.0, 5.0))
    notes = []
    assert_allclose(read_onto(path, LATTICE, notes=notes), 1.5)
    assert "EPSG:32632 (WGS 84 / UTM zone 32N) into EPSG:32633" in notes[0]


def test_a_raster_that_does_not_cover_is_refused(tmp_path):
    path = write_tiff(tmp_path / "soil.tif", Z[:, :10])
    with pytest.raises(InputError, match=r"over x 400000 to 400050 m.*the terrain over x 400000 to 400080 m"):
        read_onto(path, LATTICE)


def test_a_raster_of_a_part_has_no_data_beyond_its_edge(tmp_path):
    found = read_onto(write_tiff(tmp_path / "part.tif", Z[:, :10]), LATTICE, whole=False)
    assert_allclose(found[:, :10], Z[::-1, :10], rtol=1e-12)
    assert np.isnan(found[:, 11:]).all()
    far = write_tiff(tmp_path / "far.tif", Z, transform=placed(WEST + 500.0, NORTH, 5.0, 5.0))
    with pytest.raises(InputError, match=r"lies wholly outside the terrain.*in the system that it names"):
        read_onto(far, LATTICE, whole=False)


def test_means_keep_volume_and_missing_data_do_not_spread():
    coarse = Lattice((4, 4), (20.0, 15.0), (WEST + 10.0, NORTH - 52.5), LATTICE.crs)
    assert_allclose(resample(Z[::-1], LATTICE, coarse), Z[::-1].reshape(4, 3, 4, 4).mean(axis=(1, 3)), rtol=1e-12)
    holed = Z[::-1].copy()
    holed[:3, :2], holed[3:6, :1] = np.nan, np.nan
    means = resample(holed, LATTICE, coarse)
    assert means[0, 0] == pytest.approx(np.nanmean(holed[:3, :4])) and np.isfinite(means).all()
    holed[0, 2] = np.nan
    assert np.isnan(resample(holed, LATTICE, coarse)[0, 0])


@pytest.mark.parametrize("finer", ["bilinear", "cubic"])
def test_a_finer_lattice_goes_through_the_values(tmp_path, finer):
    fine = Lattice((36, 48), (5.0 / 3.0, 5.0 / 3.0), (WEST + 5.0 / 6.0, NORTH - 60.0 + 5.0 / 6.0), LATTICE.crs)
    holed = Z[::-1].copy()
    holed[4, 5] = np.nan
    found = resample(holed, LATTICE, fine, finer)
    assert np.isnan(found).sum() == 9 and np.isnan(found[12:15, 15:18]).all()
    middle = found[1::3, 1::3]
    far = np.ones(Z.shape, bool)
    far[2:7, 3:8] = False
    assert_allclose(middle[far], holed[far], atol=1e-9)
