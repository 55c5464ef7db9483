"""Observations: misfits of members made by hand, and refusals."""

from pathlib import Path

import geopandas
import numpy as np
import pytest
import rasterio
import shapely
import xarray as xr

from landlab_debrisflow import InputError
from landlab_debrisflow.calibration import (
    ArrivalTime,
    AtPoint,
    ChangeVolume,
    DepositOutline,
    ElevationChange,
    Measure,
    ModelError,
    RunOut,
    Volume,
)
from landlab_debrisflow.calibration.calibrate import criterion_of
from landlab_debrisflow.calibration.criteria import Likelihood, Tolerance
from landlab_debrisflow.calibration.place import Place
from landlab_debrisflow.ensemble import Ensemble, MemberResult
from landlab_debrisflow.geo.lattice import Lattice
from landlab_debrisflow.geo.references import wkt_of

LATTICE = Lattice((4, 6), (10.0, 10.0), (1000.0, 2000.0), "EPSG:32632")
RELEASED = np.zeros(LATTICE.shape)
RELEASED[2, 0] = 3.0
CLOSED = np.zeros(LATTICE.shape, bool)
CLOSED[3, 5] = True
PLACE = Place(LATTICE, Path("."), RELEASED, 300.0, CLOSED, (1000.0, 2020.0))
ROWS, COLUMNS = slice(1, 3), slice(2, 5)


def member(**maps):
    """Return a member whose window is two rows and three columns."""
    names = "deposit_depth", "depth", "eroded_depth", "max_depth", "arrival_time"
    arrays = {name: np.zeros((2, 3), np.float32) for name in names} | maps
    measures = {"run_out": 30.0, "budget_released": 150.0}
    return MemberResult(0, {}, measures, ROWS, COLUMNS, arrays)


def misfit(observation, one):
    return observation.at(PLACE).misfit(one)


def test_measures_and_run_out_are_simulated_less_observed():
    assert misfit(Measure("run_out", 28.0, 1.0), member()) == 2.0
    assert misfit(RunOut(1030.0, 2020.0 + 1e-9, 1.0), member()) == pytest.approx(0.0, abs=1e-6)
    assert misfit(RunOut(1040.0, 2020.0, 1.0), member()) == -10.0
    with pytest.raises(InputError, match=r"no measure 'runout' \(did you mean 'run_out'"):
        misfit(Measure("runout", 28.0, 1.0), member())


def test_values_at_points_are_those_of_the_cell():
    depth = np.arange(6, dtype=np.float32).reshape(2, 3)
    one = member(max_depth=depth, arrival_time=np.where(depth > 3.0, depth, np.nan).astype(np.float32))
    assert misfit(AtPoint("max_depth", 1043.0, 2018.0, 1.5, 0.1), one) == 5.0 - 1.5
    assert misfit(AtPoint("max_depth", 1000.0, 2000.0, 1.5, 0.1), one) == -1.5  # outside of the window
    assert misfit(ArrivalTime(1043.0, 2018.0, 1.5, 0.1), one) == 3.5
    assert misfit(ArrivalTime(1020.0, 2010.0, 1.5, 0.1), one) == np.inf  # in the window, at a dry node
    assert AtPoint("max_speed", 1000.0, 2000.0, 1.0, 1.0).at(PLACE).unit == "m/s"


def test_volumes_are_sums_of_cells_or_of_their_parts_inside_a_polygon():
    one = member(eroded_depth=np.full((2, 3), 0.5, np.float32))
    assert misfit(Volume("eroded_depth", 300.0, 10.0), one) == 0.0
    half = [[1015.0, 2005.0], [1030.0, 2005.0], [1030.0, 2015.0], [1015.0, 2015.0]]  # one cell and a half
    assert misfit(Volume("eroded_depth", 0.0, 10.0, half), one) == pytest.approx(75.0)


def test_the_change_of_elevation_is_deposit_less_erosion_without_the_release():
    observed = np.zeros(LATTICE.shape)
    observed[1, 2], observed[0, 0] = 2.0, np.nan
    given = xr.DataArray(observed, {"y": LATTICE.y, "x": LATTICE.x}, ("y", "x"))
    ones = np.ones((2, 3), np.float32)
    one = member(deposit_depth=2 * ones, depth=ones, eroded_depth=ones)
    # 24 nodes less one closed, one unknown and that of the release; 5 cells are off by 2 m, one by 0 m
    assert misfit(ElevationChange(given, 0.1), one) == pytest.approx(np.sqrt(5 * 4.0 / 21))
    # with the release, whose depth is 3 m times half of the volume: one more is off by 1.5 m
    assert misfit(ElevationChange(given, 0.1, source=True), one) == pytest.approx(np.sqrt((5 * 4.0 + 1.5**2) / 22))
    turned = given.transpose("x", "y").sortby("y", ascending=False)
    assert misfit(ElevationChange(turned, 0.1), one) == misfit(ElevationChange(given, 0.1), one)
    mask = shapely.box(1005.0, 2005.0, 1055.0, 2035.0)
    # 15 cells less one closed
    assert misfit(ElevationChange(given, 0.1, mask=mask), one) == pytest.approx(np.sqrt(5 * 4.0 / 14))


def test_volumes_of_a_change_are_sums_beyond_its_threshold():
    observed = np.zeros(LATTICE.shape)
    observed[1, 2], observed[1, 3], observed[0, 1], observed[2, 0] = (
        -2.0,
        1.0,
        -0.1,
        -3.0,
    )  # the last one is the release
    given = xr.DataArray(observed, {"y": LATTICE.y, "x": LATTICE.x}, ("y", "x"))
    change = ElevationChange(given, 0.1)
    depth = np.full((2, 3), 0.15, np.float32)
    depth[0, :2] = 0.0, 4.0
    one = member(deposit_depth=depth, eroded_depth=np.array([[1.0, 0.5, 0.0], [0.0, 0.0, 0.0]], np.float32))
    # simulated -1 and +3.5 m, observed -2 and +1 m on cells of 100 m2; 0.15 and -0.1 m are below the threshold of 0.2 m
    assert misfit(ChangeVolume(change, "lowered", 50.0), one) == pytest.approx(100.0 - 200.0)
    assert misfit(ChangeVolume(change, "raised", 50.0), one) == pytest.approx(350.0 - 100.0)
    # with the release, of which half of the volume left
    whole = ElevationChange(given, 0.1, source=True)
    assert misfit(ChangeVolume(whole, "lowered", 50.0), one) == pytest.approx(100.0 + 150.0 - 500.0)
    assert ChangeVolume(change, "lowered", 50.0).at(PLACE).label == "volume lowered outside of the release"


def test_correlated_errors_count_as_fewer_cells():
    given = xr.DataArray(np.zeros(LATTICE.shape), {"y": LATTICE.y, "x": LATTICE.x}, ("y", "x"))
    counts = [ElevationChange(given, 0.1, length).at(PLACE).stated.count for length in (0.0, 25.0, 1000.0)]
    assert counts == pytest.approx([22.0, 5.0 * 2200.0 / (np.pi * 625.0), 1.0])


def test_a_difference_of_surveys_may_be_a_file(tmp_path):
    values = np.ones(LATTICE.shape, np.float32)
    transform = rasterio.transform.from_origin(995.0, 2035.0, 10.0, 10.0)
    with rasterio.open(
        tmp_path / "dod.tif", "w", driver="GTiff", height=4, width=6, count=1, dtype="float32", crs="EPSG:32632",
        transform=transform,
    ) as file:  # fmt: skip
        file.write(values, 1)
    found = ElevationChange(tmp_path / "dod.tif", 0.1).observed(PLACE)
    assert np.array_equal(found, np.where(CLOSED, np.nan, 1.0), equal_nan=True)


def test_a_difference_of_surveys_may_end_within_the_dem(tmp_path):
    transform = rasterio.transform.from_origin(995.0, 2035.0, 10.0, 10.0)
    with rasterio.open(
        tmp_path / "dod.tif", "w", driver="GTiff", height=4, width=3, count=1, dtype="float32", crs="EPSG:32632",
        transform=transform,
    ) as file:  # fmt: skip
        file.write(np.ones((4, 3), np.float32), 1)
    known = np.isfinite(ElevationChange(tmp_path / "dod.tif", 0.1).observed(PLACE))
    assert known[:, :3].any() and not known[:, 4:].any()  # of column 3 the file has an edge


def test_the_outline_is_compared_by_the_area_between():
    # the deposit is 20 m by 30 m; the outline is the same rectangle, then one cell longer
    one = member(deposit_depth=np.ones((2, 3), np.float32))
    same, longer = shapely.box(1015.0, 2005.0, 1045.0, 2025.0), shapely.box(1015.0, 2005.0, 1055.0, 2025.0)
    assert misfit(DepositOutline(same, 1.0), one) == pytest.approx(0.0, abs=1e-9)
    assert misfit(DepositOutline(longer, 1.0), one) == pytest.approx(200.0 / 120.0)
    frame = geopandas.GeoDataFrame(geometry=[longer], crs="EPSG:32632").to_crs("EPSG:32633")
    assert misfit(DepositOutline(frame, 1.0), one) == pytest.approx(200.0 / 120.0, rel=0.02)


class Runs:
    """Event with observations at its nodes."""

    def __init__(self, *observations):
        self.bound = [one.at(PLACE) for one in observations]


def test_stated_errors_make_a_likelihood_none_make_abc_and_both_are_refused():
    stated, other = Measure("run_out", 28.0, 1.0), Measure("run_out", 28.0)
    assert isinstance(criterion_of([Runs(stated)], 8), Likelihood)
    assert isinstance(criterion_of([Runs(other)], 8), Tolerance)
    with pytest.raises(InputError, match=r"run_out has no stated error and other observations have one; state sd"):
        criterion_of([Runs(stated), Runs(other)], 8)


def test_observations_that_share_a_model_error_share_it():
    shared = ModelError(1.0)
    for error, same in ((shared, True), (1.0, False)):
        pair = [Measure("run_out", value, 1.0, error) for value in (28.0, 40.0)]
        errors = criterion_of([Runs(*pair)], 8).errors
        assert len(errors.model_errors(np.ones((2, 2)), np.full(2, 0.5))) == (1 if same else 2)


FAR = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]]
MAP = xr.DataArray(np.zeros(LATTICE.shape), {"y": LATTICE.y, "x": LATTICE.x}, ("y", "x"))
OTHER = MAP.assign_coords(spatial_ref=((), 0, {"crs_wkt": wkt_of("EPSG:32633")}))


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Measure("run_out", 28.0, 0.0), r"run_out: sd must lie in \(0, inf\], got 0.0"),
        (lambda: Measure("run_out", np.nan, 1.0), "run_out: value must lie in"),
        (lambda: Measure("run_out", 28.0, model_error=1.0), "a model error needs the error sd of the observation"),
        (lambda: ModelError(0.0), "ModelError: scale must lie in"),
        (lambda: AtPoint("max_dept", 0.0, 0.0, 1.0), r"no map 'max_dept' \(did you mean 'max_depth'\?\); there are"),
        (lambda: AtPoint("max_depth", 0.0, 0.0, 1.0).at(PLACE), "max_depth at .0, 0. lies outside of the grid"),
        (lambda: RunOut(1050.0, 2030.0).at(PLACE), "run-out to .1050, 2030. lies where the DEM has no data"),
        (lambda: RunOut(1000.0, 2000.0).at(PLACE._replace(centre=(np.nan, np.nan))), "the scene has none"),
        (lambda: DepositOutline(FAR).at(PLACE), "does not touch the grid.*coordinate reference system"),
        (lambda: DepositOutline(shapely.Point(1000.0, 2000.0)).at(PLACE), "a polygon is needed, got Point"),
        (lambda: ElevationChange(MAP[1:]).at(PLACE), r"has \(3, 6\) nodes.*the maps have \(4, 6\)"),
        (lambda: ElevationChange(OTHER).at(PLACE), "elevation change is in EPSG:32633 .*, the maps are in EPSG:32632"),
        (lambda: ElevationChange(MAP.values).at(PLACE), "a DataArray over y and x or a raster file is needed"),
        (lambda: ElevationChange(MAP * np.nan).at(PLACE), "only 0 cells have values"),
        (
            lambda: ChangeVolume(ElevationChange(MAP), "lowred"),
            r"must be lowered or raised, got 'lowred' \(did you mean",
        ),
        (lambda: ChangeVolume(MAP, "lowered"), "volume of a change: give an ElevationChange"),
        (lambda: ChangeVolume(ElevationChange(MAP), "raised", 0.0), r"volume raised: sd must lie in \(0, inf\]"),
        (lambda: ElevationChange(MAP, correlation_length=-1.0), "correlation_length must lie in"),
    ],
)
def test_bad_observations_are_refused(make, words):
    with pytest.raises(ValueError, match=words):
        make()


@pytest.mark.parametrize("source", ["ground", "above"])
def test_mass_that_is_laid_on_the_ground_does_not_lower_it(source):
    polygon = [[400020, 5200140], [400045, 5200140], [400045, 5200165], [400020, 5200165]]
    scene = {"terrain": {"example": "gully"}, "release": {"polygons": polygon, "volume": 900.0, "from": source}}
    ensemble = Ensemble(scene, {"release.factor": {"uniform": {"low": 0.5, "high": 2.0}}}, 2)
    place = Place.of_basis(ensemble.basis())
    assert place.volume == pytest.approx(900.0)
    assert place.released.sum() * place.lattice.area == pytest.approx(900.0 if source == "ground" else 0.0)
