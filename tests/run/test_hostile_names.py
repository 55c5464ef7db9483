"""Names and texts from files that a terminal, a page or a file system would obey: they are shown, and do nothing."""

import contextlib
import json
import os
import re

import pytest

from landlab_debrisflow.cli import exit_codes, main
from landlab_debrisflow.run.directory import OutputDirectory
from landlab_debrisflow.run.record import RunRecord
from landlab_debrisflow.run.results import Results
from landlab_debrisflow.run.scene import Scene

NAMES = (
    "[red]red[/red]", "[/]", "<script>alert(1)</script>", "\x1b[31mred\x07", "a\nb\rc", "../../above", "/tmp/root",
    "\u202eback", "{0}%s",
)  # fmt: skip
OBEYED = re.compile("[\x00-\x09\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")
OUTLINE = [[400020, 5200145], [400050, 5200145], [400050, 5200170], [400020, 5200170], [400020, 5200145]]
SCARS = "[red]\x1b[31m<b>.geojson"


def features(kind, coordinates, names, **attributes):
    """Return the text of a GeoJSON in the coordinate reference system of the gully."""
    found = [
        {"type": "Feature", "properties": {"name": name} | attributes, "geometry": {"type": kind, "coordinates": one}}
        for name, one in zip(names, coordinates, strict=True)
    ]
    crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32632"}}
    return json.dumps({"type": "FeatureCollection", "crs": crs, "features": found})


def write_scene(folder, attributes=("depth",), **output):
    """Write a scene whose files, features and attributes have such names; return its path."""
    folder.mkdir(exist_ok=True)
    own = dict.fromkeys(attributes, 1.5) | dict.fromkeys(NAMES, "x")
    (folder / SCARS).write_text(features("Polygon", [[OUTLINE]], NAMES[3:4], **own))
    points = [[400060 + 5 * k, 5200150] for k in range(len(NAMES))]
    (folder / "gauges.geojson").write_text(features("Point", points, NAMES))
    houses = [[[[x + 100, y] for x, y in OUTLINE]]] * len(NAMES)
    (folder / "houses.geojson").write_text(features("Polygon", houses, NAMES))
    scene = {
        "terrain": {"example": "gully", "soil_depth": 2.0}, "release": {"polygons": SCARS},
        "numerics": {"particle_count": 60},
        "output": {"max_duration": 1.0, "gauges": "gauges.geojson", "exposure": "houses.geojson"} | output,
    }  # fmt: skip
    path = folder / "[blink]<i>.yaml"
    path.write_text(json.dumps(scene))
    return path


def is_shown(text):
    return not OBEYED.search(text)


@pytest.mark.slow
def test_a_run_shows_them_and_writes_nowhere_else(tmp_path, capsys, monkeypatch):
    path = write_scene(tmp_path / "inner")
    before = {one: one.stat().st_mtime_ns for one in tmp_path.rglob("*") if one.is_file()}
    monkeypatch.chdir(tmp_path)
    log = tmp_path / "log.txt"
    assert main.main(["check", str(path)]) == exit_codes.DONE
    assert main.main(["run", str(path), "--log", str(log), "-v"]) == exit_codes.STILL_MOVING
    out, err = capsys.readouterr()
    assert is_shown(out) and is_shown(err) and is_shown(log.read_text())
    after = {one for one in tmp_path.rglob("*") if one.is_file()} - {log}
    results = tmp_path / "inner" / "[blink]<i>_out"
    assert {one for one in after if not one.is_relative_to(results)} == set(before)
    assert all(one.stat().st_mtime_ns == time for one, time in before.items())
    page = Results(results)._repr_html_()
    assert "<i>" not in page and "&lt;i&gt;" in page


def test_refusals_show_them(tmp_path, capsys):
    path = write_scene(tmp_path, attributes=())
    assert main.main(["check", str(path)]) == exit_codes.USER_ERROR
    out, err = capsys.readouterr()
    assert not out and len(err.splitlines()) == 1 and is_shown(err.rstrip("\n"))
    assert "[red]red[/red]" in err and "\\x1b[31mred" in err  # attributes are listed, none taken for markup


@pytest.mark.parametrize(
    "name",
    ["*", "**", "**/*", "../*", "series/*", "sub/*", "photo.jpg/..", "", ".", "/", 5, None, "series/../../keep.txt"],
)
def test_a_record_removes_nothing_of_others(name, tmp_path):
    """A record is a file as others are: what it says was written is removed if it is what runs write."""
    scene = Scene.from_file(write_scene(tmp_path, directory="results"))
    results = tmp_path / "results"
    with OutputDirectory.claimed(results) as directory:
        directory.begin(RunRecord.of(scene))
    record = results / "run.json"
    record.write_text(json.dumps(json.loads(record.read_text()) | {"files": [name]}))
    mine = [results / one for one in ("photo.jpg", "series/photo.jpg", "sub/maps.nc", "../keep.txt")]
    for one in mine:
        one.parent.mkdir(exist_ok=True)
        one.write_text("mine")
    with contextlib.suppress(ValueError), OutputDirectory.claimed(results) as directory:
        repr(Results(results))
        directory.begin(RunRecord.of(scene), overwrite=True)
    assert all(one.read_text() == "mine" for one in mine)


@pytest.mark.parametrize("target", ["file", "directory"])
def test_links_in_a_directory_of_results_are_replaced_and_not_followed(target, tmp_path):
    scene = Scene.from_file(write_scene(tmp_path / "inner", directory="results"))
    outside = tmp_path / "outside"
    outside.mkdir()
    (outside / "mine.txt").write_text("mine")
    results = tmp_path / "inner" / "results"
    with OutputDirectory.claimed(results) as directory:
        directory.begin(RunRecord.of(scene))
    for name in ("maps.nc", ".unfinished", "scene.yaml"):
        (results / name).unlink(missing_ok=True)
        (results / name).symlink_to(outside / "mine.txt" if target == "file" else outside)
    with contextlib.suppress(ValueError, OSError), OutputDirectory.claimed(results) as directory:
        directory.begin(RunRecord.of(scene), overwrite=True)
        directory.publish(lambda folder: (folder / "maps.nc").write_text("new"))
    assert os.listdir(outside) == ["mine.txt"] and (outside / "mine.txt").read_text() == "mine"


@pytest.mark.parametrize("name", ["/dev/zero", "/dev/stdin", "pipe", "folder", "loop", "/proc/self/mem"])
@pytest.mark.parametrize("key", ["elevation", "soil_depth", "polygons", "hydrograph", "gauges"])
def test_what_is_no_file_is_refused_at_once(name, key, tmp_path):
    """Devices and pipes have no end: a reader that opens one waits for ever."""
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "folder").mkdir()
    (tmp_path / "loop").symlink_to("loop")
    mapping = {
        "terrain": {"elevation": name} if key == "elevation" else {"example": "gully"},
        "release": {"polygons": [OUTLINE], "depth": 1.0}, "output": {"gauges": name} if key == "gauges" else {},
    }  # fmt: skip
    if key == "soil_depth":
        mapping["terrain"]["soil_depth"] = name
    elif key == "polygons":
        mapping["release"] = {"polygons": name}
    elif key == "hydrograph":
        mapping["release"] = {"points": [[400060, 5200150]], "hydrograph": name, "speed": 3.0, "width": 10.0}
    scene = Scene.from_mapping(mapping, tmp_path)
    with pytest.raises(ValueError, match=re.escape(name)):
        _ = scene.releases, scene.setup, scene.places
