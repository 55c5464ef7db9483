"""The normal force on a curved bed: hand values, the cap, and no friction where the flow would lift off."""

import numpy as np
import pytest

from landlab_debrisflow.core.parameters import on_nodes
from landlab_debrisflow.model.basal import BedLoad, Weighing, press_on_bed
from landlab_debrisflow.physics.contracts import BasalState, BasalStress
from landlab_debrisflow.physics.friction import Coulomb, Voellmy
from landlab_debrisflow.physics.material import Material

G, SPACING = 9.81, 5.0


def on_bed(velocity, gradient=(0.0, 0.0), hessian=(0.0, 0.0, 0.0)):
    """Return speed and normal gravity of one particle; its velocity on the map, tangent to the bed, is given."""
    curvature = tuple(np.array([hessian]).T.copy())
    u, v = velocity
    along = np.array([[u, v, u * gradient[0] + v * gradient[1]]]).T
    cosine = 1.0 / np.sqrt(1.0 + np.sum(np.square([gradient]), axis=1))
    one = np.ones(1)
    load, weighing = BedLoad(one, one, 0.0 * one), Weighing(G, 0.0, SPACING)
    speed, normal, _ = press_on_bed(0, along, curvature, cosine, load, weighing)
    return float(speed[0]), float(normal[0])


def test_at_the_bottom_of_a_dip_the_weight_is_that_of_a_swing():
    """N = m (g + v^2/R)."""
    radius = 100.0
    assert on_bed((20.0, 0.0), hessian=(1.0 / radius, 0.0, 0.0)) == pytest.approx((20.0, G + 400.0 / radius))
    assert on_bed((0.0, 20.0), hessian=(1.0 / radius, 0.0, 0.0))[1] == G  # along the axis of a trough it is flat
    # of a trough at 45 degrees, Hess = n n / R, what goes straight across or along
    diagonal, part = (0.5 / radius, 0.5 / radius, 0.5 / radius), 20.0 / np.sqrt(2.0)
    assert on_bed((part, part), hessian=diagonal)[1] == pytest.approx(G + 400.0 / radius)
    assert on_bed((part, -part), hessian=diagonal)[1] == pytest.approx(G)


@pytest.mark.parametrize("degrees", [-40.0, 25.0])
def test_on_a_slope_the_radius_is_that_of_the_profile(degrees):
    """On a circle of radius R, N/m = g cos + v^2/R all the way; z'' = 1/(R cos^3)."""
    radius, angle, speed = 80.0, np.radians(degrees), 15.0
    found = on_bed((speed * np.cos(angle), 0.0), (np.tan(angle), 0.0), (1.0 / (radius * np.cos(angle) ** 3), 0.0, 0.0))
    assert found == pytest.approx((speed, G * np.cos(angle) + speed**2 / radius), rel=1e-13)


def test_no_radius_is_tighter_than_a_node_spacing():
    assert on_bed((4.0, 0.0), hessian=(1.0 / (1.01 * SPACING), 0.0, 0.0))[1] == pytest.approx(G + 16.0 / 1.01 / SPACING)
    for hessian in (1.0 / (0.99 * SPACING), 1.0, 1e6):
        assert on_bed((4.0, 0.0), hessian=(hessian, 0.0, 0.0))[1] == pytest.approx(G + 16.0 / SPACING, rel=1e-14)


def test_over_a_bump_the_flow_gets_lighter_and_without_weight_it_has_no_friction():
    radius = 30.0
    lifts = np.sqrt(G * radius)  # 17.2 m/s
    assert on_bed((0.5 * lifts, 0.0), hessian=(-1.0 / radius, 0.0, 0.0))[1] == pytest.approx(0.75 * G)
    for speed in (1.001 * lifts, 3.0 * lifts):
        found, normal = on_bed((speed, 0.0), hessian=(-1.0 / radius, 0.0, 0.0))
        assert normal == 0.0
        one = np.ones(1)
        state = BasalState(
            one, one, found * one, 1990.0 * one, normal * one,
            BasalStress(990.0 * normal * one, 9712.0 * one, 0.0 * one), 0.0 * one, Material(gravity=G), None, None,
        )  # fmt: skip
        for law in (Coulomb(), Voellmy()):
            stress, drag = np.empty(1), np.empty(1)
            law.basal_resistance(state._replace(parameters=on_nodes(law, {})), stress, drag)
            assert stress[0] == 0.0
            # what is left of Voellmy is turbulence
            assert drag[0] == (0.0 if isinstance(law, Coulomb) else pytest.approx(1990.0 * G * speed / 500.0))
