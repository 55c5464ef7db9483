"""Bounded whatever happens, and refused where that makes no sense."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from landlab_debrisflow.core.errors import ParameterError
from landlab_debrisflow.physics.column import ALE, Classical, ConstantRatio

from .driver import LOAD_PER_METRE, WATER_TO_BUOYANT, Columns, eta

COEFFICIENTS = (0.0, 1e-9, 1e-4, 1.0, 1e3)


@pytest.mark.parametrize("law", [ALE, Classical])
@pytest.mark.parametrize("levels", [3, 4, 11, 41])
@pytest.mark.parametrize("source", ["overburden", "proportional", "none"])
def test_pressure_stays_between_its_bounds(law, levels, source):
    """Steps of any length, erosion, switching and strain of any strength, thickness down to a film."""
    rng = np.random.default_rng(7)
    n = 40
    slack = 1e-9  # rounding of the columns that were a thousand times thicker
    for coefficient in COEFFICIENTS:
        start = rng.uniform(-1.0, 1.0, (n, levels)) * eta(levels) * LOAD_PER_METRE
        columns = Columns(
            law(levels=levels, loading_source=source),
            start,
            np.ones(n),
            coefficient_of_consolidation=coefficient,
        )
        for _ in range(60):
            entrained = columns.volume * 10.0 ** rng.uniform(-6, 0.5, n) * (rng.random(n) < 0.5)
            strain = np.exp(rng.normal(0.0, 0.5, n)) - 1.0
            base = columns.step(10.0 ** rng.uniform(-4, 3), entrained, strain, ratio=rng.random(n))
            assert np.all(base <= columns.load) and np.all(base >= -WATER_TO_BUOYANT * columns.load)
        ratio = columns.profile() / columns.load[:, None]
        assert np.all(ratio <= eta(levels) + slack) and np.all(ratio >= -WATER_TO_BUOYANT * eta(levels) - slack)
        assert np.all(columns.state.clipped >= 0.0)


@pytest.mark.parametrize("levels", [3, 11, 21, 41])
@pytest.mark.parametrize("coefficient", COEFFICIENTS)
@pytest.mark.parametrize("dt", [1e-3, 0.1, 10.0, 1e4])
def test_no_new_extreme_without_source(levels, coefficient, dt):
    """0 <= p <= p_b at any Peclet, Fourier and Courant number, from a jump at the base."""
    columns = Columns(ALE(levels=levels, loading_source="none"), np.zeros((1, levels)), [1.0], [1e6], coefficient)
    for step in range(40):
        base = columns.step(dt, entrained=0.02 * columns.volume * (step % 20 < 12), ratio=1e-6, load=1e6)
        assert -1e-12 <= base[0] <= 1.0 + 1e-12
    profile = columns.profile()
    assert profile.min() >= -1e-12 and profile.max() <= 1.0 + 1e-12


def test_nothing_divides_by_zero():
    """Empty, vanishing and dry columns stay finite."""
    columns = Columns(ALE(), np.zeros((3, 11)), [1.0, 1e-30, 1.0], coefficient_of_consolidation=1.0)
    columns.thickness[2] = 0.0
    for source in ("overburden", "proportional", "none"):
        columns.law = ALE(loading_source=source)
        for entrained in (0.0, 1e-32, 0.0, 1.0):
            with np.errstate(all="raise", under="ignore"):
                assert np.all(np.isfinite(columns.step(1.0, entrained=entrained)))
            assert np.all(np.isfinite(columns.profile()))
    empty = Columns(ALE(), np.zeros((0, 11)), [])
    assert empty.step(1.0).size == 0


def test_what_is_clipped_is_counted():
    """A column at rest thins to a tenth: grains fall below minus the weight of water, and are held there."""
    columns = Columns(ALE(), np.zeros((1, 11)), [1.0])
    columns.step(0.1, strain=-0.9)
    profile = columns.profile()
    assert_allclose(profile[0], -WATER_TO_BUOYANT * columns.load * eta(11), rtol=1e-12)
    columns.synchronise()
    free = -0.9 * LOAD_PER_METRE * eta(11)
    assert_allclose(columns.state.clipped[0], 0.1 * 0.5 * (profile[0, 0] - free[0]), rtol=1e-12)


@pytest.mark.parametrize(
    "law, parameter, value",
    [
        (ALE, "levels", 2),
        (ALE, "levels", 1002),
        (ALE, "levels", 11.0),
        (Classical, "levels", 2),
        (ALE, "loading_source", "some"),
        (Classical, "loading_source", 1),
        (ConstantRatio, "ratio", -0.01),
        (ConstantRatio, "ratio", 1.01),
        (ConstantRatio, "ratio", float("nan")),
    ],
)
def test_values_out_of_bounds_are_refused(law, parameter, value):
    with pytest.raises(ParameterError, match=parameter):
        law(**{parameter: value})
