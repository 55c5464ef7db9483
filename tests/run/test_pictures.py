"""Pictures of a run: all that its directory holds, each told when it is there."""

import shutil

import matplotlib
import numpy as np
import pytest
import xarray as xr

from landlab_debrisflow import InputError
from landlab_debrisflow.cli import exit_codes, main
from landlab_debrisflow.run.directory import OutputDirectory
from landlab_debrisflow.run.pictures import draw_pictures
from landlab_debrisflow.run.recorded import read_recorded

from .running import Stopping, scene

PLACES = {
    "gauges": {"Fläche <1>": [400100, 5200155]}, "sections": {"$weir": [[400100, 5200110], [400100, 5200190]]},
    "thalweg": [[400037, 5200157], [400150, 5200157], [400250, 5200142]], "tracks": 5, "columns": 2,
    "series_interval": 1.0, "maps": ["max_run_up"],
}  # fmt: skip


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Return the directory of the results of a run."""
    return scene(tmp_path_factory.mktemp("pictures"), **PLACES).run().directory


def names(paths):
    return [path.name for path in paths]


@pytest.mark.slow
def test_everything_that_was_recorded_is_drawn_and_noted(run):
    written = list(draw_pictures(run, dpi=30))
    assert names(written) == [
        "overview.png", "max_depth.png", "max_speed.png", "arrival_time.png", "elevation_change.png",
        "max_basal_pressure_ratio.png", "max_basal_peclet_number.png", "max_run_up.png", "section.png", "tracks.png",
        "time_distance.png", "hydrographs.png", "gauges.png", "volumes.png", "column.png", "depth.gif",
    ]  # fmt: skip
    assert all(path.parent == run / "pictures" and path.stat().st_size > 1000 for path in written)
    directory = OutputDirectory(run)
    assert "pictures/depth.gif" in directory.record.results
    (run / "pictures" / "mine.png").write_bytes(b"")
    directory.remove_page()  # as a run that goes on does
    assert names((run / "pictures").iterdir()) == ["mine.png"]


def test_the_section_follows_the_thalweg_of_the_scene(run):
    assert read_recorded(run).thalweg == pytest.approx(np.array(PLACES["thalweg"]), abs=0.0)
    assert read_recorded(run / "maps.nc").thalweg is None


def test_maps_are_chosen_by_name(run, tmp_path, capsys):
    words = ["plot", str(run), "--output", str(tmp_path / "Bilder"), "--dpi", "30", "--animation", "none"]
    assert main.main([*words, "--maps", "max_run_up", "--format", "svg"]) == exit_codes.DONE
    assert f"wrote {tmp_path / 'Bilder' / 'max_run_up.svg'}" in capsys.readouterr().out
    drawn = {path.stem for path in (tmp_path / "Bilder").iterdir()}
    assert "max_run_up" in drawn and not {"overview", "max_depth", "depth"} & drawn
    assert main.main([*words, "--maps", "max_runup"]) == exit_codes.USER_ERROR
    assert "no map 'max_runup' (did you mean 'max_run_up'?); there are max_depth" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "picture"),
    [("budget", "volumes.png"), ("gauges", "gauges.png"), ("sections", "hydrographs.png"), ("columns", "column.png"),
     ("thalweg", "time_distance.png"), ("series", "depth.gif")],
)  # fmt: skip
@pytest.mark.slow
def test_one_file_is_drawn(run, tmp_path, name, picture):
    copy = shutil.copy(run / f"{name}.nc", tmp_path)
    written = list(draw_pictures(copy, dpi=30))
    assert names(written) == [picture] and written[0].parent == tmp_path / f"{name}_pictures"


def test_a_file_of_maps_is_drawn(run, tmp_path):
    written = list(draw_pictures(run / "maps.nc", ["max_depth"], to=tmp_path, dpi=30))
    assert names(written) == ["max_depth.png", "section.png"]


def test_an_unfinished_run_is_drawn_from_its_checkpoint(tmp_path, caplog):
    from landlab_debrisflow.run.runner import run_scene

    with pytest.raises(KeyboardInterrupt):
        run_scene(scene(tmp_path), monitor=Stopping(40))
    directory = tmp_path / "scene_out"
    written = list(draw_pictures(directory, ["max_depth", "elevation_change"], dpi=30, animation="none"))
    assert names(written) == ["max_depth.png", "elevation_change.png", "section.png"]
    assert "is interrupted: its last checkpoint is drawn, at" in caplog.text
    for path in directory.glob("checkpoint*"):
        path.unlink()
    shutil.rmtree(directory / "series")
    with pytest.raises(InputError, match="nothing to draw yet: the run is interrupted and has no checkpoint"):
        list(draw_pictures(directory))


def test_what_cannot_be_drawn_is_refused_before_anything_is_written(run, tmp_path):
    def refused(match, path, *words, **keywords):
        with pytest.raises(InputError, match=match):
            list(draw_pictures(path, *words, **keywords))

    refused("does not exist; give the directory", tmp_path / "nowhere")
    refused("run.json is missing", tmp_path)
    (tmp_path / "dem.tif").write_bytes(b"")
    refused("is no file of results", tmp_path / "dem.tif")
    (tmp_path / "half.nc").write_bytes((run / "maps.nc").read_bytes()[:2000])
    refused("cannot read .*half.nc", tmp_path / "half.nc")
    xr.Dataset({"a": ("b", np.zeros(2))}).to_netcdf(tmp_path / "other.nc")
    refused("holds nothing that can be drawn: it has a; give", tmp_path / "other.nc")
    refused("no maps, and max_depth cannot be drawn", run / "budget.nc", ["max_depth"])
    refused("is a file; choose another --output", run, to=tmp_path / "dem.tif")
    refused("missing does not exist; create it first", run, to=tmp_path / "missing" / "pictures")
    refused("format must be png, pdf, svg, got 'bmp'", run, form="bmp")
    refused("dpi must lie in", run, dpi=5)
    refused("no series of maps that could be animated; set output: interval", run / "maps.nc", animation="gif")
    with matplotlib.rc_context({"animation.ffmpeg_path": "no such program"}):
        refused("needs the program ffmpeg", run, animation="mp4")
    assert not (tmp_path / "missing").exists()
