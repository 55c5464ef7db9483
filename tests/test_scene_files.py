"""The example scenes run, shortened, and their files are those that examples/scene_files.py writes."""

import os
import shutil
from pathlib import Path

import numpy as np
import pytest
import rasterio

from landlab_debrisflow import Scene, simulate

ROOT = Path(__file__).parents[1]
SCENES = ROOT / "examples" / "scenes"
DATA = Path(os.environ.get("DEBRISFLOW_DATA") or ROOT.parent / "shared" / "data") / "s1000"


def test_every_scene_is_small_and_known():
    assert sorted(path.name for path in SCENES.glob("*.yaml")) == ["dam.yaml", "s1000.yaml", "surge.yaml"]
    assert sum(path.stat().st_size for path in SCENES.iterdir()) < 100_000


@pytest.mark.slow
def test_a_dam_and_buildings_stand_in_the_terrain():
    scene = Scene.from_file(SCENES / "dam.yaml")
    assert abs(scene.releases[0].depth.sum() * 25.0 - 900.0) < 1e-6
    assert list(scene.places.exposure) == ["mill", "farm", "barn"]
    assert any("dam" in note for note in scene.notes) and any("buildings" in note for note in scene.notes)
    maps = simulate(None, scene, 5.0)
    assert maps.debris_flow__max_depth.max() > 0.5 and maps.attrs["budget_released"] == pytest.approx(900.0, rel=1e-9)


@pytest.mark.slow
def test_a_surge_enters_the_channel():
    scene = Scene.from_file(SCENES / "surge.yaml")
    (surge,) = scene.setup.inflow
    assert surge.volume == 25.0 * 20.0 / 2.0 + 35.0 / 2.0 * 40.0 + 10.0 * 120.0 / 2.0
    maps = simulate(None, scene, 10.0)
    assert maps.attrs["budget_inflow"] == pytest.approx(25.0 * 10.0**2 / 40.0, rel=0.05)


@pytest.mark.slow
def test_a_real_landslide(tmp_path):
    if not (DATA / "pre_runout_DEM.asc").is_file():
        pytest.skip("needs the rasters of S-1000 in $DEBRISFLOW_DATA/s1000")
    for name in ("pre_runout_DEM.asc", "landslide_depth.asc"):
        shutil.copy(DATA / name, tmp_path)
    scene = Scene.from_file(shutil.copy(SCENES / "s1000.yaml", tmp_path))
    assert any("losses of elevation" in note for note in scene.notes)
    maps = simulate(None, scene, 5.0)
    assert maps.attrs["budget_released"] == pytest.approx(22_481.0, rel=1e-3)


@pytest.mark.slow
def test_the_files_are_those_of_the_script(tmp_path):
    from tests.test_examples import load

    load("scene_files").main(tmp_path)
    for name in ("release.geojson", "buildings.geojson", "surge.csv"):
        assert (tmp_path / name).read_text() == (SCENES / name).read_text()
    with rasterio.open(tmp_path / "gully.tif") as made, rasterio.open(SCENES / "gully.tif") as kept:
        assert np.array_equal(made.read(1), kept.read(1)) and made.transform == kept.transform and made.crs == kept.crs
