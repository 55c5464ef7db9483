"""Each law at points where it can be worked out by hand; only the arithmetic is rounded: 1e-14."""

import math

import numpy as np
import pytest

from landlab_debrisflow.core.errors import ParameterError
from landlab_debrisflow.core.parameters import on_nodes
from landlab_debrisflow.physics.friction import Bingham, Coulomb, HerschelBulkley, MuI, Voellmy

from .bases import DENSITY, G, ask, base, resistance


@pytest.mark.parametrize(
    ("profile", "slip", "factor"),
    [("linear", 0.0, 2.0), ("linear", 1.0 / 3.0, 4.0 / 3.0), ("parabolic", 0.0, 3.0), ("linear", 1.0, 0.0)],
)
def test_the_viscous_part_of_coulomb(profile, slip, factor):
    """docs/theory.md#friction: 2 mu v/h without slip, (4/3) mu v/h at v_b = v/3, parabolic 3 mu v/h."""
    law = Coulomb(viscosity=300.0, velocity_profile=profile)
    drag = ask(law, base([0.0, 5.0], thickness=1.5, slip_ratio=slip))[1]
    np.testing.assert_allclose(drag, factor * 300.0 / 1.5, rtol=1e-14)


def test_a_linear_profile_and_a_parabola_have_these_means():
    """Where the factors come from: the shear rate at the base over the mean of u - v_b; three points are exact."""
    z, weight = np.polynomial.legendre.leggauss(3)
    z, weight = 0.5 * (z + 1.0), 0.5 * weight
    for profile, shear, at_base in (("linear", z, 1.0), ("parabolic", 2.0 * z - z**2, 2.0)):
        drag = ask(Coulomb(viscosity=1.0, velocity_profile=profile), base(1.0, thickness=1.0))[1]
        assert drag[0] == pytest.approx(at_base / (weight @ shear), rel=1e-14)


@pytest.mark.parametrize("law", [Coulomb, Voellmy])
def test_cohesion_adds_to_friction_and_stays_without_normal_stress(law):
    yield_stress, _ = ask(
        law(basal_friction_angle=45.0, cohesion=500.0), base([1.0, 1.0], effective_normal_stress=[0.0, 1e4])
    )
    np.testing.assert_allclose(yield_stress, [500.0, 10500.0], rtol=1e-14)


@pytest.mark.parametrize("law", [Coulomb, Voellmy, Bingham, HerschelBulkley, MuI])
def test_the_angle_of_dilatancy_adds_to_every_friction_angle(law):
    """tan(45 deg + psi) = (1 + tan(psi))/(1 - tan(psi)); no less than 0, no more than tan(89 deg)."""
    names = ("static_friction_angle", "limiting_friction_angle") if law is MuI else ("basal_friction_angle",)
    flowing = law(**dict.fromkeys(names, 45.0), **({"yield_stress": 0.0} if law in (Bingham, HerschelBulkley) else {}))
    state = base(np.ones(4))._replace(dilatancy=np.array([0.0, 0.1, -0.2, -5.0]))
    np.testing.assert_allclose(ask(flowing, state)[0], 1e4 * np.array([1.0, 1.1 / 0.9, 0.8 / 1.2, 0.0]), rtol=1e-13)
    locked = base(1.0)._replace(dilatancy=np.array([1.5]))
    assert ask(flowing, locked)[0] == pytest.approx(1e4 * math.tan(math.radians(89.0)), rel=1e-13)


def test_dilatancy_adds_to_both_angles_of_mu_i():
    """Between the two curves the resistance is a mean of theirs, as without dilatancy."""
    law, dilatancy = MuI(static_friction_angle=20.0, limiting_friction_angle=30.0), math.tan(math.radians(5.0))
    steeper = MuI(static_friction_angle=25.0, limiting_friction_angle=35.0)
    state = base(3.0)._replace(dilatancy=np.array([dilatancy]))
    np.testing.assert_allclose(ask(law, state), ask(steeper, base(3.0)), rtol=1e-13)


def test_voellmy_does_not_know_of_slip():
    drag = ask(Voellmy(turbulent_coefficient=500.0), base(10.0, slip_ratio=0.5))[1]
    assert drag[0] == pytest.approx(DENSITY * G * 10.0 / 500.0, rel=1e-14)


@pytest.mark.parametrize("law", [Bingham, HerschelBulkley])
def test_half_a_plug_by_hand(law):
    """xi = 1/2: a = (1 - xi)^2 (2 + xi)/xi = 1.25 = 6 mu v/(tau_y h), so of 1000 Pa, 2 m, 10 m/s mu is 125/3 Pa s."""
    keywords = {"viscosity": 125.0 / 3.0} if law is Bingham else {"consistency": 125.0 / 3.0, "flow_index": 1.0}
    yield_stress, drag = ask(law(yield_stress=1000.0, **keywords), base(10.0))
    assert yield_stress[0] == 1000.0
    assert drag[0] == pytest.approx(100.0, rel=1e-14)  # tau_b = 2000 Pa
    # a half of it slides: as much at twice the speed, and half of that drag
    assert ask(law(yield_stress=1000.0, **keywords), base(20.0, slip_ratio=0.5))[1][0] == pytest.approx(50.0, rel=1e-14)


@pytest.mark.parametrize("law", [Bingham, HerschelBulkley])
def test_the_yield_stress_grows_with_effective_stress_if_so_wished(law):
    given = {"effective_normal_stress": [0.0, 1e4, 2e4]}
    np.testing.assert_array_equal(ask(law(yield_stress=700.0), base(np.ones(3), **given))[0], 700.0)
    frictional = ask(law(yield_stress=700.0, basal_friction_angle=45.0), base(np.ones(3), **given))[0]
    np.testing.assert_allclose(frictional, [700.0, 10700.0, 20700.0], rtol=1e-14)


def test_bingham_without_yield_stress_is_newtonian():
    law = Bingham(yield_stress=0.0, viscosity=80.0)
    np.testing.assert_allclose(
        resistance(law, np.array([0.1, 5.0, 40.0])), 3.0 * 80.0 * np.array([0.05, 2.5, 20.0]), rtol=1e-14
    )


@pytest.mark.parametrize("n", [0.1, 1.0 / 3.0, 1.0, 2.0])
def test_herschel_bulkley_without_yield_stress_is_a_power_law(n):
    law = HerschelBulkley(yield_stress=0.0, consistency=80.0, flow_index=n)
    speed = np.array([1e-3, 0.1, 5.0, 40.0])
    exact = 80.0 * ((2.0 * n + 1.0) / n * speed / 2.0) ** n
    np.testing.assert_allclose(resistance(law, speed), exact, rtol=2e-14)  # logarithms of up to 10


def test_mu_i_half_way():
    """I = 2.5 * 10 * 0.02/(2 * sqrt(1e4/2500)) = 1/8 = I_0, so mu is half of tan 45; half of it slides: I = 1/16."""
    law = MuI(
        static_friction_angle=0.0, limiting_friction_angle=45.0, inertial_number=0.125, grain_diameter=0.02,
        grain_density=2500.0,
    )  # fmt: skip
    yield_stress, drag = ask(law, base(10.0))
    assert yield_stress[0] == 0.0 and drag[0] == pytest.approx(500.0, rel=1e-14)
    assert ask(law, base(10.0, slip_ratio=0.5))[1][0] == pytest.approx(1e4 / 3.0 / 10.0, rel=1e-14)


def test_the_inertial_number_is_that_of_gray_and_edwards():
    """I = 5 v d/(2 h^(3/2) (phi_c g cos(theta))^(1/2)), their equation for a dry flow."""
    v, d, h, fraction, cosine = 3.0, 0.005, 0.4, 0.6, math.cos(0.5)
    number = 5.0 * v * d / (2.0 * h**1.5 * math.sqrt(fraction * G * cosine))
    law = MuI(static_friction_angle=20.0, limiting_friction_angle=35.0, inertial_number=0.3, grain_diameter=d)
    low, high = math.tan(math.radians(20.0)), math.tan(math.radians(35.0))
    stress = fraction * 2650.0 * G * cosine * h
    found = resistance(law, v, thickness=h, effective_normal_stress=stress)[0]
    assert found == pytest.approx(stress * (low + (high - low) / (1.0 + 0.3 / number)), rel=1e-14)


def test_mu_i_goes_from_its_static_to_its_limiting_friction():
    law = MuI(static_friction_angle=20.0, limiting_friction_angle=30.0)
    slow, fast = resistance(law, np.array([1e-9, 1e12])) / 1e4
    assert slow == pytest.approx(math.tan(math.radians(20.0)), rel=1e-8)  # I < 1e-10, I/I_0 of the difference
    assert fast == pytest.approx(math.tan(math.radians(30.0)), rel=1e-8)


@pytest.mark.parametrize("speed", [0.0, 1e-9, 10.0])
@pytest.mark.parametrize("thickness", [0.0, 1e-5, 2.0])
def test_mu_i_of_what_is_liquefied_is_nothing(speed, thickness):
    assert not ask(MuI(), base(speed, thickness=thickness, effective_normal_stress=0.0)).any()


@pytest.mark.parametrize(("low", "high"), [(30.0, 20.0), ([20.0, 30.0], 25.0), ([20.0, 20.0], [20.0, 19.0])])
def test_a_limiting_friction_below_the_static_is_refused(low, high):
    with pytest.raises(
        ParameterError, match=r"limiting_friction_angle must be at least static_friction_angle, \d+ deg"
    ):
        MuI(static_friction_angle=low, limiting_friction_angle=high)


def test_arrays_of_two_sizes_are_left_to_the_grid_to_refuse():
    assert MuI(static_friction_angle=[20.0, 20.0], limiting_friction_angle=[30.0, 30.0, 30.0])


def test_a_field_of_limiting_friction_below_the_static_changes_nothing():
    """Known on a grid only: the law's description says that the static one holds there."""
    law = MuI(static_friction_angle=30.0, limiting_friction_angle="angle")
    out = np.empty((2, 2))
    law.basal_resistance(base([5.0, 5.0])._replace(parameters=on_nodes(law, {"angle": np.array([20.0, 40.0])})), *out)
    assert out[1, 0] == 0.0 and out[1, 1] > 0.0
