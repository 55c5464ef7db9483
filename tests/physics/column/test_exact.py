"""What the laws must reproduce to rounding: no mesh, step or laziness may show."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from landlab_debrisflow.physics.column import ALE, Classical, ConstantRatio, NoExcessPressure

from .driver import LOAD_PER_METRE, Columns, depth_mean, eta

ROUNDING = 1e-12  # hundreds of operations at 2e-16 each, relative to the load
LAWS = (ALE, Classical)


@pytest.mark.parametrize("source", ["overburden", "proportional"])
@pytest.mark.parametrize("coefficient", [0.0, 1e-4, 1.0, 1e3])
def test_a_constant_ratio_survives_any_erosion(source, coefficient):
    """p = r_b rho' g y: the bed brings what the column already has (docs/theory.md#column-solutions)."""
    columns = Columns(
        ALE(loading_source=source),
        0.65 * LOAD_PER_METRE * eta(11)[None],
        [1.0],
        coefficient_of_consolidation=coefficient,
    )
    for step in range(300):
        base = columns.step(0.05, entrained=1e-3 * (1.0 + np.sin(0.1 * step) ** 2 + 30.0 * (step == 150)))
        assert_allclose(base, 0.65 * columns.load, rtol=ROUNDING)
    assert_allclose(columns.profile()[0], 0.65 * columns.load * eta(11), atol=ROUNDING * columns.load[0])


@pytest.mark.parametrize("law", LAWS)
def test_undrained_loading_lifts_every_level_by_its_own_overburden(law):
    start = 0.3 * LOAD_PER_METRE * eta(11) ** 2
    columns = Columns(law(), start[None], [1.0])
    for step in range(50):
        base = columns.step(0.05, strain=0.01 * np.cos(step))
    gained = LOAD_PER_METRE * (columns.thickness[0] - 1.0) * eta(11)
    assert_allclose(columns.profile()[0], start + gained, atol=ROUNDING * LOAD_PER_METRE)
    assert_allclose(base, (start + gained)[0], rtol=ROUNDING)


@pytest.mark.parametrize("law", LAWS)
def test_proportional_loading_keeps_every_ratio(law):
    start = 0.3 * LOAD_PER_METRE * eta(11) ** 2
    columns = Columns(law(loading_source="proportional"), start[None], [1.0])
    for step in range(50):
        base = columns.step(0.05, strain=0.02 * np.cos(step))
    assert_allclose(columns.profile()[0], start * columns.thickness, atol=ROUNDING * LOAD_PER_METRE)
    assert_allclose(base, (start * columns.thickness)[0], rtol=ROUNDING)


@pytest.mark.parametrize("law, erodes", [(ALE, False), (ALE, True), (Classical, False)])
def test_a_liquefied_column_stays_liquefied(law, erodes):
    """Thinning, thickening and soil as liquefied as itself; while it erodes, at any diffusion."""
    columns = Columns(law(), LOAD_PER_METRE * eta(11)[None], [1.0], coefficient_of_consolidation=0.1 * erodes)
    for step in range(200):
        grown = 2e-3 * columns.volume * erodes
        base = columns.step(0.05, entrained=grown, strain=0.03 * np.cos(0.3 * step), ratio=1.0)
        assert_allclose(base, columns.load, rtol=ROUNDING)
    assert_allclose(columns.profile()[0], columns.load * eta(11), atol=ROUNDING * columns.load[0])
    assert_allclose(columns.state.clipped, 0.0, atol=1e-10 * columns.load[0])  # rounding of 200 steps only


def test_without_diffusion_old_soil_keeps_its_depth_and_new_soil_its_pressure():
    """Pure erosion: the front stays at the material depth h_0; eq. 54 of the paper, with p_b ~ load."""
    columns = Columns(ALE(levels=101, tolerance=1e-3), np.zeros((1, 101)), [1.0])
    for _ in range(400):
        columns.step(0.05, entrained=1.0 / 400.0)
    depth = eta(101) * columns.thickness
    exact = np.where(depth > 1.0, 0.65 * LOAD_PER_METRE * depth, 0.0)
    profile = columns.profile()[0]
    away = np.abs(depth - 1.0) > 0.16  # the interpolation spreads the jump over some levels of 0.02 m
    assert_allclose(profile[away], exact[away], atol=1e-6 * LOAD_PER_METRE)
    front = np.interp(0.325 * LOAD_PER_METRE, profile[::-1], depth[::-1])
    assert_allclose(front, 1.0, atol=0.02)  # one level


def test_the_classical_column_spreads_what_it_erodes():
    """A grain keeps its fraction of the depth, and soil that comes in below loads nobody: friction alone sees it."""
    start = 0.65 * LOAD_PER_METRE * eta(11)
    columns = Columns(Classical(), start[None], [1.0])
    for _ in range(100):
        base = columns.step(0.05, entrained=0.02)
    assert_allclose(base, 0.65 * columns.load, rtol=ROUNDING)
    assert_allclose(columns.profile()[0], start, atol=ROUNDING * columns.load[0])


def test_the_literal_source_is_not_made():
    """A cold column over a dry bed erodes: no pressure out of nothing (rho' g y ln(...), docs/theory.md#loading)."""
    columns = Columns(ALE(), np.zeros((1, 11)), [1.0])
    for _ in range(100):
        columns.step(0.05, entrained=0.02, ratio=0.0)
    assert_allclose(columns.profile(), 0.0, atol=ROUNDING * LOAD_PER_METRE)


def test_a_time_step_of_zero_changes_nothing():
    columns = Columns(ALE(), 0.5 * LOAD_PER_METRE * eta(11)[None], [1.0], coefficient_of_consolidation=1.0)
    before = columns.profile()
    assert_allclose(columns.step(0.0), before[:, 0], rtol=ROUNDING)
    assert_allclose(columns.profile(), before, atol=ROUNDING * LOAD_PER_METRE)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("source", ["overburden", "proportional", "none"])
def test_a_switch_does_not_change_the_content(law, source):
    """A hundred switches in no time add no more than the soil that came in with them."""
    columns = Columns(
        law(loading_source=source),
        0.2 * LOAD_PER_METRE * eta(11)[None] ** 2,
        [1.0],
        coefficient_of_consolidation=1e-4,
    )
    before = columns.content()[0]
    for _ in range(100):
        columns.step(1e-9, entrained=1e-9)
        columns.step(1e-9)
    # 1e-7 m of soil, and 100 times 2 sqrt(1e-13/pi) of diffusion, each at most one load
    assert_allclose(columns.content()[0], before, atol=1e-4 * LOAD_PER_METRE)


@pytest.mark.parametrize("law", LAWS)
def test_inputs_are_untouched_and_columns_do_not_mix(law):
    start = np.array([0.65, 0.1, 0.0])[:, None] * LOAD_PER_METRE * eta(11)
    together = Columns(law(), start, np.ones(3), coefficient_of_consolidation=0.01)
    alone = Columns(law(), start[1:2], np.ones(1), coefficient_of_consolidation=0.01)
    for step in range(30):
        together.step(0.1, entrained=np.array([0.0, 0.02, 0.1]) * (step < 15))
        alone.step(0.1, entrained=0.02 * (step < 15))
    assert_array_equal(together.profile()[1], alone.profile()[0])
    forcing = together.forcing._replace(entrained=np.full(3, 0.1))
    arrays = forcing[:5]  # the rest are numbers
    for array in arrays:
        array.flags.writeable = False
    copies = [array.copy() for array in arrays]
    together.law.advance(together.state, forcing, 0.1, together.base)
    for array, copy in zip(arrays, copies, strict=True):
        assert_array_equal(array, copy)


def test_the_bed_pressure_may_be_one_number():
    columns, other = (Columns(ALE(), np.zeros((2, 11)), np.ones(2)) for _ in range(2))
    columns.step(0.1, entrained=0.1, ratio=0.4)
    forcing = columns.forcing._replace(bed_pressure=0.4 * columns.load[:1])
    other.law.advance(other.state, forcing, 0.1, other.base)
    assert_array_equal(other.base, columns.base)


def test_laws_without_memory():
    for law, ratio in ((NoExcessPressure(), 0.0), (ConstantRatio(ratio=0.4), 0.4)):
        columns = Columns(law, np.ones((1, law.levels)), [2.0])
        assert_array_equal(columns.step(1.0, entrained=0.5), ratio * columns.load)
        assert_allclose(columns.profile()[0], ratio * columns.load * eta(law.levels), rtol=ROUNDING)
        assert_allclose(depth_mean(columns.profile()), 0.5 * ratio * columns.load)
