"""Columns with dilatancy at their bounds: films, long steps, lanes, NaN (docs/theory.md#dilatancy)."""

import itertools

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from landlab_debrisflow.exact.dilatancy import DilatantDebris, equilibrium_solid_fraction
from landlab_debrisflow.physics.column.dilatancy import DENSEST, LOOSEST

from .dilatant import LOADING, SOLID_DENSITY, WATER_TO_BUOYANT, dilatant_columns, mean, stresses

ETA = np.linspace(1.0, 0.0, 11)
DEBRIS = DilatantDebris(solid_density=SOLID_DENSITY)


def within_bounds(columns):
    """Assert that pressures and solid fractions of columns are within their bounds, to rounding."""
    load = columns.forcing.liquefaction_pressure[:, None] * np.linspace(1.0, 0.0, columns.state.profile.shape[1])
    rounding = 1e-13 * (1000.0 + load)
    assert np.all(columns.state.profile <= load + rounding)
    assert np.all(columns.state.profile >= -WATER_TO_BUOYANT * load - rounding)
    assert np.all((columns.state.solid_fraction >= LOOSEST) & (columns.state.solid_fraction <= DENSEST))


# ---- extremes ----

THICKNESS, SHEAR, FRACTION = np.array(
    list(itertools.product([1e-4, 1e-3, 0.03, 1.0, 10.0], [0.0, 1.0, 100.0, 1e5], [0.31, 0.58, 0.63, 0.66, 0.73]))
).T


@pytest.mark.parametrize("permeability", [0.0, 1e-13, 5e-9, 1e-3])
@pytest.mark.parametrize("dt", [1e-6, 1e-3, 0.1, 10.0, 1000.0])
def test_no_step_leaves_the_bounds(permeability, dt):
    columns = dilatant_columns({"permeability": permeability}, THICKNESS, FRACTION, SHEAR)
    for k in range(12):
        # spreading and thickening by a third, half of the columns erode
        thickness = THICKNESS * (1.0 + 0.3 * np.sin(k))
        columns.step(
            dt, 0.05 * THICKNESS * (np.arange(THICKNESS.size) % 2), thickness=thickness, bed_pressure=0.0,
            liquefaction_pressure=LOADING * thickness,
        )  # fmt: skip
        within_bounds(columns)


@pytest.mark.parametrize("permeability", [1e-11, 5e-9, 1e-7])
@pytest.mark.parametrize("dt", [1e-3, 0.1, 10.0])
def test_levels_between_their_bounds_obey_the_law_also_beside_levels_on_a_bound(permeability, dt):
    """With m_new = m/(1 + x): x (1 + m gd dt) = gd dt (m - m_eq) - a ln((s_new + s_0)/(s + s_0))/m, at s_new > 50 Pa.

    Below, m_eq changes within less than 1 Pa, the change of (s + s_0) that is not iterated.
    """
    columns, strain = dilatant_columns({"permeability": permeability}, THICKNESS, FRACTION, SHEAR), SHEAR[:, None] * dt
    for _ in range(2):
        before, old = np.maximum(stresses(columns), 0.0), columns.state.solid_fraction.copy()
        columns.step(dt)
        now, stress = columns.state.solid_fraction, stresses(columns)
        most = (1.0 + WATER_TO_BUOYANT) * columns.forcing.liquefaction_pressure[:, None] * ETA
        free = (stress > 50.0) & (stress < most * (1.0 - 1e-6)) & (now > LOOSEST) & (now < DENSEST)
        tends = equilibrium_solid_fraction(np.maximum(stress, 0.0), SHEAR[:, None], DEBRIS)
        gained = 0.017 / old * np.log((np.maximum(stress, 0.0) + 1000.0) / (before + 1000.0))
        leaving = (strain * (old - tends) - gained) / (1.0 + old * strain)
        assert free.sum() > 50
        expected = old / np.maximum(1.0 + leaving, 0.5)  # a step doubles no solid fraction
        assert_allclose(now[free], expected[free], rtol=0.0, atol=2e-6)


@pytest.mark.parametrize("dt", [1e-6, 1e-3, 1.0, 1e3])
def test_a_film_of_a_tenth_of_a_millimetre(dt):
    """At rest its pressure is gone after T_c = h^2/c_v, 0.2 ms; nothing oscillates below or above."""
    columns = dilatant_columns({}, 1e-4, 0.62, profile=0.9e-4 * LOADING * ETA[None])
    last = columns.profile()
    for _ in range(5):
        columns.step(dt)
        now = columns.profile()
        assert np.all(now <= last * (1.0 + 1e-9) + 1e-10) and np.all(now >= -1e-10)
        last = now
    assert_allclose(columns.state.solid_fraction, 0.62, atol=2e-5)  # a ln(1 + sigma'/sigma_0) of 1 Pa


def test_a_longer_step_goes_farther():
    """Take one step from the same start: the longer, the lower the stress and the more water has left."""
    steps = np.logspace(-6.0, 3.0, 40)
    columns = [dilatant_columns({"permeability": 1e-10}, 0.5, 0.61, 50.0) for _ in steps]
    for one, dt in zip(columns, steps, strict=True):
        one.step(dt)
    stress = np.array([stresses(one)[0, :-1] for one in columns])
    fraction = np.array([one.state.solid_fraction[0] for one in columns])
    early = steps < 1e-2  # later water leaves, and stress rises again
    assert np.all(np.diff(stress[early], axis=0) < 0.0)
    assert np.all(np.diff(mean(fraction)) > -1e-12)
    assert np.all(fraction <= 0.64)


# ---- columns do not know each other ----


def mixed(count, chosen=slice(None)):
    """Columns of many kinds, some of which erode; return them and the function that takes a step."""
    random = np.random.default_rng(3)
    thickness = 10.0 ** random.uniform(-4, 1, count)
    fraction, shear = random.uniform(0.5, 0.7, count), 10.0 ** random.uniform(-2, 3, count)
    ratio, entrained = random.uniform(0.0, 1.0, count), 0.03 * thickness * (random.uniform(size=count) < 0.5)
    profile = (ratio * LOADING * thickness)[:, None] * ETA
    columns = dilatant_columns(
        {"permeability": 1e-10}, thickness[chosen], fraction[chosen], shear[chosen], profile=profile[chosen],
        soil_solid_fraction=0.63,
    )  # fmt: skip

    def step():
        bed = 0.65 * columns.forcing.liquefaction_pressure
        return columns.step(0.02, entrained[chosen], bed_pressure=bed)

    return columns, step


@pytest.mark.parametrize("count", [1, 2, 15, 16, 17, 40])
def test_a_column_does_not_depend_on_its_neighbours_in_a_block(count):
    together, step = mixed(40)
    alone, other_step = mixed(40, slice(40 - count, None))
    for _ in range(6):
        assert_array_equal(step()[40 - count :], other_step())
    for name in ("profile", "solid_fraction", "memory"):
        assert_array_equal(getattr(together.state, name)[40 - count :], getattr(alone.state, name))


def test_no_columns():
    assert dilatant_columns({}, np.empty(0), np.empty(0)).step(0.1).shape == (0,)


@pytest.mark.parametrize("name", ["thickness", "shear_rate", "solid_fraction", "profile", "liquefaction_pressure"])
def test_nan_is_not_hidden(name):
    (columns, _), (clean, _) = mixed(20), mixed(20)
    changes = {}
    if name in ("thickness", "liquefaction_pressure"):
        changes = {name: getattr(columns.forcing, name).copy()}
        changes[name][4] = np.nan
        clean_changes = {name: getattr(columns.forcing, name).copy()}
    elif name == "shear_rate":
        changes, clean_changes = {name: columns.forcing.shearing.rate.copy()}, {}
        changes[name][4] = np.nan
    else:
        getattr(columns.state, name)[4, 5], clean_changes = np.nan, {}
    columns.step(0.02, **changes)
    clean.step(0.02, **clean_changes)
    assert np.isnan(columns.state.profile[4]).any() or np.isnan(columns.state.solid_fraction[4]).any()
    others = np.arange(20) != 4
    assert_array_equal(columns.state.profile[others], clean.state.profile[others])
    columns.step(0.02, **({"thickness": clean.forcing.thickness} if changes and name != "shear_rate" else {}))
    assert np.isnan(columns.state.profile[4]).any() or np.isnan(columns.state.solid_fraction[4]).any()
