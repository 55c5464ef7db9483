"""A report tells what the run was given, what came out, how sure it is, and how it was made."""

import json
import re

import numpy as np
import pytest

from landlab_debrisflow import Scene, __version__, measures
from landlab_debrisflow.report import write_report
from landlab_debrisflow.report.inputs import input_blocks
from landlab_debrisflow.report.numbers import rounded
from landlab_debrisflow.report.outcome import outcome_of
from landlab_debrisflow.run.results import Results

from .conftest import HOUSE, NAME
from .reading import read_page

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def read(page):
    return read_page(page)


def summary(read):
    return next(" ".join(text.split()) for tag, given, text in read.elements if given.get("class") == "summary")


def test_the_summary_is_that_of_record_and_maps(results, read):
    words, budget, maps = summary(read), results.budget, results.maps
    for number in (
        rounded(budget["eroded"], "m³"), rounded(float(maps.debris_flow__max_depth.max()), "m"),
        rounded(float(maps.debris_flow__max_speed.max()), "m/s"),
    ):  # fmt: skip
        assert " ".join(number.split()) in words
    assert words.startswith("1 130 m³ of ground failed; ") and "It was still moving when" in words
    assert f"Of the 2 polygons given as exposed it reached 1: {HOUSE}." in words
    assert words.endswith("No errors were stated for these numbers.")
    assert read.texts("h1") == [NAME] and "Still moving at its end" in read.texts("p")


def test_run_out_is_counted_from_the_release(results):
    """By hand: 99 % of the mass, which still moves, lies nearer to the centre of the outline, (400035, 5200157.5)."""
    found, maps = outcome_of(results.maps), results.maps
    x, y = np.meshgrid(maps.x, maps.y)
    depth = np.nan_to_num(maps.debris_flow__depth.values)
    far = np.hypot(x - 400035.0, y - 5200157.5)
    nearer = [depth[far <= found.run_out + off].sum() / depth.sum() for off in (-6.0, 6.0)]  # a node and a bit
    assert nearer[0] < 0.99 < nearer[1]
    assert 10.0 < found.travel_angle < 40.0
    assert float(measures(maps, results.before).run_out) != found.run_out  # its deposit only, which is empty


def test_every_parameter_is_there_with_unit_and_whether_it_was_given(read):
    rows = {row[0]: row for row in read.table("friction: voellmy")}
    assert rows["turbulent_coefficient"][1:4] == ["300 m/s²", "given", "Voellmy's xi: large means little drag"]
    assert rows["basal_friction_angle"][1:3] == ["30.9638°", "default"] and rows["cohesion"][2] == "default"
    assert "Voellmy (1955); Hungr (1995)" in " ".join(read.texts("caption"))
    assert all(f" {name} " in f" {' '.join(read.texts('caption'))} " for name in ("material", "erosion:", "column:"))
    assert {row[0]: row[2] for row in read.table("numerics")}["particle_count"] == "given"
    words, origin = {row[0]: row[1:3] for row in read.table("material")}["coefficient_of_consolidation"]
    assert words.startswith("0.0004 m²/s, from permeability 2e-12 m²") and "stiffness 200000 Pa" in words
    assert origin == "given"


def test_keys_of_the_scene_are_there(read):
    assert {row[0]: row[1:3] for row in read.table("terrain")}["soil_depth"] == ["2 m", "given"]
    assert {row[0]: row[1:3] for row in read.table("release 1")}["polygons"] == ["4 pairs", "given"]
    assert {row[0]: row[2] for row in read.table("output")}["least_depth"] == "default"


def test_the_ledger_adds_up(results, read):
    cells = {row[0]: row[1] for row in read.table("Volumes")}
    assert cells["eroded on the way"].replace(" ", "").replace("\xa0", "") == f"{results.budget['eroded']:.1f}"
    assert "more than rounding" not in " ".join(read.texts("p"))


def test_maps_sections_series_are_pictures_with_words(read):
    pictures = [given for tag, given, _ in read.elements if tag == "img"]
    assert len(pictures) >= 5 and all(given["alt"].strip() and given["src"] for given in pictures)
    captions = " ".join(read.texts("figcaption"))
    assert all(words in captions for words in ("vertical depth", "Péclet", "Long section", "Hydrographs", "gauges"))


def test_pictures_say_what_they_show(read):
    alternatives = [attributes["alt"] for tag, attributes, _ in read.elements if tag == "img"]
    pictures = [attributes["src"].split(";")[0] for tag, attributes, _ in read.elements if tag == "img"]
    assert any(re.fullmatch(r"Map: Peak speed\. Largest value: [\d.]+\sm/s\.", words) for words in alternatives)
    assert any(
        re.fullmatch(r"Map: Peak basal pressure ratio\. Largest value: [\d.]+\.", words) for words in alternatives
    )
    assert any(words.startswith("Long section along the thalweg of the scene") for words in alternatives)
    assert pictures.count("data:image/gif") == 1  # the animation, of the series that the scene asks for
    assert alternatives[pictures.index("data:image/gif")] == "Animation of the depth of the flow from 3 to 9 s."


def test_input_and_provenance(results, read):
    terrain = dict(read.table("Terrain"))
    assert terrain["coordinate reference system"] == "WGS 84 / UTM zone 32N (EPSG:32632)"
    assert terrain["grid"].startswith("61 rows × 141 columns of nodes, 5 m apart")
    run = dict(read.table("The run"))
    assert run["package"] == f"landlab_debrisflow {__version__}" and "numba" in run["libraries"]
    assert run["digest of keys and files"] == results.record.digest
    scene = Scene.from_file(results.directory / results.record.scene_file)
    assert run["digest of the scene"] == scene.digest()
    assert "doi = {10.1002/nag.3339}" in read.texts("pre")[-1]
    words = " ".join(read.texts("p"))
    assert "Not modelled are boulders and wood" in words and "Made by landlab-debrisflow report" in words
    assert len(read.texts("li")) > 5  # of which five to distrust


def test_the_dem_is_told_by_its_name_and_checksum(results):
    maps = results.maps.assign_attrs(dem="../dem 2021.tif", dem_sha256="0f" * 32)
    terrain = dict(input_blocks(results.record, maps)[0].rows)
    assert terrain["elevation from"] == "../dem 2021.tif" and terrain["its SHA-256"] == "0f" * 32


def test_stated_errors_are_those_of_the_run(results, tmp_path):
    record = json.loads((results.directory / "run.json").read_text())
    record["statement"] = {"errors": {"run_out": 0.031, "speed": None}, "raster_errors": {"run_out": 0.01}}
    folder = tmp_path / "planned"
    folder.mkdir()
    for name in ("maps.nc",):
        (folder / name).write_bytes((results.directory / name).read_bytes())
    (folder / "run.json").write_text(json.dumps(record))
    read = read_page(write_report(Results(folder)))
    assert read.table("Stated errors")[1:] == [
        ["run-out", "3.1 %", "1.0 %"],
        ["peak speed", "not known", "not examined"],
    ]
    assert "by no more than: run-out 3.1 % and 1.0 %. The error of peak speed is not known." in summary(read)
