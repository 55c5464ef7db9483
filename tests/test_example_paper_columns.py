"""The example that draws figures 6 to 9 of Pastor et al. (2022)."""

import importlib.util
from pathlib import Path

import pytest

from landlab_debrisflow import InputError

EXAMPLE = Path(__file__).parents[1] / "examples" / "paper_columns.py"
LEVEL = 0.1  # between 11 levels

BOUNDS = {
    "Fig. 6 (A)": LEVEL,  # straight lines between levels cannot turn a step sharper than half a level
    "Fig. 6 (B)": 0.25 * LEVEL,  # the front travels without lag, but is seen through two or three levels
    "Fig. 7": 3e-2,  # at t/T_c = 0.01 the new soil is just one level thick
    "Fig. 8": 5e-4,  # nearly pure diffusion, whose modes decay without error; what is left comes from the time steps
    "Fig. 9": 5e-3,  # smooth, but a column left alone until it is due may be off by about 0.3 (1/10)^2 = 3e-3
}


@pytest.fixture(scope="module")
def example():
    spec = importlib.util.spec_from_file_location("paper_columns", EXAMPLE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_numbers_are_close_to_closed_forms(example, tmp_path, capsys):
    picture = tmp_path / "paper_columns.png"
    differences = example.main(picture)
    assert differences.keys() == BOUNDS.keys()
    for name, bound in BOUNDS.items():
        assert 0.0 < differences[name] < bound, name
    assert picture.stat().st_size > 10_000
    told = capsys.readouterr().out
    assert all(name in told for name in BOUNDS) and "11 levels" in told


def test_more_levels_come_closer(example, capsys):
    coarse, fine = example.main(), example.main(levels=21)
    for name in ("Fig. 6 (A)", "Fig. 6 (B)", "Fig. 7", "Fig. 9"):  # the error of figure 8 comes from the time steps
        assert fine[name] < 0.8 * coarse[name], name


def test_a_missing_folder_is_refused_before_anything_runs(example, tmp_path, monkeypatch):
    monkeypatch.setattr(example, "solve_column", lambda **words: pytest.fail("it ran"))
    with pytest.raises(InputError, match="does not exist"):
        example.main(tmp_path / "missing" / "paper_columns.png")
