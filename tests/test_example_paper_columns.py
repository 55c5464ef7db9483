"""The example that draws figures 6 to 9 of Pastor et al. (2022)."""

import contextlib
import importlib.util
import io
import sys
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from landlab_debrisflow import InputError
from landlab_debrisflow.exact.columns import growing_column

EXAMPLES = Path(__file__).parents[1] / "examples"
LEVEL = 0.1  # between 11 levels

BOUNDS = {
    "Fig. 6 (A)": LEVEL,  # straight lines between levels cannot turn a step sharper than half a level
    "Fig. 6 (A), overshoot": 1e-12,
    "Fig. 6 (B)": 0.25 * LEVEL,  # the front travels without lag, but is seen through two or three levels
    "Fig. 7": 3e-2,  # at t/T_c = 0.01 the new soil is just one level thick
    "Fig. 8": 5e-4,  # nearly pure diffusion, whose modes decay without error; what is left comes from the time steps
    "Fig. 9": 5e-3,  # smooth, but a column left alone until it is due may be off by about 0.3 (1/10)^2 = 3e-3
}
"""Of the default scheme, in either reading of eq. 48."""


@pytest.fixture(scope="module")
def example():
    spec = importlib.util.spec_from_file_location("paper_columns", EXAMPLES / "paper_columns.py")
    module = importlib.util.module_from_spec(spec)
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(EXAMPLES)
        patch.setitem(sys.modules, "paper_columns", module)
        spec.loader.exec_module(module)
        yield module


@pytest.fixture(scope="module")
def run(example, tmp_path_factory):
    """Errors, what was printed, and the figure."""
    picture, told = tmp_path_factory.mktemp("paper") / "paper_columns.png", io.StringIO()
    with contextlib.redirect_stdout(told):
        errors = example.main(picture)
    return errors, told.getvalue(), picture


@pytest.mark.slow
def test_numbers_are_close_to_exact_solutions_in_either_reading(run):
    errors, told, picture = run
    assert errors.keys() == {"default", "lax_wendroff"}
    assert len(errors["default"]) == 9
    for name, error in errors["default"].items():
        assert error < BOUNDS[name.removesuffix(", growing").removesuffix(", fixed")], name
        assert errors["lax_wendroff"][name] > error, name
    assert errors["lax_wendroff"]["Fig. 6 (A), overshoot"] > 0.2  # "by a third", says the README
    assert picture.stat().st_size > 10_000
    assert all(name in told for name in errors["default"]) and "11 levels" in told
    assert "0.998" in told and "0.474" in told  # figure 7 at x/h = 0.8: growing to 1, or stopped


@pytest.mark.slow
def test_more_levels_come_closer(example, run, capsys):
    (coarse, _, _), fine = run, example.main(levels=21)
    for name, error in coarse["default"].items():
        if "Fig. 8" not in name and "overshoot" not in name:  # the error of figure 8 comes from the time steps
            assert fine["default"][name] < 0.8 * error, name
    for name, error in coarse["lax_wendroff"].items():
        if "overshoot" not in name:  # an overshoot stays, however fine the levels (docs/theory.md#failures)
            assert fine["lax_wendroff"][name] < 0.8 * error, name


@pytest.mark.parametrize("time", [0.01, 0.05, 0.5])
def test_a_fixed_column_that_does_not_erode_is_the_closed_form(example, time):
    xi = np.linspace(0.0, 1.0, 11)
    assert_allclose(example.fixed_column(xi, time, 0.0), growing_column(xi, time, 0.0), rtol=0.0, atol=1e-10)


@pytest.mark.slow
@pytest.mark.parametrize("number", [0.01, 1.0, 10.0])
def test_a_fixed_column_solves_the_equation(example, number):
    xi, time, dx, dt = np.linspace(0.1, 0.9, 9), 0.05, 1e-3, 1e-5

    def p(x, t):
        return example.fixed_column(x, t, number)

    rate = (p(xi, time + dt) - p(xi, time - dt)) / (2.0 * dt)
    slope = (p(xi + dx, time) - p(xi - dx, time)) / (2.0 * dx)
    curvature = (p(xi + dx, time) - 2.0 * p(xi, time) + p(xi - dx, time)) / dx**2
    # central differences: dx^2/12 times a fourth derivative of some (1/sqrt(4 t))^4 = 25, and more of it with Pe
    assert_allclose(rate + number * (1.0 - xi) * slope, curvature, rtol=0.0, atol=1e-3)
    assert_allclose(p(np.array([0.0, 1.0]), time), [1.0, 0.0], atol=1e-12)


def test_a_missing_folder_is_refused_before_anything_runs(example, tmp_path, monkeypatch):
    monkeypatch.setattr(example, "solve_column", lambda **words: pytest.fail("it ran"))
    with pytest.raises(InputError, match="does not exist"):
        example.main(tmp_path / "missing" / "paper_columns.png")
