"""Closed forms of debris that contracts or dilates: digits, limits, and the equations that they solve."""

import doctest

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
from scipy.integrate import solve_ivp

from landlab_debrisflow.exact import dilatancy
from landlab_debrisflow.exact.dilatancy import (
    DilatantDebris,
    dilatant_block,
    drained_solid_fraction,
    equilibrium_solid_fraction,
    equilibrium_stress,
    liquefaction_strain,
    stress_after_strain,
)
from landlab_debrisflow.laws import Dilatancy

SLOPE, ANGLE = np.radians(31.0), np.radians(40.7)


def test_docstrings():
    with np.errstate(all="raise", under="ignore"):
        assert doctest.testmod(dilatancy).failed == 0


def test_defaults_are_those_of_the_law():
    law, debris = Dilatancy(), DilatantDebris()
    same = set(debris._fields) - {"solid_density"}
    assert {name: getattr(law, name) for name in same} == {name: getattr(debris, name) for name in same}


def test_equilibrium_stress_by_hand():
    """GI's grains, 2700 kg/m3: the four values of a prototype."""
    found = equilibrium_stress([0.58, 0.60, 0.61, 0.62], 20.0, DilatantDebris(solid_density=2700.0))
    assert_allclose(found, [8.26, 21.42, 40.26, 95.02], atol=5e-3)
    coarse = DilatantDebris(grain_diameter=0.01)
    assert_array_equal(equilibrium_stress([0.62, 0.64, 0.7], 50.0, coarse), [0.0, np.inf, np.inf])


def test_equilibrium_stress_is_that_of_the_equilibrium_fraction():
    stress, rate = np.array([1.0, 30.0, 1e3, 1e5]), np.array([0.1, 5.0, 50.0, 300.0])
    assert_allclose(equilibrium_stress(equilibrium_solid_fraction(stress, rate), rate), stress, rtol=1e-9)


def test_no_shear_and_no_stress():
    assert_array_equal(equilibrium_solid_fraction([0.0, 10.0], 0.0), 0.64)
    assert equilibrium_solid_fraction(0.0, 1.0, DilatantDebris(grain_diameter=0.0)) == 0.0


def test_stress_is_gone_at_the_strain_of_liquefaction():
    for fraction in (0.5, 0.6, 0.63):
        strain = float(liquefaction_strain(7e3, fraction))
        before, after = stress_after_strain(np.array([0.999, 1.001]) * strain, 7e3, fraction)
        assert 0.0 < before < 4.0 and after == 0.0
    assert stress_after_strain(1.0, 100.0, 0.66) > 100.0
    assert_array_equal(liquefaction_strain([0.0, 10.0], 0.66), [0.0, np.inf])


def test_the_drained_fraction_solves_its_equation():
    strain = np.linspace(0.0, 5.0, 6)
    for start in (0.5, 0.64, 0.7):
        found = solve_ivp(lambda _, m: -m * (m - 0.64), (0.0, 5.0), [start], t_eval=strain, rtol=1e-10, atol=1e-12).y[0]
        assert_allclose(drained_solid_fraction(strain, start), found, rtol=1e-8)


def test_a_block_at_rest_stays():
    for time in (0.0, [0.0], [0.0, 5.0]):
        velocity, stress, fraction = dilatant_block(time, np.radians(10.0), 0.5, 0.62, ANGLE)
        assert velocity.shape == stress.shape == fraction.shape == np.shape(time)
        assert not velocity.any() and np.all(stress == stress.flat[0])


def test_a_drained_block_of_critical_debris_slides_as_any_block():
    """With next to no viscosity psi = 0: v = g (sin(slope) - rho'/rho tan(phi) cos(slope)) t."""
    debris = DilatantDebris(pore_fluid_viscosity=1e-12)
    velocity, _, fraction = dilatant_block([1.0, 3.0], SLOPE, 1.0, 0.64, ANGLE, True, debris)
    buoyant, density = 0.64 * 1650.0, 0.64 * 2650.0 + 0.36 * 1000.0
    pull = 9.81 * (np.sin(SLOPE) - buoyant / density * np.tan(ANGLE) * np.cos(SLOPE))
    assert_allclose(velocity, pull * np.array([1.0, 3.0]), rtol=1e-4)
    assert_allclose(fraction, 0.64, rtol=1e-4)


def test_dense_debris_locks_at_the_lowest_pressure_or_before():
    velocity, stress, _ = dilatant_block([0.1, 10.0], SLOPE, 0.5, 0.66, ANGLE)
    most = (0.66 * 2650.0 + 0.34 * 1000.0) * 9.81 * 0.5 * np.cos(SLOPE)
    assert velocity[0] > 0.0 == velocity[1] and stress[0] < stress[1] <= most


def test_times_in_any_order():
    time = np.array([[1.0, 0.2], [0.0, 0.5]])
    for drained in (False, True):
        one = dilatant_block(time, SLOPE, 0.5, 0.62, ANGLE, drained)
        other = dilatant_block(np.sort(time.ravel()), SLOPE, 0.5, 0.62, ANGLE, drained)
        assert_allclose(np.sort(one[0].ravel()), other[0], rtol=1e-7, atol=1e-12)
