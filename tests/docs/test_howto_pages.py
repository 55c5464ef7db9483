"""What the pages about releases, loops, observers and columns print is what they say; their numbers have a source."""

import concurrent.futures
import re
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
import yaml

from landlab_debrisflow.grid.fields import NODE_FIELDS

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"


def page(name):
    return (DOCS / f"{name}.md").read_text(encoding="utf-8")


@pytest.fixture
def output(cells):
    """Return a function that returns the output of the first cell of a page whose source has some words in it."""

    def find(name, words):
        found, *_ = [text for source, text, _ in cells(name) if words in source]
        return found

    return find


def numbers(text):
    return [float(number) for number in re.findall(r"(?<![\w.])-?\d+(?:\.\d*)?(?:e-?\d+)?", text)]


# ---- fields ----


def test_table_of_fields_is_complete_and_true():
    rows = re.findall(r"^\| `(\w+)` \| ([\w, ]+) \| (\S+) \|", page("fields"), re.MULTILINE)
    declared = [(f.name, f.intent + (", optional" if f.optional else ""), f.unit) for f in NODE_FIELDS]
    assert sorted(rows) == sorted(declared)


# ---- releases ----


@pytest.mark.slow
def test_releases_have_the_volumes_that_were_asked_for(output):
    assert re.search(r"^released +900 m3$", output("release", "!landlab-debrisflow check"), re.M)


@pytest.mark.slow
def test_releases_in_python_and_inflow(output):
    deepest, released = numbers(output("release", "lay_on_top(grid"))
    assert 900.0 / 30.0**2 < deepest < 3.0 and released == 900.0 + 0.5 * 30.0**2
    assert numbers(output("release", '"line_start"'))[0] == 0.5 * 60.0 * 20.0


@pytest.mark.slow
def test_the_release_is_drawn(cells):
    (outputs,) = [outputs for source, _, outputs in cells("release") if "draw_map(" in source]
    assert any("image/png" in output.get("data", {}) for output in outputs)


@pytest.mark.slow
def test_what_goes_wrong_with_a_release_is_told(output):
    assert "a pit that they cannot leave" in output("release", "np.where(inside, 2.0, 0.0)")
    assert "lies wholly outside the DEM" in output("release", 'scarps.set_crs("EPSG:32633")')
    refused = output("release", "BC_NODE_IS_CLOSED")
    assert refused.startswith("InputError: debris_flow__release_depth is 1 m on node") and "closed node" in refused


def test_how_scars_empty_is_what_the_command_printed():
    table = (ROOT / "benchmarks" / "releases.txt").read_text(encoding="utf-8")
    words = " ".join(page("release").split())
    for kind in ("uniform", "base level"):
        peak, left = re.search(
            rf"│ {kind} +│ +30 │ +1 │ +\d+ │ +([\d.]+) / .*? │ +\d+ / \d+ │ +(\d+) / ", table
        ).groups()
        digits = peak if kind == "base level" else f"{float(peak):.1f}"
        assert f"up to {digits} times its depth" in words
        assert (f"left {left} % of its volume" if int(left) else "left nothing") in words


# ---- loops ----


@pytest.mark.slow
def test_a_landscape_and_its_flows_balance(output):
    told = output("landlab_loops", "BedrockLandslider(")
    volumes = {name: float(volume) for name, volume in re.findall(r"^(\w+) +(-?\d+) m3$", told, re.M)}
    assert volumes["released"] > 0.0 and volumes["eroded"] > 0.0 and volumes["moving"] == volumes["residual"] == 0.0
    assert len(re.findall(r"^year \d+: up to [\d.]+ m deep$", told, re.M)) >= 1
    # elevations of 300 m changed some hundred times: 6e-14 each
    assert float(re.search(r"within (\S+) m", told)[1]) < 1e-11
    assert "over the west edge left the grid" in told  # as the text says


@pytest.mark.slow
def test_triggers_and_second_events(output):
    (drawn,) = numbers(output("landlab_loops", "calc_slope_at_node"))[:1]
    told = output("landlab_loops", "continues=flow")
    (first, second), *_ = [
        tuple(map(float, pair)) for pair in re.findall(r"^released (\d+), then (\d+) m3$", told, re.M)
    ]
    assert drawn > 0.0 and abs(second - first - drawn) <= 1.0  # rounded
    assert "not at rest after" in output("landlab_loops", "run_until_rest(max_duration=5.0)")


@pytest.mark.slow
def test_bmi_as_printed(output):
    time, depth = numbers(output("landlab_loops", "wrap_as_bmi"))
    assert time == 2.0 and 0.0 < depth < 1.0


@pytest.mark.slow
def test_many_runs_at_once_as_printed(monkeypatch, capsys, tmp_path):
    """Threads stand for processes, which take seconds to start; tests/test_processes.py sends the arguments."""
    (block,) = re.findall(r"^```python\n(.*?)^```", page("landlab_loops"), re.M | re.S)
    outline = [[400020, 5200140], [400045, 5200140], [400045, 5200160], [400020, 5200160]]
    scene = {
        "terrain": {"example": "gully"}, "release": {"polygons": outline, "depth": 1.0},
        "numerics": {"particle_count": 60}, "output": {"max_duration": 2.0},
    }  # fmt: skip
    monkeypatch.chdir(tmp_path)
    Path("scene.yaml").write_text(yaml.safe_dump(scene), encoding="utf-8")
    threads = ThreadPoolExecutor
    monkeypatch.setattr(concurrent.futures, "ProcessPoolExecutor", lambda count, mp_context: threads(count))
    exec(compile(block, "landlab_loops.md", "exec"), {"__name__": "__main__"})
    angles, speeds = np.array(numbers(capsys.readouterr().out)).reshape(3, 2).T
    assert angles.tolist() == [25.0, 28.0, 31.0] and np.all(np.diff(speeds) < 0.0)


# ---- observers, restart, files ----


@pytest.mark.slow
def test_a_run_that_was_stopped_ends_like_one_that_was_not(output):
    told = output("observers_restart_files", "signal.SIGINT")
    assert "as if never stopped: True" in told and "everything computed until then is kept" in told
    assert 8.0 < float(re.search(r"^stopped at ([\d.]+) s$", told, re.M)[1]) < 9.0


@pytest.mark.slow
def test_results_as_printed(output):
    told = output("observers_restart_files", "Series(np.arange")
    assert "DebrisFlow: at rest at" in told and "moving 0" in told
    measured = dict(
        re.findall(r"^(\w+) +([\d.]+) \S", output("observers_restart_files", "measures(flow, before)"), re.M)
    )
    assert 0.0 < float(measured["travel_angle"]) < np.degrees(np.arctan(0.5))  # of the gully
    about = output("observers_restart_files", "friction_turbulent_coefficient")
    assert "friction_law = voellmy" in about and "friction_turbulent_coefficient = 500.0 m s-2" in about


@pytest.mark.slow
def test_what_goes_wrong_with_observers_and_files_is_told(output):
    misspelt = output("observers_restart_files", "debris_flow__max_dept")
    assert "did you mean 'debris_flow__max_depth'?" in misspelt and "goes on from there" in misspelt
    assert "is no whole checkpoint" in output("observers_restart_files", 'DebrisFlow.load("maps.nc")')
    assert "not at rest after" in output("observers_restart_files", "max_duration=1.0")


# ---- columns ----


@pytest.mark.slow
def test_columns_as_printed(output):
    ale, classical = output("columns", "history = {").splitlines()
    assert numbers(ale) == [1.0, 0.96, 0.91, 0.86] and numbers(classical) == [1.0, 0.59, 0.38, 0.27]
    few, some, many = (numbers(line)[1:] for line in output("columns", "(11, 41, 161)").splitlines())
    assert some == numbers(classical) and few[1] > some[1] > many[1]
    peclet = numbers(output("columns", "basal_peclet_number").splitlines()[-1])
    assert peclet[-1] == round(0.05 * (1.0 + 0.05 * 43.0) / 4e-4)
    default, lax_wendroff = (numbers(line)[-1] for line in output("columns", '"lax_wendroff"').splitlines())
    assert default == 1.0 and lax_wendroff > 1.2
    assert "ParameterError: solve_column: basal_pressure_ratio needs loading > 0" in output("columns", "times=[10.0])")


# ---- ensembles ----


@pytest.mark.slow
def test_ensembles_as_printed(output, cells):
    assert output("cluster", "members=8") == "<EnsembleResults with 8 of 8 members>\n"
    assert "no scheduler answers at tcp://127.0.0.1:9" in output("cluster", "timeouts.connect")
    assert output("sensitivity", "members=2").startswith("InputError: Sobol indices need sampling: saltelli; these")
    assert re.search(r"^friction.turbulent_coefficient +0\.\d+ +\d\.\d+ +0\.\d+$", output("sensitivity", "ends."), re.M)
    drawn = [any("image/png" in one.get("data", {}) for one in outputs) for *_, outputs in cells("sensitivity")]
    assert drawn == [True, True, False, False]
