"""Commands in the same process, the demonstration on a valley so short that it runs as plain Python, too."""

import functools

import pytest
import xarray as xr

from landlab_debrisflow.cli import demo, main
from landlab_debrisflow.physics.registry import LAWS

SHORT = {"erodible_length": 40.0, "transition_length": 20.0, "runout_length": 200.0, "width": 80.0}


def test_the_demo_writes_what_it_tells(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(demo, "tsing_shan_valley", functools.partial(demo.tsing_shan_valley, **SHORT))
    assert main.main(["demo", "--particles", "12", "--output-dir", str(tmp_path)]) == 0
    rows = [line.split("│")[1:-1] for line in capsys.readouterr().out.splitlines() if line.count("│") == 4]
    told = {name.strip(): [float(value.replace(" ", "")) for value in values] for name, *values in rows}
    with xr.open_dataset(tmp_path / "demo.nc") as both:
        assert list(both.column.values) == ["ale", "classical"]
        for name in ("released", "eroded"):
            assert told[f"{name} [m3]"] == pytest.approx(both[f"budget_{name}"].values, abs=0.5)  # whole numbers
        assert told["released [m3]"] == [2350.0, 2350.0] and min(told["eroded [m3]"]) > 300.0
        deepest = both.debris_flow__eroded_depth.max(("y", "x")).values
    assert told["deepest erosion [m]"] == pytest.approx(deepest, abs=0.005)
    assert len(set(told["median deposit below 100 m [m]"])) == 2  # two models
    assert (tmp_path / "demo.png").read_bytes()[1:4] == b"PNG"


def test_info_lists_every_law(monkeypatch, capsys):
    monkeypatch.setenv("COLUMNS", "120")
    assert main.main(["info"]) == 0
    shown = capsys.readouterr().out
    for kind, laws in LAWS.items():
        for number, name in enumerate(laws):
            assert f"{kind}: {name}{' (default)' * (number == 0)}  " in shown


@pytest.mark.parametrize(
    ("words", "reason"),
    [(["--output-dir", "missing"], "missing"), (["--particles", "0"], "particle_count must lie in")],
)
def test_what_is_not_usable_is_said_in_one_line(words, reason, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main.main(["demo", *words]) == main.USER_ERROR
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("landlab-debrisflow: ") and reason in line and not list(tmp_path.iterdir())
