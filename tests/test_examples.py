"""What a user would run first: the command line and the examples, shortened."""

import dataclasses
import importlib.util
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from landlab import RasterModelGrid
from landlab.io import esri_ascii
from numpy.testing import assert_allclose

from landlab_debrisflow import InputError
from landlab_debrisflow.cli import demo, main
from landlab_debrisflow.physics.registry import LAWS

pytestmark = pytest.mark.slow

EXAMPLES = Path(__file__).parents[1] / "examples"


def load(name):
    """Import an example as a module, with its folder on the path as when it is run."""
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    sys.path.insert(0, str(EXAMPLES))
    try:
        spec.loader.exec_module(module)
    finally:
        sys.path.remove(str(EXAMPLES))
    return module


# ---- the command line ----


def test_demo_shows_that_the_ale_column_runs_farther(tmp_path, capsys):
    assert main.main(["demo", "--particles", "150", "--output-dir", str(tmp_path)]) == 0
    told = capsys.readouterr()
    assert told.err == ""  # no progress without a terminal
    for words in (
        "run-out of the front beyond the 100 m contour [m]",
        "residual of the mass balance [m3]",
        "CPU time [s]",
    ):
        assert words in told.out
    with xr.open_dataset(tmp_path / "demo.nc") as both:
        assert list(both.column.values) == ["ale", "classical"]
        assert_allclose(both.budget_residual, 0.0, atol=1e-12 * 20_000)
        assert_allclose(both.budget_eroded[0], both.budget_eroded[1], rtol=0.01)
        reach = (both.debris_flow__deposit_depth > 0.0).any("y")
        ale, classical = (float(both.x[reach.sel(column=name)].max()) for name in ("ale", "classical"))
        assert ale > classical + 50.0
    assert (tmp_path / "demo.png").read_bytes()[:4] == b"\x89PNG"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--output-dir", "missing"], "does not exist"),
        (["--particles", "0"], "particle_count must lie in"),
    ],
)
def test_user_errors_are_one_line_and_code_2_before_anything_runs(words, said, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(demo.DebrisFlow, "run_until_rest", lambda self: pytest.fail("it ran"))
    assert main.main(["demo", *words]) == 2
    told = capsys.readouterr()
    assert told.out == "" and told.err.count("\n") == 1
    assert told.err.startswith("landlab-debrisflow: ") and said in told.err
    assert list(tmp_path.iterdir()) == []


def test_info_lists_every_law_and_parameter(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    assert main.main(["info"]) == 0
    told = capsys.readouterr().out
    for kind, laws in LAWS.items():
        for name, law in laws.items():
            assert f"{kind}: {name}" in told
            assert all(parameter.name in told for parameter in dataclasses.fields(law))
    line = next(line for line in told.splitlines() if "growth_rate" in line)
    assert all(word in line for word in ("m-1", "0.003", "0 or more"))
    line = next(line for line in told.splitlines() if "bed_pressure_ratio" in line)
    assert all(word in line for word in ("0.65", "0 to 1"))


def test_a_command_is_needed(capsys):
    with pytest.raises(SystemExit) as stop:
        main.main([])
    assert stop.value.code == 2
    assert "command" in capsys.readouterr().err


# ---- obstacles ----


def test_a_dam_shields_the_buildings(tmp_path, capsys):
    example = load("obstacle")
    found = example.main(tmp_path / "obstacle.png", particles=300)
    free, shielded = found["buildings"], found["dam and buildings"]
    for run in found.values():
        assert_allclose(run["volume released [m3]"], example.VOLUME)
        assert abs(run["residual of the mass balance [m3]"]) < 1e-12 * example.VOLUME
    # what comes has an energy head v^2/2g of 11.5 m (11.1 to 12.0 with 255 to 345 particles), a dynamic pressure of
    # 430 kPa, and slows down on the fan
    assert_allclose([run["energy head before the dam [m]"] for run in found.values()], 11.5, atol=0.7)
    assert 20.0 < free["peak impact on buildings [kPa]"] < 430.0
    assert free["peak run-up at buildings [m]"] < 11.0
    # the dam, 6 m high, is run up and just overtopped
    assert 4.0 < shielded["peak run-up where the dam is [m]"] < 11.0
    assert shielded["peak run-up where the dam is [m]"] > 2.0 * free["peak run-up where the dam is [m]"]
    for name in ("peak run-up at buildings [m]", "deposit beyond the dam [m3]"):
        assert shielded[name] < 0.7 * free[name], name
    # the largest of what a few particles do: from 255 to 345 particles between .46 and .77 of the free one
    assert shielded["peak impact on buildings [kPa]"] < 0.9 * free["peak impact on buildings [kPa]"]
    told = capsys.readouterr().out
    assert all(name in told for name in free)
    assert (tmp_path / "obstacle.png").stat().st_size > 10_000
    with pytest.raises(InputError, match="does not exist"):
        example.main(tmp_path / "missing" / "obstacle.png")


# ---- S-1000 ----


def write_rasters(folder):
    """Write rasters like those of S-1000: scar, channel and fan in a valley; return what left and came [m3]."""
    grid = RasterModelGrid((50, 25), xy_spacing=10.0)
    x, y = grid.x_of_node, grid.y_of_node
    scar = (abs(x - 120.0) < 25.0) & (abs(y - 430.0) < 25.0)
    fan = (abs(x - 120.0) < 15.0) & (abs(y - 130.0) < 45.0)
    fan = fan * (1.0 + (y - 85.0) / 90.0)  # thicker uphill [m]
    channel = -0.5 * ((abs(x - 120.0) < 15.0) & (y > 175.0) & (y < 405.0))
    gone = x > 215.0
    rasters = {
        "pre_runout_DEM": np.maximum(0.0, 0.6 * (y - 150.0)) + 0.2 * abs(x - 120.0),
        "landslide_depth": np.where(scar, -2.0, 0.0),
        "DEM_of_Difference": np.where(scar, -2.0, fan + channel),
    }
    for name, values in rasters.items():
        grid.add_field(name, np.where(gone, -9999.0, values), at="node")
        with open(folder / f"{name}.asc", "w") as stream:
            esri_ascii.dump(grid, stream, at="node", name=name)
    return float(200.0 * scar.sum()), float(-100.0 * channel.sum()), float(100.0 * fan.sum())


def test_s1000_runs_on_rasters_of_another_event(tmp_path, capsys):
    (tmp_path / "s1000").mkdir()
    released, lowered, raised = write_rasters(tmp_path / "s1000")
    example = load("s1000")
    soil = example.build_grid(tmp_path / "s1000").at_node["soil__depth"]
    assert soil.min() == example.SOIL_DEPTH and soil.max() == 2.0  # there is as much as fails
    shown = example.main(tmp_path, particles=80, output_dir=tmp_path, quick=True)
    seen = shown["observed"]
    assert_allclose(
        [seen["released"], seen["lowered outside"], seen["raised"], seen["net"]],
        [released, lowered, raised, raised - lowered - released], rtol=1e-12,
    )  # fmt: skip
    check_shown(shown)
    assert "CUT SHORT" in capsys.readouterr().out
    check_written(tmp_path, example.SOIL_DEPTH)


def check_shown(shown):
    """Check what holds for every event."""
    seen = shown["observed"]
    assert_allclose(
        [seen[key] for key in ("csi", "csi outside", "correlation", "run-out error")], [1, 1, 1, 0], atol=1e-12
    )
    for name in ("Coulomb", "Voellmy"):
        ours = shown[name]
        assert abs(ours["residual"]) < 1e-12 * 30_000
        assert ours["eroded outside"] > 0.0 and ours["lowered outside"] > 0.0
        assert 0.0 < ours["csi outside"] < 1.0
    assert shown["Voellmy"]["eroded"] < shown["Coulomb"]["eroded"]  # drag shortens the way in the same time
    spread = shown["spread evenly"]
    assert_allclose(spread["raised"] - spread["lowered outside"] + spread["net"], spread["raised"], atol=1.0)


def check_written(folder, soil_depth):
    with xr.open_dataset(folder / "s1000.nc") as stored:
        assert stored.elevation_change.dims == ("run", "y", "x")
        moving_aside = stored.elevation_change.where(stored.source == 0)
        assert float(moving_aside.min()) >= -soil_depth - 1e-9  # it never digs below the soil
    assert (folder / "s1000.png").stat().st_size > 10_000


def test_s1000_shortened(tmp_path, capsys):
    example = load("s1000")
    try:
        example.find_data()
    except InputError as error:
        pytest.skip(f"the S-1000 rasters are not part of the project: {error}")
    shown = example.main(particles=80, output_dir=tmp_path, quick=True)
    seen, spread = shown["observed"], shown["spread evenly"]
    assert_allclose([seen["released"], seen["lowered outside"], seen["raised"]], [22481, 5126, 22543], atol=1.0)
    check_shown(shown)
    assert_allclose([spread["csi"], spread["csi outside"], spread["correlation"]], [0.478, 0.432, -0.11], atol=0.05)
    told = capsys.readouterr().out
    assert "CUT SHORT" in told and "±.02" in told and "not rerun" in told
    check_written(tmp_path, example.SOIL_DEPTH)


def test_s1000_parameters_are_those_written_down_before_scoring():
    s1000 = load("s1000")
    apparent = (990.0 / 1990.0) * np.tan(np.radians(s1000.BASAL_FRICTION_ANGLE)) * (1.0 - s1000.PRESSURE_RATIO)
    assert_allclose(apparent, 0.21, atol=0.005)
    assert (s1000.GROWTH_RATE, s1000.TURBULENT_COEFFICIENT, s1000.SOIL_DEPTH) == (1e-3, 500.0, 1.2)


def test_missing_data_are_refused_with_the_places_looked_at(tmp_path):
    with pytest.raises(InputError, match=f"no pre_runout_DEM.asc in {tmp_path} nor in {tmp_path}/s1000"):
        load("s1000").find_data(tmp_path)


def test_success_index_counts_hits_misses_and_false_alarms():
    success = load("s1000_scores").success
    modelled, observed = np.array([1, 1, 1, 0, 0], bool), np.array([1, 1, 0, 1, 0], bool)
    assert success(modelled, observed) == 0.5
