"""Rasters of every form come in as the same values at the same place, or are refused with a remedy."""

import os
from pathlib import Path

import numpy as np
import pytest
import rasterio
import xarray as xr
from numpy.testing import assert_array_equal
from rasterio.transform import Affine

from landlab_debrisflow.core.errors import InputError
from landlab_debrisflow.geo.lattice import Lattice
from landlab_debrisflow.geo.rasters import open_raster, read_raster, read_window
from landlab_debrisflow.geo.references import same_place, utm_code, wkt_of

from ..unreadable import unreadable
from .files import NORTH, UTM, WEST, ascii_text, elevations, placed, write_tiff

Z = elevations()
BOUNDS = (WEST, NORTH - 60.0, WEST + 80.0, NORTH)
DATA = Path(os.environ.get("DEBRISFLOW_DATA", Path(__file__).parents[3] / "shared" / "data"))


def big(path):
    return write_tiff(path, Z, BIGTIFF="YES")


def tiled(path):
    return write_tiff(path, Z, tiled=True, blockxsize=16, blockysize=16, compress="deflate")


def south_up(path):
    return write_tiff(path, Z[::-1], transform=Affine(5.0, 0.0, WEST, 0.0, 5.0, NORTH - 60.0))


def scaled(path):
    with rasterio.open(write_tiff(path, ((Z - 1000.0) * 100.0).astype(np.int32)), "r+") as target:
        target.scales, target.offsets = (0.01,), (1000.0,)
    return path


def feet(path):
    with rasterio.open(write_tiff(path, Z / 0.3048), "r+") as target:
        target.units = ("ft",)
    return path


def two_bands(path):
    return write_tiff(path, Z, bands=2)


@pytest.mark.parametrize("write", [write_tiff, big, tiled, south_up, scaled, feet, two_bands])
def test_a_geotiff_of_any_form(tmp_path, write):
    path = write(tmp_path / "dem.tif", Z) if write is write_tiff else write(tmp_path / "dem.tif")
    raster = read_raster(path)
    tolerance = 1e-9 if write in (scaled, feet) else 0.0
    np.testing.assert_allclose(raster.values, Z[::-1], rtol=0.0, atol=tolerance)
    assert raster.lattice.bounds == BOUNDS and raster.lattice.spacing == (5.0, 5.0)
    assert rasterio.crs.CRS.from_wkt(raster.lattice.crs).to_epsg() == 32633
    assert len(raster.checksum) == 64


@pytest.mark.parametrize(
    ("write", "note"),
    [(scaled, "multiplied by 0.01 and 1000 is added"), (feet, "in ft and are multiplied"), (two_bands, "of 2 bands")],
)
def test_what_was_done_is_said(tmp_path, write, note):
    notes = []
    read_raster(write(tmp_path / "dem.tif"), notes=notes)
    assert any(note in each for each in notes)


def test_a_band_is_chosen(tmp_path):
    path = write_tiff(tmp_path / "dem.tif", Z, bands=2)
    with rasterio.open(path, "r+") as target:
        target.write(2.0 * Z, 2)
    assert_array_equal(read_raster(f"{path}:2").values, 2.0 * Z[::-1])
    with pytest.raises(InputError, match="a band, 1 to 2"):
        read_raster(f"{path}:3")


@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.int16, np.uint16, np.int32, np.uint8])
@pytest.mark.parametrize("stated", [True, False])
def test_missing_data_of_any_type(tmp_path, dtype, stated):
    values = np.round(Z / 8.0 if dtype == np.uint8 else Z).astype(dtype)
    if dtype == np.uint8 and not stated:
        return  # 255 is a value like any other unless the file says so
    missing = {np.uint8: 255, np.uint16: 65535, np.int32: -2147483648, np.int16: -32768}.get(dtype, -9999.0)
    values[2, 3] = missing
    notes = []
    path = write_tiff(tmp_path / "dem.tif", values, nodata=missing if stated else None)
    found = read_raster(path, notes=notes).values
    assert np.isnan(found[9, 3]) and np.isnan(found).sum() == 1
    assert any("marks missing data" in note for note in notes) != stated


@pytest.mark.parametrize("missing", [np.nan, np.inf, 3.4028234663852886e38, -3.4028234663852886e38, 1e20])
def test_missing_data_that_no_file_states(tmp_path, missing):
    values = Z.astype(np.float32)
    values[2, 3] = missing
    assert_array_equal(np.argwhere(np.isnan(read_raster(write_tiff(tmp_path / "dem.tif", values)).values)), [[9, 3]])


def test_a_further_value_marks_missing_data(tmp_path):
    values = Z.copy()
    values[0, 0] = 0.0
    assert np.isnan(read_raster(write_tiff(tmp_path / "dem.tif", values), missing=0.0).values[-1, 0])


def test_a_mask_beside_the_values(tmp_path):
    path = write_tiff(tmp_path / "dem.tif", Z)
    with rasterio.open(path, "r+") as target:
        target.write_mask(Z < 1050.0)
    assert_array_equal(np.isnan(read_raster(path).values), (Z >= 1050.0)[::-1])


def test_cells_that_are_no_squares(tmp_path):
    lattice = read_raster(write_tiff(tmp_path / "dem.tif", Z, spacing=(5.0, 2.0))).lattice
    assert lattice.spacing == (5.0, 2.0) and lattice.lower_left == (WEST + 2.5, NORTH - 23.0)


@pytest.mark.parametrize("form", ["tif", "up", "asc", "nc"])
def test_a_window_is_the_same_part_of_every_format(tmp_path, form):
    path = write_any(tmp_path, form)
    part = read_raster(path, bounds=(WEST + 11.0, NORTH - 30.0, WEST + 29.0, NORTH - 14.0))
    assert part.lattice.bounds == (WEST + 10.0, NORTH - 30.0, WEST + 30.0, NORTH - 10.0)
    assert_array_equal(part.values, Z[2:6, 2:6][::-1])
    source = open_raster(path)
    thin = read_window(source, source.lattice.window, (6, 8))
    assert thin.shape == (6, 8) and np.isin(thin, Z).all()
    # of four values one is taken: the corners stay those of the raster
    assert thin[0, 0] in Z[-2:, :2] and thin[-1, -1] in Z[:2, -2:]


def write_any(folder, form):
    if form == "tif":
        return write_tiff(folder / "dem.tif", Z)
    if form == "up":
        return south_up(folder / "dem.tif")
    if form == "asc":
        (folder / "dem.asc").write_text(ascii_text(Z))
        return folder / "dem.asc"
    return write_netcdf(folder / "dem.nc")


def test_a_window_outside_is_refused_with_both_extents(tmp_path):
    with pytest.raises(InputError, match=r"it covers x 400000 to 400080 m.*wanted is x 500000"):
        read_raster(write_tiff(tmp_path / "dem.tif", Z), bounds=(500_000.0, NORTH, 500_010.0, NORTH + 10.0))


def test_absurd_sizes_are_refused_before_they_are_read(tmp_path):
    path = tmp_path / "dem.tif"
    profile = {"driver": "GTiff", "height": 60_000, "width": 60_000, "count": 1, "dtype": "float32", "crs": UTM}
    with rasterio.open(path, "w", transform=placed(WEST, NORTH, 1.0, 1.0), SPARSE_OK=True, tiled=True, **profile):
        pass
    with pytest.raises(InputError, match="too many to be read at once"):
        read_raster(path)
    (tmp_path / "dem.asc").write_text(ascii_text(Z).replace("ncols 16", "ncols 160000000"))
    with pytest.raises(InputError, match="do not fit into its"):
        read_raster(tmp_path / "dem.asc")


# ---- ESRI ASCII ----


@pytest.mark.parametrize(
    "change",
    [
        lambda text: text,
        str.upper,
        lambda text: text.replace("\n", "\r\n"),
        lambda text: text.replace(".", ","),
        lambda text: text.replace("xllcorner 400000.0", "xllcenter 400002.5"),
        lambda text: text.replace("cellsize 5.0", "dx 5.0\ndy 5.0"),
        lambda text: text.replace("NODATA_value -9999\n", ""),
        lambda text: text.replace(" 10", "\n10"),
        lambda text: "\n  " + text.replace(" ", "\t   "),
    ],
)
def test_an_ascii_grid_of_any_form(tmp_path, change):
    path = tmp_path / "dem.asc"
    path.write_bytes(change(ascii_text(Z)).encode())
    raster = read_raster(path)
    assert_array_equal(raster.values, Z[::-1])
    assert raster.lattice == Lattice((12, 16), (5.0, 5.0), (WEST + 2.5, NORTH - 57.5), None)


def test_a_reference_beside_an_ascii_grid(tmp_path):
    (tmp_path / "dem.asc").write_text(ascii_text(Z))
    for text in (wkt_of(UTM), "Projection UTM\nZone 33\nDatum WGS84\nUnits METERS\nParameters\n"):
        (tmp_path / "dem.prj").write_text(text)
        assert same_place(read_raster(tmp_path / "dem.asc").lattice.crs, wkt_of(UTM), BOUNDS, 1e-6)
    (tmp_path / "dem.prj").write_text("a map")
    with pytest.raises(InputError, match=r"cannot read .*dem.prj.* remove the file and give crs"):
        read_raster(tmp_path / "dem.asc")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda text: text.replace("1064", "high"), "'high.*' is no number"),
        (lambda text: text[:-40], "promises 12 rows of 16 = 192"),
        (lambda text: text + "7 7 7\n", "195 values"),
        (lambda text: text[: len(text) // 2], "do not fit into|promises 12 rows"),
        (lambda text: text.replace("nrows 12\n", ""), "lacks nrows"),
        (lambda text: text.replace("cellsize 5.0", "cellsize 0"), "none"),
        (lambda text: text.replace("ncols 16", "ncols 1.5"), "1.5 columns"),
        (lambda text: text.replace("ncols 16", "ncols many"), "'ncols many'"),
        (lambda text: "\0" * 50 + text, "lacks|as a raster"),
        (lambda text: "Hello", "lacks nrows"),
    ],
)
def test_a_damaged_ascii_grid_is_refused(tmp_path, change, words):
    path = tmp_path / "dem.asc"
    path.write_text(change(ascii_text(Z)))
    with pytest.raises(InputError, match=words):
        read_raster(path)


@pytest.mark.skipif(not DATA.is_dir(), reason="needs the data of the real cases")
@pytest.mark.parametrize("name", ["s1000/pre_runout_DEM", "olivares/dem", "cascade2009/landslide_depth"])
def test_grids_of_real_cases_are_those_of_gdal(name):
    path = DATA / f"{name}.asc"
    with rasterio.open(path) as source:
        expected = source.read(1, masked=True).astype(float).filled(np.nan)[::-1]
    raster = read_raster(path)
    # gdal keeps 32 bits
    np.testing.assert_allclose(raster.values, expected, rtol=1e-7)


# ---- NetCDF ----


def write_netcdf(path, north_first=False, names=("y", "x"), crs=UTM, **others):
    y = NORTH - 57.5 + 5.0 * np.arange(12)
    data = xr.Dataset(
        {"elevation": (names, Z[::-1], {"units": "m"})}, {names[0]: y, names[1]: WEST + 2.5 + 5.0 * np.arange(16)}
    )
    for name, values in others.items():
        data[name] = (names, values)
    if crs:
        data["spatial_ref"] = ((), 0, {"crs_wkt": wkt_of(crs)})
        data["elevation"].attrs["grid_mapping"] = "spatial_ref"
    (data.isel({names[0]: slice(None, None, -1)}) if north_first else data).to_netcdf(path)
    return path


@pytest.mark.parametrize("north_first", [False, True])
@pytest.mark.parametrize("names", [("y", "x"), ("northing", "easting")])
def test_netcdf_of_any_order(tmp_path, north_first, names):
    raster = read_raster(write_netcdf(tmp_path / "dem.nc", north_first, names))
    assert_array_equal(raster.values, Z[::-1])
    assert raster.lattice.bounds == BOUNDS and "UTM zone 33N" in raster.lattice.crs


def test_a_variable_is_chosen(tmp_path):
    path = write_netcdf(tmp_path / "maps.nc", soil=0.0 * Z)
    with pytest.raises(InputError, match=r"several rasters: elevation, soil; choose one, such as maps.nc:elevation"):
        read_raster(path)
    assert_array_equal(read_raster(f"{path}:soil").values, 0.0 * Z)
    with pytest.raises(InputError, match=r"no raster 'soils' \(did you mean 'soil'\?\)"):
        read_raster(f"{path}:soils")


def test_coordinates_that_are_not_equally_spaced(tmp_path):
    path = write_netcdf(tmp_path / "dem.nc")
    with xr.open_dataset(path) as data:
        data.assign_coords(x=data.x + 0.001 * np.arange(16) ** 2).to_netcdf(tmp_path / "bent.nc")
    with pytest.raises(InputError, match="not equally spaced"):
        read_raster(tmp_path / "bent.nc")


def test_times_are_refused_with_the_way_to_one(tmp_path):
    path = tmp_path / "looks.nc"
    xr.Dataset({"h": (("time", "y", "x"), np.zeros((3, 4, 5)))}, {"x": np.arange(5.0), "y": np.arange(4.0)}).to_netcdf(
        path
    )
    with pytest.raises(InputError, match=r"the dimension time \(3\).*isel\(time=-1\)"):
        read_raster(path)


# ---- coordinate reference systems ----


def test_degrees_are_refused_with_the_command_that_reprojects(tmp_path):
    path = write_tiff(tmp_path / "dem.tif", Z, crs="EPSG:4326", transform=placed(13.2, 46.6, 2e-4, 2e-4))
    with pytest.raises(InputError) as refusal:
        read_raster(path)
    assert f"gdalwarp -t_srs EPSG:32633 -r bilinear {path} out.tif" in str(refusal.value)
    assert f"rio warp {path} out.tif --dst-crs EPSG:32633" in str(refusal.value)


@pytest.mark.parametrize("place", [(1e300, 0.0, WEST, 0.0, -1e300, NORTH), (5.0, 0.0, 1e15, 0.0, -5.0, NORTH)])
def test_no_map_reaches_so_far(tmp_path, place):
    path = write_tiff(tmp_path / "dem.tif", Z, transform=Affine(*place))
    with pytest.raises(InputError, match=r"no map reaches beyond 1e\+08 m"):
        read_raster(path)


def test_degrees_that_are_none(tmp_path):
    """A system in degrees over coordinates in metres is a wrong system: to reproject from it would lead nowhere."""
    path = write_tiff(tmp_path / "dem.tif", Z, crs="EPSG:4326")
    with pytest.raises(InputError, match=r"in degrees .* but its coordinates are not: x .* gdal_edit.py -a_srs"):
        read_raster(path)


def test_a_file_cut_off_names_the_reason_of_the_library(tmp_path):
    path = write_tiff(tmp_path / "dem.tif", Z)
    path.write_bytes(path.read_bytes()[:-300])
    with pytest.raises(InputError, match=r"(?i)read error") as failure:
        read_raster(path)
    assert "previous exception" not in str(failure.value) and ".;" not in str(failure.value)


def test_degrees_that_no_file_names(tmp_path):
    path = write_tiff(tmp_path / "dem.tif", Z, crs=None, transform=placed(-70.2, -33.4, 2e-4, 2e-4))
    with pytest.raises(InputError, match=r"look like degrees.*-s_srs EPSG:4326 -t_srs EPSG:32719"):
        read_raster(path)
    path = write_netcdf(tmp_path / "dem.nc", names=("lat", "lon"), crs=None)
    with pytest.raises(InputError, match="degrees"):
        read_raster(path)


@pytest.mark.parametrize(
    ("crs", "words"),
    [("EPSG:2229", "US survey foot"), ("EPSG:3857", "off by 45 %")],
)
def test_lengths_that_are_no_metres(tmp_path, crs, words):
    transform = {"EPSG:3857": placed(1_480_000.0, 5_860_000.0, 5.0, 5.0)}.get(crs, placed(6.5e6, 1.9e6, 5.0, 5.0))
    path = write_tiff(tmp_path / "dem.tif", Z, crs=crs, transform=transform)
    with pytest.raises(InputError, match=words):
        read_raster(path)


def test_heights_in_feet_of_the_reference_system(tmp_path):
    path = write_tiff(tmp_path / "dem.tif", Z / 0.3048, crs="EPSG:32633+8228")
    np.testing.assert_allclose(read_raster(path).values, Z[::-1], rtol=1e-12)
    np.testing.assert_allclose(read_raster(path, lengths=False).values, Z[::-1] / 0.3048, rtol=1e-12)


def test_a_reference_is_given_to_a_file_without_one(tmp_path):
    path, notes = write_tiff(tmp_path / "dem.tif", Z, crs=None), []
    assert read_raster(path, notes=notes).lattice.crs is None and "no coordinate reference system" in notes[0]
    assert "UTM" in read_raster(path, UTM).lattice.crs
    with pytest.raises(InputError, match="'EPSG:0' is no coordinate reference system"):
        read_raster(path, "EPSG:0")
    assert "33N" in read_raster(write_tiff(tmp_path / "own.tif", Z), "EPSG:32632").lattice.crs


@pytest.mark.parametrize(("longitude", "zone"), [(-180.0, "01"), (179.9, "60"), (180.0, "01"), (0.0, "31")])
def test_zones_of_utm(longitude, zone):
    assert utm_code(longitude, 10.0) == f"EPSG:326{zone}"


# ---- other refusals ----


def rotated(path):
    return write_tiff(
        path, Z, transform=Affine.translation(WEST, NORTH) @ Affine.rotation(10.0) @ Affine.scale(5.0, -5.0)
    )


def mirrored(path):
    return write_tiff(path, Z, transform=Affine(-5.0, 0.0, WEST, 0.0, -5.0, NORTH))


def nowhere(path):
    with pytest.warns(rasterio.errors.NotGeoreferencedWarning):
        return write_tiff(path, Z, crs=None, transform=Affine.identity())


def picture(path):
    return write_tiff(path, Z.astype(np.uint8), bands=3, photometric="RGB")


def imaginary(path):
    return write_tiff(path, Z.astype(np.complex64))


@pytest.mark.parametrize(
    ("write", "words"),
    [
        (rotated, "rotated transform.*gdalwarp -r bilinear .*dem.tif out.tif, or rio warp .*--dst-crs EPSG:32633"),
        (mirrored, "from east to west"),
        (nowhere, "no place on the map"),
        (picture, "the colour red of a picture"),
        (imaginary, "no real numbers"),
        (lambda path: path, "there is no such file"),
        (lambda path: path.touch() or path, "the file is empty"),
        (lambda path: path.write_text("no map") and path, "as a raster"),
        (lambda path: path.mkdir() or path, "a directory"),
        (lambda path: path.write_bytes(big(path).read_bytes()[:700]) and path, "cannot read"),
        (lambda path: path.write_bytes(b"\x89HDF\r\n\x1a\n" + b"x" * 500) and path, "as NetCDF"),
        (lambda path: path.write_bytes(b"CDF\x01" + b"x" * 500) and path, "as NetCDF"),
        (lambda path: path.with_name("x" * 300), "cannot read"),
        (lambda path: path.with_name("a\0b"), "cannot read"),
    ],
)
def test_what_is_no_raster_is_refused(tmp_path, write, words):
    path = write(tmp_path / "dem.tif")
    with pytest.raises(InputError, match=words):
        read_raster(path)


def test_a_misspelt_name_gets_a_hint(tmp_path):
    write_tiff(tmp_path / "dem_5m.tif", Z)
    with pytest.raises(InputError, match=r"did you mean 'dem_5m.tif'\?"):
        read_raster(tmp_path / "dem_5n.tif")


@pytest.mark.skipif(os.name != "posix", reason="permissions of POSIX")
def test_an_unreadable_file(tmp_path):
    with unreadable(write_tiff(tmp_path / "dem.tif", Z)) as path, pytest.raises(InputError, match="cannot read"):
        read_raster(path)
