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


@pytest.mark.parametrize("law", [ALE, Classical])
@pytest.mark.parametrize("scheme", ["default", "lax_wendroff", "upwind"])
def test_suction_that_is_lacking_comes_first(law, scheme):
    """A column at rest thins to a tenth: grains show minus the weight of water. Back at its thickness it is as before.

    Half way back, at .75 of it, it has what its effective stress leaves of the load.
    """
    columns, suction = Columns(law(scheme=scheme), 0.5 * LOAD_PER_METRE * eta(11)[None], [1.0]), -0.1 * WATER_TO_BUOYANT
    for thickness, pressure in ((0.1, suction), (0.75, 0.25), (0.1, suction), (1.0, 0.5)):
        base = columns.step(0.1, strain=thickness / columns.thickness - 1.0)
        assert_allclose(base, pressure * LOAD_PER_METRE, rtol=1e-12)
        assert_allclose(columns.profile()[0], pressure * LOAD_PER_METRE * eta(11), atol=1e-12 * LOAD_PER_METRE)
    assert columns.state.clipped[0] == 0.0


def test_suction_in_a_body_that_erodes_or_flows_in_is_kept():
    """Liquefied soil comes in below a column that lacks suction: its grains lack it still when it thickens.

    Without diffusion they are as at first, p = 0; had they lost what they lack, p = .6 of the load.
    """
    for contact in ("dirichlet", "flux"):
        columns = Columns(ALE(bed_contact=contact), np.zeros((1, 11)), [1.0])
        columns.step(0.1, strain=-0.8)
        for _ in range(20):
            columns.step(0.1, entrained=0.005 * columns.volume, ratio=1.0)
        columns.step(0.1, strain=4.0)
        old = eta(11) < 1.0 / columns.volume[0] - 0.1  # 11 levels smear the edge of the soil over one or two of them
        assert_allclose(columns.profile()[0, old], 0.0, atol=0.05 * LOAD_PER_METRE)


def test_what_is_clipped_is_counted():
    """A column that keeps its pressure thins to a half: grains are more than liquefied, and lose what exceeds it."""
    columns = Columns(ALE(loading_source="none"), 0.8 * LOAD_PER_METRE * eta(11)[None], [1.0])
    columns.step(0.1, strain=-0.5)
    assert_allclose(columns.profile()[0], columns.load * eta(11), rtol=1e-12)
    assert_allclose(columns.state.clipped[0], 0.5 * 0.5 * 0.3 * LOAD_PER_METRE, rtol=1e-12)
    columns.step(0.1, strain=1.0)
    assert_allclose(columns.base, 0.5 * columns.load, rtol=1e-12)  # for good


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
