"""Each friction law in the flow, on a plane: terminal speed, arrest, no reversal, and what pore pressure does (theory, 2 and 6).

The body is a single particle: without neighbours its thickness stays and nothing pushes it, so the closed forms for
its own thickness hold to rounding.
"""

import math

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow, Material
from landlab_debrisflow.model import step
from landlab_debrisflow.model.physics import build_law
from landlab_debrisflow.physics.friction import Bingham, Coulomb, HerschelBulkley, MuI, Voellmy

from ..grids import inclined, place, release

G, STEEP, GENTLE = 9.81, math.radians(20.0), math.radians(6.0)
RATIO = 0.4  # excess pore pressure over liquefaction

LAWS = [
    Coulomb(basal_friction_angle=25.0, cohesion=400.0, viscosity=600.0),
    Coulomb(basal_friction_angle=25.0, viscosity=600.0, velocity_profile="parabolic"),
    Voellmy(basal_friction_angle=25.0, cohesion=400.0, turbulent_coefficient=150.0),
    Bingham(yield_stress=3000.0, viscosity=150.0),
    Bingham(yield_stress=1000.0, viscosity=150.0, basal_friction_angle=15.0),
    HerschelBulkley(yield_stress=3000.0, consistency=700.0, flow_index=0.5),
    HerschelBulkley(yield_stress=1000.0, consistency=100.0, flow_index=1.3, basal_friction_angle=15.0),
    MuI(static_friction_angle=30.0, limiting_friction_angle=60.0, inertial_number=0.3, grain_diameter=0.05),
]
of_laws = pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)


def lone(law, slope, **material):
    """Put one particle, some 0.8 m thick, on a plane at rest; its pressure ratio stays what it is."""
    grid = inclined((7, 150), 10.0, math.tan(slope))
    depth = np.zeros(grid.shape)
    depth[3, 3] = (
        200.0  # of which the particle, which knows no neighbours, keeps 1/64 as least, and its own sum of that
    )
    release(grid, depth.ravel(), on_top=True)
    flow = DebrisFlow(
        grid, friction=law, erosion="none", column={"law": "constant_ratio", "ratio": RATIO}, material=material,
        numerics={"settle": False, "particle_count": 1, "rest_energy": 0.0},
    )  # fmt: skip
    return place(flow)


def speed(flow):
    """Return the speed along the fall line, negative if uphill [m s-1]."""
    u, v, w = flow._simulation.particles.velocity[:, 0]
    assert v == 0.0
    return math.copysign(math.hypot(u, w), u)


def throw(flow, velocity, slope):
    flow._simulation.particles.velocity[:, 0] = velocity * np.array([math.cos(slope), 0.0, -math.sin(slope)])
    flow._simulation._arrested = False


def terminal_speed(law, thickness, slip_ratio, material):
    """Solve rho g h sin(theta) = tau_b(v) by hand, by law."""
    drive = material.density * G * thickness * math.sin(STEEP)
    stress = (1.0 - RATIO) * material.buoyant_density * G * thickness * math.cos(STEEP)
    tangent = math.tan(math.radians(getattr(law, "basal_friction_angle", 0.0)))
    match law:
        case Coulomb():
            factor = {"linear": 2.0, "parabolic": 3.0}[law.velocity_profile]
            sheared = (drive - law.cohesion - stress * tangent) * thickness / (factor * law.viscosity)
        case Voellmy():
            beyond = drive - law.cohesion - stress * tangent
            return math.sqrt(law.turbulent_coefficient * beyond / (material.density * G))
        case Bingham():
            xi = (law.yield_stress + stress * tangent) / drive
            sheared = drive * thickness / (6.0 * law.viscosity) * (1.0 - xi) ** 2 * (2.0 + xi)
        case HerschelBulkley():
            n, xi = law.flow_index, (law.yield_stress + stress * tangent) / drive
            plug = n / (n + 1.0) * thickness * (drive / law.consistency) ** (1.0 / n) * (1.0 - xi) ** (1.0 + 1.0 / n)
            sheared = plug * (1.0 - n / (2.0 * n + 1.0) * (1.0 - xi))
        case MuI():
            low, high = (math.tan(math.radians(a)) for a in (law.static_friction_angle, law.limiting_friction_angle))
            number = law.inertial_number * (drive / stress - low) / (high - drive / stress)
            sheared = number * thickness * math.sqrt(stress / law.grain_density) / (2.5 * law.grain_diameter)
    return sheared / (1.0 - slip_ratio)


@of_laws
@pytest.mark.parametrize("slip_ratio", [0.0, 1.0 / 3.0])
def test_a_steady_flow_has_the_speed_of_its_closed_form(law, slip_ratio):
    flow = lone(law, STEEP, basal_slip_ratio=slip_ratio)
    flow.run_one_step(100.0)
    thickness = float(flow._simulation.particles.thickness[0])
    exact = terminal_speed(law, thickness, slip_ratio, Material(basal_slip_ratio=slip_ratio))
    assert speed(flow) == pytest.approx(exact, rel=1e-9)
