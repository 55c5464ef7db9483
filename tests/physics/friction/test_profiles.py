"""The mean velocity behind each law, integrated over its own profile, and how well the laws are solved.

Shear stress in plane flow is tau_b (1 - z/h), so the mean of u - v_b is the integral of (h - z)/h du/dz.
"""

import math
from fractions import Fraction

import numpy as np
import pytest
from scipy.integrate import quad

from landlab_debrisflow.physics.friction import Bingham, HerschelBulkley, MuI
from landlab_debrisflow.physics.friction.bingham import stress_beyond_yield
from landlab_debrisflow.physics.friction.herschel_bulkley import stress_beyond_yield as stress_beyond_yield_hb

from .bases import ask, base, resistance

H = 1.7
EXPONENTS = np.linspace(-14.0, 12.0, 261)
INDICES = [0.1, 0.25, 1.0 / 3.0, 0.5, 1.0, 1.4, 2.0]


def mean_velocity(shear_rate, top=H):
    """Integrate; `shear_rate` is a function of z [s-1], and 0 above `top` [m]."""
    return quad(lambda z: (1.0 - z / H) * shear_rate(z), 0.0, top, epsabs=0.0, epsrel=1e-12)[0]


@pytest.mark.parametrize("speed", [1e-4, 0.3, 20.0])
@pytest.mark.parametrize("slip", [0.0, 0.2])
@pytest.mark.parametrize("n", INDICES)
def test_herschel_bulkley_has_the_mean_of_its_profile(n, slip, speed):
    law = HerschelBulkley(yield_stress=400.0, consistency=60.0, flow_index=n)
    at_base = resistance(law, speed, thickness=H, slip_ratio=slip)[0]
    sheared = H * (1.0 - 400.0 / at_base)
    mean = mean_velocity(lambda z: (max(0.0, at_base * (1.0 - z / H) - 400.0) / 60.0) ** (1.0 / n), sheared)
    # w = tau_b - tau_y is known to eps tau_b here, and the speed goes with its power of 1 + 1/n
    rounding = 1e-15 * at_base / (at_base - 400.0) * (1.0 + 1.0 / n)
    assert mean == pytest.approx((1.0 - slip) * speed, rel=1e-10 + rounding)


@pytest.mark.parametrize("speed", [1e-4, 0.3, 20.0])
def test_bingham_has_the_mean_of_its_profile(speed):
    law = Bingham(yield_stress=400.0, viscosity=60.0)
    at_base = resistance(law, speed, thickness=H)[0]
    mean = mean_velocity(lambda z: max(0.0, at_base * (1.0 - z / H) - 400.0) / 60.0, H * (1.0 - 400.0 / at_base))
    assert mean == pytest.approx(speed, rel=1e-10)


def test_mu_i_has_the_mean_of_its_profile():
    """One inertial number over the whole thickness, P = sigma' (1 - z/h): Bagnold's profile."""
    law = MuI(static_friction_angle=20.0, limiting_friction_angle=35.0, inertial_number=0.3, grain_diameter=0.01)
    low, high = (math.tan(math.radians(angle)) for angle in (20.0, 35.0))
    friction = resistance(law, 4.0, thickness=H)[0] / 1e4
    number = 0.3 * (friction - low) / (high - friction)
    mean = mean_velocity(lambda z: number / 0.01 * math.sqrt(1e4 * (1.0 - z / H) / 2650.0))
    assert mean == pytest.approx(4.0, rel=1e-10)


def test_the_cubic_is_solved_to_rounding_for_every_speed():
    """In exact arithmetic a = s^2 (3 + 2 s)/(1 + s)^2, s = tau_b/tau_y - 1; s is at least as accurate as this a."""
    a = 10.0**EXPONENTS
    s = np.empty(a.size)
    stress_beyond_yield(np.ones(a.size), a, s)
    for given, found in zip(map(Fraction, a), map(Fraction, s), strict=True):
        assert abs(found**2 * (3 + 2 * found) / (1 + found) ** 2 / given - 1) < 1e-14


def test_the_ends_of_the_cubic():
    s = np.empty(3)
    stress_beyond_yield(np.array([1.0, 1.0, 0.0]), np.array([1e-20, 1e12, 10.0]), s)
    # s (1 + 2/3 s ...) = (a/3)^(1/2); (a + 1)/2 less terms in 1/a; 3 mu v/h is half of 6 mu v/h
    np.testing.assert_allclose(s, [math.sqrt(1e-20 / 3.0), 0.5e12 + 0.5, 5.0], rtol=1e-10)


@pytest.mark.parametrize("n", INDICES)
def test_herschel_bulkley_is_solved_to_rounding_for_every_speed(n):
    a = 10.0**EXPONENTS
    w = np.empty(a.size)
    stress_beyond_yield_hb(np.ones(a.size), np.log(a), np.array([n]), w)
    q = w / (1.0 + w)
    np.testing.assert_allclose(w * (q * (2.0 * n + 1.0 - n * q)) ** n, a, rtol=5e-14)  # logarithms of up to 32


def test_an_index_of_one_is_bingham():
    speed = 10.0 ** np.linspace(-8.0, 3.0, 100)
    given = base(speed, thickness=np.linspace(1e-3, 30.0, 100), effective_normal_stress=np.linspace(0.0, 1e6, 100))
    one = ask(Bingham(yield_stress=300.0, viscosity=40.0, basal_friction_angle=10.0), given)
    other = ask(HerschelBulkley(yield_stress=300.0, consistency=40.0, flow_index=1.0, basal_friction_angle=10.0), given)
    np.testing.assert_allclose(other, one, rtol=5e-14)


def test_indices_that_vary_are_solved_each_by_itself():
    index, a = np.array(INDICES), np.full(len(INDICES), 3.0)
    together, alone = np.empty(index.size), np.empty(1)
    stress_beyond_yield_hb(np.ones(index.size), np.log(a), index, together)
    for n, found in zip(INDICES, together, strict=True):
        stress_beyond_yield_hb(np.ones(1), np.log(a[:1]), np.array([n]), alone)
        assert found == pytest.approx(alone[0], rel=1e-14)


@pytest.mark.parametrize("law", [Bingham, HerschelBulkley, MuI])
def test_resistance_never_falls_with_speed(law):
    # below 1e-9 m/s, where drag is kept, as well
    found = resistance(law(), np.concatenate([[0.0], 10.0 ** np.linspace(-15.0, 3.0, 400)]))
    assert np.all(np.diff(found) >= -1e-15 * found[1:])


@pytest.mark.parametrize("law", [Bingham, HerschelBulkley, MuI])
def test_what_slides_as_a_block_is_not_sheared(law):
    assert not ask(law(), base([0.0, 1e-3, 10.0], slip_ratio=1.0))[1].any()
