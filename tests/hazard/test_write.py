"""Files of hazard maps: read back, styled, drawn, and the report of an ensemble."""

import re

import geopandas
import numpy as np
import pytest
import rasterio
import shapely
import xarray as xr

from landlab_debrisflow import InputError
from landlab_debrisflow.geo.styles import PROBABILITIES, class_labels
from landlab_debrisflow.hazard import (
    SWISS,
    exposure_probabilities,
    hazard_maps,
    hazard_matrix,
    write_danger_levels,
    write_hazard,
)
from landlab_debrisflow.plots import draw_probability
from landlab_debrisflow.report import write_ensemble_report
from landlab_debrisflow.run.files import STORE
from landlab_debrisflow.scene.gully import LATTICE

from ..ensemble.scenes import SCENE
from .fakes import fake_results

MAPS = "max_depth", "max_speed", "arrival_time"


def members(count):
    """Return members whose flow is 20 nodes wide and of random length and depth, the last one a failure."""
    rng = np.random.default_rng(5)
    drawn = []
    for _ in range(count - 1):
        depth = np.zeros(LATTICE.shape)
        depth[20:40, 10 : int(rng.uniform(60, 120))] = rng.uniform(0.2, 3.0)
        drawn.append({
            "max_depth": depth, "max_speed": 2.0 * depth,
            "arrival_time": np.where(depth > 0.0, np.arange(LATTICE.shape[1]) + 1.0, np.nan),
        })  # fmt: skip
    return [*drawn, "SimulationError: <b>burst</b>"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A directory as the command leaves it."""
    folder = tmp_path_factory.mktemp("valley_ensemble")
    results = fake_results(members(24), maps=MAPS, lattice=LATTICE, scene=SCENE, path=folder / STORE)
    maps, classes = hazard_maps(results, {"max_depth": [0.5]}, [0.5]), hazard_maps(results, scale=SWISS)
    x, y = LATTICE.x, LATTICE.y
    boxes = [shapely.box(x[50], y[30], x[55], y[33]), shapely.box(x[130], y[5], x[133], y[8])]
    houses = geopandas.GeoDataFrame({"name": ["<i>A</i>", "B"]}, geometry=boxes, crs=LATTICE.crs)
    table = exposure_probabilities(results, houses, {"max_depth": [0.5]}, identifier="name")
    elevation = np.add.outer(0.1 * LATTICE.y, -0.3 * (LATTICE.x - LATTICE.x[-1]))
    paths = write_hazard(folder, maps, elevation=elevation, exposure=table)
    paths += write_danger_levels(folder, hazard_matrix({300: classes}), elevation=elevation)
    return folder, maps, paths, classes


def test_files_are_read_back(folder):
    folder, maps, paths, _ = folder
    assert all(path.exists() for path in paths)
    with xr.open_dataset(folder / "hazard.nc", decode_coords="all") as file:
        assert file.attrs["ensemble_digest"] == "d" * 32 and file.attrs["members_failed"] == 1
        for name in maps:
            assert np.array_equal(file[name].values, maps[name].values, equal_nan=True), name
        assert file.topographic__elevation.attrs["units"] == "m" and "32N" in file.spatial_ref.attrs["crs_wkt"]
    with rasterio.open(folder / "probability_of_max_depth_above_0.5_m.tif") as file:
        expected = maps.probability_of_max_depth.values[0]
        assert np.array_equal(file.read(1)[::-1], np.where(expected > 0.0, expected, np.nan), equal_nan=True)
        assert file.tags()["ensemble_digest"] == "d" * 32 and file.tags()["sampling_error"].startswith("Wilson")
        assert file.crs.to_epsg() == 32632
    assert not list(folder.glob("*eroded*")) and (folder / "quantile_of_arrival_time_0.5.tif").exists()
    table = geopandas.read_file(folder / "exposure.gpkg")
    assert table["id"].tolist() == ["<i>A</i>", "B"] and table["p_reached"].tolist() == [1.0, 0.0]


def test_styles_name_their_classes(folder):
    text = (folder[0] / "probability_of_reached.qml").read_text(encoding="utf-8")
    labels = re.findall(r'label="([^"]+)"', text)
    assert labels == [label.replace("<", "&lt;").replace(">", "&gt;") for label in class_labels(PROBABILITIES)]
    levels = (folder[0] / "danger_level.qml").read_text(encoding="utf-8")
    assert re.findall(r'label="([^"]+)"', levels) == ["none", "residual", "low", "medium", "high"]
    assert re.findall(r'color="([^"]+)"', levels)[-1] == "#d7301f"


def test_pictures_show_the_error_beside_the_probability(folder):
    maps = folder[1]
    figure = draw_probability(maps, "max_depth", 0.5)
    shown, beside = figure.axes[:2]
    assert shown.get_title(loc="left") == "Probability of peak depth > 0.5 m"
    assert beside.get_title(loc="left") == "Standard error"
    drawn = shown.images[0].get_array()
    assert drawn.count() == int((maps.probability_of_max_depth[0] > 0.0).sum())
    assert len(draw_probability(maps, error=False).axes) == 1
    title = draw_probability(folder[3], "class", "strong").axes[0].get_title(loc="left")
    assert title == "Probability of the class strong or a more severe one"
    with pytest.raises(InputError, match="did you mean 'max_depth'"):
        draw_probability(maps, "max_depht")
    with pytest.raises(InputError, match=r"max_depth has no threshold 0.7; there are 0.5"):
        draw_probability(maps, "max_depth", 0.7)


def test_a_report_has_members_probabilities_and_polygons(folder):
    folder = folder[0]
    text = write_ensemble_report(folder).read_text(encoding="utf-8")
    assert "shares of 23 of 24 members (random)" in text and "takes 100 members; 77 more are needed" in text
    assert text.count('<img src="data:image/png') == 3  # reached, one threshold, danger levels
    rows = dict(re.findall(r'<th scope="row">(high|medium|low|residual)</th><td class="n">(\d[\s\d]*)', text))
    assert list(rows) == ["high", "medium", "low", "residual"] and float("".join(rows["high"].split())) > 0.0
    assert "300 years" in text and "Matrix of debris flows" in text
    assert "Member 23 failed" in text and "&lt;b&gt;burst" in text and "<b>burst" not in text
    assert "<i>A" not in text and "100 (86–100)" in text and "Some members reach 1 of the 2 polygons" in text
    assert "Complete" in text and "friction.basal_friction_angle" in text
    assert not re.search(r"(?:src|href)=\"(?!data:|#)", text)


def test_a_report_of_other_files_is_made_of_the_store(folder, tmp_path):
    """A hazard.nc of other members does not count; one that is damaged is refused."""
    scene = SCENE | {"ensemble": {"thresholds": {"max_speed": [3.0]}, "hazard_scale": "swiss"}}
    results = fake_results(members(8), maps=MAPS, lattice=LATTICE, scene=scene, path=tmp_path / STORE)
    (tmp_path / "hazard.nc").write_bytes((folder[0] / "hazard.nc").read_bytes())
    text = write_ensemble_report(tmp_path, tmp_path / "page.html").read_text(encoding="utf-8")
    assert (
        "shares of 7 of 8 members" in text
        and "peak speed &gt; 3 m/s" in text
        and "class strong" in text
        and results.done.all()
    )
    levels = tmp_path / "danger_level.nc"
    levels.write_bytes((folder[0] / "hazard.nc").read_bytes())
    with pytest.raises(InputError, match="write the danger levels again, or remove the file"):
        write_ensemble_report(tmp_path)
    with xr.open_dataset(folder[0] / "danger_level.nc") as file:
        file.load().assign_attrs(ensemble_digest="e" * 32).to_netcdf(levels)
    text = write_ensemble_report(tmp_path).read_text(encoding="utf-8")
    assert "danger_level.nc was made of other members" in text and "Area by danger level" not in text
    levels.unlink()
    (tmp_path / "hazard.nc").write_bytes(b"half")
    with pytest.raises(InputError, match="damaged"):
        write_ensemble_report(tmp_path)
