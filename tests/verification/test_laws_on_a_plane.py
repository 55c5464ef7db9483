"""Each friction law in the flow, on a plane: terminal speed, arrest, no reversal, pressure (docs/theory.md#friction).

The body is a single particle: without neighbours its thickness stays and nothing pushes it, so the closed forms for
its own thickness hold to rounding.
"""

import math

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow, Material
from landlab_debrisflow.model import step
from landlab_debrisflow.physics.friction import Bingham, Coulomb, HerschelBulkley, MuI, Voellmy
from validation.grids import inclined, place, release, set_free, throw
from validation.measure import body

G, STEEP, GENTLE = 9.81, math.radians(20.0), math.radians(6.0)
DOWN = np.array([math.cos(GENTLE), 0.0, -math.sin(GENTLE)])  # the fall line of the gentle slope
RATIO = 0.4  # excess pore pressure over liquefaction

LAWS = [
    Coulomb(basal_friction_angle=25.0, cohesion=400.0, viscosity=600.0),
    Coulomb(basal_friction_angle=25.0, viscosity=600.0, velocity_profile="parabolic"),
    Voellmy(basal_friction_angle=25.0, cohesion=400.0, turbulent_coefficient=150.0),
    Bingham(yield_stress=3000.0, viscosity=150.0),
    Bingham(yield_stress=1000.0, viscosity=150.0, basal_friction_angle=15.0),
    HerschelBulkley(yield_stress=3000.0, consistency=700.0, flow_index=0.5),
    HerschelBulkley(yield_stress=1000.0, consistency=100.0, flow_index=1.3, basal_friction_angle=15.0),
    MuI(static_friction_angle=30.0, limiting_friction_angle=60.0, inertial_number=0.1, grain_diameter=0.05),
]
of_laws = pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)


def lone(law, slope, ratio=RATIO, **material):
    """Put one particle, some 0.8 m thick, on a plane at rest; its pressure ratio stays what it is."""
    grid = inclined((7, 150), 10.0, math.tan(slope))
    depth = np.zeros(grid.shape)
    depth[3, 3] = (
        200.0  # of which the particle, which knows no neighbours, keeps 1/64 as least, and its own sum of that
    )
    release(grid, depth.ravel(), on_top=True)
    flow = DebrisFlow(
        grid, friction=law, erosion="none", column={"law": "constant_ratio", "ratio": ratio}, material=material,
        numerics={"settle": False, "particle_count": 1, "rest_energy": 0.0},
    )  # fmt: skip
    return place(flow)


def speed(flow):
    """Return the speed along the fall line, negative if uphill [m s-1]."""
    u, v, w = body(flow).velocity[:, 0]
    assert v == 0.0
    return math.copysign(math.hypot(u, w), u)


def terminal_speed(law, thickness, material, ratio=RATIO):
    """Solve rho g h sin(theta) = tau_b(v) by hand, by law."""
    drive = material.density * G * thickness * math.sin(STEEP)
    stress = (1.0 - ratio) * material.buoyant_density * G * thickness * math.cos(STEEP)
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
    return sheared / (1.0 - material.basal_slip_ratio)


def thickness(flow):
    return float(flow.particles.thickness[0])


@pytest.mark.slow
@of_laws
def test_a_steady_flow_has_the_speed_of_its_closed_form(law):
    """A third of the mean velocity slides; that nothing does is the same with other numbers."""
    flow = lone(law, STEEP, basal_slip_ratio=1.0 / 3.0)
    flow.run_one_step(100.0)
    exact = terminal_speed(law, thickness(flow), Material(basal_slip_ratio=1.0 / 3.0))
    # it gets there like exp(-t/T), the slowest with T = 4 s; measured 4e-13 at most
    assert speed(flow) == pytest.approx(exact, rel=1e-10)


@pytest.mark.slow
def test_what_is_liquefied_keeps_cohesion_and_viscosity():
    flow = lone(LAWS[0], STEEP, ratio=1.0)
    flow.run_one_step(60.0)
    assert speed(flow) == pytest.approx(terminal_speed(LAWS[0], thickness(flow), Material(), ratio=1.0), rel=1e-10)


@pytest.mark.slow
@pytest.mark.parametrize("law", [Coulomb(basal_friction_angle=30.0), MuI()], ids=["Coulomb", "MuI"])
def test_what_is_liquefied_falls_freely(law):
    flow = lone(law, STEEP, ratio=1.0)
    flow.run_one_step(5.0 - flow.elapsed_time)
    assert speed(flow) == pytest.approx(G * math.sin(STEEP) * 5.0, rel=1e-12)


@pytest.mark.slow
@of_laws
@pytest.mark.parametrize("dt", [1e-3, 1e3])
def test_what_its_strength_holds_never_moves(law, dt):
    flow = lone(law, GENTLE)
    for _ in range(3):
        set_free(flow)  # let every step decide anew
        flow.run_one_step(dt)
    assert flow.at_rest and not body(flow).velocity.any()


@pytest.mark.slow
@of_laws
def test_what_is_thrown_stops_and_stays(law):
    flow = lone(law, GENTLE)
    throw(flow, 3.0 * DOWN)
    # strength exceeds the drive by 0.28 of g sin(theta) at least, viscous parts help: 3/(0.28 g sin(6 deg)) = 10.5 s
    speeds = [speed(flow)]
    while len(speeds) < 45:
        flow.run_one_step(0.25)
        speeds.append(speed(flow))
    assert min(speeds) == speeds[-1] == 0.0 and flow.at_rest
    assert np.all(np.diff(speeds) <= 0.0)
    x = float(flow.particles.x[0])
    flow.run_one_step(1000.0)
    assert float(flow.particles.x[0]) == x and speed(flow) == 0.0


@pytest.mark.slow
@of_laws
@pytest.mark.parametrize("velocity", [1e-12, -1e-12, 1e-3, -1e-3, 3.0, -3.0, 50.0, -50.0])
def test_friction_never_reverses_what_it_stops(law, velocity, gently):
    """For steps of any length, downhill and uphill: no velocity against the one before."""
    flow = gently(law)
    for dt in 10.0 ** np.arange(-4.0, 5.0):
        throw(flow, velocity * DOWN)
        sim = flow._simulation
        near = sim.surroundings
        step.friction_and_kick(sim.particles, sim.state.exchange, near.friction, sim.phases, near.walls, dt)
        after = speed(flow)
        assert 0.0 <= after * velocity <= velocity * velocity * (1.0 + 1e-12)


@pytest.fixture(scope="module")
def gently():
    """Return what gives one body per law, on the gentle slope, to be thrown again and again."""
    made = {}
    return lambda law: made[law] if law in made else made.setdefault(law, lone(law, GENTLE))


@pytest.mark.slow
@pytest.mark.parametrize(
    "law", [Bingham(yield_stress=1000.0), HerschelBulkley(yield_stress=1000.0)], ids=["Bingham", "HerschelBulkley"]
)
def test_pore_pressure_is_nothing_to_a_fluid_without_friction(law):
    speeds = []
    for ratio in (0.0, 0.9):
        flow = lone(law, STEEP, ratio=ratio)
        flow.run_one_step(5.0)
        speeds.append(speed(flow))
    assert speeds[0] == speeds[1] > 0.0


@pytest.mark.slow
@pytest.mark.parametrize("law", [LAWS[0], LAWS[2], LAWS[4], LAWS[6], LAWS[7]], ids=lambda law: type(law).__name__)
def test_pore_pressure_makes_what_has_friction_faster(law):
    flow = lone(law, STEEP, ratio=0.5)
    flow.run_one_step(150.0)
    exact = terminal_speed(law, thickness(flow), Material(), ratio=0.5)
    assert exact > 1.05 * terminal_speed(law, thickness(flow), Material(), ratio=RATIO)
    assert speed(flow) == pytest.approx(exact, rel=1e-9)


@pytest.mark.parametrize(
    ("water_table_ratio", "density", "buoyant"),
    [(1.0, 1990.0, 990.0), (0.5, 1790.0, 1290.0), (0.0, 1590.0, 1590.0)],
)
def test_the_water_table_sets_the_apparent_friction(water_table_ratio, density, buoyant):
    """mu_a = (rho'/rho)(1 - r) tan(phi); rho = 0.6 * 2650 + 0.4 * 1000 m, rho' = rho - 1000 m kg/m3, m = h_w/h."""
    flow = lone(Coulomb(basal_friction_angle=15.0), STEEP, water_table_ratio=water_table_ratio)
    flow.run_one_step(5.0 - flow.elapsed_time)
    apparent = buoyant / density * (1.0 - RATIO) * math.tan(math.radians(15.0))
    exact = 5.0 * G * (math.sin(STEEP) - apparent * math.cos(STEEP))
    assert speed(flow) == pytest.approx(exact, rel=1e-10)  # rounding bends the plane: measured 5e-12
