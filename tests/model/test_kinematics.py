"""What the kick makes of strength and drag where there is next to nothing to be held."""

import numpy as np
import pytest

from landlab_debrisflow.model.kinematics import Resistance, kick

G = 9.81


def kicked(velocity, yield_stress, drag, mass, dt=0.1):
    """Kick one particle on a plane that falls by 1 towards x; return its velocity, shape (3,) [m s-1]."""
    state = np.array(velocity, float)[:, None]
    one = np.ones(1)
    kick(
        0,
        state,
        np.zeros((3, 1)),
        (-np.ones(1), np.zeros(1)),
        one / np.sqrt(2.0),
        Resistance(yield_stress=yield_stress * one, drag=drag * one, mass=mass * one, rest_speed=np.zeros(1)),
        G,
        dt,
    )
    return state[:, 0]


@pytest.mark.parametrize("mass", [1e-300, 1e-12])
@pytest.mark.parametrize(("yield_stress", "drag"), [(500.0, 0.0), (0.0, 1e9), (500.0, 1e9)])
def test_a_film_of_next_to_no_mass_is_held_by_what_it_has(mass, yield_stress, drag):
    for velocity in ([0.0, 0.0, 0.0], [3.0, 0.0, -3.0]):
        found = kicked(velocity, yield_stress, drag, mass)
        assert np.all(abs(found) < 1e-10)  # (v + a dt) mass / (drag dt) at most: 1e-19


def test_strength_and_drag_by_hand():
    """Gravity along the slope is g/2^(1/2) = 6.94; 100 Pa on 50 kg/m2 take 2 m/s2 off; then 1 + dt d/m = 1.5."""
    along = G / np.sqrt(2.0)
    found = kicked([3.0, 0.0, -3.0], 100.0, 250.0, 50.0, dt=0.1)
    speed = (np.sqrt(18.0) + 0.1 * along - 0.2) / 1.5
    np.testing.assert_allclose(found, np.array([1.0, 0.0, -1.0]) * speed / np.sqrt(2.0), rtol=1e-14)
